//! Energies → mass matrix and forcing, by the Euler–Lagrange equations
//!
//! ```text
//! d/dt ∂L/∂vᵢ − ∂L/∂qᵢ = Qᵢ,  L = T − V     ⇒     M v̇ = f
//! Mᵢⱼ = ∂²T/∂vᵢ∂vⱼ        fᵢ = ∂L/∂qᵢ − (d/dt ∂T/∂vᵢ) at v̇ = 0
//! ```
//!
//! (Goldstein, Poole & Safko 2002, section 1.4; Lanczos 1970, chapter V). Where T = ½ vᵀM v + b·v + T₀ is
//! quadratic, f can be had in a second form from the simplified M, in which what cancels between the two terms
//! above never appears (Christoffel symbols of the first kind; Lanczos 1970, section I.5):
//!
//! ```text
//! fᵢ = −Σⱼₖ (∂Mᵢⱼ/∂qₖ − ½ ∂Mⱼₖ/∂qᵢ) vⱼvₖ − Σⱼ (∂Mᵢⱼ/∂t + ∂bᵢ/∂qⱼ − ∂bⱼ/∂qᵢ) vⱼ − ∂bᵢ/∂t + ∂T₀/∂qᵢ − ∂V/∂qᵢ
//! ```

use super::forms::{Variables, cheapest};
use super::needs::Needs;
use super::{NeedId, needs};
use crate::model::System;
use crate::symbolic::{ExprId, Pool};
use std::collections::BTreeMap;

/// Up to this many coordinates the Christoffel form is tried: its terms grow like n³.
const CHRISTOFFEL_LIMIT: usize = 8;

/// All energy under one need.
pub(super) struct Group {
    /// Need of its contributions to M and f.
    pub need: NeedId,
    /// T
    pub kinetic: ExprId,
    /// V
    pub potential: ExprId,
}

/// The equations of motion that one [`Group`] contributes.
pub(super) struct Inertia {
    /// Need of its contributions.
    pub need: NeedId,
    /// T in its cheapest form.
    pub kinetic: ExprId,
    /// V in its cheapest form.
    pub potential: ExprId,
    /// (i, ∂T/∂vᵢ), zeros left out.
    pub momenta: Vec<(usize, ExprId)>,
    /// ((i, j ≤ i), Mᵢⱼ), zeros left out.
    pub mass: BTreeMap<(usize, usize), ExprId>,
    /// (i, fᵢ), zeros left out.
    pub forcing: Vec<(usize, ExprId)>,
    /// Whether M is free of velocities.
    pub quadratic: bool,
}

/// Sums up the energies that share a need.
pub(super) fn groups(system: &mut System, needs: &Needs) -> Vec<Group> {
    let mut terms: BTreeMap<NeedId, [Vec<ExprId>; 2]> = BTreeMap::new();
    terms.insert(needs::ALWAYS, Default::default());
    for (term, &need) in system.kinetic.iter().zip(&needs.kinetic) {
        terms.entry(need).or_default()[0].push(term.energy);
    }
    for (term, &need) in system.potential.iter().zip(&needs.potential) {
        terms.entry(need).or_default()[1].push(term.energy);
    }
    let pool = &mut system.pool;
    terms
        .into_iter()
        .map(|(need, [kinetic, potential])| Group {
            need,
            kinetic: pool.sum(&kinetic),
            potential: pool.sum(&potential),
        })
        .collect()
}

/// The Euler–Lagrange equations of one group.
pub(super) fn derive(pool: &mut Pool, x: &Variables, group: &Group) -> Inertia {
    let moving = x.velocities_in(pool, group.kinetic);
    let raw_momenta: Vec<(usize, ExprId)> =
        moving.iter().map(|&i| (i, pool.differentiate(group.kinetic, x.velocities[i]))).collect();

    let mut raw_mass = BTreeMap::new();
    for &(i, p) in &raw_momenta {
        for j in x.velocities_in(pool, p).into_iter().filter(|&j| j <= i) {
            raw_mass.insert((i, j), pool.differentiate(p, x.velocities[j]));
        }
    }
    let mut mass = BTreeMap::new();
    for (&place, &entry) in &raw_mass {
        let entry = pool.simplify(entry);
        if !pool.is_zero(entry) {
            mass.insert(place, entry);
        }
    }
    let quadratic = mass.values().all(|&entry| x.velocities_in(pool, entry).is_empty());
    let expansion = quadratic.then(|| Expansion::new(pool, x, group.kinetic, &raw_momenta, &mass));

    let potential = pool.simplify(group.potential);
    let conservative: Vec<ExprId> = (0..x.len())
        .map(|i| {
            let slope = pool.differentiate(potential, x.positions[i]);
            pool.neg(slope)
        })
        .collect();

    let direct = direct_form(pool, x, group.kinetic, &raw_momenta);
    let mut forms = Vec::new();
    if let Some(expansion) = &expansion
        && moving.len() <= CHRISTOFFEL_LIMIT
    {
        let inertial = expansion.christoffel_form(pool, x);
        forms.push(total(pool, &inertial, &conservative));
    }
    let simple = total(pool, &direct, &conservative);
    forms.push(simple);
    if x.len() > CHRISTOFFEL_LIMIT {
        // Large systems share more before each entry is simplified on its own.
        forms.push((0..x.len()).map(|i| pool.add(direct[i], conservative[i])).collect());
    }
    let company: Vec<ExprId> = mass.values().copied().collect();
    let forcing = cheapest(pool, &company, forms);

    let (kinetic, momenta) = match &expansion {
        Some(expansion) => expansion.energy_and_momenta(pool, x, group.kinetic, &raw_momenta),
        None => {
            let kinetic = pool.simplify(group.kinetic);
            (kinetic, raw_momenta.iter().map(|&(i, p)| (i, pool.simplify(p))).collect())
        }
    };
    Inertia {
        need: group.need,
        kinetic,
        potential,
        momenta: momenta.into_iter().filter(|&(_, p)| !pool.is_zero(p)).collect(),
        mass,
        forcing: forcing.into_iter().enumerate().filter(|&(_, f)| !pool.is_zero(f)).collect(),
        quadratic,
    }
}

/// ∂T/∂qᵢ − (d/dt ∂T/∂vᵢ) at v̇ = 0, term by term.
fn direct_form(pool: &mut Pool, x: &Variables, kinetic: ExprId, momenta: &[(usize, ExprId)]) -> Vec<ExprId> {
    let mut forcing: Vec<ExprId> = x.positions.iter().map(|&q| pool.differentiate(kinetic, q)).collect();
    for &(i, p) in momenta {
        let rate = x.rate(pool, p);
        forcing[i] = pool.sub(forcing[i], rate);
    }
    forcing
}

/// Inertial and conservative parts together, each entry simplified.
fn total(pool: &mut Pool, inertial: &[ExprId], conservative: &[ExprId]) -> Vec<ExprId> {
    inertial
        .iter()
        .zip(conservative)
        .map(|(&a, &b)| {
            let sum = pool.add(a, b);
            pool.simplify(sum)
        })
        .collect()
}

/// T = ½ vᵀM v + b·v + T₀ with simplified coefficients.
struct Expansion<'a> {
    mass: &'a BTreeMap<(usize, usize), ExprId>,
    linear: BTreeMap<usize, ExprId>,
    rest: ExprId,
}

impl<'a> Expansion<'a> {
    fn new(
        pool: &mut Pool,
        x: &Variables,
        kinetic: ExprId,
        momenta: &[(usize, ExprId)],
        mass: &'a BTreeMap<(usize, usize), ExprId>,
    ) -> Self {
        let mut linear = BTreeMap::new();
        for &(i, p) in momenta {
            let b = x.at_rest(pool, p);
            let b = pool.simplify(b);
            if !pool.is_zero(b) {
                linear.insert(i, b);
            }
        }
        let rest = x.at_rest(pool, kinetic);
        Self { mass, linear, rest: pool.simplify(rest) }
    }

    /// Mᵢⱼ for any order of i and j.
    fn entry(&self, i: usize, j: usize) -> Option<ExprId> {
        self.mass.get(&(i.max(j), i.min(j))).copied()
    }

    /// The forcing by Christoffel symbols of the simplified mass matrix, without potential.
    fn christoffel_form(&self, pool: &mut Pool, x: &Variables) -> Vec<ExprId> {
        (0..x.len())
            .map(|i| {
                let mut terms = Vec::new();
                for j in 0..x.len() {
                    for k in 0..=j {
                        let coefficient = self.christoffel(pool, x, i, j, k);
                        terms.push(pool.product(&[coefficient, x.rates[j], x.rates[k]]));
                    }
                    let coefficient = self.gyroscopic(pool, x, i, j);
                    terms.push(pool.mul(coefficient, x.rates[j]));
                }
                if let Some(&b) = self.linear.get(&i) {
                    terms.push(pool.differentiate(b, x.time));
                }
                let inertial = pool.sum(&terms);
                let centrifugal = pool.differentiate(self.rest, x.positions[i]);
                pool.sub(centrifugal, inertial)
            })
            .collect()
    }

    /// Coefficient of vⱼvₖ, k ≤ j: the Christoffel symbol, twice for j ≠ k since both orders occur.
    fn christoffel(&self, pool: &mut Pool, x: &Variables, i: usize, j: usize, k: usize) -> ExprId {
        let mut slope = |row: usize, column: usize, by: usize| match self.entry(row, column) {
            Some(entry) => pool.differentiate(entry, x.positions[by]),
            None => x.zero,
        };
        let (a, b, c) = (slope(i, j, k), slope(i, k, j), slope(j, k, i));
        let sum = pool.add(a, b);
        let twice = pool.sub(sum, c);
        let coefficient = if j == k { half(pool, twice) } else { twice };
        pool.simplify(coefficient)
    }

    /// Coefficient of vⱼ: ∂Mᵢⱼ/∂t + ∂bᵢ/∂qⱼ − ∂bⱼ/∂qᵢ.
    fn gyroscopic(&self, pool: &mut Pool, x: &Variables, i: usize, j: usize) -> ExprId {
        let mut terms = Vec::new();
        if let Some(entry) = self.entry(i, j) {
            terms.push(pool.differentiate(entry, x.time));
        }
        if let Some(&b) = self.linear.get(&i) {
            terms.push(pool.differentiate(b, x.positions[j]));
        }
        if let Some(&b) = self.linear.get(&j) {
            let slope = pool.differentiate(b, x.positions[i]);
            terms.push(pool.neg(slope));
        }
        let sum = pool.sum(&terms);
        pool.simplify(sum)
    }

    /// T and ∂T/∂v: as declared and simplified, or put together again from M, b and T₀.
    fn energy_and_momenta(
        &self,
        pool: &mut Pool,
        x: &Variables,
        kinetic: ExprId,
        momenta: &[(usize, ExprId)],
    ) -> (ExprId, Vec<(usize, ExprId)>) {
        let mut rebuilt = Vec::new();
        for &(i, _) in momenta {
            let mut row: Vec<ExprId> = (0..x.len())
                .filter_map(|j| self.entry(i, j).map(|entry| pool.mul(entry, x.rates[j])))
                .collect();
            row.extend(self.linear.get(&i));
            let sum = pool.sum(&row);
            rebuilt.push(pool.simplify(sum));
        }
        let declared: Vec<ExprId> = momenta.iter().map(|&(_, p)| pool.simplify(p)).collect();
        let momenta_form = cheapest(pool, &[], vec![rebuilt, declared]);

        let mut terms = vec![self.rest];
        for (&(i, j), &entry) in self.mass {
            let product = pool.product(&[entry, x.rates[i], x.rates[j]]);
            terms.push(if i == j { half(pool, product) } else { product });
        }
        for (&i, &b) in &self.linear {
            terms.push(pool.mul(b, x.rates[i]));
        }
        let sum = pool.sum(&terms);
        let rebuilt = pool.simplify(sum);
        let declared = pool.simplify(kinetic);
        let energy = cheapest(pool, &[], vec![vec![rebuilt], vec![declared]]);
        let momenta = momenta.iter().zip(momenta_form).map(|(&(i, _), p)| (i, p)).collect();
        (energy[0], momenta)
    }
}

fn half(pool: &mut Pool, e: ExprId) -> ExprId {
    pool.scale(e, crate::symbolic::Rational::new(1, 2))
}
