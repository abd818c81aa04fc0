//! `lagrange run`: one scene, from a start to its end.

use super::compare::Comparison;
use super::output::{self, draw, ready, to_file};
use super::run_args::RunArgs;
use super::terminal::{keep_what_is_done, patiently, remark};
use super::values::{self, number_of, picture};
use super::watch::watched;
use super::{Trouble, went_well};
use crate::catalogue::Catalogue;
use crate::format::RunFormat;
use crate::outcome::Outcome;
use crate::progress::Progress;
use crate::quantity::Show;
use crate::report::plot;
use crate::request::{MOST_SAMPLES, Request};
use crate::results::SAMPLES;
use crate::scene::{RUN_STAGES, Scene};
use crate::scene_file::{self, Outputs};
use clap::Args;
use core::iter;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Run a scene and tell what happened.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange run mass-on-wheel
  lagrange run mass-on-wheel --set mu_static=10 --tolerance 1e-12 --plot wheel.png
  lagrange run mass-on-wheel --plot wheel.pdf --show \"theta, |grip| vs t\"
  lagrange run mass-on-wheel --plot grip.svg --show theta --compare without:grip
  lagrange run rolling-sphere --start theta=0.3 --start \"der(theta)=1\"
  lagrange run rolling-sphere --end-after \"shell lost\" --output run.parquet
  lagrange run mass-on-wheel --without grip --save smooth.toml
  lagrange run smooth.toml --format json
  lagrange run pendulum.lagrange              a declaration of one's own; `lagrange new pendulum` writes one

Ctrl-C ends a run; what there is of it is written. Exit codes: 0 all went well, 1 the run failed or its certificate falls short, 2 the request makes no sense, 130 interrupted.")]
pub(super) struct Run {
    /// The scene, a declaration (….lagrange) or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    #[command(flatten)]
    run: RunArgs,
    #[command(flatten)]
    results: Results,
    /// Run again whenever the file of the scene changes, until Ctrl-C.
    #[arg(long)]
    watch: bool,
}

/// What to write, and where to.
#[derive(Args)]
#[command(next_help_heading = "Results")]
struct Results {
    /// What to write [default: what the name of the output says, else table].
    #[arg(long, value_enum)]
    format: Option<RunFormat>,
    /// Write the run to a file instead of stdout, in the format that its name says: ….csv, ….json, ….jsonl, ….parquet, ….txt.
    /// May be repeated; `-` is stdout.
    #[arg(long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Draw forces, coordinates and outputs over time, or what --show says, into a file ….svg, ….png or ….pdf.
    #[arg(long, value_name = "FILE", value_parser = picture)]
    plot: Option<PathBuf>,
    /// What to draw: "theta, rim vs t", "der(theta) vs theta". Coordinates, velocities, forces, outputs, kinetic, potential,
    /// energy; |grip| and limit(grip) of a friction. A panel for each unit; may be repeated.
    #[arg(long, value_name = "WHAT")]
    show: Vec<String>,
    /// Draw upon it the same run with something changed: set:NAME=VALUE, without:ITEM, method:M, … as `report` has it. May be
    /// repeated.
    #[arg(long, value_name = "CHANGE", allow_hyphen_values = true)]
    compare: Vec<Comparison>,
    /// Equal intervals of time to sample the motion at, beside the ends of its phases [default: 400].
    #[arg(long, value_name = "N", value_parser = number_of("intervals", 1, MOST_SAMPLES), allow_hyphen_values = true)]
    samples: Option<usize>,
    /// Give the work of every item over time (csv, jsonl, parquet: columns; json: a list).
    #[arg(long)]
    ledger: bool,
    /// Write this run down as a scene file.
    #[arg(long, value_name = "FILE.toml", value_parser = values::scene_file)]
    save: Option<PathBuf>,
}

impl Run {
    pub(super) fn execute(self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let names = std::slice::from_ref(&self.scene);
        watched(self.watch, names, || self.once(catalogue))
    }

    fn once(&self, catalogue: &Catalogue) -> Result<(), Trouble> {
        let file = self.run.of(&self.scene, catalogue)?;
        let scene = file.scene;
        remark(scene);
        let outputs = self.results.or(file.outputs);
        let destinations = destinations(&outputs)?;
        let files = destinations.iter().filter_map(|(_, path)| path.as_deref());
        let files = files.chain(outputs.plot.as_deref());
        let files = files.chain(self.results.save.as_deref());
        ready(files, std::slice::from_ref(&self.scene))?;
        let shows = shows(&outputs, &self.results.compare, scene)?;
        let ledger = self.results.ledger || file.request.ledger;
        let sampled = |(format, _): &(RunFormat, _)| format.is_sampled();
        let sampled = ledger || outputs.plot.is_some() || destinations.iter().any(sampled);
        let progress = Progress::default();
        progress.expect(RUN_STAGES * (1 + self.results.compare.len()));
        let request = Request {
            samples: match sampled {
                true => outputs.samples.unwrap_or(SAMPLES),
                false => 0,
            },
            plotted: outputs.plot.is_some(),
            ledger,
            progress: Some(progress.clone()),
            ..file.request
        };
        keep_what_is_done(&progress);
        let words = format!("running {}", scene.name());
        let changes = self.results.compare.iter();
        let changed: Vec<Request> = changes.map(|change| change.of(request.clone())).collect();
        let run = |request: &Request| {
            let outcome = scene.run(request);
            outcome.map_err(|refusal| Trouble::refused_run(refusal, scene, request))
        };
        let (outcome, compared) = patiently(&words, &progress, || -> Result<_, Trouble> {
            let outcome = run(&request)?;
            let compared = changed.iter().map(run);
            Ok((outcome, compared.collect::<Result<Vec<_>, _>>()?))
        })?;
        if let Some(path) = &self.results.save {
            let folder = path.parent().unwrap_or(Path::new(""));
            let text =
                scene_file::write(scene, &request, &outputs, folder).map_err(Trouble::failed)?;
            to_file(path, |out| out.write_all(text.as_bytes()))?;
        }
        // A story without a motion would only hide the error.
        let tells = |destination: &&(RunFormat, Option<PathBuf>)| {
            outcome.has_begun() || *destination != &(RunFormat::Table, None)
        };
        for (format, path) in destinations.iter().filter(tells) {
            write(&outcome, *format, path.as_deref())?;
        }
        let plotted = outputs.plot.as_deref().map_or(Ok(()), |path| {
            let titles: Vec<String> = self
                .results
                .compare
                .iter()
                .map(ToString::to_string)
                .collect();
            let titles = iter::once(scene.name()).chain(titles.iter().map(String::as_str));
            let runs = titles.zip(iter::once(&outcome).chain(&compared));
            let runs: Vec<plot::Run> = runs
                .map(|(title, outcome)| plot::Run { title, outcome })
                .collect();
            draw(path, &plot::svg(&runs, &shows).map_err(Trouble::failed)?)
        });
        // Why a run has failed is also why there is nothing to plot of it.
        let runs = iter::once(outcome).chain(compared);
        let mut runs = runs.zip(iter::once(&request).chain(&changed));
        runs.try_for_each(|(outcome, request)| went_well(outcome, scene, request))?;
        plotted
    }
}

impl Results {
    /// What the command line leaves open is as in a scene file.
    fn or(&self, file: Outputs) -> Outputs {
        Outputs {
            format: self.format.or(file.format),
            output: match self.output.is_empty() {
                true => file.output,
                false => self.output.clone(),
            },
            plot: self.plot.clone().or(file.plot),
            show: match self.show.is_empty() {
                true => file.show,
                false => self.show.clone(),
            },
            samples: self.samples.or(file.samples),
        }
    }
}

/// What is drawn.
fn shows(
    outputs: &Outputs,
    compare: &[Comparison],
    scene: &dyn Scene,
) -> Result<Vec<Show>, Trouble> {
    if outputs.plot.is_none() && !(outputs.show.is_empty() && compare.is_empty()) {
        let reason = "--show and --compare say what to draw; say where with --plot FILE.svg";
        return Err(Trouble::usage(reason));
    }
    let shows = outputs
        .show
        .iter()
        .map(|text| Show::new(text, scene.description()));
    shows.collect::<Result<_, _>>().map_err(Trouble::usage)
}

/// In which format the run goes into which file, or to stdout.
fn destinations(outputs: &Outputs) -> Result<Vec<(RunFormat, Option<PathBuf>)>, Trouble> {
    let file = |path: &PathBuf| output::file(Some(path)).map(Path::to_owned);
    let destinations = match (outputs.format, &outputs.output[..]) {
        (format, []) => vec![(format.unwrap_or(RunFormat::Table), None)],
        (Some(format), [path]) => vec![(format, file(path))],
        (Some(_), _) => {
            let reason =
                "several outputs have the formats that their names say; leave the format out";
            return Err(Trouble::usage(reason));
        }
        (None, paths) => {
            let one = |path: &PathBuf| Ok((RunFormat::named(path)?, file(path)));
            let all: Result<_, String> = paths.iter().map(one).collect();
            all.map_err(Trouble::usage)?
        }
    };
    let stdout = destinations.iter().filter(|(_, path)| path.is_none());
    if stdout.count() > 1 {
        let reason = "two results would go to stdout; give one of them the name of a file";
        return Err(Trouble::usage(reason));
    }
    let bytes = destinations.contains(&(RunFormat::Parquet, None));
    match bytes && std::io::stdout().is_terminal() {
        true => Err(Trouble::usage(
            "Parquet is not for a terminal; add --output run.parquet",
        )),
        false => Ok(destinations),
    }
}

fn write(outcome: &Outcome, format: RunFormat, path: Option<&Path>) -> Result<(), Trouble> {
    match path {
        None => super::print(|out| format.write(outcome, out)),
        Some(path) => to_file(path, |out| format.write_whole(outcome, out)),
    }
}
