//! Hard cases, one file each: what breaks other programs, with an answer known by other means.
//!
//! [`stability`](crate::stability) runs them and compares.

mod backspin_ball;
mod belt_oscillator;
mod bouncing_ball;
mod coulomb_oscillator;
mod cradle;
mod cue_ball;
mod hoop_bead;
mod incline_block;
mod ladder;
mod long_pendulum;
mod painleve_rod;
mod parallelogram;
mod polar_particle;
mod rattleback;
mod rod_sleeve;
mod rolling_disk;
mod slider_crank;
mod spherical_pendulum;
mod spring_pendulum;
mod string_pendulum;
mod thrown_ball;
mod tumbling_body;
mod turning_push;
mod turntable;
mod unequal_pendulum;

pub use backspin_ball::BackspinBall;
pub use belt_oscillator::BeltOscillator;
pub use bouncing_ball::BouncingBall;
pub use coulomb_oscillator::CoulombOscillator;
pub use cradle::Cradle;
pub use cue_ball::CueBall;
pub use hoop_bead::HoopBead;
pub use incline_block::InclineBlock;
pub use ladder::Ladder;
pub use long_pendulum::LongPendulum;
pub use painleve_rod::PainleveRod;
pub use parallelogram::Parallelogram;
pub use polar_particle::PolarParticle;
pub use rattleback::Rattleback;
pub use rod_sleeve::RodSleeve;
pub use rolling_disk::RollingDisk;
pub use slider_crank::SliderCrank;
pub use spherical_pendulum::SphericalPendulum;
pub use spring_pendulum::SpringPendulum;
pub use string_pendulum::StringPendulum;
pub use thrown_ball::ThrownBall;
pub use tumbling_body::TumblingBody;
pub use turning_push::TurningPush;
pub use turntable::Turntable;
pub use unequal_pendulum::UnequalPendulum;
