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
            guards.push(self.contact_guard(contact, mode.contacts[contact], known));
        }
        for (friction, state) in mode.frictions.iter().enumerate() {
            guards.extend(self.friction_guard(friction, *state, known));
        }
        guards
    }

    fn contact_guard(&mut self, contact: usize, closed: bool, known: &Known) -> Guard {
        let item = &self.equations.system.contacts[contact];
        let name = &item.name.text;
        let (meaning, value, otherwise) = match closed {
            true => {
                let force = Formula::Letter(self.names.letter(item.force));
                (format!("{name} presses"), force, format!("{name} lost"))
            }
            false => {
                let gap = self.pool().substitute(item.gap, known);
                let gap = self.reader.formula(gap);
                (format!("{name} is open"), gap, format!("impact at {name}"))
            }
        };
        Guard {
            meaning,
            statement: Statement::new(value, Relation::AtLeast, Formula::ZERO),
            otherwise,
        }
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
            otherwise,
        })
    }
}
