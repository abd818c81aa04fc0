//! All tests of the workspace's public behaviour, in one binary.

mod bowl;
mod derived;
mod errors;
mod recording;
mod steppers;
mod switches;
mod systems;
mod wheel;
