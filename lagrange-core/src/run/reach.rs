//! Whether a run can come to its end: one that would take more steps than can ever be made is told so, not made until its last step.

use super::Run;
use crate::arithmetic::Scalar;
use crate::error::Error;

/// The first look is after this share of the steps that a run may take,
const FIRST: f64 = 1e-3;
/// and after so many: the first ones may be far shorter than those that follow.
const FEWEST: f64 = 32.0;

/// The end of a run that goes on as it did is out of reach if it needs this many times more than the run may take: motion that dies out is followed by
/// longer and longer steps.
const FAR: f64 = 1e3;

/// No flight between two events takes as many steps. Steps that events end become ever shorter where impacts accumulate, and that comes to an end.
const FLIGHT: usize = 32;

/// Of fewer steps nothing tells that they become ever shorter: close to a position in which constraints lose rank they do so for a while.
const FEWEST_GROWING: f64 = 4096.0;

impl<T: Scalar> Run<T> {
    /// Looks, each time the number of steps has doubled, whether the end of the run is within reach at the rate at which it has gone so far.
    ///
    /// # Errors
    /// [`Error::OutOfReach`] if it is not.
    #[inline]
    pub(super) fn check_reach(&mut self) -> Result<(), Error> {
        match self.recorder.trajectory.work.steps.is_power_of_two() {
            true => self.look_ahead(),
            false => Ok(()),
        }
    }

    #[cold]
    fn look_ahead(&mut self) -> Result<(), Error> {
        let limit = self.settings.max_steps as f64;
        let (made, time) = (
            self.recorder.trajectory.work.steps as f64,
            self.now.t.value(),
        );
        let even = (self.end - time) * (made / (time - self.begin));
        let missing = match even > FAR * limit {
            true => even,
            false => self.growing(made, time),
        };
        self.looks.rotate_left(1);
        self.looks[2] = time;
        match made >= FEWEST.max(FIRST * limit) && missing > FAR * limit {
            true => Err(Error::OutOfReach {
                time,
                end: self.end,
                steps: missing,
                limit: self.settings.max_steps,
            }),
            false => Ok(()),
        }
    }

    /// Steps up to the end of the run if each time in which their number doubles is longer than the one before by the same factor, the larger of the
    /// last two: less than 2 where the motion becomes faster and faster. Of steps that events end nothing is known.
    fn growing(&self, made: f64, time: f64) -> f64 {
        let trajectory = &self.recorder.trajectory;
        if made < FEWEST_GROWING || FLIGHT * trajectory.events.len() > trajectory.work.steps {
            return 0.0;
        }
        let [a, b, c] = self.looks;
        let (earlier, before, mut lasts) = (b - a, c - b, time - c);
        let factor = (lasts / before).max(before / earlier);
        let (mut steps, mut reached) = (made, time);
        while reached < self.end && steps.is_finite() {
            lasts *= factor;
            reached += lasts;
            steps *= 2.0;
        }
        steps
    }
}
