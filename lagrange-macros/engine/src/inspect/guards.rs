//! What must hold in a mode, and what happens where it ceases to.

use super::Guard;
use super::choice::{Choice, State};
use super::formula::{Formula, Relation, Statement};
use super::friction::norm;
use super::motion::Known;
use super::work::Work;

impl Work<'_> {
    /// Guards of contacts, then of frictions.
    pub(super) fn guards(&mut self, choice: &Choice, known: &Known) -> Vec<Guard> {
        let mut guards = Vec::new();
        for contact in Work::shown(choice.contacts.len()) {
            guards.push(self.contact_guard(contact, choice.contacts[contact], known));
        }
        for (friction, state) in choice.frictions.iter().enumerate() {
            guards.extend(self.friction_guard(friction, *state, known));
        }
        guards
    }

    fn contact_guard(&mut self, contact: usize, closed: bool, known: &Known) -> Guard {
        let item = &self.program.equations.system.contacts[contact];
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

    fn friction_guard(&mut self, friction: usize, state: State, known: &Known) -> Option<Guard> {
        let item = &self.program.equations.system.frictions[friction];
        let name = &item.name.text;
        let (meaning, statement, otherwise) = match state {
            State::Inactive => return None,
            State::Sticks => {
                let force = norm(&self.forces(friction));
                let most = self.strength(friction, item.static_coefficient);
                (
                    format!("static friction of {name} suffices"),
                    Statement::new(force, Relation::AtMost, most),
                    format!("{name} slips"),
                )
            }
            State::Forward | State::Backward => {
                let relation = match state {
                    State::Forward => Relation::Above,
                    _ => Relation::Below,
                };
                let slip = self.rate(self.slip_rows(friction).start, known);
                (
                    format!("{name} {}", state.verb()),
                    Statement::new(slip, relation, Formula::ZERO),
                    format!("{name} sticks, or slips the other way"),
                )
            }
            State::Slips => {
                let speed = norm(&self.slip(friction, known));
                (
                    format!("{name} slips"),
                    Statement::new(speed, Relation::Above, Formula::ZERO),
                    format!("{name} sticks, or slips on"),
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
