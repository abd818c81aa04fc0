//! Bodies at a start: how they are turned, and how they spin.
//!
//! ```text
//! turn = a               q = (cos |a|/2, a/|a| sin |a|/2): by the angle |a| about a
//! turn = (a, b, …)       q = q(a) q(b) …: each about the axes that the body has by then
//! body_rate = Ω          q̇ = ½ q (0, Ω)
//! space_rate = ω         q̇ = ½ (0, ω) q
//! ```
//!
//! (Whittaker, Analytical Dynamics, 1904, §§8–16.)

use super::Start;
use super::depth::START;
use super::elaboration::Elaboration;
use super::value::{cross, dot};
use crate::ast::{Name, StartValue};
use crate::diagnostics::{Code, nearest};
use crate::symbolic::{ExprId, Function, Pool, Rational};

/// What a start may say of a body.
const MEMBERS: [&str; 3] = ["turn", "body_rate", "space_rate"];

/// One part in so many, added to the square of an angle, is too small to be seen, but the length of no turn at all can be divided by.
const TINY: i128 = 1_000_000_000_000_000_000_000_000_000_000_000_000;

/// (w, u)
type Quaternion = [ExprId; 4];

/// What a start says of one body.
pub(super) struct Oriented {
    /// The name where it is first spoken of.
    name: Name,
    /// First of its coordinates.
    first: usize,
    /// The orientation that its turns make.
    turned: Option<Quaternion>,
    /// Its angular velocity by component, along axes of the body and of space.
    rates: [[Option<ExprId>; 3]; 2],
}

impl Elaboration<'_> {
    /// Takes one `body.turn = …`, `body.body_rate = …` or `body.space_rate[2] = …`.
    pub fn orient(
        &mut self,
        bodies: &mut Vec<Oriented>,
        declared: &StartValue,
        member: &Name,
    ) -> Option<()> {
        let name = &declared.name;
        let first = self.body_of(name, member)?;
        if self.in_body_rates {
            return None;
        }
        let index = match bodies.iter().position(|body| body.first == first) {
            Some(index) => index,
            None => {
                bodies.push(Oriented {
                    name: name.clone(),
                    first,
                    turned: None,
                    rates: [[None; 3]; 2],
                });
                bodies.len() - 1
            }
        };
        let twice = |this: &mut Self, text: &str| {
            let text = format!("{}.{text}", name.text);
            this.sink.report(Code::SameTwice, member, &[&text]);
        };
        let side = match member.text.as_str() {
            "turn" => {
                let turned = self.turned(declared, member)?;
                if bodies[index].turned.replace(turned).is_some() {
                    twice(self, "turn");
                    return None;
                }
                return Some(());
            }
            "body_rate" => 0,
            "space_rate" => 1,
            other => {
                let hint = match nearest(other, MEMBERS) {
                    Some(known) => format!("did you mean `{known}`?"),
                    None => format!("a start sets {}", MEMBERS.join(", ")),
                };
                let body = &name.text;
                self.sink
                    .report(Code::NoSuchMember, member, &[body, &other, &hint]);
                return None;
            }
        };
        for (k, rate) in self.elements_of(declared, Some(3))? {
            if bodies[index].rates[side][k].replace(rate).is_some() {
                twice(self, &format!("{}[{k}]", member.text));
                return None;
            }
        }
        Some(())
    }

    /// Whether a start says in one way only how a body is turned, and how it spins.
    fn said_once(&mut self, start: &Start, body: &Oriented) -> Option<()> {
        let of_body = |list: &[(usize, ExprId)]| {
            let mut set = list.iter().map(|(coordinate, _)| *coordinate);
            set.find(|coordinate| (body.first..body.first + 4).contains(coordinate))
        };
        let (position, velocity) = (of_body(&start.positions), of_body(&start.velocities));
        let coordinates = &self.system.coordinates;
        let position = position.map(|i| coordinates[i].name.text.clone());
        let velocity = velocity.map(|i| self.system.pool.name(coordinates[i].velocity).to_string());
        let member = |text: &str| format!("{}.{text}", body.name.text);
        let [own, space] = [0, 1].map(|side| body.rates[side].iter().any(Option::is_some));
        let rate = match (own, space) {
            (true, true) => Some((member("body_rate"), Some(member("space_rate")))),
            (true, false) => Some((member("body_rate"), velocity)),
            (false, true) => Some((member("space_rate"), velocity)),
            (false, false) => None,
        };
        let turn = body.turned.map(|_| (member("turn"), position));
        for (said, again) in [turn, rate].into_iter().flatten() {
            if let Some(again) = again {
                let hint = "both say how the body moves; keep one";
                self.sink
                    .report(Code::Exclusive, &body.name, &[&said, &again, &hint]);
                return None;
            }
        }
        Some(())
    }

    /// Sets the quaternions of all bodies, and how they change. A body that is not oriented stands along the axes of space: q = 0 is no
    /// orientation.
    pub fn place(&mut self, start: &mut Start, bodies: &[Oriented]) -> Option<()> {
        for body in bodies {
            self.said_once(start, body)?;
            let turned = body.turned.into_iter().flatten().enumerate();
            start
                .positions
                .extend(turned.map(|(k, e)| (body.first + k, e)));
        }
        for &first in self.bodies.values() {
            let mut set = start.positions.iter();
            if !set.any(|(coordinate, _)| (first..first + 4).contains(coordinate)) {
                start.positions.push((first, self.system.pool.integer(1)));
            }
        }
        for body in bodies {
            for (rates, in_space) in body.rates.iter().zip([false, true]) {
                if rates.iter().all(Option::is_none) {
                    continue;
                }
                let pool = &mut self.system.pool;
                let zero = pool.integer(0);
                let mut position = |k: usize| {
                    let mut set = start.positions.iter();
                    let found = set.find(|(coordinate, _)| *coordinate == body.first + k);
                    found.map_or(zero, |&(_, e)| e)
                };
                let q = [0, 1, 2, 3].map(&mut position);
                let [x, y, z] = rates.map(|rate| rate.unwrap_or(zero));
                let rate = [zero, x, y, z];
                let change = match in_space {
                    true => product(pool, rate, q),
                    false => product(pool, q, rate),
                };
                let change = change.map(|e| pool.scale(e, Rational::HALF));
                let change = change.into_iter().enumerate();
                start
                    .velocities
                    .extend(change.map(|(k, e)| (body.first + k, e)));
            }
        }
        Some(())
    }

    /// The orientation by `turn = (a, b, c)`, or by several such vectors.
    fn turned(&mut self, declared: &StartValue, member: &Name) -> Option<Quaternion> {
        let turns = self.turns(member, &declared.value, START)?;
        let pool = &mut self.system.pool;
        let (zero, one) = (pool.integer(0), pool.integer(1));
        let upright = [one, zero, zero, zero];
        Some(turns.chunks_exact(3).fold(upright, |q, turn| {
            let turn = by_vector(pool, [turn[0], turn[1], turn[2]]);
            product(pool, q, turn)
        }))
    }
}

/// The orientation by a turn about a vector, by its length.
fn by_vector(pool: &mut Pool, turn: [ExprId; 3]) -> Quaternion {
    let mut along = (0..3).filter(|&k| !pool.is_zero(turn[k]));
    let only = along.next().filter(|_| along.next().is_none());
    // About one axis the angle is known with its sign.
    let angle = only.map(|k| turn[k]).unwrap_or_else(|| {
        let square = dot(pool, &turn, &turn);
        let tiny = Rational::new(1, TINY).map_or(square, |tiny| pool.number(tiny));
        let square = pool.sum(&[square, tiny]);
        pool.sqrt(square)
    });
    let half = pool.scale(angle, Rational::HALF);
    let [sine, w] = [Function::Sin, Function::Cos].map(|f| pool.call(f, &[half]));
    let [x, y, z] = [0, 1, 2].map(|k| match only {
        Some(axis) if axis == k => sine,
        Some(_) => turn[k],
        None => {
            let part = pool.div(turn[k], angle).unwrap_or(turn[k]);
            pool.mul(part, sine)
        }
    });
    [w, x, y, z]
}

/// (w, u) (w', u') = (w w' − u·u', w u' + w' u + u × u')
fn product(pool: &mut Pool, [w, x, y, z]: Quaternion, [v, a, b, c]: Quaternion) -> Quaternion {
    let (u, s) = ([x, y, z], [a, b, c]);
    let (whole, shared) = (pool.mul(w, v), dot(pool, &u, &s));
    let turned = cross(pool, u, s);
    let part = |pool: &mut Pool, k: usize| {
        let terms = [pool.mul(w, s[k]), pool.mul(v, u[k]), turned[k]];
        pool.sum(&terms)
    };
    [
        pool.sub(whole, shared),
        part(pool, 0),
        part(pool, 1),
        part(pool, 2),
    ]
}
