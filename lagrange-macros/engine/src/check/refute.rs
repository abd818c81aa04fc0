//! The search for a state at which the two sides of a claim differ, and what is said about it.

use super::arithmetic::Arithmetic;
use super::bounded::Bounded;
use super::sample::{Region, State, sample};
use crate::model::Check;
use crate::symbolic::{ExprId, Pool, Symbol};

/// What a search has come to.
pub(super) enum Search {
    /// A state and both sides, in words.
    Counterexample(String),
    /// No difference at this many states.
    Nothing(usize),
    /// No state, because the mode does not determine this.
    Undetermined(Symbol),
}

/// A state with both sides.
struct Found<'a> {
    state: State<'a>,
    left: Bounded,
    right: Bounded,
}

/// Seeds that are tried, and states that are enough to say that a claim has been tested.
const SEEDS: u64 = 600;
const STATES: usize = 64;
/// A state that is possible in every respect is worth some search.
const PATIENCE: u64 = 200;

/// Looks for a difference. `certain`: it is known that there is one somewhere on the surface.
pub(super) fn search(
    pool: &mut Pool,
    region: &Region,
    check: &Check,
    applied: &[(Symbol, ExprId)],
    certain: bool,
) -> Search {
    let sides = [check.left, check.right].map(|e| pool.substitute(e, applied));
    let (mut states, mut undetermined) = (0, None);
    let mut ratios: Vec<f64> = Vec::new();
    let mut first: Option<Found> = None;
    // For a difference that is certain but small: the state that shows most of it.
    let mut largest: Option<(f64, Found)> = None;
    for seed in 1..=SEEDS {
        if states >= STATES || (first.is_some() && (ratios.len() >= 3 || seed > PATIENCE)) {
            break;
        }
        let Ok(mut state) = sample(pool, region, seed) else {
            continue;
        };
        let Ok(values) = state.numbers.values(pool, &sides) else {
            continue;
        };
        let (left, right) = (values[0], values[1]);
        let is_open = |symbol: &Symbol| sides.iter().any(|&e| pool.depends_on(e, *symbol));
        let open = state.undetermined.iter().copied().find(is_open);
        let found = Found { state, left, right };
        let differs = found.excess() > 1.0;
        if differs && open.is_some() {
            undetermined = open;
            continue;
        }
        if found.state.feasible {
            states += 1;
            if differs {
                ratios.push(left.value / right.value);
            }
        }
        let better = first
            .as_ref()
            .is_none_or(|first| !first.state.feasible && found.state.feasible);
        if differs && (found.state.feasible || certain) && better {
            first = Some(found);
        } else if certain
            && largest
                .as_ref()
                .is_none_or(|(most, _)| found.excess() > *most)
        {
            largest = Some((found.excess(), found));
        }
    }
    let found = first.or_else(|| largest.map(|(_, found)| found));
    match found {
        Some(found) => Search::Counterexample(words(
            pool,
            region,
            &sides,
            check.is_conserved,
            &found,
            &ratios,
        )),
        None if certain => Search::Counterexample(
            "the difference shows in exact arithmetic; no state to show it was found".to_owned(),
        ),
        None => match undetermined {
            Some(symbol) if states == 0 => Search::Undetermined(symbol),
            _ => Search::Nothing(states),
        },
    }
}

impl Found<'_> {
    /// The difference over what rounding can explain.
    fn excess(&self) -> f64 {
        let (left, right) = (self.left, self.right);
        let rounding = 16.0 * (left.error + right.error) + f64::MIN_POSITIVE;
        (left.value - right.value).abs() / rounding
    }
}

/// The state, both sides, and what can be said about their ratio.
fn words(
    pool: &Pool,
    region: &Region,
    sides: &[ExprId; 2],
    conserved: bool,
    found: &Found,
    ratios: &[f64],
) -> String {
    let values = printed(pool, region, sides).into_iter().map(|symbol| {
        let value = found.state.numbers.symbol(symbol).value;
        format!("{} = {}", pool.name(symbol), short(value))
    });
    let values = values.collect::<Vec<_>>().join(", ");
    let mut text = match values.is_empty() {
        true => "everywhere".to_owned(),
        false => format!("at {values}:"),
    };
    let (left, right) = (found.left.value, found.right.value);
    let [left_text, right_text] = distinct(left, right);
    if conserved {
        text += &format!(" its rate is {left_text}");
    } else if left_text == right_text {
        text += &format!(" both sides are {left_text} to within rounding, but they are not equal");
    } else {
        text += &format!(" the left side is {left_text}, the right side {right_text}");
    }
    if !found.state.feasible {
        text +=
            "; no such state was found in which gaps are open, contacts press and friction holds";
    }
    if let [first, rest @ ..] = ratios
        && rest.len() >= 2
        && rest.iter().all(|ratio| (ratio / first - 1.0).abs() < 1e-9)
        && first.is_finite()
        && !conserved
        && *first != 0.0
    {
        text += &match *first {
            r if (r + 1.0).abs() < 1e-9 => "; they differ in sign only".to_owned(),
            r => format!(
                "; the left side is always {} times the right side",
                short(r)
            ),
        };
    }
    text
}

/// What a reader needs to work both sides out.
fn printed(pool: &Pool, region: &Region, sides: &[ExprId; 2]) -> Vec<Symbol> {
    let mechanics = region.mechanics;
    let mut present: Vec<Symbol> = sides.iter().flat_map(|&e| pool.symbols(e)).collect();
    let solved = |symbol: &Symbol| {
        mechanics.coordinates.iter().any(|q| q[2] == *symbol)
            || mechanics.rows.iter().any(|row| row.force == *symbol)
    };
    if present.iter().any(solved) {
        let all = mechanics.expressions();
        present.extend(
            pool.iter_reachable(&all)
                .into_iter()
                .filter_map(|e| match pool.node(e) {
                    crate::symbolic::Node::Symbol(symbol) => Some(*symbol),
                    _ => None,
                }),
        );
    }
    let known = mechanics.parameters.iter().copied().chain([region.time]);
    let places = mechanics.coordinates.iter().map(|q| q[0]);
    let speeds = mechanics.coordinates.iter().map(|q| q[1]);
    let known = known.chain(places).chain(speeds);
    known.filter(|symbol| present.contains(symbol)).collect()
}

/// Up to six digits, without zeros at the end.
fn short(value: f64) -> String {
    digits(value, 6)
}

fn digits(value: f64, count: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = value.abs().log10().floor() as i32;
    if !(-4..count as i32).contains(&size) {
        return format!("{value:.*e}", count - 1);
    }
    let text = format!("{value:.*}", (count as i32 - 1 - size).max(0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// Two numbers with as many digits as it takes to tell them apart.
fn distinct(left: f64, right: f64) -> [String; 2] {
    let mut texts = [short(left), short(right)];
    for count in 7..=17 {
        if texts[0] != texts[1] {
            break;
        }
        texts = [left, right].map(|value| digits(value, count));
    }
    texts
}
