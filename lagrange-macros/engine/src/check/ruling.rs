//! What one mode says about a claim: exactly, on its solved surface; else at real states.

use super::Prover;
use super::case::Case;
use super::exact::{Finding, exact};
use super::mechanics::Mechanics;
use super::motion;
use super::refute;
use super::sample::{Newton, Positions, Region};
use super::surface::{Sheet, Surface, surface, ties};
use crate::model::{Check, Premise};
use crate::modes::Mode;
use crate::sorted::SortedSet;
use crate::symbolic::{ExprId, Pool, Symbol};

/// What one mode says.
pub(super) enum Ruling {
    Proven,
    Impossible,
    Refuted(String),
    Tested(usize, String),
}

/// A mode with its surface.
pub(super) struct Prepared<'a> {
    mode: Mode,
    zeros: Vec<ExprId>,
    surface: Surface,
    /// Everything in the free symbols of each sheet.
    mechanics: Vec<Mechanics<'a>>,
    newton: Newton,
}

impl Prover<'_> {
    /// What a mode says about a claim.
    pub(super) fn rule(&mut self, check: &Check, claim: ExprId, mode: &Mode) -> Ruling {
        let at = self.prepare(check, claim, mode);
        let decided = self.decided(check, mode);
        let pool = &mut *self.pool;
        let prepared = &self.prepared[at];
        let ties = ties(pool, &self.mechanics, &check.premises);
        let (sheets, findings): (&[Sheet], Findings) = match &prepared.surface {
            Surface::Empty => return Ruling::Impossible,
            Surface::Sheets(sheets) => {
                let mut findings = Findings::default();
                for (sheet, mechanics) in sheets.iter().zip(&prepared.mechanics) {
                    let case = Case {
                        mechanics,
                        mode,
                        ties: &substituted(pool, &ties, sheet),
                        positions: &sheet.positions,
                        claim: pool.substitute(claim, &sheet.solved),
                        decided: &decided,
                    };
                    findings.add(exact(pool, &case));
                }
                (sheets, findings)
            }
            Surface::Unsolved(reason) => (&[], Findings::unsolved(reason)),
        };
        let Some(because) = findings.because else {
            return match findings.has_states {
                true => Ruling::Proven,
                false => Ruling::Impossible,
            };
        };
        let region = Region {
            mechanics: &self.mechanics,
            mode,
            ties: &ties,
            premises: &check.premises,
            guards: &self.guards,
            time: self.system.time,
            positions: if sheets.is_empty() {
                Positions::Iterated(&prepared.newton)
            } else {
                Positions::Solved(sheets)
            },
        };
        let applied = &self.mechanics.applied;
        match refute::search(pool, &region, check, applied, findings.certain) {
            refute::Search::Counterexample(text) => Ruling::Refuted(text),
            refute::Search::Nothing(states) => Ruling::Tested(states, because),
            refute::Search::Undetermined(symbol) => {
                let name = pool.name(symbol);
                Ruling::Tested(0, format!("the mode does not determine `{name}`"))
            }
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
        let active = mode.acting_rows(self.system);
        let pool = &mut *self.pool;
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
        let conditions = zeros.iter().copied();
        let conditions = conditions.filter(|&e| !pool.depends_on_any(e, &speeds));
        let conditions: Vec<ExprId> = conditions.collect();
        let places = self.mechanics.coordinates.iter().map(|q| q[0]);
        let mut unknowns: Vec<_> = places.collect();
        unknowns.extend(bound(pool, self.system.time, &conditions, &unknowns));
        let equations: Vec<ExprId> = equations.chain(conditions).collect();
        let slopes = equations.iter().map(|&e| {
            let unknowns = unknowns.iter();
            unknowns
                .map(|&unknown| pool.differentiate(e, unknown))
                .collect()
        });
        let slopes = slopes.collect();
        self.prepared.push(Prepared {
            mode: mode.clone(),
            zeros,
            surface,
            mechanics: substituted,
            newton: Newton {
                equations,
                unknowns,
                slopes,
            },
        });
        self.prepared.len() - 1
    }
}

/// What has been found on the sheets of a surface.
#[derive(Default)]
struct Findings {
    /// Why the claim is not proven.
    because: Option<String>,
    /// Whether it is certain that it does not hold.
    certain: bool,
    /// Whether there are states at all.
    has_states: bool,
}

impl Findings {
    fn unsolved(reason: &str) -> Findings {
        Findings {
            because: Some(reason.to_owned()),
            ..Findings::default()
        }
    }

    fn add(&mut self, finding: Finding) {
        match finding {
            Finding::Impossible => return,
            Finding::Zero => {}
            Finding::Different { certain } => {
                self.certain |= certain;
                let reason = "it holds functions or roots that may depend on each other";
                self.because = Some(reason.to_owned());
            }
            Finding::Open(reason) => self.because = Some(reason),
        }
        self.has_states = true;
    }
}

/// What conditions may bind beside the places: the time, and all that stands in a condition in which no place does.
fn bound(pool: &Pool, time: Symbol, conditions: &[ExprId], places: &[Symbol]) -> SortedSet<Symbol> {
    let placeless = conditions.iter().copied();
    let placeless = placeless.filter(|&e| !pool.depends_on_any(e, places));
    let bound = placeless.flat_map(|e| pool.symbols(e));
    bound
        .chain((!conditions.is_empty()).then_some(time))
        .collect()
}

/// Ties on a sheet.
fn substituted(pool: &mut Pool, ties: &[motion::Tie], sheet: &Sheet) -> Vec<motion::Tie> {
    let mut on_sheet = Vec::new();
    for tie in ties {
        let mut jacobian = Vec::new();
        for &(j, e) in &tie.jacobian {
            jacobian.push((j, pool.substitute(e, &sheet.solved)));
        }
        let whole = pool.substitute(tie.whole, &sheet.solved);
        on_sheet.push(motion::Tie { jacobian, whole });
    }
    on_sheet
}
