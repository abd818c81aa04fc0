//! Text → what it says, or the first mistake in it.

use super::value::{Value, Wrong, flag, number, positive, table, text, texts};
use super::{KEYS, Mistake, OUTPUTS, Outputs, SceneFile};
use crate::catalogue::Catalogue;
use crate::file::ENDING;
use crate::format::{RunFormat, Still};
use crate::names::{self, nearest};
use crate::quantity::Show;
use crate::request::event;
use crate::request::{
    ERRORS, MOST_SAMPLES, Refusal, Request, TOLERANCES, find_coordinate, find_effects,
    find_parameters, find_start, find_state,
};
use clap::ValueEnum;
use lagrange_core::prelude::{Impacts, Method};
use lagrange_core::system::Description;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use toml::Spanned;
use toml::de::{DeString, DeTable};

/// Reads a scene file about a scene of a catalogue. Its paths begin in `folder`, where it lies.
///
/// # Errors
/// The first mistake, at its place.
pub fn read(text: &str, folder: &Path, catalogue: &Catalogue) -> Result<SceneFile, Mistake> {
    let document = match DeTable::parse(text) {
        Ok(document) => document,
        Err(error) => {
            let byte = error.span().map_or(0, |span| span.start);
            return Err(Mistake::at(text, byte, syntax(text, byte, error.message())));
        }
    };
    let (file, mut mistakes) = contents(document.get_ref(), folder, catalogue);
    mistakes.sort_by_key(|(byte, _)| *byte);
    match (file, mistakes.into_iter().next()) {
        (Some(file), None) => Ok(file),
        (_, Some((byte, reason))) => Err(Mistake::at(text, byte, reason)),
        (None, None) => {
            let reason = "which scene? begin with scene = \"…\"; `lagrange list` shows them";
            Err(Mistake::at(text, 0, reason.to_owned()))
        }
    }
}

/// What the parser says, and what is usually meant.
fn syntax(text: &str, byte: usize, message: &str) -> String {
    let message = message.replace('\n', "; ");
    let (before, after) = text.split_at_checked(byte).unwrap_or((text, ""));
    let begin = before.rfind('\n').map_or(0, |end| end + 1);
    let line = text[begin..].lines().next().unwrap_or_default();
    let name = line.split('=').next().unwrap_or_default().trim();
    let bare = !name.starts_with(['"', '\'', '[', '#']);
    if bare && name.contains(['(', '[']) && after.starts_with(['(', '[', ')']) {
        return format!("{message}; a name with brackets stands in quotes: \"{name}\" = …");
    }
    message
}

/// What the document says as far as it makes sense (nothing if the scene is not known), and what does not.
fn contents(
    document: &DeTable,
    folder: &Path,
    catalogue: &Catalogue,
) -> (Option<SceneFile>, Vec<Wrong>) {
    let mut reader = Reader {
        folder,
        mistakes: Vec::new(),
    };
    reader.known_keys(document, &KEYS, "key");
    let scene = document.get("scene").and_then(|value| {
        let find = |name: &str| match name.ends_with(ENDING) {
            true => catalogue.find(&folder.join(name).to_string_lossy()),
            false => catalogue.find(name),
        };
        reader.take(value, |value| refused(value, find(text(value)?)))
    });
    let Some(scene) = scene else {
        return (None, reader.mistakes);
    };
    let d = scene.description();
    let mut request = Request::default();
    for (key, value) in document {
        match key.get_ref().as_ref() {
            "until" => request.until = reader.take(value, positive),
            "tolerance" => request.tolerance = reader.take(value, tolerance).unwrap_or(1e-9),
            "absolute_tolerance" => {
                request.absolute = reader.pairs(value, |key, value| {
                    refused(key, find_coordinate(d, key.get_ref()))?;
                    Ok((key.get_ref().to_string(), positive(value)?))
                });
            }
            "error" => request.error = reader.take(value, error),
            "estimate" => request.estimate = reader.take(value, flag).unwrap_or_default(),
            "method" => request.method = reader.take(value, method).unwrap_or(request.method),
            "impacts" => request.impacts = reader.take(value, impacts),
            "project" => request.project = reader.take(value, flag).unwrap_or_default(),
            "end_after" => {
                let events = reader.take(value, |value| events(value, d));
                request.end_after = events.unwrap_or_default();
            }
            "max_events" => {
                request.max_events = reader.take(value, |value| count(value, usize::MAX));
            }
            "parameters" => {
                request.parameters = reader.pairs(value, |key, value| {
                    refused(key, find_parameters(d, key.get_ref()))?;
                    Ok((key.get_ref().to_string(), number(value)?))
                });
            }
            "effects" => {
                request.effects = reader.pairs(value, |key, value| {
                    refused(key, find_effects(d, key.get_ref()))?;
                    Ok((key.get_ref().to_string(), flag(value)?))
                });
            }
            "start" => {
                let entries = reader.pairs(value, |key, value| start(key, value, d));
                for entry in entries {
                    match entry {
                        Start::From(name) => request.from = Some(name),
                        Start::Held(name, value) => request.start.push((name, value)),
                    }
                }
            }
            _ => {}
        }
    }
    let outputs = document.get("outputs");
    let outputs = outputs.map(|value| reader.outputs(value, d, &mut request));
    let file = SceneFile {
        scene,
        request,
        outputs: outputs.unwrap_or_default(),
    };
    (Some(file), reader.mistakes)
}

/// What has been wrong so far.
struct Reader<'f> {
    folder: &'f Path,
    mistakes: Vec<Wrong>,
}

impl Reader<'_> {
    /// A file that is named in this one; `-` is stdout.
    fn path(&self, path: PathBuf) -> PathBuf {
        match path == Path::new("-") {
            true => path,
            false => self.folder.join(path),
        }
    }

    /// The value, or a mistake.
    fn take<'v, 't, T>(
        &mut self,
        value: &'v Value<'t>,
        read: impl FnOnce(&'v Value<'t>) -> Result<T, Wrong>,
    ) -> Option<T> {
        read(value)
            .map_err(|mistake| self.mistakes.push(mistake))
            .ok()
    }

    /// The entries of a table.
    fn pairs<'v, 't: 'v, T>(
        &mut self,
        value: &'v Value<'t>,
        read: impl Fn(&'v Spanned<DeString<'t>>, &'v Value<'t>) -> Result<T, Wrong>,
    ) -> Vec<T> {
        let Some(table) = self.take(value, table) else {
            return Vec::new();
        };
        let entries = table
            .iter()
            .map(|(key, value)| read(key, value).map_err(|wrong| misplaced(key, wrong)));
        let (good, bad): (Vec<_>, Vec<_>) = entries.partition(Result::is_ok);
        self.mistakes
            .extend(bad.into_iter().filter_map(Result::err));
        good.into_iter().filter_map(Result::ok).collect()
    }

    fn known_keys(&mut self, table: &DeTable, known: &[&str], what: &'static str) {
        let unknown = table
            .keys()
            .filter(|key| !known.contains(&&**key.get_ref()));
        let mistakes = unknown.map(|key| {
            let refusal = Refusal::unknown(what, key.get_ref(), known.iter().copied());
            misplaced(key, (key.span().start, refusal.to_string()))
        });
        self.mistakes.extend(mistakes);
    }

    fn outputs(&mut self, value: &Value, d: &Description, request: &mut Request) -> Outputs {
        let mut outputs = Outputs::default();
        let Some(table) = self.take(value, table) else {
            return outputs;
        };
        self.known_keys(table, &OUTPUTS, "output");
        for (key, value) in table {
            match key.get_ref().as_ref() {
                "format" => outputs.format = self.take(value, format),
                "output" => {
                    let says = !table.contains_key("format");
                    let paths = self.take(value, |value| results(value, says));
                    let paths = paths.unwrap_or_default().into_iter();
                    outputs.output = paths.map(|path| self.path(path)).collect();
                }
                "plot" => outputs.plot = self.take(value, picture).map(|path| self.path(path)),
                "show" => {
                    outputs.show = self
                        .take(value, |value| shows(value, d))
                        .unwrap_or_default()
                }
                "ledger" => request.ledger = self.take(value, flag).unwrap_or_default(),
                "samples" => outputs.samples = self.take(value, |value| count(value, MOST_SAMPLES)),
                _ => {}
            }
        }
        outputs
    }
}

/// A key above all tables that was written below the head of one: TOML takes it for a key of that table.
fn misplaced(key: &Spanned<DeString>, wrong: Wrong) -> Wrong {
    let name: &str = key.get_ref();
    let at_key = wrong.0 == key.span().start;
    match at_key && KEYS.contains(&name) {
        true => (wrong.0, format!("`{name}` stands above the first [table]")),
        false => wrong,
    }
}

fn refused<K, T>(place: &Spanned<K>, found: Result<T, Refusal>) -> Result<T, Wrong> {
    found.map_err(|refusal| (place.span().start, refusal.to_string()))
}

fn tolerance(value: &Value) -> Result<f64, Wrong> {
    within(TOLERANCES, value, "a tolerance is between 1e-17 and 0.1")
}

fn error(value: &Value) -> Result<f64, Wrong> {
    within(ERRORS, value, "an error is between 1e-15 and 0.1")
}

fn within(allowed: RangeInclusive<f64>, value: &Value, reason: &str) -> Result<f64, Wrong> {
    match positive(value)? {
        number if allowed.contains(&number) => Ok(number),
        _ => Err((value.span().start, reason.to_owned())),
    }
}

/// A method, by its name.
fn method(value: &Value) -> Result<Method, Wrong> {
    let name = text(value)?;
    names::method(name).map_err(|reason| (value.span().start, reason))
}

fn impacts(value: &Value) -> Result<Impacts, Wrong> {
    let known = text(value)?.parse();
    known.map_err(|expected| (value.span().start, format!("impacts are {expected}")))
}

fn format(value: &Value) -> Result<RunFormat, Wrong> {
    let name = text(value)?;
    let formats = RunFormat::value_variants().iter();
    let known: Vec<_> = formats.filter_map(|f| f.to_possible_value()).collect();
    let names = known.iter().map(|known| known.get_name());
    RunFormat::from_str(name, false).map_err(|_| {
        let refusal = Refusal::unknown("format", name, names);
        (value.span().start, refusal.to_string())
    })
}

/// A whole number from 1 to `most`.
fn count(value: &Value, most: usize) -> Result<usize, Wrong> {
    match number(value)? {
        count if count.fract() == 0.0 && (1.0..=most as f64).contains(&count) => Ok(count as usize),
        _ => {
            let reason = format!("a whole number from 1 to {most} is expected here");
            Err((value.span().start, reason))
        }
    }
}

/// Files of numbers, whose names say their formats if nothing else does.
fn results(value: &Value, says: bool) -> Result<Vec<PathBuf>, Wrong> {
    let paths = texts(value)?.into_iter();
    let known = paths.map(|(byte, path)| match RunFormat::named(Path::new(path)) {
        Err(reason) if says => Err((byte, reason)),
        _ => Ok(PathBuf::from(path)),
    });
    known.collect()
}

/// A file for a picture.
fn picture(value: &Value) -> Result<PathBuf, Wrong> {
    let path = PathBuf::from(text(value)?);
    let known = Still::of(&path).map_err(|reason| (value.span().start, reason));
    known.map(|_| path)
}

fn events(value: &Value, d: &'static Description) -> Result<Vec<String>, Wrong> {
    known(value, |name| event::events(name, d).map(drop))
}

/// What a picture shows.
fn shows(value: &Value, d: &Description) -> Result<Vec<String>, Wrong> {
    known(value, |text| Show::new(text, d).map(drop))
}

/// The texts of a list, none of which is refused.
fn known(value: &Value, judge: impl Fn(&str) -> Result<(), Refusal>) -> Result<Vec<String>, Wrong> {
    let texts = texts(value)?.into_iter();
    let known = texts.map(|(byte, text)| match judge(text) {
        Ok(()) => Ok(text.to_owned()),
        Err(refusal) => Err((byte, refusal.to_string())),
    });
    known.collect()
}

/// An entry of the table `start`.
enum Start {
    /// The named start to begin from.
    From(String),
    /// A coordinate or velocity that is held.
    Held(String, f64),
}

fn start(key: &Spanned<DeString>, value: &Value, d: &'static Description) -> Result<Start, Wrong> {
    let name: &str = key.get_ref();
    if name == "from" {
        let from = text(value)?;
        refused(value, find_start(d, from))?;
        return Ok(Start::From(from.to_owned()));
    }
    if let Err(refusal) = find_state(d, name) {
        // `form = "rest"` is no slip of a coordinate.
        let meant = value
            .get_ref()
            .as_str()
            .and_then(|_| nearest(name, &["from"]));
        let reason = match meant {
            Some(_) => format!("a named start is given as from = \"…\", not `{name}`"),
            None => refusal.to_string(),
        };
        return Err((key.span().start, reason));
    }
    Ok(Start::Held(name.to_owned(), number(value)?))
}
