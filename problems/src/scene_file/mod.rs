//! Scene files: a run written down in TOML, and read again with every mistake at its line.
//!
//! ```toml
//! scene = "mass-on-wheel"
//! tolerance = 1e-12
//!
//! [parameters]
//! mu_static = 10
//!
//! [effects]
//! grip = false
//! ```

use crate::catalogue::{self, Scene};
use crate::report::Format;
use crate::request::{Refusal, Request, find_effect, find_parameter, find_start, find_state};
use core::fmt;
use core::ops::Range;
use lagrange_core::prelude::Method;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;
use toml::Spanned;

/// What a scene file says.
pub struct SceneFile {
    /// The scene.
    pub scene: &'static dyn Scene,
    /// The run of it.
    pub request: Request,
    /// Where its results go.
    pub outputs: Outputs,
}

/// Where the results of a run go; what is `None` is as the command line says.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Outputs {
    /// What to print.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub format: Option<Format>,
    /// The file to write it to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<PathBuf>,
    /// The picture to draw.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plot: Option<PathBuf>,
}

impl Outputs {
    fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// What is wrong with a scene file, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// What is wrong, and what to do.
    pub reason: String,
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.reason)
    }
}

impl core::error::Error for Mistake {}

/// The file as it is written. Tables by name, each name with its place.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    scene: Spanned<String>,
    until: Option<Spanned<f64>>,
    tolerance: Option<Spanned<f64>>,
    method: Option<Spanned<String>>,
    #[serde(default)]
    project: bool,
    impacts: Option<Spanned<String>>,
    #[serde(default)]
    parameters: BTreeMap<Spanned<String>, Spanned<f64>>,
    #[serde(default)]
    start: BTreeMap<Spanned<String>, Spanned<Value>>,
    #[serde(default)]
    effects: BTreeMap<Spanned<String>, bool>,
    #[serde(default)]
    outputs: Outputs,
}

/// A value of the table `start`: a number, or the name of the start to begin from.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a number")]
enum Value {
    Number(f64),
    Name(String),
}

/// Reads a scene file.
///
/// # Errors
/// The first mistake, at its place.
pub fn read(text: &str) -> Result<SceneFile, Mistake> {
    let mistake = |span: Range<usize>, reason: String| {
        let before = &text[..span.start.min(text.len())];
        let line = before.rfind('\n').map_or(0, |end| end + 1);
        Mistake {
            line: before.matches('\n').count() + 1,
            column: before[line..].chars().count() + 1,
            reason,
        }
    };
    let refused = |span: Range<usize>| move |refusal: Refusal| mistake(span, refusal.to_string());
    let positive = |number: &Spanned<f64>| match *number.get_ref() {
        x if x.is_finite() && x > 0.0 => Ok(x),
        _ => Err(mistake(
            number.span(),
            "the value must be above 0".to_owned(),
        )),
    };
    let finite = |span: Range<usize>, x: f64| match x.is_finite() {
        true => Ok(x),
        false => Err(mistake(span, "the value must be finite".to_owned())),
    };
    let file: Text = toml::from_str(text).map_err(|error| {
        let reason = error.message().replace('\n', "; ");
        mistake(error.span().unwrap_or(0..0), reason)
    })?;
    let scene = catalogue::find(file.scene.get_ref()).map_err(refused(file.scene.span()))?;
    let description = scene.description();
    let mut request = Request {
        project: file.project,
        ..Request::default()
    };
    if let Some(until) = &file.until {
        request.until = Some(positive(until)?);
    }
    if let Some(tolerance) = &file.tolerance {
        request.tolerance = positive(tolerance)?;
    }
    if let Some(impacts) = &file.impacts {
        let known = impacts.get_ref().parse();
        let refused = |expected| mistake(impacts.span(), format!("impacts are {expected}"));
        request.impacts = Some(known.map_err(refused)?);
    }
    if let Some(method) = &file.method {
        let parsed: Result<Method, _> = method.get_ref().parse();
        request.method = parsed.map_err(|reason| mistake(method.span(), reason.to_string()))?;
    }
    for (name, value) in &file.parameters {
        find_parameter(description, name.get_ref()).map_err(refused(name.span()))?;
        let value = finite(value.span(), *value.get_ref())?;
        request.parameters.push((name.get_ref().clone(), value));
    }
    for (name, on) in &file.effects {
        find_effect(description, name.get_ref()).map_err(refused(name.span()))?;
        request.effects.push((name.get_ref().clone(), *on));
    }
    for (name, value) in &file.start {
        match value.get_ref() {
            Value::Name(start) if name.get_ref() == "from" => {
                find_start(description, start).map_err(refused(value.span()))?;
                request.from = Some(start.clone());
            }
            Value::Number(number) => {
                find_state(description, name.get_ref()).map_err(refused(name.span()))?;
                let number = finite(value.span(), *number)?;
                request.start.push((name.get_ref().clone(), number));
            }
            Value::Name(_) => {
                let reason = "expected a number; a named start is given as from = \"…\"";
                return Err(mistake(value.span(), reason.to_owned()));
            }
        }
    }
    Ok(SceneFile {
        scene,
        request,
        outputs: file.outputs,
    })
}

/// The file as it is written by [`write`].
#[derive(Serialize)]
struct Record<'a> {
    scene: &'a str,
    until: f64,
    tolerance: f64,
    method: String,
    #[serde(skip_serializing_if = "is_false")]
    project: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    impacts: Option<String>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    parameters: BTreeMap<&'a str, f64>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    start: BTreeMap<&'a str, toml::Value>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    effects: BTreeMap<&'a str, bool>,
    #[serde(skip_serializing_if = "Outputs::is_empty")]
    outputs: &'a Outputs,
}

fn is_false(flag: &bool) -> bool {
    !flag
}

/// The scene file of a run; [`read`] gives the same run again.
///
/// # Errors
/// What cannot be written in TOML, as a path that is not Unicode.
pub fn write(
    scene: &dyn Scene,
    request: &Request,
    outputs: &Outputs,
) -> Result<String, toml::ser::Error> {
    let numbers = request.start.iter();
    let numbers = numbers.map(|(name, value)| (name.as_str(), toml::Value::Float(*value)));
    let from = request.from.iter();
    let from = from.map(|name| ("from", toml::Value::String(name.clone())));
    let pairs = request.parameters.iter();
    toml::to_string(&Record {
        scene: scene.name(),
        until: request.until.unwrap_or(scene.until()),
        tolerance: request.tolerance,
        method: request.method.to_string(),
        project: request.project,
        impacts: request.impacts.map(|impacts| impacts.to_string()),
        parameters: pairs.map(|(name, value)| (name.as_str(), *value)).collect(),
        start: from.chain(numbers).collect(),
        effects: request
            .effects
            .iter()
            .map(|(name, on)| (name.as_str(), *on))
            .collect(),
        outputs,
    })
}

#[cfg(test)]
mod tests;
