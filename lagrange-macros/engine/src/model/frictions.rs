//! Coulomb friction: slip velocities, coefficients, and the source of the normal force.

use super::depth::{Context, Depth, NORMAL_FORCE, Reach};
use super::elaboration::Elaboration;
use super::meaning::Kind;
use super::value::Value;
use super::{Friction, Normal};
use crate::ast::{self, Expr, ExprKind, FrictionLaw, Reference};
use crate::diagnostics::Code;
use crate::symbolic::{ExprId, Rational, Symbol};

const SLIP: Context = Context::new(Reach::Motion, "a slip velocity");
const COEFFICIENT: Context = Context::new(Reach::Motion, "a coefficient of friction");
const NORMAL: Context = Context::new(Reach::Motion, NORMAL_FORCE);
const LIMIT: Context = Context::new(Reach::Motion, "a friction force");

/// Forces of no more constraints press together: space has so many directions.
const MOST_TOGETHER: usize = 3;

impl Elaboration<'_> {
    pub fn friction(&mut self, declared: &ast::Friction) {
        self.each(&declared.head, |this, name| {
            let on = match declared.on.as_slice() {
                [] => None,
                on => Some(this.bearers(on)),
            };
            let slip = this.slip(&declared.slip, &name.text);
            this.slip = slip.as_deref().map(slip_as_value);
            let law = this.law(&declared.law);
            this.slip = None;
            let (given, at_rest, sliding) = law?;
            this.sensible(&declared.law, given, at_rest, sliding)?;
            let normal = match (on, given) {
                (Some(on), _) => on?,
                (None, given) => Normal::Given(given?),
            };
            let slip = slip?;
            this.as_strong_both_ways(&declared.law, sliding, &slip)?;
            if let Normal::Contact(contact) = normal {
                this.along_surface(contact, &slip, &declared.slip)?;
            }
            let [static_coefficient, kinetic_coefficient] =
                [at_rest, sliding].map(|e| this.of_slip_speed(e, &slip, &declared.slip));
            this.system.frictions.push(Friction {
                name,
                slip,
                normal,
                static_coefficient,
                kinetic_coefficient,
            });
            Some(this.system.frictions.len() - 1)
        });
    }

    /// Whether no slip is the velocity along the normal, as that of the contact's own gap.
    fn along_surface(
        &mut self,
        contact: usize,
        slip: &[(ExprId, Symbol)],
        declared: &Expr,
    ) -> Option<()> {
        let contact = &self.system.contacts[contact];
        let (name, gap) = (contact.name.text.clone(), contact.gap);
        let rate = self.time_rate(gap);
        for &(component, _) in slip {
            let pool = &mut self.system.pool;
            let along = [Rational::ONE, Rational::MINUS_ONE]
                .into_iter()
                .any(|sign| {
                    let signed = pool.scale(rate, sign);
                    let sum = pool.add(component, signed);
                    let sum = pool.expand(sum);
                    pool.is_zero(sum)
                });
            if along {
                let text = format!("this slip is the velocity along the normal of `{name}`");
                let hint = "a slip is a velocity along the surface";
                self.sink
                    .report(Code::Bearing, declared.extent, &[&text, &hint]);
                return None;
            }
        }
        Some(())
    }

    /// What presses: a contact, a constraint, or constraints together.
    fn bearers(&mut self, on: &[Reference]) -> Option<Normal> {
        if let [one] = on {
            let (kind, item) = self.item(one, &[Kind::Contact, Kind::Constraint])?;
            if kind == Kind::Contact {
                return Some(Normal::Contact(item));
            }
            let normal = Normal::Constraint(item);
            return self.presses_one_way(normal, item, one).then_some(normal);
        }
        let mut constraints = Vec::new();
        for reference in on {
            let (_, constraint) = self.item(reference, &[Kind::Constraint])?;
            if constraints.contains(&constraint) {
                let name = &reference.name;
                self.sink.report(Code::SameTwice, name, &[&name.text]);
                return None;
            }
            constraints.push(constraint);
        }
        let first = &on[0].name;
        if constraints.len() > MOST_TOGETHER {
            let (most, many) = (format!("up to {MOST_TOGETHER} constraints"), on.len());
            self.sink
                .report(Code::ArgumentCount, first, &[&"on", &most, &many]);
            return None;
        }
        let condition = |&i: &usize| self.system.constraints[i].while_contact;
        let conditions: Vec<_> = constraints.iter().map(condition).collect();
        if conditions.iter().any(|other| *other != conditions[0]) {
            let hint = "constraints press together if all hold always, or all `while` one contact";
            let text = "these constraints do not hold at the same times";
            self.sink.report(Code::Bearing, first, &[&text, &hint]);
            return None;
        }
        // In whatever order they are named.
        let same = |known: &Vec<usize>| {
            known.len() == constraints.len() && constraints.iter().all(|i| known.contains(i))
        };
        let known = self.system.resultants.iter().position(same);
        let resultant = known.unwrap_or(self.system.resultants.len());
        let normal = Normal::Resultant(resultant);
        let mut each = constraints.iter().zip(on);
        if !each.all(|(&i, reference)| self.presses_one_way(normal, i, reference)) {
            return None;
        }
        if known.is_none() {
            self.system.resultants.push(constraints);
        }
        Some(normal)
    }

    /// Whether no friction before this one has the force of this constraint together with others.
    fn presses_one_way(&mut self, normal: Normal, constraint: usize, at: &Reference) -> bool {
        let other = self.system.frictions.iter().find(|friction| {
            let mut pressing = self.system.pressing(friction.normal);
            friction.normal != normal && pressing.any(|i| i == constraint)
        });
        let Some(other) = other else {
            return true;
        };
        let text = format!(
            "`{}` is pressed by other constraints than this friction",
            other.name.text
        );
        let hint = "frictions of one bearing name the same constraints; a bearing beside it has constraints of its own, on a body between them";
        self.sink.report(Code::Bearing, &at.name, &[&text, &hint]);
        false
    }

    /// (given normal force, μs, μk); a limit is the coefficient of the normal force 1.
    fn law(&mut self, law: &FrictionLaw) -> Option<(Option<ExprId>, ExprId, ExprId)> {
        match law {
            FrictionLaw::Coefficients {
                normal,
                stick,
                slide,
            } => {
                let normal = normal.as_ref().map(|normal| self.scalar(normal, NORMAL));
                let stick_at_rest = self.at_rest(|this| this.scalar(stick, COEFFICIENT));
                let slide = match slide {
                    None if !mentions_slip(stick) => stick_at_rest,
                    None => stick_at_rest.and_then(|_| self.scalar(stick, COEFFICIENT)),
                    Some(slide) => self.scalar(slide, COEFFICIENT),
                };
                let normal = match normal {
                    None => None,
                    Some(normal) => Some(normal?),
                };
                Some((normal, stick_at_rest?, slide?))
            }
            FrictionLaw::Limit(limit) => {
                let one = self.system.pool.integer(1);
                let (stick, slide) = self.limit(limit)?;
                if !mentions_slip(limit) {
                    return Some((Some(one), stick, slide));
                }
                let (stick, _) = self.at_rest(|this| this.limit(limit))?;
                Some((Some(one), stick, slide))
            }
        }
    }

    /// The static and the kinetic force.
    fn limit(&mut self, limit: &Expr) -> Option<(ExprId, ExprId)> {
        match self.value(limit, LIMIT)? {
            Value::Scalar(force) => Some((force, force)),
            list => match list.vector().as_deref() {
                Some(&[stick, slide]) => Some((stick, slide)),
                _ => {
                    let hint = "a limit is one force, or two: `(static, kinetic)`";
                    self.sink
                        .report(Code::ScalarForList, limit.extent, &[&hint]);
                    None
                }
            },
        }
    }

    /// Reads what holds while a friction sticks: `slip` is zero.
    fn at_rest<R>(&mut self, read: impl FnOnce(&mut Self) -> R) -> R {
        let zero = self.system.pool.integer(0);
        let none = self.slip.as_ref().map(|slip| slip.map(&mut |_| zero));
        let slip = std::mem::replace(&mut self.slip, none);
        let found = read(self);
        self.slip = slip;
        found
    }

    /// Whether a normal force and coefficients that are numbers can be meant: not negative, and kinetic at most static.
    fn sensible(
        &mut self,
        law: &FrictionLaw,
        normal: Option<ExprId>,
        stick: ExprId,
        slide: ExprId,
    ) -> Option<()> {
        let (pressing, first, second) = match law {
            FrictionLaw::Coefficients {
                normal,
                stick,
                slide,
            } => (normal.as_deref(), &**stick, slide.as_deref()),
            FrictionLaw::Limit(limit) => match &limit.kind {
                ExprKind::List(limits) => (None, limits.first()?, limits.get(1)),
                _ => (None, limit, None),
            },
        };
        let second = second.unwrap_or(first);
        let pool = &self.system.pool;
        let (stick, slide) = (pool.as_number(stick), pool.as_number(slide));
        let normal = normal.and_then(|normal| pool.as_number(normal));
        let pressing = pressing.map(|expr| (normal, expr));
        for (number, expr) in pressing
            .into_iter()
            .chain([(stick, first), (slide, second)])
        {
            if number.is_some_and(Rational::is_negative) {
                self.sink.report(Code::NegativeFriction, expr.extent, &[]);
                return None;
            }
        }
        let falls = stick
            .zip(slide)
            .and_then(|(stick, slide)| stick.checked_sub(slide));
        if falls.is_some_and(Rational::is_negative) {
            self.sink
                .report(Code::FrictionGrows, second.extent, &[second, first]);
            return None;
        }
        Some(())
    }

    /// A coefficient in which √(s²) is |s| for the one slip component s: at rest the root has no Taylor series.
    fn of_slip_speed(&mut self, e: ExprId, slip: &[(ExprId, Symbol)], declared: &Expr) -> ExprId {
        let &[(s, _)] = slip else {
            return e;
        };
        let pool = &mut self.system.pool;
        let square = pool.mul(s, s);
        let mark = pool.integer(1);
        if pool.extract_root(e, square, mark) == e {
            return e;
        }
        let speed = self.absolute(s, declared);
        self.system.pool.extract_root(e, square, speed)
    }

    /// One or two slip components with the symbols of the forces along them.
    fn slip(&mut self, slip: &Expr, name: &str) -> Option<Vec<(ExprId, Symbol)>> {
        let components = match self.value(slip, SLIP)? {
            Value::Scalar(e) => vec![e],
            list => match list.vector() {
                Some(components) if matches!(components.len(), 1 | 2) => components,
                _ => {
                    let hint = "a slip has one component, or two: `(s1, s2)`";
                    self.sink.report(Code::ScalarForList, slip.extent, &[&hint]);
                    return None;
                }
            },
        };
        let count = components.len();
        let mut found = Vec::new();
        for (i, component) in components.into_iter().enumerate() {
            if self.depth(&[component]) < Depth::Velocity {
                let hint = "a slip is the velocity of the contact point: write it with `der(…)`";
                self.sink.report(
                    Code::ConstrainsNothing,
                    slip.extent,
                    &[&"slip", &"velocity", &hint],
                );
                return None;
            }
            let hint = "a slip is a component of a velocity; of two components write `(s1, s2)`, not their norm";
            self.linear(component, "slip", hint, slip.extent)?;
            let text = match count {
                1 => name.to_string(),
                _ => format!("{name}[{i}]"),
            };
            found.push((component, self.symbol(&text, Depth::Force)));
        }
        Some(found)
    }
}

/// What `slip` stands for in the coefficients of a friction: one value, or a list of two.
pub(super) fn slip_as_value(components: &[(ExprId, Symbol)]) -> Value {
    match components {
        &[(slip, _)] => Value::Scalar(slip),
        two => Value::List(two.iter().map(|&(e, _)| Value::Scalar(e)).collect()),
    }
}

/// Whether a coefficient is written with the slip of its friction.
fn mentions_slip(coefficient: &Expr) -> bool {
    let mut names = Vec::new();
    coefficient.names_into(&mut names);
    names.contains(&"slip")
}
