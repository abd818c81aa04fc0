//! The equations in rates of bodies say what those in quaternions say that are emitted.
//!
//! At a state with q̇ = ½ q ω the four balances of a quaternion, projected on its three turns, are the balances of ω; the
//! projections need no solver.

use super::{derivation, planned, scenes};
use crate::derive::{Equations, OutputId};
use crate::inspect::print;
use crate::model;
use crate::symbolic::{ExprId, Symbol};
use quote::quote;
use std::collections::BTreeMap;

/// A state: numbers by name, and the velocities' derivative.
struct State {
    numbers: BTreeMap<Symbol, f64>,
}

impl State {
    fn of(&self, equations: &Equations, e: ExprId) -> f64 {
        let at = |symbol| self.numbers.get(&symbol).copied().unwrap_or(0.3);
        equations.system.pool.evaluate(&[e], &at, &|_| true)[0]
    }

    fn output(&self, equations: &Equations, output: OutputId) -> f64 {
        let terms = equations.outputs[output.0].terms.iter();
        terms.map(|&(_, e)| self.of(equations, e)).sum()
    }
}

/// q ω as quaternions, halved: the rate of q.
fn half_product([w, x, y, z]: [f64; 4], [a, b, c]: [f64; 3]) -> [f64; 4] {
    [
        -(x * a + y * b + z * c) / 2.0,
        (w * a + y * c - z * b) / 2.0,
        (w * b + z * a - x * c) / 2.0,
        (w * c + x * b - y * a) / 2.0,
    ]
}

/// M v̇ − f of each coordinate, and per row its velocity, a v̇ + γ, and a.
struct Balance {
    coordinates: Vec<f64>,
    rows: BTreeMap<String, ([f64; 2], Vec<f64>)>,
    energies: [f64; 2],
}

fn balance(equations: &Equations, state: &State, accelerations: &[f64]) -> Balance {
    let structure = &equations.structure;
    let number = |output| state.output(equations, output);
    let mut coordinates: Vec<f64> = structure.forcing.iter().map(|&f| -number(f)).collect();
    for &(i, j, entry) in &structure.mass {
        coordinates[i] += number(entry) * accelerations[j];
        if i != j {
            coordinates[j] += number(entry) * accelerations[i];
        }
    }
    let names = equations
        .system
        .constraints
        .iter()
        .map(|c| c.name.text.clone());
    let mut rows = BTreeMap::new();
    for (name, row) in names.zip(&structure.rows) {
        let mut jacobian = vec![0.0; accelerations.len()];
        for &(j, entry) in &row.jacobian {
            jacobian[j] = number(entry);
        }
        let along: f64 = jacobian.iter().zip(accelerations).map(|(a, v)| a * v).sum();
        rows.insert(
            name,
            ([number(row.velocity), along + number(row.bias)], jacobian),
        );
    }
    let energies = [number(structure.energy.0), number(structure.energy.1)];
    Balance {
        coordinates,
        rows,
        energies,
    }
}

#[test]
fn equations_in_body_rates_are_those_in_quaternions() {
    let mut seen = 0;
    for (name, tokens) in scenes() {
        let (declaration, program) = planned(tokens);
        let Some(system) = model::in_body_rates(&declaration) else {
            continue;
        };
        let mut sink = crate::diagnostics::Diagnostics::new();
        let turned = crate::derive::equations(system, &mut sink).expect("regular");
        let plain = program.equations;
        seen += 1;

        let mut states = [(); 2].map(|()| State {
            numbers: BTreeMap::new(),
        });
        for (state, equations) in states.iter_mut().zip([&plain, &turned]) {
            for (i, parameter) in equations.system.parameters.iter().enumerate() {
                state
                    .numbers
                    .insert(parameter.symbol, 0.4 + (0.618 * i as f64).fract());
            }
        }
        let number = |name: &str, salt: f64| {
            let sum: u32 = name.bytes().map(u32::from).sum();
            (f64::from(sum) * 0.618 + salt).fract() - 0.4
        };
        // Ordinary coordinates by name; their accelerations.
        let mut accelerations = [
            vec![0.0; plain.system.coordinates.len()],
            vec![0.0; turned.system.coordinates.len()],
        ];
        for (k, equations) in [&plain, &turned].into_iter().enumerate() {
            for (i, c) in equations.system.coordinates.iter().enumerate() {
                let text = &c.name.text;
                states[k].numbers.insert(c.position, number(text, 0.1));
                states[k].numbers.insert(c.velocity, number(text, 0.5));
                accelerations[k][i] = number(text, 0.8);
            }
        }
        // Quaternions by the rates of the bodies.
        let mut bodies = Vec::new();
        for body in &turned.system.bodies {
            let row = plain
                .system
                .constraints
                .iter()
                .position(|c| c.name.text == body.name);
            let unit = &plain.structure.rows[row.expect("the unit constraint")];
            let first = unit.jacobian[0].0;
            let raw = [0.7, -0.3, 0.5, 0.2 + 0.1 * bodies.len() as f64];
            let length = raw.iter().map(|x| x * x).sum::<f64>().sqrt();
            let q = raw.map(|x| x / length);
            let turns = [0, 1, 2].map(|k| body.first + k);
            let omega = turns.map(|i| states[1].numbers[&turned.system.coordinates[i].velocity]);
            let spin = turns.map(|i| accelerations[1][i]);
            let rate = half_product(q, omega);
            let (linear, carried) = (half_product(q, spin), half_product(rate, omega));
            for k in 0..4 {
                let c = &plain.system.coordinates[first + k];
                states[0].numbers.insert(c.position, q[k]);
                states[0].numbers.insert(c.velocity, rate[k]);
                accelerations[0][first + k] = linear[k] + carried[k];
            }
            let [w, x, y, z] = q;
            let axes = [
                [
                    w * w + x * x - y * y - z * z,
                    2.0 * (x * y + w * z),
                    2.0 * (x * z - w * y),
                ],
                [
                    2.0 * (x * y - w * z),
                    w * w - x * x + y * y - z * z,
                    2.0 * (y * z + w * x),
                ],
                [
                    2.0 * (x * z + w * y),
                    2.0 * (y * z - w * x),
                    w * w - x * x - y * y + z * z,
                ],
            ];
            for (symbols, numbers) in body.axes.iter().zip(axes) {
                for (&symbol, number) in symbols.iter().zip(numbers) {
                    states[1].numbers.insert(symbol, number);
                }
            }
            bodies.push((body, first, q));
        }
        let [fours, threes] = [
            balance(&plain, &states[0], &accelerations[0]),
            balance(&turned, &states[1], &accelerations[1]),
        ];
        // A list over the coordinates of quaternions as one over those of turns.
        let projected = |list: &[f64]| -> Vec<f64> {
            let coordinates = turned.system.coordinates.iter();
            let named = |name: &str| {
                plain
                    .system
                    .coordinates
                    .iter()
                    .position(|c| c.name.text == name)
            };
            let mut out: Vec<f64> = coordinates
                .map(|c| named(&c.name.text).map_or(0.0, |i| list[i]))
                .collect();
            for &(body, first, q) in &bodies {
                for k in 0..3 {
                    let mut axis = [0.0; 3];
                    axis[k] = 1.0;
                    let turn = half_product(q, axis)
                        .into_iter()
                        .zip(&list[first..first + 4]);
                    out[body.first + k] = turn.map(|(a, b)| a * b).sum();
                }
            }
            out
        };
        let close = |a: f64, b: f64, what: &str| {
            assert!(
                (a - b).abs() < 1e-9 * (1.0 + a.abs()),
                "{name}, {what}: {a} {b}"
            );
        };
        for (i, (a, b)) in projected(&fours.coordinates)
            .into_iter()
            .zip(&threes.coordinates)
            .enumerate()
        {
            close(a, *b, &turned.system.coordinates[i].name.text);
        }
        for (row, ([velocity, acceleration], jacobian)) in &threes.rows {
            let (levels, other) = &fours.rows[row];
            close(levels[0], *velocity, &format!("{row}, velocity"));
            close(levels[1], *acceleration, &format!("{row}, acceleration"));
            for (a, b) in projected(other).into_iter().zip(jacobian) {
                close(a, *b, &format!("{row}, jacobian"));
            }
        }
        for (a, b) in fours.energies.into_iter().zip(threes.energies) {
            close(a, b, "energy");
        }
    }
    assert!(seen >= 4, "{seen} scenes have bodies in space");
}

/// A point up an axis adds to the moments of inertia, as the theorem of parallel axes says, and to nothing else.
#[test]
fn axes_are_at_right_angles() {
    let tokens = quote! {
        #[lagrange(
            attitude(top: q),
            define(c = arm * top.axes[2]),
            kinetic = m/2 * dot(der(c), der(c)) + I/2 * dot(top.body_rate, top.body_rate),
            potential = m * g * c[2],
        )]
        struct Top { m: f64, g: f64, arm: f64, I: f64 }
    };
    let d = derivation(tokens);
    let statements = d.motion.iter().map(|e| &e.statement);
    let statements = statements.chain(d.conserved.iter().map(|c| &c.quantity));
    let told: Vec<String> = [&d.kinetic]
        .into_iter()
        .chain(statements)
        .map(print::text::statement)
        .collect();
    let expected = [
        "T = ½ (m arm² + I) ω₀² + ½ (m arm² + I) ω₁² + ½ I ω₂²",
        "(m arm² + I) ω̇₀ = m arm (arm ω₁ ω₂ + g e₁₂)",
        "(m arm² + I) ω̇₁ = −m arm (arm ω₀ ω₂ + g e₀₂)",
        "I ω̇₂ = 0",
        "E = T + V",
    ];
    assert_eq!(told, expected);
}

/// Euler's equations, as they stand in every textbook.
#[test]
fn a_free_body_obeys_euler() {
    let (_, tokens) = scenes()
        .into_iter()
        .find(|(name, _)| name == "TumblingBody")
        .expect("it");
    let d = derivation(tokens);
    let motion: Vec<String> = d
        .motion
        .iter()
        .map(|e| print::text::statement(&e.statement))
        .collect();
    let expected = [
        "I₀ ω̇₀ = (I₁ − I₂) ω₁ ω₂",
        "I₁ ω̇₁ = −(I₀ − I₂) ω₀ ω₂",
        "I₂ ω̇₂ = (I₀ − I₁) ω₀ ω₁",
    ];
    assert_eq!(motion, expected);
    assert_eq!(
        print::text::formula(&d.kinetic.right),
        "½ I₀ ω₀² + ½ I₁ ω₁² + ½ I₂ ω₂²"
    );
    assert_eq!(
        print::text::statement(&d.bodies[0].definitions[0]),
        "ω₀ = 2 (q₀ q̇₁ − q₁ q̇₀ − q₂ q̇₃ + q₃ q̇₂)"
    );
    assert_eq!(print::text::formula(&d.potential.right), "0");
}
