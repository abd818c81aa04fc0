//! Constraints and contacts that textbooks derive by hand, at random states.

use super::kit::Build;
use super::numbers::{at_random, close};
use super::systems::{mass_on_shell, mass_on_wheel, rolling_sphere, sphere_in_sphere};
use crate::model::Level;

#[test]
fn mass_on_shell_in_polar_coordinates() {
    let mut d = mass_on_shell().derive();
    let [f_r, f_theta] = d.equations.structure.forcing[..] else {
        panic!()
    };
    d.expect(f_r, "m*r*v_theta^2 - m*g*cos(theta)");
    d.expect(f_theta, "m*r*(g*sin(theta) - 2*v_r*v_theta)");
    let [(0, 0, m_rr), (1, 1, m_tt)] = d.equations.structure.mass[..] else {
        panic!("{:?}", d.pattern())
    };
    d.expect(m_rr, "m");
    d.expect(m_tt, "m*r^2");
    // N = m g cosθ − m R θ̇² on the shell.
    at_random(&d, |p| {
        let mut p = p.clone();
        p.insert("r".into(), p["R"]);
        p.insert("v_r".into(), 0.0);
        let [_, theta, normal] = d.accelerations(&[0], &p)[..] else {
            panic!()
        };
        close("theta", theta, p["g"] * p["theta"].sin() / p["R"]);
        close(
            "N",
            normal,
            p["m"] * (p["g"] * p["theta"].cos() - p["R"] * p["v_theta"].powi(2)),
        );
    });
}

#[test]
fn rolling_sphere_on_a_sphere() {
    let d = rolling_sphere().derive();
    at_random(&d, |p| {
        let mut p = p.clone();
        let reach = p["R"] + p["a"];
        p.insert("r".into(), reach);
        p.insert("v_r".into(), 0.0);
        let [_, theta, _, normal, friction] = d.accelerations(&[0, 1], &p)[..] else {
            panic!()
        };
        close(
            "theta",
            theta,
            5.0 / 7.0 * p["g"] * p["theta"].sin() / reach,
        );
        close(
            "N",
            normal,
            p["m"] * (p["g"] * p["theta"].cos() - reach * p["v_theta"].powi(2)),
        );
        close(
            "friction",
            friction,
            2.0 / 7.0 * p["m"] * p["g"] * p["theta"].sin(),
        );
    });
}

#[test]
fn sphere_in_a_sphere() {
    let d = sphere_in_sphere().derive();
    at_random(&d, |p| {
        let mut p = p.clone();
        let reach = p["R"] - p["a"];
        p.insert("r".into(), reach);
        p.insert("v_r".into(), 0.0);
        let [_, theta, _, normal, _] = d.accelerations(&[0, 1], &p)[..] else {
            panic!()
        };
        close(
            "theta",
            theta,
            -5.0 / 7.0 * p["g"] * p["theta"].sin() / reach,
        );
        close(
            "N",
            normal,
            p["m"] * (p["g"] * p["theta"].cos() + reach * p["v_theta"].powi(2)),
        );
    });
}

#[test]
fn mass_on_a_rolling_wheel() {
    let mut d = mass_on_wheel().derive();
    for (place, wanted) in [
        ((0, 0), "wheel + mass"),
        ((1, 1), "inertia"),
        ((2, 0), "mass*sin(theta)"),
        ((2, 2), "mass"),
        ((3, 0), "mass*r*cos(theta)"),
        ((3, 3), "mass*r^2"),
    ] {
        let entry = d
            .equations
            .structure
            .mass
            .iter()
            .find(|&&(i, j, _)| (i, j) == place);
        let output = entry.unwrap_or_else(|| panic!("{place:?} is missing")).2;
        d.expect(output, wanted);
    }
    let [f_x, f_phi, f_r, f_theta] = d.equations.structure.forcing[..] else {
        panic!()
    };
    d.expect(
        f_x,
        "mass*v_theta*(r*v_theta*sin(theta) - 2*v_r*cos(theta))",
    );
    assert!(d.equations.outputs[f_phi.0].terms.is_empty());
    d.expect(f_r, "mass*(r*v_theta^2 - gravity*cos(theta))");
    d.expect(f_theta, "mass*r*(gravity*sin(theta) - 2*v_r*v_theta)");
    at_random(&d, |p| {
        assert_eq!(d.jacobian(0, p), [1.0, -p["radius"], 0.0, 0.0]);
        assert_eq!(d.jacobian(1, p), [0.0, 0.0, 1.0, 0.0]);
        assert_eq!(d.jacobian(2, p), [0.0, -p["radius"], 0.0, p["radius"]]);
    });
}

#[test]
fn pendulum_in_cartesian_coordinates() {
    let mut d = Build::new("x y", "m g l")
        .kinetic("", "m/2*(der(x)^2 + der(y)^2)")
        .potential("", "m*g*y")
        .constraint("rod", Level::Position, "x^2 + y^2 - l^2")
        .derive();
    let row = &d.equations.structure.rows[0];
    let (jacobian, bias, position, velocity) =
        (row.jacobian.clone(), row.bias, row.position, row.velocity);
    let [(0, a_x), (1, a_y)] = jacobian[..] else {
        panic!()
    };
    d.expect(a_x, "2*x");
    d.expect(a_y, "2*y");
    d.expect(bias, "2*(v_x^2 + v_y^2)");
    d.expect(velocity, "2*(x*v_x + y*v_y)");
    d.expect(position.expect("position level"), "x^2 + y^2 - l^2");
}

#[test]
fn moving_support() {
    let mut d = Build::new("x", "m A w")
        .kinetic("", "m/2*der(x)^2")
        .constraint("shaker", Level::Position, "x - A*sin(w*t)")
        .derive();
    let row = &d.equations.structure.rows[0];
    let (bias, velocity) = (row.bias, row.velocity);
    d.expect(bias, "A*w^2*sin(w*t)");
    d.expect(velocity, "v_x - A*w*cos(w*t)");
}

#[test]
fn knife_edge() {
    let mut d = Build::new("x y theta", "m J")
        .kinetic("", "m/2*(der(x)^2 + der(y)^2) + J/2*der(theta)^2")
        .constraint(
            "blade",
            Level::Velocity,
            "sin(theta)*der(x) - cos(theta)*der(y)",
        )
        .derive();
    let row = &d.equations.structure.rows[0];
    assert!(row.position.is_none());
    let bias = row.bias;
    d.expect(bias, "v_theta*(cos(theta)*v_x + sin(theta)*v_y)");
    at_random(&d, |p| {
        assert_eq!(d.jacobian(0, p), [p["theta"].sin(), -p["theta"].cos(), 0.0])
    });
}
