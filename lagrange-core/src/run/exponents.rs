//! Exponents along a step: what is too small to be seen where a step begins may be large in its middle.
//!
//! A pulse exp(−(t − 5)²/2σ²) has the value 0 at t = 0, to all digits, and so have its derivatives; no step is too long for a
//! series of it, and at the end of the step it is 0 again. But its exponent is known: it is no small number, and the declaration
//! tells how it goes on. A step ends where an exponent has risen by more than a series can follow; whether what has risen then
//! matters is seen by the next one. (In tanh and in 1/cosh it is the size of the argument that must not fall.)

use crate::arithmetic::Scalar;
use crate::declaration::{Declaration, Evaluator, Inputs, Worked, exponentials, exponents};
use crate::effects::{Effects, Item};
use crate::integrate::StepPolynomial;
use crate::system::{Description, Erased};
use crate::trajectory::State;

/// What is smaller than exp(−100), 4e-44, does not matter, whatever it is a factor of.
const NEGLIGIBLE: f64 = -100.0;

/// Per order of a method: a rise of the exponent by so much has small terms of higher orders.
const RISE: f64 = 0.5;

/// Equations of motion, and their series, contain what is declared to powers of about this.
const RAISED: i32 = 8;

/// A step is looked at in so many pieces.
const PIECES: usize = 8;

/// The arguments of exp, sinh, cosh and tanh in what acts.
#[derive(Debug)]
pub(super) struct Exponents {
    evaluator: Evaluator,
    /// Each argument, and by how much the exponent changes with it.
    arguments: Vec<(usize, f64)>,
    /// Per argument: itself and its change over a piece, at the beginning of the piece.
    before: Vec<[f64; 2]>,
    /// Per argument: up to where its exponent may rise.
    highest: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    still: Vec<f64>,
}

impl Exponents {
    /// Those of a system, if it has any.
    pub(super) fn new<T: Scalar>(system: &Erased<T>, effects: &Effects) -> Option<Self> {
        let (d, declaration) = (system.description(), system.declaration());
        let mut arguments = exponents(declaration, acting(d, declaration, effects));
        if arguments.is_empty() {
            return None;
        }
        let wanted = arguments.iter().map(|&(argument, _)| argument);
        let evaluator = Evaluator::new(declaration, &parameters(system), wanted);
        arguments.retain(|&(argument, _)| {
            evaluator.moves(argument) && !evaluator.is_of_forces(argument)
        });
        let (n, count) = (d.coordinates.len(), arguments.len());
        (count > 0).then(|| Self {
            evaluator,
            arguments,
            before: vec![[0.0; 2]; count],
            highest: vec![0.0; count],
            q: vec![0.0; n],
            v: vec![0.0; n],
            still: vec![0.0; n],
        })
    }

    /// Which part of a step, up to `end` of it, a method of this order can follow all exponents over: `end`, or less.
    pub(super) fn followed<T: Scalar>(
        &mut self,
        step: &StepPolynomial<T>,
        end: f64,
        order: usize,
    ) -> f64 {
        let rise = RISE * order as f64;
        let piece = end / PIECES as f64;
        let change = piece * step.h.value();
        self.look(step, 0.0);
        for (k, &(argument, factor)) in self.arguments.iter().enumerate() {
            let z = [
                self.evaluator.value(argument),
                change * self.evaluator.rate(argument),
            ];
            self.before[k] = z;
            self.highest[k] = f64::max(-factor * z[0].abs(), NEGLIGIBLE) + rise;
        }
        for n in 1..=PIECES {
            self.look(step, n as f64 * piece);
            for (k, &(argument, factor)) in self.arguments.iter().enumerate() {
                let after = [
                    self.evaluator.value(argument),
                    change * self.evaluator.rate(argument),
                ];
                if -factor * least_size(self.before[k], after) > self.highest[k] {
                    return f64::max((n - 1) as f64, 0.5) * piece;
                }
                self.before[k] = after;
            }
        }
        end
    }

    fn look<T: Scalar>(&mut self, step: &StepPolynomial<T>, s: f64) {
        let s = T::from_f64(s);
        for i in 0..self.q.len() {
            self.q[i] = step.position(i, s).value();
            self.v[i] = step.velocity(i, s).value();
        }
        self.evaluator.evaluate(Inputs {
            time: step.time(s).value(),
            q: &self.q,
            v: &self.v,
            acceleration: &self.still,
            forces: &[],
            loads: &[],
        });
    }
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
    let mut evaluator = Evaluator::new(declaration, &parameters(system), growing.iter().copied());
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

fn parameters<T: Scalar>(system: &Erased<T>) -> Vec<f64> {
    let count = system.description().parameters.len();
    (0..count).map(|i| system.parameter(i).value()).collect()
}

/// Least |z| of the cubic with these values and changes at both ends of a piece.
fn least_size([before, falls]: [f64; 2], [after, rises]: [f64; 2]) -> f64 {
    if before * after <= 0.0 {
        return 0.0;
    }
    let mut least = before.abs().min(after.abs());
    // z = before + falls·s + b s² + c s³, whose slope vanishes at two places at most.
    let (b, c) = (
        3.0 * (after - before) - 2.0 * falls - rises,
        2.0 * (before - after) + falls + rises,
    );
    let root = (b * b - 3.0 * c * falls).max(0.0).sqrt();
    let q = -(b + root.copysign(b));
    for s in [q / (3.0 * c), falls / q] {
        if s > 0.0 && s < 1.0 {
            let z = before + s * (falls + s * (b + s * c));
            least = if z * before <= 0.0 {
                0.0
            } else {
                least.min(z.abs())
            };
        }
    }
    least
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
    use super::least_size;

    #[test]
    fn least_sizes_of_cubics_are_found_between_the_ends() {
        // (s − ½)² + 1, by its values and slopes at 0 and 1.
        assert_eq!(least_size([1.25, -1.0], [1.25, 1.0]), 1.0);
        // −2 + s, s − ½, and 1 − 6s + 6s², which is negative in the middle.
        assert_eq!(least_size([-2.0, 1.0], [-1.0, 1.0]), 1.0);
        assert_eq!(least_size([-0.5, 1.0], [0.5, 1.0]), 0.0);
        assert_eq!(least_size([1.0, -6.0], [1.0, 6.0]), 0.0);
        // 1 + s − s³/4 rises and is least at its beginning.
        assert_eq!(least_size([1.0, 1.0], [1.75, 0.25]), 1.0);
        assert_eq!(least_size([3.0, 0.0], [3.0, 0.0]), 3.0);
    }
}
