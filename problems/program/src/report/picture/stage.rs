//! Films in space → stages: every solid's size, and where it is and how it is turned over all samples, m.
//!
//! What the page draws with the light on it, and frames project.

use super::arrow::is_false;
use super::frame::{self, Newtons, largest};
use super::impulse::{self, Rows};
use super::{Column, finely, strength};
use crate::drawing::Arrow;
use crate::film::Film;
use crate::number::significant;
use crate::outcome::Outcome;
use crate::path::{self, Path};
use crate::space::{Solid, UnitQuaternion, Vector};
use serde::Serialize;

/// A scene in space over time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Stage {
    /// What is there.
    pub bodies: Vec<Body>,
    /// Forces.
    pub arrows: Vec<Thrust>,
    /// Corners of a box around all that is ever there.
    pub low: [f64; 3],
    /// See `low`.
    pub high: [f64; 3],
    /// Length of an arrow for each newton, m; 0 if there are no forces.
    pub reach: f64,
    /// Whether some arrows are shorter than the force is large.
    pub cut: bool,
}

/// A solid over time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Body {
    /// What it is.
    pub kind: &'static str,
    /// Its radius, its edges, m.
    pub size: Vec<f64>,
    /// x, y, z of its origin or of its joints, m.
    pub places: Vec<Column>,
    /// The quaternion of its attitude, scalar part first; nothing if it does not show.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub turn: Vec<Column>,
    /// Of a path: time, s, and x, y, z, m, of every point of its strokes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub strokes: Vec<Vec<[f64; 4]>>,
}

/// A force over time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Thrust {
    /// Name of the item.
    pub name: String,
    /// Whether it is an impulse, seen for a while after its impact.
    #[serde(skip_serializing_if = "is_false")]
    pub impulse: bool,
    /// How large it is, N or N s.
    pub size: Column,
    /// Where it begins, and the arrow from there, m: x, y, z, x, y, z. Forces begin where they act, impulses end there.
    pub numbers: Vec<Column>,
}

/// A stage for each film that is in space. Films of one scene have one scale.
pub(crate) fn stages(films: &[&Film]) -> Vec<Option<Stage>> {
    let stage = |film: &&Film| {
        film.spaces.first()?;
        let alike = films.iter().copied();
        let alike = alike.filter(|other| other.outcome.scene == film.outcome.scene);
        Some(stage(film, alike))
    };
    films.iter().map(stage).collect()
}

fn stage<'a>(film: &Film, alike: impl Iterator<Item = &'a Film> + Clone) -> Stage {
    let spaces = alike.clone().flat_map(|film| &film.spaces);
    let mut around = Box3::EMPTY;
    for solid in spaces.flat_map(|space| &space.solids) {
        if !matches!(solid, Solid::Ground(_)) {
            for place in solid.places() {
                around.hold(place, solid.reach());
            }
        }
    }
    for path in alike.clone().flat_map(|film| &film.paths) {
        around.hold(path.low, Vector::zeros());
        around.hold(path.high, Vector::zeros());
    }
    let thrusts = |kind: Kind| -> Vec<(Vector, Vector)> {
        let thrusts = alike.clone().flat_map(|film| all_thrusts(film, kind));
        thrusts.filter(|(_, force)| force.norm() > 0.0).collect()
    };
    let (forces, impulses) = (thrusts(Kind::Force), thrusts(Kind::Impulse));
    for (at, _) in forces.iter().chain(&impulses) {
        around.hold(*at, Vector::zeros());
    }
    let size = around.grown();
    let mut scale = |kind: Kind, thrusts: &[(Vector, Vector)]| {
        let sizes = thrusts.iter().map(|(_, force)| force.norm());
        let newtons = match kind {
            Kind::Force => Newtons::new(sizes, size),
            Kind::Impulse => Newtons::to_scale(sizes.fold(0.0, f64::max), size),
        };
        for (at, force) in thrusts {
            let end = at + kind.far() * Vector::from(newtons.arrow((*force).into()));
            around.hold(end, Vector::zeros());
        }
        newtons
    };
    let newtons = scale(Kind::Force, &forces);
    let blows = scale(Kind::Impulse, &impulses);
    let mut arrows = self::arrows(film, Kind::Force, &newtons, size);
    arrows.extend(self::arrows(film, Kind::Impulse, &blows, size));
    Stage {
        bodies: bodies(film, size),
        cut: arrows
            .iter()
            .any(|arrow| !arrow.impulse && largest(&arrow.size) > newtons.most()),
        arrows,
        low: around.low.map(|x| near(x, size)),
        high: around.high.map(|x| near(x, size)),
        reach: significant(newtons.reach),
    }
}

/// A box around points.
struct Box3 {
    low: [f64; 3],
    high: [f64; 3],
}

impl Box3 {
    const EMPTY: Self = Self {
        low: [f64::INFINITY; 3],
        high: [f64::NEG_INFINITY; 3],
    };

    fn hold(&mut self, at: Vector, reach: Vector) {
        for k in 0..3 {
            self.low[k] = self.low[k].min(at[k] - reach[k]);
            self.high[k] = self.high[k].max(at[k] + reach[k]);
        }
    }

    /// The size of a picture of what is in it, which is its longest edge but where that is next to nothing: it grows to that size then.
    fn grown(&mut self) -> f64 {
        // A ground alone is nowhere.
        if self.low[0] > self.high[0] {
            self.hold(Vector::zeros(), Vector::zeros());
        }
        let (low, high) = (Vector::from(self.low), Vector::from(self.high));
        let finite = |lengths: Vector| {
            let lengths = lengths.iter().copied();
            lengths.filter(|x| x.is_finite()).fold(0.0, f64::max)
        };
        let apart = finite(high - low);
        let size = frame::size(apart, finite(low.abs()).max(finite(high.abs())));
        if size > apart {
            self.hold(0.5 * (low + high), Vector::repeat(0.5 * size));
        }
        size
    }
}

/// To a hundred-thousandth of the size of all.
fn near(x: f64, size: f64) -> f64 {
    let digits = 10_f64.powf((5.0 - size.log10()).floor());
    (x * digits).round() / digits + 0.0
}

fn bodies(film: &Film, size: f64) -> Vec<Body> {
    let spaces = &film.spaces;
    let mut paths = film.paths.iter();
    let Some(first) = spaces.first() else {
        return Vec::new();
    };
    let mut body = |(i, solid): (usize, &Solid)| {
        let path = paths.by_ref();
        let path = path.take(usize::from(matches!(solid, Solid::Trace(_))));
        let over = || spaces.iter().map(move |space| &space.solids[i]);
        // Where a path is, its strokes say.
        let places = match solid {
            Solid::Trace(_) => 0,
            solid => solid.places().len(),
        };
        let coordinate = |k: usize, axis: usize| {
            let numbers =
                over().map(|solid| solid.places().get(k).map_or(0.0, |place| place[axis]));
            Column::of(numbers.map(|x| near(x, size)))
        };
        Body {
            kind: solid.kind(),
            size: solid.size(),
            places: (0..places)
                .flat_map(|k| (0..3).map(move |axis| (k, axis)))
                .map(|(k, axis)| coordinate(k, axis))
                .collect(),
            turn: columns(&turns(over())),
            strokes: path.flat_map(|path| strokes(path, size)).collect(),
        }
    };
    first.solids.iter().enumerate().map(&mut body).collect()
}

fn strokes(path: &Path, size: f64) -> impl Iterator<Item = Vec<[f64; 4]>> {
    let point = move |point: &path::Point| {
        let [x, y, z] = [0, 1, 2].map(|axis| near(point.at[axis], size));
        [finely(point.time), x, y, z]
    };
    let strokes = path.strokes.iter();
    strokes.map(move |stroke| stroke.iter().map(point).collect())
}

/// Attitudes of one solid over time; what has turned, as the sum of small turns, of a ball whose rates alone are known.
fn turns<'a>(solids: impl Iterator<Item = &'a Solid>) -> Vec<UnitQuaternion<f64>> {
    let mut turn = UnitQuaternion::identity();
    let mut before: Option<Vector> = None;
    let attitude = |solid: &Solid| match solid {
        Solid::RolledBall(_, _, angles) => {
            if !angles.iter().all(|angle| angle.is_finite()) {
                return Some(UnitQuaternion::from_scaled_axis(*angles));
            }
            let more = before.map_or(Vector::zeros(), |before| angles - before);
            before = Some(*angles);
            turn = UnitQuaternion::from_scaled_axis(more) * turn;
            Some(turn)
        }
        other => other.turn(),
    };
    solids.filter_map(attitude).collect()
}

/// The four numbers over time, each next to the one before: q and −q are one attitude.
fn columns(turns: &[UnitQuaternion<f64>]) -> Vec<Column> {
    if turns.is_empty() {
        return Vec::new();
    }
    let mut numbers: Vec<[f64; 4]> = Vec::new();
    for turn in turns {
        let q = [turn.w, turn.i, turn.j, turn.k];
        let same: f64 = numbers
            .last()
            .map_or(1.0, |last| (0..4).map(|k| last[k] * q[k]).sum());
        numbers.push(if same < 0.0 { q.map(|x| -x) } else { q });
    }
    let column = |k: usize| Column::of(numbers.iter().map(|q| near(q[k], 1.0)));
    (0..4).map(column).collect()
}

/// What arrows stand for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Force,
    Impulse,
}

impl Kind {
    /// Where the end of an arrow is that is not where it acts: forces begin there, impulses end there.
    fn far(self) -> f64 {
        match self {
            Kind::Force => 1.0,
            Kind::Impulse => -1.0,
        }
    }

    /// What acts along every row at every sample.
    fn rows(self, outcome: &Outcome) -> Rows {
        match self {
            Kind::Force => impulse::forces(outcome),
            Kind::Impulse => impulse::impulses(outcome),
        }
    }
}

/// What acts in a film, where and how strong at every sample.
fn all_thrusts(film: &Film, kind: Kind) -> Vec<(Vector, Vector)> {
    let count = film.spaces.first().map_or(0, |space| space.arrows.len());
    let acting = kind.rows(&film.outcome);
    let thrusts = (0..count).flat_map(|i| thrusts(film, kind, &acting, i));
    thrusts.collect()
}

/// The arrow number `i` over time.
fn thrusts(film: &Film, kind: Kind, acting: &Rows, i: usize) -> Vec<(Vector, Vector)> {
    let samples = film.spaces.iter().zip(acting);
    let thrust = samples.map(|(space, acting)| {
        let arrow = &space.arrows[i];
        let sum = arrow.sum(acting, kind == Kind::Impulse);
        (arrow.at.into(), sum.into())
    });
    thrust.collect()
}

/// An arrow for each force; of impulses, for those that there ever are.
fn arrows(film: &Film, kind: Kind, newtons: &Newtons, size: f64) -> Vec<Thrust> {
    let Some(first) = film.spaces.first() else {
        return Vec::new();
    };
    let acting = kind.rows(&film.outcome);
    let arrow = |(i, arrow): (usize, &Arrow<3>)| {
        let thrusts = thrusts(film, kind, &acting, i);
        if kind == Kind::Impulse && thrusts.iter().all(|(_, impulse)| impulse.norm() == 0.0) {
            return None;
        }
        let over = |number: &dyn Fn(&(Vector, Vector)) -> f64| {
            Column::of(thrusts.iter().map(|thrust| near(number(thrust), size)))
        };
        let back = 0.5 - 0.5 * kind.far();
        let at =
            (0..3).map(|k| over(&|(at, force)| at[k] - back * newtons.arrow((*force).into())[k]));
        let along = (0..3).map(|k| over(&|(_, force)| newtons.arrow((*force).into())[k]));
        Some(Thrust {
            name: match kind {
                Kind::Force => arrow.name.to_owned(),
                Kind::Impulse => format!("impulse of {}", arrow.name),
            },
            impulse: kind == Kind::Impulse,
            size: Column::of(thrusts.iter().map(|(_, force)| strength(force.norm()))),
            numbers: at.chain(along).collect(),
        })
    };
    first.arrows.iter().enumerate().filter_map(arrow).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Pose;

    /// A ball that rolls along x, then along y, as much as a quarter turn each: what pointed up points along x, then stays there.
    #[test]
    fn turns_add_up_in_their_order() {
        let quarter = core::f64::consts::FRAC_PI_2;
        let rolled =
            |a: f64, b: f64| Solid::RolledBall(1.0, Vector::zeros(), Vector::new(a, b, 0.0));
        let course = [
            rolled(0.0, 0.0),
            rolled(0.0, quarter),
            rolled(quarter, quarter),
        ];
        let turns = turns(course.iter());
        let up = turns[2] * Vector::z();
        assert!((up - Vector::x()).norm() < 1e-15, "{up}");
        let fixed = [Solid::Mass(Vector::zeros())];
        assert_eq!(columns(&super::turns(fixed.iter())), []);
        let back = Solid::Ball(
            1.0,
            Pose::at(0.0, 0.0, 0.0).turned(4.0 * quarter * Vector::z()),
        );
        let still = Solid::Ball(1.0, Pose::at(0.0, 0.0, 0.0));
        // A whole turn is −1, the same attitude as 1.
        assert!(
            columns(&super::turns([still, back].iter()))
                .iter()
                .all(|c| matches!(c, Column::Constant(_)))
        );
    }

    /// A ball of no size in space: pushed at a height above it with a force, and moved at a speed.
    #[test]
    fn what_rests_in_space_has_a_size() {
        for (height, push, speed, size) in [
            (0.5, 1.0, 0.0, 0.5),
            (40.0, 1.0, 1e-6, 40.0),
            (40.0, 0.0, 1e-6, 2e-6),
            (40.0, 0.0, 0.0, 1.0),
        ] {
            let declared = format!(
                "coordinates(x, y, z), kinetic = (der(x)^2 + der(y)^2 + der(z)^2)/2,
                 force(push: (0, {push:?}, 0) at (x, y, z + {height:?})), constraint(guide: y == 0),
                 start(rest: z = 1/2, der(x) = {speed:?}), until = 2,"
            );
            let scene = crate::file::scene("seen.lagrange", &declared).expect("a declaration");
            let request = crate::request::Request {
                samples: 20,
                ..Default::default()
            };
            let film = scene.film(&request).expect("a film");
            let stage = stages(&[&film]).remove(0).expect("a stage");
            let edges = [0, 1, 2].map(|k| stage.high[k] - stage.low[k]);
            let longest = edges.into_iter().fold(0.0, f64::max);
            assert!((longest - size).abs() < 1e-4 * size, "{stage:?}");
            let view = super::super::view::View::of(&stage);
            let middle = Vector::from_fn(|k, _| 0.5 * (stage.low[k] + stage.high[k]));
            let [x, y] = view.place(middle);
            assert!((0.0..1000.0).contains(&x) && (0.0..view.height).contains(&y));
        }
    }
}
