//! Results in words: an event, an instant, a whole run.

use super::debug::rows;
use super::{Event, EventKind, Instant, Trajectory};
use crate::arithmetic::Scalar;
use crate::handle::Subject;
use crate::shortest::Shortest;
use core::fmt::{Display, Formatter, Result};

/// The event as a sentence, `t = 2.461759150 s: grip starts to slip`.
impl<T: Scalar> Display for Event<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let name = match self.subject {
            Subject::Branch(i) => self.after.side(self.owner.0, i),
            subject => subject.name(self.owner.0),
        };
        let what = match self.kind {
            EventKind::Lost => "lets go",
            EventKind::Closed => "closes and holds",
            EventKind::Impact => "is hit",
            EventKind::Accumulates { .. } => "has bounced infinitely often",
            EventKind::Slips => "starts to slip",
            EventKind::Sticks => "sticks",
            EventKind::Reverses => "reverses its slip",
            EventKind::Branches => "from now on",
            EventKind::Ambiguous => "could go on otherwise",
            EventKind::Stop => "ends the run",
            EventKind::Mark => "is reached",
        };
        write!(f, "t = {:.9} s: {name} {what}", self.time.value())
    }
}

impl Display for EventKind {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(self.word())
    }
}

/// The time, the mode, and positions, velocities, forces and outputs by name.
impl<T: Scalar> Display for Instant<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let d = self.owner.0;
        write!(f, "t = {:.9} s", self.time.value())?;
        if !(d.contacts.is_empty() && d.frictions.is_empty()) {
            write!(f, ": {}", self.mode.display(d))?;
        }
        for (coordinate, q) in d.coordinates.iter().zip(&self.state.q) {
            write!(f, ", {} = {}", coordinate.name, Shortest(q.value()))?;
        }
        for (coordinate, v) in d.coordinates.iter().zip(&self.state.v) {
            write!(f, ", der({}) = {}", coordinate.name, Shortest(v.value()))?;
        }
        for (name, force) in rows(d).iter().zip(&self.forces) {
            write!(f, ", force({name}) = {}", Shortest(force.value()))?;
        }
        for (observe, value) in d.observes.iter().zip(&self.observes) {
            write!(f, ", {} = {}", observe.name, Shortest(value.value()))?;
        }
        Ok(())
    }
}

/// What happened, a line for each event, from the first instant to the last.
impl<T: Scalar> Display for Trajectory<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let name = self.description().name;
        writeln!(f, "t = {:.9} s: {name} starts", self.first_time())?;
        for event in self.events() {
            writeln!(f, "{event}")?;
        }
        let steps = self.work().steps;
        write!(f, "t = {:.9} s: end, after {steps} steps", self.last_time())
    }
}
