//! `lagrange sweep`: many runs of one scene, on all cores.

use super::output::ready;
use super::results::{Results, beside, verdict};
use super::run_args::RunArgs;
use super::values::{number_of, whole};
use super::{Trouble, terminal};
use crate::catalogue::Catalogue;
use crate::sweep::launch::{self, Place};
#[cfg(feature = "mpi")]
use crate::sweep::team::Team;
use crate::sweep::{Axis, Journal, Points, Sampling, Shard, Sweep, work};
use clap::Args;
use indicatif::ProgressBar;

/// Run a scene many times, over parameters and starts, on all cores. Killed and started again, a sweep with --output goes
/// on where it was: what is done is kept in FILE.part until all is done.
#[derive(Args)]
#[command(after_help = "Examples:
  lagrange sweep mass-on-wheel --vary mu_static=0.5..2:99 --observe \"leave angle\" --plot angles.svg
  lagrange sweep ladder --vary length=1..9:20 --vary mass=0.1..10:20:log --observe t --plot map.svg
  lagrange sweep ladder --vary length=1..9 --vary mass=1..9 --sample sobol:500 --observe t
  lagrange sweep ladder --vary \"der(theta)=-2..0:99\" --observe theta --output runs.parquet
  lagrange sweep ladder --vary length=1..9:3000 --observe t --output one.csv --shard 1/2

A run that fails is a line that says why; the sweep goes on. Exit codes: 0 runs went well, 1 every run failed or a file could not be written, 2 the request makes no sense, 130 interrupted.")]
pub(super) struct Sweeps {
    /// The scene, a declaration (….lagrange) or a scene file (….toml); `lagrange list` shows the scenes.
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
    /// Run a sample instead of a grid, with so many points: sobol:N (even), random:N (independent) or lhs:N (Latin hypercube).
    #[arg(long, value_name = "KIND:N")]
    sample: Option<Sampling>,
    /// Which of many such samples.
    #[arg(long, default_value_t = 1, requires = "sample", value_parser = whole::<u32>, allow_hyphen_values = true)]
    seed: u32,
    /// What to read from each run: a coordinate, velocity, force, output or energy at an event ("theta at shell lost", "t at grip
    /// slips", "energy at floor impact 2") or at the end ("x"); "impulse floor at floor impact"; "count floor impact"; or a named
    /// result of the scene ("leave angle"). May be repeated.
    #[arg(long, value_name = "WHAT", required = true)]
    observe: Vec<String>,
    #[command(flatten)]
    run: RunArgs,
    #[command(flatten)]
    results: Results,
    /// Cores to use [default: all; under mpirun, one per process].
    #[arg(long, value_name = "N", value_parser = number_of("cores", 1, u16::MAX.into()), allow_hyphen_values = true)]
    workers: Option<usize>,
    /// Do only part I of N (1/8 … 8/8), for array jobs. What is done stays in FILE.part; `lagrange merge` puts parts together.
    #[arg(long, value_name = "I/N", requires = "output")]
    shard: Option<Shard>,
}

impl Sweeps {
    pub(super) fn execute(self, catalogue: &Catalogue) -> Result<(), Trouble> {
        self.results.check()?;
        if self.run.estimate {
            let reason = "a sweep has no place for estimates; --error keeps the error of every run below a bound";
            return Err(Trouble::usage(reason));
        }
        let file = self.run.of(&self.scene, catalogue)?;
        let mut request = file.request;
        // What a scene file gives is varied instead; that the command line gives twice is refused.
        let stays = |(name, _): &(String, f64)| {
            self.run.motion.gives(name) || self.vary.iter().all(|axis| axis.name != *name)
        };
        request.parameters.retain(stays);
        request.start.retain(stays);
        let points = Points {
            axes: self.vary.clone(),
            sampling: match self.sample {
                None => Sampling::Grid,
                Some(sample) => sample.seeded(self.seed),
            },
        };
        let sweep =
            Sweep::new(file.scene, request, points, &self.observe).map_err(Trouble::refused)?;
        self.results.check_picture(&sweep)?;
        match launch::place() {
            Some(place) if self.shard.is_none() => self.together(&sweep, place),
            _ => self.alone(&sweep),
        }
    }

    /// The journal of a shard.
    fn journal(&self, sweep: &Sweep, shard: Shard) -> Result<Journal, Trouble> {
        ready(self.results.files(), std::slice::from_ref(&self.scene))?;
        match &self.results.output {
            None => Journal::in_memory(sweep).map_err(Trouble::failed),
            Some(path) => {
                Journal::in_folder(sweep, &beside(path, ".part"), shard).map_err(Trouble::failed)
            }
        }
    }

    /// On this machine.
    fn alone(&self, sweep: &Sweep) -> Result<(), Trouble> {
        let shard = self.shard.unwrap_or(Shard::WHOLE);
        let journal = self.journal(sweep, shard)?;
        let workers = self.workers.unwrap_or(0);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build();
        let pool = pool.map_err(Trouble::failed)?;
        let ours = |chunk| shard.has(chunk);
        if self.results.output.is_some() {
            terminal::end_at_once("what is done is kept; the same command goes on from there");
        }
        let bar = self.bar(sweep, &journal, ours);
        let outcome = pool.install(|| work(sweep, &journal, ours, |points| bar.inc(points as u64)));
        bar.finish_and_clear();
        outcome.map_err(Trouble::failed)?;
        match self.shard {
            Some(_) => Ok(()),
            None => self.finish(sweep, journal),
        }
    }

    /// With all processes that were started together.
    #[cfg(feature = "mpi")]
    fn together(&self, sweep: &Sweep, place: Place) -> Result<(), Trouble> {
        let mut team = Team::gather(place, sweep).map_err(Trouble::failed)?;
        let workers = self.workers.unwrap_or(1);
        if !team.leads() {
            team.follow(sweep, workers);
            return Ok(());
        }
        let result = match self.journal(sweep, Shard::WHOLE) {
            Err(trouble) => {
                team.dismiss();
                Err(trouble)
            }
            Ok(journal) => {
                let bar = self.bar(sweep, &journal, |_| true);
                let count = |points| bar.inc(points as u64);
                let outcome = team.lead(sweep, &journal, workers, count);
                bar.finish_and_clear();
                if team.lost() > 0 {
                    let (lost, of) = (team.lost(), place.of);
                    super::say(&format!(
                        "{lost} of {of} processes were lost; the others did their chunks"
                    ));
                }
                let done = outcome.map_err(Trouble::failed);
                done.and_then(|()| self.finish(sweep, journal))
            }
        };
        team.end(u8::from(result.is_err()));
        result
    }

    #[cfg(not(feature = "mpi"))]
    fn together(&self, _: &Sweep, place: Place) -> Result<(), Trouble> {
        Err(Trouble::usage(format_args!(
            "{} processes were started together, but this program was built without MPI (cargo build --features mpi); or give each \
             its part with --shard",
            place.of
        )))
    }

    /// What is made of all runs.
    fn finish(&self, sweep: &Sweep, journal: Journal) -> Result<(), Trouble> {
        let complaint = self.results.write(sweep, &journal)?;
        journal.remove().map_err(Trouble::failed)?;
        verdict(complaint)
    }

    /// How far it is.
    fn bar(&self, sweep: &Sweep, journal: &Journal, ours: impl Fn(usize) -> bool) -> ProgressBar {
        let chunks = (0..sweep.chunks()).filter(|&chunk| ours(chunk));
        let (done, open): (Vec<_>, Vec<_>) = chunks.partition(|&chunk| journal.has(sweep, chunk));
        let count = |chunks: &[usize]| chunks.iter().map(|&c| sweep.chunk(c).len()).sum::<usize>();
        let form = "{wide_bar} {human_pos} of {human_len} runs, {per_sec}, {eta} left";
        let bar = terminal::bar((count(&done) + count(&open)) as u64, form);
        bar.set_position(count(&done) as u64);
        bar.reset_eta();
        bar
    }
}
