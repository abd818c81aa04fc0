//! Coordinates that fail at a point, and attitudes.

use super::kit::{TOLERANCE, cross, distance, relative, run, violation};
use crate::reference::{agm, jacobi, over_a_turn};
use crate::scenes::hard::{PolarParticle, SphericalPendulum, TumblingBody};
use core::f64::consts::{FRAC_PI_2, PI};
use lagrange_core::prelude::*;
use lagrange_program::stability::{Extent, Figure, Surprise};

/// Demands that a run from a point where the coordinate `phi` has no meaning is refused, naming it.
fn refused<S: System<Scalar = f64>>(scene: &S, start: StartId) -> Result<(), Surprise> {
    let run = Simulation::new(scene)
        .tolerance(TOLERANCE)
        .run(scene.at(start), 0.0..1.0);
    match run.map(|_| ()).map_err(|failure| failure.error) {
        Err(Error::Singular { items, .. }) if items == ["phi"] => Ok(()),
        other => Err(Surprise::NotRefused {
            expected: "the mass matrix is singular in `phi`",
            found: other.err(),
        }),
    }
}

pub fn spherical_pendulum(_: Extent) -> Result<Vec<Figure>, Surprise> {
    const SWINGS: f64 = 4.0;
    let scene = SphericalPendulum::default();
    let SphericalPendulum {
        length,
        gravity,
        amplitude,
        nearest,
        ..
    } = scene;
    let start = scene.at(SphericalPendulum::TURNING);
    let momentum = start.v[1] * amplitude.sin().powi(2);
    // With w = 1 − cos θ between w₂ and w₁: ẇ² = (2g/l)(w₁ − w)(w − w₂)(D − w), φ̇ = ℓ/(w(2 − w)).
    let (low, high) = (
        2.0 * (0.5 * nearest).sin().powi(2),
        2.0 * (0.5 * amplitude).sin().powi(2),
    );
    let (near, far) = (nearest.cos(), amplitude.cos());
    let beyond = 1.0 + (1.0 + near * far) / (near + far);
    let root = |w: f64| (2.0 * gravity / length * (beyond - w)).sqrt();
    let w = |psi: f64| low + (high - low) * psi.sin().powi(2);
    // 2 dψ over a quarter turn of ψ.
    let half = 0.5 * over_a_turn(|psi| 1.0 / root(w(psi)));
    let density = |w: f64| momentum / ((2.0 - w) * root(w));
    // The peak at the pole, ∫ dψ/w = π/(2√(w₁ w₂)), in closed form; the rest is smooth.
    let smooth = over_a_turn(|psi| {
        let w = w(psi);
        if w > 1e-9 {
            (density(w) - density(0.0)) / w
        } else {
            0.0
        }
    });
    let advance = 2.0 * (density(0.0) * FRAC_PI_2 / (low * high).sqrt() + 0.25 * smooth);
    let trajectory = run(&scene, SphericalPendulum::TURNING, SWINGS * 2.0 * half)?;
    let end = trajectory.final_state();
    let found = end.v[1] * end.q[0].sin().powi(2);
    refused(&scene, SphericalPendulum::POLE)?;
    Ok(vec![
        Figure::new(
            format!("θ after {SWINGS} passes"),
            relative(end.q[0].abs(), amplitude),
            1e-9,
        ),
        Figure::new("azimuth", relative(end.q[1], SWINGS * 2.0 * advance), 1e-9),
        // φ̇ far from the pole is itself no larger than 1e-6 rad/s.
        Figure::new("angular momentum, rad/s", distance(found, momentum), 1e-12),
    ])
}

pub fn polar_particle(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = PolarParticle::default();
    let trajectory = run(&scene, PolarParticle::PASSING, 2.0)?;
    let end = trajectory.final_state();
    let (x, y) = (end.q[0] * end.q[1].cos(), end.q[0] * end.q[1].sin());
    refused(&scene, PolarParticle::ORIGIN)?;
    let momentum = end.q[0] * end.q[0] * end.v[1];
    Ok(vec![
        Figure::new("place along the line, m", distance(x, 1.0), 1e-9),
        Figure::new("place across it, m", distance(y, scene.distance), 1e-9),
        Figure::new(
            "angular momentum, m²/s",
            distance(momentum, -scene.speed * scene.distance),
            1e-12,
        ),
    ])
}

/// Quaternion product.
fn product(p: [f64; 4], q: [f64; 4]) -> [f64; 4] {
    let (u, v) = ([p[1], p[2], p[3]], [q[1], q[2], q[3]]);
    let c = cross(u, v);
    let dot: f64 = (0..3).map(|k| u[k] * v[k]).sum();
    [
        p[0] * q[0] - dot,
        p[0] * v[0] + q[0] * u[0] + c[0],
        p[0] * v[1] + q[0] * u[1] + c[1],
        p[0] * v[2] + q[0] * u[2] + c[2],
    ]
}

pub fn tumbling_body(_: Extent) -> Result<Vec<Figure>, Surprise> {
    const PERIODS: u32 = 2;
    let scene = TumblingBody::default();
    let TumblingBody {
        inertia: [a, b, c],
        rate,
        nudge,
        ..
    } = scene;
    // Landau & Lifshitz, Mechanics, §37, with 1 and 3 exchanged, since L² < 2 E I₂.
    let (energy2, momentum2) = (
        a * nudge * nudge + b * rate * rate,
        (a * nudge).powi(2) + (b * rate).powi(2),
    );
    let first = ((energy2 * c - momentum2) / (a * (c - a))).sqrt();
    let third = ((momentum2 - energy2 * a) / (c * (c - a))).sqrt();
    let lambda = ((b - a) * (energy2 * c - momentum2) / (a * b * c)).sqrt();
    let complement = nudge / first;
    let quarter = FRAC_PI_2 / agm(1.0, complement) / lambda;
    let rates = |t: f64| {
        let (sn, cn, dn) = jacobi(lambda * (t + quarter), complement);
        [first * dn, rate * sn, third * cn]
    };
    let (period, momentum) = (4.0 * quarter, momentum2.sqrt());
    // φ̇ = L (I₂Ω₂² + I₃Ω₃²)/(I₂²Ω₂² + I₃²Ω₃²) about the angular momentum.
    let turned = period / (2.0 * PI)
        * over_a_turn(|x| {
            let [_, y, z] = rates(period * x / (2.0 * PI));
            momentum * (b * y * y + c * z * z) / ((b * y).powi(2) + (c * z).powi(2))
        });
    let until = f64::from(PERIODS) * period;
    let trajectory = run(&scene, TumblingBody::SPUN, until)?;
    let mut sampler = trajectory.sampler();
    let mut worst: f64 = 0.0;
    for k in 0..=300 {
        let t = until * f64::from(k) / 300.0;
        let found = sampler.at(t)?.observes;
        for (x, y) in found.iter().zip(rates(t)) {
            worst = worst.max(distance(*x, y) / rate);
        }
    }
    // The start is q = 1, so the attitude at the end is that turn itself.
    let (s, co) = (0.5 * turned * f64::from(PERIODS)).sin_cos();
    let expected = [co, s * a * nudge / momentum, s * b * rate / momentum, 0.0];
    let q = &trajectory.final_state().q;
    let difference = product([q[0], -q[1], -q[2], -q[3]], expected);
    let off = 2.0 * difference[1].hypot(difference[2]).hypot(difference[3]);
    // A flip begins nudge/rate = 1/200 from the unstable axis and its time goes with the logarithm of that distance: an error
    // there, of the size of the tolerance per step, comes back 200 times larger, and there are four flips of some ten steps.
    let bound = TOLERANCE * (rate / nudge) * 40.0;
    Ok(vec![
        Figure::new(format!("rates over {PERIODS} periods"), worst, bound),
        Figure::new("attitude after them, rad", off, 1e-9),
        Figure::new("length of the quaternion", violation(&trajectory)?, 1e-12),
    ])
}
