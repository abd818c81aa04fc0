//! Equations that textbooks derive by hand, at random states.

use super::kit::Build;
use super::numbers::{Derived, Point, Random, close};
use crate::model::{Level, Normal};

/// Calls `check` at ten random points.
fn at_random(derived: &Derived, check: impl Fn(&Point)) {
    let mut random = Random(0x5eed);
    for _ in 0..10 {
        check(&derived.point(&mut random));
    }
}

/// Point mass in the plane, θ from the vertical.
pub fn mass_on_shell() -> Build {
    Build::new("r theta", "m g R")
        .define("px", "r*sin(theta)")
        .define("py", "r*cos(theta)")
        .kinetic("", "m/2*(der(px)^2 + der(py)^2)")
        .potential("", "m*g*py")
        .contact("shell", "r - R")
}

pub fn rolling_sphere() -> Build {
    Build::new("r theta phi", "m g R a")
        .define("px", "r*sin(theta)")
        .define("py", "r*cos(theta)")
        .kinetic(
            "",
            "m/2*(der(px)^2 + der(py)^2) + 1/2*(2/5*m*a^2)*der(phi)^2",
        )
        .potential("", "m*g*py")
        .contact("shell", "r - (R + a)")
        .friction(
            "grip",
            Normal::Contact(0),
            &["a*(der(phi) - der(theta)) - R*der(theta)"],
            "1",
        )
}

pub fn mass_on_wheel() -> Build {
    Build::new("x phi r theta", "wheel inertia mass radius gravity mu")
        .define("px", "x + r*sin(theta)")
        .define("py", "r*cos(theta)")
        .kinetic(
            "",
            "wheel/2*der(x)^2 + inertia/2*der(phi)^2 + mass/2*(der(px)^2 + der(py)^2)",
        )
        .potential("", "mass*gravity*py")
        .constraint("rolling", Level::Velocity, "der(x) - radius*der(phi)")
        .contact("rim", "r - radius")
        .friction(
            "grip",
            Normal::Contact(0),
            &["radius*(der(theta) - der(phi))"],
            "mu",
        )
}

pub fn sphere_in_sphere() -> Build {
    Build::new("r theta phi", "m g R a")
        .define("px", "r*sin(theta)")
        .define("py", "-r*cos(theta)")
        .kinetic(
            "",
            "m/2*(der(px)^2 + der(py)^2) + 1/2*(2/5*m*a^2)*der(phi)^2",
        )
        .potential("", "m*g*py")
        .contact("shell", "R - a - r")
        .friction(
            "grip",
            Normal::Contact(0),
            &["R*der(theta) - a*(der(phi) + der(theta))"],
            "1",
        )
}

pub fn double_pendulum() -> Build {
    Build::new("th1 th2", "m1 m2 l1 l2 g")
        .define("x1", "l1*sin(th1)")
        .define("y1", "-l1*cos(th1)")
        .define("x2", "x1 + l2*sin(th2)")
        .define("y2", "y1 - l2*cos(th2)")
        .kinetic(
            "",
            "m1/2*(der(x1)^2 + der(y1)^2) + m2/2*(der(x2)^2 + der(y2)^2)",
        )
        .potential("", "m1*g*y1 + m2*g*y2")
}

pub fn cart_pole() -> Build {
    Build::new("x theta", "M m l g")
        .define("px", "x + l*sin(theta)")
        .define("py", "l*cos(theta)")
        .kinetic("", "M/2*der(x)^2 + m/2*(der(px)^2 + der(py)^2)")
        .potential("", "m*g*py")
}

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
fn double_pendulum_equations() {
    let d = double_pendulum().derive();
    at_random(&d, |p| {
        let (m1, m2, l1, l2, g) = (p["m1"], p["m2"], p["l1"], p["l2"], p["g"]);
        let (a, b, u, w) = (p["th1"], p["th2"], p["v_th1"], p["v_th2"]);
        close("M00", d.mass(0, 0, p), (m1 + m2) * l1 * l1);
        close("M10", d.mass(1, 0, p), m2 * l1 * l2 * (a - b).cos());
        close("M11", d.mass(1, 1, p), m2 * l2 * l2);
        close(
            "f0",
            d.forcing(0, p),
            -m2 * l1 * l2 * (a - b).sin() * w * w - (m1 + m2) * g * l1 * a.sin(),
        );
        close(
            "f1",
            d.forcing(1, p),
            m2 * l1 * l2 * (a - b).sin() * u * u - m2 * g * l2 * b.sin(),
        );
    });
}

#[test]
fn cart_pole_equations() {
    let mut d = cart_pole().derive();
    let [f_x, f_theta] = d.equations.structure.forcing[..] else {
        panic!()
    };
    d.expect(f_x, "m*l*sin(theta)*v_theta^2");
    d.expect(f_theta, "m*g*l*sin(theta)");
    let [(0, 0, m_xx), (1, 0, m_tx), (1, 1, m_tt)] = d.equations.structure.mass[..] else {
        panic!()
    };
    d.expect(m_xx, "M + m");
    d.expect(m_tx, "m*l*cos(theta)");
    d.expect(m_tt, "m*l^2");
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
fn bead_on_a_rotating_wire() {
    let mut d = Build::new("s", "m w")
        .define("px", "s*cos(w*t)")
        .define("py", "s*sin(w*t)")
        .kinetic("", "m/2*(der(px)^2 + der(py)^2)")
        .derive();
    let structure = &d.equations.structure;
    let (mass, forcing, energy) = (structure.mass[0].2, structure.forcing[0], structure.energy);
    d.expect(mass, "m");
    d.expect(forcing, "m*s*w^2");
    d.expect(energy.0, "m/2*(v_s^2 + s^2*w^2)");
    d.expect(energy.2, "m/2*(v_s^2 - s^2*w^2)");
    assert!(
        d.equations.outputs[energy.3.0].terms.is_empty(),
        "the Jacobi integral is conserved"
    );
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

#[test]
fn rayleigh_dissipation() {
    let mut d = Build::new("x y", "m c")
        .kinetic("", "m/2*(der(x)^2 + der(y)^2)")
        .dissipation("damper", "c/2*(der(x) - der(y))^2")
        .derive();
    let [f_x, f_y] = d.equations.structure.forcing[..] else {
        panic!()
    };
    d.expect(f_x, "c*(v_y - v_x)");
    d.expect(f_y, "c*(v_x - v_y)");
    let (value, power) = (
        d.equations.structure.dissipations[0].value,
        d.equations.structure.dissipations[0].power,
    );
    d.expect(value, "c/2*(v_x - v_y)^2");
    at_random(&d, |p| {
        close("power", d.value(power, p), -2.0 * d.value(value, p))
    });
}

#[test]
fn charge_in_a_magnetic_field() {
    let mut d = Build::new("x y", "m q B")
        .lagrangian("m/2*(der(x)^2 + der(y)^2) + q*B/2*(x*der(y) - y*der(x))")
        .derive();
    let [f_x, f_y] = d.equations.structure.forcing[..] else {
        panic!()
    };
    d.expect(f_x, "q*B*v_y");
    d.expect(f_y, "-q*B*v_x");
    let energy = d.equations.structure.energy;
    d.expect(energy.0, "m/2*(v_x^2 + v_y^2)");
    d.expect(energy.2, "m/2*(v_x^2 + v_y^2)");
    let p_x = d.equations.structure.momenta.0[0];
    d.expect(p_x, "m*v_x - q*B*y/2");
}

#[test]
fn relativistic_particle() {
    let d = Build::new("x", "m c k")
        .lagrangian("-m*c^2*sqrt(1 - der(x)^2/c^2) - k/2*x^2")
        .derive();
    let mut random = Random(7);
    for _ in 0..10 {
        let mut p = d.point(&mut random);
        p.insert("c".into(), 3.0);
        let gamma = (1.0 - (p["v_x"] / p["c"]).powi(2)).powf(-0.5);
        close("M", d.mass(0, 0, &p), p["m"] * gamma.powi(3));
        close("f", d.forcing(0, &p), -p["k"] * p["x"]);
        let rest = p["m"] * p["c"].powi(2);
        close(
            "h",
            d.value(d.equations.structure.energy.2, &p),
            rest * gamma + p["k"] / 2.0 * p["x"].powi(2),
        );
    }
}

/// M and f need no more operations than the equations that one finds in books.
#[test]
fn no_more_operations_than_by_hand() {
    check_operations(
        mass_on_shell().derive(),
        &[
            "m",
            "m*r^2",
            "m*r*v_theta^2 - m*g*cos(theta)",
            "m*r*(g*sin(theta) - 2*v_r*v_theta)",
        ],
    );
    check_operations(
        cart_pole().derive(),
        &[
            "M + m",
            "m*l*cos(theta)",
            "m*l^2",
            "m*l*sin(theta)*v_theta^2",
            "m*g*l*sin(theta)",
        ],
    );
    check_operations(
        double_pendulum().derive(),
        &[
            "(m1 + m2)*l1^2",
            "m2*l1*l2*cos(th1 - th2)",
            "m2*l2^2",
            "-m2*l1*l2*sin(th1 - th2)*v_th2^2 - (m1 + m2)*g*l1*sin(th1)",
            "m2*l1*l2*sin(th1 - th2)*v_th1^2 - m2*g*l2*sin(th2)",
        ],
    );
    check_operations(
        mass_on_wheel().derive(),
        &[
            "wheel + mass",
            "inertia",
            "mass*sin(theta)",
            "mass",
            "mass*r*cos(theta)",
            "mass*r^2",
            "mass*v_theta*(r*v_theta*sin(theta) - 2*v_r*cos(theta))",
            "mass*(r*v_theta^2 - gravity*cos(theta))",
            "mass*r*(gravity*sin(theta) - 2*v_r*v_theta)",
        ],
    );
}

fn check_operations(mut derived: Derived, by_hand: &[&str]) {
    let got = derived.operations();
    let by_hand = derived.operations_of(by_hand);
    assert!(
        got <= by_hand,
        "{got} operations, {by_hand} by hand: {:#?}",
        derived.equations_of_motion()
    );
}
