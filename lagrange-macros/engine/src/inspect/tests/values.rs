//! Formulas say what expressions are worth, in every scene.

use super::super::excerpt::excerpt;
use super::{planned, scenes};
use crate::inspect::costs::Counts;
use crate::inspect::formula::{Formula, Statement};
use crate::inspect::names::Names;
use crate::inspect::print;
use crate::inspect::readable::Reader;
use crate::inspect::work::Work;
use crate::plan::Program;
use crate::symbolic::{ExprId, Pool, Symbol};
use proc_macro2::TokenStream;
use std::collections::BTreeMap;

/// A scene at a point: a number for each symbol, the same for each letter.
struct Scene {
    program: Program,
    names: Names,
    guards: Vec<ExprId>,
    by_symbol: BTreeMap<Symbol, f64>,
    by_letter: BTreeMap<String, f64>,
}

impl Scene {
    /// The scene, and the pool of its expressions.
    fn new(tokens: TokenStream) -> (Scene, Pool) {
        let (declaration, mut program) = planned(tokens);
        let pool = std::mem::take(&mut program.equations.system.pool);
        let names = Names::of(&declaration, &program.equations.system);
        let branches = &program.equations.system.branches;
        let guards = branches.iter().map(|branch| branch.guard).collect();
        let mut scene = Scene {
            program,
            names,
            guards,
            by_symbol: BTreeMap::new(),
            by_letter: BTreeMap::new(),
        };
        for (i, symbol) in scene.symbols().into_iter().enumerate() {
            let value = 0.3 + (0.618 * (i + 1) as f64).fract();
            scene.by_symbol.insert(symbol, value);
            let letter = print::text::formula(&Formula::Letter(scene.names.letter(symbol)));
            let before = scene.by_letter.insert(letter.clone(), value);
            assert_eq!(before, None, "{letter} stands for two things");
        }
        (scene, pool)
    }

    fn symbols(&self) -> Vec<Symbol> {
        let system = &self.program.equations.system;
        let mut symbols = vec![system.time];
        symbols.extend(system.parameters.iter().map(|p| p.symbol));
        for c in &system.coordinates {
            symbols.extend([c.position, c.velocity, c.acceleration]);
        }
        symbols.extend(system.constraints.iter().map(|c| c.force));
        symbols.extend(system.contacts.iter().map(|c| c.force));
        let slips = system.frictions.iter().flat_map(|f| &f.slip);
        symbols.extend(slips.map(|&(_, force)| force));
        symbols.extend(system.forces.iter().map(|f| f.force));
        symbols
    }

    fn reader<'a>(&'a self, pool: &'a mut Pool) -> Reader<'a> {
        Reader::new(pool, &self.names, self.guards.clone())
    }

    /// The value of an expression.
    fn value(&self, pool: &Pool, e: ExprId) -> f64 {
        let at = |symbol| self.by_symbol[&symbol];
        let number = |e, then: &dyn Fn(usize) -> bool| pool.evaluate(&[e], &at, then)[0];
        number(e, &|branch| number(self.guards[branch], &|_| true) >= 0.0)
    }

    /// What a formula is worth, where nothing is left out.
    fn worth(&self, f: &Formula) -> Option<f64> {
        worth(f, &self.by_letter)
    }
}

/// What a formula is worth, where nothing is left out.
fn worth(f: &Formula, at: &BTreeMap<String, f64>) -> Option<f64> {
    let of = |a: &Formula| worth(a, at);
    Some(match f {
        Formula::Number(n) => n.to_f64(),
        Formula::Decimal(n) => n.nearest(),
        Formula::Pi => std::f64::consts::PI,
        Formula::Letter(_) => at[&print::text::formula(f)],
        Formula::Sum(terms) => {
            let mut sum = 0.0;
            for (minus, term) in terms {
                sum += if *minus { -of(term)? } else { of(term)? };
            }
            sum
        }
        Formula::Product(factors) => {
            let mut product = 1.0;
            for factor in factors {
                product *= of(factor)?;
            }
            product
        }
        Formula::Negative(a) => -of(a)?,
        Formula::Fraction(a, b) => of(a)? / of(b)?,
        Formula::Power(a, b) => of(a)?.powf(of(b)?),
        Formula::Root(a) => of(a)?.sqrt(),
        Formula::Absolute(a) => of(a)?.abs(),
        Formula::Call(name, arguments) => {
            let x = of(&arguments[0])?;
            let y = || of(&arguments[1]);
            match name.as_str() {
                "sin" => x.sin(),
                "cos" => x.cos(),
                "tan" => x.tan(),
                "tanh" => x.tanh(),
                "exp" => x.exp(),
                "sgn" => x.signum(),
                "max" => x.max(y()?),
                "min" => x.min(y()?),
                other => panic!("{other}"),
            }
        }
        Formula::Cases(condition, a, b) => match of(&condition.left)? >= 0.0 {
            true => of(a)?,
            false => of(b)?,
        },
        Formula::More(_) => return None,
        other => panic!("{other:?} is for declarations"),
    })
}

#[track_caller]
fn close(a: f64, b: f64, what: &str) {
    assert!((a - b).abs() <= 1e-9 * (1.0 + a.abs()), "{what}: {a} {b}");
}

/// Whatever form was chosen for reading, its value is that of the expression that is emitted.
#[test]
fn formulas_are_worth_what_their_expressions_are() {
    let mut compared = 0;
    for (name, tokens) in scenes() {
        let (scene, mut pool) = Scene::new(tokens);
        for output in &scene.program.equations.outputs {
            for &(_, e) in &output.terms {
                let formula = scene.reader(&mut pool).formula(e);
                if let Some(worth) = scene.worth(&formula) {
                    let what = format!("{name}, {}: {formula:?}", output.label);
                    close(scene.value(&pool, e), worth, &what);
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

/// The equations of motion are M v̇ = f + Σ aᵀλ of the outputs.
#[test]
fn equations_of_motion_balance() {
    for (name, tokens) in scenes() {
        let (scene, mut pool) = Scene::new(tokens);
        let mut work = Work {
            equations: &scene.program.equations,
            counts: &Counts {
                program: &scene.program,
            },
            names: &scene.names,
            reader: scene.reader(&mut pool),
            solves: true,
        };
        let motion = work.motion();
        let multipliers = work.system().multipliers();
        let at = |symbol| scene.by_symbol[&symbol];
        let mut value = |output| {
            let e = work.output(output);
            scene.value(work.pool(), e)
        };
        let structure = &scene.program.equations.structure;
        // Of many equations a few are shown.
        let shown = excerpt(scene.program.equations.system.coordinates.len());
        for (i, equation) in shown.into_iter().zip(&motion) {
            let mut balance = -value(structure.forcing[i]);
            for &(row, column, entry) in &structure.mass {
                let coordinates = &scene.program.equations.system.coordinates;
                if row == i {
                    balance += value(entry) * at(coordinates[column].acceleration);
                } else if column == i {
                    balance += value(entry) * at(coordinates[row].acceleration);
                }
            }
            for (row, numbers) in structure.rows.iter().enumerate() {
                for &(j, entry) in &numbers.jacobian {
                    if j == i {
                        balance -= value(entry) * at(multipliers[row]);
                    }
                }
            }
            for coupling in structure.couplings.iter().filter(|c| c.coordinate == i) {
                balance -= value(coupling.factor) * at(multipliers[coupling.row]);
            }
            let Statement { left, right, .. } = &equation.statement;
            if let (Some(left), Some(right)) = (scene.worth(left), scene.worth(right)) {
                close(left - right, balance, &format!("{name}, equation {i}"));
            }
        }
    }
}
