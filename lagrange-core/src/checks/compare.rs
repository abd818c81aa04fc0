//! A derived number against a formula at many states, and the state where they differ most.

use super::state::Checks;
use crate::error::Error;
use crate::shortest::Shortest;
use crate::system::System;
use crate::trajectory::Instant;
use core::fmt;

/// The result of a comparison.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Number of states.
    pub states: usize,
    /// Largest difference that counts as rounding.
    pub tolerance: f64,
    /// Where they differ most.
    pub worst: Worst,
    /// (name, value) there: parameters, coordinates, velocities, the time `t`.
    pub state: Vec<(String, f64)>,
    /// The mode there, `shell closed`.
    pub mode: String,
}

/// Two numbers that should be one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// What the derived equations give.
    pub derived: f64,
    /// What the formula gives.
    pub by_hand: f64,
    /// |derived − by hand| over the larger of both and 1; infinite where one is not a number.
    pub difference: f64,
}

impl Worst {
    fn of(derived: f64, by_hand: f64) -> Worst {
        let size = derived.abs().max(by_hand.abs()).max(1.0);
        let difference = (derived - by_hand).abs() / size;
        Worst {
            derived,
            by_hand,
            difference: match difference.is_finite() {
                true => difference,
                false => f64::INFINITY,
            },
        }
    }
}

impl Comparison {
    /// Whether no state shows more than rounding.
    pub fn holds(&self) -> bool {
        self.worst.difference <= self.tolerance
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Worst {
            derived,
            by_hand,
            difference,
        } = self.worst;
        write!(
            f,
            "derived {}, by hand {} (difference {difference:.1e}, the worst of {} states, {}) at",
            Shortest(derived),
            Shortest(by_hand),
            self.states,
            self.mode
        )?;
        for (i, (name, value)) in self.state.iter().enumerate() {
            write!(
                f,
                "{} {name} = {}",
                if i == 0 { "" } else { "," },
                Shortest(*value)
            )?;
        }
        Ok(())
    }
}

/// For each state wanted, so many are tried.
const TRIES: usize = 20;

impl<S: System<Scalar = f64>> Checks<'_, S> {
    /// Compares a derived number with a formula: (derived, by hand) from the scene with its parameters and the instant.
    ///
    /// # Errors
    /// [`Error::Projection`] and the like if the mode has no states near.
    pub fn compare(
        &self,
        both: impl Fn(&S, &Instant<f64>) -> (f64, f64),
    ) -> Result<Comparison, Error> {
        let mut worst: Option<(Worst, S, Instant<f64>)> = None;
        let mut states = 0;
        for number in 0..TRIES * self.states.max(1) {
            if states == self.states.max(1) {
                break;
            }
            let (scene, now) = match self.draw(number) {
                Ok(drawn) => drawn,
                // Some states have no neighbour on the constraints.
                Err(error) if number + 1 == TRIES * self.states.max(1) && states == 0 => {
                    return Err(error);
                }
                Err(_) => continue,
            };
            states += 1;
            let (derived, by_hand) = both(&scene, &now);
            let here = Worst::of(derived, by_hand);
            if worst
                .as_ref()
                .is_none_or(|(worst, ..)| here.difference > worst.difference)
            {
                worst = Some((here, scene, now));
            }
        }
        let Some((worst, scene, now)) = worst else {
            return Err(Error::Projection {
                time: 0.0,
                residual: f64::INFINITY,
                item: self.scene.description().name,
            });
        };
        Ok(Comparison {
            states,
            tolerance: self.tolerance,
            worst,
            state: numbers(&scene, &now),
            mode: now.mode.display(scene.description()).to_string(),
        })
    }
}

/// (name, value) of parameters, coordinates, velocities and the time.
fn numbers<S: System<Scalar = f64>>(scene: &S, now: &Instant<f64>) -> Vec<(String, f64)> {
    let d = scene.description();
    let mut state = Vec::new();
    for (i, parameter) in d.parameters.iter().enumerate() {
        state.push((parameter.name.to_owned(), scene.parameter(i)));
    }
    for (coordinate, &q) in d.coordinates.iter().zip(&now.state.q) {
        state.push((coordinate.name.to_owned(), q));
    }
    for (coordinate, &v) in d.coordinates.iter().zip(&now.state.v) {
        state.push((format!("der({})", coordinate.name), v));
    }
    state.push(("t".to_owned(), now.time));
    state
}
