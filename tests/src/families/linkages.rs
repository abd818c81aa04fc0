//! Linkages with a loop, a bead on a wire between walls, and bars on rough pins.

use super::{Family, masses, perhaps, signed};
use crate::Random;
use lagrange_core::prelude::*;

/// Three rods between two fixed pivots.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[3]),
    define(
        x[k in 0..4] = sum(i in 0..k: length[i] * cos(theta[i])),
        y[k in 0..4] = sum(i in 0..k: length[i] * sin(theta[i])),
        cx[k in 0..3] = (x[k] + x[k+1]) / 2,
        cy[k in 0..3] = (y[k] + y[k+1]) / 2,
    ),
    kinetic = sum(k in 0..3: mass[k]/2 * (der(cx[k])^2 + der(cy[k])^2) + mass[k] * length[k]^2/24 * der(theta[k])^2),
    potential = sum(k in 0..3: mass[k] * 9.81 * cy[k]),
    constraint(right: x[3] == pivot[0]),
    constraint(up: y[3] == pivot[1]),
    dissipation(oil: sum(k in 0..3: drag/2 * der(theta[k])^2)),
    force(motor: theta[0] = torque),
)]
pub struct FourBar {
    pub mass: [f64; 3],
    pub length: [f64; 3],
    pub pivot: [f64; 2],
    pub drag: f64,
    pub torque: f64,
}

/// A bead on a wavy wire between two walls.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * 9.81 * y,
    constraint(wire: y == bend * x^2 + wave * sin(number * x)),
    contact(left: x >= -1, restitution = bounce),
    contact(right: x <= 1, restitution = bounce),
)]
pub struct Bead {
    pub mass: f64,
    pub bend: f64,
    pub wave: f64,
    pub number: f64,
    pub bounce: f64,
}

/// Two bars that hang from rough pins beside a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[2], y[2], theta[2]),
    define(
        right[k in 0..2] = length[k]/2 * sin(theta[k]),
        down[k in 0..2] = length[k]/2 * cos(theta[k]),
        turn[k in 0..2] = der(theta[k]) - sum(i in 0..k: der(theta[i])),
    ),
    kinetic = sum(k in 0..2: mass[k]/2 * (der(x[k])^2 + der(y[k])^2 + length[k]^2/12 * der(theta[k])^2)),
    potential = sum(k in 0..2: mass[k] * 9.81 * y[k]),
    constraint(pin_x[k in 0..2]: x[k] - right[k] == sum(i in 0..k: x[i] + right[i])),
    constraint(pin_y[k in 0..2]: y[k] + down[k] == sum(i in 0..k: y[i] - down[i])),
    friction(rub[k in 0..2] on (pin_x[k], pin_y[k]): slip = radius * turn[k], static = mu[k]),
    contact(wall: x[1] + right[1] <= far, restitution = bounce),
)]
pub struct RoughPins {
    pub mass: [f64; 2],
    pub length: [f64; 2],
    pub radius: f64,
    pub mu: [f64; 2],
    pub far: f64,
    pub bounce: f64,
}

impl Family for FourBar {
    const NAME: &'static str = "four bars";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let length = [(); 3].map(|()| random.between(0.3, 1.5));
        // Any three angles are a start: the pivot is where they lead.
        let q = signed(random, 3, 3.0);
        let end = |f: fn(f64) -> f64| length.iter().zip(&q).map(|(l, q)| l * f(*q)).sum::<f64>();
        let bars = FourBar {
            mass: masses(random),
            length,
            pivot: [end(f64::cos), end(f64::sin)],
            drag: perhaps(random, 0.1),
            torque: random.between(-3.0, 3.0),
        };
        let v = signed(random, 3, 3.0);
        (bars, State::new(q, v))
    }
}

impl Family for Bead {
    const NAME: &'static str = "bead on a wire";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let bead = Bead {
            mass: random.between(0.1, 3.0),
            bend: random.between(-1.0, 2.0),
            wave: random.between(-0.3, 0.3),
            number: random.between(1.0, 12.0),
            bounce: perhaps(random, 0.95),
        };
        let x = random.between(-0.9, 0.9);
        let q = vec![x, bead.bend * x * x + bead.wave * (bead.number * x).sin()];
        let v = vec![random.between(-3.0, 3.0), 0.0];
        (bead, State::new(q, v))
    }
}

impl Family for RoughPins {
    const NAME: &'static str = "bars on rough pins";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let length = [(); 2].map(|()| random.between(0.3, 1.5));
        let theta = signed(random, 2, 1.5);
        let far = length[0] * theta[0].sin() + length[1] * theta[1].sin();
        let bars = RoughPins {
            mass: masses(random),
            length,
            radius: random.between(0.01, 0.1),
            mu: [(); 2].map(|()| perhaps(random, 0.6)),
            far: far + random.between(0.01, 0.5),
            bounce: perhaps(random, 0.9),
        };
        let [x0, x1] = [0, 1].map(|k| length[k] * theta[k].sin());
        let [y0, y1] = [0, 1].map(|k| length[k] * theta[k].cos());
        let q = [x0 / 2.0, x0 + x1 / 2.0, -y0 / 2.0, -y0 - y1 / 2.0];
        let rates = match random.below(3) {
            0 => vec![0.0; 2],
            _ => signed(random, 2, 4.0),
        };
        let [u0, u1] = [0, 1].map(|k| length[k] * theta[k].cos() * rates[k]);
        let [w0, w1] = [0, 1].map(|k| length[k] * theta[k].sin() * rates[k]);
        let v = [u0 / 2.0, u0 + u1 / 2.0, w0 / 2.0, w0 + w1 / 2.0];
        let state = State::new([&q[..], &theta].concat(), [&v[..], &rates].concat());
        (bars, state)
    }
}
