//! Which name did they mean?

use lagrange_core::integrate::ParseMethodError;
use lagrange_core::prelude::Method;

/// The known name nearest to `name`, if it is near enough to be a slip of the finger.
///
/// Distance counts insertions, deletions, substitutions and swaps of neighbours (Damerau 1964); up to a third of
/// the letters may differ, but not all of them.
///
/// A rate in another notation (`thetadot`, `dtheta`, `v_theta`, `theta'`) is near to `der(theta)`, and an array to its first element.
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    if let Some(element) = known.iter().find(|known| is_element(known, name)) {
        return Some(element);
    }
    if let Some(rate) = rate(name, known) {
        return Some(rate);
    }
    let distance = |candidate: &str| strsim::damerau_levenshtein(&name.to_lowercase(), candidate);
    let best = known
        .iter()
        .copied()
        .min_by_key(|candidate| distance(candidate))?;
    let longest = name.chars().count().max(best.chars().count());
    (distance(best) <= longest.div_ceil(3) && distance(best) < longest).then_some(best)
}

/// Whether `name` is an element of what is called `array`, as `x[1]` is of `x` and `der(x[1])` of `der(x)`.
pub(crate) fn is_element(name: &str, array: &str) -> bool {
    let parts = name.split_once('[').zip(name.rsplit_once(']'));
    parts.is_some_and(|((before, _), (_, after))| {
        array.strip_prefix(before).is_some_and(|rest| rest == after)
    })
}

/// The known rate that is meant by a name in another notation.
fn rate<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let suffixes = ["_dot", "dot", "_rate", "'"].map(|end| name.strip_suffix(end));
    let prefixes = ["dot_", "d_", "v_", "d", "v"].map(|begin| name.strip_prefix(begin));
    let stems = suffixes.into_iter().chain(prefixes).flatten();
    let mut rates = stems.map(|stem| format!("der({stem})"));
    rates.find_map(|rate| known.iter().copied().find(|name| *name == rate))
}

/// The method called `name`.
///
/// # Errors
/// What is wrong with the name, with the nearest one that is known.
pub fn method(name: &str) -> Result<Method, String> {
    let known: Vec<&str> = Method::names().collect();
    name.parse()
        .map_err(|error| method_meant(name, &error, &known))
}

/// What other programs call a method, and what it is called here.
const ELSEWHERE: [(&str, &str); 11] = [
    ("rk45", "dopri5"),
    ("ode45", "dopri5"),
    ("dp5", "dopri5"),
    ("rkf45", "dopri5"),
    ("dop54", "dopri5"),
    ("dopri8", "dop853"),
    ("ode89", "verner98"),
    ("vern9", "verner98"),
    ("radau", "radau5"),
    ("bdf", "radau5"),
    ("ode15s", "radau5"),
];

/// What is wrong with the name of a method, with the nearest of those that could be meant.
pub(crate) fn method_meant(name: &str, error: &ParseMethodError, known: &[&str]) -> String {
    let elsewhere = ELSEWHERE.iter();
    let mut elsewhere = elsewhere.filter(|(other, _)| name.eq_ignore_ascii_case(other));
    let meant = elsewhere.next().map(|(_, method)| *method);
    match (error, meant.or_else(|| nearest(name, known))) {
        (ParseMethodError::Unknown { name }, Some(near)) => {
            format!("no method is called `{name}`; did you mean `{near}`?")
        }
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::{method, nearest};

    #[test]
    fn a_method_is_recognised_by_its_name_in_other_programs() {
        for (name, meant) in [
            ("rk45", "dopri5"),
            ("RK45", "dopri5"),
            ("ode45", "dopri5"),
            ("Radau", "radau5"),
            ("dopri", "dopri5"),
        ] {
            let said = method(name).expect_err(name);
            assert_eq!(
                said,
                format!("no method is called `{name}`; did you mean `{meant}`?")
            );
        }
    }

    #[test]
    fn a_slip_is_recognised_and_nonsense_is_not() {
        let known = ["mass-on-wheel", "mass-on-shell", "rolling-sphere"];
        assert_eq!(nearest("mass-on-whele", &known), Some("mass-on-wheel"));
        assert_eq!(nearest("Rolling-Sphere", &known), Some("rolling-sphere"));
        assert_eq!(nearest("pendulum", &known), None);
        assert_eq!(nearest("x", &[]), None);
        assert_eq!(nearest("x", &["t"]), None);
    }

    #[test]
    fn an_array_means_its_first_element() {
        let known = ["ul", "up[0]", "up[1]", "der(up[0])"];
        assert_eq!(nearest("up", &known), Some("up[0]"));
        assert_eq!(nearest("der(up)", &known), Some("der(up[0])"));
    }

    #[test]
    fn rates_are_recognised_in_other_notations() {
        let known = ["theta", "der(theta)", "d", "der(d)"];
        for name in [
            "thetadot",
            "theta_dot",
            "dtheta",
            "v_theta",
            "theta'",
            "dot_theta",
        ] {
            assert_eq!(nearest(name, &known), Some("der(theta)"), "{name}");
        }
        assert_eq!(nearest("ddot", &known), Some("der(d)"));
        assert_eq!(nearest("thet", &known), Some("theta"));
    }
}
