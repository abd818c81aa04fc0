//! Equations of motion that textbooks derive by hand, of systems without constraints, at random states.

use super::kit::Build;
use super::numbers::{Random, at_random, close};
use super::systems::{cart_pole, double_pendulum};

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
    let mut random = Random::new(7);
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
