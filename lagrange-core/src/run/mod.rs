//! The loop of a run: step, look for the first thing that happens, switch, go on.

mod accumulation;
mod acting;
mod adjoining;
mod advance;
mod at_edge;
mod cause;
mod corners;
mod dead_centre;
mod decaying_slip;
mod evaluation;
mod execution;
mod extremal;
mod failure;
mod fall;
mod feasible;
mod gradient;
mod grazing;
mod guard_polynomials;
mod hidden;
mod hit;
mod impact;
mod instant;
mod jamming;
mod jumping_slips;
mod last_impacts;
mod locator;
pub(crate) mod lockstep;
mod log;
mod passage;
mod piece;
mod reach;
mod redundant;
mod region;
mod resolution;
mod rest_under_load;
mod sampled_step;
mod samples;
mod sides;
mod singular;
mod spatial_slip;
mod stepping;
mod stiffness;
mod still;
mod switch;
mod taylor_step;
mod touching;
mod vanishing_loads;
mod vanishing_slips;
mod watches;

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::integrate::Start;
use crate::mode::Mode;
use crate::modes::domain;
use crate::modes::facts::{EvaluationPoint, SwitchContext, SwitchFacts};
use crate::settings::Settings;
use crate::system::{Description, Erased};
use crate::trajectory::{State, Trajectory};
use acting::acting;
use corners::Lagrangian;
use hidden::Hidden;
use locator::Locator;
use log::Recorder;
use passage::Passage;
use singular::RankWatch;
use stepping::Stepper;
use switch::Switcher;

/// How much of a Taylor series there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Progress {
    None,
    /// The values: coefficients of order 0.
    Begun,
    Complete,
}

/// A run: where the motion is, and what makes its steps, finds what ends them, changes its mode and writes it down.
#[derive(Debug)]
pub(crate) struct Run<T: Scalar> {
    settings: Settings,
    dynamics: Dynamics<T>,
    now: Now<T>,
    stepper: Stepper<T>,
    /// Exponents, powers, angles and roots in what is declared, if there are any.
    hidden: Option<Hidden>,
    /// Whether the strength of a friction follows from the state.
    strengths_vary: bool,
    /// Whether accelerations may jump where no branch says so.
    may_jump: bool,
    /// Whether what acts has logarithms.
    has_logarithms: bool,
    /// Whether what acts is a function of time.
    changes_with_time: bool,
    /// The declared Lagrangian, if a choice in it may change.
    lagrangian: Option<Lagrangian>,
    /// Watches for positions where constraints lose rank.
    rank: RankWatch,
    passage: Passage<T>,
    locator: Locator<T>,
    switcher: Switcher<T>,
    recorder: Recorder<T>,
    /// First instant of the span.
    begin: f64,
    /// Last instant of the span.
    end: f64,
    /// When the number of steps doubled, the last three times, s.
    looks: [f64; 3],
}

/// Where the motion is.
#[derive(Debug)]
struct Now<T> {
    t: T,
    state: State<T>,
    mode: Mode,
    /// Per contact: the motion is beyond its surface, where it passed outside its region.
    below: Vec<bool>,
    /// Whether a step can leave the rows of the mode.
    drifts: bool,
    /// How much of the Taylor series at this state `dynamics` holds.
    series: Progress,
    /// Whether `dynamics` holds the values of this state, for the needs of the mode.
    valued: bool,
    /// Distance from a position where constraints lose rank.
    distance: f64,
}

impl<T: Scalar> Now<T> {
    /// What `dynamics` holds is of another state or mode.
    fn outdate(&mut self) {
        (self.valued, self.series) = (false, Progress::None);
    }

    /// The state from which the next step is made.
    fn start(&self) -> Start<'_, T> {
        Start {
            t: self.t,
            q: &self.state.q,
            v: &self.state.v,
        }
    }

    /// Where the mode may end, for who decides on the next.
    fn context<'a>(
        &'a self,
        order: usize,
        tolerance: f64,
        facts: &'a SwitchFacts,
    ) -> SwitchContext<'a, T> {
        let here = SwitchContext {
            moment: EvaluationPoint {
                t: self.t,
                q: &self.state.q,
                v: &self.state.v,
                order,
                tolerance,
            },
            present: &self.mode,
            facts,
        };
        match facts.lost {
            true => here.exactly(),
            false => here,
        }
    }
}

impl<T: Scalar> Run<T> {
    /// Makes everything ready.
    pub(crate) fn new(system: Erased<T>, settings: &Settings) -> Self {
        let d = system.description();
        let n = d.coordinates.len();
        let mut state = State::new(vec![T::default(); n], vec![T::default(); n]);
        state.name(d);
        let mode = Mode::open(d);
        let acting = acting(&system, &settings.effects);
        let rank = RankWatch::new(d, &settings.effects);
        let mut dynamics = Dynamics::of(system.clone(), &settings.effects);
        dynamics.set_sizes(&settings.sizes);
        let mut run = Run {
            dynamics,
            stepper: Stepper::new(settings, d, &state),
            hidden: Hidden::new(&system, &acting),
            strengths_vary: domain::strengths_vary(d),
            may_jump: acting.may_jump(),
            has_logarithms: acting.has_logarithms(),
            changes_with_time: acting.reads_time(),
            lagrangian: Lagrangian::new(&system, &settings.effects),
            passage: match rank.watches() {
                true => Passage::new(n),
                false => Passage::default(),
            },
            rank,
            locator: Locator::new(d, settings, &mode),
            switcher: Switcher::new(d, &state, &mode),
            recorder: Recorder::new(&system, settings, &state, &mode),
            now: Now {
                t: T::default(),
                below: vec![false; d.contacts.len()],
                drifts: true,
                series: Progress::None,
                valued: false,
                distance: 1.0,
                state,
                mode,
            },
            begin: 0.0,
            end: 0.0,
            looks: [0.0; 3],
            settings: settings.clone(),
        };
        run.dynamics.set_equations(settings.equations);
        run.watch();
        run
    }

    /// The table of names and places of the system.
    pub(crate) fn description(&self) -> &'static Description {
        self.dynamics.description()
    }

    /// Takes another system of the same kind.
    pub(crate) fn set_system(&mut self, system: Erased<T>) {
        if self.hidden.is_some() || self.lagrangian.is_some() {
            let parameters = system.parameters();
            if let Some(hidden) = &mut self.hidden {
                hidden.set_parameters(&parameters);
            }
            if let Some(lagrangian) = &mut self.lagrangian {
                lagrangian.set_parameters(&parameters);
            }
        }
        self.dynamics.set_system(system);
    }

    /// An empty trajectory.
    pub(crate) fn record(&self) -> &Trajectory<T> {
        &self.recorder.trajectory
    }
}
