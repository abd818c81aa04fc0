//! Which part of the plane is seen, and how long arrows are.

use super::impulse::{self, Rows};
use super::{Column, WIDTH};
use crate::drawing::{Shape, union};
use crate::film::Film;
use crate::outcome::Outcome;

/// Part of the picture that the strongest force takes.
const LONGEST: f64 = 0.2;
/// Part of the forces that is drawn to scale at least: few peaks must not make all others invisible.
const TO_SCALE: f64 = 0.95;
/// Arrows of stronger forces, in terms of the strongest one that is to scale, are cut.
const CUT: f64 = 1.2;

/// A window on the plane.
pub(crate) struct Frame {
    left: f64,
    right: f64,
    low: f64,
    high: f64,
    /// Largest extent of what is drawn but for the lengths of arrows, m.
    pub size: f64,
    /// Units per metre.
    pub scale: f64,
    /// How long arrows of forces are.
    pub newtons: Newtons,
    /// How long arrows of impulses are.
    pub blows: Newtons,
}

/// How long the arrows of forces are.
pub(crate) struct Newtons {
    /// The strongest force that is drawn to scale, N; 0 if there are none.
    pub strongest: f64,
    /// Metres of an arrow for each newton.
    pub reach: f64,
}

impl Newtons {
    /// For forces of these sizes, N, in a picture of `size` metres.
    pub fn new(sizes: impl Iterator<Item = f64>, size: f64) -> Self {
        let mut sizes: Vec<f64> = sizes.filter(|f| f.is_finite() && *f > 0.0).collect();
        sizes.sort_by(f64::total_cmp);
        let at = (TO_SCALE * sizes.len() as f64) as usize;
        Self::to_scale(sizes.get(at).copied().unwrap_or(0.0), size)
    }

    /// For forces of which the strongest that is to scale is this one, N.
    pub fn to_scale(strongest: f64, size: f64) -> Self {
        Self {
            strongest,
            reach: if strongest > 0.0 {
                LONGEST * size / strongest
            } else {
                0.0
            },
        }
    }

    /// The force from which on arrows are cut, N.
    pub fn most(&self) -> f64 {
        CUT * self.strongest
    }

    /// The arrow of a force, m.
    pub fn arrow<const D: usize>(&self, force: [f64; D]) -> [f64; D] {
        let size = force.iter().fold(0.0, |sum: f64, f| sum.hypot(*f));
        let cut = if size > self.most() {
            self.most() / size
        } else {
            1.0
        };
        force.map(|f| f * cut * self.reach)
    }
}

/// The size of a picture, m, of what is so far apart, and so far from the origin. What is apart by rounding only, or not at all, has a picture
/// as large as it is far away.
pub(super) fn size(apart: f64, away: f64) -> f64 {
    match apart > (1e-9 * away).max(1e-12) {
        true => apart,
        false => away.max(1.0),
    }
}

/// The largest of numbers over time.
pub(super) fn largest(column: &Column) -> f64 {
    match column {
        Column::Constant(value) => *value,
        Column::Varying(values) => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    }
}

impl Frame {
    /// Around all that is ever drawn in these films, arrows too.
    pub fn around<'a>(films: impl Iterator<Item = &'a Film> + Clone) -> Option<Self> {
        let all = |rows: fn(&Outcome) -> Rows, impulse: bool| -> Vec<[f64; 4]> {
            films
                .clone()
                .flat_map(|film| pushes(film, &rows(&film.outcome), impulse))
                .collect()
        };
        let forces = all(impulse::forces, false);
        let impulses = all(impulse::impulses, true);
        let drawings = films.clone().flat_map(|film| &film.drawings);
        let shapes = drawings.flat_map(|d| &d.shapes).map(Shape::extent);
        let paths = films.clone().flat_map(|film| &film.paths);
        let paths = paths.map(|path| [path.low.x, path.high.x, path.low.y, path.high.y]);
        let pushed = forces.iter().chain(&impulses);
        let pushed = pushed.map(|&[x, y, ..]| [x, x, y, y]);
        // A floor alone is nowhere across.
        let place = |from: f64, to: f64| if from <= to { (from, to) } else { (0.0, 0.0) };
        let [left, right, low, high] = shapes.chain(paths).chain(pushed).reduce(union)?;
        let ((left, right), (low, high)) = (place(left, right), place(low, high));
        let finite = |lengths: &[f64]| {
            let lengths = lengths.iter().copied();
            lengths.filter(|x| x.is_finite()).fold(0.0, f64::max)
        };
        let away = finite(&[left, right, low, high].map(f64::abs));
        let size = size(finite(&[right - left, high - low]), away);
        let sizes = |pushes: &[[f64; 4]]| -> Vec<f64> {
            pushes.iter().map(|[_, _, x, y]| x.hypot(*y)).collect()
        };
        let strongest = sizes(&impulses).into_iter().fold(0.0, f64::max);
        let mut frame = Self {
            left,
            right,
            low,
            high,
            size,
            scale: 1.0,
            newtons: Newtons::new(sizes(&forces).into_iter(), size),
            blows: Newtons::to_scale(strongest, size),
        };
        // Far ends: the tips of forces, the beginnings of impulses.
        let far = |pushes: &[[f64; 4]], newtons: &Newtons, sign: f64| -> Vec<[f64; 2]> {
            let end = |&[x, y, fx, fy]: &[f64; 4]| {
                let [dx, dy] = newtons.arrow([fx, fy]);
                [x + sign * dx, y + sign * dy]
            };
            pushes.iter().map(end).collect()
        };
        let ends = [
            far(&forces, &frame.newtons, 1.0),
            far(&impulses, &frame.blows, -1.0),
        ]
        .concat();
        for [x, y] in ends {
            (frame.left, frame.right) = (frame.left.min(x), frame.right.max(x));
            (frame.low, frame.high) = (frame.low.min(y), frame.high.max(y));
        }
        let grow = |from: f64, to: f64, least: f64| {
            let more = (0.5 * (least - (to - from))).max(0.0) + 0.06 * size;
            (from - more, to + more)
        };
        (frame.left, frame.right) = grow(frame.left, frame.right, 0.5 * size);
        (frame.low, frame.high) = grow(frame.low, frame.high, 0.25 * size);
        frame.scale = WIDTH / (frame.right - frame.left);
        Some(frame)
    }

    /// Units across.
    pub fn x(&self, x: f64) -> f64 {
        (x - self.left) * self.scale
    }

    /// Units down.
    pub fn y(&self, y: f64) -> f64 {
        (self.high - y) * self.scale
    }

    /// Units from top to bottom.
    pub fn height(&self) -> f64 {
        (self.high - self.low) * self.scale
    }

    /// A length for a ruler, m.
    pub fn ruler(&self) -> f64 {
        super::nice((self.right - self.left) / 6.0)
    }
}

/// Places of all arrows at all samples at which something acts there, and what: x and y, m, and the components, N or N s.
fn pushes(film: &Film, acting: &Rows, impulse: bool) -> Vec<[f64; 4]> {
    let samples = film.drawings.iter().zip(acting);
    let pushes = samples.flat_map(|(drawing, acting)| {
        drawing.arrows.iter().map(move |arrow| {
            let ([x, y], [fx, fy]) = (arrow.at, arrow.sum(acting, impulse));
            [x, y, fx, fy]
        })
    });
    // Where nothing acts there is no arrow to be seen.
    pushes
        .filter(|[_, _, fx, fy]| fx.hypot(*fy) > 0.0)
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::file;
    use crate::report::picture::{Column, Form, Picture, pictures};
    use crate::request::Request;

    /// The picture of what a text declares.
    fn picture(declared: &str) -> Picture {
        let scene = file::scene("seen.lagrange", declared).expect("a declaration");
        let request = Request {
            samples: 20,
            ..Request::default()
        };
        let film = scene.film(&request).expect("a film");
        let picture = pictures(&[&film]).remove(0).expect("a picture");
        assert!((200.0..4000.0).contains(&picture.height), "{picture:?}");
        picture
    }

    /// Least and greatest value over time.
    fn ends(column: &Column) -> [f64; 2] {
        match column {
            Column::Constant(value) => [*value, *value],
            Column::Varying(values) => [f64::min, f64::max].map(|choose| {
                let chosen = values.iter().copied().reduce(choose);
                chosen.expect("a value")
            }),
        }
    }

    /// Where the centre of the first mass is: x and y, and how far it comes from left to right and up and down.
    fn mass(picture: &Picture) -> [[f64; 2]; 2] {
        let marks = picture.marks.iter();
        let mut circles = marks.filter(|mark| mark.form == Form::Circle);
        let mass = circles.next().expect("a mass");
        let [x, y] = [0, 1].map(|k| ends(&mass.numbers[k]));
        let inside = x[0] >= 0.0 && x[1] <= 1000.0 && y[0] >= 0.0 && y[1] <= picture.height;
        assert!(inside, "{picture:?}");
        [[x[0], y[0]], [x[1] - x[0], y[1] - y[0]]]
    }

    /// Units of a metre, by the ruler.
    fn metre(picture: &Picture) -> f64 {
        let ruler = &picture.rulers[0];
        let length: f64 = ruler.text.trim_end_matches(" m").parse().expect("metres");
        ruler.length / length
    }

    /// A body that is pushed across its guide, at a place that is a height above it.
    fn pushed(height: f64, speed: f64) -> Picture {
        picture(&format!(
            "coordinates(x, y), kinetic = (der(x)^2 + der(y)^2)/2, potential = 10*y,
             force(push: (1, 0) at (x, y + {height})), constraint(guide: x == {speed:?}*t),
             contact(floor: y >= 1/2), start(rest: y = 1/2, der(x) = {speed:?}), until = 2,"
        ))
    }

    #[test]
    fn what_rests_is_seen_with_the_places_of_its_forces() {
        for height in [1e-3, 0.5, 40.0] {
            let picture = pushed(height, 0.0);
            let [[x, y], come] = mass(&picture);
            assert_eq!(come, [0.0, 0.0]);
            let push = picture.arrows.iter().find(|arrow| arrow.name == "push");
            let [at_x, at_y] = [0, 1].map(|k| ends(&push.expect("a force").numbers[k])[0]);
            assert!((at_x - x).abs() < 0.02, "{picture:?}");
            let apart = height * metre(&picture);
            assert!((y - at_y - apart).abs() < 1e-3 * apart, "{picture:?}");
            assert!(apart > 0.3 * picture.height, "{picture:?}");
        }
        // Nothing acts up there.
        let picture = picture(
            "coordinates(x, y), kinetic = (der(x)^2 + der(y)^2)/2, force(push: (0*t, 0) at (x, y + 40)),
             start(rest: y = 1/2), until = 2,",
        );
        assert!((1e2..1e4).contains(&metre(&picture)), "{picture:?}");
    }

    #[test]
    fn what_hardly_moves_fills_the_picture() {
        for (speed, seen) in [(1e-7, true), (1e-6, true), (1.0, true), (1e-12, false)] {
            let picture = picture(&format!(
                "coordinates(x, y), kinetic = (der(x)^2 + der(y)^2)/2, start(slow: y = 1/2, der(x) = {speed:?}), until = 2,"
            ));
            let [_, [come, _]] = mass(&picture);
            match seen {
                true => assert!((500.0..1000.0).contains(&come), "{picture:?}"),
                false => assert!(come == 0.0, "rounding is not shown: {picture:?}"),
            }
        }
    }

    #[test]
    fn one_coordinate_is_enough() {
        let scene = |start: &str| {
            picture(&format!(
                "coordinates(z), kinetic = der(z)^2/2, draw(mass: (0, z)), draw(floor: -1), start(a: {start}), until = 1,"
            ))
        };
        let [_, come] = mass(&scene("z = 0"));
        assert_eq!(come, [0.0, 0.0]);
        let rising = scene("der(z) = 1");
        let [_, [aside, up]] = mass(&rising);
        let metre = metre(&rising);
        assert!(
            aside == 0.0 && (up - metre).abs() < 1e-3 * metre,
            "{rising:?}"
        );
        // A floor alone is nowhere across.
        picture("coordinates(z), kinetic = der(z)^2/2, draw(floor: 3), until = 1,");
    }
}
