//! What the program makes of a run, for a run from code: its story, a plot, a page, its numbers.

use crate::film::{Reel, instants};
use crate::format::{RunFormat, Still};
use crate::outcome::Outcome;
use crate::quantity::Show;
use crate::report::export::{Moving, Pace};
use crate::report::frames::{self, Clock};
use crate::report::html::{self, Shown};
use crate::report::plot;
use crate::request::Request;
use lagrange_core::prelude::*;
use std::fs;
use std::io;
use std::path::Path;

/// Intervals at which tables of numbers and plots sample a trajectory.
pub const SAMPLES: usize = 400;

/// Pixels per unit of plots: fine enough for print at their usual size.
pub const PLOTS: f32 = 2.0;

/// Pictures a second of a report that moves.
const RATE: f64 = 25.0;

/// What a [`Trajectory`] can be made into, and the [`Failure`] of a run, which has a trajectory until then and its error.
///
/// ```
/// use lagrange_core::prelude::*;
/// use lagrange_program::Results;
///
/// /// A ball falls, and bounces.
/// #[derive(Lagrangian, Clone, Debug)]
/// #[lagrange(
///     coordinates(y: "m"),
///     kinetic   = mass/2 * der(y)^2,
///     potential = mass * gravity * y,
///     contact(floor: y >= 0, restitution = 1/2),
///     start(dropped: y = 1),
///     draw(floor: 0),
///     draw(mass: (0, y)),
/// )]
/// struct Ball {
///     mass: f64,
///     gravity: f64,
/// }
///
/// let ball = Ball { mass: 1.0, gravity: 9.81 };
/// let run = Simulation::new(&ball).run(ball.at(Ball::DROPPED), 0.0..2.0)?;
/// println!("{}", run.story());
/// # let folder = std::env::temp_dir().join(format!("lagrange-results-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder)?;
/// # std::env::set_current_dir(&folder)?;
/// run.plot("ball.svg")?;          // or .png, .pdf
/// run.report("ball.html")?;       // or a picture that moves: .svg, .png, .gif, .mp4
/// run.write("ball.csv")?;         // or .parquet, .json, .jsonl, .txt
/// # for (file, holds) in [("ball.svg", "<svg"), ("ball.html", "A ball falls"), ("ball.csv", "force(floor)")] {
/// #     assert!(std::fs::read_to_string(file)?.contains(holds), "{file}");
/// # }
/// # std::env::set_current_dir("/")?;
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// A run that failed half-way is in its error: `stopped.story()` tells what there is of it, and why it ended.
pub trait Results {
    /// The motion.
    fn motion(&self) -> &Trajectory;

    /// Why it ended early, if it did.
    fn error(&self) -> Option<&Error>;

    /// What happened, as `lagrange run` tells it, and the error of a run that failed.
    fn story(&self) -> String {
        let mut text = Vec::new();
        // Nothing fails that is written to memory.
        let _ = RunFormat::Table.write_whole(&outcome(self, &Request::default()), &mut text);
        String::from_utf8_lossy(&text).into_owned()
    }

    /// Draws forces, coordinates and outputs over time into a file ….svg, ….png or ….pdf.
    ///
    /// # Errors
    /// The name ends otherwise, the file cannot be written, or there is nothing to draw.
    fn plot(&self, path: impl AsRef<Path>) -> io::Result<()> {
        self.plot_of(path, &[])
    }

    /// Draws quantities into a file ….svg, ….png or ….pdf: `["theta, rim vs t", "der(theta) vs theta"]`, as `--show` names them.
    ///
    /// # Errors
    /// The name ends otherwise, the file cannot be written, a quantity is not known, or the run was not recorded.
    fn plot_of(&self, path: impl AsRef<Path>, shows: &[&str]) -> io::Result<()> {
        let path = path.as_ref();
        let still = Still::of(path).map_err(refused)?;
        let shows = shows
            .iter()
            .map(|text| Show::new(text, self.motion().description()));
        let shows: Vec<Show> = shows.collect::<Result<_, _>>().map_err(refused)?;
        self.motion().check_recorded().map_err(refused)?;
        let request = Request {
            samples: SAMPLES,
            plotted: true,
            ..Request::default()
        };
        let outcome = outcome(self, &request);
        let run = plot::Run {
            title: outcome.scene,
            outcome: &outcome,
        };
        let svg = plot::svg(&[run], &shows).map_err(refused)?;
        to_file(path, |out| still.write(&svg, PLOTS, out))
    }

    /// Writes a page ….html that plays the run and has all that is known of it, or a picture that moves: ….svg, ….png, ….gif, ….mp4.
    ///
    /// # Errors
    /// The name ends otherwise, or the file cannot be written.
    fn report(&self, path: impl AsRef<Path>) -> io::Result<()> {
        let path = path.as_ref();
        let ending = path.extension().and_then(|ending| ending.to_str());
        let moving = match ending {
            Some("html" | "htm" | "svg") => None,
            Some("png") => Some(Moving::Png),
            Some("gif") => Some(Moving::Gif),
            Some("mp4") => Some(Moving::Mp4),
            _ => {
                return Err(refused(
                    "let the name of a report end in .html, .svg, .png, .gif or .mp4",
                ));
            }
        };
        let motion = self.motion();
        let description = motion.description();
        let duration = motion.last_time() - motion.first_time();
        let request = Request {
            samples: html::intervals(description, duration, 1),
            ..Request::default()
        };
        let times = instants(motion, request.samples);
        let run = Shown {
            title: description.name.to_owned(),
            film: Reel::of(
                description.name,
                motion,
                self.error().cloned(),
                &request,
                &times,
            )
            .film(),
            derivation: motion.derivation(),
            failure: self.error().map(ToString::to_string),
        };
        if let Some("html" | "htm") = ending {
            return to_file(path, |out| html::write(&[run], None, None, out));
        }
        let panels = [run.panel()];
        let clock = Clock::new(&panels, RATE, None).map_err(refused)?;
        let Some(moving) = moving else {
            return to_file(path, |out| {
                out.write_all(frames::animated(&panels, &clock).as_bytes())
            });
        };
        moving.ready(RATE).map_err(refused)?;
        let pace = Pace {
            count: clock.instants.len(),
            rate: clock.rate,
            scale: 1.0,
        };
        let written = moving.write(|| frames::stills(&panels, &clock), pace, path);
        written.map_err(|error| unwritten(path, &error))
    }

    /// Writes the run over time to a file ….csv, ….parquet, ….json or ….jsonl, or its story to ….txt.
    ///
    /// # Errors
    /// The name ends otherwise, or the file cannot be written.
    fn write(&self, path: impl AsRef<Path>) -> io::Result<()> {
        let path = path.as_ref();
        let Some(format) = RunFormat::of(path) else {
            return Err(refused(
                "let the name end in .csv, .parquet, .json, .jsonl or .txt",
            ));
        };
        let request = Request {
            samples: if format.is_sampled() { SAMPLES } else { 0 },
            ..Request::default()
        };
        to_file(path, |out| {
            format.write_whole(&outcome(self, &request), out)
        })
    }
}

impl Results for Trajectory {
    fn motion(&self) -> &Trajectory {
        self
    }

    fn error(&self) -> Option<&Error> {
        None
    }
}

impl Results for Failure {
    fn motion(&self) -> &Trajectory {
        &self.trajectory
    }

    fn error(&self) -> Option<&Error> {
        Some(&self.error)
    }
}

/// What is known of a run.
fn outcome(run: &(impl Results + ?Sized), request: &Request) -> Outcome {
    let motion = run.motion();
    Outcome::new(
        motion.description().name,
        motion,
        run.error().cloned(),
        request,
    )
}

/// Something that cannot be written.
fn refused(reason: impl core::fmt::Display) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, reason.to_string())
}

/// The error of a file, with its name.
pub fn unwritten(path: &Path, error: &io::Error) -> io::Error {
    let said = format!("cannot write {}: {error}", path.display());
    io::Error::new(error.kind(), said)
}

/// Writes a file, at once when all of it is there.
///
/// # Errors
/// Of `write`, or of the file, with its name.
pub fn to_file(
    path: &Path,
    write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut text = Vec::new();
    let written = write(&mut text).and_then(|()| fs::write(path, text));
    written.map_err(|error| unwritten(path, &error))
}
