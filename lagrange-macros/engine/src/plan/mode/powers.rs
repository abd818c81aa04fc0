//! Powers that several operations make of one value, as √x, x √x and c/(x √x) are c xᵉ.
//!
//! ```text
//! k x₀ zₖ = e k xₖ z₀ + Σ (e j xⱼ zₖ₋ⱼ − j zⱼ xₖ₋ⱼ),  0 < j < k,        for z = c xᵉ
//! ```
//!
//! These are two products however many operations make z, and zₖ follows from xₖ in one of them rather than in a chain. Reference: Knuth,
//! The Art of Computer Programming 2, section 4.7 (Euler's rule for powers of series).

use super::ModeProgram;
use crate::plan::{Operation, Step, Value};
use crate::sorted::{SortedMap, SortedSet};
use crate::symbolic::Rational;

/// A value as a power of another one, but for a factor that does not change.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Power {
    /// x
    pub base: Value,
    /// e
    pub exponent: Rational,
    /// Whether x must be positive, not only different from zero.
    pub positive: bool,
}

/// A rule of its own takes two products: with so many operations at least it replaces as many.
const WORTHWHILE: usize = 2;

/// The values of a mode whose series are those of a power.
pub(super) fn powers(mode: &ModeProgram) -> SortedMap<Value, Power> {
    let varying = mode.varying();
    let mut all: SortedMap<Value, Power> = SortedMap::new();
    let mut steps: SortedMap<Value, (usize, &Step)> = SortedMap::new();
    for (at, block) in mode.tape.blocks.iter().enumerate() {
        for step in &block.steps {
            for offset in 0..step.operation.values() {
                steps.insert(Value(step.value.0 + offset), (at, step));
            }
            if let Some(power) = power(step, &all)
                && varying[power.base.0]
            {
                all.insert(step.value, power);
            }
        }
    }
    // The series of x⁴ exists also where x vanishes.
    all.retain(|_, power| power.positive || power.exponent.is_negative());
    let mut chosen = SortedMap::new();
    if all.is_empty() {
        return chosen;
    }
    let readers = readers(mode);
    let mut replaced: SortedSet<Value> = SortedSet::new();
    for (&value, &power) in all.iter().rev() {
        if replaced.contains(&value) {
            continue;
        }
        let (at, step) = steps[&value];
        let is_single = matches!(step.operation, Operation::Powf(x, _) if x == power.base);
        let chain = chain(value, power.base, &steps, &readers);
        let products = chain
            .iter()
            .filter(|value| has_product(steps[*value].1))
            .count();
        let is_visible = match steps.get(&power.base) {
            None => true,
            Some(&(of, _)) => of == at || mode.tape.blocks[of].needs.is_always(),
        };
        if is_single || is_visible && products >= WORTHWHILE {
            chosen.insert(value, power);
            replaced.extend(chain);
        }
    }
    chosen
}

/// A value that only those steps read that are named; outputs have no name.
type Readers = SortedMap<Value, Vec<Option<Value>>>;

fn readers(mode: &ModeProgram) -> Readers {
    let mut readers = Readers::new();
    for block in &mode.tape.blocks {
        for step in &block.steps {
            for operand in step.operation.operands() {
                readers.get_or_default(operand).push(Some(step.value));
            }
        }
        for write in &block.writes {
            readers.get_or_default(write.value).push(None);
        }
    }
    readers
}

/// The power that a step makes, given those of the steps before.
fn power(step: &Step, earlier: &SortedMap<Value, Power>) -> Option<Power> {
    let own = |base: Value| Power {
        base,
        exponent: Rational::ONE,
        positive: false,
    };
    let of = |value: Value| earlier.get(&value).copied().unwrap_or(own(value));
    let raised = |x: Value, exponent: Rational| {
        let power = of(x);
        let exponent = power.exponent.checked_mul(exponent)?;
        Some(Power { exponent, ..power })
    };
    // √(x²) is not x where that is negative.
    let root = |x: Value| {
        let power = Some(of(x)).filter(|power| power.positive);
        let power = power.unwrap_or(own(x));
        let exponent = power.exponent.checked_mul(Rational::HALF)?;
        Some(Power {
            exponent,
            positive: true,
            ..power
        })
    };
    let joined = |x: Value, y: Value, sign: Rational| {
        let (x, y) = (of(x), of(y));
        let exponent = y.exponent.checked_mul(sign)?;
        let exponent = x.exponent.checked_add(exponent)?;
        let positive = x.positive || y.positive;
        (x.base == y.base).then_some(Power {
            exponent,
            positive,
            ..x
        })
    };
    match step.operation {
        Operation::Sqrt(x) => root(x),
        Operation::Powf(base, exponent) => Some(Power {
            base,
            exponent,
            positive: true,
        }),
        Operation::Square(x) => raised(x, Rational::integer(2)),
        Operation::Ratio(_, x) => raised(x, Rational::MINUS_ONE),
        Operation::Scale(_, x) | Operation::Neg(x) => raised(x, Rational::ONE),
        Operation::Mul(x, y) => joined(x, y, Rational::ONE),
        Operation::Div(x, y) => joined(x, y, Rational::MINUS_ONE),
        _ => None,
    }
}

/// A value and what stands between it and the base that nothing else reads.
fn chain(
    value: Value,
    base: Value,
    steps: &SortedMap<Value, (usize, &Step)>,
    readers: &Readers,
) -> SortedSet<Value> {
    let mut chain: SortedSet<Value> = [value].into_iter().collect();
    let mut open = vec![value];
    while let Some(next) = open.pop() {
        for operand in steps[&next].1.operation.operands() {
            let is_own = |reader: &Option<Value>| reader.is_some_and(|r| chain.contains(&r));
            if operand != base
                && steps.contains_key(&operand)
                && !chain.contains(&operand)
                && readers[&operand].iter().all(is_own)
            {
                chain.insert(operand);
                open.push(operand);
            }
        }
    }
    chain
}

/// Whether the series of a step that is made of powers is a sum of products.
fn has_product(step: &Step) -> bool {
    !matches!(step.operation, Operation::Scale(..) | Operation::Neg(_))
}
