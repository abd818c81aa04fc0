//! All tests of the workspace's public behaviour, in one binary.

mod architecture;
mod bowl;
mod certificates;
mod derived;
mod diagnostics;
mod effects;
mod efficiency;
mod errors;
mod exactness;
mod fallbacks;
mod handles;
mod hostile;
mod interpretation;
mod large;
mod ledgers;
mod monitor;
mod random;
mod recording;
mod runner;
mod sensitivity;
mod stability;
mod steppers;
mod switches;
mod systems;
mod tolerances;
mod wheel;
