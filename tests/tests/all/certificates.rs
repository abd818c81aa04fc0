//! Certificates: right runs are certified, wrong ones are not.

use lagrange_core::certificate::{Certificate, Subject};
use lagrange_core::prelude::*;
use lagrange_problems::catalogue::scenes;
use lagrange_tests::fuzz::{self, METHODS, Verdict};

/// A block that is thrown onto a rough incline, slides, comes to rest, and is watched.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(s, n),
    kinetic = mass/2 * (der(s)^2 + der(n)^2),
    potential(weight: mass * gravity * (n * cos(slope) - s * sin(slope))),
    contact(plane: n >= 0, restitution = bounce),
    friction(grip on plane: slip = der(s), static = mu),
    force(wind: s = push * cos(t)),
    constraint(held while plane: der(s) == der(s)*0 + speed),
    mark(passes: s - 1/2),
    stop(far: s >= 2),
)]
struct Block {
    mass: f64,
    gravity: f64,
    slope: f64,
    bounce: f64,
    mu: f64,
    push: f64,
    speed: f64,
}
