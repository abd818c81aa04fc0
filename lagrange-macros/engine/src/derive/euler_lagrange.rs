//! Energies → mass matrix and forcing, by the Euler–Lagrange equations
//!
//! ```text
//! d/dt ∂L/∂vᵢ − ∂L/∂qᵢ = Qᵢ,  L = T − V     ⇒     M v̇ = f
//! Mᵢⱼ = ∂²T/∂vᵢ∂vⱼ        fᵢ = ∂L/∂qᵢ − (d/dt ∂T/∂vᵢ) at v̇ = 0
//! ```
//!
//! (Goldstein, Poole & Safko 2002, section 1.4; Lanczos 1970, chapter V). For the turns of a body, whose rates ω are no rates
//! of coordinates, it is d/dt ∂L/∂ω + ω × ∂L/∂ω − ∂L/∂(turns) = Q (Whittaker 1904, section 30). Where T is quadratic in v there is a
//! second form of f, by Christoffel symbols ([`super::quadratic`]); the one with fewer operations is kept.

use super::NeedId;
use super::forms::{Variables, cheapest};
use super::needs::{ALWAYS, Needs};
use super::quadratic::{LARGE, Quadratic};
use super::squares::Squares;
use crate::model::System;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Node, Pool, Rational};

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
    /// v·∂T/∂v − T: the part of the Jacobi integral beyond V.
    pub motional: ExprId,
    /// What T depends on the positions by: M, b and T₀, or T itself where it is not quadratic.
    pub parts: Vec<ExprId>,
    /// V in its cheapest form.
    pub potential: ExprId,
    /// (i, ∂T/∂vᵢ), zeros left out.
    pub momenta: Vec<(usize, ExprId)>,
    /// ((i, j ≤ i), Mᵢⱼ), zeros left out.
    pub mass: SortedMap<(usize, usize), ExprId>,
    /// (i, fᵢ), zeros left out.
    pub forcing: Vec<(usize, ExprId)>,
    /// Whether M is free of velocities.
    pub quadratic: bool,
}

/// Sums up the energies that share a need.
pub(super) fn groups(system: &mut System, needs: &Needs) -> Vec<Group> {
    let mut terms: SortedMap<NeedId, [Vec<ExprId>; 2]> = SortedMap::new();
    terms.insert(ALWAYS, Default::default());
    for (term, &need) in system.kinetic.iter().zip(&needs.kinetic) {
        terms.get_or_default(need)[0].push(term.energy);
    }
    for (term, &need) in system.potential.iter().zip(&needs.potential) {
        terms.get_or_default(need)[1].push(term.energy);
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
    let large_system = moving.len() > LARGE || pool.holds_group(group.kinetic);
    if large_system
        && x.turns.is_empty()
        && let Some(squares) = Squares::of(pool, x, group.kinetic)
    {
        return large(pool, x, group, &squares);
    }
    let raw_momenta: Vec<(usize, ExprId)> = moving
        .iter()
        .map(|&i| (i, pool.differentiate(group.kinetic, x.velocities[i])))
        .collect();
    let mass = mass(pool, x, &raw_momenta);
    let quadratic = mass
        .values()
        .all(|&entry| x.velocities_in(pool, entry).is_empty());
    // Christoffel symbols are those of coordinates.
    let expansion = (quadratic && x.turns.is_empty())
        .then(|| Quadratic::new(pool, x, group.kinetic, &raw_momenta, &mass));
    let (potential, conservative) = conservative(pool, x, group.potential);

    let small = moving.len() <= LARGE;
    let mut forms = Vec::new();
    if let Some(inertial) = expansion
        .as_ref()
        .and_then(|expansion| expansion.forcing(pool, x))
    {
        forms.push(total(pool, &inertial, &conservative, Pool::factor));
        if small {
            forms.push(total(pool, &inertial, &conservative, Pool::simplify));
        }
    }
    if small || forms.is_empty() {
        let direct = direct_form(pool, x, group.kinetic, &raw_momenta);
        let cheaper = if small { Pool::simplify } else { Pool::factor };
        forms.push(total(pool, &direct, &conservative, cheaper));
    }
    let company: Vec<ExprId> = mass.values().copied().collect();
    let forcing = cheapest(pool, &company, forms);

    let energies = energies(pool, x, group.kinetic, &raw_momenta, expansion.as_ref());
    let mut momenta = energies.momenta;
    momenta.retain(|&(_, p)| !pool.is_zero(p));
    Inertia {
        need: group.need,
        kinetic: energies.kinetic,
        motional: energies.motional,
        parts: energies.parts,
        potential,
        momenta,
        mass,
        forcing: present(pool, forcing),
        quadratic,
    }
}

/// The equations of motion of one [`Group`] as a balance of forces.
pub(super) struct Balance {
    /// ((i, j ≤ i), Mᵢⱼ), zeros left out, made of what the balance is made of.
    pub mass: SortedMap<(usize, usize), ExprId>,
    /// Per coordinate: M v̇ − f.
    pub balance: Vec<ExprId>,
}

/// M v̇ − f of a system that is small enough for functions, the velocities whose squares make T left whole: d'Alembert's principle.
/// Its Taylor series have products in proportion to the number of bodies of a chain, those of M and f to its square.
pub(super) fn balance(pool: &mut Pool, x: &Variables, group: &Group) -> Option<Balance> {
    // Two bodies have as many products either way.
    if !(3..=LARGE).contains(&x.len()) || !x.turns.is_empty() {
        return None;
    }
    let (inertial, mass) = match pool.is_zero(group.kinetic) {
        true => (vec![x.zero; x.len()], SortedMap::new()),
        false => {
            let squares = Squares::of(pool, x, group.kinetic)?;
            (squares.balance(pool, x), squares.mass(pool, x))
        }
    };
    let (_, conservative) = conservative(pool, x, group.potential);
    let pairs = inertial.into_iter().zip(conservative);
    let balance = pairs.map(|(a, b)| pool.sub(a, b)).collect();
    Some(Balance { mass, balance })
}

/// ((i, j ≤ i), ∂pᵢ/∂vⱼ) simplified, zeros left out.
fn mass(
    pool: &mut Pool,
    x: &Variables,
    momenta: &[(usize, ExprId)],
) -> SortedMap<(usize, usize), ExprId> {
    let mut raw = SortedMap::new();
    for &(i, p) in momenta {
        if pool.is_full() {
            break;
        }
        for j in x.velocities_in(pool, p).into_iter().filter(|&j| j <= i) {
            raw.insert((i, j), pool.differentiate(p, x.velocities[j]));
        }
    }
    let mut mass = SortedMap::new();
    for (place, entry) in raw {
        let entry = pool.simplify(entry);
        if !pool.is_zero(entry) {
            mass.insert(place, entry);
        }
    }
    mass
}

/// T, ∂T/∂v, v·∂T/∂v − T, and what T depends on the positions by.
struct Energies {
    kinetic: ExprId,
    momenta: Vec<(usize, ExprId)>,
    motional: ExprId,
    parts: Vec<ExprId>,
}

fn energies(
    pool: &mut Pool,
    x: &Variables,
    kinetic: ExprId,
    momenta: &[(usize, ExprId)],
    expansion: Option<&Quadratic>,
) -> Energies {
    if let Some(expansion) = expansion {
        let (kinetic, momenta) = expansion.energy_and_momenta(pool, x, kinetic, momenta);
        return Energies {
            kinetic,
            momenta,
            motional: expansion.motional(pool, x, kinetic),
            parts: expansion.coefficients(),
        };
    }
    let kinetic = pool.simplify(kinetic);
    let momenta: Vec<_> = momenta
        .iter()
        .map(|&(i, p)| (i, pool.simplify(p)))
        .collect();
    let along = x.along_velocity(pool, &momenta);
    let motional = pool.sub(along, kinetic);
    Energies {
        kinetic,
        momenta,
        motional: pool.simplify(motional),
        parts: vec![kinetic],
    }
}

/// The equations of motion of a large system whose T is a sum of squares.
fn large(pool: &mut Pool, x: &Variables, group: &Group, squares: &Squares) -> Inertia {
    let (potential, conservative) = conservative(pool, x, group.potential);
    let inertial = squares.forcing(pool, x);
    let forcing = total(pool, &inertial, &conservative, Pool::factor);
    let mass = squares.mass(pool, x);
    let kinetic = squares.energy(pool);
    Inertia {
        need: group.need,
        kinetic,
        motional: kinetic,
        parts: mass.values().copied().collect(),
        potential,
        momenta: squares.momenta(pool),
        mass,
        forcing: present(pool, forcing),
        quadratic: true,
    }
}

/// V in its cheapest form, and −∂V/∂q.
fn conservative(pool: &mut Pool, x: &Variables, potential: ExprId) -> (ExprId, Vec<ExprId>) {
    let potential = pool.simplify(potential);
    // Term by term: most terms of a large V know few of the positions.
    let terms = match pool.node(potential) {
        Node::Sum { terms, .. } => terms.clone(),
        _ => vec![(potential, Rational::ONE)],
    };
    let mut slopes = vec![Vec::new(); x.len()];
    for (term, number) in terms {
        for i in x.positions_in(pool, term) {
            let slope = x.slope(pool, term, i);
            slopes[i].push(pool.scale(slope, number));
        }
    }
    let forces = slopes.into_iter().map(|slopes| {
        let slope = pool.sum(&slopes);
        pool.neg(slope)
    });
    let forces = forces.collect();
    (potential, forces)
}

/// (i, fᵢ), zeros left out.
fn present(pool: &Pool, forcing: Vec<ExprId>) -> Vec<(usize, ExprId)> {
    forcing
        .into_iter()
        .enumerate()
        .filter(|&(_, f)| !pool.is_zero(f))
        .collect()
}

/// ∂T/∂qᵢ − (d/dt ∂T/∂vᵢ) at v̇ = 0, term by term; less ω × ∂T/∂ω for the turns of a body.
fn direct_form(
    pool: &mut Pool,
    x: &Variables,
    kinetic: ExprId,
    momenta: &[(usize, ExprId)],
) -> Vec<ExprId> {
    let mut forcing: Vec<ExprId> = (0..x.len()).map(|i| x.slope(pool, kinetic, i)).collect();
    for &(i, p) in momenta {
        let rate = x.rate(pool, p);
        forcing[i] = pool.sub(forcing[i], rate);
    }
    for &first in &x.turns {
        let momentum = |k: usize| momenta.iter().find(|&&(i, _)| i == first + k);
        let spin = [0, 1, 2].map(|k| momentum(k).map_or(x.zero, |&(_, p)| p));
        let rates = [0, 1, 2].map(|k| x.rates[first + k]);
        for k in 0..3 {
            let [next, last] = [(k + 1) % 3, (k + 2) % 3];
            let carried = [
                pool.mul(rates[next], spin[last]),
                pool.mul(rates[last], spin[next]),
            ];
            let carried = pool.sub(carried[0], carried[1]);
            forcing[first + k] = pool.sub(forcing[first + k], carried);
        }
    }
    forcing
}

/// Inertial and conservative parts together, each entry brought into a cheaper form.
fn total(
    pool: &mut Pool,
    inertial: &[ExprId],
    conservative: &[ExprId],
    cheaper: fn(&mut Pool, ExprId) -> ExprId,
) -> Vec<ExprId> {
    inertial
        .iter()
        .zip(conservative)
        .map(|(&a, &b)| {
            let sum = pool.add(a, b);
            cheaper(pool, sum)
        })
        .collect()
}
