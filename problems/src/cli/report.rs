//! `lagrange report`: runs as a page to look at.

use super::Trouble;
use super::course::Course;
use super::output::to_file;
use super::terminal::{keep_what_is_done, patiently};
use clap::Args;
use lagrange_problems::catalogue::Scene;
use lagrange_problems::progress::Progress;
use lagrange_problems::report::html::{self, Shown};
use lagrange_problems::request::Request;
use std::path::PathBuf;

/// Run scenes and write a page that shows them: animation, forces and their limits, energy, events, equations. The page is one
/// file and needs no network.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange report mass-on-wheel --output wheel.html
  lagrange report mass-on-wheel sticky.toml --output both.html     two runs side by side, on one clock")]
pub(super) struct Report {
    /// Scenes and scene files (….toml); `lagrange list` shows the scenes.
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<String>,
    #[command(flatten)]
    course: Course,
    /// The page to write.
    #[arg(long, value_name = "FILE.html", default_value = "report.html")]
    output: PathBuf,
}

impl Report {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let progress = Progress::default();
        progress.expect(self.scenes.len());
        keep_what_is_done(&progress);
        let runs: Vec<Shown> = patiently("running", &progress, || {
            let names = self.scenes.iter();
            let shown = names.map(|name| self.shown(name, &progress));
            shown.collect::<Result<_, _>>()
        })?;
        to_file(&self.output, |out| html::write(&runs, out))?;
        let failed = runs.into_iter().find_map(|run| run.film.outcome.failure);
        failed.map_or(Ok(()), |error| Err(Trouble::ended(error)))
    }

    fn shown(&self, name: &str, progress: &Progress) -> Result<Shown, Trouble> {
        let file = self.course.of(name)?;
        let request = Request {
            samples: html::intervals(file.scene, &file.request),
            progress: Some(progress.clone()),
            ..file.request
        };
        let film = file.scene.film(&request).map_err(Trouble::refused)?;
        Ok(Shown {
            title: title(name, file.scene),
            film,
            derivation: file.scene.derivation(),
            tolerance: request.tolerance,
            method: request.method,
        })
    }
}

/// The scene, or the scene and the name of the file that describes the run.
fn title(name: &str, scene: &dyn Scene) -> String {
    match name.strip_suffix(".toml") {
        Some(path) => {
            let stem = path.rsplit(['/', '\\']).next().unwrap_or(path);
            format!("{} ({stem})", scene.name())
        }
        None => name.to_owned(),
    }
}
