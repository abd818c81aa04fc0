//! `attitude(body: q)`: the orientation of a rigid body by a unit quaternion q = (w, u), and what it gives.
//!
//! ```text
//! unit constraint     w² + u·u − 1 = 0, named `body`
//! axes[i]             body axis i in space: (w² − u·u) eᵢ + 2 uᵢ u + 2 w u × eᵢ
//! body_rate           Ω = 2 (w u̇ − ẇ u − u × u̇), along the body axes
//! space_rate          ω = 2 (w u̇ − ẇ u + u × u̇), along the axes of space
//! ```
//!
//! (Whittaker, Analytical Dynamics, 1904, §§9–16.) With T = ½ Σ Iₖ Ωₖ² the 4 × 4 mass matrix is singular along q
//! itself; together with the unit constraint the equations are regular.

use super::elaborate::Elaboration;
use super::names::{Entry, Kind, Meaning};
use super::reach::{Context, Depth};
use super::value::{Value, cross, dot};
use super::{Constraint, Level};
use crate::ast::{self, Expr, ExprKind, Head, Name};
use crate::diagnostics::{Code, nearest};
use crate::symbolic::{ExprId, Rational};

const BODIES: &str = "members belong to a body of `attitude`";
const MEMBERS: [&str; 3] = ["axes", "space_rate", "body_rate"];

impl Elaboration<'_> {
    /// The four coordinates of a body.
    pub fn declare_attitude(&mut self, attitude: &ast::Attitude) {
        let first = self.declare_array(&attitude.coordinates, Some(4));
        if let Some(first) = first {
            self.bodies.insert(attitude.body.text.clone(), first);
        }
        self.dropped |= first.is_none();
    }

    /// The unit constraint of a body.
    pub fn attitude(&mut self, attitude: &ast::Attitude) {
        let head = Head {
            name: attitude.body.clone(),
            index: None,
        };
        self.each(&head, |this, name| {
            let &first = this.bodies.get(&attitude.body.text)?;
            let (w, u) = this.quaternion(first, Depth::Position);
            let pool = &mut this.system.pool;
            let terms = [pool.mul(w, w), dot(pool, &u, &u), pool.integer(-1)];
            let residual = pool.sum(&terms);
            let force = this.symbol(&name.text, Depth::Force);
            this.system.constraints.push(Constraint {
                name,
                level: Level::Position,
                residual,
                while_contact: None,
                force,
            });
            Some(this.system.constraints.len() - 1)
        });
    }

    /// Starts that do not orient a body leave it along the axes of space: q = 0 is no orientation.
    pub fn upright(&mut self, positions: &mut Vec<(usize, ExprId)>) {
        for &first in self.bodies.values() {
            if !positions
                .iter()
                .any(|(coordinate, _)| (first..first + 4).contains(coordinate))
            {
                positions.push((first, self.system.pool.integer(1)));
            }
        }
    }

    /// (w, u) or (ẇ, u̇)
    fn quaternion(&mut self, first: usize, depth: Depth) -> (ExprId, [ExprId; 3]) {
        let mut leaf = |k: usize| {
            let coordinate = &self.system.coordinates[first + k];
            let symbol = match depth {
                Depth::Velocity => coordinate.velocity,
                _ => coordinate.position,
            };
            self.system.pool.leaf(symbol)
        };
        (leaf(0), [leaf(1), leaf(2), leaf(3)])
    }

    /// `body.axes`, `body.space_rate`, `body.body_rate`
    pub fn member(&mut self, base: &Expr, member: &Name, context: Context) -> Option<Value> {
        let ExprKind::Name(name) = &base.kind else {
            self.sink
                .report(Code::NoSuchMember, member, &[base, &member.text, &BODIES]);
            return None;
        };
        let Some(&first) = self.bodies.get(&name.text) else {
            match self.names.get(&name.text) {
                None => self.unknown(name),
                Some(Entry {
                    meaning: Meaning::Poisoned,
                    ..
                }) => {}
                Some(_) => {
                    self.sink
                        .report(Code::NoSuchMember, member, &[base, &member.text, &BODIES])
                }
            }
            return None;
        };
        let text = format!("{base}.{}", member.text);
        match member.text.as_str() {
            "axes" => {
                self.admit(Depth::Position, context, &text, member.into())?;
                Some(self.axes(first))
            }
            "body_rate" | "space_rate" => {
                self.admit(Depth::Velocity, context, &text, member.into())?;
                let sign = if member.text == "space_rate" { 2 } else { -2 };
                Some(self.rate(first, sign))
            }
            other => {
                let hint = match nearest(other, MEMBERS) {
                    Some(known) => format!("did you mean `{known}`?"),
                    None => format!("its members are {}", MEMBERS.join(", ")),
                };
                self.sink
                    .report(Code::NoSuchMember, member, &[base, &other, &hint]);
                None
            }
        }
    }

    fn axes(&mut self, first: usize) -> Value {
        let (w, u) = self.quaternion(first, Depth::Position);
        let pool = &mut self.system.pool;
        let (zero, one, two) = (pool.integer(0), pool.integer(1), Rational::integer(2));
        let (square, length) = (pool.mul(w, w), dot(pool, &u, &u));
        let along = pool.sub(square, length);
        let axis = |i: usize| {
            let mut unit = [zero; 3];
            unit[i] = one;
            let turned = cross(pool, u, unit);
            let component = |j: usize| {
                let (outer, twist) = (pool.mul(u[i], u[j]), pool.mul(w, turned[j]));
                let terms = [
                    pool.mul(along, unit[j]),
                    pool.scale(outer, two),
                    pool.scale(twist, two),
                ];
                Value::Scalar(pool.sum(&terms))
            };
            Value::List((0..3).map(component).collect())
        };
        Value::List((0..3).map(axis).collect())
    }

    /// 2 (w u̇ − ẇ u) + sign u × u̇
    fn rate(&mut self, first: usize, sign: i64) -> Value {
        let (w, u) = self.quaternion(first, Depth::Position);
        let (dw, du) = self.quaternion(first, Depth::Velocity);
        let pool = &mut self.system.pool;
        let turned = cross(pool, u, du);
        let component = |k: usize| {
            let (gain, loss) = (pool.mul(w, du[k]), pool.mul(dw, u[k]));
            let terms = [
                pool.scale(gain, Rational::integer(2)),
                pool.scale(loss, Rational::integer(-2)),
                pool.scale(turned[k], Rational::integer(sign)),
            ];
            Value::Scalar(pool.sum(&terms))
        };
        Value::List((0..3).map(component).collect())
    }

    /// Enters the body's name, which is that of its unit constraint.
    pub fn enter_body(&mut self, attitude: &ast::Attitude) -> bool {
        let meaning = Meaning::Item {
            elements: Vec::new(),
            lower: None,
        };
        self.enter(&attitude.body, Kind::Constraint, meaning)
            .is_some()
    }
}
