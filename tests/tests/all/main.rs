//! All tests of the workspace's public behaviour, in one binary.

mod derived;
mod errors;
mod oracle;
mod recording;
mod steppers;
mod switches;
mod systems;
mod wheel;
