//! What a step hides between its ends, where neither its series nor its error shows it.
//!
//! What is too small to be seen where a step begins may be large in its middle. A pulse exp(−(t − 5)²/2σ²) has the value 0 at t = 0, to all digits, and so have its derivatives; no step is too long for a
//! series of it, and at the end of the step it is 0 again. But its exponent is known: it is no small number, and the declaration
//! tells how it goes on. A step ends where an exponent has risen by more than a series can follow; whether what has risen then
//! matters is seen by the next one. (In tanh and in 1/cosh it is the size of the argument that must not fall.)
//!
//! So with a power, whose exponent is n ln|x|: atoms that fly at one another from afar feel nothing of (s/r)¹² until they touch, and a step over
//! r = 0 sees nothing of it at all; and sin⁴⁰t is nothing where it begins. What has come near to a right angle, atan u of a large u, hides a hill as u⁻¹ does, and powers of
//! it: steps end before u comes down to 1. A logarithm is taken for the power of its argument that is not followed any more.
//!
//! An angle `atan2` that passes its cut jumps by 2π, and `atan` by π at a pole of its argument, which their series do not know. Where it has come back at the end of a step nothing there
//! tells of it: the step ends beyond the cut instead, where accelerations show that they have jumped.
//!
//! A root √x², as |v| of a body that turns back, goes on as −x in its series. Where x passes zero twice nothing tells of it at the end of the step:
//! the step ends between the zeros. So does asin(sin x), by the root √(1 − sin²x) that its slope is divided by.

use super::piece::{Ends, extremes, largest_size, least_size, of_root, passes_cut, passes_zero};
use crate::arithmetic::{Pack, Scalar};
use crate::declaration::{AtState, Evaluator, Operations};
use crate::integrate::{AtPlaces, PLACES, StepPolynomial};
use crate::system::Erased;

/// What is smaller than exp(−100), 4e-44, does not matter, whatever it is a factor of.
const NEGLIGIBLE: f64 = -100.0;

/// Per order of a method: a rise of the exponent by so much has small terms of higher orders.
const RISE: f64 = 0.5;

/// What is divided by and has fallen to this share of what it was may pass zero: it is a rounding error of what it is made of, as cos(x) is beside
/// π/2, and a quotient that has not been felt until then, as sin(x)/x, never is.
const LEAST: f64 = f64::EPSILON;

/// What is divided by, or a root of positions is taken of, and changes by less than this share over a step, by its first two rates, is looked at no closer.
const FAR: f64 = 0.9;

/// Lower powers grow by no more than a series of a loose tolerance follows.
const HIGH: f64 = 8.0;

/// Where the argument of `atan` is larger than this its series shows nothing of what it is nearer to zero.
const FLAT: f64 = 2.0;

/// The argument of `asin` or `acos` that changes by more than this in a piece may come to ±1 in it, and back.
const SWING: f64 = 1.0;

/// The arguments of exponentials and powers, the angles, the roots and the arcs in what acts.
#[derive(Debug)]
pub(super) struct Hidden {
    /// Where a step begins.
    start: AtState,
    /// Where its pieces end.
    pieces: AtState<AtPlaces>,
    arguments: Vec<Argument>,
    angles: Vec<Angle>,
    roots: Vec<Root>,
    /// The order of the method for which powers know their growth.
    order: usize,
}

/// The argument of an exponential function, or the base of a power.
#[derive(Debug)]
struct Argument {
    value: usize,
    function: Function,
    /// The argument and its change over a piece, at the beginning of the piece.
    before: Ends,
    /// The border of its size within the step; none where it does not come there.
    border: Option<Border>,
}

/// What an argument is of.
#[derive(Debug)]
enum Function {
    /// exp, sinh, cosh or tanh, and by how much the exponent changes with the argument.
    Exponential(f64),
    /// atan.
    Arctangent,
    /// A power, with a negative exponent for what is divided by.
    Power {
        exponent: f64,
        /// How large the base has been at most.
        largest: f64,
        /// By what the base changes where the power grows by the rise that a method follows.
        growth: f64,
    },
}

/// How small or how large a number may become.
#[derive(Clone, Copy, Debug)]
enum Border {
    Least(f64),
    Most(f64),
}

/// A value of `atan2`, or of `atan`.
#[derive(Debug)]
struct Angle {
    value: usize,
    /// How far its values lie apart at most, by which it jumps.
    range: f64,
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
    kind: Kind,
    /// Whether it may come to zero in the step.
    near: bool,
    /// The root and its change over a piece, at the beginning of the piece.
    before: Ends,
    /// Where the piece ends that it first has a corner in, as a part of the step.
    corner: Option<f64>,
}

/// What a root is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Of positions.
    Place,
    /// Of velocities, or of the time.
    Rate,
    /// 1 − base².
    Arc,
}

impl Hidden {
    /// Those of what acts in a system, if it has any.
    pub(super) fn new<T: Scalar>(system: &Erased<T>, acting: &Operations) -> Option<Self> {
        let exponentials = acting.exponents().map(|(argument, factor)| {
            let function = Function::Exponential(factor);
            (argument, function)
        });
        let high = |&(_, exponent): &(usize, f64)| !(0.0..HIGH).contains(&exponent);
        let powers = acting
            .powers()
            .filter(high)
            .map(|(base, exponent)| (base, Function::power(exponent)));
        let logarithms = acting
            .logarithms()
            .map(|argument| (argument, Function::power(-HIGH)));
        let arctangents = acting.arctangents().map(|x| (x, Function::Arctangent));
        let functions = exponentials.chain(powers).chain(logarithms);
        let mut arguments: Vec<(usize, Function)> = functions.chain(arctangents).collect();
        let mut angles: Vec<(usize, f64)> = acting.angles().collect();
        let arcs = acting.arcs().map(|base| (base, Kind::Arc));
        let roots = acting.roots().map(|(base, of_rates)| match of_rates {
            true => (base, Kind::Rate),
            false => (base, Kind::Place),
        });
        let mut roots: Vec<(usize, Kind)> = roots.chain(arcs).collect();
        // Of what reads forces as well a state says nothing.
        let all: Vec<usize> = values(&arguments, &angles, &roots);
        let (declaration, parameters) = (system.declaration(), system.parameters());
        let evaluator = Evaluator::<f64>::new(declaration, &parameters, all);
        arguments.retain(|&(argument, _)| evaluator.follows_state(argument));
        angles.retain(|&(angle, _)| evaluator.follows_state(angle));
        roots.retain(|&(base, _)| evaluator.follows_state(base));
        let all = values(&arguments, &angles, &roots);
        if arguments.is_empty() && angles.is_empty() && roots.is_empty() {
            return None;
        }
        let arguments = arguments.into_iter().map(|(value, function)| Argument {
            value,
            function,
            before: [0.0; 2],
            border: None,
        });
        let angles = angles.into_iter().map(|(value, range)| Angle {
            value,
            range,
            before: [0.0; 2],
            jumps: 0.0,
            beyond: None,
        });
        let roots = roots.into_iter().map(|(base, kind)| Root {
            base,
            kind,
            near: true,
            before: [0.0; 2],
            corner: None,
        });
        let n = system.description().coordinates.len();
        Some(Self {
            start: AtState::new(declaration, &parameters, all.iter().copied(), n),
            pieces: AtState::new(declaration, &parameters, all, n),
            arguments: arguments.collect(),
            angles: angles.collect(),
            roots: roots.collect(),
            order: 0,
        })
    }

    /// Takes the parameters of another system of the same kind.
    pub(super) fn set_parameters(&mut self, parameters: &[f64]) {
        self.start.evaluator.set_parameters(parameters);
        self.pieces.evaluator.set_parameters(parameters);
    }

    /// Forgets what belongs to another motion.
    pub(super) fn restart(&mut self) {
        for argument in &mut self.arguments {
            if let Function::Power { largest, .. } = &mut argument.function {
                *largest = 0.0;
            }
        }
    }

    /// Whether there are roots of velocities or of the time among them.
    pub(super) fn has_roots_of_rates(&self) -> bool {
        self.roots.iter().any(|root| root.kind == Kind::Rate)
    }

    /// The part of a step, up to `end` of it, that hides nothing from a method of this order: `end`, or less.
    pub(super) fn shown<T: Scalar>(
        &mut self,
        step: &StepPolynomial<T>,
        end: f64,
        order: usize,
    ) -> f64 {
        let rise = RISE * order as f64;
        if self.order != order {
            self.order = order;
            self.arguments
                .iter_mut()
                .for_each(|a| a.function.set_rise(rise));
        }
        let piece = end / PLACES as f64;
        let change = piece * step.h.value();
        step.at_start(&mut self.start);
        let start = &self.start.evaluator;
        let ends = |value: usize| [start.value(value), change * start.rate(value)];
        let time = end * step.h.value();
        let most = |value: usize| {
            let [rate, bend] = [1, 2].map(|k| start.coefficient(value, k));
            time * (rate.abs() + 2.0 * time * bend.abs())
        };
        for argument in &mut self.arguments {
            argument.before = ends(argument.value);
            argument.begin(rise, most(argument.value));
        }
        for root in &mut self.roots {
            let base = start.value(root.base).abs();
            root.near = root.kind != Kind::Place || most(root.base) >= FAR * base;
        }
        if self.is_clear() {
            return end;
        }
        let places = core::array::from_fn(|n| (n + 1) as f64 * piece);
        step.at_places(Pack(places), &mut self.pieces);
        let pieces = &self.pieces.evaluator;
        let at = |n: usize, value: usize| -> Ends {
            let [x, rate] = [pieces.value(value), pieces.rate(value)].map(|x| x.0[n - 1]);
            [x, change * rate]
        };
        // Between two ends of a piece a curve stays among these and what its tangents there come to within the piece.
        let course = |before: Ends, value: usize| {
            core::iter::once(before).chain((1..=PLACES).map(move |n| at(n, value)))
        };
        for argument in &mut self.arguments {
            if argument.keeps_away(course(argument.before, argument.value)) {
                argument.border = None;
            }
        }
        for root in self.roots.iter_mut().filter(|root| root.near) {
            let mut course = course(ends(root.base), root.base);
            root.near = root.kind == Kind::Arc || !course.all(|[x, dx]| x - dx.abs() > 0.0);
        }
        if self.is_clear() {
            return end;
        }
        for angle in &mut self.angles {
            angle.before = ends(angle.value);
            (angle.jumps, angle.beyond) = (0.0, None);
        }
        for root in &mut self.roots {
            root.before = root.ends(ends(root.base));
            root.corner = None;
        }
        for n in 1..=PLACES {
            let ends = |value: usize| at(n, value);
            for argument in &mut self.arguments {
                let after = ends(argument.value);
                let before = core::mem::replace(&mut argument.before, after);
                if argument.passes_border(before, after) {
                    return f64::max((n - 1) as f64, 0.5) * piece;
                }
            }
            for angle in &mut self.angles {
                let after = ends(angle.value);
                if let Some((s, jumps)) = passes_cut(angle.range, angle.before, after) {
                    angle.jumps += jumps;
                    angle.beyond.get_or_insert(((n - 1) as f64 + s) * piece);
                }
                angle.before = after;
            }
            for root in self.roots.iter_mut().filter(|root| root.near) {
                let base = ends(root.base);
                if root.kind == Kind::Arc && base[1].abs() > SWING {
                    return f64::max((n - 1) as f64, 0.5) * piece;
                }
                let after = root.ends(base);
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

    /// Whether nothing is left that the step may hide.
    fn is_clear(&self) -> bool {
        let borders = self.arguments.iter().any(|a| a.border.is_some());
        let near = self.roots.iter().any(|root| root.near);
        !borders && !near && self.angles.is_empty()
    }
}

/// The values that are looked at.
fn values(
    arguments: &[(usize, Function)],
    angles: &[(usize, f64)],
    roots: &[(usize, Kind)],
) -> Vec<usize> {
    let arguments = arguments.iter().map(|(argument, _)| *argument);
    let angles = angles.iter().map(|(angle, _)| *angle);
    let bases = roots.iter().map(|(base, _)| *base);
    arguments.chain(angles).chain(bases).collect()
}

impl Root {
    /// The root and its change, by those of its base.
    fn ends(&self, [base, change]: Ends) -> Ends {
        of_root(match self.kind {
            Kind::Arc => [1.0 - base * base, -2.0 * base * change],
            Kind::Place | Kind::Rate => [base, change],
        })
    }
}

impl Function {
    /// A power of what has not been seen yet.
    fn power(exponent: f64) -> Self {
        Function::Power {
            exponent,
            largest: 0.0,
            growth: 1.0,
        }
    }

    /// Takes the rise of the exponent that a method follows.
    fn set_rise(&mut self, rise: f64) {
        if let Function::Power {
            exponent, growth, ..
        } = self
        {
            *growth = (rise / *exponent).exp();
        }
    }
}

impl Argument {
    /// Says where it may go over a step, so that its function does not grow by more than the exponential of `rise`. The argument is known where the
    /// step begins, and its `change` over the step by its first two rates.
    fn begin(&mut self, rise: f64, change: f64) {
        let size = self.before[0].abs();
        self.border = match &mut self.function {
            Function::Exponential(factor) => {
                // The function is small where the argument is large, in exp(−x) as in 1/cosh(x).
                let highest = f64::max(-*factor * size, NEGLIGIBLE) + rise;
                (highest < 0.0).then_some(Border::Least(-highest / *factor))
            }
            Function::Arctangent => {
                let least = f64::max(size * (-rise / HIGH).exp(), 1.0);
                (size > FLAT).then_some(Border::Least(least))
            }
            Function::Power {
                exponent,
                largest,
                growth,
            } => {
                *largest = largest.max(size);
                if *exponent < 0.0 {
                    let least = size * *growth;
                    let nearest = size - change;
                    let is_near =
                        nearest < least.max((1.0 - FAR) * size) && least > LEAST * *largest;
                    is_near.then_some(Border::Least(least))
                } else {
                    let scale = if *largest > 0.0 { *largest } else { 1.0 };
                    let most = size.max(scale * (NEGLIGIBLE / *exponent).exp()) * *growth;
                    (size + change > most).then_some(Border::Most(most))
                }
            }
        };
    }

    /// Whether it does not come to its border, by its values where pieces end and its changes over them.
    fn keeps_away(&self, mut course: impl Iterator<Item = Ends>) -> bool {
        let side = self.before[0].signum();
        match self.border {
            None => true,
            Some(Border::Least(least)) => course.all(|[x, dx]| side * x - dx.abs() >= least),
            Some(Border::Most(most)) => course.all(|[x, dx]| x.abs() + dx.abs() <= most),
        }
    }

    /// Whether it goes where it must not in a piece with these ends.
    fn passes_border(&self, before: Ends, after: Ends) -> bool {
        self.border.is_some_and(|border| match border {
            Border::Least(least) => least_size(before, after) < least,
            Border::Most(most) => largest_size(before, after) > most,
        })
    }
}
