//! Equality constraints: position level without velocities, else velocity level and linear in them.

use super::elaborate::Elaboration;
use super::names::Kind;
use super::reach::{Context, Depth, Reach};
use super::{Constraint, Level};
use crate::ast;
use crate::diagnostics::{Code, Extent};

const CONSTRAINT: Context = Context::new(Reach::Motion, "a constraint");

impl Elaboration<'_> {
    pub fn constraint(&mut self, declared: &ast::Constraint) {
        let at = Extent::new(declared.left.extent, declared.right.extent);
        self.each(&declared.head, |this, name| {
            let contact = declared.while_contact.as_ref().map(|(_, contact)| contact);
            let while_contact = contact.map(|contact| this.item(contact, &[Kind::Contact]));
            let (left, right) = (this.scalar(&declared.left, CONSTRAINT), this.scalar(&declared.right, CONSTRAINT));
            let residual = this.system.pool.sub(left?, right?);
            let level = match this.depth(&[residual]) {
                Depth::Parameter => {
                    let hint = "write an equation between coordinates or velocities";
                    this.sink.report(Code::ConstrainsNothing, at, &[&"constraint", &"coordinate", &hint]);
                    return None;
                }
                Depth::Position => Level::Position,
                _ => Level::Velocity,
            };
            match (level, &declared.while_contact) {
                (Level::Position, Some((word, contact))) => {
                    this.sink.report(Code::WhilePosition, *word, &[&contact.name.text]);
                    return None;
                }
                (Level::Position, None) => {}
                (Level::Velocity, _) => {
                    let hint = "velocity constraints are a·v + b = 0; an energy or speed cannot be constrained";
                    this.linear(residual, "constraint", hint, at)?;
                }
            }
            let while_contact = match while_contact {
                None => None,
                Some(found) => Some(found?.1),
            };
            let force = this.symbol(&name.text, Depth::Force);
            this.system.constraints.push(Constraint {
                name,
                level,
                residual,
                while_contact,
                force,
            });
            Some(this.system.constraints.len() - 1)
        });
    }

    /// Reports an expression that is not linear in the velocities.
    pub fn linear(
        &mut self,
        e: crate::symbolic::ExprId,
        what: &str,
        hint: &str,
        at: Extent,
    ) -> Option<()> {
        let velocities = self.velocities();
        let Some(velocity) = self.nonlinear_in(e, &velocities) else {
            return Some(());
        };
        let velocity = self.system.pool.name(velocity).to_string();
        self.sink
            .report(Code::NotLinear, at, &[&what, &velocity, &hint]);
        None
    }
}
