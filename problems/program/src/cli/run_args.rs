//! Which run of a scene is meant: arguments that several commands share, and the request that they make.

use super::Trouble;
use super::values::{error, held, named, named_positive, number_of, positive, tolerance};
use crate::catalogue::Catalogue;
use crate::file::{self, ENDING};
use crate::names::method;
use crate::request::{Refusal, Request};
use crate::scene_file::{self, Outputs, SceneFile};
use clap::Args;
use lagrange_core::error::Shortest;
use lagrange_core::prelude::{Impacts, Method};
use std::path::Path;

/// Steps after which a run ends, as [`Simulation::max_steps`](lagrange_core::Simulation::max_steps) has it.
const MOST_STEPS: f64 = 1e8;

/// What is to move, and how exactly it is followed.
#[derive(Args)]
pub(super) struct RunArgs {
    #[command(flatten)]
    pub(super) motion: Motion,
    /// Tolerance of the integration, relative and absolute [default: 1e-9].
    #[arg(long, value_name = "X", value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: Option<f64>,
    /// Absolute tolerance of one coordinate and of its velocity, in its units, instead of the number that stands for all
    /// (x=1e-15); may be repeated.
    #[arg(long, value_name = "NAME=X", value_parser = named_positive, allow_hyphen_values = true)]
    absolute_tolerance: Vec<(String, f64)>,
    /// Error that the final state and the times of all events are to keep, relative above 1 and absolute below; tightens the
    /// tolerance until two runs agree.
    #[arg(long, value_name = "X", value_parser = error, allow_hyphen_values = true, conflicts_with = "tolerance")]
    error: Option<f64>,
    /// Run again at a hundredth of the tolerance, and tell how far off the first run is.
    #[arg(long, conflicts_with = "error")]
    pub(super) estimate: bool,
    /// Method of integration [default: auto].
    #[arg(long, value_name = "M", value_parser = method)]
    method: Option<Method>,
    /// Most events of a run, marks among them; with more it ends with an error [default: 100000; of each run of a sweep 10000].
    #[arg(long, value_name = "N", value_parser = number_of("events", 1, usize::MAX), allow_hyphen_values = true)]
    max_events: Option<usize>,
}

/// What is to move: from which start, under which effects, until when.
#[derive(Args)]
#[command(next_help_heading = "The run")]
pub(super) struct Motion {
    /// Set a parameter, to a number or an expression of numbers (pi/3); may be repeated.
    #[arg(long, value_name = "NAME=VALUE", value_parser = named, allow_hyphen_values = true)]
    set: Vec<(String, f64)>,
    /// The named start to begin from [default: the first].
    #[arg(long, value_name = "START")]
    from: Option<String>,
    /// Hold a coordinate (theta=0.1) or velocity ("der(theta)=2") at the start; the others follow from the named
    /// start: constraints hold, and what is closed or sticks there goes on if it can. May be repeated.
    #[arg(long, value_name = "NAME=VALUE", value_parser = held, allow_hyphen_values = true)]
    start: Vec<(String, f64)>,
    /// Switch an effect on that the scene file has switched off; may be repeated.
    #[arg(long, value_name = "ITEM")]
    with: Vec<String>,
    /// Leave an item of the declaration out: a force, a friction, a contact with all that hangs on it, a stop. It costs
    /// nothing then. May be repeated.
    #[arg(long, value_name = "ITEM")]
    without: Vec<String>,
    /// End of the run, s [default: the scene's].
    #[arg(long, value_name = "T", value_parser = positive, allow_hyphen_values = true)]
    until: Option<f64>,
    /// End the run after an event ("rim lost", or "floor impact 5" for the fifth); if given several times or of an array, once all of them
    /// have happened.
    #[arg(long, value_name = "EVENT")]
    end_after: Vec<String>,
    /// Move a start that violates a constraint onto it instead of refusing it.
    #[arg(long)]
    project: bool,
    /// How impacts at one instant are solved, instead of as the scene declares: `together` or `in_turn`.
    #[arg(long, value_name = "HOW")]
    impacts: Option<Impacts>,
}

impl RunArgs {
    /// The run of the scene of this name, or of a scene file; the command line has the last word.
    pub(super) fn of(&self, name: &str, catalogue: &Catalogue) -> Result<SceneFile, Trouble> {
        let file = self.motion.of(name, catalogue)?;
        let request = Request {
            tolerance: self.tolerance.unwrap_or(file.request.tolerance),
            absolute: instead(file.request.absolute, &self.absolute_tolerance),
            error: match self.tolerance {
                Some(_) => None,
                None => self.error.or(file.request.error),
            },
            estimate: self.estimate || file.request.estimate,
            method: self.method.unwrap_or(file.request.method),
            max_events: self.max_events.or(file.request.max_events),
            ..file.request
        };
        can_end(request.method, request.until.unwrap_or(file.scene.until()))?;
        Ok(SceneFile { request, ..file })
    }
}

impl Motion {
    /// The same, as exact as the scene file has it.
    pub(super) fn of(&self, name: &str, catalogue: &Catalogue) -> Result<SceneFile, Trouble> {
        if let Some(item) = self.with.iter().find(|item| self.without.contains(item)) {
            return Err(Trouble::usage(format_args!(
                "`{item}` is both left out and switched on; give --without or --with"
            )));
        }
        let file = scene(name, catalogue)?;
        Ok(SceneFile {
            request: self.request(file.request),
            ..file
        })
    }

    /// Whether the command line itself gives a parameter or a value of the start.
    pub(super) fn gives(&self, name: &str) -> bool {
        let mut given = self.set.iter().chain(&self.start);
        given.any(|(other, _)| other == name)
    }

    /// The arguments that say the same.
    pub(super) fn arguments(&self) -> Vec<String> {
        let mut all = Vec::new();
        let mut add = |option: &str, value: String| all.extend([option.to_owned(), value]);
        for (name, value) in &self.set {
            add("--set", format!("{name}={}", Shortest(*value)));
        }
        if let Some(start) = &self.from {
            add("--from", start.clone());
        }
        for (name, value) in &self.start {
            add("--start", format!("{name}={}", Shortest(*value)));
        }
        let lists = [
            ("--with", &self.with),
            ("--without", &self.without),
            ("--end-after", &self.end_after),
        ];
        for (option, list) in lists {
            list.iter().for_each(|word| add(option, word.clone()));
        }
        if let Some(until) = self.until {
            add("--until", Shortest(until).to_string());
        }
        if let Some(how) = self.impacts {
            add("--impacts", how.to_string());
        }
        all.extend(self.project.then(|| "--project".to_owned()));
        all
    }

    /// What the arguments leave open is as in `base`.
    fn request(&self, base: Request) -> Request {
        let effects = self.without.iter().map(|name| (name.clone(), false));
        let effects = effects.chain(self.with.iter().map(|name| (name.clone(), true)));
        Request {
            parameters: instead(base.parameters, &self.set),
            from: self.from.clone().or(base.from),
            effects: base.effects.into_iter().chain(effects).collect(),
            start: instead(base.start, &self.start),
            until: self.until.or(base.until),
            end_after: match self.end_after.is_empty() {
                true => base.end_after,
                false => self.end_after.clone(),
            },
            project: self.project || base.project,
            impacts: self.impacts.or(base.impacts),
            ..base
        }
    }
}

/// Refuses steps so short that a run would end after hours, at the limit of their number.
fn can_end(method: Method, until: f64) -> Result<(), Trouble> {
    let (Method::RungeKutta4 { step } | Method::Gauss6 { step }) = method else {
        return Ok(());
    };
    let steps = until / step;
    match steps <= MOST_STEPS {
        true => Ok(()),
        false => Err(Trouble::usage(format_args!(
            "{method}: {until} s are {steps:.0e} steps, which take hours, and a run has at most {MOST_STEPS:e}; choose longer \
             steps, or end earlier with --until"
        ))),
    }
}

/// The scene of this name or declaration (`….lagrange`), or what a file says if it is the path of a scene file (`….toml`).
pub(super) fn scene(name: &str, catalogue: &Catalogue) -> Result<SceneFile, Trouble> {
    if !name.ends_with(".toml") {
        return Ok(SceneFile {
            scene: catalogue
                .find(name)
                .map_err(|refusal| unknown(name, &refusal))?,
            request: Request::default(),
            outputs: Outputs::default(),
        });
    }
    let text = file::read(name).map_err(Trouble::usage)?;
    let folder = Path::new(name).parent().unwrap_or(Path::new(""));
    scene_file::read(&text, folder, catalogue)
        .map_err(|mistake| Trouble::usage(format_args!("{name}:{mistake}")))
}

/// A scene that there is not; perhaps a file was meant.
fn unknown(name: &str, refusal: &Refusal) -> Trouble {
    let files = [".toml", ENDING].map(|ending| format!("{name}{ending}"));
    if let Some(file) = files.iter().find(|file| Path::new(file).is_file()) {
        return Trouble::usage(format_args!(
            "no scene is called `{name}`; did you mean the file `{file}`?"
        ));
    }
    if Path::new(name).is_dir() {
        let folder = name.trim_end_matches('/');
        return Trouble::usage(match Path::new(name).join("Cargo.toml").is_file() {
            true => format!(
                "`{name}` is the folder of a crate, whose own program knows its scenes: go there, and write `cargo run --release -- list`"
            ),
            false => format!(
                "`{name}` is a folder; name a file in it: a declaration, {folder}/NAME{ENDING}, or a scene file, {folder}/NAME.toml"
            ),
        });
    }
    match Path::new(name).is_file() && !name.ends_with(ENDING) {
        true => Trouble::usage(format_args!(
            "`{name}` is no scene; the name of a scene file ends in .toml, that of a declaration in {ENDING}"
        )),
        false => Trouble::usage(refusal),
    }
}

/// The values of `base`, but for those `given`.
fn instead(base: Vec<(String, f64)>, given: &[(String, f64)]) -> Vec<(String, f64)> {
    let stays = |(name, _): &(String, f64)| given.iter().all(|(other, _)| other != name);
    let base = base.into_iter().filter(stays);
    base.chain(given.iter().cloned()).collect()
}
