//! Checks: what the user derived by hand, as `left = right` under conditions on mode and state.
//!
//! They are read when everything has been derived, so that they cannot change what is derived.

use super::depth::{Context, Depth, Reach};
use super::elaboration::{Elaboration, Scope};
use super::meaning::{Kind, Meaning};
use super::{Branch, Condition, ItemName, System};
use crate::ast::{self, Claim, Declaration, ItemKind, ModeWord, Reference};
use crate::diagnostics::{Code, Diagnostics, Extent};
use crate::symbolic::ExprId;

const OUTPUT: Context = Context::new(Reach::Outputs, "a check");

/// A check with all names resolved.
pub struct Check {
    /// Name, if it has one.
    pub name: Option<ItemName>,
    /// `shell == m*g*cos(theta)`, as the user wrote it.
    pub text: String,
    /// `when closed(shell)`, as the user wrote it, or empty.
    pub when: String,
    /// Where.
    pub extent: Extent,
    /// Whether it says that a quantity is conserved; the left side is then its rate, the right side 0.
    pub is_conserved: bool,
    /// Left side.
    pub left: ExprId,
    /// Right side.
    pub right: ExprId,
    /// Conditions on the mode.
    pub conditions: Vec<Condition>,
    /// Conditions on the state.
    pub premises: Vec<Premise>,
}

/// A condition on the state, in positions and velocities.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Premise {
    /// e ≥ 0
    AtLeast(ExprId),
    /// e = 0
    Zero(ExprId),
}

/// The checks of a declaration whose system has been derived; mistakes go to the sink. Also the branches of
/// `abs`, `min`, `if` and the like: those of the system, then those of the checks.
pub fn checks(
    declaration: &Declaration,
    system: System,
    scope: Scope,
    sink: &mut Diagnostics,
) -> (System, Vec<Check>, Vec<Branch>) {
    let known = system.branches.len();
    let mut elaboration = Elaboration::reopen(system, scope, sink);
    let mut checks = Vec::new();
    for item in &declaration.items {
        if let ItemKind::Check(check) = &item.kind {
            elaboration.check(check, &mut checks);
        }
    }
    let (mut system, _) = elaboration.close();
    // What only checks branch on is no part of the system.
    let branches = system.branches.clone();
    system.branches.truncate(known);
    (system, checks, branches)
}

impl Elaboration<'_> {
    fn check(&mut self, declared: &ast::Check, checks: &mut Vec<Check>) {
        match &declared.head {
            None => {
                if let Some(check) = self.check_of(declared, None) {
                    checks.push(check);
                }
            }
            Some(head) => self.each(head, |this, name| {
                checks.push(this.check_of(declared, Some(name))?);
                Some(checks.len() - 1)
            }),
        }
    }

    fn check_of(&mut self, declared: &ast::Check, name: Option<ItemName>) -> Option<Check> {
        let (text, left, right) = match &declared.claim {
            Claim::Equal(left, right) => {
                let text = format!("{left} == {right}");
                let (left, right) = (self.scalar(left, OUTPUT), self.scalar(right, OUTPUT));
                (text, left, right)
            }
            Claim::Conserved(quantity) => {
                let zero = self.system.pool.integer(0);
                (
                    format!("conserved {quantity}"),
                    self.rate_of(quantity),
                    Some(zero),
                )
            }
        };
        let mut check = Check {
            name,
            text,
            when: when(&declared.premises),
            extent: declared.claimed,
            is_conserved: matches!(declared.claim, Claim::Conserved(_)),
            left: left?,
            right: right?,
            conditions: Vec::new(),
            premises: Vec::new(),
        };
        let before = self.sink.count();
        let mut families = Vec::new();
        for premise in &declared.premises {
            self.premise(premise, &mut check, &mut families);
        }
        // Elements that are named decide before the rest of their family.
        let named: Vec<(bool, usize)> = check.conditions.iter().map(|&c| item_of(c)).collect();
        families.retain(|&condition| !named.contains(&item_of(condition)));
        check.conditions.extend(families);
        (self.sink.count() == before).then_some(check)
    }

    /// d/dt of a quantity of the motion.
    fn rate_of(&mut self, quantity: &ast::Expr) -> Option<ExprId> {
        let value = self.scalar(quantity, OUTPUT)?;
        if self.depth(&[value]) >= Depth::Acceleration {
            self.sink
                .report(Code::HigherDerivative, quantity.extent, &[]);
            return None;
        }
        Some(self.time_rate(value))
    }

    fn premise(
        &mut self,
        declared: &ast::Premise,
        check: &mut Check,
        families: &mut Vec<Condition>,
    ) -> Option<()> {
        match declared {
            ast::Premise::Mode(word, item) => {
                let kind = match word {
                    ModeWord::Closed | ModeWord::Open => Kind::Contact,
                    ModeWord::Sticks | ModeWord::Slips => Kind::Friction,
                };
                let elements = self.elements(item, kind)?;
                let is_family = elements.len() > 1;
                for index in elements {
                    let condition = match word {
                        ModeWord::Closed => Condition::Closed(index),
                        ModeWord::Open => Condition::Open(index),
                        ModeWord::Sticks => Condition::Sticks(index),
                        ModeWord::Slips => Condition::Slips(index),
                    };
                    if is_family {
                        families.push(condition);
                    } else {
                        check.conditions.push(condition);
                    }
                }
            }
            ast::Premise::AtLeast(comparison) => {
                let e = self.difference(comparison, OUTPUT)?;
                self.of_state(e, comparison.extent(), &comparison.left)?;
                check.premises.push(Premise::AtLeast(e));
            }
            ast::Premise::Equal(left, right) => {
                let (a, b) = (self.scalar(left, OUTPUT), self.scalar(right, OUTPUT));
                let e = self.system.pool.sub(a?, b?);
                self.of_state(e, Extent::new(left.extent, right.extent), left)?;
                check.premises.push(Premise::Zero(e));
            }
        }
        Some(())
    }

    /// Whether it contains no accelerations and forces; if it does, says so.
    fn of_state(&mut self, e: ExprId, at: Extent, text: &ast::Expr) -> Option<()> {
        if self.depth(&[e]) <= Depth::Velocity {
            return Some(());
        }
        self.sink.report(Code::CheckPremise, at, &[text]);
        None
    }

    /// The element that is named, or all elements of an indexed item that is named without index.
    fn elements(&mut self, item: &Reference, kind: Kind) -> Option<Vec<usize>> {
        if item.element.is_none()
            && let Some(entry) = self.names.get(&item.name.text)
            && entry.kind == kind
            && let Meaning::Item {
                elements,
                lower: Some(_),
            } = &entry.meaning
        {
            return Some(elements.clone());
        }
        Some(vec![self.item(item, &[kind])?.1])
    }
}

/// Conditions as written.
fn when(premises: &[ast::Premise]) -> String {
    let mut text = String::new();
    for (i, premise) in premises.iter().enumerate() {
        text += if i == 0 { "when " } else { " and " };
        text += &match premise {
            ast::Premise::Mode(word, item) => {
                let word = ModeWord::ALL.iter().find(|(_, known)| known == word);
                let word = word.map_or("", |(text, _)| text);
                match &item.element {
                    None => format!("{word}({})", item.name.text),
                    Some(element) => format!("{word}({}[{element}])", item.name.text),
                }
            }
            ast::Premise::AtLeast(comparison) => comparison.to_string(),
            ast::Premise::Equal(left, right) => format!("{left} == {right}"),
        };
    }
    text
}

/// Which item a condition is about: (whether it is a contact, index).
fn item_of(condition: Condition) -> (bool, usize) {
    match condition {
        Condition::Closed(i) | Condition::Open(i) => (true, i),
        Condition::Sticks(i) | Condition::Slips(i) => (false, i),
    }
}
