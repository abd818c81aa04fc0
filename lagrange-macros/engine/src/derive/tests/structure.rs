//! What is structurally zero, who needs what, and what is rejected.

use super::kit::Build;
use super::numbers::{Random, close};
use super::systems::{mass_on_shell, mass_on_wheel, rolling_sphere, sphere_in_sphere};
use crate::derive::{NeedId, Stage};
use crate::model::{Level, Normal};

#[test]
fn structural_zeros_of_the_scenes() {
    assert_eq!(mass_on_shell().derive().pattern(), [(0, 0), (1, 1)]);
    assert_eq!(
        rolling_sphere().derive().pattern(),
        [(0, 0), (1, 1), (2, 2)]
    );
    assert_eq!(
        sphere_in_sphere().derive().pattern(),
        [(0, 0), (1, 1), (2, 2)]
    );
    assert_eq!(
        mass_on_wheel().derive().pattern(),
        [(0, 0), (1, 1), (2, 0), (2, 2), (3, 0), (3, 3)]
    );
    for scene in [
        mass_on_shell(),
        rolling_sphere(),
        sphere_in_sphere(),
        mass_on_wheel(),
    ] {
        let d = scene.derive();
        for row in &d.equations.structure.rows {
            let bias = &d.equations.outputs[row.bias.0];
            assert!(
                bias.terms.is_empty(),
                "{}: {}",
                bias.label,
                d.printed(row.bias)
            );
        }
    }
}

#[test]
fn cyclic_coordinates_of_the_scenes() {
    assert_eq!(
        mass_on_shell().derive().equations.structure.cyclic,
        [false, false]
    );
    assert_eq!(
        rolling_sphere().derive().equations.structure.cyclic,
        [false, false, true]
    );
    assert_eq!(
        mass_on_wheel().derive().equations.structure.cyclic,
        [true, true, false, false]
    );
    let free = Build::new("r theta", "m k")
        .define("px", "r*sin(theta)")
        .define("py", "r*cos(theta)")
        .kinetic("", "m/2*(der(px)^2 + der(py)^2)")
        .potential("", "-k/r")
        .derive();
    assert_eq!(free.equations.structure.cyclic, [false, true]);
}

#[test]
fn a_guard_breaks_a_cyclic_coordinate() {
    let d = Build::new("x y", "m k")
        .kinetic("", "m/2*(der(x)^2 + der(y)^2)")
        .load("push", "if(x - 1, k, 0)", &[(1, "if(x - 1, k, 0)")])
        .derive();
    assert_eq!(d.equations.structure.cyclic, [false, true]);
}

#[test]
fn every_effect_has_its_own_terms() {
    let d = Build::new("x", "m extra k c F")
        .kinetic("", "m/2*der(x)^2")
        .kinetic("load", "extra/2*der(x)^2")
        .potential("spring", "k/2*x^2")
        .load("pull", "F", &[(0, "F")])
        .dissipation("damper", "c/2*der(x)^2")
        .derive();
    let structure = &d.equations.structure;
    let mass = &d.equations.outputs[structure.mass[0].2.0];
    assert_eq!(
        mass.terms.iter().map(|t| t.0).collect::<Vec<_>>(),
        [NeedId(0), structure.kinetic[1]]
    );
    let forcing = &d.equations.outputs[structure.forcing[0].0];
    let mut needs = vec![
        structure.potential[0],
        structure.forces[0].need,
        structure.dissipations[0].need,
    ];
    needs.sort();
    assert_eq!(forcing.terms.iter().map(|t| t.0).collect::<Vec<_>>(), needs);
    // The spring is in the energy exactly while it acts.
    let potential = &d.equations.outputs[structure.energy.1.0];
    assert_eq!(
        potential.terms.iter().map(|t| t.0).collect::<Vec<_>>(),
        [structure.potential[0]]
    );
    assert_eq!(potential.stage, Stage::Report);
    let kinetic = &d.equations.outputs[structure.energy.0.0];
    assert_eq!(
        kinetic.terms.iter().map(|t| t.0).collect::<Vec<_>>(),
        [structure.kinetic[1], structure.energy.4]
    );
}

#[test]
fn forces_proportional_to_multipliers_are_couplings() {
    let mut d = Build::new("x phi", "m J R mu F")
        .kinetic("", "m/2*der(x)^2 + J/2*der(phi)^2")
        .constraint("axle", Level::Velocity, "der(x) - R*der(phi)")
        .load(
            "drag",
            "F - mu*axle*phi",
            &[(0, "F - mu*axle*phi"), (1, "axle")],
        )
        .observe("seen", "2*drag + a_x")
        .stop("slow", &["drag - 1"])
        .derive();
    let couplings: Vec<_> = d
        .equations
        .structure
        .couplings
        .iter()
        .map(|c| (c.coordinate, c.row, c.factor, c.need))
        .collect();
    let need = d.equations.structure.forces[0].need;
    let [(0, 0, on_x, a), (1, 0, on_phi, b)] = couplings[..] else {
        panic!()
    };
    assert_eq!([a, b], [need, need]);
    d.expect(on_x, "-mu*phi");
    d.expect(on_phi, "1");
    let forcing = d.equations.structure.forcing[0];
    d.expect(forcing, "F");
    let (power, seen, stop) = (
        d.equations.structure.forces[0].power,
        d.equations.structure.observes[0].0,
        d.equations.structure.stops[0].0[0],
    );
    d.expect(power, "(F - mu*axle*phi)*v_x + axle*v_phi");
    d.expect(seen, "2*(F - mu*axle*phi) + a_x");
    d.expect(stop, "F - mu*axle*phi - 1");
}

#[test]
fn branches_know_their_users() {
    let d = Build::new("x", "m k")
        .kinetic("", "m/2*der(x)^2")
        .potential("bumper", "if(x - 1, k/2*(x - 1)^2, 0)")
        .constraint("rail", Level::Velocity, "der(x)")
        .observe("hard", "if(if(rail - k, x, rail), 1, 0)")
        .derive();
    let structure = &d.equations.structure;
    let [bumper, inner, outer] = &structure.branches[..] else {
        panic!()
    };
    assert!(!bumper.after_solve && inner.after_solve && outer.after_solve);
    assert_eq!(bumper.users, [structure.potential[0]]);
    assert_eq!(outer.users, [structure.observes[0].1]);
    assert_eq!(inner.users, [structure.observes[0].1]);
    assert_eq!(d.equations.outputs[bumper.guard.0].stage, Stage::Motion);
    assert_eq!(d.equations.outputs[inner.guard.0].stage, Stage::Report);
}

#[test]
fn friction_rows_follow_contacts_and_share_needs() {
    let d = Build::new("x y z", "m g mu w")
        .kinetic("", "m/2*(der(x)^2 + der(y)^2 + der(z)^2)")
        .potential("", "m*g*z")
        .contact("floor", "z")
        .friction(
            "grip",
            Normal::Contact(0),
            &["der(x) + w*y", "der(y) - w*x"],
            "mu",
        )
        .derive();
    let structure = &d.equations.structure;
    assert_eq!(structure.frictions[0].row, 1);
    assert_eq!(structure.rows.len(), 3);
    assert_eq!(structure.rows[1].needs, structure.rows[2].needs);
    let mut random = Random::new(3);
    let p = d.point(&mut random);
    close(
        "slip",
        d.value(structure.rows[1].velocity, &p),
        p["v_x"] + p["w"] * p["y"],
    );
    close(
        "bias",
        d.value(structure.rows[2].bias, &p),
        -p["w"] * p["v_x"],
    );
}

#[test]
fn a_coordinate_without_inertia_is_rejected() {
    let scene = || {
        Build::new("x y", "m k")
            .kinetic("", "m/2*der(x)^2")
            .potential("", "k/2*(x - y)^2")
    };
    let message = scene().try_derive().err().expect("y has no inertia");
    assert!(
        message.contains("E601") && message.contains("`y`"),
        "{message}"
    );
    assert!(
        scene()
            .constraint("tie", Level::Position, "x - y")
            .try_derive()
            .is_ok()
    );
}

#[test]
fn contacts_need_a_quadratic_lagrangian() {
    let scene = || Build::new("x", "m c").lagrangian("-m*c^2*sqrt(1 - der(x)^2/c^2)");
    let message = scene()
        .contact("wall", "x")
        .try_derive()
        .err()
        .expect("not quadratic");
    assert!(
        message.contains("E507") && message.contains("der(x)"),
        "{message}"
    );
    assert!(scene().try_derive().is_ok());
}

#[test]
fn derivation_is_deterministic() {
    let run = || {
        let d = mass_on_wheel().derive();
        let pool = &d.equations.system.pool;
        let lines: Vec<String> = d
            .equations
            .outputs
            .iter()
            .map(|o| {
                let terms: Vec<_> = o
                    .terms
                    .iter()
                    .map(|&(need, e)| (need, e, pool.print(e)))
                    .collect();
                format!("{} {:?} {terms:?}", o.label, o.stage)
            })
            .collect();
        (lines, d.equations.needs)
    };
    assert_eq!(run(), run());
}
