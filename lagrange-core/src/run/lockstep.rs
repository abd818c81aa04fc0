//! Runs side by side: each makes one step, and their Taylor series are expanded together.

use super::{Progress, Run};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, Lanes, Packets, Start};
use crate::error::Error;
use crate::trajectory::State;

/// A run among others, and how it ended, once it has.
#[derive(Debug)]
pub(crate) struct Member<'a, T: Scalar> {
    pub(crate) run: &'a mut Run<T>,
    pub(crate) outcome: Option<Result<(), Error>>,
}

/// What expands series of several runs at once: by functions, and by the interpreter.
#[derive(Debug)]
pub(crate) struct Together<T: Scalar> {
    pub(crate) lanes: Lanes<T>,
    pub(crate) packets: Packets<T>,
}

/// Goes on with all members until the first of them end. What each does is, bit for bit, what it does alone.
pub(crate) fn go_on<T: Scalar>(together: &mut Together<T>, members: &mut [Member<'_, T>]) {
    let Together { lanes, packets } = together;
    let order = match members {
        [] => return,
        [first, ..] => first.run.stepper.order,
    };
    loop {
        let at_start = |member: &Member<'_, T>| member.run.begins_step();
        let mut starts: Vec<_> = (members.iter_mut().filter(|m| at_start(m)))
            .map(|member| member.run.start_of_step())
            .collect();
        lanes.expand(&mut starts, order);
        let expanded: Vec<bool> = starts.iter().map(|start| start.expanded).collect();
        let begins = members.iter_mut().filter(|m| at_start(m));
        for (member, _) in begins.zip(expanded).filter(|(_, expanded)| *expanded) {
            member.run.now.series = Progress::Complete;
        }
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
    /// Whether the coming step begins with a series of which nothing is there.
    fn begins_step(&self) -> bool {
        self.steps_by_series() && self.now.series == Progress::None
    }

    /// The motion at the start of the coming step.
    fn start_of_step(&mut self) -> Start<'_, T> {
        let State { q, v, .. } = &self.now.state;
        Start {
            dynamics: &mut self.dynamics,
            t: self.now.t,
            q,
            v,
            expanded: false,
        }
    }

    /// Whether the coming step begins with a series that is begun, but not complete.
    fn awaits_series(&mut self) -> bool {
        // A series that cannot begin is an error of the step.
        self.steps_by_series() && self.begin_series().is_ok() && self.now.series == Progress::Begun
    }

    /// Whether there is a coming step, and a series makes it.
    fn steps_by_series(&self) -> bool {
        self.stepper.is_taylor() && self.goes_on()
    }
}
