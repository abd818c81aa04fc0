//! Checks: what the user derived by hand, proven or refuted on the states of the modes that it speaks of.
//!
//! ```text
//! modes      every mode that the conditions leave open                                    crate::modes
//! surface    its positions, solved exactly for some symbols                               surface
//! proof      left − right at random points of finite fields, forces from linear equations  exact, motion
//! refutation a real state at which both sides differ by more than rounding               sample, bounded
//! ```
//!
//! A claim that vanishes at the points of all modes is proven (but for a probability below 2^-120); one that differs is
//! refuted by a state. What is neither — functions whose values may depend on each other, equations that are not
//! solved — has been tested numerically, and is said to. What could not be tested either is a mistake: nothing is known of it.

mod arithmetic;
mod bounded;
mod case;
mod decided;
mod degree;
mod exact;
mod forces;
mod linear;
mod mechanics;
mod motion;
mod refute;
mod ruling;
mod sample;
mod stuck;
mod surface;
#[cfg(test)]
mod tests;

use crate::ast::Declaration;
use crate::derive::Equations;
use crate::diagnostics::{Code, Diagnostics};
use crate::model::{self, Branch, Check, Normal, Scope, System};
use crate::modes::{self, Mode};
use crate::symbolic::{ExprId, Pool};
use mechanics::Mechanics;
use ruling::{Prepared, Ruling};

/// More modes than these are not looked through.
const MOST_MODES: u128 = 256;

/// What is known of a check.
#[derive(Clone, PartialEq, Debug)]
pub struct Verdict {
    /// Name, or empty.
    pub name: String,
    /// What is claimed, and when.
    pub claim: String,
    /// How far that is known.
    pub outcome: Outcome,
}

/// How far a check is known to hold.
#[derive(Clone, PartialEq, Debug)]
pub enum Outcome {
    /// Proven in this many modes.
    Proven {
        /// Number of modes.
        modes: usize,
    },
    /// Neither proven nor refuted: no difference at this many random states.
    Tested {
        /// Number of states.
        states: usize,
        /// Why it could not be proven.
        because: String,
    },
}

/// Reads and judges the checks of a declaration whose equations have been derived; what is false goes to the sink.
pub fn verdicts(
    declaration: &Declaration,
    equations: Equations,
    scope: Scope,
    sink: &mut Diagnostics,
) -> (Equations, Vec<Verdict>) {
    let mut equations = equations;
    let (system, checks, branches) = model::checks(declaration, equations.system, scope, sink);
    equations.system = system;
    if checks.is_empty() {
        return (equations, Vec::new());
    }
    // Checks need the pool for themselves; it is put back with more in it.
    let mut pool = std::mem::take(&mut equations.system.pool);
    let mut prover = Prover {
        system: &equations.system,
        guards: branches.iter().map(|branch| branch.guard).collect(),
        branches,
        mechanics: Mechanics::of(&equations, &mut pool),
        pool: &mut pool,
        prepared: Vec::new(),
    };
    let mut verdicts = Vec::new();
    for check in &checks {
        verdicts.extend(prover.judge(check, sink));
    }
    equations.system.pool = pool;
    (equations, verdicts)
}

struct Prover<'a> {
    /// The system, without its pool.
    system: &'a System,
    pool: &'a mut Pool,
    mechanics: Mechanics<'a>,
    branches: Vec<Branch>,
    guards: Vec<ExprId>,
    /// Modes that have been looked at.
    prepared: Vec<Prepared<'a>>,
}

impl Prover<'_> {
    /// A friction that slips in one of these modes, pressed by constraints together: its equations are not linear.
    fn slips_on_resultant(&self, modes: &[Mode]) -> Option<usize> {
        let frictions = self.system.frictions.iter().enumerate();
        let pressed = frictions.filter(|(_, f)| matches!(f.normal, Normal::Resultant(_)));
        let slips = |f: usize| modes.iter().any(|mode| mode.frictions[f].slips());
        pressed.map(|(f, _)| f).find(|&f| slips(f))
    }

    fn judge(&mut self, check: &Check, sink: &mut Diagnostics) -> Option<Verdict> {
        let modes = modes::all(self.system).under(&check.conditions);
        let count = modes.count();
        if count > MOST_MODES {
            sink.report(Code::CheckModes, check.extent, &[&count]);
            return None;
        }
        let signed = |mode: Mode| mode.with_normal_signs(self.system);
        let mut modes: Vec<Mode> = modes.iter().flat_map(signed).collect();
        modes.retain(|mode| !self.contradicts(check, mode));
        if let Some(friction) = self.slips_on_resultant(&modes) {
            let name = &self.system.frictions[friction].name.text;
            sink.report(Code::CheckSlips, check.extent, &[name]);
            return None;
        }
        let claim = self.pool.sub(check.left, check.right);
        let claim = self.pool.substitute(claim, &self.mechanics.applied);
        let (mut proven, mut tested) = (0, None);
        for mode in &modes {
            match self.rule(check, claim, mode) {
                Ruling::Proven => proven += 1,
                Ruling::Impossible => {}
                Ruling::Tested(states, because) => {
                    let (sum, _) = tested.unwrap_or((0, String::new()));
                    tested = Some((sum + states, because));
                }
                Ruling::Refuted(state) => {
                    let state = state + &self.energy_changes(check);
                    let when = match mode.frictions.is_empty() && mode.contacts.is_empty() {
                        true => String::new(),
                        false => format!(" while {}", mode.name(self.system)),
                    };
                    sink.report(
                        Code::CheckFalse,
                        check.extent,
                        &[&check.text, &when, &state],
                    );
                    return None;
                }
            }
        }
        let outcome = match tested {
            Some((0, because)) if proven == 0 => {
                sink.report(Code::CheckUntried, check.extent, &[&check.text, &because]);
                return None;
            }
            Some((states, because)) => Outcome::Tested { states, because },
            None if proven > 0 => Outcome::Proven { modes: proven },
            None => {
                let hint = "the contacts and constraints that it closes contradict each other";
                sink.report(Code::CheckNever, check.extent, &[&hint]);
                return None;
            }
        };
        Some(Verdict {
            name: check
                .name
                .as_ref()
                .map_or_else(String::new, |name| name.text.clone()),
            claim: match check.when.is_empty() {
                true => check.text.clone(),
                false => format!("{} {}", check.text, check.when),
            },
            outcome,
        })
    }

    /// What gives energy or takes it, where a check says that it is conserved.
    fn energy_changes(&self, check: &Check) -> String {
        if check.text != "conserved energy" {
            return String::new();
        }
        let forces = self.system.forces.iter().map(|force| &force.name);
        let dissipations = self.system.dissipations.iter().map(|d| &d.name);
        let names = forces.chain(dissipations);
        let names: Vec<String> = names.map(|name| format!("`{}`", name.text)).collect();
        match names.as_slice() {
            [] => String::new(),
            [one] => format!("; {one} gives energy or takes it"),
            many => format!("; {} give energy or take it", many.join(", ")),
        }
    }
}
