use lagrange_core::prelude::*;
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    constraint(rod: y * cos(rate * t) == x * sin(rate * t)),
    friction(rub on rod: slip = der(x) * cos(rate * t) + der(y) * sin(rate * t), static = mu, kinetic = mu),
    start(inwards: x = distance, der(x) = -speed, der(y) = rate * distance),
    observe(r = x * cos(rate * t) + y * sin(rate * t)),
)]
pub struct RodSleeve<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", symbol = "m")]
    pub mass: T,
    /// Rate ω of the rod, rad/s.
    #[lagrange(unit = "rad/s", symbol = "omega")]
    pub rate: T,
    /// Coefficient of friction.
    #[lagrange(unit = "1", symbol = "mu")]
    pub mu: T,
    /// Distance from the axle at the start, m.
    #[lagrange(unit = "m")]
    pub distance: T,
    /// Speed inwards at the start, m/s.
    #[lagrange(unit = "m/s", symbol = "v_0")]
    pub speed: T,
}
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    attitude(body: q),
    kinetic = sum(k in 0..3: inertia[k]/2 * body.body_rate[k]^2),
    start(spun: q[0] = 1, der(q[1]) = nudge/2, der(q[2]) = rate/2),
    observe(rate_of_body = body.body_rate),
)]
pub struct TumblingBody<T = f64> {
    /// Principal moments of inertia, kg m², ascending.
    #[lagrange(unit = "kg m^2", symbol = "I")]
    pub inertia: [T; 3],
    /// Rate about the middle axis at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub rate: T,
    /// Rate about the first axis at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub nudge: T,
}
fn main() {
    let scene: TumblingBody<f64> = TumblingBody {
        inertia: [1.0, 2.0, 3.0],
        rate: 2.0,
        nudge: 0.01,
    };
    let t = Simulation::new(&scene)
        .tolerance(1e-12)
        .run(scene.at(<TumblingBody>::SPUN), 0.0..2.0)
        .unwrap();
    let now = t.sampler().at(0.007251424156671).unwrap();
    for e in [
        Equations::Emitted,
        Equations::Interpreted,
        Equations::Solved,
    ] {
        let mut d = t.dynamics();
        d.set_equations(e);
        d.value(now.time, &now.q, &now.v).unwrap();
        println!("{e:?} {:?} {:?}", d.acceleration(), d.force(0));
    }
}
