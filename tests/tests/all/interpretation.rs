//! The programs of the five scenes as the core runs them against the engine's own interpretation of the same declarations: each
//! scene's source is read again through the pipeline, in process, and both are run on the same numbers, with any set of needs.

use lagrange_core::__private::program::Selection;
use lagrange_core::arithmetic::Dual;
use lagrange_core::system::Derived;
use lagrange_engine::interpret::{self, Machine};
use lagrange_engine::plan::Program;
use lagrange_problems::scenes::*;
use lagrange_tests::{Random, agree};
use quote::ToTokens;

/// Random states and need sets for each scene.
const CASES: usize = 200;

/// The program of the struct called `name` in a Rust source.
fn program(source: &str, name: &str) -> Program {
    let file = syn::parse_file(source).expect("Rust");
    let item = file
        .items
        .into_iter()
        .find_map(|item| match item {
            syn::Item::Struct(mut item) if item.ident == name => {
                // rustc does not show a derive macro the `derive` that called it.
                item.attrs.retain(|a| !a.path().is_ident("derive"));
                Some(item)
            }
            _ => None,
        })
        .expect("the struct");
    lagrange_engine::program(item.into_token_stream()).unwrap_or_else(|m| panic!("{m}"))
}

/// Constants, motion and report of the core's interpreter; NaN where nothing that is held asks for a number.
fn interpreted_by_core<S: Derived<Scalar = f64>>(
    scene: &S,
    held: &Selection,
    x: &[f64],
) -> [Vec<f64>; 3] {
    let d = S::DESCRIPTION;
    let parameters = parameters(scene);
    let numbers = |list: Vec<Option<f64>>| -> Vec<f64> {
        list.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect()
    };
    let constants = numbers(d.constants.evaluate(held, &[], &[], &parameters));
    let state = &x[..1 + 2 * d.coordinates.len()];
    let motion = numbers(d.motion.evaluate(held, &constants, &parameters, state));
    let report = numbers(d.report.evaluate(held, &constants, &parameters, x));
    [constants, motion, report]
}

fn parameters<S: Derived<Scalar = f64>>(scene: &S) -> Vec<f64> {
    let count = S::DESCRIPTION.parameters.len();
    (0..count).map(|i| scene.parameter(i)).collect()
}

fn random_inputs<S: Derived>(random: &mut Random) -> Vec<f64> {
    let d = S::DESCRIPTION;
    let count = 1 + 3 * d.coordinates.len() + d.rows.len();
    (0..count).map(|_| random.between(0.2, 2.0)).collect()
}

pub fn check<S: Derived<Scalar = f64> + Default>(source: &str) {
    let d = S::DESCRIPTION;
    let program = program(source, d.name);
    let mut random = Random::new(d.name.len() as u64);
    let mut scene = S::default();
    for case in 0..CASES {
        let parameters: Vec<f64> = (0..d.parameters.len())
            .map(|i| {
                let value = random.between(0.1, 2.0);
                scene.set_parameter(i, value);
                assert_eq!(scene.parameter(i), value, "parameter {i}");
                value
            })
            .collect();
        let machine = Machine::new(&program, &parameters);
        let needs: Vec<u64> = (0..d.needs.div_ceil(64))
            .map(|_| match case {
                0 => u64::MAX,
                1 => 1,
                _ => random.bits() | 1,
            })
            .collect();
        let x = random_inputs::<S>(&mut random);
        let branches: Vec<u64> = (0..d.branches.len().div_ceil(64))
            .map(|_| random.bits())
            .collect();
        let held = Selection {
            needs: &needs,
            branches: &branches,
        };
        let interpreted = interpret::Selection {
            needs: &needs,
            branches: &branches,
        };
        let motion = &x[..1 + 2 * d.coordinates.len()];
        let oracle = [
            machine.constants(&interpreted),
            machine.motion(&interpreted, motion),
            machine.report(&interpreted, &x),
        ];
        for (what, (found, expected)) in ["constants", "motion", "report"]
            .iter()
            .zip(interpreted_by_core(&scene, &held, &x).iter().zip(&oracle))
        {
            assert_eq!(found.len(), expected.len(), "{what}");
            for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
                // To the last bit, and both NaN where neither ran.
                assert!(
                    found.to_bits() == expected.to_bits() || found.is_nan() && expected.is_nan(),
                    "{} {what}[{i}]: by the core {found:e}, by the engine {expected:e}, needs {needs:x?}",
                    d.name
                );
            }
        }
    }
}

/// Starts of the emitted code against the interpretation, at random parameters.
fn check_starts<S: Derived<Scalar = f64> + Default>(source: &str) {
    let d = S::DESCRIPTION;
    let program = program(source, d.name);
    let mut random = Random::new(7);
    let mut scene = S::default();
    for _ in 0..20 {
        let parameters: Vec<f64> = d
            .parameters
            .iter()
            .map(|_| random.between(0.1, 2.0))
            .collect();
        for (i, value) in parameters.iter().enumerate() {
            scene.set_parameter(i, *value);
        }
        for start in 0..d.starts.len() {
            let n = d.coordinates.len();
            let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
            scene.start(start, 0.3, &mut q, &mut v);
            let oracle = Machine::new(&program, &parameters).start(start, 0.3);
            assert_eq!((q, v), oracle, "{} {}", d.name, d.starts[start]);
        }
    }
}

/// The motion program over dual numbers against central differences of the engine's interpretation.
pub fn check_derivatives<S: Derived<Scalar = f64> + Default>(source: &str) {
    let d = S::DESCRIPTION;
    let program = program(source, d.name);
    let mut random = Random::new(11);
    let scene = S::default();
    let parameters = parameters(&scene);
    let machine = Machine::new(&program, &parameters);
    let needs = vec![u64::MAX; d.needs.div_ceil(64)];
    let branches = vec![u64::MAX; d.branches.len().div_ceil(64)];
    let held = Selection {
        needs: &needs,
        branches: &branches,
    };
    let interpreted = interpret::Selection {
        needs: &needs,
        branches: &branches,
    };
    let constant = |&x: &f64| Dual::constant(x);
    let constants: Vec<Dual<f64, 1>> = machine
        .constants(&interpreted)
        .iter()
        .map(constant)
        .collect();
    let parameters: Vec<Dual<f64, 1>> = parameters.iter().map(constant).collect();
    for _ in 0..10 {
        let x = random_inputs::<S>(&mut random);
        let x = &x[..1 + 2 * d.coordinates.len()];
        for input in 0..x.len() {
            let seeded: Vec<Dual<f64, 1>> = x
                .iter()
                .enumerate()
                .map(|(i, x)| match i == input {
                    true => Dual::variable(*x, 0),
                    false => Dual::constant(*x),
                })
                .collect();
            let duals = d.motion.evaluate(&held, &constants, &parameters, &seeded);
            let moved = |h: f64| {
                let mut x = x.to_vec();
                x[input] += h;
                machine.motion(&interpreted, &x)
            };
            let h = 1e-5;
            let (up, down) = (moved(h), moved(-h));
            for (i, dual) in duals.into_iter().flatten().enumerate() {
                let slope = (up[i] - down[i]) / (2.0 * h);
                agree(
                    format!("{} ∂y[{i}]/∂x[{input}]", d.name),
                    dual.derivative[0],
                    slope,
                    1e-7,
                );
            }
        }
    }
}

macro_rules! scenes {
    ($($test:ident $scene:ident $file:literal;)*) => {$(
        #[test]
        fn $test() {
            let source = include_str!(concat!("../../../problems/src/scenes/", $file));
            check::<$scene>(source);
            check_starts::<$scene>(source);
            check_derivatives::<$scene>(source);
        }
    )*};
}

scenes! {
    mass_on_shell MassOnShell "mass_on_shell.rs";
    rolling_sphere RollingSphere "rolling_sphere.rs";
    rolling_slipping_sphere RollingSlippingSphere "rolling_slipping_sphere.rs";
    mass_on_wheel MassOnWheel "mass_on_wheel.rs";
    sphere_in_bowl SphereInBowl "sphere_in_bowl.rs";
}
