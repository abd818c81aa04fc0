//! A run → the scene file that gives it again.

use super::Outputs;
use crate::file::ENDING;
use crate::request::Request;
use crate::scene::Scene;
use serde::Serialize;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf, absolute};

/// The file as it is written.
#[derive(Serialize)]
struct Record<'a> {
    scene: Cow<'a, str>,
    until: f64,
    #[serde(skip_serializing_if = "is_empty")]
    end_after: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    max_events: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<f64>,
    #[serde(skip_serializing_if = "is_false")]
    estimate: bool,
    method: String,
    #[serde(skip_serializing_if = "is_false")]
    project: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    impacts: Option<String>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    absolute_tolerance: BTreeMap<&'a str, f64>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    parameters: BTreeMap<&'a str, f64>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    start: BTreeMap<&'a str, toml::Value>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    effects: BTreeMap<&'a str, bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    outputs: Option<Results<'a>>,
}

/// Its table `outputs`.
#[derive(Serialize)]
struct Results<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    format: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    output: Vec<PathBuf>,
    #[serde(skip_serializing_if = "Option::is_none")]
    plot: Option<PathBuf>,
    #[serde(skip_serializing_if = "is_empty")]
    show: &'a [String],
    #[serde(skip_serializing_if = "is_false")]
    ledger: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<usize>,
}

fn is_false(flag: &bool) -> bool {
    !flag
}

fn is_empty<T>(list: &&[T]) -> bool {
    list.is_empty()
}

/// A path as it is written in a file of `folder`.
fn beside(path: &Path, folder: &Path) -> PathBuf {
    if folder.as_os_str().is_empty() || path == Path::new("-") {
        return path.to_owned();
    }
    let (Ok(whole), Ok(folder)) = (absolute(path), absolute(folder)) else {
        return path.to_owned();
    };
    let both = whole.components().zip(folder.components());
    let shared = both.take_while(|(a, b)| a == b).count();
    let below = || folder.components().skip(shared);
    // With nothing but the root in common they have no way to each other that could be kept; `..` may lead through a link.
    if shared <= 1 || below().any(|part| part == Component::ParentDir) {
        return whole;
    }
    let up = below().map(|_| Component::ParentDir);
    up.chain(whole.components().skip(shared)).collect()
}

/// The scene file of a run, for a file in `folder`; [`read`](super::read) gives the same run again.
///
/// # Errors
/// What cannot be written in TOML, as a path that is not Unicode.
pub fn write<'a>(
    scene: &'a dyn Scene,
    request: &'a Request,
    outputs: &'a Outputs,
    folder: &Path,
) -> Result<String, toml::ser::Error> {
    let numbers = request.start.iter();
    let numbers = numbers.map(|(name, value)| (name.as_str(), toml::Value::Float(*value)));
    let from = request.from.iter();
    let from = from.map(|name| ("from", toml::Value::String(name.clone())));
    let pairs = |list: &'a [(String, f64)]| {
        let pairs = list.iter().map(|(name, value)| (name.as_str(), *value));
        pairs.collect()
    };
    let results = Results {
        format: outputs.format.map(|format| format.to_string()),
        output: (outputs.output.iter())
            .map(|path| beside(path, folder))
            .collect(),
        plot: (outputs.plot.as_ref()).map(|path| beside(path, folder)),
        show: &outputs.show,
        ledger: request.ledger,
        samples: outputs.samples,
    };
    let said = request.ledger || *outputs != Outputs::default();
    toml::to_string(&Record {
        scene: match scene.name().ends_with(ENDING) {
            true => {
                let path = beside(Path::new(scene.name()), folder);
                path.to_string_lossy().into_owned().into()
            }
            false => scene.name().into(),
        },
        until: request.until.unwrap_or(scene.until()),
        end_after: &request.end_after,
        max_events: request.max_events,
        // An error is kept whatever the tolerance.
        tolerance: request.error.is_none().then_some(request.tolerance),
        error: request.error,
        estimate: request.estimate,
        method: request.method.to_string(),
        project: request.project,
        impacts: request.impacts.map(|impacts| impacts.to_string()),
        absolute_tolerance: pairs(&request.absolute),
        parameters: pairs(&request.parameters),
        start: from.chain(numbers).collect(),
        effects: request
            .effects
            .iter()
            .map(|(name, on)| (name.as_str(), *on))
            .collect(),
        outputs: said.then_some(results),
    })
}
