//! What a system declares with `draw(…)` → its pictures: the values of places, sizes and forces at every sample of a run.
//!
//! They are read from the declaration as it was written, by the evaluator of certificates; the run knows nothing of them.

use crate::drawing::{Arrow, Drawing, Shape};
use crate::outcome::{Outcome, forces};
use crate::path::{Path, follow};
use crate::space::{Pose, Solid, Space, Vector};
use lagrange_core::__private::declaration::{Declaration, Draw, Evaluator, Form, Inputs, Turn};
use lagrange_core::prelude::*;

/// The pictures of all samples: in a plane, or in space.
#[derive(Default)]
pub(crate) struct Pictures {
    /// One for each sample, if the places have two coordinates.
    pub drawings: Vec<Drawing>,
    /// One for each sample, if the places have three.
    pub spaces: Vec<Space>,
    /// What is no finite number at some sample, so that it is not drawn there, and the time of the first of these, s.
    pub nowhere: Vec<(&'static str, f64)>,
}

/// The pictures of a run.
pub(crate) fn pictures(declaration: &'static Declaration, outcome: &Outcome) -> Pictures {
    let draws: Vec<&Draw> = declaration
        .draws
        .iter()
        .filter(|draw| takes_part(draw, outcome))
        .collect();
    if draws.is_empty() {
        return Pictures::default();
    }
    let mut instant = Instant::new(declaration, &outcome.parameters);
    let (mut drawings, mut spaces) = (Vec::new(), Vec::new());
    let mut nowhere: Vec<Option<f64>> = vec![None; draws.len()];
    let places = draws.iter().flat_map(|draw| draw.places);
    let in_space = places.map(|place| place.len()).max() == Some(3);
    for sample in &outcome.samples {
        let moment = instant.at((sample.time, &sample.state, &sample.forces), &draws);
        for (draw, first) in draws.iter().zip(&mut nowhere) {
            let missing = !moment.is_somewhere(draw);
            *first = first.or(missing.then_some(sample.time));
        }
        match in_space {
            true => spaces.push(moment.space()),
            false => drawings.push(moment.drawing()),
        }
    }
    let nowhere = draws.iter().zip(nowhere);
    let nowhere = nowhere.filter_map(|(draw, first)| Some((called(draw), first?)));
    Pictures {
        drawings,
        spaces,
        nowhere: nowhere.collect(),
    }
}

/// What is written in `draw(…)`, or the name of an arrow.
fn called(draw: &Draw) -> &'static str {
    match draw.form {
        Form::Floor => "floor",
        Form::Ground => "ground",
        Form::Shell => "shell",
        Form::Bowl => "bowl",
        Form::Disc => "disc",
        Form::Polygon => "polygon",
        Form::Box => "box",
        Form::Sphere => "sphere",
        Form::HalfEllipsoid => "half_ellipsoid",
        Form::Rod => "rod",
        Form::Rope => "rope",
        Form::Spring => "spring",
        Form::Mass => "mass",
        Form::Pivot => "pivot",
        Form::Path => "path",
        Form::Arrow => draw.name,
    }
}

/// Where what is drawn with a path has been in a motion.
pub(crate) fn paths(trajectory: &Trajectory) -> Vec<Path> {
    let declaration = trajectory.declaration();
    let draws = declaration.draws.iter();
    let draws: Vec<&Draw> = draws.filter(|draw| draw.form == Form::Path).collect();
    let mut paths = vec![Path::default(); draws.len()];
    let parameters = 0..trajectory.description().parameters.len();
    let parameters: Vec<f64> = parameters.map(|i| trajectory.parameter(i)).collect();
    let mut instant = Instant::new(declaration, &parameters);
    let mut sampler = trajectory.sampler();
    let mut at = |time: f64| match sampler.at(time) {
        Ok(known) => {
            let moment = instant.at((time, &known.state, &known.forces), &draws);
            let place = |draw: &&Draw| moment.list(draw.places[0]).into();
            draws.iter().map(place).collect()
        }
        Err(_) => vec![Vector::repeat(f64::NAN); draws.len()],
    };
    if !draws.is_empty() {
        let times = trajectory.step_times().chain([trajectory.last_time()]);
        follow(&mut paths, times, &mut at);
    }
    paths
}

/// Whether all items whose forces an arrow shows are in the run.
fn takes_part(draw: &Draw, outcome: &Outcome) -> bool {
    let known = forces(outcome.description);
    let included = |row: usize| {
        let force = known.iter().find(|force| force.row == row);
        force.is_some_and(|force| outcome.includes(force.source))
    };
    let left_out = outcome.left_out();
    let named = |load: &usize| left_out.contains(&outcome.description.forces[*load].name);
    draw.parts.iter().all(|(row, _)| included(*row)) && !draw.loads.iter().any(named)
}

/// Evaluates a declaration at samples.
struct Instant {
    declaration: &'static Declaration,
    evaluator: Evaluator,
}

impl Instant {
    fn new(declaration: &'static Declaration, parameters: &[f64]) -> Self {
        Self {
            declaration,
            evaluator: Evaluator::of_everything(declaration, parameters),
        }
    }

    /// At a time, in a state, with these forces along the rows.
    fn at<'a>(
        &'a mut self,
        (time, state, forces): (f64, &'a State<f64>, &'a Vec<f64>),
        draws: &'a [&'a Draw],
    ) -> Moment<'a> {
        let still = vec![0.0; state.q.len()];
        let mut loads = vec![0.0; self.declaration.forces.len()];
        let mut evaluate = |loads: &[f64]| {
            self.evaluator.evaluate(Inputs {
                time,
                q: &state.q,
                v: &state.v,
                acceleration: &still,
                forces,
                loads,
            });
            let values = self.declaration.forces.iter();
            values
                .map(|force| self.evaluator.value(force.value))
                .collect()
        };
        if draws.iter().any(|draw| !draw.loads.is_empty()) {
            // What an applied force is, is itself a value of the declaration.
            loads = evaluate(&loads);
        }
        let _: Vec<f64> = evaluate(&loads);
        Moment {
            evaluator: &self.evaluator,
            q: &state.q,
            draws,
        }
    }
}

/// All values at one sample.
struct Moment<'a> {
    evaluator: &'a Evaluator,
    q: &'a [f64],
    draws: &'a [&'a Draw],
}

impl Moment<'_> {
    /// A value; what is infinite is as little of a place or size as what is no number.
    fn value(&self, value: usize) -> f64 {
        let value = self.evaluator.value(value);
        if value.is_finite() { value } else { f64::NAN }
    }

    /// As many sizes as fit: none is negative.
    fn sizes<const D: usize>(&self, draw: &Draw) -> [f64; D] {
        let sizes: [f64; D] = self.list(draw.size);
        sizes.map(|size| if size < 0.0 { f64::NAN } else { size })
    }

    /// Whether all that is said of something is a finite number.
    fn is_somewhere(&self, draw: &Draw) -> bool {
        let turn = match &draw.turn {
            Turn::Angle(angle) => core::slice::from_ref(angle),
            Turn::About(values) | Turn::Rolled(values) => values,
            Turn::None | Turn::Attitude(_) => &[],
        };
        let slopes = draw.parts.iter().flat_map(|(_, slope)| *slope);
        let places = draw.places.iter().copied().flatten();
        let mut values = places.chain(turn).chain(draw.applied).chain(slopes);
        let sizes: [f64; 3] = self.sizes(draw);
        values.all(|value| self.value(*value).is_finite()) && sizes.iter().all(|x| x.is_finite())
    }

    /// As many values as fit; the others are 0.
    fn list<const D: usize>(&self, values: &[usize]) -> [f64; D] {
        core::array::from_fn(|k| values.get(k).map_or(0.0, |value| self.value(*value)))
    }

    fn places<const D: usize>(&self, draw: &Draw) -> Vec<[f64; D]> {
        draw.places.iter().map(|place| self.list(place)).collect()
    }

    fn arrows<const D: usize>(&self) -> Vec<Arrow<D>> {
        let arrows = self.draws.iter().filter(|draw| draw.form == Form::Arrow);
        let arrow = |draw: &&Draw| Arrow {
            name: draw.name,
            at: self.places(draw)[0],
            parts: draw
                .parts
                .iter()
                .map(|(row, slope)| (*row, self.list(slope)))
                .collect(),
            applied: self.list(draw.applied),
        };
        arrows.map(arrow).collect()
    }

    fn drawing(&self) -> Drawing {
        let shapes = self.draws.iter().filter_map(|draw| self.shape(draw));
        Drawing {
            shapes: shapes.collect(),
            arrows: self.arrows(),
        }
    }

    fn shape(&self, draw: &Draw) -> Option<Shape> {
        let places: Vec<[f64; 2]> = self.places(draw);
        let at = places[0];
        let [size, height] = self.sizes(draw);
        let angle = match draw.turn {
            Turn::Angle(angle) => self.value(angle),
            _ => 0.0,
        };
        Some(match draw.form {
            Form::Floor => Shape::Floor(at[0]),
            Form::Ground => Shape::Fixed(places),
            Form::Shell => Shape::Shell(at, size),
            Form::Bowl => Shape::Bowl(at, size),
            Form::Disc => Shape::Disc(at, size, angle),
            Form::Polygon => Shape::Block(places),
            Form::Box => Shape::Block(corners(at, [size, height], angle)),
            Form::Rod => Shape::Rod(places),
            Form::Rope => Shape::Rope(places),
            Form::Spring => Shape::Spring(at, places[1]),
            Form::Mass => Shape::Mass(at),
            Form::Pivot => Shape::Pivot(at),
            Form::Path => Shape::Trace(at),
            Form::Arrow | Form::Sphere | Form::HalfEllipsoid => return None,
        })
    }

    fn space(&self) -> Space {
        let solids = self.draws.iter().filter_map(|draw| self.solid(draw));
        Space {
            solids: solids.collect(),
            arrows: self.arrows(),
        }
    }

    fn solid(&self, draw: &Draw) -> Option<Solid> {
        let places: Vec<Vector> = self.places(draw).into_iter().map(Vector::from).collect();
        let at = places[0];
        let [x, y, z] = self.sizes(draw);
        let pose = self.pose(at, draw.turn);
        Some(match (draw.form, draw.turn) {
            (Form::Floor, _) => Solid::Ground(Pose {
                at: at.x * Vector::z(),
                ..pose
            }),
            (Form::Sphere, Turn::Rolled(angles)) => {
                Solid::RolledBall(x, at, self.list(angles).into())
            }
            (Form::Sphere, _) => Solid::Ball(x, pose),
            (Form::HalfEllipsoid, _) => Solid::HalfEllipsoid([x, y, z], pose),
            (Form::Box, _) => Solid::Box([x, y, z], pose),
            (Form::Disc, _) => Solid::Disc(x, y, pose),
            (Form::Rod | Form::Rope, _) => Solid::Rod(places),
            (Form::Spring, _) => Solid::Rod(coil(at, places[1])),
            (Form::Mass, _) => Solid::Mass(at),
            (Form::Pivot, _) => Solid::Pivot(at),
            (Form::Path, _) => Solid::Trace(at),
            (Form::Shell, _) => Solid::Shell(x, at),
            (Form::Bowl, _) => Solid::Bowl(x, at),
            (Form::Arrow | Form::Ground | Form::Polygon, _) => return None,
        })
    }

    fn pose(&self, at: Vector, turn: Turn) -> Pose {
        let pose = Pose::at(at.x, at.y, at.z);
        match turn {
            Turn::Attitude(first) => pose.attitude(&self.q[first..first + 4]),
            Turn::About(vectors) => vectors
                .chunks_exact(3)
                .fold(pose, |pose, vector| pose.turned(self.list(vector).into())),
            Turn::None | Turn::Angle(_) | Turn::Rolled(_) => pose,
        }
    }
}

/// The corners of a rectangle around a place.
fn corners(at: [f64; 2], [width, height]: [f64; 2], angle: f64) -> Vec<[f64; 2]> {
    let (sin, cos) = angle.sin_cos();
    let corner = |[a, b]: [f64; 2]| {
        let (x, y) = (a * width / 2.0, b * height / 2.0);
        [at[0] + x * cos - y * sin, at[1] + x * sin + y * cos]
    };
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        .map(corner)
        .into()
}

/// A coil of ten turns from one place to another, a twelfth of its length wide.
fn coil(from: Vector, to: Vector) -> Vec<Vector> {
    const TURNS: usize = 10;
    const JOINTS: usize = 8 * TURNS;
    let along = to - from;
    let least = along.iamin();
    let side = along.cross(&Vector::ith(least, 1.0));
    let side = side.try_normalize(0.0).unwrap_or_default() * along.norm() / 24.0;
    let other = along.try_normalize(0.0).unwrap_or_default().cross(&side);
    let joint = |k: usize| {
        let part = k as f64 / JOINTS as f64;
        let (sin, cos) = (core::f64::consts::TAU * TURNS as f64 * part).sin_cos();
        from + part * along + cos * side + sin * other
    };
    let inner = (1..JOINTS).map(joint);
    core::iter::once(from).chain(inner).chain([to]).collect()
}

#[cfg(test)]
mod tests {
    use crate::drawing::Shape;
    use crate::file;
    use crate::film::Film;
    use crate::request::Request;
    use crate::space::{Solid, UnitQuaternion, Vector};

    /// A film of what a text declares, with some items left out.
    fn film(items: &str, without: &[&str]) -> Film {
        let effects = without.iter().map(|name| (name.to_string(), false));
        let request = Request {
            samples: 20,
            effects: effects.collect(),
            ..Request::default()
        };
        let scene = file::scene("drawn.lagrange", items).expect("a declaration");
        scene.film(&request).expect("a film")
    }

    const BLOCK: &str = "
        parameters(mass = 2, gravity = 10, speed = 3, radius = 0.5),
        coordinates(x, y, phi),
        kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass/2 * der(phi)^2,
        potential = mass * gravity * y,
        contact(floor: y >= 0, restitution = 1/2),
        friction(grip on floor: slip = der(x), static = 0.1),
        force(wind: (t, 2) at (x, y)),
        force(drive: x = 4 * t),
        start(thrown: y = 1, der(x) = speed, der(phi) = 1),
        until = 2,
    ";

    #[test]
    fn shapes_and_forces_have_the_values_that_are_written() {
        let draws = "
            draw(floor: -radius),
            draw(box: (x, y), size = (2, 1), angle = phi),
            draw(rod: (0, 0) to list(k in 1..3: (k * x, y + t))),
            draw(arrow: floor * (0, 1) + grip * (1, 0) at (x, y)),
            draw(arrow: drive * (1, 0) + (0, -mass * gravity) at (x, 0), name = sum),
            draw(arrow: wind),
        ";
        let film = film(&format!("{BLOCK}{draws}"), &[]);
        assert!(film.outcome.events.len() > 3, "it bounces");
        for (drawing, sample) in film.drawings.iter().zip(&film.outcome.samples) {
            let [x, y, phi] = sample.state.q[..] else {
                panic!("three coordinates");
            };
            let t = sample.time;
            let (sin, cos) = phi.sin_cos();
            let [floor, block, rod] = &drawing.shapes[..] else {
                panic!("three shapes");
            };
            assert_eq!(*floor, Shape::Floor(-0.5));
            assert_eq!(
                *rod,
                Shape::Rod(vec![[0.0, 0.0], [x, y + t], [2.0 * x, y + t]])
            );
            let Shape::Block(corners) = block else {
                panic!("{block:?}");
            };
            // The third corner is at (1, ½) along the axes of the box.
            let third = [x + cos - 0.5 * sin, y + sin + 0.5 * cos];
            assert!((corners[2][0] - third[0]).hypot(corners[2][1] - third[1]) < 1e-14);
            let [contact, sum, wind] = &drawing.arrows[..] else {
                panic!("three arrows");
            };
            assert_eq!(
                [contact.name, sum.name, wind.name],
                ["floor + grip", "sum", "wind"]
            );
            let [normal, grip] = sample.forces[..] else {
                panic!("two rows");
            };
            assert_eq!(contact.sum(&sample.forces, false), [grip, normal]);
            assert_eq!(contact.sum(&[7.0, 5.0], true), [5.0, 7.0]);
            assert_eq!(sum.sum(&sample.forces, false), [4.0 * t, -20.0]);
            // No applied force is an impulse.
            assert_eq!(sum.sum(&[7.0, 5.0], true), [0.0, 0.0]);
            assert_eq!((wind.at, wind.sum(&[0.0; 2], false)), ([x, y], [t, 2.0]));
        }
    }

    #[test]
    fn what_is_left_out_has_no_arrow() {
        let draws = "
            draw(mass: (x, y)),
            draw(arrow: floor * (0, 1) at (x, y)),
            draw(arrow: grip * (1, 0) at (x, y)),
            draw(arrow: drive * (1, 0) at (x, y)),
            draw(arrow: wind),
        ";
        let named = |without: &[&str]| -> Vec<&str> {
            let film = film(&format!("{BLOCK}{draws}"), without);
            let arrows = &film.drawings[0].arrows;
            arrows.iter().map(|arrow| arrow.name).collect()
        };
        assert_eq!(named(&[]), ["floor", "grip", "drive", "wind"]);
        assert_eq!(named(&["grip", "wind"]), ["floor", "drive"]);
        // A friction goes with the contact that it is on.
        assert_eq!(named(&["floor"]), ["drive", "wind"]);
    }

    #[test]
    fn bodies_in_space_are_turned_as_written() {
        let film = film(
            "
            parameters(mass = 1, radius = 0.5),
            coordinates(x, a, b),
            attitude(body: q),
            kinetic = mass/2 * (der(x)^2 + der(a)^2 + der(b)^2) + dot(body.body_rate, body.body_rate),
            start(spun: der(x) = 1, der(a) = 2, der(b) = -1, der(q[1]) = 0.5, der(q[3]) = 0.2),
            draw(disc: (x, 0, 1), radius = radius, turn = ((0, 0, a), (b, 0, 0))),
            draw(sphere: (0, x, 0), radius = radius, attitude = body),
            draw(sphere: (0, 0, x), radius = radius, rolled = (a, b, 0)),
            draw(floor: -1, turn = (0.1, 0, 0)),
            until = 2,
            ",
            &[],
        );
        assert!(film.drawings.is_empty());
        let about = |axis: Vector, angle: f64| UnitQuaternion::from_scaled_axis(angle * axis);
        for (space, sample) in film.spaces.iter().zip(&film.outcome.samples) {
            let q = &sample.state.q;
            let (x, a, b) = (q[0], q[1], q[2]);
            let [disc, ball, rolled, floor] = &space.solids[..] else {
                panic!("four solids");
            };
            let Solid::Disc(radius, height, pose) = disc else {
                panic!("{disc:?}");
            };
            assert_eq!((*radius, *height), (0.5, 0.025));
            assert_eq!(pose.at, Vector::new(x, 0.0, 1.0));
            let turned = about(Vector::z(), a) * about(Vector::x(), b);
            assert!(pose.turn.angle_to(&turned) < 1e-7);
            let Solid::Ball(_, pose) = ball else {
                panic!("{ball:?}");
            };
            // The scalar part comes last in nalgebra's list.
            let attitude = pose.turn.coords;
            assert!((attitude - nalgebra::Vector4::new(q[4], q[5], q[6], q[3])).norm() < 1e-7);
            assert_eq!(
                *rolled,
                Solid::RolledBall(0.5, x * Vector::z(), Vector::new(a, b, 0.0))
            );
            assert_eq!(floor.places(), [-Vector::z()]);
        }
    }

    #[test]
    fn without_a_picture_points_are_seen() {
        let film = film(BLOCK, &[]);
        let kinds: Vec<&str> = film.drawings[0].shapes.iter().map(Shape::kind).collect();
        assert_eq!(kinds, ["floor", "trace", "mass"]);
        let names: Vec<&str> = film.drawings[0].arrows.iter().map(|a| a.name).collect();
        assert_eq!(names, ["floor", "wind"]);
        let [first, .., last] = &film.drawings[..] else {
            panic!("a film");
        };
        assert_eq!(first.shapes[2], Shape::Mass([0.0, 1.0]));
        assert_eq!(first.shapes[0], Shape::Floor(0.0));
        let end = &film.outcome.samples[film.outcome.samples.len() - 1].state.q;
        assert_eq!(last.shapes[2], Shape::Mass([end[0], end[1]]));
    }

    #[test]
    fn springs_in_space_end_at_their_ends() {
        let (from, to) = (Vector::new(1.0, 2.0, 3.0), Vector::new(1.0, 2.0, 5.0));
        let coil = super::coil(from, to);
        assert_eq!((coil[0], coil[coil.len() - 1]), (from, to));
        let wide = coil.iter().map(|joint| (joint - from).xy().norm());
        assert!((wide.fold(0.0, f64::max) - 2.0 / 24.0).abs() < 1e-14);
        assert!(super::coil(from, from).iter().all(|joint| *joint == from));
    }
}
