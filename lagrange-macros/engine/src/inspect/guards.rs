//! What must hold in a mode, and what happens where it ceases to.

use super::Guard;
use super::excerpt::excerpt;
use super::formula::{Formula, Relation, Statement};
use super::friction::norm;
use super::motion::Known;
use super::work::Work;
use crate::modes::{FrictionState, Mode};

impl Work<'_> {
    /// Guards of contacts, then of frictions.
    pub(super) fn guards(&mut self, mode: &Mode, known: &Known) -> Vec<Guard> {
        let mut guards = Vec::new();
        for contact in excerpt(mode.contacts.len()) {
            guards.extend(self.contact_guards(contact, mode.contacts[contact], known));
        }
        for (friction, state) in mode.frictions.iter().enumerate() {
            guards.extend(self.friction_guard(friction, *state, known));
        }
        guards
    }

    /// A closed contact ends where it does not press, and at the edge of its region; an open one is hit within its region.
    fn contact_guards(&mut self, contact: usize, closed: bool, known: &Known) -> Vec<Guard> {
        let item = &self.equations.system.contacts[contact];
        let name = &item.name.text;
        let region = self.region(contact, known);
        if !closed {
            let gap = self.pool().substitute(item.gap, known);
            return vec![Guard {
                meaning: format!("{name} is open"),
                statement: at_least_zero(self.reader.formula(gap)),
                region,
                otherwise: format!("impact at {name}"),
            }];
        }
        let force = Formula::Letter(self.names.letter(item.force));
        let presses = (format!("{name} presses"), at_least_zero(force));
        let within = region.map(|region| (format!("{name} is in its region"), region));
        let guard = |(meaning, statement)| Guard {
            meaning,
            statement,
            region: None,
            otherwise: format!("{name} lost"),
        };
        [presses].into_iter().chain(within).map(guard).collect()
    }

    /// The region of a contact, as what is not negative there.
    pub(super) fn region(&mut self, contact: usize, known: &Known) -> Option<Statement> {
        let region = self.equations.system.contacts[contact].region?;
        let region = self.pool().substitute(region, known);
        Some(at_least_zero(self.reader.formula(region)))
    }

    fn friction_guard(
        &mut self,
        friction: usize,
        state: FrictionState,
        known: &Known,
    ) -> Option<Guard> {
        let item = &self.equations.system.frictions[friction];
        let name = &item.name.text;
        let (meaning, statement, otherwise) = match state {
            FrictionState::Inactive => return None,
            FrictionState::Stick => {
                let force = norm(&self.forces(friction));
                let most = self.strength(friction, item.static_coefficient);
                (
                    format!("static friction of {name} suffices"),
                    Statement::new(force, Relation::AtMost, most),
                    format!("{name} slips"),
                )
            }
            FrictionState::Slip(_) => {
                let zero = Formula::ZERO;
                let (statement, otherwise) = match state.is_forward() {
                    Some(forward) => {
                        let row = self.system().slip_rows(friction).start;
                        let slip = self.rate(row, known);
                        let side = if forward {
                            Relation::Above
                        } else {
                            Relation::Below
                        };
                        (Statement::new(slip, side, zero), "slips the other way")
                    }
                    None => {
                        let speed = norm(&self.slip(friction, known));
                        (Statement::new(speed, Relation::Above, zero), "slips on")
                    }
                };
                (
                    format!("{name} {}", state.verb()),
                    statement,
                    format!("{name} sticks, or {otherwise}"),
                )
            }
        };
        Some(Guard {
            meaning,
            statement,
            region: None,
            otherwise,
        })
    }
}

fn at_least_zero(formula: Formula) -> Statement {
    Statement::new(formula, Relation::AtLeast, Formula::ZERO)
}
