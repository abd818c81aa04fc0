//! Runs side by side: Taylor series of equations that are interpreted are expanded together.

use super::{Progress, Run};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, Packets};
use crate::error::Error;

/// A run among others, and how it ended, once it has.
#[derive(Debug)]
pub(crate) struct Member<'a, T: Scalar> {
    pub(crate) run: &'a mut Run<T>,
    pub(crate) outcome: Option<Result<(), Error>>,
}

/// Goes on with all members until the first of them end. What each does is, bit for bit, what it does alone.
pub(crate) fn go_on<T: Scalar>(packets: &mut Packets<T>, members: &mut [Member<'_, T>]) {
    let order = match members {
        [] => return,
        [first, ..] => first.run.stepper.order,
    };
    loop {
        let mut waiting: Vec<&mut Dynamics<T>> = Vec::with_capacity(members.len());
        for Member { run, .. } in &mut *members {
            if run.awaits_series() {
                run.now.series = Progress::Complete;
                waiting.push(&mut run.dynamics);
            }
        }
        packets.expand(&mut waiting, order);
        let mut ended = false;
        for Member { run, outcome } in &mut *members {
            let step = run.until_it_waits();
            if step.is_err() || !run.goes_on() {
                *outcome = Some(step);
                ended = true;
            }
        }
        if ended {
            return;
        }
    }
}

impl<T: Scalar> Run<T> {
    /// Makes steps until one begins with a series that others may share. Equations that are functions wait for nobody.
    fn until_it_waits(&mut self) -> Result<(), Error> {
        while self.goes_on() {
            self.advance()?;
            if self.awaits_series() {
                break;
            }
        }
        Ok(())
    }

    /// Whether the coming step begins with a series that is begun, but not complete.
    fn awaits_series(&mut self) -> bool {
        // A series that cannot begin is an error of the step.
        let by_series = self.stepper.is_taylor() && self.goes_on();
        by_series && self.begin_series().is_ok() && self.now.series == Progress::Begun
    }
}
