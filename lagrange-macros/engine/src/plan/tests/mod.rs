//! The plan keeps the value of every output, whatever is held, and does not waste operations.

mod counts;
mod peers;
mod pi;
mod random;

use super::*;
use crate::derive::NeedId;
use crate::interpret::{Machine, Selection};
use random::{Dice, NEEDS, random_equations};
use std::collections::{BTreeMap, BTreeSet};

/// Compares all outputs that are asked for; returns how many.
fn compare(program: &Program, values: &BTreeMap<Symbol, f64>, held: Selection) -> usize {
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
        let mut dice = Dice::new(seed);
        let (equations, symbols) = random_equations(&mut dice);
        let values = symbols
            .into_iter()
            .map(|symbol| (symbol, dice.number()))
            .collect();
        let program = plan(equations);
        assert!(
            program.equations.system.pool.outgrown().is_none(),
            "seed {seed}"
        );
        for needs in (0..1 << NEEDS).filter(|needs| needs & 1 == 1) {
            for branches in 0..4 {
                compared += compare(
                    &program,
                    &values,
                    Selection {
                        needs: &[needs],
                        branches: &[branches],
                    },
                );
            }
        }
    }
    assert!(compared > 20_000, "only {compared} comparisons");
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

/// A coin in plain numbers: a number that would be taken out of a sum outgrows what is kept exactly, and is left in it.
#[test]
fn numbers_stay_in_a_sum_where_their_quotients_outgrow_what_is_exact() {
    let coin = "#[lagrange(
        coordinates(p[3]), attitude(b: q),
        define(
            n = [b.axes[0][2], b.axes[1][2], b.axes[2][2]], s = sqrt(n[0]^2 + n[1]^2),
            arm = (-0.159*n[0]/s)*b.axes[0] + (-0.159*n[1]/s)*b.axes[1] + [0, 0, -0.0618],
            u = der(p) + cross(b.space_rate, arm)),
        kinetic = 0.1233/2*dot(der(p), der(p)) + 0.00183/2*b.body_rate[0]^2 + 0.00183/2*b.body_rate[1]^2 + 0.003181/2*b.body_rate[2]^2,
        potential = 0.1233*9.81*p[2],
        contact(f: p[2] - 0.159*s - 0.0618 >= 0),
        friction(k on f: slip = (u[0], u[1]), static = 0.0669),
        start(a: p = [0, 0, height], der(p) = [1.3194, -0.2912, -0.603], b.turn = (0.0713, -0.1045, -0.1749), b.body_rate = (7.9415, -6.5102, -19.1853)),
    )]
    struct Coin { height: f64 }";
    let program = crate::program(coin.parse().expect("tokens")).unwrap_or_else(|e| panic!("{e}"));
    let mut dice = Dice::new(7);
    let values = inputs(&program.equations.system, Stage::Report)
        .into_iter()
        .map(|symbol| (symbol, dice.number()))
        .collect();
    let held = Selection {
        needs: &[u64::MAX],
        branches: &[0],
    };
    assert!(compare(&program, &values, held) > 30);
}
