//! All scenes that the program knows. A new scene is one line in `SCENES` or, with a case of `stability`, in `HARD`.

use crate::scenes::{hard::*, *};
use crate::stability::CASES;
use core::f64::consts::PI;
use lagrange_program::Entry;
use lagrange_program::catalogue::Catalogue;
use lagrange_program::scene::Scene;

/// Every scene, in the order of `lagrange list`.
pub static SCENES: &[&dyn Scene] = &[
    &Entry::<MassOnShell>::new("mass-on-shell", 20.0)
        .known(MassOnShell::closed_form)
        .results(&[
            ("leave angle", "theta at shell lost"),
            ("leave time", "t at shell lost"),
        ]),
    &Entry::<RollingSphere>::new("rolling-sphere", 20.0)
        .known(RollingSphere::closed_form)
        .results(&[
            ("leave angle", "theta at shell lost"),
            ("leave time", "t at shell lost"),
        ]),
    &Entry::<RollingSlippingSphere>::new("rolling-slipping-sphere", 20.0).results(&[
        ("leave angle", "theta at shell lost"),
        ("leave time", "t at shell lost"),
        ("slip angle", "theta at grip slips"),
    ]),
    &Entry::<MassOnWheel>::new("mass-on-wheel", 20.0).results(&[
        ("leave angle", "theta at rim lost"),
        ("leave time", "t at rim lost"),
        ("slip angle", "theta at grip slips"),
    ]),
    &Entry::<SphereInBowl>::new("sphere-in-bowl", 10.0),
    &Entry::<DoublePendulum>::new("double-pendulum", 5.0),
    &Entry::<FiveLinkChain>::new("five-link-chain", 2.0),
    &Entry::<Chain20>::new("chain", 2.0),
    &Entry::<Net>::new("net", 2.0),
    &Entry::<CartesianPendulum>::new("cartesian-pendulum", 100.0)
        .known(CartesianPendulum::closed_form),
    &Entry::<Kepler>::new("kepler", 200.0 * PI).known(Kepler::closed_form),
    &Entry::<StiffSpringPendulum>::new("stiff-spring-pendulum", 10.0),
];

/// The hard cases, in the order of `lagrange list`.
pub static HARD: &[&dyn Scene] = &[
    &Entry::<BouncingBall>::new("bouncing-ball", 10.0),
    &Entry::<ThrownBall>::new("thrown-ball", 3.0),
    &Entry::<Ladder>::new("ladder", 5.0),
    &Entry::<BackspinBall>::new("backspin-ball", 3.0),
    &Entry::<BeltOscillator>::new("belt-oscillator", 20.0),
    &Entry::<CoulombOscillator>::new("coulomb-oscillator", 10.0),
    &Entry::<InclineBlock>::new("incline-block", 2.0),
    &Entry::<CueBall>::new("cue-ball", 2.0),
    &Entry::<TurningPush>::new("turning-push", 2.5),
    &Entry::<HoopBead>::new("hoop-bead", 10.0),
    &Entry::<RodSleeve>::new("rod-sleeve", 2.0),
    &Entry::<Cradle>::new("cradle", 1.0),
    &Entry::<FiveBallCradle>::new("five-ball-cradle", 1.0),
    &Entry::<RockingBlock>::new("rocking-block", 10.0),
    &Entry::<PainleveRod>::new("painleve-rod", 1.0),
    &Entry::<StringPendulum>::new("string-pendulum", 3.0),
    &Entry::<SphericalPendulum>::new("spherical-pendulum", 5.0),
    &Entry::<PolarParticle>::new("polar-particle", 2.0),
    &Entry::<RodOnSupports>::new("rod-on-supports", 10.0),
    &Entry::<BeamOnSupports>::new("beam-on-supports", 10.0),
    &Entry::<Sled>::new("sled", 2.0),
    &Entry::<Table>::new("table", 4.0),
    &Entry::<Parallelogram>::new("parallelogram", 2.0),
    &Entry::<SliderCrank>::new("slider-crank", 2.0),
    &Entry::<RollingDisk>::new("rolling-disk", 5.0),
    &Entry::<Rattleback>::new("rattleback", 5.0),
    &Entry::<Turntable>::new("turntable", 10.0),
    &Entry::<SpringPendulum>::new("spring-pendulum", 0.1),
    &Entry::<UnequalPendulum>::new("unequal-pendulum", 5.0),
    &Entry::<TumblingBody>::new("tumbling-body", 30.0),
    &Entry::<LongPendulum>::new("long-pendulum", 10.0),
    &Entry::<OverdampedOscillator>::new("overdamped-oscillator", 10.0),
    &Entry::<GardenSwing>::new("garden-swing", 10.0),
];

/// All scenes: the textbook's, then the hard cases.
pub fn scenes() -> impl Iterator<Item = &'static dyn Scene> {
    [SCENES, HARD].into_iter().flatten().copied()
}

/// What the program `lagrange` knows: all scenes, and the cases of `lagrange stability`.
pub fn all() -> Catalogue {
    Catalogue {
        scenes: scenes().collect(),
        cases: CASES,
    }
}
