//! `lagrange sweep`: many runs of one scene, on all cores.

use super::course::Course;
use super::output::to_file;
use super::{Trouble, terminal};
use clap::Args;
use lagrange_problems::report::{Format, sweep as report};
use lagrange_problems::sweep::{Axis, Journal, Points, Sampling, Summary, Sweep, work};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Run a scene many times, over parameters and starts, on all cores. Killed and started again, a sweep with --output goes
/// on where it was.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange sweep mass-on-wheel --vary mu_static=0.3..1:40 --observe \"leave angle\" --plot leave.svg
  lagrange sweep mass-on-shell --vary \"der(theta)=0..2:20\" --observe \"leave angle\" --output shell.csv
  lagrange sweep ladder --vary start_angle=0.5..1.5 --vary length=1..9 --sample sobol:500 --observe t")]
pub(super) struct Sweeps {
    /// The scene, or a scene file (….toml); `lagrange list` shows the scenes.
    scene: String,
    /// Vary a parameter, coordinate or velocity of the start: name=from..to:count, name=from..to:count:log, or name=from..to
    /// with --sample. May be repeated: all combinations are run.
    #[arg(
        long,
        value_name = "NAME=A..B:N",
        required = true,
        allow_hyphen_values = true
    )]
    vary: Vec<Axis>,
    /// Take this many points of a Sobol sequence instead of a grid.
    #[arg(long, value_name = "sobol:N")]
    sample: Option<Sample>,
    /// Which of many Sobol sequences.
    #[arg(long, default_value_t = 1, requires = "sample")]
    seed: u32,
    /// What to read from each run: "theta at shell lost", "t at grip slips", "count floor impact", "x" (at the end), or a named
    /// result of the scene ("leave angle"). May be repeated.
    #[arg(long, value_name = "WHAT", required = true)]
    observe: Vec<String>,
    #[command(flatten)]
    course: Course,
    /// Write a line per run, as Parquet (….parquet) or CSV (….csv). What is done is kept in FILE.part until all is done.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Draw the first observation over one axis or two.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// In what form to print what came out, in a few numbers.
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
    /// Cores to use [default: all].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    workers: Option<u16>,
    /// Do only part I of N (1/8 … 8/8), for array jobs; once all parts are done, the same command without --shard
    /// writes the output.
    #[arg(long, value_name = "I/N", requires = "output")]
    shard: Option<Shard>,
}

/// `sobol:N`
#[derive(Clone, Copy)]
struct Sample(usize);

impl FromStr for Sample {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let count = text.strip_prefix("sobol:").and_then(|n| n.parse().ok());
        match count {
            Some(count) if (1..=1 << 32).contains(&count) => Ok(Sample(count)),
            _ => Err("expected sobol:N with a number of points N".to_owned()),
        }
    }
}

/// `i/n`
#[derive(Clone, Copy)]
struct Shard {
    part: usize,
    of: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/');
        let numbers = parts.and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((part, of)) if (1..=of).contains(&part) => Ok(Shard { part, of }),
            _ => Err("expected I/N with I from 1 to N, for example 3/8".to_owned()),
        }
    }
}

impl Sweeps {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let file = self.course.of(&self.scene)?;
        let points = Points {
            axes: self.vary.clone(),
            sampling: match self.sample {
                None => Sampling::Grid,
                Some(Sample(count)) => Sampling::Sobol {
                    count,
                    seed: self.seed,
                },
            },
        };
        let sweep = Sweep::new(file.scene, file.request, points, &self.observe)
            .map_err(Trouble::refused)?;
        let folder = self.output.as_deref().map(part);
        let journal = match &folder {
            None => Journal::in_memory(&sweep),
            Some(folder) => Journal::in_folder(&sweep, folder).map_err(Trouble::failed)?,
        };
        self.work(&sweep, &journal)?;
        if self.shard.is_some() {
            return Ok(());
        }
        if let Some(path) = &self.output {
            write(path, &sweep, &journal)?;
        }
        if let Some(path) = &self.plot {
            let picture = report::svg(&sweep, &journal).map_err(Trouble::failed)?;
            to_file(path, |out| out.write_all(picture.as_bytes()))?;
        }
        let summary = Summary::new(&sweep, &journal).map_err(Trouble::failed)?;
        super::print(|out| match self.format {
            Format::Table => report::table(&sweep, &summary, out),
            Format::Json => report::json(&sweep, &summary, out),
            Format::Csv => report::csv(&sweep, &journal, out).map_err(std::io::Error::other),
        })?;
        journal.remove().map_err(Trouble::failed)
    }

    /// Does what is not done yet.
    fn work(&self, sweep: &Sweep, journal: &Journal) -> Result<(), Trouble> {
        let ours = |chunk: usize| match self.shard {
            None => true,
            Some(Shard { part, of }) => chunk % of == part - 1,
        };
        let chunks = (0..sweep.chunks()).filter(|&chunk| ours(chunk));
        let (done, open): (Vec<_>, Vec<_>) = chunks.partition(|&chunk| journal.has(sweep, chunk));
        let count = |chunks: &[usize]| chunks.iter().map(|&c| sweep.chunk(c).len()).sum::<usize>();
        let form = "{wide_bar} {human_pos} of {human_len} runs, {per_sec}, {eta} left";
        let bar = terminal::bar((count(&done) + count(&open)) as u64, form);
        bar.set_position(count(&done) as u64);
        bar.reset_eta();
        let workers = self.workers.map_or(0, usize::from);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build();
        let pool = pool.map_err(Trouble::failed)?;
        let outcome = pool.install(|| work(sweep, journal, ours, |points| bar.inc(points as u64)));
        bar.finish_and_clear();
        outcome.map_err(Trouble::failed)
    }
}

/// Where what is done is kept.
fn part(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".part");
    PathBuf::from(name)
}

fn write(path: &Path, sweep: &Sweep, journal: &Journal) -> Result<(), Trouble> {
    let cannot = |error: &dyn std::fmt::Display| {
        Trouble::failed(format_args!("cannot write {}: {error}", path.display()))
    };
    // Under another name until it is complete.
    let unfinished = part(path).join("output");
    let file = std::fs::File::create(&unfinished).map_err(|e| cannot(&e))?;
    let out = std::io::BufWriter::new(file);
    let written = match path.extension().and_then(|e| e.to_str()) {
        Some("csv") => report::csv(sweep, journal, out),
        _ => report::parquet(sweep, journal, out),
    };
    written.map_err(|e| cannot(&e))?;
    std::fs::rename(&unfinished, path).map_err(|e| cannot(&e))
}
