//! An arm of six joints, its bodies told by their axes in space and by their rates about their own axes: the same motion, though
//! multiplied out the equations of neither could be derived.

use crate::interpretation::check;
use lagrange_core::prelude::*;

/// Each body turns about the last axis of the one before it. What its axes are in space is a vector of each, and so is its end.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(q[6]: "rad"),
    define(
        a0 = [cos(q[0]), sin(q[0]), 0], b0 = [0, 0, 1], c0 = [sin(q[0]), -cos(q[0]), 0],
        a1 = cos(q[1])*a0 + sin(q[1])*b0, b1 = c0, c1 = sin(q[1])*a0 - cos(q[1])*b0,
        a2 = cos(q[2])*a1 + sin(q[2])*b1, b2 = c1, c2 = sin(q[2])*a1 - cos(q[2])*b1,
        a3 = cos(q[3])*a2 + sin(q[3])*b2, b3 = c2, c3 = sin(q[3])*a2 - cos(q[3])*b2,
        a4 = cos(q[4])*a3 + sin(q[4])*b3, b4 = c3, c4 = sin(q[4])*a3 - cos(q[4])*b3,
        a5 = cos(q[5])*a4 + sin(q[5])*b4, b5 = c4, c5 = sin(q[5])*a4 - cos(q[5])*b4,
        p0 = length*a0, p1 = p0 + length*a1, p2 = p1 + length*a2,
        p3 = p2 + length*a3, p4 = p3 + length*a4, p5 = p4 + length*a5,
    ),
    kinetic = mass/2 * (dot(der(p0), der(p0)) + dot(der(p1), der(p1)) + dot(der(p2), der(p2))
        + dot(der(p3), der(p3)) + dot(der(p4), der(p4)) + dot(der(p5), der(p5)))
        + inertia/2 * (dot(der(b0), c0)^2 + dot(der(b1), c1)^2 + dot(der(b2), c2)^2
        + dot(der(b3), c3)^2 + dot(der(b4), c4)^2 + dot(der(b5), c5)^2)
        + inertia * (dot(der(c0), a0)^2 + dot(der(c1), a1)^2 + dot(der(c2), a2)^2
        + dot(der(c3), a3)^2 + dot(der(c4), a4)^2 + dot(der(c5), a5)^2),
    potential = mass*gravity * (p0[2] + p1[2] + p2[2] + p3[2] + p4[2] + p5[2]),
    contact(floor: p5[2] >= -2*length, restitution = 0.5),
    observe(height = p5[2]),
    start(bent: q = [0.3, 1.2, -0.7, 0.4, 1.1, -0.5], der(q[k in 0..6]) = 0.2*k),
)]
struct Arm {
    mass: f64,
    length: f64,
    inertia: f64,
    gravity: f64,
}

impl Default for Arm {
    fn default() -> Self {
        Self {
            mass: 1.5,
            length: 0.4,
            inertia: 0.02,
            gravity: 9.81,
        }
    }
}

/// The same with the rates u, v, w of each body about its own axes, and the velocities e, f, g of its end along them.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(q[6]: "rad"),
    define(
        s[k in 0..6] = sin(q[k]), d[k in 0..6] = cos(q[k]), r[k in 0..6] = der(q[k]),
        u1 = s[1]*r[0], v1 = r[1], w1 = -d[1]*r[0],
        u2 = d[2]*u1 + s[2]*v1, v2 = w1 + r[2], w2 = s[2]*u1 - d[2]*v1,
        u3 = d[3]*u2 + s[3]*v2, v3 = w2 + r[3], w3 = s[3]*u2 - d[3]*v2,
        u4 = d[4]*u3 + s[4]*v3, v4 = w3 + r[4], w4 = s[4]*u3 - d[4]*v3,
        u5 = d[5]*u4 + s[5]*v4, v5 = w4 + r[5], w5 = s[5]*u4 - d[5]*v4,
        g0 = -length*r[0],
        f1 = g0 + length*w1, g1 = -length*v1,
        e2 = s[2]*f1, f2 = g1 + length*w2, g2 = -d[2]*f1 - length*v2,
        e3 = d[3]*e2 + s[3]*f2, f3 = g2 + length*w3, g3 = s[3]*e2 - d[3]*f2 - length*v3,
        e4 = d[4]*e3 + s[4]*f3, f4 = g3 + length*w4, g4 = s[4]*e3 - d[4]*f3 - length*v4,
        e5 = d[5]*e4 + s[5]*f4, f5 = g4 + length*w5, g5 = s[5]*e4 - d[5]*f4 - length*v5,
        a1 = s[1], c1 = -d[1],
        a2 = d[2]*a1, c2 = s[2]*a1,
        a3 = d[3]*a2 + s[3]*c1, c3 = s[3]*a2 - d[3]*c1,
        a4 = d[4]*a3 + s[4]*c2, c4 = s[4]*a3 - d[4]*c2,
        a5 = d[5]*a4 + s[5]*c3,
        height1 = length*a1, height2 = height1 + length*a2, height3 = height2 + length*a3,
        height4 = height3 + length*a4, height5 = height4 + length*a5,
    ),
    kinetic = mass/2 * (g0^2 + f1^2 + g1^2 + e2^2 + f2^2 + g2^2
        + e3^2 + f3^2 + g3^2 + e4^2 + f4^2 + g4^2 + e5^2 + f5^2 + g5^2)
        + inertia/2 * (u1^2 + u2^2 + u3^2 + u4^2 + u5^2)
        + inertia * (r[0]^2 + v1^2 + v2^2 + v3^2 + v4^2 + v5^2),
    potential = mass*gravity * (height1 + height2 + height3 + height4 + height5),
    contact(floor: height5 >= -2*length, restitution = 0.5),
    observe(height = height5),
    start(bent: q = [0.3, 1.2, -0.7, 0.4, 1.1, -0.5], der(q[k in 0..6]) = 0.2*k),
)]
struct ArmByRates {
    mass: f64,
    length: f64,
    inertia: f64,
    gravity: f64,
}

impl Default for ArmByRates {
    fn default() -> Self {
        Self {
            mass: 1.5,
            length: 0.4,
            inertia: 0.02,
            gravity: 9.81,
        }
    }
}

#[test]
fn arms_of_six_joints_compute_as_declared() {
    check::<Arm>(include_str!("arm.rs"));
    check::<ArmByRates>(include_str!("arm.rs"));
}

#[test]
fn axes_in_space_and_rates_about_axes_of_bodies_tell_the_same_motion() {
    let (arm, by_rates) = (Arm::default(), ArmByRates::default());
    let one = Simulation::new(&arm)
        .tolerance(1e-12)
        .run(arm.at(Arm::BENT), 0.0..0.8);
    let other = Simulation::new(&by_rates)
        .tolerance(1e-12)
        .run(by_rates.at(ArmByRates::BENT), 0.0..0.8);
    let (one, other) = (one.expect("runs"), other.expect("runs"));
    assert!(!one.events().is_empty(), "the arm touches the floor");
    assert_eq!(one.events().len(), other.events().len());
    for (a, b) in one.events().iter().zip(other.events()) {
        assert!((a.time - b.time).abs() < 1e-9, "{} {}", a.time, b.time);
    }
    let (a, b) = (one.final_state(), other.final_state());
    for k in 0..6 {
        let (a, b) = (a.q(Arm::Q[k]), b.q(ArmByRates::Q[k]));
        assert!((a - b).abs() < 1e-8, "q[{k}]: {a} {b}");
    }
}
