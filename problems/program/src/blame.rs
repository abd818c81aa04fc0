//! Why a motion cannot begin, for who wrote the declaration: where the item stands, and the parameter whose value is the cause.
//!
//! A value is the cause if the motion can begin with another one in its place: the default of what was set; or 1 where it is 0 and something has no value, as
//! in a division by it, or no inertia.

use crate::outcome::Outcome;
use crate::request::{Refusal, Request, find_parameters};
use crate::scene::Scene;
use lagrange_core::error::Shortest;
use lagrange_core::prelude::Error;

/// What a refusal tells; with places and the cause if the motion cannot begin.
pub(crate) fn refusal(scene: &dyn Scene, request: &Request, refusal: &Refusal) -> String {
    let told = refusal.to_string();
    match refusal {
        Refusal::Start(error) | Refusal::Begin(error) => explained(scene, request, error, told),
        _ => told,
    }
}

/// The same of the error that has ended a run, if one has.
pub(crate) fn failure(scene: &dyn Scene, request: &Request, outcome: &Outcome) -> Option<String> {
    let error = outcome.failure.as_ref()?;
    let told = error.to_string();
    Some(match outcome.has_begun() {
        true => told,
        false => explained(scene, request, error, told),
    })
}

/// What was `told` of an error because of which a motion does not begin.
fn explained(scene: &dyn Scene, request: &Request, error: &Error, told: String) -> String {
    let Some(items) = items(error) else {
        return told;
    };
    let place = items.iter().find_map(|item| scene.place(item));
    let place = place.map_or(String::new(), |place| format!("{place}: "));
    // Where a message names the number itself there is nothing to look for.
    let cause = match error {
        Error::Domain { fields, .. } if !fields.is_empty() => None,
        _ => cause(scene, request, error),
    };
    let cause = cause.map_or(String::new(), |cause| format!("; {cause}"));
    let of_state = match error {
        Error::Domain { .. } => false,
        _ => scene.description().starts.is_empty(),
    };
    let zero = match of_state {
        true => {
            "; no `start(…)` is declared, so that coordinates and velocities that are not given are 0"
        }
        false => "",
    };
    format!("{place}{told}{cause}{zero}")
}

/// Items that a message about a start names, of a value the parameter first; nothing of an error that is none of the start.
fn items(error: &Error) -> Option<Vec<&'static str>> {
    Some(match error {
        Error::Domain { item, fields, .. } => {
            let fields = fields.iter().map(|(name, _)| *name);
            fields.chain([*item]).collect()
        }
        Error::Start { item, .. }
        | Error::Penetrates { item, .. }
        | Error::Projection { item, .. }
        | Error::NoMode { item, .. }
        | Error::NoImpact { item, .. } => {
            vec![*item]
        }
        Error::Singular { items, .. } => items.clone(),
        Error::NotFinite { item, .. } => item.iter().copied().collect(),
        _ => return None,
    })
}

/// The parameter whose value alone is the cause.
fn cause(scene: &dyn Scene, request: &Request, error: &Error) -> Option<String> {
    let by_zero = matches!(
        error,
        Error::Domain { .. } | Error::Singular { .. } | Error::NotFinite { .. }
    );
    let (d, defaults) = (scene.description(), scene.defaults());
    let mut values = defaults.clone();
    for (name, value) in &request.parameters {
        for parameter in find_parameters(d, name).ok()? {
            values[parameter] = *value;
        }
    }
    let others = values.iter().zip(&defaults).enumerate();
    let others = others.filter_map(|(i, (value, default))| match *value {
        set if set != *default => Some((i, *default)),
        0.0 if by_zero => Some((i, 1.0)),
        _ => None,
    });
    let mut others = others.filter(|(i, other)| {
        let mut request = request.clone();
        request.parameters = (d.parameters.iter().zip(&values).enumerate())
            .map(|(k, (p, value))| (p.name.to_owned(), if k == *i { *other } else { *value }))
            .collect();
        scene.modes(&request, None).is_ok()
    });
    let (i, other) = others.next()?;
    let name = d.parameters[i].name;
    let place = scene.place(name);
    let place = place.map_or(String::new(), |place| format!(" ({place})"));
    Some(format!(
        "the cause is `{name}` = {}{place}: with {} the motion can begin",
        Shortest(values[i]),
        Shortest(other)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(set: &[(&str, f64)], start: &[(&str, f64)]) -> String {
        let declared = "parameters(mass = 1, gravity = 9.81,\n h = 0, top = 0),\ncoordinates(y, z),\n\
            kinetic = mass/2 * der(y)^2 + der(z)^2/2, potential = mass * gravity * y,\n\
            contact(floor: y >= h, restitution = 0),\nstart(up: y = 1, z = sqrt(top)), until = 0.1,";
        let scene = crate::file::scene("fall.lagrange", declared).expect("a declaration");
        let own = |list: &[(&str, f64)]| list.iter().map(|(n, x)| ((*n).to_owned(), *x)).collect();
        let request = Request {
            parameters: own(set),
            start: own(start),
            ..Request::default()
        };
        told(scene, &request)
    }

    /// What is said of a run, if anything.
    fn told(scene: &dyn Scene, request: &Request) -> String {
        match scene.run(request) {
            Ok(outcome) => failure(scene, request, &outcome).unwrap_or_default(),
            Err(refused) => refusal(scene, request, &refused),
        }
    }

    #[test]
    fn a_start_that_is_not_declared_is_told() {
        let declared = "parameters(mass = 1, h = 1), coordinates(y), kinetic = mass/2 * der(y)^2,\n\
            contact(floor: y >= h), until = 0.1,";
        let scene = crate::file::scene("fall.lagrange", declared).expect("a declaration");
        let request = Request {
            parameters: vec![("h".to_owned(), 2.0)],
            ..Request::default()
        };
        let told = told(scene, &request);
        let zero = "; no `start(…)` is declared, so that coordinates and velocities that are not given are 0";
        assert!(
            told.contains("is below the surface of `floor`") && told.ends_with(zero),
            "{told}"
        );
    }

    #[test]
    fn the_parameter_and_the_place_are_named() {
        assert_eq!(said(&[], &[]), "");
        for (told, place, cause) in [
            (
                said(&[("gravity", 3.0), ("mass", 0.0)], &[]),
                "fall.lagrange:3:13: t = 0",
                "; the cause is `mass` = 0 (fall.lagrange:1:12): with 1 the motion can begin",
            ),
            (
                said(&[("mass", 1e308)], &[]),
                "t = 0",
                "; the cause is `mass` = 1e308 (fall.lagrange:1:12): with 1 the motion can begin",
            ),
            (
                said(&[("top", -1.0)], &[]),
                "fall.lagrange:3:16: t = 0: `z`: position at the start = NaN; it must be finite",
                "; the cause is `top` = -1 (fall.lagrange:2:9): with 0 the motion can begin",
            ),
            (
                said(&[("h", 2.0)], &[]),
                "fall.lagrange:5:9: the start is below",
                "; the cause is `h` = 2 (fall.lagrange:2:2): with 0 the motion can begin",
            ),
        ] {
            assert!(told.starts_with(place) && told.ends_with(cause), "{told}");
        }
        for (told, place) in [
            (
                said(&[], &[("y", -1.0)]),
                "fall.lagrange:5:9: the start is below",
            ),
            (said(&[("mass", -1.0)], &[]), "fall.lagrange:1:12: t = 0"),
        ] {
            assert!(
                told.starts_with(place) && !told.contains("the cause"),
                "{told}"
            );
        }
    }
}
