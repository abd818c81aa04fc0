//! A worker: an ensemble of runs, over a range of points.

use super::failure::code;
use super::{Sweep, Worker};
use crate::request::{Quantity, Refusal, Start, find_parameter, find_state};
use crate::scene::Scene;
use lagrange_core::prelude::*;
use lagrange_core::system::Description;

/// What an axis varies.
#[derive(Clone, Copy, Debug)]
enum Target {
    /// This parameter.
    Parameter(usize),
    /// This element of what the start holds.
    Held(usize),
}

impl dyn Scene + '_ {
    /// What runs the points of a sweep.
    ///
    /// # Errors
    /// The sweep makes no sense.
    pub fn worker<'a>(&self, sweep: &'a Sweep) -> Result<Worker<'a>, Refusal> {
        let request = &sweep.request;
        let mut system = self.system();
        request.set_parameters(&mut system)?;
        let description = system.description();
        let mut start = Start::new(request, description)?;
        let targets = targets(sweep, description, &mut start)?;
        let mut simulation = request
            .simulation(&system)?
            .record(false)
            .max_events(sweep.most_events());
        let ends: Option<Vec<_>> = sweep.observed.iter().map(|o| o.ends_with()).collect();
        for event in ends.unwrap_or_default() {
            simulation = simulation.end_after(event);
        }
        let mut ensemble = simulation.ensemble();
        let varies = targets
            .iter()
            .any(|target| matches!(target, Target::Parameter(_)));
        let until = request.until.unwrap_or(self.until());
        let mut point = vec![0.0; targets.len()];
        Ok(Box::new(move |points, rows| {
            let first = points.start;
            rows.fill(f64::NAN);
            let mut refused = Vec::new();
            ensemble.run(
                points.len(),
                0.0..until,
                |index, runner| {
                    sweep.points.write(first + index, &mut point);
                    for (&target, &value) in targets.iter().zip(&point) {
                        match target {
                            Target::Parameter(index) => system.set_parameter(index, value),
                            Target::Held(index) => start.held[index].2 = value,
                        }
                    }
                    if varies {
                        runner.set_scene(&system);
                    }
                    let state = start.state(&system, |reference, fixed| {
                        runner.consistent(0.0, reference, fixed)
                    });
                    state
                        .map_err(|error| refused.push((index, code(&error))))
                        .ok()
                },
                |index, outcome, trajectory| {
                    let row = &mut rows[index * sweep.width()..][..sweep.width()];
                    let Some((failed, observed)) = row.split_last_mut() else {
                        return;
                    };
                    *failed = outcome.as_ref().err().map_or(0.0, code);
                    if outcome.is_ok() {
                        for (value, observation) in observed.iter_mut().zip(&sweep.observed) {
                            *value = observation.read(trajectory);
                        }
                    }
                },
            );
            for (index, code) in refused {
                rows[(index + 1) * sweep.width() - 1] = code;
            }
        }))
    }
}

/// What each axis varies. What it varies at the start is held there.
fn targets(
    sweep: &Sweep,
    description: &'static Description,
    start: &mut Start,
) -> Result<Vec<Target>, Refusal> {
    let mut targets: Vec<Target> = Vec::new();
    for axis in &sweep.points.axes {
        let name = &axis.name;
        let parameter = description.parameters.iter().any(|p| p.name == name);
        let target = if parameter {
            let index = find_parameter(description, name)?;
            let twice = |target: &Target| matches!(target, Target::Parameter(i) if *i == index);
            let set = |(other, _): &(String, f64)| other == name;
            if targets.iter().any(twice) || sweep.request.parameters.iter().any(set) {
                return Err(Refusal::Repeated { name: name.clone() });
            }
            Target::Parameter(index)
        } else {
            let (index, level): (usize, Quantity) =
                find_state(description, name).map_err(|_| unknown(description, name))?;
            start.hold(index, level, axis.from, name)?;
            Target::Held(start.held.len() - 1)
        };
        targets.push(target);
    }
    Ok(targets)
}

fn unknown(description: &'static Description, name: &str) -> Refusal {
    let parameters = description.parameters.iter().map(|p| p.name);
    let coordinates = description.coordinates.iter().map(|c| c.name);
    Refusal::unknown(
        "parameter or coordinate",
        name,
        parameters.chain(coordinates),
    )
}
