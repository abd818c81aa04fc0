//! Sums whose terms stand under needs: what a scene leaves out drops its terms at run time.

use crate::derive::{NeedId, Output};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Pool, Symbol};

/// The need that is always held.
pub(super) const ALWAYS: NeedId = NeedId(0);

/// Σ of one expression for each need; none of them is zero.
#[derive(Clone, Default, PartialEq, Eq, Debug)]
pub(super) struct Masked(SortedMap<NeedId, ExprId>);

impl Masked {
    /// One expression that is always there.
    pub fn always(pool: &Pool, e: ExprId) -> Masked {
        let mut sum = Masked::default();
        if !pool.is_zero(e) {
            sum.0.insert(ALWAYS, e);
        }
        sum
    }

    /// An output of the equations, with symbols replaced.
    pub fn of(pool: &mut Pool, output: &Output, known: &[(Symbol, ExprId)]) -> Masked {
        let mut sum = Masked::default();
        for &(need, e) in &output.terms {
            let e = pool.substitute(e, known);
            sum.add(pool, need, e);
        }
        sum
    }

    /// Adds a term.
    pub fn add(&mut self, pool: &mut Pool, need: NeedId, e: ExprId) {
        let whole = match self.0.get(&need) {
            Some(&before) => pool.add(before, e),
            None => e,
        };
        if pool.is_zero(whole) {
            self.0.remove(&need);
        } else {
            self.0.insert(need, whole);
        }
    }

    /// Adds `factor` times another sum.
    pub fn add_scaled(&mut self, pool: &mut Pool, factor: ExprId, other: &Masked) {
        for (&need, &e) in &other.0 {
            let e = pool.mul(factor, e);
            self.add(pool, need, e);
        }
    }

    /// The same with every term simplified.
    pub fn simplified(&self, pool: &mut Pool) -> Masked {
        let mut sum = Masked::default();
        for (&need, &e) in &self.0 {
            let e = pool.simplify(e);
            sum.add(pool, need, e);
        }
        sum
    }

    /// Whether it has no terms.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The expression, if nothing of it can be left out.
    pub fn whole(&self, pool: &mut Pool) -> Option<ExprId> {
        match self.0.iter().next() {
            None => Some(pool.integer(0)),
            Some((&ALWAYS, &e)) if self.0.len() == 1 => Some(e),
            Some(_) => None,
        }
    }

    /// The terms, by need.
    pub fn terms(&self) -> Vec<(NeedId, ExprId)> {
        self.0.iter().map(|(&need, &e)| (need, e)).collect()
    }
}
