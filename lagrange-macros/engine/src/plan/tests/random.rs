//! Random equations.

use crate::derive::{Equations, NeedId, Output, OutputId, Stage, Structure};
use crate::model::tests::bare;
use crate::model::{Branch, System};
use crate::symbolic::{ExprId, Function, Pool, Rational, Symbol};
use proc_macro2::Span;

/// Seeded random numbers.
pub struct Dice(fastrand::Rng);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    fn below(&mut self, n: usize) -> usize {
        self.0.usize(..n)
    }

    pub fn number(&mut self) -> f64 {
        (self.below(2001) as f64 - 1000.0) / 700.0
    }
}

/// How many needs there are.
pub const NEEDS: usize = 4;

/// A system with two branches and six random outputs, some of several terms, some of parameters only.
pub fn random_equations(dice: &mut Dice) -> (Equations, Vec<Symbol>) {
    let mut system = bare(["mass", "length"], ["x", "y"]);
    for text in ["first", "second"] {
        let guard = system.pool.leaf(system.time);
        system.branches.push(Branch {
            guard,
            declared: guard,
            then: text.to_owned(),
            otherwise: String::new(),
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
        unloaded: Vec::new(),
    };
    Equations {
        system,
        needs: Vec::new(),
        outputs,
        structure,
        balance: None,
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
                let number = pool.number(Rational::new(p, q).expect("q > 0"));
                let pi = pool.pi();
                [number, pool.mul(number, pi)][dice.below(2)]
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
        8 => {
            let positive = {
                let x = next(pool, dice);
                positive(pool, x)
            };
            pool.call(Function::Ln, &[positive])
        }
        9 => {
            let positive = {
                let x = next(pool, dice);
                positive(pool, x)
            };
            let (p, q) = EXPONENTS[dice.below(EXPONENTS.len())];
            let exponent = pool.number(Rational::new(p, q).expect("q > 0"));
            pool.pow(positive, exponent).expect("1 + x² is not 0")
        }
        10 => {
            let (then, otherwise) = (next(pool, dice), next(pool, dice));
            pool.select(dice.below(2), then, otherwise)
        }
        _ => {
            let positive = {
                let x = next(pool, dice);
                positive(pool, x)
            };
            let exponent = next(pool, dice);
            let bounded = pool.call(Function::Sin, &[exponent]);
            pool.pow(positive, bounded).expect("positive base")
        }
    };
    known.push(e);
    e
}

/// 1 + x², for roots, logarithms and denominators.
fn positive(pool: &mut Pool, x: ExprId) -> ExprId {
    let (one, two) = (pool.integer(1), pool.integer(2));
    let square = pool.pow(x, two).expect("positive power");
    pool.add(one, square)
}

const EXPONENTS: [(i128, i128); 8] = [
    (-3, 2),
    (-1, 1),
    (1, 2),
    (3, 2),
    (-2, 1),
    (1, 3),
    (-1, 2),
    (5, 2),
];
