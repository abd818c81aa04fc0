//! What a step hides between its ends, where neither its series nor its error shows it.
//!
//! What is too small to be seen where a step begins may be large in its middle. A pulse exp(−(t − 5)²/2σ²) has the value 0 at t = 0, to all digits, and so have its derivatives; no step is too long for a
//! series of it, and at the end of the step it is 0 again. But its exponent is known: it is no small number, and the declaration
//! tells how it goes on. A step ends where an exponent has risen by more than a series can follow; whether what has risen then
//! matters is seen by the next one. (In tanh and in 1/cosh it is the size of the argument that must not fall.)
//!
//! So with a power, whose exponent is n ln|x|: atoms that fly at one another from afar feel nothing of (s/r)¹² until they touch, and a step over
//! r = 0 sees nothing of it at all; and sin⁴⁰t is nothing where it begins.
//!
//! An angle `atan2` that passes its cut jumps by 2π, which its series does not know. Where it has come back at the end of a step nothing there
//! tells of it: the step ends beyond the cut instead, where accelerations show that they have jumped.
//!
//! A root √x², as |v| of a body that turns back, goes on as −x in its series. Where x passes zero twice nothing tells of it at the end of the step:
//! the step ends between the zeros.

use crate::arithmetic::Scalar;
use crate::declaration::{
    self, Declaration, Evaluator, Inputs, Worked, angles, exponentials, exponents, powers, roots,
};
use crate::effects::{Effects, Item};
use crate::integrate::StepPolynomial;
use crate::system::{Description, Erased};
use crate::trajectory::State;
use core::f64::consts::{PI, TAU};

/// What is smaller than exp(−100), 4e-44, does not matter, whatever it is a factor of.
const NEGLIGIBLE: f64 = -100.0;

/// Per order of a method: a rise of the exponent by so much has small terms of higher orders.
const RISE: f64 = 0.5;

/// What is divided by and has fallen to this share of what it was may pass zero: it is known no better, and a quotient that has not been felt until
/// then, as sin(x)/x, never is.
const LEAST: f64 = 1e-18;

/// What is divided by and changes by less than this share over a step, by its first two rates, is looked at no closer.
const FAR: f64 = 0.5;

/// Lower powers grow by no more than a series of a loose tolerance follows.
const HIGH: f64 = 8.0;

/// Equations of motion, and their series, contain what is declared to powers of about this.
const RAISED: i32 = 8;

/// A step is looked at in so many pieces.
const PIECES: usize = 8;

/// The exponents, powers, angles and roots in what acts.
#[derive(Debug)]
pub(super) struct Hidden {
    evaluator: Evaluator,
    exponents: Vec<Exponent>,
    powers: Vec<Power>,
    angles: Vec<Angle>,
    roots: Vec<Root>,
    q: Vec<f64>,
    v: Vec<f64>,
    acceleration: Vec<f64>,
}

/// The argument of exp, sinh, cosh or tanh.
#[derive(Debug)]
struct Exponent {
    argument: usize,
    /// By how much the exponent changes with the argument.
    factor: f64,
    /// The argument and its change over a piece, at the beginning of the piece.
    before: Ends,
    /// Up to where the exponent may rise.
    highest: f64,
}

/// A power of something.
#[derive(Debug)]
struct Power {
    base: usize,
    /// Its exponent, negative for what is divided by.
    exponent: f64,
    /// The base and its change over a piece, at the beginning of the piece.
    before: Ends,
    /// How large the base has been at most.
    largest: f64,
    /// The size of the base down to which, or up to which, it may go; none where it does not come there.
    border: Option<f64>,
}

/// A value of `atan2`.
#[derive(Debug)]
struct Angle {
    value: usize,
    /// The angle and its change over a piece, at the beginning of the piece.
    before: Ends,
    /// How often it has jumped up, less how often it has jumped down.
    jumps: f64,
    /// The first place beyond the cut, as a part of the step.
    beyond: Option<f64>,
}

/// A root.
#[derive(Debug)]
struct Root {
    base: usize,
    /// The root and its change over a piece, at the beginning of the piece.
    before: Ends,
    /// Where the piece ends that it first has a corner in, as a part of the step.
    corner: Option<f64>,
}

/// A value, and its change over a piece.
type Ends = [f64; 2];

impl Hidden {
    /// Those of a system, if it has any.
    pub(super) fn new<T: Scalar>(system: &Erased<T>, effects: &Effects) -> Option<Self> {
        let (d, declaration) = (system.description(), system.declaration());
        let mut arguments = exponents(declaration, acting(d, declaration, effects));
        let mut raised = powers(declaration, acting(d, declaration, effects));
        raised.retain(|&(_, exponent)| !(0.0..HIGH).contains(&exponent));
        let mut values = angles(declaration, acting(d, declaration, effects));
        let mut bases = roots(declaration, acting(d, declaration, effects));
        if arguments.is_empty() && raised.is_empty() && values.is_empty() && bases.is_empty() {
            return None;
        }
        let wanted = arguments.iter().chain(&raised).map(|&(value, _)| value);
        let wanted = wanted.chain(values.iter().chain(&bases).copied());
        let evaluator = Evaluator::new(declaration, &system.parameters(), wanted);
        let follows = |value: usize| evaluator.moves(value) && !evaluator.is_of_forces(value);
        arguments.retain(|&(argument, _)| follows(argument));
        raised.retain(|&(base, _)| follows(base));
        values.retain(|&value| follows(value));
        bases.retain(|&base| follows(base));
        let is_empty = arguments.is_empty() && raised.is_empty();
        if is_empty && values.is_empty() && bases.is_empty() {
            return None;
        }
        let exponents = arguments.iter().map(|&(argument, factor)| Exponent {
            argument,
            factor,
            before: [0.0; 2],
            highest: 0.0,
        });
        let powers = raised.iter().map(|&(base, exponent)| Power {
            base,
            exponent,
            before: [0.0; 2],
            largest: 0.0,
            border: None,
        });
        let angles = values.iter().map(|&value| Angle {
            value,
            before: [0.0; 2],
            jumps: 0.0,
            beyond: None,
        });
        let roots = bases.iter().map(|&base| Root {
            base,
            before: [0.0; 2],
            corner: None,
        });
        let n = d.coordinates.len();
        Some(Self {
            exponents: exponents.collect(),
            powers: powers.collect(),
            angles: angles.collect(),
            roots: roots.collect(),
            evaluator,
            q: vec![0.0; n],
            v: vec![0.0; n],
            acceleration: vec![0.0; n],
        })
    }

    /// Forgets what belongs to another motion.
    pub(super) fn restart(&mut self) {
        self.powers.iter_mut().for_each(|power| power.largest = 0.0);
    }

    /// Whether there are roots among them.
    pub(super) fn has_roots(&self) -> bool {
        !self.roots.is_empty()
    }

    /// The part of a step, up to `end` of it, that hides nothing from a method of this order: `end`, or less.
    pub(super) fn shown<T: Scalar>(
        &mut self,
        step: &StepPolynomial<T>,
        end: f64,
        order: usize,
    ) -> f64 {
        let rise = RISE * order as f64;
        let piece = end / PIECES as f64;
        let change = piece * step.h.value();
        self.look(step, 0.0);
        let ends = |evaluator: &Evaluator, value: usize| {
            [evaluator.value(value), change * evaluator.rate(value)]
        };
        for exponent in &mut self.exponents {
            exponent.before = ends(&self.evaluator, exponent.argument);
            let size = exponent.before[0].abs();
            exponent.highest = f64::max(-exponent.factor * size, NEGLIGIBLE) + rise;
        }
        let mut near = false;
        for power in &mut self.powers {
            let [rate, bend] = [1, 2].map(|k| self.evaluator.coefficient(power.base, k));
            power.before = ends(&self.evaluator, power.base);
            power.begin(rise, [rate, bend], end * step.h.value());
            near |= power.border.is_some();
        }
        if !near && self.exponents.is_empty() && self.angles.is_empty() && self.roots.is_empty() {
            return end;
        }
        for angle in &mut self.angles {
            angle.before = ends(&self.evaluator, angle.value);
            (angle.jumps, angle.beyond) = (0.0, None);
        }
        for root in &mut self.roots {
            root.before = of_root(ends(&self.evaluator, root.base));
            root.corner = None;
        }
        for n in 1..=PIECES {
            self.look(step, n as f64 * piece);
            for exponent in &mut self.exponents {
                let after = ends(&self.evaluator, exponent.argument);
                let least = least_size(exponent.before, after);
                if -exponent.factor * least > exponent.highest {
                    return f64::max((n - 1) as f64, 0.5) * piece;
                }
                exponent.before = after;
            }
            for power in &mut self.powers {
                let after = ends(&self.evaluator, power.base);
                let before = core::mem::replace(&mut power.before, after);
                if power.passes_border(before, after) {
                    return f64::max((n - 1) as f64, 0.5) * piece;
                }
            }
            for angle in &mut self.angles {
                let after = ends(&self.evaluator, angle.value);
                if let Some((s, jumps)) = passes_cut(angle.before, after) {
                    angle.jumps += jumps;
                    angle.beyond.get_or_insert(((n - 1) as f64 + s) * piece);
                }
                angle.before = after;
            }
            for root in &mut self.roots {
                let after = of_root(ends(&self.evaluator, root.base));
                let before = core::mem::replace(&mut root.before, after);
                if !passes_zero(before, after) {
                    let mut dips = extremes(before, after).filter(|&(_, root)| root < 0.0);
                    if let Some((between, _)) = dips.next() {
                        return ((n - 1) as f64 + between) * piece;
                    }
                    continue;
                }
                if let Some(corner) = root.corner {
                    return corner;
                }
                root.corner = Some(n as f64 * piece);
            }
        }
        let back = self.angles.iter().filter(|angle| angle.jumps == 0.0);
        let beyond = back.filter_map(|angle| angle.beyond);
        beyond.fold(end, f64::min)
    }

    fn look<T: Scalar>(&mut self, step: &StepPolynomial<T>, s: f64) {
        let s = T::from_f64(s);
        for i in 0..self.q.len() {
            self.q[i] = step.position(i, s).value();
            self.v[i] = step.velocity(i, s).value();
            self.acceleration[i] = step.acceleration(i, s).value();
        }
        self.evaluator.evaluate(Inputs {
            time: step.time(s).value(),
            q: &self.q,
            v: &self.v,
            acceleration: &self.acceleration,
            forces: &[],
            loads: &[],
        });
    }
}

impl Power {
    /// Says where its base may go over a step that takes `time`, so that the power does not grow by more than the exponential of `rise`. The base is
    /// known where the step begins, and the coefficients of its series are `rate` and `bend`.
    fn begin(&mut self, rise: f64, [rate, bend]: [f64; 2], time: f64) {
        let size = self.before[0].abs();
        self.largest = self.largest.max(size);
        let change = time * (rate.abs() + 2.0 * time * bend.abs());
        let n = self.exponent;
        self.border = match n < 0.0 {
            true => {
                let lowest = size * (rise / n).exp();
                (change >= FAR * size && lowest > LEAST * self.largest).then_some(lowest)
            }
            false => {
                let scale = if self.largest > 0.0 {
                    self.largest
                } else {
                    1.0
                };
                let highest = size.max(scale * (NEGLIGIBLE / n).exp()) * (rise / n).exp();
                (size + change > highest).then_some(highest)
            }
        };
    }

    /// Whether the base goes where it must not in a piece with these ends.
    fn passes_border(&self, before: Ends, after: Ends) -> bool {
        self.border.is_some_and(|border| match self.exponent < 0.0 {
            true => least_size(before, after) < border,
            false => largest_size(before, after) > border,
        })
    }
}

/// Whether accelerations may jump where no branch says so.
pub(super) fn may_jump<T: Scalar>(system: &Erased<T>, effects: &Effects) -> bool {
    let (d, declaration) = (system.description(), system.declaration());
    declaration::may_jump(declaration, acting(d, declaration, effects))
}

/// Whether what acts is a function of time.
pub(super) fn changes_with_time<T: Scalar>(system: &Erased<T>, effects: &Effects) -> bool {
    let (d, declaration) = (system.description(), system.declaration());
    declaration::reads_time(declaration, acting(d, declaration, effects))
}

/// Whether functions in what acts are so large at a state that powers of them are beyond all numbers.
#[cold]
pub(super) fn overflow<T: Scalar>(
    system: &Erased<T>,
    effects: &Effects,
    time: T,
    state: &State<T>,
) -> bool {
    let (d, declaration) = (system.description(), system.declaration());
    let growing = exponentials(declaration, acting(d, declaration, effects));
    let mut evaluator = Evaluator::new(declaration, &system.parameters(), growing.iter().copied());
    let numbers = |list: &[T]| -> Vec<f64> { list.iter().map(|x| x.value()).collect() };
    evaluator.evaluate(Inputs {
        time: time.value(),
        q: &numbers(&state.q),
        v: &numbers(&state.v),
        acceleration: &vec![0.0; state.q.len()],
        forces: &[],
        loads: &[],
    });
    let mut growing = growing.into_iter();
    growing.any(|value| {
        let follows = evaluator.moves(value) && !evaluator.is_of_forces(value);
        follows && evaluator.value(value).powi(RAISED).is_infinite()
    })
}

/// Least |z| of the cubic with these values and changes at both ends of a piece, or of what is bent in between as |s| is, up to where its tangents
/// meet.
fn least_size(before: Ends, after: Ends) -> f64 {
    let ([first, falls], [last, rises]) = (before, after);
    if first * last <= 0.0 {
        return 0.0;
    }
    let side = first.signum();
    let mut least = first.abs().min(last.abs());
    if side * falls < 0.0 && side * rises > 0.0 {
        let meet = (last - rises - first) / (falls - rises);
        least = least.min((side * (first + falls * meet)).max(0.0));
    }
    extremes(before, after).fold(least, |least, (_, z)| match z * first <= 0.0 {
        true => 0.0,
        false => least.min(z.abs()),
    })
}

/// Largest |z| of the cubic with these values and changes at both ends of a piece.
fn largest_size(before: Ends, after: Ends) -> f64 {
    let largest = before[0].abs().max(after[0].abs());
    extremes(before, after).fold(largest, |largest, (_, z)| largest.max(z.abs()))
}

/// A root and its change, by those of what is under it.
fn of_root([base, change]: Ends) -> Ends {
    let root = base.max(0.0).sqrt();
    [root, change / (2.0 * root)]
}

/// Whether a root with these values and changes at both ends of a piece goes on with the other sign: then the change is the mean of those at
/// the ends.
fn passes_zero(before: Ends, after: Ends) -> bool {
    let misfit = |sign: f64| {
        let grows = 0.5 * (before[1] + sign * after[1]);
        (sign * after[0] - before[0] - grows).abs()
    };
    misfit(-1.0) < misfit(1.0)
}

/// Where an angle is beyond its cut in a piece, and how often it has jumped up there: once, or −1 times, or not where it has come back.
fn passes_cut(before: Ends, after: Ends) -> Option<(f64, f64)> {
    let grows = (before[1] + after[1]) / 2.0;
    let jumps = ((after[0] - before[0] - grows) / TAU).round();
    if jumps != 0.0 {
        return Some((1.0, jumps));
    }
    let mut extremes = extremes(before, after);
    extremes.find_map(|(s, z)| (z.abs() > PI).then_some((s, 0.0)))
}

/// Where the slope of the cubic with these values and changes at both ends of a piece vanishes in it, and its values there.
fn extremes([first, falls]: Ends, [last, rises]: Ends) -> impl Iterator<Item = (f64, f64)> {
    // z = first + falls·s + b s² + c s³, whose slope vanishes at two places at most.
    let (b, c) = (
        3.0 * (last - first) - 2.0 * falls - rises,
        2.0 * (first - last) + falls + rises,
    );
    let root = (b * b - 3.0 * c * falls).max(0.0).sqrt();
    let q = -(b + root.copysign(b));
    let places = [q / (3.0 * c), falls / q].into_iter();
    let inside = places.filter(|&s| s > 0.0 && s < 1.0);
    inside.map(move |s| (s, first + s * (falls + s * (b + s * c))))
}

/// What is declared, less what is left out.
fn acting(d: &Description, declaration: &Declaration, effects: &Effects) -> Vec<usize> {
    let mut values = Vec::new();
    let mut put = |item: Item, list: &[usize]| {
        if effects.includes(d, item) {
            values.extend_from_slice(list);
        }
    };
    for (i, &value) in declaration.kinetic.iter().enumerate() {
        put(Item::Kinetic(i), &[value]);
    }
    for (i, &value) in declaration.potential.iter().enumerate() {
        put(Item::Potential(i), &[value]);
    }
    for (i, &value) in declaration.constraints.iter().enumerate() {
        put(Item::Constraint(i), &[value]);
    }
    for (i, contact) in declaration.contacts.iter().enumerate() {
        put(Item::Contact(i), &[contact.gap]);
        put(Item::Contact(i), contact.region.as_slice());
    }
    for (i, friction) in declaration.frictions.iter().enumerate() {
        put(Item::Friction(i), friction.slip);
        put(Item::Friction(i), friction.normal.as_slice());
        let coefficients = [friction.static_coefficient, friction.kinetic_coefficient];
        put(Item::Friction(i), &coefficients);
    }
    for (i, force) in declaration.forces.iter().enumerate() {
        for &(component, worked) in force.components {
            put(Item::Force(i), &[component]);
            if let Worked::Point(value) | Worked::Speed(value) = worked {
                put(Item::Force(i), &[value]);
            }
        }
    }
    for (i, &value) in declaration.dissipations.iter().enumerate() {
        put(Item::Dissipation(i), &[value]);
    }
    for (i, terms) in declaration.stops.iter().enumerate() {
        put(Item::Stop(i), terms.unwrap_or_default());
    }
    for (i, terms) in declaration.marks.iter().enumerate() {
        put(Item::Mark(i), terms.unwrap_or_default());
    }
    values
}

#[cfg(test)]
mod tests {
    use super::{PI, TAU, extremes, least_size, passes_cut, passes_zero};

    #[test]
    fn angles_pass_their_cut_at_an_end_of_a_piece_or_in_between() {
        assert_eq!(passes_cut([1.0, 0.5], [1.5, 0.5]), None);
        assert_eq!(passes_cut([3.0, 0.4], [3.4 - TAU, 0.4]), Some((1.0, -1.0)));
        assert_eq!(
            passes_cut([-3.0, -0.4], [TAU - 3.4, -0.4]),
            Some((1.0, 1.0))
        );
        // π − 0.1 + s − s² is highest in the middle, 0.15 beyond the cut.
        let returns = passes_cut([PI - 0.1, 1.0], [PI - 0.1, -1.0]);
        assert_eq!(returns, Some((0.5, 0.0)));
        assert_eq!(passes_cut([PI - 0.3, 1.0], [PI - 0.3, -1.0]), None);
    }

    #[test]
    fn least_sizes_of_cubics_are_found_between_the_ends() {
        // (s − ½)² + 1 and |s − ½| + 1, by their values and slopes at 0 and 1: both are 3/4 or more.
        assert_eq!(least_size([1.25, -1.0], [1.25, 1.0]), 0.75);
        assert_eq!(least_size([1.5, -1.0], [1.5, 1.0]), 1.0);
        // −2 + s, s − ½, and 1 − 6s + 6s², which is negative in the middle.
        assert_eq!(least_size([-2.0, 1.0], [-1.0, 1.0]), 1.0);
        assert_eq!(least_size([-0.5, 1.0], [0.5, 1.0]), 0.0);
        assert_eq!(least_size([1.0, -6.0], [1.0, 6.0]), 0.0);
        // 1 + s − s³/4 rises and is least at its beginning.
        assert_eq!(least_size([1.0, 1.0], [1.75, 0.25]), 1.0);
        assert_eq!(least_size([3.0, 0.0], [3.0, 0.0]), 3.0);
    }

    #[test]
    fn zeros_of_a_root_are_told_from_curves_that_pass_near() {
        // |s − 0.3|, |(s − 0.3)(s − 2)|, and what falls without passing zero.
        assert!(passes_zero([0.3, -1.0], [0.7, 1.0]));
        assert!(passes_zero([0.6, -2.3], [0.7, 0.3]));
        assert!(!passes_zero([1.0, -0.5], [0.5, -0.5]));
        // √((s − ½)² + 0.09), and (s − ½)² − 0.04, which is negative between its zeros.
        let near = 0.34_f64.sqrt();
        let ends = ([near, -0.5 / near], [near, 0.5 / near]);
        assert!(!passes_zero(ends.0, ends.1));
        assert!(extremes(ends.0, ends.1).all(|(_, root)| root > 0.0));
        let dip = ([0.21, -1.0], [0.21, 1.0]);
        assert!(!passes_zero(dip.0, dip.1));
        let least = extremes(dip.0, dip.1).find(|(_, root)| *root < 0.0);
        assert!(least.is_some_and(|(place, _)| (place - 0.5).abs() < 1e-12));
    }
}
