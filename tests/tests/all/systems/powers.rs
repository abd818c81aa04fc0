//! Forces that are powers of distances: their series follow a rule of their own, whatever roots and quotients make them.

use lagrange_core::dynamics::Dynamics;
use lagrange_core::prelude::*;
use lagrange_tests::all_agree;

/// A point between a charge at the origin, a field that falls off slowly and one that has no root.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    define(square = x^2 + y^2, far = (x - 4)^2 + y^2),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential(charge: a/sqrt(square)),
    potential(lens: -b*square^0.7),
    potential(dipole: c/square^2),
    potential(well: x^4/8),
    potential(post: a/far^1.5 + b*sqrt(far)),
    start(aside: x = 1.2, y = 0.4, der(x) = 0.3, der(y) = -0.8),
    start(inside: y = 1, der(x) = 0.5),
)]
struct Field {
    a: f64,
    b: f64,
    c: f64,
}

const FIELD: Field = Field {
    a: 0.7,
    b: 0.4,
    c: 0.3,
};

/// −∂V/∂(x, y) by hand.
fn force([x, y]: [f64; 2]) -> [f64; 2] {
    let Field { a, b, c } = FIELD;
    let (square, far) = (x * x + y * y, (x - 4.0).powi(2) + y * y);
    // −2 ∂V/∂square and −2 ∂V/∂far.
    let near = a / square.powf(1.5) + 1.4 * b / square.powf(0.3) + 4.0 * c / square.powi(3);
    let post = 3.0 * a / far.powf(2.5) - b / far.sqrt();
    [
        near * x + post * (x - 4.0) - x.powi(3) / 2.0,
        near * y + post * y,
    ]
}

#[test]
fn forces_and_their_series_are_those_by_hand() {
    for start in [Field::ASIDE, Field::INSIDE] {
        let state = FIELD.at(start);
        let mut numbers = Vec::new();
        for equations in [Equations::Emitted, Equations::Interpreted] {
            let mut dynamics = Dynamics::new(&FIELD, &Effects::all());
            dynamics.set_equations(equations);
            dynamics.value(0.0, &state.q, &state.v).expect("a value");
            let by_hand = force([state.q[0], state.q[1]]);
            all_agree("forces", dynamics.acceleration(), &by_hand, 1e-14);
            dynamics
                .series(0.0, &state.q, &state.v, 20)
                .expect("a series");
            numbers.push(
                [0, 1]
                    .map(|i| dynamics.position_series(i).to_vec())
                    .concat(),
            );
        }
        all_agree("series", &numbers[0], &numbers[1], 1e-10);
    }
}

#[test]
fn the_energy_stays() {
    for (start, until) in [(Field::ASIDE, 3.0), (Field::INSIDE, 3.0)] {
        let run = Simulation::new(&FIELD)
            .tolerance(1e-12)
            .run(FIELD.at(start), 0.0..until)
            .expect("runs");
        let energy = |state: &State| {
            let [x, y] = [state.q[0], state.q[1]];
            let (square, far) = (x * x + y * y, (x - 4.0).powi(2) + y * y);
            let Field { a, b, c } = FIELD;
            (state.v[0].powi(2) + state.v[1].powi(2)) / 2.0 + a / square.sqrt()
                - b * square.powf(0.7)
                + c / square.powi(2)
                + x.powi(4) / 8.0
                + a / far.powf(1.5)
                + b * far.sqrt()
        };
        let (first, last) = (energy(&FIELD.at(start)), energy(run.final_state()));
        assert!((last - first).abs() < 1e-10 * first.abs(), "{first} {last}");
    }
}
