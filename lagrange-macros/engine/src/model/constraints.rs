//! Equality constraints: position level without velocities, else velocity level and linear in them.

use super::depth::{Context, Depth, Reach};
use super::elaboration::Elaboration;
use super::meaning::Kind;
use super::value::Value;
use super::{Constraint, Level};
use crate::ast;
use crate::diagnostics::{Code, Extent};
use crate::symbolic::ExprId;

const CONSTRAINT: Context = Context::new(Reach::Motion, "a constraint");

impl Elaboration<'_> {
    pub fn constraint(&mut self, declared: &ast::Constraint) {
        let at = Extent::new(declared.left.extent, declared.right.extent);
        self.each(&declared.head, |this, name| {
            let contact = declared.while_contact.as_ref().map(|(_, contact)| contact);
            let while_contact = contact.map(|contact| this.item(contact, &[Kind::Contact]));
            let residual = this.equation(declared)?;
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
                attitude: None,
                force,
            });
            Some(this.system.constraints.len() - 1)
        });
    }

    /// left − right; an equation between lists is one for each of their elements.
    fn equation(&mut self, declared: &ast::Constraint) -> Option<ExprId> {
        let (left, right) = (&declared.left, &declared.right);
        let values = (self.value(left, CONSTRAINT), self.value(right, CONSTRAINT));
        let (a, b) = (values.0?, values.1?);
        if let (Value::List(a), Value::List(b), None) = (&a, &b, &declared.head.index)
            && a.len() == b.len()
        {
            let hint = format!(
                "write an equation for each element, `{name}[k in 0..{count}]: {left}[k] == {right}[k]`",
                name = declared.head.name.text,
                count = a.len(),
                left = left.as_base(),
                right = right.as_base(),
            );
            let at = Extent::new(left.extent, right.extent);
            self.sink
                .report(Code::ListForScalar, at, &[&a.len(), &hint]);
            return None;
        }
        let (a, b) = (self.single(a, left.extent), self.single(b, right.extent));
        Some(self.system.pool.sub(a?, b?))
    }

    /// Reports an expression that is not linear in the velocities.
    pub fn linear(&mut self, e: ExprId, what: &str, hint: &str, at: Extent) -> Option<()> {
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
