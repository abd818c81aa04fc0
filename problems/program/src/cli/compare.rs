//! `--compare`: a run that differs in something from another one.

use super::values::{named, positive, tolerance};
use crate::names::{method, nearest};
use crate::request::Request;
use lagrange_core::error::Shortest;
use lagrange_core::prelude::Method;
use std::fmt;
use std::str::FromStr;

/// What is different, one after the other.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Comparison(Vec<Change>);

#[derive(Clone, Debug, PartialEq)]
enum Change {
    Without(String),
    With(String),
    Set(String, f64),
    Start(String, f64),
    From(String),
    Until(f64),
    Tolerance(f64),
    Method(Method),
}

/// What can be changed, and what is said after the colon.
const KINDS: [(&str, &str); 8] = [
    ("without", "ITEM"),
    ("with", "ITEM"),
    ("set", "NAME=VALUE"),
    ("start", "NAME=VALUE"),
    ("from", "START"),
    ("until", "T"),
    ("tolerance", "X"),
    ("method", "M"),
];

impl Comparison {
    /// The run that this one is compared with, changed.
    pub(super) fn of(&self, mut request: Request) -> Request {
        for change in self.0.iter().cloned() {
            match change {
                Change::Without(item) => request.effects.push((item, false)),
                Change::With(item) => request.effects.push((item, true)),
                Change::Set(name, value) => instead(&mut request.parameters, name, value),
                Change::Start(name, value) => instead(&mut request.start, name, value),
                Change::From(start) => request.from = Some(start),
                Change::Until(time) => request.until = Some(time),
                Change::Tolerance(tolerance) => {
                    (request.tolerance, request.error) = (tolerance, None);
                }
                Change::Method(method) => request.method = method,
            }
        }
        request
    }
}

fn instead(list: &mut Vec<(String, f64)>, name: String, value: f64) {
    list.retain(|(other, _)| *other != name);
    list.push((name, value));
}

impl FromStr for Comparison {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let changes = text.split(',').map(change);
        changes.collect::<Result<_, _>>().map(Self)
    }
}

fn change(text: &str) -> Result<Change, String> {
    let (kind, value) = text.split_once(':').unwrap_or((text, ""));
    let (kind, value) = (kind.trim(), value.trim());
    let Some((_, meant)) = KINDS.iter().find(|(name, _)| *name == kind) else {
        let names = KINDS.map(|(name, _)| name);
        let near = nearest(kind, &names).map(|near| format!("did you mean `{near}:`? "));
        let near = near.unwrap_or_default();
        let all = KINDS
            .map(|(name, meant)| format!("{name}:{meant}"))
            .join(", ");
        return Err(format!(
            "`{kind}` cannot be compared; {near}there are {all}"
        ));
    };
    if value.is_empty() {
        return Err(format!("say what: {kind}:{meant}"));
    }
    Ok(match kind {
        "without" => Change::Without(value.to_owned()),
        "with" => Change::With(value.to_owned()),
        "from" => Change::From(value.to_owned()),
        "until" => Change::Until(positive(value)?),
        "tolerance" => Change::Tolerance(tolerance(value)?),
        "method" => Change::Method(method(value)?),
        "set" => named(value).map(|(name, value)| Change::Set(name, value))?,
        _ => named(value).map(|(name, value)| Change::Start(name, value))?,
    })
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, change) in self.0.iter().enumerate() {
            f.write_str(if i == 0 { "" } else { ", " })?;
            match change {
                Change::Without(item) => write!(f, "without {item}")?,
                Change::With(item) => write!(f, "with {item}")?,
                Change::Set(name, value) | Change::Start(name, value) => {
                    write!(f, "{name} = {}", Shortest(*value))?;
                }
                Change::From(start) => write!(f, "from {start}")?,
                Change::Until(time) => write!(f, "until {} s", Shortest(*time))?,
                Change::Tolerance(tolerance) => write!(f, "tolerance {tolerance:e}")?,
                Change::Method(method) => write!(f, "{method}")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_read_made_and_told() {
        let comparison: Comparison =
            "without:grip, set:mass=0.3,tolerance:1e-3,method:gauss6:0.01,start:der(x)=1"
                .parse()
                .expect("a comparison");
        assert_eq!(
            comparison.to_string(),
            "without grip, mass = 0.3, tolerance 1e-3, gauss6:0.01, der(x) = 1"
        );
        let base = Request {
            parameters: vec![("mass".to_owned(), 1.0), ("radius".to_owned(), 2.0)],
            ..Request::default()
        };
        let request = comparison.of(base);
        assert_eq!(request.effects, [("grip".to_owned(), false)]);
        let parameters = [("radius".to_owned(), 2.0), ("mass".to_owned(), 0.3)];
        assert_eq!(request.parameters, parameters);
        assert_eq!((request.tolerance, request.start.len()), (1e-3, 1));
    }

    #[test]
    fn mistakes_say_what_to_write() {
        let said = |text: &str| text.parse::<Comparison>().expect_err("a mistake");
        assert!(said("witout:drag").contains("did you mean `without:`?"));
        assert!(said("drag").contains("without:ITEM"), "{}", said("drag"));
        assert!(said("set:mass").contains("name=value"));
        assert!(said("without:").contains("without:ITEM"));
        assert!(said("method:euler").contains("euler"));
        assert!(said("tolerance:-1").contains("above 0"));
    }
}
