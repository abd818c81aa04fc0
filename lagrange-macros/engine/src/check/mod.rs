//! Checks: what the user derived by hand, proven or refuted on the states of the modes that it speaks of.
//!
//! ```text
//! modes      every mode that the conditions leave open                                    modes
//! surface    its positions, solved exactly for some symbols                               surface
//! proof      left − right at random points of finite fields, forces from linear equations  exact, motion
//! refutation a real state at which both sides differ by more than rounding               sample, bounded
//! ```
//!
//! A claim that vanishes at the points of all modes is proven (but for a probability below 2^-120); one that differs is
//! refuted by a state. What is neither — functions whose values may depend on each other, equations that are not
//! solved — has been tested numerically, and is said to.

mod arithmetic;
mod bounded;
mod degree;
mod exact;
mod linear;
mod mechanics;
mod modes;
mod motion;
mod refute;
mod sample;
mod surface;
#[cfg(test)]
mod tests;

use crate::ast::Declaration;
use crate::derive::Equations;
use crate::diagnostics::{Code, Diagnostics};
use crate::model::{self, Branch, Check, Normal, Premise, Scope};
use crate::symbolic::{ExprId, Pool, Rational};
use exact::{Case, Finding, exact};
use mechanics::Mechanics;
use modes::{Grip, Mode, modes};
use sample::{Newton, Positions, Region};
use surface::{Sheet, Surface, surface, ties};

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
    let mechanics = Mechanics::of(&mut equations);
    let mut court = Court {
        guards: branches.iter().map(|branch| branch.guard).collect(),
        branches,
        mechanics,
        equations: &mut equations,
        prepared: Vec::new(),
    };
    let mut verdicts = Vec::new();
    for check in &checks {
        verdicts.extend(court.judge(check, sink));
    }
    (equations, verdicts)
}

struct Court<'a> {
    equations: &'a mut Equations,
    mechanics: Mechanics,
    branches: Vec<Branch>,
    guards: Vec<ExprId>,
    /// Modes that have been looked at.
    prepared: Vec<Prepared>,
}

/// A mode with its surface.
struct Prepared {
    mode: Mode,
    zeros: Vec<ExprId>,
    surface: Surface,
    /// Everything in the free symbols of each sheet.
    mechanics: Vec<Mechanics>,
    newton: Newton,
}

/// What one mode says.
enum Ruling {
    Proven,
    Impossible,
    Refuted(String),
    Tested(usize, String),
}

impl Court<'_> {
    fn pool(&mut self) -> &mut Pool {
        &mut self.equations.system.pool
    }

    fn judge(&mut self, check: &Check, sink: &mut Diagnostics) -> Option<Verdict> {
        let mut modes = match modes(&self.mechanics, &check.conditions) {
            Ok(modes) => modes,
            Err(count) => {
                sink.report(Code::CheckModes, check.extent, &[&count]);
                return None;
            }
        };
        modes.retain(|mode| !self.contradicts(check, mode));
        let applied = self.mechanics.applied.clone();
        let claim = {
            let pool = self.pool();
            let claim = pool.sub(check.left, check.right);
            pool.substitute(claim, &applied)
        };
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
                    let described = mode.describe(&self.mechanics);
                    let when = if described.is_empty() {
                        described
                    } else {
                        format!(" while {described}")
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

    /// What a mode says about a claim.
    fn rule(&mut self, check: &Check, claim: ExprId, mode: &Mode) -> Ruling {
        let at = self.prepare(check, claim, mode);
        let decided = self.decided(check, mode);
        let pool = &mut self.equations.system.pool;
        let prepared = &self.prepared[at];
        let ties = ties(pool, &self.mechanics, &check.premises);
        let (mut because, mut certain, mut impossible) = (None, false, true);
        let sheets: &[Sheet] = match &prepared.surface {
            Surface::Empty => return Ruling::Impossible,
            Surface::Sheets(sheets) => sheets,
            Surface::Unsolved(reason) => {
                because = Some(reason.clone());
                &[]
            }
        };
        for (sheet, mechanics) in sheets.iter().zip(&prepared.mechanics) {
            let here = pool.substitute(claim, &sheet.solved);
            let ties: Vec<motion::Tie> = ties
                .iter()
                .map(|tie| motion::Tie {
                    jacobian: tie
                        .jacobian
                        .iter()
                        .map(|&(j, e)| (j, pool.substitute(e, &sheet.solved)))
                        .collect(),
                    whole: pool.substitute(tie.whole, &sheet.solved),
                })
                .collect();
            let case = Case {
                mechanics,
                mode,
                ties: &ties,
                positions: &sheet.positions,
                claim: here,
                decided: &decided,
            };
            match exact(pool, &case) {
                Finding::Zero => impossible = false,
                Finding::Impossible => {}
                Finding::Different { certain: sure } => {
                    impossible = false;
                    certain |= sure;
                    because =
                        Some("it holds functions or roots that may depend on each other".into());
                }
                Finding::Open(reason) => {
                    impossible = false;
                    because = Some(reason);
                }
            }
        }
        let Some(because) = because else {
            return if impossible {
                Ruling::Impossible
            } else {
                Ruling::Proven
            };
        };
        let region = Region {
            mechanics: &self.mechanics,
            mode,
            ties: &ties,
            premises: &check.premises,
            guards: &self.guards,
            time: self.equations.system.time,
            positions: if sheets.is_empty() {
                Positions::Iterated(&prepared.newton)
            } else {
                Positions::Solved(sheets)
            },
        };
        let search = refute::search(pool, &region, check, &self.mechanics.applied, certain);
        match search {
            refute::Search::Counterexample(text) => Ruling::Refuted(text),
            refute::Search::Nothing(states) => Ruling::Tested(states, because),
        }
    }

    /// The mode with its surface solved, as it has been or now is.
    fn prepare(&mut self, check: &Check, claim: ExprId, mode: &Mode) -> usize {
        let zeros = check.premises.iter().filter_map(|premise| match premise {
            Premise::Zero(e) => Some(*e),
            Premise::AtLeast(_) => None,
        });
        let zeros: Vec<ExprId> = zeros.collect();
        let same = |known: &Prepared| known.mode == *mode && known.zeros == zeros;
        if let Some(at) = self.prepared.iter().position(same) {
            return at;
        }
        let active = mode.active(&self.mechanics);
        let pool = &mut self.equations.system.pool;
        let surface = surface(pool, &self.mechanics, &active, &check.premises, &[claim]);
        let mut substituted = Vec::new();
        if let Surface::Sheets(sheets) = &surface {
            for sheet in sheets {
                let free = self
                    .mechanics
                    .map(&mut |e| pool.substitute(e, &sheet.solved));
                substituted.push(free);
            }
        }
        let rows = active.iter();
        let equations = rows.filter_map(|&row| self.mechanics.rows[row].position);
        let speeds: Vec<_> = self.mechanics.coordinates.iter().map(|q| q[1]).collect();
        let still = zeros.iter().filter(|&&e| !pool.depends_on_any(e, &speeds));
        let equations: Vec<ExprId> = equations.chain(still.copied()).collect();
        let slopes = equations.iter().map(|&e| {
            let places = self.mechanics.coordinates.iter();
            places.map(|q| pool.differentiate(e, q[0])).collect()
        });
        let slopes = slopes.collect();
        self.prepared.push(Prepared {
            mode: mode.clone(),
            zeros,
            surface,
            mechanics: substituted,
            newton: Newton { equations, slopes },
        });
        self.prepared.len() - 1
    }

    /// Whether the conditions on the state exclude the direction of a slip.
    fn contradicts(&mut self, check: &Check, mode: &Mode) -> bool {
        let system = &mut self.equations.system;
        let mut slips = system.frictions.iter().zip(&mode.grips);
        let at_least = check.premises.iter().filter_map(|premise| match premise {
            Premise::AtLeast(e) => Some(*e),
            Premise::Zero(_) => None,
        });
        let at_least: Vec<ExprId> = at_least.collect();
        slips.any(|(friction, grip)| match (grip, &friction.slip[..]) {
            (Grip::Slips { forward }, &[(slip, _)]) => at_least.iter().any(|&e| {
                let ratio = ratio(&mut system.pool, e, slip);
                ratio.is_some_and(|ratio| ratio.is_negative() == *forward)
            }),
            _ => false,
        })
    }

    /// Branches on what the mode or the conditions say: a closed contact pushes, an open gap is positive, a slip has its
    /// direction.
    fn decided(&mut self, check: &Check, mode: &Mode) -> Vec<(usize, bool)> {
        let system = &mut self.equations.system;
        let mut positive = Vec::new();
        for (contact, &closed) in system.contacts.iter().zip(&mode.closed) {
            positive.push(if closed {
                system.pool.leaf(contact.force)
            } else {
                contact.gap
            });
        }
        for (friction, grip) in system.frictions.iter().zip(&mode.grips) {
            if let (Grip::Slips { forward }, [(slip, _)]) = (grip, &friction.slip[..]) {
                positive.push(if *forward {
                    *slip
                } else {
                    system.pool.neg(*slip)
                });
            }
        }
        // Friction acts against the slip, and the mode says which way the constraint pushes that carries it.
        for (friction, grip) in system.frictions.iter().zip(&mode.grips) {
            let (Grip::Slips { forward }, [(_, force)]) = (grip, &friction.slip[..]) else {
                continue;
            };
            let mut signed = vec![(*force, !forward)];
            if let Normal::Constraint(i) = friction.normal {
                signed.push((system.constraints[i].force, mode.positive[i]));
            }
            for (force, is_positive) in signed {
                let force = system.pool.leaf(force);
                positive.push(if is_positive {
                    force
                } else {
                    system.pool.neg(force)
                });
            }
        }
        for premise in &check.premises {
            if let Premise::AtLeast(e) = *premise {
                positive.push(e);
            }
        }
        let mut decided = Vec::new();
        for (i, branch) in self.branches.iter().enumerate() {
            let mut known = positive.iter();
            let ratio = known.find_map(|&known| ratio(&mut system.pool, branch.guard, known));
            decided.extend(ratio.map(|ratio| (i, !ratio.is_negative())));
        }
        decided
    }
}

/// a/b, if that is a number.
fn ratio(pool: &mut Pool, a: ExprId, b: ExprId) -> Option<Rational> {
    let ratio = pool.div(a, b)?;
    let ratio = pool.simplify(ratio);
    pool.as_number(ratio).filter(|ratio| !ratio.is_zero())
}
