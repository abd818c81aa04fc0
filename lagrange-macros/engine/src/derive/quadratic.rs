//! T = ½ vᵀM v + b·v + T₀ → forcing, energy and momenta from the simplified M, b and T₀.
//!
//! ```text
//! fᵢ = −Σⱼₖ (∂Mᵢⱼ/∂qₖ − ½ ∂Mⱼₖ/∂qᵢ) vⱼvₖ − Σⱼ (∂Mᵢⱼ/∂t + ∂bᵢ/∂qⱼ − ∂bⱼ/∂qᵢ) vⱼ − ∂bᵢ/∂t + ∂T₀/∂qᵢ
//! ```
//!
//! the Christoffel symbols of the first kind of the metric M, the gyroscopic and the centrifugal terms (Lanczos
//! 1970, section I.5; Goldstein, Poole & Safko 2002, section 8.1). What cancels between ∂T/∂q and d/dt ∂T/∂v
//! never appears in this form.

use super::forms::{Variables, cheapest};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Pool, Rational};

/// With more coordinates than this, entries of f and p are not multiplied out: the terms grow like n³.
pub(super) const LARGE: usize = 8;

/// Most derivatives of M that the form by Christoffel symbols is tried with.
const BUDGET: usize = 20_000;

/// Coefficients of a quadratic kinetic energy, simplified, zeros left out.
pub(super) struct Quadratic<'a> {
    /// ((i, j ≤ i), Mᵢⱼ)
    mass: &'a SortedMap<(usize, usize), ExprId>,
    /// (i, bᵢ)
    linear: SortedMap<usize, ExprId>,
    /// T₀
    rest: ExprId,
}

/// Terms of one fᵢ, by the velocities that multiply them: none, vⱼ, or vⱼvₖ with k ≤ j.
type ByVelocities = SortedMap<Vec<usize>, Vec<ExprId>>;

impl<'a> Quadratic<'a> {
    /// Expands T, whose momenta ∂T/∂v and mass matrix are known, at v = 0.
    pub fn new(
        pool: &mut Pool,
        x: &Variables,
        kinetic: ExprId,
        momenta: &[(usize, ExprId)],
        mass: &'a SortedMap<(usize, usize), ExprId>,
    ) -> Self {
        let mut linear = SortedMap::new();
        for &(i, p) in momenta {
            let b = x.at_rest(pool, p);
            let b = pool.simplify(b);
            if !pool.is_zero(b) {
                linear.insert(i, b);
            }
        }
        let rest = x.at_rest(pool, kinetic);
        Self {
            mass,
            linear,
            rest: pool.simplify(rest),
        }
    }

    /// M, b and T₀.
    pub fn coefficients(&self) -> Vec<ExprId> {
        self.mass
            .values()
            .chain(self.linear.values())
            .chain([&self.rest])
            .copied()
            .collect()
    }

    /// v·∂T/∂v − T = ½ vᵀM v − T₀ by Euler's theorem on homogeneous functions, given T.
    pub fn motional(&self, pool: &mut Pool, x: &Variables, kinetic: ExprId) -> ExprId {
        if self.linear.is_empty() && pool.is_zero(self.rest) {
            return kinetic;
        }
        let linear: Vec<(usize, ExprId)> = self.linear.iter().map(|(&i, &b)| (i, b)).collect();
        let linear = x.along_velocity(pool, &linear);
        let difference = pool.linear(
            Rational::ZERO,
            vec![
                (kinetic, Rational::ONE),
                (linear, Rational::MINUS_ONE),
                (self.rest, Rational::integer(-2)),
            ],
        );
        pool.simplify(difference)
    }

    /// The inertial part of f; None if there are too many Christoffel symbols.
    pub fn forcing(&self, pool: &mut Pool, x: &Variables) -> Option<Vec<ExprId>> {
        let size: usize = self
            .mass
            .values()
            .map(|&entry| x.positions_in(pool, entry).len())
            .sum();
        if size > BUDGET {
            return None;
        }
        let mut forcing: Vec<ByVelocities> = vec![SortedMap::new(); x.len()];
        self.christoffel(pool, x, &mut forcing);
        self.gyroscopic(pool, x, &mut forcing);
        for k in x.positions_in(pool, self.rest) {
            let slope = pool.differentiate(self.rest, x.positions[k]);
            forcing[k].get_or_default(vec![]).push(slope);
        }
        Some(
            forcing
                .into_iter()
                .map(|by_velocities| assemble(pool, x, by_velocities))
                .collect(),
        )
    }

    /// Each entry of M feeds the equations of its row, of its column, and of the positions that it depends on.
    fn christoffel(&self, pool: &mut Pool, x: &Variables, forcing: &mut [ByVelocities]) {
        let mut put = |i: usize, j: usize, k: usize, e: ExprId| {
            forcing[i].get_or_default(vec![j.max(k), j.min(k)]).push(e);
        };
        for (&(i, j), &entry) in self.mass {
            if pool.is_full() {
                return;
            }
            for k in x.positions_in(pool, entry) {
                let slope = pool.differentiate(entry, x.positions[k]);
                let minus = pool.neg(slope);
                put(i, j, k, minus);
                if i == j {
                    put(k, i, i, half(pool, slope));
                } else {
                    put(j, i, k, minus);
                    put(k, i, j, slope);
                }
            }
        }
    }

    /// What b and the explicit time in M add.
    fn gyroscopic(&self, pool: &mut Pool, x: &Variables, forcing: &mut [ByVelocities]) {
        let mut put = |i: usize, by: Vec<usize>, e: ExprId| forcing[i].get_or_default(by).push(e);
        for (&(i, j), &entry) in self.mass {
            let rate = pool.differentiate(entry, x.time);
            let minus = pool.neg(rate);
            put(i, vec![j], minus);
            if i != j {
                put(j, vec![i], minus);
            }
        }
        for (&i, &b) in &self.linear {
            for k in x.positions_in(pool, b) {
                let slope = pool.differentiate(b, x.positions[k]);
                put(k, vec![i], slope);
                put(i, vec![k], pool.neg(slope));
            }
            let rate = pool.differentiate(b, x.time);
            put(i, vec![], pool.neg(rate));
        }
    }

    /// T and ∂T/∂v: as declared and simplified, or put together again from M, b and T₀.
    pub fn energy_and_momenta(
        &self,
        pool: &mut Pool,
        x: &Variables,
        kinetic: ExprId,
        momenta: &[(usize, ExprId)],
    ) -> (ExprId, Vec<(usize, ExprId)>) {
        let mut rebuilt_momenta: SortedMap<usize, Vec<ExprId>> = SortedMap::new();
        let mut rebuilt = vec![self.rest];
        for (&(i, j), &entry) in self.mass {
            let product = pool.product(&[entry, x.rates[i], x.rates[j]]);
            rebuilt.push(if i == j { half(pool, product) } else { product });
            rebuilt_momenta
                .get_or_default(i)
                .push(pool.mul(entry, x.rates[j]));
            if i != j {
                rebuilt_momenta
                    .get_or_default(j)
                    .push(pool.mul(entry, x.rates[i]));
            }
        }
        for (&i, &b) in &self.linear {
            rebuilt.push(pool.mul(b, x.rates[i]));
            rebuilt_momenta.get_or_default(i).push(b);
        }
        let rebuilt = pool.sum(&rebuilt);
        let cheaper = if momenta.len() <= LARGE {
            Pool::simplify
        } else {
            Pool::factor
        };
        let forms = [rebuilt, kinetic].map(|e| vec![cheaper(pool, e)]);
        let energy = cheapest(pool, &[], forms.into())[0];

        let mut forms = [Vec::new(), Vec::new()];
        for &(i, declared) in momenta {
            let rebuilt = pool.sum(rebuilt_momenta.get(&i).map_or(&[], Vec::as_slice));
            for (form, p) in forms.iter_mut().zip([rebuilt, declared]) {
                form.push(cheaper(pool, p));
            }
        }
        let chosen = cheapest(pool, &[], forms.into());
        (
            energy,
            momenta
                .iter()
                .zip(chosen)
                .map(|(&(i, _), p)| (i, p))
                .collect(),
        )
    }
}

/// Σ coefficient · velocities, each coefficient simplified.
fn assemble(pool: &mut Pool, x: &Variables, by_velocities: ByVelocities) -> ExprId {
    let mut terms = Vec::new();
    for (velocities, coefficient) in by_velocities {
        let coefficient = pool.sum(&coefficient);
        let mut factors = vec![pool.simplify(coefficient)];
        factors.extend(velocities.into_iter().map(|j| x.rates[j]));
        terms.push(pool.product(&factors));
    }
    pool.sum(&terms)
}

fn half(pool: &mut Pool, e: ExprId) -> ExprId {
    pool.scale(e, Rational::HALF)
}
