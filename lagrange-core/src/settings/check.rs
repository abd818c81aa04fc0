//! Refuses what was asked of a run where it has no meaning.

use super::Settings;
use crate::arithmetic::{Scalar, epsilon};
use crate::effects::Item;
use crate::error::Error;
use crate::handle::CoordinateId;
use crate::integrate::Method;
use crate::state::State;
use crate::system::{Description, ErasedSystem};
use core::ops::Range;

/// Whether numbers have 24 bits only.
pub(crate) fn is_single<T: Scalar>() -> bool {
    epsilon::<T>() > f64::EPSILON
}

/// Refuses a handle that names nothing in this system: its index is not below the number of items of its kind.
fn check_place(what: &'static str, (index, count): (usize, usize)) -> Result<(), Error> {
    if index < count {
        return Ok(());
    }
    Err(argument(
        what,
        index as f64,
        "less than this system has items of its kind; the handle is one of another system",
    ))
}

/// The error of an argument with this value.
fn argument(what: &'static str, value: f64, expected: &'static str) -> Error {
    Error::Argument {
        what,
        value,
        expected,
    }
}

impl Settings {
    /// Checks what the caller set, the start, and the parameters of the system.
    pub(crate) fn check<T: Scalar>(
        &self,
        system: &dyn ErasedSystem<T>,
        start: &State<T>,
        span: &Range<f64>,
    ) -> Result<(), Error> {
        let d = system.description();
        self.check_tolerances::<T>(d, span.start)?;
        self.check_items(d)?;
        self.check_method()?;
        check_span(span)?;
        start.check_dimension(d.coordinates.len())?;
        for (i, parameter) in d.parameters.iter().enumerate() {
            let value = system.parameter(i).value();
            if !value.is_finite() {
                return Err(argument(parameter.name, value, "finite"));
            }
        }
        check_start(d, start, span.start)
    }

    fn check_tolerances<T: Scalar>(&self, d: &Description, time: f64) -> Result<(), Error> {
        let n = d.coordinates.len();
        let (least, expected) = match is_single::<T>() {
            true => (1e-7, "between 1e-7 and 0.1 in single precision"),
            false => (1e-17, "between 1e-17 and 0.1"),
        };
        if !(least..=0.1).contains(&self.tolerance) {
            return Err(argument("tolerance", self.tolerance, expected));
        }
        for &(CoordinateId(i), _) in &self.absolute {
            check_place("index of the coordinate with its own tolerance", (i, n))?;
        }
        let mut absolute = self.absolute.iter();
        // A size overflows where the relative tolerance is far smaller.
        let usable = |&&(CoordinateId(i), value): &&(CoordinateId, f64)| {
            value > 0.0 && self.sizes[i].is_finite()
        };
        if let Some(&(CoordinateId(i), value)) = absolute.find(|given| !usable(given)) {
            let expected = match value > 0.0 && value.is_finite() {
                true => format!("below {:.1e}", f64::MAX * self.tolerance),
                false => "positive and finite".to_owned(),
            };
            return Err(Error::Domain {
                time,
                item: d.coordinates[i].name,
                what: "absolute tolerance",
                value,
                expected,
                fields: Vec::new(),
            });
        }
        Ok(())
    }

    fn check_items(&self, d: &Description) -> Result<(), Error> {
        for item in self.effects.left_out() {
            let what = "index of the item that is left out";
            let place = item.place(d);
            check_place(what, place)?;
            if matches!(item, Item::Constraint(i) if d.constraints[i].attitude.is_some()) {
                let expected = "that of another item: this one is an attitude, and without the unit length of its quaternion no orientation";
                return Err(argument(what, place.0 as f64, expected));
            }
        }
        for awaited in &self.last_events {
            let what = "index of the item after whose event the run ends";
            let place = awaited.subject.place(d);
            check_place(what, place)?;
            let item = awaited.subject.item();
            if item.is_some_and(|item| !self.effects.includes(d, item)) {
                let expected =
                    "that of one that takes part: this one is left out, and so are its events";
                return Err(argument(what, place.0 as f64, expected));
            }
            if awaited
                .kind
                .is_some_and(|kind| !kind.happens_to(awaited.subject))
            {
                let expected = "that of an item to which an event of this kind can happen: contacts are hit, close and are lost, frictions slip and stick";
                return Err(argument(what, place.0 as f64, expected));
            }
            if awaited.number == 0 {
                let what = "number of the event after which the run ends";
                return Err(argument(
                    what,
                    0.0,
                    "1 or more: the first event has number 1",
                ));
            }
        }
        Ok(())
    }

    fn check_method(&self) -> Result<(), Error> {
        if let Method::RungeKutta4 { step } | Method::Gauss6 { step } = self.method
            && !(step > 0.0 && step.is_finite())
        {
            return Err(argument("step of the method", step, "positive"));
        }
        Ok(())
    }
}

pub(crate) fn check_span(span: &Range<f64>) -> Result<(), Error> {
    for (what, value) in [("first time", span.start), ("last time", span.end)] {
        if !value.is_finite() {
            return Err(argument(what, value, "finite"));
        }
    }
    if span.end < span.start {
        return Err(argument("last time", span.end, "not before the first"));
    }
    let lasts = span.end - span.start;
    if !lasts.is_finite() {
        return Err(argument("last time less the first", lasts, "finite"));
    }
    Ok(())
}

pub(crate) fn check_start<T: Scalar>(
    d: &Description,
    start: &State<T>,
    time: f64,
) -> Result<(), Error> {
    for (what, numbers) in [
        ("position at the start", &start.q),
        ("velocity at the start", &start.v),
    ] {
        let mut numbers = numbers.iter().map(|x| x.value()).enumerate();
        if let Some((i, value)) = numbers.find(|(_, x)| !x.is_finite()) {
            return Err(Error::Domain {
                time,
                item: d.coordinates[i].name,
                what,
                value,
                expected: "finite".to_owned(),
                fields: Vec::new(),
            });
        }
    }
    Ok(())
}
