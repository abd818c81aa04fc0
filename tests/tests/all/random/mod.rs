//! Random small systems from random starts: what must hold in every run, whatever happens.
//!
//! No number that is not finite, no panic, no penetration beyond the tolerance, no contact that pulls, friction inside its cone,
//! constraints satisfied, the ledger closed. A run may end early only at its limit of steps or where physics has no answer.

mod boundaries;
mod contacts;
mod linkages;
mod moving;

use core::fmt::Debug;
use lagrange_core::__private::places::Normal;
use lagrange_core::prelude::*;

/// How to run, and what to hold the run to.
#[derive(Clone, Copy, Debug)]
struct Trial {
    until: f64,
    tolerance: f64,
    method: Method,
    /// Coefficient of every friction.
    mu: f64,
}

impl Trial {
    /// Taylor at 1e-10, without friction.
    fn until(until: f64) -> Self {
        Trial {
            until,
            tolerance: 1e-10,
            method: Method::Taylor,
            mu: 0.0,
        }
    }

    fn rough(self, mu: f64) -> Self {
        Trial { mu, ..self }
    }
}

/// What many runs came to.
#[derive(Debug, Default)]
struct Tally {
    runs: usize,
    /// Steps of the longest run.
    longest: usize,
    /// Runs that ended where no mode is possible.
    paradoxes: usize,
    /// What was wrong, run by run.
    failures: Vec<String>,
}

impl Tally {
    /// Runs and books what comes of it.
    fn run<S: Derived<Scalar = f64> + Debug>(
        &mut self,
        scene: &S,
        start: &State<f64>,
        trial: Trial,
    ) {
        self.runs += 1;
        if let Err(what) = self.judge(scene, start, trial) {
            self.failures
                .push(format!("{what}\n  {scene:?}\n  {start:?}\n  {trial:?}"));
        }
    }

    fn judge<S: Derived<Scalar = f64> + Debug>(
        &mut self,
        scene: &S,
        start: &State<f64>,
        trial: Trial,
    ) -> Result<(), String> {
        let run = Simulation::new(scene)
            .tolerance(trial.tolerance)
            .method(trial.method)
            .project_start(true)
            .max_steps(10_000)
            .run(start.clone(), 0.0..trial.until);
        let trajectory = match run {
            Ok(trajectory) => trajectory,
            Err(Failure {
                error: Error::Limit { what: "steps", .. },
                trajectory,
            }) => *trajectory,
            Err(Failure {
                error: Error::NoMode { .. } | Error::NoImpact { .. },
                trajectory,
            }) => {
                self.paradoxes += 1;
                *trajectory
            }
            Err(failure) => return Err(failure.to_string()),
        };
        self.longest = self.longest.max(trajectory.work().steps);
        let mut sampler = trajectory.sampler();
        let times: Vec<f64> = trajectory
            .step_times()
            .chain([trajectory.last_time()])
            .collect();
        let between = times.windows(2).map(|t| 0.5 * (t[0] + t[1]));
        for t in times.iter().copied().chain(between) {
            let now = sampler.at(t).map_err(|e| format!("t = {t}: {e}"))?;
            instant::<S>(&now, trial).map_err(|e| format!("t = {t}: {e}"))?;
        }
        let ledger = trajectory.ledger().map_err(|e| e.to_string())?;
        let closure = ledger.closure.abs() / ledger.scale.max(1.0);
        if !(closure < 1e3 * trial.tolerance.max(1e-12)) {
            return Err(format!("the ledger is off by {closure:e}"));
        }
        Ok(())
    }

    /// Everything must have gone well.
    #[track_caller]
    fn check(&self) {
        assert!(
            self.failures.is_empty(),
            "{} of {} runs failed:\n{}",
            self.failures.len(),
            self.runs,
            self.failures[..self.failures.len().min(5)].join("\n")
        );
    }
}

/// What must hold at one time.
fn instant<S: Derived<Scalar = f64>>(now: &Instant<f64>, trial: Trial) -> Result<(), String> {
    let d = S::DESCRIPTION;
    let mut numbers = now.state.q.iter().chain(&now.state.v).chain(&now.forces);
    if !numbers.all(|x| x.is_finite()) {
        return Err("not finite".to_owned());
    }
    let bound = 10.0 * trial.tolerance.max(1e-13);
    let weight = now.forces.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    let noise = 1e3 * trial.tolerance.max(1e-13) * weight;
    for (c, contact) in d.contacts.iter().enumerate() {
        let (name, gap, force) = (contact.name, now.gaps[c], now.forces[contact.row]);
        if gap < -bound {
            return Err(format!("{name} penetrates by {gap:e}"));
        }
        if now.mode.contacts[c] {
            if gap > bound {
                return Err(format!("{name} is closed and {gap:e} away"));
            }
            if force < -noise {
                return Err(format!("{name} pulls with {force:e}"));
            }
        } else if force != 0.0 {
            return Err(format!("{name} is open and pushes with {force:e}"));
        }
    }
    for friction in d.frictions {
        let Normal::Contact(c) = friction.normal else {
            continue;
        };
        let (normal, force) = (now.forces[d.contacts[c].row], now.forces[friction.row]);
        if force.abs() > trial.mu * normal + noise {
            let name = friction.name;
            return Err(format!("{name} gives {force:e} with N = {normal:e}"));
        }
    }
    Ok(())
}
