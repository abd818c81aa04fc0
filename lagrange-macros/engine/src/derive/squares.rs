//! T = Σ cₛ wₛ², the velocities wₛ = Σ Jₛᵢ vᵢ left whole: mass matrix, forcing, momenta and T of large systems.
//!
//! ```text
//! Mᵢⱼ = Σₛ 2cₛ Jₛᵢ Jₛⱼ        pᵢ = Σₛ 2cₛ Jₛᵢ wₛ
//! fᵢ = −Σₛ 2cₛ (Jₛᵢ aₛ + wₛ (J̇ₛᵢ − ∂wₛ/∂qᵢ)),        aₛ = ẇₛ at v̇ = 0
//! ```
//!
//! The first term of f is d'Alembert's: inertial forces projected on the directions of motion (Kane & Levinson 1985,
//! section 4.11); the second vanishes where wₛ is the rate of a function of the positions. A chain's velocities are
//! each the one before it and a term more, and so are the sums of inertial forces below a joint: kept as
//! [groups](Pool::group) they cost n operations together, where the Christoffel symbols of M cost n².

use super::forms::Variables;
use crate::symbolic::{ExprId, Node, Pool, Rational, Symbol};
use std::collections::BTreeMap;

/// A sum as (term, number), ascending.
type Terms = Vec<(ExprId, Rational)>;

/// (i, expression)
type ByCoordinate = Vec<(usize, ExprId)>;

/// Which squares; a bit each.
type Set = Vec<u64>;

/// A pair of directions that is used at least so often gets its fixed factor beforehand.
const WORTHWHILE: usize = 4;

/// How many shorter sums are looked at for one that a sum contains.
const TRIES: usize = 16;

/// c w²
struct Square {
    /// 2c
    inertia: ExprId,
    /// (j, ∂w/∂vⱼ), without zeros, ascending.
    slopes: ByCoordinate,
}

/// A kinetic energy as a sum of squares.
pub(super) struct Squares {
    squares: Vec<Square>,
    /// Per coordinate: (Jₛᵢ, the squares that have it).
    directions: Vec<Vec<(ExprId, Set)>>,
    /// wₛ, each made of a shorter one where it contains it.
    speeds: Vec<ExprId>,
    /// Number of coordinates.
    size: usize,
}

impl Squares {
    /// None if the energy does not have this form.
    pub fn of(pool: &mut Pool, x: &Variables, kinetic: ExprId) -> Option<Squares> {
        let velocities: BTreeMap<Symbol, usize> = x
            .velocities
            .iter()
            .enumerate()
            .map(|(i, &v)| (v, i))
            .collect();
        let mut squares = Vec::new();
        let mut lists = Vec::new();
        for (c, w) in squares_in(pool, x, kinetic)? {
            squares.push(Square {
                inertia: pool.scale(c, Rational::integer(2)),
                slopes: slopes(pool, x, &velocities, w)?,
            });
            lists.push(terms(pool, w));
        }
        let speeds = nested(pool, &lists);
        let mut directions = vec![Vec::new(); x.len()];
        let words = squares.len().div_ceil(64);
        for (s, square) in squares.iter().enumerate() {
            for &(i, slope) in &square.slopes {
                let known: &mut Vec<(ExprId, Set)> = &mut directions[i];
                let at = match known.iter().position(|&(other, _)| other == slope) {
                    Some(at) => at,
                    None => {
                        known.push((slope, vec![0; words]));
                        known.len() - 1
                    }
                };
                known[at].1[s / 64] |= 1 << (s % 64);
            }
        }
        Some(Squares {
            squares,
            directions,
            speeds,
            size: x.len(),
        })
    }

    /// T
    pub fn energy(&self, pool: &mut Pool) -> ExprId {
        let mut terms = Vec::with_capacity(self.squares.len());
        for (square, &w) in self.squares.iter().zip(&self.speeds) {
            let factors = [
                (square.inertia, Rational::ONE),
                (pool.group_sum(w), Rational::integer(2)),
            ];
            terms.push(pool.monomial(Rational::HALF, &factors));
        }
        pool.sum(&terms)
    }

    /// (i, ∂T/∂vᵢ)
    pub fn momenta(&self, pool: &mut Pool) -> ByCoordinate {
        let projected = self.projected(pool, &self.speeds);
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
        let mut lists = Vec::with_capacity(self.squares.len());
        let mut twists: Vec<Vec<ExprId>> = vec![Vec::new(); self.size];
        let mut known: BTreeMap<(usize, ExprId), (ExprId, ByCoordinate)> = BTreeMap::new();
        for (square, &w) in self.squares.iter().zip(&self.speeds) {
            let mut rates = Vec::with_capacity(square.slopes.len());
            let mut twist: BTreeMap<usize, Vec<ExprId>> = BTreeMap::new();
            for &(j, slope) in &square.slopes {
                let (rate, turning) = known
                    .entry((j, slope))
                    .or_insert_with(|| rate_and_twist(pool, x, j, slope));
                rates.push((*rate, Rational::ONE));
                for &(i, part) in turning.iter() {
                    twist.entry(i).or_default().push(part);
                }
            }
            let rate = pool.linear(Rational::ZERO, rates);
            lists.push(terms(pool, rate));
            for (i, parts) in twist {
                let part = pool.sum(&parts);
                let part = pool.simplify(part);
                let w = pool.group_sum(w);
                twists[i].push(pool.product(&[square.inertia, w, part]));
            }
        }
        let accelerations = nested(pool, &lists);
        let mut forcing = self.projected(pool, &accelerations);
        for (f, mut twist) in forcing.iter_mut().zip(twists) {
            twist.push(*f);
            let inertial = pool.sum(&twist);
            *f = pool.neg(inertial);
        }
        forcing
    }

    /// Σₛ 2cₛ Jₛᵢ xₛ for every coordinate i.
    fn projected(&self, pool: &mut Pool, x: &[ExprId]) -> Vec<ExprId> {
        let x: Vec<ExprId> = x.iter().map(|&x| pool.group_sum(x)).collect();
        let mut lists = Vec::new();
        let mut factors = Vec::new();
        for (slope, set) in self.directions.iter().flatten() {
            let members: Vec<usize> = members(set).filter(|&s| !pool.is_zero(x[s])).collect();
            let equal = members
                .iter()
                .all(|&s| self.squares[s].inertia == self.squares[members[0]].inertia);
            let sum: Vec<ExprId> = members
                .iter()
                .map(|&s| match equal {
                    true => x[s],
                    false => pool.mul(self.squares[s].inertia, x[s]),
                })
                .collect();
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

    /// ((i, j ≤ i), Mᵢⱼ), zeros left out.
    pub fn mass(&self, pool: &mut Pool, x: &Variables) -> BTreeMap<(usize, usize), ExprId> {
        let inertias = self.inertias(pool);
        let mut products: BTreeMap<(usize, usize), Vec<Product>> = BTreeMap::new();
        let mut parts: BTreeMap<ExprId, (ExprId, ExprId)> = BTreeMap::new();
        // How often a fixed factor meets a direction.
        let mut uses: BTreeMap<(ExprId, ExprId), usize> = BTreeMap::new();
        for i in 0..self.size {
            if pool.is_full() {
                break;
            }
            for j in 0..=i {
                for (own, set) in &self.directions[i] {
                    for (other, others) in &self.directions[j] {
                        let Some(&inertia) = inertias.get(&common(set, others)) else {
                            continue;
                        };
                        let (fixed, varying) = *parts
                            .entry(*other)
                            .or_insert_with(|| split(pool, x, *other));
                        let product = Product {
                            inertia,
                            scaled: pool.mul(inertia, fixed),
                            own: *own,
                            other: *other,
                            varying,
                        };
                        if i != j {
                            *uses.entry((product.scaled, *own)).or_default() += 1;
                            *uses.entry((inertia, *own)).or_default() += 1;
                        }
                        products.entry((i, j)).or_default().push(product);
                    }
                }
            }
        }
        let often = |key: (ExprId, ExprId)| uses.get(&key).is_some_and(|&n| n >= WORTHWHILE);
        let mut mass = BTreeMap::new();
        for ((i, j), list) in products {
            let mut terms = Vec::with_capacity(list.len());
            for product in list {
                let [own, other] = if i != j && often((product.scaled, product.own)) {
                    let own = pool.mul(product.scaled, product.own);
                    [pool.group(own), product.varying]
                } else if i != j && often((product.inertia, product.own)) {
                    let own = pool.mul(product.inertia, product.own);
                    [pool.group(own), pool.group(product.other)]
                } else {
                    [pool.mul(product.inertia, product.own), product.other]
                };
                terms.push(pool.mul(own, other));
            }
            let entry = pool.sum(&terms);
            let entry = pool.factor(entry);
            if !pool.is_zero(entry) {
                mass.insert((i, j), entry);
            }
        }
        mass
    }

    /// Σ 2cₛ of all sets of squares in which two directions meet.
    fn inertias(&self, pool: &mut Pool) -> BTreeMap<Set, ExprId> {
        let mut lists: BTreeMap<Set, Terms> = BTreeMap::new();
        for i in 0..self.size {
            for j in 0..=i {
                for (_, set) in &self.directions[i] {
                    for (_, others) in &self.directions[j] {
                        let set = common(set, others);
                        if lists.contains_key(&set) || set.iter().all(|word| *word == 0) {
                            continue;
                        }
                        let list: Vec<ExprId> =
                            members(&set).map(|s| self.squares[s].inertia).collect();
                        let sum = pool.sum(&list);
                        lists.insert(set, terms(pool, sum));
                    }
                }
            }
        }
        let (sets, lists): (Vec<Set>, Vec<Terms>) = lists.into_iter().unzip();
        sets.into_iter().zip(nested(pool, &lists)).collect()
    }
}

/// What two sets have in common.
fn common(a: &Set, b: &Set) -> Set {
    a.iter().zip(b).map(|(a, b)| a & b).collect()
}

/// inertia · own · other
struct Product {
    inertia: ExprId,
    /// inertia and what is fixed of the other direction
    scaled: ExprId,
    own: ExprId,
    other: ExprId,
    /// What varies of the other direction.
    varying: ExprId,
}

/// What is fixed during a run of a direction, and what varies.
fn split(pool: &mut Pool, x: &Variables, slope: ExprId) -> (ExprId, ExprId) {
    let (number, core) = match pool.node(slope) {
        Node::Sum { constant, terms } if constant.is_zero() && terms.len() == 1 => {
            (terms[0].1, terms[0].0)
        }
        _ => (Rational::ONE, slope),
    };
    let (varying, fixed): (Vec<_>, Vec<_>) = match pool.node(core) {
        Node::Product(factors) => factors
            .iter()
            .partition(|&&(base, _)| x.changes(pool, base)),
        _ => (vec![(core, Rational::ONE)], Vec::new()),
    };
    (
        pool.monomial(number, &fixed),
        pool.monomial(Rational::ONE, &varying),
    )
}

/// The members of a set, ascending.
fn members(set: &Set) -> impl Iterator<Item = usize> + '_ {
    let bits = |(word, &bits): (usize, &u64)| {
        (0..64)
            .filter(move |bit| bits >> bit & 1 == 1)
            .map(move |bit| 64 * word + bit)
    };
    set.iter().enumerate().flat_map(bits)
}

/// (c, w) of all squares c w² that an energy is the sum of.
fn squares_in(pool: &mut Pool, x: &Variables, kinetic: ExprId) -> Option<Vec<(ExprId, ExprId)>> {
    let mut found = Vec::new();
    let mut open = vec![(x.one, kinetic)];
    while let Some((c, e)) = open.pop() {
        match pool.node(e).clone() {
            Node::Sum { constant, terms } if constant.is_zero() => {
                for (term, number) in terms.into_iter().rev() {
                    open.push((pool.scale(c, number), term));
                }
            }
            Node::Product(factors) => {
                let (moving, rest): (Vec<_>, Vec<_>) = factors
                    .into_iter()
                    .partition(|&(base, _)| pool.depends_on_any(base, &x.velocities));
                let rest = pool.monomial(Rational::ONE, &rest);
                let c = pool.mul(c, rest);
                match moving[..] {
                    [(w, power)] if power == Rational::integer(2) && !x.changes(pool, c) => {
                        found.push((c, w));
                    }
                    [(sum, power)] if power.is_one() => open.push((c, sum)),
                    _ => return None,
                }
            }
            _ => return None,
        }
    }
    Some(found)
}

/// (j, ∂w/∂vⱼ) of a velocity that is linear and homogeneous in v by its form.
fn slopes(
    pool: &mut Pool,
    x: &Variables,
    velocities: &BTreeMap<Symbol, usize>,
    w: ExprId,
) -> Option<ByCoordinate> {
    let mut parts: BTreeMap<usize, Terms> = BTreeMap::new();
    for (term, number) in terms(pool, w) {
        let factors = match pool.node(term) {
            Node::Product(factors) => factors.clone(),
            Node::Symbol(_) => vec![(term, Rational::ONE)],
            _ => return None,
        };
        let mut rest = Vec::with_capacity(factors.len());
        let mut moving = None;
        for (base, power) in factors {
            let velocity = match pool.node(base) {
                Node::Symbol(symbol) => velocities.get(symbol),
                _ if pool.depends_on_any(base, &x.velocities) => return None,
                _ => None,
            };
            match velocity {
                Some(&j) if power.is_one() && moving.is_none() => moving = Some(j),
                Some(_) => return None,
                None => rest.push((base, power)),
            }
        }
        let rest = pool.monomial(Rational::ONE, &rest);
        parts.entry(moving?).or_default().push((rest, number));
    }
    let slopes = parts
        .into_iter()
        .map(|(j, terms)| (j, pool.linear(Rational::ZERO, terms)));
    Some(slopes.filter(|&(_, slope)| slope != x.zero).collect())
}

/// Of J vⱼ: J̇ vⱼ, and what it adds to J̇ₛᵢ − ∂wₛ/∂qᵢ for each i, without zeros.
fn rate_and_twist(
    pool: &mut Pool,
    x: &Variables,
    j: usize,
    slope: ExprId,
) -> (ExprId, ByCoordinate) {
    let rate = x.rate(pool, slope);
    let mut twist = BTreeMap::from([(j, rate)]);
    for i in x.positions_in(pool, slope) {
        let turned = pool.differentiate(slope, x.positions[i]);
        let turned = pool.mul(turned, x.rates[j]);
        let before = twist.get(&i).copied().unwrap_or(x.zero);
        twist.insert(i, pool.sub(before, turned));
    }
    twist.retain(|_, part| !pool.is_zero(*part));
    (pool.mul(rate, x.rates[j]), twist.into_iter().collect())
}

/// e as a sum.
fn terms(pool: &Pool, e: ExprId) -> Terms {
    match pool.node(e) {
        Node::Sum { constant, terms } if constant.is_zero() => terms.clone(),
        Node::Number(number) if number.is_zero() => Vec::new(),
        _ => vec![(e, Rational::ONE)],
    }
}

/// The sums, each made of the longest shorter one that it contains.
fn nested(pool: &mut Pool, lists: &[Terms]) -> Vec<ExprId> {
    let mut order: Vec<usize> = (0..lists.len()).collect();
    order.sort_by_key(|&k| lists[k].len());
    let mut sums = vec![pool.integer(0); lists.len()];
    let mut made: Vec<usize> = Vec::new();
    for k in order {
        let list = &lists[k];
        let inner = made.iter().rev().take(TRIES).copied();
        let inner = inner
            .filter(|&inner| lists[inner].len() > 1)
            .find_map(|inner| Some((inner, remainder(list, &lists[inner])?)));
        sums[k] = match inner {
            Some((inner, rest)) if rest.is_empty() => sums[inner],
            Some((inner, mut rest)) => {
                rest.push((pool.group_sum(sums[inner]), Rational::ONE));
                pool.linear(Rational::ZERO, rest)
            }
            None => pool.linear(Rational::ZERO, list.clone()),
        };
        made.push(k);
    }
    sums
}

/// What a sum has beside another one, if it contains it.
fn remainder(list: &Terms, inner: &Terms) -> Option<Terms> {
    let mut rest = Vec::with_capacity(list.len() - inner.len());
    let mut inner = inner.iter().peekable();
    for term in list {
        if inner.peek() == Some(&term) {
            inner.next();
        } else {
            rest.push(*term);
        }
    }
    inner.next().is_none().then_some(rest)
}
