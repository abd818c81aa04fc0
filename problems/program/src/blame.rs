//! Why a motion cannot begin, for who wrote the declaration: where the item stands, and the parameter whose value is the cause.
//!
//! A value is the cause if the motion can begin with another one in its place: the default of what was set, or 1 where it is 0.

use crate::request::{Refusal, Request, find_parameters};
use crate::scene::Scene;
use lagrange_core::prelude::Error;

/// What was `told` of a run, with places and the cause if it cannot begin.
pub(crate) fn explained(scene: &dyn Scene, request: &Request, told: &str) -> String {
    let Some(error) = error(scene, request) else {
        return told.to_owned();
    };
    let place = items(&error).iter().find_map(|item| scene.place(item));
    let place = place.map_or(String::new(), |place| format!("{place}: "));
    // Where a message names the number itself there is nothing to look for.
    let cause = match error {
        Error::Domain { .. } => None,
        _ => cause(scene, request),
    };
    let cause = cause.map_or(String::new(), |cause| format!("; {cause}"));
    format!("{place}{told}{cause}")
}

/// Why the motion cannot begin, if it cannot.
fn error(scene: &dyn Scene, request: &Request) -> Option<Error> {
    match scene.modes(request, None) {
        Err(Refusal::Start(error) | Refusal::Run(error)) => Some(error),
        _ => None,
    }
}

/// Items that a message is about; of a value the parameter first.
fn items(error: &Error) -> Vec<&'static str> {
    match error {
        Error::Domain { item, fields, .. } => {
            let fields = fields.iter().map(|(name, _)| *name);
            fields.chain([*item]).collect()
        }
        Error::Start { item, .. }
        | Error::Penetrates { item, .. }
        | Error::Projection { item, .. } => {
            vec![*item]
        }
        Error::Singular { items, .. } => items.clone(),
        _ => Vec::new(),
    }
}

/// The parameter whose value alone is the cause.
fn cause(scene: &dyn Scene, request: &Request) -> Option<String> {
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
        0.0 => Some((i, 1.0)),
        _ => None,
    });
    let mut others = others.filter(|(i, other)| {
        let mut request = request.clone();
        request.parameters = (d.parameters.iter().zip(&values).enumerate())
            .map(|(k, (p, value))| (p.name.to_owned(), if k == *i { *other } else { *value }))
            .collect();
        error(scene, &request).is_none()
    });
    let (i, other) = others.next()?;
    let name = d.parameters[i].name;
    let place = scene.place(name);
    let place = place.map_or(String::new(), |place| format!(" ({place})"));
    Some(format!(
        "the cause is `{name}` = {}{place}: with {other} the motion can begin",
        values[i]
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(set: &[(&str, f64)], start: &[(&str, f64)]) -> String {
        let declared = "parameters(mass = 1, gravity = 9.81,\n h = 0),\ncoordinates(y, z),\n\
            kinetic = mass/2 * der(y)^2 + der(z)^2/2, potential = mass * gravity * y,\n\
            contact(floor: y >= h, restitution = 0),\nstart(up: y = 1), until = 0.1,";
        let scene = crate::file::scene("fall.lagrange", declared).expect("a declaration");
        let own = |list: &[(&str, f64)]| list.iter().map(|(n, x)| ((*n).to_owned(), *x)).collect();
        let request = Request {
            parameters: own(set),
            start: own(start),
            ..Request::default()
        };
        explained(scene, &request, "told")
    }

    #[test]
    fn the_parameter_and_the_place_are_named() {
        assert_eq!(said(&[], &[]), "told");
        assert_eq!(
            said(&[("gravity", 3.0), ("mass", 0.0)], &[]),
            "fall.lagrange:3:13: told; the cause is `mass` = 0 (fall.lagrange:1:12): with 1 the motion can begin"
        );
        assert_eq!(
            said(&[("h", 2.0)], &[]),
            "fall.lagrange:5:9: told; the cause is `h` = 2 (fall.lagrange:2:2): with 0 the motion can begin"
        );
        assert_eq!(said(&[], &[("y", -1.0)]), "fall.lagrange:5:9: told");
        assert_eq!(said(&[("mass", -1.0)], &[]), "fall.lagrange:1:12: told");
    }
}
