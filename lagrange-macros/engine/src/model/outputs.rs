//! What is reported, what ends a run, and what is logged.

use super::depth::{Context, Reach};
use super::elaborate::item_name;
use super::elaboration::Elaboration;
use super::meaning::{Kind, Meaning};
use super::value::Value;
use super::{Condition, Observe, Watch};
use crate::ast::{self, Clause, Expr, ExprKind, ModeWord, Name, Trigger};
use crate::diagnostics::Code;

const OUTPUT: Context = Context::new(Reach::Outputs, "an output");

impl Elaboration<'_> {
    pub fn observe(&mut self, declared: &[ast::Observe]) {
        for observe in declared {
            let name = match observe {
                ast::Observe::Known(name) => name,
                ast::Observe::New(head, _) => &head.name,
            };
            self.dropped |= self.output(name).is_none();
        }
    }

    /// The value of a name becomes an output, a list one for each element.
    fn output(&mut self, name: &Name) -> Option<()> {
        if self.outputs.contains(&name.text) {
            self.sink.report(Code::SameTwice, name, &[&name.text]);
            return None;
        }
        self.outputs.push(name.text.clone());
        let expr = Expr {
            kind: ExprKind::Name(name.clone()),
            extent: name.into(),
        };
        let value = self.value(&expr, OUTPUT)?;
        let lower = match self.names.get(&name.text).map(|entry| &entry.meaning) {
            Some(Meaning::Value { lower, .. }) => *lower,
            Some(Meaning::Item { lower, .. }) => lower.unwrap_or(0),
            _ => 0,
        };
        let elements = match value {
            Value::Scalar(value) => {
                let name = item_name(name, None);
                self.system.observes.push(Observe { name, value });
                return Some(());
            }
            Value::List(elements) => elements,
        };
        let count = elements.len();
        for (k, element) in elements.into_iter().enumerate() {
            let value = self.single(element, name.into())?;
            let name = item_name(name, Some((lower + k as i64, k, count)));
            self.system.observes.push(Observe { name, value });
        }
        Some(())
    }

    pub fn watch(&mut self, kind: Kind, declared: &ast::Watch) {
        self.each(&declared.head, |this, name| {
            let mut watch = Watch {
                name,
                terms: Vec::new(),
                conditions: Vec::new(),
                zeros: matches!(declared.trigger, Trigger::Zero(_)),
            };
            match &declared.trigger {
                Trigger::Zero(e) => {
                    let term = this.scalar(e, OUTPUT)?;
                    let on_argument = this.on_argument(term);
                    // A root that is never negative may still be zero.
                    let never = this.system.pool.as_number(on_argument).is_some();
                    watch.terms.push(if never { term } else { on_argument });
                }
                Trigger::All(clauses) => {
                    let read: Vec<Option<()>> = clauses
                        .iter()
                        .map(|clause| this.clause(clause, &mut watch))
                        .collect();
                    read.into_iter().collect::<Option<()>>()?;
                }
            }
            let mut terms = watch.terms.iter();
            if watch.conditions.is_empty() && !terms.any(|&term| this.moves(term)) {
                let hint = "it never changes: compare something that moves, or `t`";
                let what = kind.text();
                this.sink.report(
                    Code::ConstrainsNothing,
                    &declared.head.name,
                    &[&what, &"coordinate", &hint],
                );
                return None;
            }
            let list = match kind {
                Kind::Stop => &mut this.system.stops,
                _ => &mut this.system.marks,
            };
            list.push(watch);
            Some(list.len() - 1)
        });
    }

    fn clause(&mut self, clause: &Clause, watch: &mut Watch) -> Option<()> {
        match clause {
            Clause::Comparison(comparison) => {
                let term = self.condition(comparison, OUTPUT)?;
                watch.terms.push(term);
            }
            Clause::Mode(word, item) => {
                let kind = match word {
                    ModeWord::Closed | ModeWord::Open => Kind::Contact,
                    ModeWord::Sticks | ModeWord::Slips => Kind::Friction,
                };
                let (_, index) = self.item(item, &[kind])?;
                watch.conditions.push(match word {
                    ModeWord::Closed => Condition::Closed(index),
                    ModeWord::Open => Condition::Open(index),
                    ModeWord::Sticks => Condition::Sticks(index),
                    ModeWord::Slips => Condition::Slips(index),
                });
            }
        }
        Some(())
    }
}
