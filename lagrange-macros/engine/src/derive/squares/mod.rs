//! T = ½ Σ cₛ wₛ uₛ, the velocities wₛ = Σ Jₛᵢ vᵢ left whole: mass matrix, forcing, momenta and T of large systems.
//!
//! ```text
//! Mᵢⱼ = Σₛ cₛ Jₛᵢ Uₛⱼ        pᵢ = Σₛ cₛ Jₛᵢ uₛ
//! fᵢ = −Σₛ cₛ (Jₛᵢ u̇ₛ + uₛ (J̇ₛᵢ − ∂wₛ/∂qᵢ)),        u̇ₛ at v̇ = 0
//! ```
//!
//! A square has uₛ = wₛ. The product of two velocities, as that of two components of an angular velocity and a product of inertia,
//! stands twice, each time with the other one of them as uₛ = Σ Uₛⱼ vⱼ.
//!
//! The first term of f is d'Alembert's: inertial forces projected on the directions of motion (Kane & Levinson 1985,
//! section 4.11); the second vanishes where wₛ is the rate of a function of the positions. A chain's velocities are
//! each the one before it and a term more, and so are the sums of inertial forces below a joint: kept as
//! [groups](Pool::group) they cost n operations together, where the Christoffel symbols of M cost n².

mod find;
mod mass;
mod nested;
mod turning;

use super::forms::Variables;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Pool, Rational, Symbol};
use find::{Term, slopes, slopes_of_whole, terms_of_energy};
use nested::{nested, terms};
use turning::{Turning, recognize};

/// (i, expression)
type ByCoordinate = Vec<(usize, ExprId)>;

/// ½ c w u
struct Square {
    /// c
    inertia: ExprId,
    /// Whose velocity u is: the square's own, but in a product.
    partner: usize,
    /// (j, ∂w/∂vⱼ), without zeros, ascending.
    slopes: ByCoordinate,
    /// w, if velocities in it are kept whole.
    whole: Option<ExprId>,
}

/// Some squares, ascending.
type Members = Vec<usize>;

/// A kinetic energy as a sum of squares and products.
pub(super) struct Squares {
    squares: Vec<Square>,
    /// Per coordinate: (Jₛᵢ, the squares that have it).
    directions: Vec<Vec<(ExprId, Members)>>,
    /// How the direction of each velocity turns.
    turnings: Vec<Turning>,
    /// wₛ, each made of a shorter one where it contains it.
    speeds: Vec<ExprId>,
    /// Number of coordinates.
    size: usize,
}

impl Squares {
    /// None if the energy does not have this form, or gains nothing by it.
    pub fn of(pool: &mut Pool, x: &Variables, kinetic: ExprId) -> Option<Squares> {
        let velocities: SortedMap<Symbol, usize> = x
            .velocities
            .iter()
            .enumerate()
            .map(|(i, &v)| (v, i))
            .collect();
        let mut squares = Vec::new();
        let mut lists = Vec::new();
        for Term {
            factor,
            velocities: [w, u],
        } in terms_of_energy(pool, x, kinetic)?
        {
            let place = squares.len();
            let entries = match w == u {
                true => vec![(w, pool.scale(factor, Rational::integer(2)), place)],
                false => vec![(w, factor, place + 1), (u, factor, place)],
            };
            for (w, inertia, partner) in entries {
                let (slopes, whole) = match slopes(pool, x, &velocities, w) {
                    Some(slopes) => (slopes, None),
                    None => (slopes_of_whole(pool, x, w)?, Some(w)),
                };
                squares.push(Square {
                    inertia,
                    partner,
                    slopes,
                    whole,
                });
                lists.push(terms(pool, w));
            }
        }
        if multiplied_out(&squares) {
            return None;
        }
        let turnings = recognize(pool, x, &mut squares);
        let speeds = nested(pool, &lists);
        let directions = directions_of(x.len(), &squares);
        Some(Squares {
            squares,
            directions,
            turnings,
            speeds,
            size: x.len(),
        })
    }

    /// T
    pub fn energy(&self, pool: &mut Pool) -> ExprId {
        let mut terms = Vec::with_capacity(self.squares.len());
        for (square, &w) in self.squares.iter().zip(&self.speeds) {
            let [w, u] = [w, self.speeds[square.partner]].map(|speed| pool.group_sum(speed));
            let term = pool.product(&[square.inertia, w, u]);
            terms.push(pool.scale(term, Rational::HALF));
        }
        pool.sum(&terms)
    }

    /// (i, ∂T/∂vᵢ)
    pub fn momenta(&self, pool: &mut Pool) -> ByCoordinate {
        let none = vec![pool.integer(0); self.squares.len()];
        let projected = self.projected(pool, &self.speeds, &none);
        let momenta: Vec<_> = projected
            .into_iter()
            .map(|p| pool.factor(p))
            .enumerate()
            .collect();
        momenta
            .into_iter()
            .filter(|&(_, p)| !pool.is_zero(p))
            .collect()
    }

    /// The inertial part of f.
    pub fn forcing(&self, pool: &mut Pool, x: &Variables) -> Vec<ExprId> {
        self.inertial(pool, x, None)
    }

    /// M v̇ less the inertial part of f, v̇ left where it enters the accelerations of the squares: linear in v̇ without a mass matrix.
    pub fn balance(&self, pool: &mut Pool, x: &Variables) -> Vec<ExprId> {
        let inertial = self.inertial(pool, x, Some(&x.accelerations));
        inertial.into_iter().map(|e| pool.neg(e)).collect()
    }

    /// −Σₛ cₛ (Jₛᵢ u̇ₛ + uₛ (J̇ₛᵢ − ∂wₛ/∂qᵢ)), at v̇ = 0 where no accelerations are given.
    fn inertial(
        &self,
        pool: &mut Pool,
        x: &Variables,
        accelerations: Option<&[ExprId]>,
    ) -> Vec<ExprId> {
        let mut lists = Vec::with_capacity(self.squares.len());
        let mut twists: Vec<Vec<ExprId>> = vec![Vec::new(); self.size];
        let mut turned: Vec<Vec<ExprId>> = vec![Vec::new(); self.squares.len()];
        let mut known: SortedMap<(usize, ExprId), (ExprId, ByCoordinate)> = SortedMap::new();
        for (square, &turning) in self.squares.iter().zip(&self.turnings) {
            let mut twist: SortedMap<usize, Vec<ExprId>> = SortedMap::new();
            let rate = if let Some(whole) = square.whole {
                match turning {
                    Turning::Integrable => {}
                    Turning::With([r, t]) => {
                        let speeds = [square.partner, r, t].map(|s| self.speeds[s]);
                        let [u, first, second] = speeds.map(|speed| pool.group_sum(speed));
                        let force = pool.mul(square.inertia, u);
                        turned[r].push(pool.mul(force, second));
                        let back = pool.mul(force, first);
                        turned[t].push(pool.neg(back));
                    }
                    Turning::Unknown => {
                        for (i, part) in twist_of_whole(pool, x, whole, &square.slopes) {
                            twist.get_or_default(i).push(part);
                        }
                    }
                }
                x.rate(pool, whole)
            } else {
                let mut rates = Vec::with_capacity(square.slopes.len());
                for &(j, slope) in &square.slopes {
                    let (rate, turning) =
                        known.get_or_insert_with((j, slope), || rate_and_twist(pool, x, j, slope));
                    rates.push((*rate, Rational::ONE));
                    for &(i, part) in turning.iter() {
                        twist.get_or_default(i).push(part);
                    }
                }
                pool.linear(Rational::ZERO, rates)
            };
            let mut rate = terms(pool, rate);
            for &(j, slope) in &square.slopes {
                if let Some(accelerations) = accelerations {
                    let along = pool.mul(slope, accelerations[j]);
                    rate.extend(terms(pool, along));
                }
            }
            lists.push(rate);
            for (i, parts) in twist {
                let part = pool.sum(&parts);
                let part = pool.simplify(part);
                let u = pool.group_sum(self.speeds[square.partner]);
                twists[i].push(pool.product(&[square.inertia, u, part]));
            }
        }
        let accelerations = nested(pool, &lists);
        let turned = turned.iter().map(|terms| pool.sum(terms));
        let turned: Vec<ExprId> = turned.collect();
        let mut forcing = self.projected(pool, &accelerations, &turned);
        for (f, mut twist) in forcing.iter_mut().zip(twists) {
            twist.push(*f);
            let inertial = pool.sum(&twist);
            *f = pool.neg(inertial);
        }
        forcing
    }

    /// Σₛ Jₛᵢ (cₛ xₛ + yₛ) for every coordinate i, where x is one number for each velocity uₛ.
    fn projected(&self, pool: &mut Pool, x: &[ExprId], y: &[ExprId]) -> Vec<ExprId> {
        let partners = self.squares.iter().map(|square| x[square.partner]);
        let x: Vec<ExprId> = partners.map(|x| pool.group_sum(x)).collect();
        let mut lists = Vec::new();
        let mut factors = Vec::new();
        for (slope, having) in self.directions.iter().flatten() {
            let present = |&s: &usize| !(pool.is_zero(x[s]) && pool.is_zero(y[s]));
            let members: Members = having.iter().copied().filter(present).collect();
            let equal = members.iter().all(|&s| {
                let same = self.squares[s].inertia == self.squares[members[0]].inertia;
                same && pool.is_zero(y[s])
            });
            let terms_of = |&s: &usize| match equal {
                true => x[s],
                false => {
                    let own = pool.mul(self.squares[s].inertia, x[s]);
                    pool.add(own, y[s])
                }
            };
            let sum: Vec<ExprId> = members.iter().map(terms_of).collect();
            let sum = pool.sum(&sum);
            lists.push(terms(pool, sum));
            factors.push(match members.first() {
                Some(&s) if equal => pool.mul(*slope, self.squares[s].inertia),
                _ => *slope,
            });
        }
        let mut sums = nested(pool, &lists).into_iter().zip(factors);
        let mut projected = Vec::with_capacity(self.size);
        for directions in &self.directions {
            let mut terms = Vec::with_capacity(directions.len());
            for (sum, factor) in sums.by_ref().take(directions.len()) {
                let sum = pool.group_sum(sum);
                terms.push(pool.mul(factor, sum));
            }
            projected.push(pool.sum(&terms));
        }
        projected
    }
}

/// Whether most of what is left whole are products of the rates of two coordinates: nothing is shared in them.
fn multiplied_out(squares: &[Square]) -> bool {
    let rates = |(s, square): &(usize, &Square)| {
        let both = [square, &squares[square.partner]];
        square.partner != *s && both.iter().all(|square| square.slopes.len() == 1)
    };
    2 * squares.iter().enumerate().filter(rates).count() > squares.len()
}

/// Per coordinate: the slopes of velocities, and the squares that have them.
fn directions_of(size: usize, squares: &[Square]) -> Vec<Vec<(ExprId, Members)>> {
    let mut directions: Vec<Vec<(ExprId, Members)>> = vec![Vec::new(); size];
    for (s, square) in squares.iter().enumerate() {
        for &(i, slope) in &square.slopes {
            let known = &mut directions[i];
            match known.iter_mut().find(|(other, _)| *other == slope) {
                Some((_, having)) => having.push(s),
                None => known.push((slope, vec![s])),
            }
        }
    }
    directions
}

/// Of J vⱼ: J̇ vⱼ, and what it adds to J̇ₛᵢ − ∂wₛ/∂qᵢ for each i, without zeros.
fn rate_and_twist(
    pool: &mut Pool,
    x: &Variables,
    j: usize,
    slope: ExprId,
) -> (ExprId, ByCoordinate) {
    let rate = x.rate(pool, slope);
    let mut twist = SortedMap::from([(j, rate)]);
    for i in x.positions_in(pool, slope) {
        let turned = pool.differentiate(slope, x.positions[i]);
        let turned = pool.mul(turned, x.rates[j]);
        let before = twist.get(&i).copied().unwrap_or(x.zero);
        twist.insert(i, pool.sub(before, turned));
    }
    twist.retain(|_, part| !pool.is_zero(*part));
    (pool.mul(rate, x.rates[j]), twist.into_iter().collect())
}

/// (i, J̇ᵢ − ∂w/∂qᵢ) of a velocity in which others are kept whole, without zeros.
fn twist_of_whole(
    pool: &mut Pool,
    x: &Variables,
    whole: ExprId,
    slopes: &[(usize, ExprId)],
) -> ByCoordinate {
    let mut twist = Vec::new();
    for i in 0..x.len() {
        let turned = pool.differentiate(whole, x.positions[i]);
        let slope = slopes.iter().find(|&&(j, _)| j == i);
        let rate = slope.map_or(x.zero, |&(_, slope)| x.rate(pool, slope));
        let part = pool.sub(rate, turned);
        if !pool.is_zero(part) {
            twist.push((i, part));
        }
    }
    twist
}
