//! Mᵢⱼ = Σₛ cₛ Jₛᵢ Uₛⱼ, factors that are fixed or shared kept together.

use super::nested::{Terms, nested, terms};
use super::{Members, Squares};
use crate::derive::forms::Variables;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Node, Pool, Rational};

/// A pair of directions that is used at least so often gets its fixed factor beforehand.
const WORTHWHILE: usize = 4;

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

/// A direction of one coordinate and, of the partners, one of coordinate j.
struct Pair {
    j: usize,
    own: ExprId,
    other: ExprId,
    /// The squares that have both.
    both: Members,
}

/// How often a fixed factor meets a direction.
type Uses = SortedMap<(ExprId, ExprId), usize>;

impl Squares {
    /// ((i, j ≤ i), Mᵢⱼ), zeros left out.
    pub fn mass(&self, pool: &mut Pool, x: &Variables) -> SortedMap<(usize, usize), ExprId> {
        let (products, uses) = self.products(pool, x);
        let mut mass = SortedMap::new();
        for ((i, j), list) in products {
            let mut terms = Vec::with_capacity(list.len());
            for product in list {
                let [own, other] = match i == j {
                    true => [pool.mul(product.inertia, product.own), product.other],
                    false => product.halves(pool, &uses),
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

    /// The terms of all entries.
    fn products(
        &self,
        pool: &mut Pool,
        x: &Variables,
    ) -> (SortedMap<(usize, usize), Vec<Product>>, Uses) {
        let inertias = self.inertias(pool);
        let mut products: SortedMap<(usize, usize), Vec<Product>> = SortedMap::new();
        let mut parts: SortedMap<ExprId, (ExprId, ExprId)> = SortedMap::new();
        let mut uses = Uses::new();
        for i in 0..self.size {
            if pool.is_full() {
                break;
            }
            for Pair {
                j,
                own,
                other,
                both,
            } in self.pairs(i)
            {
                let Some(&inertia) = inertias.get(&both) else {
                    continue;
                };
                let (fixed, varying) = *parts.get_or_insert_with(other, || split(pool, x, other));
                let scaled = pool.mul(inertia, fixed);
                if i != j {
                    *uses.get_or_default((scaled, own)) += 1;
                    *uses.get_or_default((inertia, own)) += 1;
                }
                products.get_or_default((i, j)).push(Product {
                    inertia,
                    scaled,
                    own,
                    other,
                    varying,
                });
            }
        }
        (products, uses)
    }

    /// Σ cₛ of all lists of squares in which two directions meet.
    fn inertias(&self, pool: &mut Pool) -> SortedMap<Members, ExprId> {
        let mut lists: SortedMap<Members, Terms> = SortedMap::new();
        for i in 0..self.size {
            if pool.is_full() {
                break;
            }
            for Pair { both, .. } in self.pairs(i) {
                if lists.contains_key(&both) {
                    continue;
                }
                let list: Vec<ExprId> = both.iter().map(|&s| self.squares[s].inertia).collect();
                let sum = pool.sum(&list);
                lists.insert(both, terms(pool, sum));
            }
        }
        let (met, lists): (Vec<Members>, Vec<Terms>) = lists.into_iter().unzip();
        met.into_iter().zip(nested(pool, &lists)).collect()
    }

    /// Directions of i that meet, in some squares, those of the partners for coordinates up to i.
    fn pairs(&self, i: usize) -> Vec<Pair> {
        // They come in order, nearly, for each j: a chain of n links has n³ / 3 of them.
        let mut meetings: Vec<Vec<(usize, ExprId, usize)>> = vec![Vec::new(); i + 1];
        for (at, (_, having)) in self.directions[i].iter().enumerate() {
            for &s in having {
                let others = &self.squares[self.squares[s].partner].slopes;
                for &(j, other) in others.iter().filter(|&&(j, _)| j <= i) {
                    meetings[j].push((at, other, s));
                }
            }
        }
        let mut pairs = Vec::new();
        for (j, mut meetings) in meetings.into_iter().enumerate() {
            meetings.sort_unstable();
            let same = meetings.chunk_by(|one, other| (one.0, one.1) == (other.0, other.1));
            pairs.extend(same.map(|meetings| Pair {
                j,
                own: self.directions[i][meetings[0].0].0,
                other: meetings[0].1,
                both: meetings.iter().map(|&(_, _, s)| s).collect(),
            }));
        }
        pairs
    }
}

impl Product {
    /// The two factors of a term off the diagonal: what is used often is kept together.
    fn halves(&self, pool: &mut Pool, uses: &Uses) -> [ExprId; 2] {
        let often = |factor| {
            uses.get(&(factor, self.own))
                .is_some_and(|&n| n >= WORTHWHILE)
        };
        if often(self.scaled) {
            let own = pool.mul(self.scaled, self.own);
            [pool.group(own), self.varying]
        } else if often(self.inertia) {
            let own = pool.mul(self.inertia, self.own);
            [pool.group(own), pool.group(self.other)]
        } else {
            [pool.mul(self.inertia, self.own), self.other]
        }
    }
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
