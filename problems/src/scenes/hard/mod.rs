//! Hard cases, one file each: what breaks other programs, with an answer known by other means.
//!
//! [`stability`](crate::stability) runs them and compares.

mod backspin_ball;
mod beam_on_supports;
mod belt_oscillator;
mod bouncing_ball;
mod coulomb_oscillator;
mod cradle;
mod ladder;
mod long_pendulum;
mod painleve_rod;
mod parallelogram;
mod polar_particle;
mod rattleback;
mod rod_on_supports;
mod rolling_disk;
mod sled;
mod slider_crank;
mod spherical_pendulum;
mod spring_pendulum;
mod string_pendulum;
mod thrown_ball;
mod tumbling_body;
mod turntable;
mod unequal_pendulum;

pub use backspin_ball::BackspinBall;
pub use beam_on_supports::BeamOnSupports;
pub use belt_oscillator::BeltOscillator;
pub use bouncing_ball::BouncingBall;
pub use coulomb_oscillator::CoulombOscillator;
pub use cradle::Cradle;
pub use ladder::Ladder;
pub use long_pendulum::LongPendulum;
pub use painleve_rod::PainleveRod;
pub use parallelogram::Parallelogram;
pub use polar_particle::PolarParticle;
pub use rattleback::Rattleback;
pub use rod_on_supports::RodOnSupports;
pub use rolling_disk::RollingDisk;
pub use sled::Sled;
pub use slider_crank::SliderCrank;
pub use spherical_pendulum::SphericalPendulum;
pub use spring_pendulum::SpringPendulum;
pub use string_pendulum::StringPendulum;
pub use thrown_ball::ThrownBall;
pub use tumbling_body::TumblingBody;
pub use turntable::Turntable;
pub use unequal_pendulum::UnequalPendulum;
