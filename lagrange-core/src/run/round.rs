//! Runs side by side: each makes one step, and their Taylor series are expanded together.

use super::{Progress, Run, Stepper};
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
        [first, ..] => first.run.order,
    };
    loop {
        let mut waiting: Vec<&mut Dynamics<T>> = Vec::with_capacity(members.len());
        for Member { run, .. } in &mut *members {
            if run.awaits_series() {
                run.series = Progress::Complete;
                waiting.push(&mut run.dynamics);
            }
        }
        packets.expand(&mut waiting, order);
        let mut ended = false;
        for Member { run, outcome } in &mut *members {
            let step = if run.goes_on() { run.advance() } else { Ok(()) };
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
    /// Whether the coming step begins with a series that is begun, but not complete.
    fn awaits_series(&mut self) -> bool {
        let taylor = matches!(self.stepper, Stepper::Taylor(_)) && self.goes_on();
        // A series that cannot begin is an error of the step.
        taylor && self.begin_series().is_ok() && self.series == Progress::Begun
    }
}
