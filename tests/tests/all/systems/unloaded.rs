//! Contacts that touch and carry nothing, in coordinates in which that is a difference of large terms.

use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, certified, event, run_by, words};

/// A balanced plank that lies against a stop, and a mass that slides off its lower end; it is counted along the plank also in its flight.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(tilt, s, n),
    define(x = s*cos(tilt) - n*sin(tilt), y = s*sin(tilt) + n*cos(tilt)),
    kinetic = inertia/2*der(tilt)^2 + mass/2*(der(x)^2 + der(y)^2),
    potential = 9.81*mass*y,
    contact(board: n >= 0, where s <= length),
    contact(rest: rise + length*sin(tilt) >= 0),
    start(slides: s = length/2, tilt = -asin(rise/length), der(s) = speed),
)]
struct Plank {
    mass: f64,
    inertia: f64,
    rise: f64,
    length: f64,
    speed: f64,
}

/// With sin α = h/L, s = L/2 + v t + g t² sin α/2 on the plank. As the mass leaves, nothing acts on the plank: it stays where it is, and its stop closed.
#[test]
fn a_plank_that_a_mass_has_left_stays_at_its_stop() {
    let mut random = Random::new(41);
    for _ in 0..12 {
        let length = random.between(0.8, 2.2);
        let plank = Plank {
            mass: random.between(0.3, 4.0),
            inertia: random.between(0.3, 3.0),
            rise: length * random.between(0.04, 0.6),
            length,
            speed: random.between(0.2, 3.0),
        };
        let (sine, v) = (plank.rise / length, plank.speed);
        let pull = 9.81 * sine;
        let leaves = ((v * v + pull * length).sqrt() - v) / pull;
        for asked in [
            ("auto", 1e-9),
            ("auto", 1e-11),
            ("dop853", 1e-12),
            ("verner98", 1e-9),
            ("radau5", 1e-9),
        ] {
            let until = leaves + 1.5;
            let run = run_by(&plank, asked, plank.at(Plank::SLIDES), until);
            let what = format!("{plank:?} by {asked:?}");
            agree(&what, event(&run, "board", "lost").time, leaves, 1e-8);
            assert_eq!(run.events().len(), 1, "{what}: {:?}", words(&run));
            assert!(run.final_mode().closed(Plank::REST), "{what}");
            let (end, fall) = (run.final_state(), until - leaves);
            agree(&what, end.q(Plank::TILT), -sine.asin(), 1e-8);
            let cosine = (1.0 - sine * sine).sqrt();
            let leaving = v + pull * leaves;
            let [x, y] = [
                length * cosine + leaving * cosine * fall,
                -length * sine - leaving * sine * fall - 9.81 * fall * fall / 2.0,
            ];
            agree(&what, end.q(Plank::S), x * cosine - y * sine, 1e-6);
            agree(&what, end.q(Plank::N), x * sine + y * cosine, 1e-6);
            certified(&what, &run);
        }
    }
}
