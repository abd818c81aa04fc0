//! Frictions that are stronger one way than the other, as a one-way clutch is.
//!
//! A friction that holds has one strength, whichever way it is loaded. One that would hold a against a positive slip s and b against a negative one
//! is a friction of (a + b)/2 beside a force of (b − a)/2 along s, which together are −a and b where it slips, and all between where it holds.

use super::elaboration::Elaboration;
use super::energies::arbitrary;
use crate::ast::{Expr, ExprKind, FrictionLaw};
use crate::diagnostics::Code;
use crate::symbolic::{ExprId, Symbol};

/// A strength is looked at in so many states.
const STATES: u32 = 8;

/// Values of a strength on both sides differ by more than this share of them.
const DIFFERENT: f64 = 1e-9;

impl Elaboration<'_> {
    /// Whether a strength that stands for rest too does not jump where the slip changes its direction.
    pub(super) fn as_strong_both_ways(
        &mut self,
        law: &FrictionLaw,
        strength: ExprId,
        slip: &[(ExprId, Symbol)],
    ) -> Option<()> {
        let (Some(declared), &[(s, _)]) = (alone(law), slip) else {
            return Some(());
        };
        let back = self.system.pool.neg(s);
        let guards: Vec<ExprId> = self.system.branches.iter().map(|b| b.guard).collect();
        // Whether a branch begins with a positive slip, or a negative one.
        let begins = guards.iter().map(|&guard| match guard {
            guard if guard == s => Some(true),
            guard if guard == back => Some(false),
            _ => None,
        });
        let begins: Vec<Option<bool>> = begins.collect();
        let branches = self.system.pool.branches(strength);
        if branches.into_iter().all(|b| begins[b].is_none()) {
            return Some(());
        }
        let Some(no_slip) = self.no_slip(s) else {
            return Some(());
        };
        let mut at_rest = |e| self.system.pool.substitute(e, &[no_slip]);
        let strength = at_rest(strength);
        let guards: Vec<(ExprId, Option<bool>)> =
            guards.into_iter().map(&mut at_rest).zip(begins).collect();
        let jumps = (0..STATES).any(|state| {
            let [a, b] =
                [true, false].map(|forward| self.beside(strength, &guards, forward, state));
            (a - b).abs() > DIFFERENT * (a.abs() + b.abs())
        });
        if jumps {
            self.sink.report(Code::StrongerOneWay, declared.extent, &[]);
            return None;
        }
        Some(())
    }

    /// A velocity, and what it is where nothing slips.
    fn no_slip(&mut self, slip: ExprId) -> Option<(Symbol, ExprId)> {
        let velocities = self.velocities();
        let pool = &mut self.system.pool;
        let mut velocities = velocities.into_iter();
        let v = velocities.find(|&v| pool.depends_on(slip, v))?;
        let slope = pool.differentiate(slip, v);
        let change = pool.div(slip, slope)?;
        let leaf = pool.leaf(v);
        Some((v, pool.sub(leaf, change)))
    }

    /// A value in a state where the slip is zero and about to be positive or negative, with the guards of all branches, and which of them are of that slip.
    fn beside(
        &self,
        e: ExprId,
        guards: &[(ExprId, Option<bool>)],
        forward: bool,
        state: u32,
    ) -> f64 {
        let pool = &self.system.pool;
        let value = |symbol: Symbol| arbitrary(state, symbol);
        let mut sides = vec![true; guards.len()];
        // A guard may contain others, in any order: each sweep settles one more of those that contain each other.
        for _ in guards {
            let side = |&(guard, begins): &(ExprId, Option<bool>)| match begins {
                Some(begins) => begins == forward,
                None => pool.evaluate(&[guard], &value, &|b| sides[b])[0] >= 0.0,
            };
            let settled: Vec<bool> = guards.iter().map(side).collect();
            if settled == sides {
                break;
            }
            sides = settled;
        }
        pool.evaluate(&[e], &value, &|b| sides[b])[0]
    }
}

/// The strength of a law that has no other one for rest.
fn alone(law: &FrictionLaw) -> Option<&Expr> {
    match law {
        FrictionLaw::Coefficients {
            stick, slide: None, ..
        } => Some(stick),
        FrictionLaw::Limit(limit) if !matches!(limit.kind, ExprKind::List(_)) => Some(limit),
        _ => None,
    }
}
