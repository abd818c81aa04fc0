//! The plan keeps the value of every output, whatever is held, and does not waste operations.

mod peers;

use super::*;
use crate::derive::{NeedId, Output, Structure};
use crate::interpret::{Held, Machine};
use crate::model::{Branch, Coordinate, ItemName, Parameter};
use crate::symbolic::{Function, Rational};
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;
use std::collections::BTreeSet;

/// Pseudo-random numbers (Knuth's MMIX linear congruence), seeded.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % n
    }

    fn number(&mut self) -> f64 {
        (self.below(2001) as f64 - 1000.0) / 700.0
    }
}

fn item(text: &str) -> ItemName {
    let span = Span::call_site();
    ItemName {
        text: text.to_owned(),
        ident: Some(Ident::new(text, span)),
        element: None,
        span,
    }
}

/// A system without items: parameters, coordinates and branches only.
fn bare(parameters: &[&str], coordinates: &[&str]) -> System {
    let mut pool = Pool::new();
    let time = pool.symbol("t");
    let parameters = parameters
        .iter()
        .map(|name| Parameter {
            field: Ident::new(name, Span::call_site()),
            element: None,
            name: (*name).to_owned(),
            symbol: pool.symbol(name),
            documentation: String::new(),
            unit: String::new(),
            tex: String::new(),
            letter: String::new(),
        })
        .collect();
    let coordinates = coordinates
        .iter()
        .map(|name| Coordinate {
            name: item(name),
            position: pool.symbol(name),
            velocity: pool.symbol(&format!("d{name}")),
            acceleration: pool.symbol(&format!("dd{name}")),
            unit: String::new(),
        })
        .collect();
    System {
        name: Ident::new("Bare", Span::call_site()),
        documentation: String::new(),
        scalar: None,
        core: TokenStream::new(),
        pool,
        time,
        parameters,
        coordinates,
        kinetic: Vec::new(),
        potential: Vec::new(),
        from_lagrangian: false,
        constraints: Vec::new(),
        contacts: Vec::new(),
        frictions: Vec::new(),
        forces: Vec::new(),
        dissipations: Vec::new(),
        branches: Vec::new(),
        starts: Vec::new(),
        observes: Vec::new(),
        stops: Vec::new(),
        marks: Vec::new(),
        impacts: crate::ast::Impacts::default(),
        units: crate::model::Units::default(),
        hints: Vec::new(),
    }
}

/// Equations that are just these outputs.
fn equations(system: System, outputs: Vec<Output>) -> Equations {
    let none = OutputId(0);
    let structure = Structure {
        mass: Vec::new(),
        forcing: Vec::new(),
        rows: Vec::new(),
        couplings: Vec::new(),
        kinetic: Vec::new(),
        potential: Vec::new(),
        contacts: Vec::new(),
        frictions: Vec::new(),
        forces: Vec::new(),
        dissipations: Vec::new(),
        branches: Vec::new(),
        energy: (none, none, none, none, NeedId(0)),
        momenta: (Vec::new(), NeedId(0)),
        observes: Vec::new(),
        stops: Vec::new(),
        marks: Vec::new(),
        cyclic: Vec::new(),
    };
    Equations {
        system,
        needs: Vec::new(),
        outputs,
        structure,
    }
}

/// A random expression whose value is moderate.
fn random(
    dice: &mut Dice,
    pool: &mut Pool,
    leaves: &[ExprId],
    known: &mut Vec<ExprId>,
    depth: usize,
) -> ExprId {
    if depth == 0 || dice.below(8) == 0 {
        return match dice.below(6) {
            0 => {
                let (p, q) = (dice.below(9) as i128 - 4, dice.below(4) as i128 + 1);
                pool.number(Rational::new(p, q).expect("q > 0"))
            }
            1 if !known.is_empty() => known[dice.below(known.len())],
            _ => leaves[dice.below(leaves.len())],
        };
    }
    let mut next = |pool: &mut Pool, dice: &mut Dice| random(dice, pool, leaves, known, depth - 1);
    let e = match dice.below(12) {
        0..=2 => {
            let terms: Vec<_> = (0..2 + dice.below(4)).map(|_| next(pool, dice)).collect();
            pool.sum(&terms)
        }
        3..=5 => {
            let factors: Vec<_> = (0..2 + dice.below(3)).map(|_| next(pool, dice)).collect();
            pool.product(&factors)
        }
        6 => {
            let (a, b) = (next(pool, dice), next(pool, dice));
            pool.sub(a, b)
        }
        7 => {
            let functions = [Function::Sin, Function::Cos, Function::Tanh, Function::Atan];
            let argument = next(pool, dice);
            pool.call(functions[dice.below(4)], &[argument])
        }
        // Roots, logarithms and denominators of 1 + x².
        kind => {
            let x = next(pool, dice);
            let (one, two) = (pool.integer(1), pool.integer(2));
            let square = pool.pow(x, two).expect("positive power");
            let positive = pool.add(one, square);
            match kind {
                8 => pool.call(Function::Ln, &[positive]),
                9 => {
                    let exponents = [
                        (-3, 2),
                        (-1, 1),
                        (1, 2),
                        (3, 2),
                        (-2, 1),
                        (1, 3),
                        (-1, 2),
                        (5, 2),
                    ];
                    let (p, q) = exponents[dice.below(exponents.len())];
                    let exponent = pool.number(Rational::new(p, q).expect("q > 0"));
                    pool.pow(positive, exponent).expect("1 + x² is not 0")
                }
                10 => {
                    let otherwise = next(pool, dice);
                    pool.select(dice.below(2), x, otherwise)
                }
                _ => {
                    let exponent = next(pool, dice);
                    let bounded = pool.call(Function::Sin, &[exponent]);
                    pool.pow(positive, bounded).expect("positive base")
                }
            }
        }
    };
    known.push(e);
    e
}

const NEEDS: usize = 4;

/// A system with two branches and six random outputs, some of several terms, some of parameters only.
fn random_equations(dice: &mut Dice) -> (Equations, Vec<Symbol>) {
    let mut system = bare(&["mass", "length"], &["x", "y"]);
    for text in ["first", "second"] {
        let guard = system.pool.leaf(system.time);
        system.branches.push(Branch {
            guard,
            text: text.to_owned(),
            span: Span::call_site(),
        });
    }
    let symbols: Vec<Symbol> = [system.time]
        .into_iter()
        .chain(system.parameters.iter().map(|p| p.symbol))
        .chain(
            system
                .coordinates
                .iter()
                .flat_map(|c| [c.position, c.velocity]),
        )
        .collect();
    let leaves: Vec<ExprId> = symbols
        .iter()
        .map(|symbol| system.pool.leaf(*symbol))
        .collect();
    let fixed = leaves[1..3].to_vec();
    let mut known = Vec::new();
    let mut outputs = Vec::new();
    for index in 0..6 {
        let mut terms = Vec::new();
        for _ in 0..[1, 1, 1, 2, 3, 0][dice.below(6)] {
            let of_parameters = dice.below(3) == 0;
            let (leaves, known) = if of_parameters {
                (&fixed, &mut Vec::new())
            } else {
                (&leaves, &mut known)
            };
            let e = random(dice, &mut system.pool, leaves, known, 4);
            terms.push((NeedId(dice.below(NEEDS)), e));
        }
        let stage = if dice.below(2) == 0 {
            Stage::Motion
        } else {
            Stage::Report
        };
        outputs.push(Output {
            stage,
            label: format!("output {index}"),
            terms,
        });
    }
    (equations(system, outputs), symbols)
}

/// Compares all outputs that are asked for; returns how many.
fn compare(program: &Program, values: &BTreeMap<Symbol, f64>, held: Held) -> usize {
    let system = &program.equations.system;
    let value = |symbol: Symbol| values.get(&symbol).copied().unwrap_or(f64::NAN);
    let then = |branch: usize| held.branches[0] >> branch & 1 == 1;
    let parameters: Vec<f64> = system.parameters.iter().map(|p| value(p.symbol)).collect();
    let machine = Machine::new(program, &parameters);
    let x = |stage| {
        inputs(system, stage)
            .into_iter()
            .map(value)
            .collect::<Vec<f64>>()
    };
    let constants = machine.constants(&held);
    let motion = machine.motion(&held, &x(Stage::Motion));
    let report = machine.report(&held, &x(Stage::Report));
    let mut compared = 0;
    for (output, place) in program.equations.outputs.iter().zip(&program.places) {
        let held = |need: NeedId| held.needs[0] >> need.0 & 1 == 1;
        let asked: Vec<ExprId> = output
            .terms
            .iter()
            .filter(|(need, _)| held(*need))
            .map(|(_, e)| *e)
            .collect();
        let needs: BTreeSet<NeedId> = output.terms.iter().map(|(need, _)| *need).collect();
        if asked.is_empty() && needs.len() == 1 {
            continue; // left as it is
        }
        let terms = system.pool.evaluate(&asked, &value, &then);
        let expected: f64 = terms.iter().sum();
        let size = terms.iter().fold(1.0, |size, term| size + term.abs());
        let nudged = system
            .pool
            .evaluate(&asked, &|symbol| value(symbol) * (1.0 + 1e-12), &then);
        let condition = (nudged.iter().sum::<f64>() - expected).abs() / size;
        // Huge values and the like of the sine of a large number say nothing.
        if !(size < 1e6 && condition < 1e-10) {
            continue;
        }
        let outputs = if output.stage == Stage::Motion {
            &motion
        } else {
            &report
        };
        let computed = Machine::number(*place, &constants, outputs);
        // Reordered sums of a few dozen terms of the size of the result.
        assert!(
            (computed - expected).abs() <= 1e-11 * size,
            "{}: {computed} not {expected}",
            output.label
        );
        compared += 1;
    }
    compared
}

#[test]
fn a_plan_keeps_values_for_every_set_of_needs() {
    let mut compared = 0;
    for seed in 0..200 {
        let mut dice = Dice(seed);
        let (equations, symbols) = random_equations(&mut dice);
        let values = symbols
            .into_iter()
            .map(|symbol| (symbol, dice.number()))
            .collect();
        let program = plan(equations);
        assert!(!program.equations.system.pool.overflowed(), "seed {seed}");
        for needs in (0..1 << NEEDS).filter(|needs| needs & 1 == 1) {
            for branches in 0..4 {
                compared += compare(
                    &program,
                    &values,
                    Held {
                        needs: &[needs],
                        branches: &[branches],
                    },
                );
            }
        }
    }
    assert!(compared > 20_000, "only {compared} comparisons");
}

/// Operations of the motion tape when everything is held, and of the report.
fn operations(declaration: TokenStream) -> (usize, usize) {
    let program = crate::program(declaration).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let all = vec![!0; program.equations.needs.len().div_ceil(64)];
    (
        program.operations(Stage::Motion, &all),
        program.operations(Stage::Report, &all),
    )
}

#[test]
fn operation_counts_do_not_grow() {
    // By hand: three sin_cos and the difference, one scaling in M, 1 + 2 + 2 + 2 + 2 in f.
    assert_eq!(operations(chain(2)), (14, 26));
    // The same for six: 21 sin_cos and 15 differences, 15 in M, 15 + 6 + 30 + 30 + 6 in f.
    assert_eq!(operations(chain(6)), (138, 186));
    let wheel = crate::model::tests::MASS_ON_WHEEL.parse().expect("tokens");
    assert_eq!(operations(wheel), (26, 34));
    let top = quote! {
        #[lagrange(
            coordinates(phi, theta, psi),
            kinetic = i1/2*(der(theta)^2 + der(phi)^2*sin(theta)^2) + i3/2*(der(psi) + der(phi)*cos(theta))^2,
            potential = m*g*l*cos(theta),
        )]
        struct Top { i1: f64, i3: f64, m: f64, g: f64, l: f64 }
    };
    assert_eq!(operations(top), (19, 19));
    // Three differences, their squares and two sums, root, cube, one division, three products and their negatives.
    let two_bodies = quote! {
        #[lagrange(
            coordinates(x, y, z, u, v, w),
            kinetic = m/2*(der(x)^2 + der(y)^2 + der(z)^2) + n/2*(der(u)^2 + der(v)^2 + der(w)^2),
            potential = -g*m*n/sqrt((x - u)^2 + (y - v)^2 + (z - w)^2),
        )]
        struct Two { m: f64, n: f64, g: f64 }
    };
    assert_eq!(operations(two_bodies), (17, 31));
}

/// A chain of n point masses on rods.
fn chain(n: usize) -> TokenStream {
    let text = format!(
        "#[lagrange(
            coordinates(th[{n}]),
            define(
                px[k in 0..{n}] = sum(i in 0..k+1: l[i]*sin(th[i])),
                py[k in 0..{n}] = sum(i in 0..k+1: -l[i]*cos(th[i])),
            ),
            kinetic = sum(k in 0..{n}: m[k]/2*(der(px[k])^2 + der(py[k])^2)),
            potential = sum(k in 0..{n}: m[k]*g*py[k]),
        )]
        struct Chain {{ m: [f64; {n}], l: [f64; {n}], g: f64 }}"
    );
    text.parse().expect("tokens")
}

#[test]
fn what_is_not_asked_for_does_not_run() {
    let wheel = crate::model::tests::MASS_ON_WHEEL.parse().expect("tokens");
    let program = crate::program(wheel).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert_eq!(program.operations(Stage::Report, &[1]), 0);
    let slip = program.equations.structure.rows[2].needs[3];
    let with_slip = program.operations(Stage::Motion, &[1 | 1 << slip.0]);
    assert_eq!(with_slip - program.operations(Stage::Motion, &[1]), 2);
}
