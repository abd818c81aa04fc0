//! Names as written → their values.

use super::depth::{Context, Reach};
use super::elaboration::Elaboration;
use super::forces::FORCES_STAND;
use super::meaning::{Kind, Meaning};
use super::value::Value;
use crate::ast::{Expr, ExprKind, Name, Reference};
use crate::diagnostics::Code;

impl Elaboration<'_> {
    /// `pi`, `t`, an index, `energy`, or a name of the namespace.
    pub(super) fn named(&mut self, name: &Name, context: Context) -> Option<Value> {
        let text = name.text.as_str();
        match text {
            "pi" => return Some(Value::Scalar(self.system.pool.pi())),
            "t" => {
                let time = self.system.time;
                return Some(Value::Scalar(self.system.pool.leaf(time)));
            }
            "energy" => return self.energy(name, context).map(Value::Scalar),
            "slip" if self.slip.is_some() => return self.slip.clone(),
            _ => {}
        }
        if let Some(&(_, index)) = self.indices.iter().rev().find(|(known, _)| known == text) {
            return Some(Value::Scalar(self.system.pool.integer(index)));
        }
        if super::names::is_reserved(text) && !self.names.contains_key(text) {
            let hint = format!("write `{text}(…)`");
            match super::names::is_function(text) {
                true => self.sink.report(
                    Code::WrongKind,
                    name,
                    &[&text, &"function", &"value", &hint],
                ),
                false => self.sink.report(Code::ReservedName, name, &[&text]),
            }
            return None;
        }
        self.meaning(name, context).map(|(value, _)| value)
    }

    /// The value of a name of the namespace, and where its indices begin.
    fn meaning(&mut self, name: &Name, context: Context) -> Option<(Value, i64)> {
        let Some(entry) = self.names.get(&name.text) else {
            self.unknown(name);
            return None;
        };
        let kind = entry.kind;
        match entry.meaning.clone() {
            Meaning::Poisoned => None,
            Meaning::Pending(definition) => {
                self.define(definition);
                self.meaning(name, context)
            }
            Meaning::Busy => {
                let hint = "its value is needed to find its value";
                self.sink.report(Code::Circular, name, &[&name.text, &hint]);
                None
            }
            Meaning::Value { .. } if kind == Kind::Output && context.reach != Reach::Outputs => {
                self.sink.report(Code::OutputOnly, name, &[&name.text]);
                None
            }
            Meaning::Value {
                value,
                lower,
                depth,
            } => {
                self.admit(depth, context, &name.text, name.into())?;
                Some((value, lower))
            }
            Meaning::Item { elements, lower } => {
                self.admit_item(name, kind, context)?;
                if elements.is_empty() {
                    // A definition is needed before the item.
                    self.sink.report(
                        Code::ForceHere,
                        name,
                        &[&name.text, &kind.text(), &FORCES_STAND],
                    );
                    return None;
                }
                let mut values: Vec<Value> = elements
                    .into_iter()
                    .map(|element| self.force_of(kind, element))
                    .collect();
                match lower {
                    Some(lower) => Some((Value::List(values), lower)),
                    None => values.pop().map(|only| (only, 0)),
                }
            }
        }
    }

    /// `base[index]`
    pub(super) fn element(&mut self, base: &Expr, index: &Expr, context: Context) -> Option<Value> {
        let is_name = |name: &Name| self.names.contains_key(&name.text);
        let (value, lower) = match &base.kind {
            ExprKind::Name(name) if is_name(name) => self.meaning(name, context)?,
            _ => (self.value(base, context)?, 0),
        };
        let Value::List(mut elements) = value else {
            let hint = match &base.kind {
                ExprKind::Call(name, _) if name.text == "cross" => {
                    "`cross` of two lists of two is one number, a₀b₁ − a₁b₀; take the index away"
                        .to_owned()
                }
                ExprKind::Name(_) => {
                    format!("`{base}` is one number; take the index away, or declare it as a list")
                }
                _ => format!("`{base}` is one number; take the index away"),
            };
            self.sink.report(Code::ScalarForList, base.extent, &[&hint]);
            return None;
        };
        let at = self.position(index, lower, elements.len())?;
        Some(elements.swap_remove(at))
    }

    /// An item's name as the target of a call: `gap(c)`, `momentum(x[2])`.
    pub fn reference(&mut self, expr: &Expr) -> Option<Reference> {
        let found = expr.as_reference();
        if found.is_none() {
            self.sink.report(
                Code::Expected,
                expr.extent,
                &[&"the name of an item", &format!("`{expr}`")],
            );
        }
        found
    }
}
