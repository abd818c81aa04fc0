//! Where something has been: its path, thinned out while it is followed by what of it can be seen.
//!
//! A path covers cells of space, about as large as the pixels of a picture that holds it. What goes through cells that are covered
//! already is not kept, so that a motion that goes round and round needs no more memory than its first rounds.

use crate::space::Vector;
use crate::straight::straightened;
use core::hash::{BuildHasherDefault, Hasher};
use std::collections::HashSet;

/// Cells along the longest edge of the box around a path, at most: about twice as many as a picture has pixels.
const CELLS: f64 = 2048.0;
/// Points that are kept, at most; of more the cells are too small.
const MOST: usize = 60_000;
/// Within a step a path goes straight where it is off by no more than this share of a cell,
const STRAIGHT: f64 = 0.5;
/// and when it is drawn by no more than this one: a circle must not look like a polygon.
const ROUND: f64 = 0.25;
/// How often a step is halved at most where a path bends.
const HALVINGS: usize = 12;

/// A place of a path, m, and when it was there, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Time, s.
    pub time: f64,
    /// Place, m; z is 0 in a plane.
    pub at: Vector,
}

/// A path as strokes of a pen, in order of time.
#[derive(Clone, Debug)]
pub struct Path {
    /// The points of every stroke: it goes straight and evenly from each to the next.
    pub strokes: Vec<Vec<Point>>,
    /// Corners of the box around it, m; the first is above the second if it was nowhere.
    pub low: Vector,
    /// See `low`.
    pub high: Vector,
    /// Edge of a cell, m: a power of two.
    cell: f64,
    /// Cells that strokes go through.
    covered: Cells,
    /// Those and the ones beside them.
    beside: Cells,
    /// Where it was last, unless that is no place.
    end: Option<Point>,
    /// Whether the last stroke goes on.
    drawing: bool,
}

impl Default for Path {
    fn default() -> Self {
        Self {
            strokes: Vec::new(),
            low: Vector::repeat(f64::INFINITY),
            high: Vector::repeat(f64::NEG_INFINITY),
            cell: 0.0,
            covered: Cells::default(),
            beside: Cells::default(),
            end: None,
            drawing: false,
        }
    }
}

impl Point {
    fn is_somewhere(&self) -> bool {
        self.at.iter().all(|x| x.is_finite())
    }

    /// At a part of the way to another one.
    fn towards(&self, to: &Self, part: f64) -> Self {
        Self {
            time: self.time + part * (to.time - self.time),
            at: self.at + part * (to.at - self.at),
        }
    }
}

impl Path {
    /// Goes straight on to a point; where that is nowhere the path has a gap.
    pub fn go_to(&mut self, to: Point) {
        if !to.is_somewhere() {
            self.leave_off();
            return;
        }
        (self.low, self.high) = (self.low.inf(&to.at), self.high.sup(&to.at));
        let fit = (self.high - self.low).max() / CELLS;
        if fit > self.cell {
            self.coarsen(fit.log2().ceil().exp2());
        }
        self.draw_to(to);
        while self.strokes.iter().map(Vec::len).sum::<usize>() > MOST {
            self.coarsen(2.0 * self.cell);
        }
    }

    /// What follows is not joined to what was.
    pub fn leave_off(&mut self) {
        (self.end, self.drawing) = (None, false);
    }

    /// Goes on with the path of what follows.
    pub fn join(&mut self, next: &Self) {
        for stroke in &next.strokes {
            self.leave_off();
            stroke.iter().for_each(|point| self.go_to(*point));
        }
    }

    /// Leaves out the points of its strokes that lie on the straight way from one to a later one.
    pub(crate) fn straighten(&mut self) {
        for stroke in &mut self.strokes {
            let place = |point: &Point| (point.time, point.at.into());
            *stroke = straightened::<_, 3>(stroke, ROUND * self.cell, place);
        }
    }

    /// Whether a picture shows no bend at a point between two others.
    fn is_straight(&self, [from, between, to]: [&Point; 3]) -> bool {
        let known = [from, between, to].map(Point::is_somewhere);
        match known {
            [true, true, true] => {
                let bend = between.at - 0.5 * (from.at + to.at);
                bend.amax() <= STRAIGHT * self.cell
            }
            [from, between, to] => from == between && between == to,
        }
    }

    /// Draws what goes through new cells on the way to a point.
    fn draw_to(&mut self, to: Point) {
        let Some(from) = self.end.replace(to).filter(|_| self.cell > 0.0) else {
            return;
        };
        let [start, end] = [from, to].map(|point| (point.at / self.cell).into());
        let [[x, y, z], [u, v, w]]: [[f64; 3]; 2] = [start, end];
        let count = (u - x).abs().max((v - y).abs()).max((w - z).abs());
        let count = count.ceil().max(1.0);
        // Plain numbers: of a motion that goes round and round this is the longest part.
        let cell = |k: f64| {
            let part = k / count;
            let [x, y, z] = [x + part * (u - x), y + part * (v - y), z + part * (w - z)];
            [x.floor() as i64, y.floor() as i64, z.floor() as i64]
        };
        let (mut last, mut k) = (key(cell(0.0)), 0.0);
        // The last point is of this line already: the line becomes longer.
        let mut longer = false;
        while k < count {
            let before = k;
            // Beside a stroke nothing is missed from one cell to the next but one.
            k = count.min(k + if self.drawing { 1.0 } else { 2.0 });
            let here = cell(k);
            let number = key(here);
            if number == last {
                continue;
            }
            last = number;
            // What runs along a stroke is no new one.
            let new = match self.drawing {
                true => !self.covered.contains(&number),
                false => !self.beside.contains(&number),
            };
            if new && !self.drawing {
                self.strokes.push(vec![from.towards(&to, before / count)]);
                longer = false;
            }
            if let Some(stroke) = self.strokes.last_mut().filter(|_| new || self.drawing) {
                if longer {
                    stroke.pop();
                }
                stroke.push(from.towards(&to, k / count));
                longer = true;
            }
            if new {
                self.cover(here);
            }
            self.drawing = new;
        }
    }

    fn cover(&mut self, [x, y, z]: [i64; 3]) {
        self.covered.insert(key([x, y, z]));
        let step = |k: i64| k % 3 - 1;
        let beside = (0..27).map(|k| {
            key([
                x.wrapping_add(step(k)),
                y.wrapping_add(step(k / 3)),
                z.wrapping_add(step(k / 9)),
            ])
        });
        self.beside.extend(beside);
    }

    /// Makes cells larger, and draws all again.
    fn coarsen(&mut self, cell: f64) {
        self.cell = cell;
        self.covered.clear();
        self.beside.clear();
        let (end, drawing) = (self.end, self.drawing);
        for stroke in core::mem::take(&mut self.strokes) {
            self.leave_off();
            stroke.into_iter().for_each(|point| self.draw_to(point));
        }
        (self.end, self.drawing) = (end, drawing && self.drawing);
    }
}

/// Numbers of cells.
type Cells = HashSet<u64, BuildHasherDefault<Spread>>;

/// The number of a cell, which is unique among those of a box with so few along an edge.
fn key([x, y, z]: [i64; 3]) -> u64 {
    const BITS: u32 = 21;
    const PART: u64 = (1 << BITS) - 1;
    x as u64 & PART | (y as u64 & PART) << BITS | (z as u64 & PART) << (2 * BITS)
}

/// Spreads numbers of cells, which nobody chooses so that they meet, by the golden ratio (Knuth 1973).
#[derive(Clone, Copy, Default)]
struct Spread(u64);

impl Hasher for Spread {
    fn write_u64(&mut self, number: u64) {
        let product = u128::from(number) * 0x9e37_79b9_7f4a_7c15;
        self.0 = product as u64 ^ (product >> 64) as u64;
    }

    fn write(&mut self, bytes: &[u8]) {
        bytes
            .iter()
            .for_each(|byte| self.write_u64(self.0 ^ u64::from(*byte)));
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

/// Follows paths through steps that begin and end at these times: `at` gives the places of all at a time.
pub(crate) fn follow(
    paths: &mut [Path],
    times: impl Iterator<Item = f64>,
    at: &mut dyn FnMut(f64) -> Vec<Vector>,
) {
    let mut at = |time: f64| -> Vec<Point> {
        let places = at(time).into_iter();
        places.map(|at| Point { time, at }).collect()
    };
    let mut from: Option<Vec<Point>> = None;
    for time in times {
        let to = at(time);
        match &from {
            Some(from) => go(paths, from, &to, HALVINGS, &mut at),
            None => go_to(paths, &to),
        }
        from = Some(to);
    }
}

/// Goes on to points, halving the way until a picture shows no bend.
fn go(
    paths: &mut [Path],
    from: &[Point],
    to: &[Point],
    halvings: usize,
    at: &mut dyn FnMut(f64) -> Vec<Point>,
) {
    let (Some(first), Some(last)) = (from.first(), to.first()) else {
        return;
    };
    let between = at(first.time + 0.5 * (last.time - first.time));
    let straight = |(i, path): (usize, &Path)| path.is_straight([&from[i], &between[i], &to[i]]);
    // A bend to both sides does not show in the middle of a step.
    let whole = halvings == HALVINGS;
    if halvings == 0 || !whole && paths.iter().enumerate().all(straight) {
        go_to(paths, &between);
        go_to(paths, to);
    } else {
        go(paths, from, &between, halvings - 1, at);
        go(paths, &between, to, halvings - 1, at);
    }
}

fn go_to(paths: &mut [Path], to: &[Point]) {
    for (path, to) in paths.iter_mut().zip(to) {
        path.go_to(*to);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An ellipse around a far place, gone round three hundred times in steps of 0.9 rad, and undefined for a while: it is right to a
    /// thousandth of its size everywhere, and no longer than some rounds.
    #[test]
    fn a_path_is_right_however_often_it_goes_round() {
        let (a, b, period) = (3.0, 2.0, 0.07);
        let angle = |time: f64| core::f64::consts::TAU * time / period;
        let mut paths = [Path::default()];
        let steps = (0..=2100).map(|k| 0.9 * f64::from(k) * period / core::f64::consts::TAU);
        follow(&mut paths, steps, &mut |time| {
            let (sin, cos) = angle(time).sin_cos();
            let gap = (0.2 * period..0.3 * period).contains(&time);
            let x = if gap { f64::NAN } else { 50.0 + a * cos };
            vec![Vector::new(x, b * sin, 0.0)]
        });
        let [path] = &paths;
        let mut directions = [0; 90];
        for stroke in &path.strokes {
            for pair in stroke.windows(2) {
                for part in [0.0, 0.5, 1.0] {
                    let here = pair[0].towards(&pair[1], part).at;
                    let (x, y) = ((here.x - 50.0) / a, here.y / b);
                    assert!((x.hypot(y) - 1.0).abs() < 2e-3, "{here}");
                    directions[((y.atan2(x).to_degrees() + 180.0) / 4.0) as usize % 90] += 1;
                }
            }
        }
        assert!(directions.iter().all(|count| *count > 0), "{directions:?}");
        let points: usize = path.strokes.iter().map(Vec::len).sum();
        assert!(points < 1000, "{points}");
        let first = path.strokes.iter().find_map(|stroke| {
            let end = stroke.last()?.time;
            (end < 0.5 * period).then_some(end)
        });
        let gap = first.expect("a stroke up to the gap");
        assert!((gap - 0.2 * period).abs() < 2e-3 * period, "{gap}");
    }

    /// A spiral that grows by a thousandth of a cell with every round is drawn to its end.
    #[test]
    fn a_path_that_creeps_outward_is_drawn() {
        let mut paths = [Path::default()];
        let radius = |time: f64| 0.5 + 1e-6 * time;
        let steps = (0..=40_000).map(|k| 0.5 * f64::from(k));
        follow(&mut paths, steps, &mut |time| {
            let (sin, cos) = time.sin_cos();
            vec![radius(time) * Vector::new(0.0, cos, sin)]
        });
        let points = || paths[0].strokes.iter().flatten();
        for part in 0..5 {
            let far = radius(4e3 * f64::from(part));
            let nearest = points().map(|point| (point.at.norm() - far).abs());
            let nearest = nearest.fold(f64::MAX, f64::min);
            assert!(nearest < 2.0 * paths[0].cell, "{far}: {nearest}");
        }
        assert!(points().count() < 30_000, "{}", points().count());
    }

    /// A field is covered line by line, and again and again: what is kept has a bound.
    #[test]
    fn a_field_that_is_filled_needs_no_more_points() {
        let mut paths = [Path::default()];
        let steps = (0..=9000).map(|k| 0.1 * f64::from(k));
        follow(&mut paths, steps, &mut |time| {
            let (x, y) = (
                (2.0_f64.sqrt() * 3.0 * time).cos(),
                (3.0_f64.sqrt() * 2.0 * time).cos(),
            );
            vec![Vector::new(x, 0.6 * y, 0.0)]
        });
        let points: usize = paths[0].strokes.iter().map(Vec::len).sum();
        assert!(points <= MOST, "{points}");
        let span = paths[0].high.x - paths[0].low.x;
        assert!((span - 2.0).abs() < 1e-4, "{span}");
    }
}
