//! How the directions of velocities turn along a motion: what J̇ᵢ − ∂w/∂qᵢ = Σₖ (∂Jᵢ/∂qₖ − ∂Jₖ/∂qᵢ) vₖ is made of.
//!
//! It vanishes where w is the rate of a function of the positions. Of a component of an angular velocity it is made of the two others: that is
//! Euler's ω × I ω, and in general Hamel's coefficients (Hamel 1904; Greenwood 2003, Advanced Dynamics, section 4.3). Multiplied out this shows by itself;
//! where velocities are kept whole it is recognized by numbers, at some states without any relation.

use super::Square;
use crate::derive::forms::Variables;
use crate::symbolic::{ExprId, Pool, Symbol};

/// More coordinates, and more velocities, are left to the form.
const MOST_COORDINATES: usize = 32;
const MOST_VELOCITIES: usize = 512;

/// States at which numbers are compared.
const STATES: u32 = 3;

/// Change of a position for a difference quotient, and its error relative to derivatives.
const CHANGE: f64 = 1e-4;
const ERROR: f64 = 1e-5;

/// What is smaller beside others of its kind is rounding.
const VANISHING: f64 = 1e-12;

/// What J̇ᵢ − ∂w/∂qᵢ is.
#[derive(Clone, Copy)]
pub(super) enum Turning {
    /// 0
    Integrable,
    /// Jᵣᵢ wₜ − Jₜᵢ wᵣ, from two other squares r and t.
    With([usize; 2]),
    /// Whatever the form says.
    Unknown,
}

/// Slopes at one state.
struct Numbers {
    /// Per square: Jᵢ.
    slopes: Vec<Vec<f64>>,
    /// Per square: ∂Jᵢ/∂qₖ − ∂Jₖ/∂qᵢ, row by row.
    curls: Vec<Vec<f64>>,
    /// Per square: the largest |∂Jᵢ/∂qₖ|.
    sizes: Vec<f64>,
}

/// The turning of each square's velocity, where velocities in it are kept whole. Slopes that vanish there, as that of one axis along
/// another, are taken out.
pub(super) fn recognize(pool: &Pool, x: &Variables, squares: &mut [Square]) -> Vec<Turning> {
    let unknown = vec![Turning::Unknown; squares.len()];
    let slopes = squares.iter().flat_map(|square| &square.slopes);
    let slopes: Vec<ExprId> = slopes.map(|&(_, slope)| slope).collect();
    let depends = |&e: &ExprId| !pool.branches(e).is_empty() || pool.depends_on_any(e, &[x.time]);
    if x.len() > MOST_COORDINATES
        || squares.len() > MOST_VELOCITIES
        || squares.iter().all(|square| square.whole.is_none())
        || slopes.iter().any(depends)
    {
        return unknown;
    }
    let states = (0..STATES).map(|state| numbers(pool, x, squares, &slopes, state));
    let Some(states) = states.collect::<Option<Vec<Numbers>>>() else {
        return unknown;
    };
    for (s, square) in squares.iter_mut().enumerate() {
        let vanishes = |i: usize| {
            let of =
                |numbers: &Numbers| numbers.slopes[s][i].abs() <= VANISHING * numbers.largest(s);
            states.iter().all(of)
        };
        if square.whole.is_some() {
            square.slopes.retain(|&(i, _)| !vanishes(i));
        }
    }
    let turning = |(s, square): (usize, &Square)| match square.whole {
        Some(_) => turning(&states, s),
        None => Turning::Unknown,
    };
    squares.iter().enumerate().map(turning).collect()
}

/// Numbers at one state; none if one of them is not finite.
fn numbers(
    pool: &Pool,
    x: &Variables,
    squares: &[Square],
    slopes: &[ExprId],
    state: u32,
) -> Option<Numbers> {
    let n = x.len();
    let at = |moved: Option<(Symbol, f64)>| {
        let value = |symbol: Symbol| {
            // Irrational steps: no two symbols are in a simple ratio.
            let step =
                symbol.index() as f64 * 0.618_033_988_749 + f64::from(state) * 0.414_213_562_373;
            let change = moved.map_or(
                0.0,
                |(who, change)| if who == symbol { change } else { 0.0 },
            );
            0.4 + step.fract() + change
        };
        let values = pool.evaluate(slopes, &value, &|_| true);
        let mut values = values.into_iter();
        let of_square = |square: &Square| {
            let mut row = vec![0.0; n];
            for (&(i, _), value) in square.slopes.iter().zip(values.by_ref()) {
                row[i] = value;
            }
            row
        };
        squares.iter().map(of_square).collect::<Vec<Vec<f64>>>()
    };
    let here = at(None);
    let mut rates = vec![vec![0.0; n * n]; squares.len()];
    for (k, &position) in x.positions.iter().enumerate() {
        let [before, behind] = [-CHANGE, CHANGE].map(|change| at(Some((position, change))));
        for ((rates, before), behind) in rates.iter_mut().zip(before).zip(behind) {
            for i in 0..n {
                rates[i * n + k] = (behind[i] - before[i]) / (2.0 * CHANGE);
            }
        }
    }
    let largest = |rates: &Vec<f64>| {
        rates
            .iter()
            .fold(0.0, |largest: f64, x| largest.max(x.abs()))
    };
    let curl = |rates: &Vec<f64>| {
        let places = 0..n * n;
        places
            .map(|at| rates[at] - rates[at % n * n + at / n])
            .collect()
    };
    let finite = rates.iter().chain(&here).flatten().all(|x| x.is_finite());
    finite.then(|| Numbers {
        slopes: here,
        curls: rates.iter().map(curl).collect(),
        sizes: rates.iter().map(largest).collect(),
    })
}

impl Numbers {
    /// The largest slope of a square.
    fn largest(&self, s: usize) -> f64 {
        let slopes = self.slopes[s].iter();
        slopes.fold(0.0, |largest: f64, x| largest.max(x.abs()))
    }
}

fn turning(states: &[Numbers], s: usize) -> Turning {
    let vanishes = |numbers: &Numbers| {
        let curl = numbers.curls[s].iter();
        curl.copied().all(|x| x.abs() <= ERROR * numbers.sizes[s])
    };
    if states.iter().all(vanishes) {
        return Turning::Integrable;
    }
    let count = states[0].slopes.len();
    for first in 0..count {
        for second in 0..count {
            let is_it = |numbers: &Numbers| is_turn(numbers, s, [first, second]);
            if first != second && states.iter().all(is_it) {
                return Turning::With([first, second]);
            }
        }
    }
    Turning::Unknown
}

/// Whether the curl of square s is Jᵣᵢ Jₜₖ − Jₜᵢ Jᵣₖ.
fn is_turn(numbers: &Numbers, s: usize, [r, t]: [usize; 2]) -> bool {
    let (first, second) = (&numbers.slopes[r], &numbers.slopes[t]);
    let n = first.len();
    let mut places = numbers.curls[s].iter().enumerate();
    places.all(|(at, x)| {
        let (i, k) = (at / n, at % n);
        let (one, other) = (first[i] * second[k], second[i] * first[k]);
        (x - one + other).abs() <= ERROR * (numbers.sizes[s] + one.abs() + other.abs())
    })
}
