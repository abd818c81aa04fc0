//! `attitude(body: q)`: the orientation of a rigid body by a unit quaternion q = (w, u), and what it gives.
//!
//! ```text
//! unit constraint     w² + u·u − 1 = 0, named `body`
//! axes[i]             body axis i in space: (w² − u·u) eᵢ + 2 uᵢ u + 2 w u × eᵢ
//! body_rate           Ω = 2 (w u̇ − ẇ u − u × u̇), along the body axes
//! space_rate          ω = 2 (w u̇ − ẇ u + u × u̇), along the axes of space
//! ```
//!
//! Where rates of bodies are velocities, axes and body rates are symbols, and there is no quaternion.
//!
//! (Whittaker, Analytical Dynamics, 1904, §§9–16.) With T = ½ Σ Iₖ Ωₖ² the 4 × 4 mass matrix is singular along q
//! itself; together with the unit constraint the equations are regular.

use super::depth::{Context, Depth};
use super::elaborate::item_name;
use super::elaboration::Elaboration;
use super::meaning::{Entry, Kind, Meaning};
use super::value::{Value, cross, dot};
use super::{Body, Constraint, Level, System};
use crate::ast::{self, Expr, ExprKind, Head, Name};
use crate::diagnostics::{Code, nearest};
use crate::symbolic::{ExprId, Rational, Symbol};

const BODIES: &str = "members belong to a body of `attitude`";
const MEMBERS: [&str; 3] = ["axes", "space_rate", "body_rate"];

impl Elaboration<'_> {
    /// The four coordinates of a body.
    pub fn declare_attitude(&mut self, attitude: &ast::Attitude) {
        let first = match self.in_body_rates {
            true => self.declare_turns(attitude),
            false => self.declare_array(&attitude.coordinates, Some(4)),
        };
        if let Some(first) = first {
            self.bodies.insert(attitude.body.text.clone(), first);
        }
        self.dropped |= first.is_none();
    }

    /// The three turns of a body, and its axes; gives the first turn.
    fn declare_turns(&mut self, attitude: &ast::Attitude) -> Option<usize> {
        self.enter(&attitude.coordinates, Kind::Coordinate, Meaning::Poisoned)?;
        let first = self.system.coordinates.len();
        let element = |k| item_name(&attitude.body, Some((k as i64, k, 3)));
        for k in 0..3 {
            self.add_coordinate(element(k));
        }
        let name = attitude.body.text.clone();
        let axes = [0, 1, 2].map(|i| {
            [0, 1, 2].map(|j| self.symbol(&format!("{name}.axes[{i}][{j}]"), Depth::Position))
        });
        let body = Body { name, first, axes };
        let rates = [0, 1, 2].map(|k| self.system.coordinates[first + k].velocity);
        self.directions
            .extend(body.rates(&mut self.system.pool, rates));
        self.system.bodies.push(body);
        Some(first)
    }

    /// The unit constraint of a body.
    pub fn attitude(&mut self, attitude: &ast::Attitude) {
        if self.in_body_rates {
            return;
        }
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
                attitude: Some(first),
                force,
            });
            Some(this.system.constraints.len() - 1)
        });
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
        let first = self.body_of(name, member)?;
        let text = format!("{base}.{}", member.text);
        match member.text.as_str() {
            "axes" => {
                self.admit(Depth::Position, context, &text, member.into())?;
                Some(self.axes(first))
            }
            "body_rate" | "space_rate" => {
                self.admit(Depth::Velocity, context, &text, member.into())?;
                let in_space = member.text == "space_rate";
                Some(match self.turned_body(first).map(|body| body.axes) {
                    Some(axes) => self.turning(first, in_space.then_some(axes)),
                    None => self.rate(first, if in_space { 2 } else { -2 }),
                })
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

    /// The first coordinate of the body whose member is spoken of.
    pub fn body_of(&mut self, name: &Name, member: &Name) -> Option<usize> {
        if let Some(&first) = self.bodies.get(&name.text) {
            return Some(first);
        }
        match self.names.get(&name.text) {
            None => self.unknown(name),
            Some(Entry {
                meaning: Meaning::Poisoned,
                ..
            }) => {}
            Some(_) => {
                let name = &name.text;
                let velocity = matches!(member.text.as_str(), "dot" | "d" | "v" | "velocity");
                let hint = match velocity {
                    true => format!("its velocity is written `der({name})`"),
                    false => BODIES.to_owned(),
                };
                self.sink
                    .report(Code::NoSuchMember, member, &[name, &member.text, &hint])
            }
        }
        None
    }

    fn axes(&mut self, first: usize) -> Value {
        if let Some(axes) = self.turned_body(first).map(|body| body.axes) {
            let pool = &mut self.system.pool;
            let vector = |axis: [Symbol; 3]| vector(axis.map(|e| pool.leaf(e)));
            return Value::List(axes.map(vector).into());
        }
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

    /// The body whose first turn this is.
    fn turned_body(&self, first: usize) -> Option<&Body> {
        self.system.bodies.iter().find(|body| body.first == first)
    }

    /// The rates ωₖ of a body, or with its axes their sum Σ ωₖ eₖ in space.
    fn turning(&mut self, first: usize, axes: Option<[[Symbol; 3]; 3]>) -> Value {
        let System {
            pool, coordinates, ..
        } = &mut self.system;
        let rates = [0, 1, 2].map(|k| pool.leaf(coordinates[first + k].velocity));
        let Some(axes) = axes else {
            return vector(rates);
        };
        vector([0, 1, 2].map(|j| {
            let along = axes.map(|axis| pool.leaf(axis[j]));
            dot(pool, &rates, &along)
        }))
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

fn vector(components: [ExprId; 3]) -> Value {
    Value::List(components.map(Value::Scalar).into())
}
