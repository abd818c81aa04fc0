//! Random real states of a mode, in floating point with error bounds: where a claim can be seen to fail.

use super::arithmetic::Arithmetic;
use super::bounded::{Bounded, Floating};
use super::linear::solve;
use super::mechanics::Mechanics;
use super::motion::{Tie, accelerations, velocities};
use super::stuck::Stuck;
use super::surface::Sheet;
use crate::model::{Normal, Premise};
use crate::modes::{FrictionState, Mode, Sign};
use crate::sorted::SortedMap;
use crate::symbolic::field::Trouble;
use crate::symbolic::{ExprId, Pool, Symbol};

/// Where states are looked for.
pub(super) struct Region<'a> {
    pub mechanics: &'a Mechanics<'a>,
    pub mode: &'a Mode,
    pub ties: &'a [Tie],
    pub premises: &'a [Premise],
    /// Guards of all branches.
    pub guards: &'a [ExprId],
    pub time: Symbol,
    /// How positions are found.
    pub positions: Positions<'a>,
}

/// How positions on the surface are found.
pub(super) enum Positions<'a> {
    /// As solved exactly.
    Solved(&'a [Sheet]),
    /// By Newton's iteration.
    Iterated(&'a Newton),
}

/// Equations and their derivatives.
pub(super) struct Newton {
    pub equations: Vec<ExprId>,
    /// Coordinates, and what conditions bind beside them.
    pub unknowns: Vec<Symbol>,
    /// Per equation and unknown.
    pub slopes: Vec<Vec<ExprId>>,
}

/// A state with its accelerations and forces.
pub(super) struct State<'a> {
    pub numbers: Floating<'a>,
    /// Gaps are open, forces push, and friction holds.
    pub feasible: bool,
    /// What the mode does not determine.
    pub undetermined: Vec<Symbol>,
}

/// The state of a seed; not every seed has one.
pub(super) fn sample<'a>(pool: &Pool, region: &Region<'a>, seed: u64) -> Result<State<'a>, Stuck> {
    let mechanics = region.mechanics;
    let mut random = fastrand::Rng::with_seed(seed);
    let mut numbers = Floating {
        symbols: SortedMap::new(),
        guards: region.guards,
    };
    for &symbol in &mechanics.parameters {
        numbers.bind(symbol, two_digits(&mut random, 0.3, 2.5));
    }
    numbers.bind(region.time, two_digits(&mut random, 0.0, 2.0));
    // Every other state is a small and slow one; a few are far away, where a branch may switch.
    let reach = match seed % 16 {
        5 => 20.0,
        11 => 200.0,
        15 => 2000.0,
        even if even.is_multiple_of(2) => 0.6,
        _ => 2.0,
    };
    for &[q, v, _] in &mechanics.coordinates {
        numbers.bind(q, two_digits(&mut random, -reach, reach));
        numbers.bind(v, two_digits(&mut random, -reach, reach));
    }
    let speeds: Vec<Symbol> = mechanics.coordinates.iter().map(|q| q[1]).collect();
    let moves = |e: ExprId| pool.depends_on_any(e, &speeds);
    let active = region.mode.acting_rows(mechanics.system);
    match region.positions {
        Positions::Iterated(newton) => {
            iterate(pool, mechanics, newton, &mut numbers)?;
            velocities(&mut numbers, pool, mechanics, &active, region.ties)?;
        }
        Positions::Solved(sheets) => {
            let sheet = &sheets[(seed / 2) as usize % sheets.len()];
            for moving in [false, true] {
                for &(symbol, e) in sheet.solved.iter().filter(|&&(_, e)| moves(e) == moving) {
                    let value = numbers.values(pool, &[e])?[0];
                    if mechanics.parameters.contains(&symbol) && value.value <= 0.0 {
                        return Err(Trouble::NotSquare.into());
                    }
                    numbers.bind(symbol, value);
                }
                if !moving {
                    velocities(&mut numbers, pool, mechanics, &active, region.ties)?;
                }
            }
        }
    }
    // What the mode does not determine may be anything, and fulfils by chance no claim that depends on it.
    let accelerations_and_forces = mechanics.coordinates.iter().map(|q| q[2]);
    for symbol in accelerations_and_forces.chain(mechanics.rows.iter().map(|row| row.force)) {
        numbers.bind(symbol, Bounded::exactly(0.3 + random.f64()));
    }
    let undetermined = accelerations(&mut numbers, pool, mechanics, region.mode)?;
    for premise in region.premises {
        if let Premise::AtLeast(e) = *premise
            && numbers.values(pool, &[e])?[0].value < 0.0
        {
            return Err(Trouble::NotSquare.into());
        }
    }
    // The direction of a slip belongs to the mode.
    for (friction, state) in mechanics.frictions.iter().zip(&region.mode.frictions) {
        if let Some(forward) = state.is_forward() {
            let slip = mechanics.rows[friction.rows[0]].velocity;
            if (numbers.values(pool, &[slip])?[0].value > 0.0) != forward {
                return Err(Trouble::NotSquare.into());
            }
        }
    }
    let feasible = feasible(pool, region, &mut numbers)?;
    Ok(State {
        numbers,
        feasible,
        undetermined,
    })
}

/// Positions on the surface near those that are bound (Gauss–Newton, least change).
fn iterate(
    pool: &Pool,
    mechanics: &Mechanics,
    newton: &Newton,
    numbers: &mut Floating,
) -> Result<(), Stuck> {
    const STEPS: usize = 30;
    const CLOSE: f64 = 1e-13;
    let slopes: Vec<ExprId> = newton.slopes.iter().flatten().copied().collect();
    let plain = |values: Vec<Bounded>| values.into_iter().map(|b| Bounded::exactly(b.value));
    for _ in 0..STEPS {
        let defects: Vec<Bounded> = plain(numbers.values(pool, &newton.equations)?).collect();
        let slopes: Vec<Bounded> = plain(numbers.values(pool, &slopes)?).collect();
        let rows: Vec<&[Bounded]> = slopes.chunks(newton.unknowns.len()).collect();
        let weights = weights(numbers, &rows, &defects)?;
        let mut largest: f64 = 0.0;
        for (j, &unknown) in newton.unknowns.iter().enumerate() {
            let rows = rows.iter().zip(&weights);
            let change: f64 = rows.map(|(row, y)| row[j].value * y.value).sum();
            let value = numbers.symbol(unknown).value - change;
            largest = largest.max(change.abs() / (1.0 + value.abs()));
            if mechanics.parameters.contains(&unknown) && value <= 0.0 {
                return Err(Trouble::NotSquare.into());
            }
            numbers.bind(
                unknown,
                Bounded {
                    value,
                    error: CLOSE * (1.0 + value.abs()),
                },
            );
        }
        if largest < 0.1 * CLOSE {
            // Equations that contradict each other have a nearest point too.
            let defects = numbers.values(pool, &newton.equations)?;
            return match defects.iter().all(|&defect| numbers.size(defect) == 0.0) {
                true => Ok(()),
                false => Err(Stuck::Impossible),
            };
        }
    }
    Err(Trouble::Division.into())
}

/// y of the least change −Jᵀy that takes the defects away: J Jᵀ y = defects. Where rows of J depend on one another, J Jᵀ is damped (Levenberg 1944), which
/// leaves out what no change takes away.
fn weights(
    numbers: &Floating,
    rows: &[&[Bounded]],
    defects: &[Bounded],
) -> Result<Vec<Bounded>, Stuck> {
    let zero = Bounded::exactly(0.0);
    let dot = |a: &[Bounded], b: &[Bounded]| {
        let products = a.iter().zip(b).map(|(&a, &b)| numbers.mul(a, b));
        products.fold(zero, |sum, product| numbers.add(sum, product))
    };
    let gram = rows.iter().zip(defects).map(|(row, &defect)| {
        let products = rows.iter().map(|other| dot(row, other));
        products.chain([defect]).collect()
    });
    let mut gram: Vec<Vec<Bounded>> = gram.collect();
    let zeros = vec![zero; rows.len()];
    if let Some(solution) = solve(numbers, gram.clone(), &zeros)?
        && solution.rank == rows.len()
    {
        return Ok(solution.x);
    }
    let trace: f64 = gram.iter().enumerate().map(|(i, row)| row[i].value).sum();
    let damping = Bounded::exactly(f64::EPSILON.sqrt() * trace);
    for (i, row) in gram.iter_mut().enumerate() {
        row[i] = numbers.add(row[i], damping);
    }
    let damped = solve(numbers, gram, &zeros)?.ok_or(Stuck::Impossible)?;
    Ok(damped.x)
}

fn feasible(pool: &Pool, region: &Region, numbers: &mut Floating) -> Result<bool, Stuck> {
    let (mechanics, mode) = (region.mechanics, region.mode);
    let mut at_least =
        |e: ExprId| -> Result<bool, Stuck> { Ok(numbers.values(pool, &[e])?[0].value >= 0.0) };
    for (i, &closed) in mode.contacts.iter().enumerate() {
        let row = &mechanics.rows[mechanics.system.contact_row(i)];
        let gap = row.position.filter(|_| !closed);
        let edge = mechanics.contacts[i].1.filter(|_| closed);
        for e in gap.into_iter().chain(edge) {
            if !at_least(e)? {
                return Ok(false);
            }
        }
    }
    let force = |numbers: &Floating, row: usize| numbers.symbol(mechanics.rows[row].force).value;
    for (i, &closed) in mode.contacts.iter().enumerate() {
        if closed && force(numbers, mechanics.system.contact_row(i)) < 0.0 {
            return Ok(false);
        }
    }
    for (friction, &state) in mechanics.frictions.iter().zip(&mode.frictions) {
        let normal = match friction.normal {
            Normal::Given(e) => numbers.values(pool, &[e])?[0].value,
            Normal::Contact(i) => {
                let factor = match mechanics.contacts[i].0 {
                    None => 1.0,
                    Some(e) => numbers.values(pool, &[e])?[0].value,
                };
                factor * force(numbers, mechanics.system.contact_row(i))
            }
            Normal::Constraint(i) => {
                let sign = match force(numbers, i) >= 0.0 {
                    true => Sign::Positive,
                    false => Sign::Negative,
                };
                if state.slips() && sign != mode.normal_signs[i] {
                    return Ok(false);
                }
                force(numbers, i).abs()
            }
            Normal::Resultant(resultant) => {
                let constraints = mechanics.system.resultants[resultant].iter();
                let square: f64 = constraints.map(|&i| force(numbers, i).powi(2)).sum();
                square.sqrt()
            }
        };
        match state {
            FrictionState::Inactive | FrictionState::Slip(_) => {}
            FrictionState::Stick => {
                let most = numbers.values(pool, &[friction.static_coefficient])?[0].value * normal;
                let rows = friction.rows.iter();
                let square: f64 = rows.map(|&row| force(numbers, row).powi(2)).sum();
                if square.sqrt() > most {
                    return Ok(false);
                }
            }
        }
    }
    Ok(true)
}

/// A random number that a person can read: between two, rounded to hundredths, and not 0.
fn two_digits(random: &mut fastrand::Rng, from: f64, to: f64) -> Bounded {
    let hundredths = ((from + (to - from) * random.f64()) * 100.0).round();
    let hundredths = if hundredths == 0.0 { 1.0 } else { hundredths };
    Bounded::exactly(hundredths / 100.0)
}
