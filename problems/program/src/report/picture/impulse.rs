//! Impulses of impacts over the samples of a film: each is there from its instant on, less and less until it is gone, so that it can be
//! drawn like a force.

use crate::outcome::Outcome;
use lagrange_core::prelude::{Event, EventKind};

/// Part of a film for which an impulse is seen.
const SEEN: f64 = 0.05;

/// What acts along every row at every sample: forces, N, or impulses, N s.
pub(super) type Rows = Vec<Vec<f64>>;

/// The forces of every row at every sample.
pub(super) fn forces(outcome: &Outcome) -> Rows {
    outcome
        .samples
        .iter()
        .map(|sample| sample.forces.clone())
        .collect()
}

/// The impulses of every row at every sample: those of the last impact that it takes part in; nothing at all without impacts.
pub(super) fn impulses(outcome: &Outcome) -> Rows {
    let blows: Vec<_> = outcome
        .events
        .iter()
        .filter(|event| event.kind == EventKind::Impact)
        .collect();
    let (Some(first), Some(last), false) = (outcome.first(), outcome.last(), blows.is_empty())
    else {
        return Vec::new();
    };
    let long = SEEN * (last.time - first.time);
    let rows = outcome.samples.iter().map(|sample| {
        let mut rows = vec![0.0; sample.forces.len()];
        let early = blows.partition_point(|event| event.time <= sample.time - long);
        let begun = outcome
            .phases
            .get(sample.phase)
            .map_or(first.time, |phase| phase.from);
        // What ends with an impact is before it.
        let happened = |event: &&&Event<f64>| {
            event.time < sample.time || event.time == sample.time && begun >= event.time
        };
        for event in blows[early..].iter().take_while(happened) {
            let left = 1.0 - (sample.time - event.time) / long;
            for (row, impulse) in rows
                .iter_mut()
                .zip(&event.impulses)
                .filter(|(_, impulse)| **impulse != 0.0)
            {
                *row = left * impulse;
            }
        }
        rows
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file;
    use crate::request::Request;

    /// A ball falls from rest: the impulse of its first impact is m (1 + e) v, and it is seen from then on.
    #[test]
    fn an_impulse_begins_with_its_impact_and_fades() {
        let ball = "parameters(mass = 1, gravity = 9.81), coordinates(y), kinetic = mass/2 * der(y)^2,
            potential = mass * gravity * y, contact(floor: y >= 0, restitution = 0.9), start(dropped: y = 1)";
        let scene = file::scene("ball.lagrange", ball).expect("a declaration");
        let request = Request {
            samples: 400,
            until: Some(2.0),
            ..Request::default()
        };
        let outcome = scene.run(&request).expect("a run");
        let blow = outcome
            .events
            .iter()
            .find(|event| event.kind == EventKind::Impact)
            .expect("an impact");
        let row = (0..blow.impulses.len())
            .find(|row| blow.impulses[*row] != 0.0)
            .expect("an impulse");
        let rows = impulses(&outcome);
        let seen = |k: usize| rows[k][row];
        let after = outcome
            .samples
            .iter()
            .position(|sample| sample.time > blow.time)
            .expect("a sample");
        let left = 1.0 - (outcome.samples[after].time - blow.time) / (SEEN * 2.0);
        assert_eq!(
            (seen(after - 1), seen(after)),
            (0.0, left * blow.impulses[row])
        );
        assert!(seen(after + 5) < seen(after) && seen(after + 5) > 0.0);
        let gone = outcome
            .samples
            .iter()
            .position(|sample| sample.time > blow.time + 0.1)
            .expect("a sample");
        assert_eq!(seen(gone), 0.0);
    }
}
