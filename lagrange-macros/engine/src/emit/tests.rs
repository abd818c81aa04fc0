//! Emitted code reads as planned.

use super::emit;
use crate::derive::tests::kit::Build;
use crate::model::{Level, Normal};
use crate::plan::{Program, plan};
use quote::quote;

/// The wheel of the design with a mass on its rim.
fn wheel() -> Program {
    let mut build = Build::new("x phi r theta", "wheel inertia mass gravity radius mu")
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
        );
    build.system.core = quote!(::lagrange_core);
    build.system.scalar = Some(super::names::plain("T"));
    plan(build.derive().equations)
}

fn double() -> Program {
    let mut build = Build::new("a b", "m1 m2 l1 l2 g")
        .define("x1", "l1*sin(a)")
        .define("y1", "-l1*cos(a)")
        .define("x2", "x1 + l2*sin(b)")
        .define("y2", "y1 - l2*cos(b)")
        .kinetic(
            "",
            "m1/2*(der(x1)^2 + der(y1)^2) + m2/2*(der(x2)^2 + der(y2)^2)",
        )
        .potential("", "m1*g*y1 + m2*g*y2");
    build.system.core = quote!(::lagrange_core);
    plan(build.derive().equations)
}

#[test]
fn show() {
    for program in [double(), wheel()] {
        for (o, p) in program.equations.outputs.iter().zip(&program.places) {
            println!(
                "{} {:?} {:?}",
                o.label,
                p,
                o.terms
                    .iter()
                    .map(|(n, e)| (n.0, program.equations.system.pool.print(*e)))
                    .collect::<Vec<_>>()
            );
        }
        println!(
            "motion {} report {}",
            program.motion.operations(&[1]),
            program.report.operations(&[!0])
        );
        std::fs::write(
            format!("/tmp/emit{}.rs", program.equations.system.parameters.len()),
            emit(&program).to_string(),
        )
        .unwrap();
    }
}
