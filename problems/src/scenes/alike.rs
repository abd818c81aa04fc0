//! Drawings that several scenes share.

use crate::drawing::{Drawing, Point, Shape, from_bottom, from_top};

/// A sphere that rolls down a shell: the shell, the sphere and the path of its centre, with the forces of `shell` and of what
/// acts along it.
pub fn sphere_on_shell(
    shell: f64,
    sphere: f64,
    [r, theta, phi]: [f64; 3],
    along: &'static str,
) -> Drawing {
    let centre = from_top([0.0; 2], r, theta);
    let touching = from_top([0.0; 2], r - sphere, theta);
    Drawing::of([
        Shape::Floor(-shell - sphere),
        Shape::Shell([0.0; 2], shell),
        Shape::Trace(centre),
        Shape::Disc(centre, sphere, phi),
    ])
    .force("shell", touching, [theta.sin(), theta.cos()])
    .force(along, touching, [theta.cos(), -theta.sin()])
}

/// A ball over a level floor: the floor, the ball and the path of its centre, with the forces of `floor` and `grip`.
pub fn ball_on_floor(radius: f64, centre: Point, phi: f64) -> Drawing {
    let bottom = [centre[0], centre[1] - radius];
    Drawing::of([
        Shape::Floor(0.0),
        Shape::Trace(centre),
        Shape::Disc(centre, radius, phi),
    ])
    .force("floor", bottom, [0.0, 1.0])
    .force("grip", bottom, [1.0, 0.0])
}

/// A mass on a spring of length r, at θ from the downward vertical: the spring, the mass and its path.
pub fn mass_on_spring(r: f64, theta: f64) -> Drawing {
    let mass = from_bottom([0.0; 2], r, theta);
    Drawing::of([
        Shape::Trace(mass),
        Shape::Spring([0.0; 2], mass),
        Shape::Pivot([0.0; 2]),
        Shape::Mass(mass),
    ])
}

/// Balls on a line.
pub fn balls(radius: f64, x: &[f64]) -> Drawing {
    Drawing::of(x.iter().map(|&x| Shape::Disc([x, 0.0], radius, 0.0)))
}
