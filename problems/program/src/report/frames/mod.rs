//! Films → pictures for slides: numbered frames, or one file that moves by itself.
//!
//! Each run is a panel: the scene, below it a bar of its modes with the present instant, the time and the mode in words.
//! Panels of several runs stand side by side, on one clock.

mod animated;
mod element;
mod layout;
mod still;

use crate::film::Film;
use crate::report::picture::nice;
use lagrange_core::error::Shortest;
use std::fmt;

pub use animated::animated;
pub use layout::width;
pub use still::stills;

/// A run and its title.
pub struct Panel<'a> {
    /// Shown above it where there are several.
    pub title: &'a str,
    /// The film.
    pub film: &'a Film,
}

/// When the pictures of a sequence are taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Clock {
    /// Instants, s, ascending.
    pub instants: Vec<f64>,
    /// Pictures a second.
    pub rate: f64,
}

/// More frames than this are refused.
const MOST: usize = 10_000;

/// Too many frames were asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooMany {
    /// How many.
    pub frames: f64,
}

impl fmt::Display for TooMany {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "that makes {} pictures, more than {MOST}; choose a lower --fps, a higher --speed, or end earlier with --until",
            Shortest(self.frames)
        )
    }
}

impl std::error::Error for TooMany {}

impl Clock {
    /// So many pictures a second of films that are shown `speed` times as fast as they happen; by default as
    /// `usual_speed` says.
    ///
    /// # Errors
    /// There would be too many.
    pub fn new(panels: &[Panel], rate: f64, speed: Option<f64>) -> Result<Self, TooMany> {
        let (first, last) = span(panels.iter().map(|panel| panel.film));
        let step = speed.unwrap_or_else(|| usual_speed(last - first)) / rate;
        let frames = ((last - first) / step).ceil();
        if !(frames < MOST as f64) {
            return Err(TooMany { frames });
        }
        let before = (0..frames as usize).map(|k| first + k as f64 * step);
        Ok(Self {
            instants: before.chain([last]).collect(),
            rate,
        })
    }
}

/// The first and the last instant of films.
pub(crate) fn span<'a>(films: impl Iterator<Item = &'a Film>) -> (f64, f64) {
    let samples = films.flat_map(|film| &film.outcome.samples);
    let times = samples.map(|sample| sample.time);
    let ends = times.fold(None, |ends: Option<(f64, f64)>, t| {
        let (first, last) = ends.unwrap_or((t, t));
        Some((first.min(t), last.max(t)))
    });
    ends.unwrap_or((0.0, 0.0))
}

/// Speeds that a page offers.
pub(crate) const SPEEDS: [f64; 9] = [0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0];

/// The highest speed up to 1 at which so many seconds are seen for at least four; of more than forty, the highest round one at which they
/// are seen for at least forty; of so few that every speed of a page is too high, the highest round one at which they are seen for four.
pub(crate) fn usual_speed(duration: f64) -> f64 {
    if duration > 40.0 {
        return nice(duration / 40.0);
    }
    let fits = |speed: &&f64| **speed <= 1.0 && duration / **speed >= 4.0;
    let speeds = SPEEDS.iter();
    let highest = speeds.rev().find(fits).copied();
    highest.unwrap_or_else(|| nice(duration / 4.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_suit_their_films() {
        let speeds = [0.2, 1.0, 3.0, 20.0, 40.0, 100.0, 600.0, 1e5, 1e9].map(usual_speed);
        assert_eq!(speeds, [0.05, 0.25, 0.5, 1.0, 1.0, 2.0, 10.0, 2000.0, 2e7]);
    }

    #[test]
    fn the_shortest_films_take_seconds() {
        for duration in [0.19, 0.01, 7e-6, 4.2e-13] {
            let seen = duration / usual_speed(duration);
            assert!((4.0..10.0).contains(&seen), "{duration}: {seen}");
        }
    }
}
