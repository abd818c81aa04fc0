//! `lagrange report`: runs to look at, as a page, as frames for slides, or as a picture that moves.

use super::compare::Comparison;
use super::output::{file, put, ready, to_file};
use super::run_args::RunArgs;
use super::shell;
use super::terminal::{keep_what_is_done, patiently};
use super::values::{number_of, positive};
use super::watch::watched;
use super::{Trouble, say, went_well};
use crate::blame;
use crate::catalogue::Catalogue;
use crate::format::Still;
use crate::progress::Progress;
use crate::report::export::{Moving, Pace};
use crate::report::frames::{self, Clock, Panel};
use crate::report::html::{self, Shown};
use crate::request::Request;
use crate::results::unwritten;
use crate::scene::{FILM_STAGES, Scene};
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Heading of what is written, in the help.
const RESULTS: &str = "Results";

/// Run scenes and write a page that shows them.
///
/// Animation, forces and their limits, energy, events, equations. The page is one file and needs no network. For slides: a file
/// that moves by itself (SVG, animated PNG, GIF, MP4), or numbered frames.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange report mass-on-wheel --output wheel.html
  lagrange report mass-on-wheel sticky.toml --output both.html     two runs side by side, on one clock
  lagrange report mass-on-wheel --compare without:grip
  lagrange report double-pendulum --compare tolerance:1e-3,method:dopri5
  lagrange report mass-on-wheel --output wheel.svg                 moves by itself, in browsers and slides
  lagrange report mass-on-wheel --output wheel.gif --fps 10        the same for everywhere else; .png, .mp4
  lagrange report mass-on-wheel --frames frames --fps 25           frames/frame-0001.svg, …
  lagrange report mass-on-wheel --frames frames --fps 5 --format png --width 1920")]
pub(super) struct Report {
    /// Scenes, declarations (….lagrange) and scene files (….toml); `lagrange list` shows the scenes.
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<String>,
    #[command(flatten)]
    run: RunArgs,
    /// Beside each scene, the same with something changed: without:ITEM, with:ITEM, set:NAME=VALUE, start:NAME=VALUE,
    /// from:START, until:T, tolerance:X, method:M, or several of them with commas between. May be repeated.
    #[arg(long, help_heading = RESULTS, value_name = "CHANGE", allow_hyphen_values = true)]
    compare: Vec<Comparison>,
    /// What to write [default: what the name of the output says, else html; of frames svg].
    #[arg(long, help_heading = RESULTS, value_enum)]
    format: Option<Form>,
    /// The file to write: ….html, or a picture that moves, ….svg, ….png, ….gif, ….mp4 [default: report.html]; a page or an SVG may go to
    /// stdout, which is `-`.
    #[arg(long, help_heading = RESULTS, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write numbered pictures into a folder instead: frame-0001.svg, frame-0002.svg, …, or with --format png
    /// frame-0001.png, … What is there of an earlier, longer sequence is removed.
    #[arg(long, help_heading = RESULTS, value_name = "DIR", conflicts_with = "output")]
    frames: Option<PathBuf>,
    /// Pixels from left to right of PNG, GIF and MP4 [default: 1048 for one run, 1000 more for each that stands beside it].
    #[arg(long, help_heading = RESULTS, value_name = "N", value_parser = number_of("pixels", 16, 8192), allow_hyphen_values = true)]
    width: Option<usize>,
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
    /// A picture that moves, of shapes.
    Svg,
    /// A picture that moves, of pixels.
    Png,
    /// The same in 256 colours, which every program shows.
    Gif,
    /// A film; needs the program ffmpeg.
    Mp4,
}

impl Form {
    /// The end of a file's name.
    fn ending(self) -> &'static str {
        match self {
            Form::Html => "html",
            Form::Svg => "svg",
            Form::Png => "png",
            Form::Gif => "gif",
            Form::Mp4 => "mp4",
        }
    }

    /// What it becomes if it is of pixels.
    fn moving(self) -> Option<Moving> {
        match self {
            Form::Html | Form::Svg => None,
            Form::Png => Some(Moving::Png),
            Form::Gif => Some(Moving::Gif),
            Form::Mp4 => Some(Moving::Mp4),
        }
    }
}

/// The run that was asked for.
struct Asked {
    scene: &'static dyn Scene,
    request: Request,
}

impl Report {
    pub(super) fn execute(self, catalogue: &Catalogue) -> Result<(), Trouble> {
        watched(self.watch, &self.scenes, || self.once(catalogue))
    }

    fn once(&self, catalogue: &Catalogue) -> Result<(), Trouble> {
        if let Some(moving) = self.form()?.moving() {
            moving.ready(self.fps).map_err(Trouble::usage)?;
        }
        ready(file(self.output.as_deref()), &self.scenes)?;
        let progress = Progress::default();
        progress.expect(self.runs() * FILM_STAGES);
        keep_what_is_done(&progress);
        let runs: Vec<(Shown, Asked)> = patiently("running", &progress, || {
            let names = self.scenes.iter().flat_map(|name| {
                let comparisons = self.compare.iter().map(Some);
                let all = core::iter::once(None).chain(comparisons);
                all.map(move |comparison| (name, comparison))
            });
            let shown =
                names.map(|(name, comparison)| self.shown(name, catalogue, comparison, &progress));
            shown.collect::<Result<_, _>>()
        })?;
        let (runs, asked): (Vec<Shown>, Vec<Asked>) = runs.into_iter().unzip();
        self.write(&runs)?;
        for run in &runs {
            run.film.not_drawn().iter().for_each(|told| say(told));
        }
        let mut ended = runs.into_iter().zip(asked);
        ended.try_for_each(|(run, asked)| went_well(run.film.outcome, asked.scene, &asked.request))
    }

    /// How many there are.
    fn runs(&self) -> usize {
        self.scenes.len() * (1 + self.compare.len())
    }

    /// What to write.
    fn form(&self) -> Result<Form, Trouble> {
        let ending = self.output.as_deref().and_then(Path::extension);
        let ending = ending.and_then(|ending| ending.to_str());
        let forms = Form::value_variants().iter().copied();
        let form = match (self.format, ending) {
            (Some(form), _) => form,
            (None, None) if self.frames.is_some() => Form::Svg,
            (None, Some("htm") | None) => Form::Html,
            (None, Some(ending)) => forms.clone().find(|form| form.ending() == ending).ok_or_else(|| {
                let endings: Vec<String> = forms.map(|form| format!(".{}", form.ending())).collect();
                Trouble::usage(format_args!(
                    "a report is no .{ending}: let the output end in one of {}, or give --format",
                    endings.join(", ")
                ))
            })?,
        };
        if self.frames.is_some() && !matches!(form, Form::Svg | Form::Png) {
            let reason = "frames are pictures: give --format svg or --format png";
            return Err(Trouble::usage(reason));
        }
        if self.output.as_deref() == Some(Path::new("-")) && form.moving().is_some() {
            let reason = "stdout takes a page or an SVG; name a file for pixels";
            return Err(Trouble::usage(reason));
        }
        Ok(form)
    }

    fn write(&self, runs: &[Shown]) -> Result<(), Trouble> {
        let form = self.form()?;
        let usual = PathBuf::from(format!("report.{}", form.ending()));
        let path = file(self.output.as_deref().or(Some(&usual)));
        if form == Form::Html {
            let command = shell::command(std::env::args().skip(1));
            return put(path, |out| {
                html::write(runs, self.speed, Some(&command), out)
            });
        }
        let seen = |run: &Shown| !run.film.drawings.is_empty() || !run.film.spaces.is_empty();
        if !runs.iter().any(seen) {
            return Err(Trouble::usage(format_args!(
                "nothing of {} is drawn: declare `draw(…)`, or write a page (--output report.html)",
                runs[0].film.outcome.scene
            )));
        }
        let panels: Vec<Panel> = runs.iter().map(Shown::panel).collect();
        let clock = Clock::new(&panels, self.fps, self.speed).map_err(Trouble::usage)?;
        if let Some(folder) = &self.frames {
            return self.frames(&panels, &clock, form, folder);
        }
        let (Some(moving), Some(path)) = (form.moving(), path) else {
            let text = frames::animated(&panels, &clock);
            return put(path, |out| out.write_all(text.as_bytes()));
        };
        let pace = Pace {
            count: clock.instants.len(),
            rate: clock.rate,
            scale: self.scale(&panels),
        };
        moving
            .write(|| frames::stills(&panels, &clock), pace, path)
            .map_err(|error| Trouble::failed(unwritten(path, &error)))
    }

    /// Pixels per unit of a picture.
    fn scale(&self, panels: &[Panel]) -> f32 {
        self.width.map_or(1.0, |width| {
            width as f32 / frames::width(panels.len()) as f32
        })
    }

    /// Writes numbered pictures.
    fn frames(
        &self,
        panels: &[Panel],
        clock: &Clock,
        form: Form,
        folder: &Path,
    ) -> Result<(), Trouble> {
        std::fs::create_dir_all(folder).map_err(|error| {
            let why = match folder.is_file() {
                true => "it is a file; frames go into a folder".to_owned(),
                false => error.to_string(),
            };
            Trouble::failed(format_args!("cannot make {}: {why}", folder.display()))
        })?;
        let frame = |i: usize| folder.join(format!("frame-{:04}.{}", i + 1, form.ending()));
        let pictures: Vec<(usize, String)> = frames::stills(panels, clock).enumerate().collect();
        let scale = self.scale(panels);
        pictures.into_par_iter().try_for_each(|(i, svg)| {
            let still = if form == Form::Png {
                Still::Png
            } else {
                Still::Svg
            };
            to_file(&frame(i), |out| still.write(&svg, scale, out))
        })?;
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
        catalogue: &Catalogue,
        comparison: Option<&Comparison>,
        progress: &Progress,
    ) -> Result<(Shown, Asked), Trouble> {
        let file = self.run.of(name, catalogue)?;
        let request = match comparison {
            Some(comparison) => comparison.of(file.request),
            None => file.request,
        };
        let until = request.until.unwrap_or(file.scene.until());
        let request = Request {
            samples: html::intervals(file.scene.description(), until, self.runs()),
            plotted: self.form()? == Form::Html,
            progress: Some(progress.clone()),
            ..request
        };
        let scene = file.scene;
        let film = scene.film(&request);
        let film = film.map_err(|refusal| Trouble::refused_run(refusal, scene, &request))?;
        let shown = Shown {
            title: title(name, scene, comparison),
            failure: blame::failure(scene, &request, &film.outcome),
            film,
            derivation: scene.derivation(),
        };
        Ok((shown, Asked { scene, request }))
    }
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
