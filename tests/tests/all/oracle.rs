//! The compiled tape against the interpretation of the same program, for every scene of the library.

use lagrange_core::arithmetic::Value;
use lagrange_core::prelude::*;
use lagrange_core::system::Held;
use lagrange_engine::interpret::{self, Machine};
use lagrange_problems::scenes::*;
use lagrange_tests::Random;

/// Compares a scene with the program that the engine makes of its own source.
fn check<S: System<Scalar = f64>>(scene: &S, source: &str) {
    let d = S::DESCRIPTION;
    let (n, rows) = (d.coordinates.len(), d.rows.len());
    let begin = source.find("#[lagrange(").expect("a declaration");
    let end = begin + source[begin..].find("\n}").expect("the end of the struct") + 2;
    let program = lagrange_engine::program(source[begin..end].parse().expect("tokens"))
        .expect("a right declaration");
    let mut random = Random::new(11);
    for round in 0..100 {
        let mut scene = scene.clone();
        for i in 0..d.parameters.len() {
            scene.set_parameter(i, random.between(0.3, 2.0));
        }
        let parameters: Vec<f64> = (0..d.parameters.len())
            .map(|i| scene.parameter(i))
            .collect();
        let machine = Machine::new(&program, &parameters);
        let x: Vec<f64> = (0..1 + 3 * n + rows)
            .map(|_| random.between(0.2, 1.5))
            .collect();
        // Everything, or any needs (need 0 is always held).
        let needs: Vec<u64> = (0..d.needs.div_ceil(64))
            .map(|_| {
                if round == 0 {
                    u64::MAX
                } else {
                    random.between(0.0, 1e18) as u64 | 1
                }
            })
            .collect();
        let held = Held {
            needs: &needs,
            branches: &[],
        };
        let told = interpret::Held {
            needs: &needs,
            branches: &[],
        };

        let mut constants = vec![0.0; d.constants];
        scene.constants(&held, &mut constants);
        let mut motion = vec![f64::NAN; d.motion.outputs];
        scene.motion(
            &mut Value::new(),
            &held,
            &constants,
            &x[..1 + 2 * n],
            &mut motion,
        );
        let mut report = vec![f64::NAN; d.report.outputs];
        scene.report(&mut Value::new(), &held, &constants, &x, &mut report);

        let both = [
            (motion, machine.motion(&told, &x[..1 + 2 * n])),
            (report, machine.report(&told, &x)),
        ];
        for (compiled, interpreted) in both {
            assert_eq!(compiled.len(), interpreted.len());
            let mut compared = 0;
            for (a, b) in compiled
                .iter()
                .zip(&interpreted)
                .filter(|(_, b)| !b.is_nan())
            {
                assert!(
                    (a - b).abs() <= 1e-12 * b.abs().max(1.0),
                    "{}: {a} and {b}",
                    d.name
                );
                compared += 1;
            }
            assert!(
                round > 0 || compared == interpreted.len(),
                "with all needs held every output is defined"
            );
        }
    }
}

#[test]
fn compiled_tapes_are_the_interpreted_programs() {
    check(
        &MassOnShell::default(),
        include_str!("../../../problems/src/scenes/mass_on_shell.rs"),
    );
    check(
        &RollingSphere::default(),
        include_str!("../../../problems/src/scenes/rolling_sphere.rs"),
    );
    check(
        &RollingSlippingSphere::default(),
        include_str!("../../../problems/src/scenes/rolling_slipping_sphere.rs"),
    );
    check(
        &MassOnWheel::default(),
        include_str!("../../../problems/src/scenes/mass_on_wheel.rs"),
    );
    check(
        &SphereInBowl::default(),
        include_str!("../../../problems/src/scenes/sphere_in_bowl.rs"),
    );
}
