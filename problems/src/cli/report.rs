//! `lagrange report`: runs to look at, as a page, as frames for slides, or as a picture that moves.

use super::Trouble;
use super::compare::Comparison;
use super::course::Course;
use super::output::{ready, to_file};
use super::terminal::{keep_what_is_done, patiently};
use super::values::positive;
use super::watch::watched;
use clap::{Args, ValueEnum};
use lagrange_problems::catalogue::{FILM_STAGES, Scene};
use lagrange_problems::progress::Progress;
use lagrange_problems::report::frames::{self, Clock, Panel};
use lagrange_problems::report::html::{self, Shown};
use lagrange_problems::request::Request;
use std::path::{Path, PathBuf};

/// Heading of what is written, in the help.
const RESULTS: &str = "Results";

/// Run scenes and write a page that shows them.
///
/// Animation, forces and their limits, energy, events, equations. The page is one file and needs no network. For slides: an SVG
/// file that moves by itself, or numbered frames.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange report mass-on-wheel --output wheel.html
  lagrange report mass-on-wheel sticky.toml --output both.html     two runs side by side, on one clock
  lagrange report mass-on-wheel --compare without:grip
  lagrange report double-pendulum --compare tolerance:1e-3,method:dopri5
  lagrange report mass-on-wheel --output wheel.svg                 moves by itself, in browsers and slides
  lagrange report mass-on-wheel --frames frames --fps 25           frames/frame-0001.svg, …")]
pub(super) struct Report {
    /// Scenes, declarations (….lagrange) and scene files (….toml); `lagrange list` shows the scenes.
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<String>,
    #[command(flatten)]
    course: Course,
    /// Beside each scene, the same with something changed: without:ITEM, with:ITEM, set:NAME=VALUE, start:NAME=VALUE,
    /// from:START, until:T, tolerance:X, method:M, or several of them with commas between. May be repeated.
    #[arg(long, help_heading = RESULTS, value_name = "CHANGE", allow_hyphen_values = true)]
    compare: Vec<Comparison>,
    /// What to write [default: svg if the output is called so, else html].
    #[arg(long, help_heading = RESULTS, value_enum)]
    format: Option<Form>,
    /// The file to write [default: report.html, or report.svg].
    #[arg(long, help_heading = RESULTS, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write numbered pictures into a folder instead: frame-0001.svg, frame-0002.svg, … What is there of an earlier, longer
    /// sequence is removed.
    #[arg(long, help_heading = RESULTS, value_name = "DIR", conflicts_with_all = ["format", "output"])]
    frames: Option<PathBuf>,
    /// Pictures a second, of frames and of a picture that moves.
    #[arg(long, help_heading = RESULTS, value_name = "N", default_value = "25", value_parser = positive, allow_hyphen_values = true)]
    fps: f64,
    /// How much faster than it happens it is shown [default: so that it takes some seconds].
    #[arg(long, help_heading = RESULTS, value_name = "X", value_parser = positive, allow_hyphen_values = true)]
    speed: Option<f64>,
    /// Write it again whenever the file of a scene changes, until Ctrl-C.
    #[arg(long)]
    watch: bool,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Form {
    /// A page with everything.
    Html,
    /// A picture that moves.
    Svg,
}

impl Report {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        watched(self.watch, &self.scenes, || self.once())
    }

    fn once(&self) -> Result<(), Trouble> {
        self.form()?;
        ready(self.output.as_deref(), &self.scenes)?;
        let progress = Progress::default();
        progress.expect(self.runs() * FILM_STAGES);
        keep_what_is_done(&progress);
        let runs: Vec<Shown> = patiently("running", &progress, || {
            let names = self.scenes.iter().flat_map(|name| {
                let comparisons = self.compare.iter().map(Some);
                let all = core::iter::once(None).chain(comparisons);
                all.map(move |comparison| (name, comparison))
            });
            let shown = names.map(|(name, comparison)| self.shown(name, comparison, &progress));
            shown.collect::<Result<_, _>>()
        })?;
        self.write(&runs)?;
        let failed = runs.into_iter().find_map(|run| run.film.outcome.failure);
        failed.map_or(Ok(()), |error| Err(Trouble::ended(error)))
    }

    /// How many there are.
    fn runs(&self) -> usize {
        self.scenes.len() * (1 + self.compare.len())
    }

    /// What to write, if it is not frames.
    fn form(&self) -> Result<Form, Trouble> {
        let ending = self.output.as_deref().and_then(Path::extension);
        match (self.format, ending.and_then(|ending| ending.to_str())) {
            (Some(form), _) => Ok(form),
            (None, Some("svg")) => Ok(Form::Svg),
            (None, Some("html" | "htm") | None) => Ok(Form::Html),
            (None, Some(other)) => Err(Trouble::usage(format_args!(
                "a report is no .{other}: let the output end in .html or .svg, or give --format"
            ))),
        }
    }

    fn write(&self, runs: &[Shown]) -> Result<(), Trouble> {
        if self.frames.is_none() && self.form()? == Form::Html {
            let path = self.output.as_deref().unwrap_or(Path::new("report.html"));
            let command = command(std::env::args());
            return to_file(path, |out| {
                html::write(runs, self.speed, Some(&command), out)
            });
        }
        let panels: Vec<Panel> = runs.iter().map(Shown::panel).collect();
        let clock = Clock::new(&panels, self.fps, self.speed).map_err(Trouble::usage)?;
        let Some(folder) = &self.frames else {
            let path = self.output.as_deref().unwrap_or(Path::new("report.svg"));
            let text = frames::animated(&panels, &clock);
            return to_file(path, |out| out.write_all(text.as_bytes()));
        };
        std::fs::create_dir_all(folder).map_err(|error| {
            Trouble::failed(format_args!("cannot make {}: {error}", folder.display()))
        })?;
        let frame = |i: usize| folder.join(format!("frame-{:04}.svg", i + 1));
        for (i, text) in frames::stills(&panels, &clock).enumerate() {
            to_file(&frame(i), |out| out.write_all(text.as_bytes()))?;
        }
        // What is left of a longer sequence would be taken for its end.
        let left = (clock.instants.len()..)
            .map(frame)
            .take_while(|path| path.exists());
        for path in left {
            std::fs::remove_file(&path).map_err(|error| {
                Trouble::failed(format_args!("cannot remove {}: {error}", path.display()))
            })?;
        }
        Ok(())
    }

    /// A scene's run or, with a comparison, the run that differs from it.
    fn shown(
        &self,
        name: &str,
        comparison: Option<&Comparison>,
        progress: &Progress,
    ) -> Result<Shown, Trouble> {
        let file = self.course.of(name)?;
        let request = match comparison {
            Some(comparison) => comparison.of(file.request),
            None => file.request,
        };
        let request = Request {
            samples: html::intervals(file.scene, &request, self.runs()),
            progress: Some(progress.clone()),
            ..request
        };
        let film = file.scene.film(&request).map_err(Trouble::refused)?;
        Ok(Shown {
            title: title(name, file.scene, comparison),
            film,
            derivation: file.scene.derivation(),
        })
    }
}

/// The command that was given, for a shell: what it would take apart stands between quotes.
fn command(arguments: impl Iterator<Item = String>) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+@%".contains(c);
    let quoted = arguments.skip(1).map(|argument| {
        match argument.is_empty() || !argument.chars().all(plain) {
            true => format!("'{}'", argument.replace('\'', "'\\''")),
            false => argument,
        }
    });
    let words: Vec<String> = core::iter::once("lagrange".to_owned())
        .chain(quoted)
        .collect();
    words.join(" ")
}

/// The scene, with the name of the file that describes the run, and what is different.
fn title(name: &str, scene: &dyn Scene, comparison: Option<&Comparison>) -> String {
    let run = match name.strip_suffix(".toml") {
        Some(path) => {
            let stem = path.rsplit(['/', '\\']).next().unwrap_or(path);
            format!("{} ({stem})", scene.name())
        }
        None => name.to_owned(),
    };
    match comparison {
        Some(comparison) => format!("{run}, {comparison}"),
        None => run,
    }
}

#[cfg(test)]
mod tests {
    use super::command;

    #[test]
    fn commands_can_be_given_to_a_shell_again() {
        let given = [
            "/usr/bin/lagrange",
            "report",
            "a b.toml",
            "--set",
            "name=it's",
            "",
        ];
        let told = command(given.into_iter().map(str::to_owned));
        assert_eq!(told, r"lagrange report 'a b.toml' --set 'name=it'\''s' ''");
    }
}
