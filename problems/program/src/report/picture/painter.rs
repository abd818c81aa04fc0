//! A stage at an instant → what is seen of it from one side, from the back to the front: polygons, circles and lines of an
//! SVG file.
//!
//! Solids are convex and do not go through each other. Of two of them the farther one is found by a plane between them, which is
//! a face of either (Newell, Newell & Sancha 1972); where there is none, the distance of their middles decides.

use super::palette::shaded;
use super::stage::{Body, Thrust};
use super::view::View;
use super::{Column, Place, Stage, Stroke, hundredths, nice};
use crate::space::{UnitQuaternion, Vector};
use core::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;

/// Where the light comes from.
const SUN: [f64; 3] = [-0.45, -0.5, 1.0];
/// Corners of a circle.
const ROUND: usize = 28;

/// What draws a stage.
pub(crate) struct Painter {
    stage: Stage,
    pub view: View,
    /// The strokes of every path, below the solids.
    pub traces: Vec<Vec<Stroke>>,
    size: f64,
    /// Radius of rods, m.
    thin: f64,
}

/// A convex solid at an instant.
struct Piece {
    /// Corners of a body around it.
    corners: Vec<Vector>,
    /// Its flat faces: a point and the direction outward.
    faces: Vec<(Vector, Vector)>,
    /// What is seen.
    text: String,
}

impl Painter {
    pub fn new(stage: Stage) -> Self {
        let view = View::of(&stage);
        let edges = stage.high.iter().zip(&stage.low);
        let size = edges.fold(1e-9, |size, (high, low)| f64::max(size, high - low));
        let rods = stage.bodies.iter().filter(|body| body.kind == "rod");
        let rods = rods.count();
        let seen = |&[time, x, y, z]: &[f64; 4]| {
            let [x, y] = view.place(Vector::new(x, y, z)).map(hundredths);
            [time, x, y]
        };
        let strokes = |body: &Body| {
            let strokes = body.strokes.iter();
            strokes
                .map(|stroke| stroke.iter().map(seen).collect())
                .collect()
        };
        Self {
            traces: stage
                .bodies
                .iter()
                .filter(|body| body.kind == "trace")
                .map(strokes)
                .collect(),
            size,
            // Many rods are thin.
            thin: if rods > 8 { 0.003 } else { 0.006 } * size,
            view,
            stage,
        }
    }

    /// What lengths mean.
    pub fn ruler(&self) -> String {
        match self.ground() {
            Some(_) => format!("Grid {} m", super::short(self.cell())),
            None => String::new(),
        }
    }

    fn cell(&self) -> f64 {
        nice(self.size / 8.0)
    }

    /// The ground's point below the middle, and its axes.
    fn ground(&self) -> Option<(Vector, [Vector; 3])> {
        let body = self
            .stage
            .bodies
            .iter()
            .find(|body| body.kind == "ground")?;
        let start = Place {
            sample: 0,
            part: 0.0,
        };
        if !is_somewhere(body, start) {
            return None;
        }
        let turn = turn(body, start);
        let [x, y, z] = [Vector::x(), Vector::y(), Vector::z()].map(|axis| turn * axis);
        let origin = joints(body, start)[0];
        let apart = 0.5 * (Vector::from(self.stage.low) + Vector::from(self.stage.high)) - origin;
        // A node of the grid.
        let node = |axis: &Vector| (apart.dot(axis) / self.cell()).round() * self.cell() * axis;
        Some((origin + node(&x) + node(&y), [x, y, z]))
    }

    /// The grid of the ground, which does not move.
    pub fn grid(&self, out: &mut String) {
        let Some((at, [x, y, _])) = self.ground() else {
            return;
        };
        let (cell, count) = (self.cell(), 8);
        for (along, across) in [(x, y), (y, x)] {
            for k in -count..=count {
                // Lines end on a circle.
                let far = cell * f64::from(count * count - k * k).sqrt();
                let from = at + across * (f64::from(k) * cell);
                let ends = [from - along * far, from + along * far].map(|end| self.view.place(end));
                let _ = writeln!(
                    out,
                    "<polyline class=\"grid\" points=\"{}\"/>",
                    points(&ends)
                );
            }
        }
    }

    /// What lies below the paths: shadows, and solids that stay in their places.
    pub fn below(&self, place: Place, out: &mut String) {
        self.shadows(&self.pieces(place, |_| true), out);
        self.solids(&self.pieces(place, |body| !moves(body)), out);
    }

    /// What is in front of the paths: solids that move, and walls around them.
    pub fn above(&self, place: Place, out: &mut String) {
        let bowls = self.stage.bodies.iter().filter(|body| body.kind == "bowl");
        let bowls = bowls.filter(|bowl| is_somewhere(bowl, place));
        let walls = bowls.map(|bowl| self.wall(joints(bowl, place)[0], bowl.size[0]));
        let mut pieces = self.pieces(place, moves);
        pieces.extend(walls);
        self.solids(&pieces, out);
    }

    fn pieces(&self, place: Place, which: impl Fn(&Body) -> bool) -> Vec<Piece> {
        let solid = |body: &&Body| {
            !["ground", "trace"].contains(&body.kind) && which(body) && is_somewhere(body, place)
        };
        let bodies = self.stage.bodies.iter().filter(solid);
        bodies.map(|body| self.piece(body, place)).collect()
    }

    fn solids(&self, pieces: &[Piece], out: &mut String) {
        for index in self.order(pieces) {
            out.push_str(&pieces[index].text);
        }
    }

    /// Each arrow: its name, whether it is an impulse, from where to where it is seen.
    pub fn arrows(&self, place: Place) -> Vec<(String, bool, [f64; 4])> {
        let arrow = |thrust: &Thrust| {
            let n: Vec<f64> = thrust
                .numbers
                .iter()
                .map(|column| column.at(place))
                .collect();
            let at = Vector::new(n[0], n[1], n[2]);
            let ends = [at, at + Vector::new(n[3], n[4], n[5])].map(|end| self.view.place(end));
            (
                thrust.name.clone(),
                thrust.impulse,
                [ends[0][0], ends[0][1], ends[1][0], ends[1][1]],
            )
        };
        self.stage.arrows.iter().map(arrow).collect()
    }

    /// Shadows on the ground, all of one darkness.
    fn shadows(&self, pieces: &[Piece], out: &mut String) {
        let Some((at, [.., up])) = self.ground() else {
            return;
        };
        let sun = Vector::from(SUN);
        let fallen = |corner: &Vector| {
            self.view
                .place(corner - sun * ((corner - at).dot(&up) / sun.dot(&up)))
        };
        let wide = 2.0 * self.thin * self.view.scale_at(at);
        let (mut path, mut lines) = (String::new(), String::new());
        for piece in pieces {
            let fallen: Vec<[f64; 2]> = piece.corners.iter().map(fallen).collect();
            let _ = match piece.text.starts_with("<polyline") {
                true => write!(lines, "M{}", points(&fallen)),
                false => write!(path, "M{}Z", points(&hull(fallen))),
            };
        }
        let _ = writeln!(
            out,
            "<g class=\"shadow\"><path d=\"{path}\"/><path class=\"line\" d=\"{lines}\" stroke-width=\"{wide:.1}\"/></g>"
        );
    }

    /// Indices from the back to the front.
    fn order(&self, pieces: &[Piece]) -> Vec<usize> {
        let mut left: Vec<usize> = (0..pieces.len()).collect();
        left.sort_by(|a, b| self.away(&pieces[*b]).total_cmp(&self.away(&pieces[*a])));
        let mut order = Vec::new();
        while !left.is_empty() {
            // One that hides no other; of a ring that hide each other, the farthest.
            let free = |i: &&usize| {
                left.iter()
                    .all(|j| *i == j || !self.hides(&pieces[**i], &pieces[*j]))
            };
            let next = left.iter().find(free).copied().unwrap_or(left[0]);
            left.retain(|i| *i != next);
            order.push(next);
        }
        order
    }

    /// Distance of a piece's middle from the eye.
    fn away(&self, piece: &Piece) -> f64 {
        let sum: Vector = piece.corners.iter().sum();
        (sum / piece.corners.len() as f64 - self.view.eye).norm()
    }

    /// Whether a piece is on the eye's side of a face, and another one on the other side: then it can hide that one.
    fn hides(&self, piece: &Piece, other: &Piece) -> bool {
        let parts = |of: &Piece, beyond: &Piece, facing: bool| {
            of.faces.iter().any(|(at, out)| {
                let outside = |corner: &Vector| (corner - at).dot(out) >= -1e-6 * self.size;
                ((self.view.eye - at).dot(out) > 0.0) == facing
                    && beyond.corners.iter().all(outside)
            })
        };
        parts(other, piece, true) || parts(piece, other, false)
    }

    fn piece(&self, body: &Body, place: Place) -> Piece {
        let joints = joints(body, place);
        match body.kind {
            "rod" => self.rod(joints),
            "mass" => self.ball(joints[0], 4.0 * self.thin, "c0"),
            "pivot" => self.pivot(joints[0]),
            "shell" => self.ball(joints[0], body.size[0], "body"),
            "bowl" => self.hollow(joints[0], body.size[0]),
            "ball" | "rolled ball" => self.striped(joints[0], body.size[0], turn(body, place)),
            _ => self.faced(body, joints[0], turn(body, place)),
        }
    }

    fn rod(&self, joints: Vec<Vector>) -> Piece {
        let seen: Vec<[f64; 2]> = joints.iter().map(|joint| self.view.place(*joint)).collect();
        let wide = 2.0 * self.thin * self.view.scale_at(joints[0]);
        Piece {
            text: format!(
                "<polyline class=\"beam\" points=\"{}\" stroke-width=\"{wide:.1}\"/>\n",
                points(&seen)
            ),
            corners: joints,
            faces: Vec::new(),
        }
    }

    /// A ball of one colour, with a light on it.
    fn ball(&self, at: Vector, radius: f64, paint: &str) -> Piece {
        let ([x, y], seen) = (self.view.place(at), radius * self.view.scale_at(at));
        let disc = |fill: &str| {
            format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{seen:.1}\" fill=\"{fill}\"/>\n")
        };
        // Its shadow is that of a circle across the light.
        let turn =
            UnitQuaternion::rotation_between(&Vector::z(), &Vector::from(SUN)).unwrap_or_default();
        let rim = circle().map(|[c, s]| at + radius * (turn * Vector::new(c, s, 0.0)));
        Piece {
            corners: rim.collect(),
            faces: Vec::new(),
            text: disc(&shaded(paint, 1.0)) + &disc("url(#round)"),
        }
    }

    /// A cone under a plate, from whose tip something hangs.
    fn pivot(&self, tip: Vector) -> Piece {
        let top = tip + 5.0 * self.thin * Vector::z();
        let seen = |corners: &[Vector]| corners.iter().map(|c| self.view.place(*c)).collect();
        let mut cone: Vec<Vector> = rim([3.0 * self.thin; 2], 0.0)
            .iter()
            .map(|c| top + c)
            .collect();
        cone.push(tip);
        let mut text = String::new();
        polygon(&hull(seen(&cone)), &shaded("quiet", 0.9), &mut text);
        let plate = 9.0 * self.thin;
        for (out, face) in box_faces([plate, plate, 1.5 * self.thin]) {
            let face: Vec<Vector> = face.iter().map(|c| top + c).collect();
            if out.dot(&(self.view.eye - face[0])) > 0.0 {
                polygon(&seen(&face), &shaded("quiet", bright(&out)), &mut text);
            }
            cone.extend(face);
        }
        Piece {
            corners: cone,
            faces: Vec::new(),
            text,
        }
    }

    /// What is seen of a bowl through its rim: nothing in it is behind that.
    fn hollow(&self, at: Vector, radius: f64) -> Piece {
        let rim: Vec<Vector> = rim([radius; 2], 0.0)
            .iter()
            .map(|corner| at + corner)
            .collect();
        let mut text = String::new();
        if self.view.eye.z > at.z {
            let seen: Vec<[f64; 2]> = rim.iter().map(|corner| self.view.place(*corner)).collect();
            polygon(&seen, &shaded("body", 0.9), &mut text);
        }
        let mut corners = half_sphere([radius; 3]);
        corners.iter_mut().for_each(|corner| *corner += at);
        Piece {
            corners,
            faces: Vec::new(),
            text,
        }
    }

    /// The wall of a bowl towards the eye, which hides what is in it.
    fn wall(&self, at: Vector, radius: f64) -> Piece {
        let corners: Vec<Vector> = half_sphere([radius; 3])
            .iter()
            .map(|corner| at + corner)
            .collect();
        let seen = |corner: &Vector| self.view.place(*corner);
        let mut path = format!("M{}Z", points(&hull(corners.iter().map(seen).collect())));
        if self.view.eye.z > at.z {
            let rim: Vec<[f64; 2]> = corners[..ROUND].iter().map(seen).collect();
            let _ = write!(path, "M{}Z", points(&rim));
        }
        let near = |corner: &Vector| (corner - at).dot(&(self.view.eye - at)) > 0.0;
        Piece {
            text: format!(
                "<path class=\"face\" fill-rule=\"evenodd\" d=\"{path}\" fill=\"{}\"/>\n",
                shaded("edge", 1.0)
            ),
            corners: corners.into_iter().filter(near).collect(),
            faces: Vec::new(),
        }
    }

    /// A ball with stripes.
    fn striped(&self, at: Vector, radius: f64, turn: UnitQuaternion<f64>) -> Piece {
        const ROWS: usize = 8;
        const COLUMNS: usize = 16;
        let point = |column: usize, row: usize| {
            let (turned, tilt) = (
                2.0 * PI * column as f64 / COLUMNS as f64,
                PI * row as f64 / ROWS as f64 - FRAC_PI_2,
            );
            turn * Vector::new(
                turned.cos() * tilt.cos(),
                turned.sin() * tilt.cos(),
                tilt.sin(),
            )
        };
        let mut stripes = String::new();
        for row in (0..ROWS).filter(|row| [0, 3, 4, ROWS - 1].contains(row)) {
            for column in 0..COLUMNS {
                let cell =
                    [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| point(column + i, row + j));
                let corners = cell.map(|corner| at + radius * corner);
                let seen = |corner: &Vector| corner.dot(&(self.view.eye - at)) > radius;
                if cell.iter().all(seen) {
                    let _ = write!(
                        stripes,
                        "M{}Z",
                        points(&corners.map(|corner| self.view.place(corner)))
                    );
                }
            }
        }
        let plain = self.ball(at, radius, "body");
        let stripes = format!("<path d=\"{stripes}\" fill=\"{}\"/>\n", shaded("c0", 1.0));
        let (base, light) = plain.text.split_once('\n').unwrap_or_default();
        Piece {
            text: format!("{base}\n{stripes}{light}"),
            ..plain
        }
    }

    /// A body with flat faces and perhaps a curved side.
    fn faced(&self, body: &Body, at: Vector, turn: UnitQuaternion<f64>) -> Piece {
        let place = |corner: &Vector| at + turn * corner;
        let (rounded, faces) = match (body.kind, body.size.as_slice()) {
            ("box", [x, y, z]) => (None, box_faces([*x, *y, *z])),
            ("disc", [radius, height]) => (Some("body"), disc_faces(*radius, *height)),
            (_, [a, b, _]) => (Some("c0"), vec![(Vector::z(), rim([*a, *b], 0.0))]),
            _ => (None, Vec::new()),
        };
        let mut corners: Vec<Vector> = faces
            .iter()
            .flat_map(|(_, corners)| corners)
            .map(place)
            .collect();
        if let ("half ellipsoid", [a, b, c]) = (body.kind, body.size.as_slice()) {
            corners.extend(half_sphere([*a, *b, *c])[ROUND..].iter().map(place));
        }
        let mut text = String::new();
        if let Some(paint) = rounded {
            let outline = hull(
                corners
                    .iter()
                    .map(|corner| self.view.place(*corner))
                    .collect(),
            );
            polygon(&outline, &shaded(paint, 0.8), &mut text);
        }
        for (out, face) in &faces {
            let (out, face) = (turn * out, face.iter().map(place).collect::<Vec<_>>());
            if out.dot(&(self.view.eye - face[0])) <= 0.0 {
                continue;
            }
            let bright = bright(&out);
            let seen: Vec<[f64; 2]> = face.iter().map(|corner| self.view.place(*corner)).collect();
            polygon(&seen, &shaded("body", bright), &mut text);
            if body.kind == "disc" {
                // A sector from the centre shows how far it has turned.
                let sector: Vec<[f64; 2]> = [self
                    .view
                    .place(face.iter().sum::<Vector>() / face.len() as f64)]
                .into_iter()
                .chain(seen[..=2].iter().copied())
                .collect();
                polygon(&sector, &shaded("c0", bright), &mut text);
            }
        }
        let faces = faces
            .iter()
            .map(|(out, face)| (place(&face[0]), turn * out));
        Piece {
            faces: faces.collect(),
            corners,
            text,
        }
    }
}

/// Whether a body is ever elsewhere.
fn moves(body: &Body) -> bool {
    body.places
        .iter()
        .any(|column| matches!(column, Column::Varying(_)))
}

/// Whether a body has a place, a size and an attitude.
fn is_somewhere(body: &Body, place: Place) -> bool {
    let columns = body.places.iter().chain(&body.turn);
    let numbers = columns.map(|column| column.at(place));
    let mut numbers = numbers.chain(body.size.iter().copied());
    numbers.all(f64::is_finite)
}

/// Where a body's origin or joints are.
fn joints(body: &Body, place: Place) -> Vec<Vector> {
    let numbers: Vec<f64> = body.places.iter().map(|column| column.at(place)).collect();
    numbers
        .chunks_exact(3)
        .map(Vector::from_column_slice)
        .collect()
}

fn turn(body: &Body, place: Place) -> UnitQuaternion<f64> {
    let q: Vec<f64> = body.turn.iter().map(|column| column.at(place)).collect();
    match q.as_slice() {
        [w, x, y, z] => UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(*w, *x, *y, *z)),
        _ => UnitQuaternion::identity(),
    }
}

/// Directions all round.
fn circle() -> impl Iterator<Item = [f64; 2]> {
    (0..ROUND).map(|k| {
        let (sin, cos) = (2.0 * PI * k as f64 / ROUND as f64).sin_cos();
        [cos, sin]
    })
}

/// An ellipse at a height.
fn rim([a, b]: [f64; 2], height: f64) -> Vec<Vector> {
    circle()
        .map(|[cos, sin]| Vector::new(a * cos, b * sin, height))
        .collect()
}

/// How bright a face is by its direction.
fn bright(out: &Vector) -> f64 {
    0.62 + 0.12 * out.z + 0.36 * out.dot(&Vector::from(SUN).normalize()).max(0.0)
}

/// The half of an ellipsoid below its centre: its rim first, the pole last.
fn half_sphere([a, b, c]: [f64; 3]) -> Vec<Vector> {
    let mut corners = Vec::new();
    for k in 0..6 {
        let (low, wide) = (f64::from(k) / 6.0 * FRAC_PI_2).sin_cos();
        corners.extend(rim([a * wide, b * wide], -c * low));
    }
    corners.push(Vector::new(0.0, 0.0, -c));
    corners
}

/// Directions outward, and corners.
fn box_faces(edges: [f64; 3]) -> Vec<(Vector, Vec<Vector>)> {
    let half = edges.map(|edge| edge / 2.0);
    let face = |(axis, side): (usize, f64)| {
        let mut out = Vector::zeros();
        out[axis] = side;
        let corner = |(u, v): (f64, f64)| {
            let mut corner = Vector::zeros();
            corner[axis] = side * half[axis];
            corner[(axis + 1) % 3] = u * half[(axis + 1) % 3];
            corner[(axis + 2) % 3] = v * half[(axis + 2) % 3];
            corner
        };
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner);
        (out, corners.into())
    };
    (0..3)
        .flat_map(|axis| [(axis, -1.0), (axis, 1.0)])
        .map(face)
        .collect()
}

fn disc_faces(radius: f64, height: f64) -> Vec<(Vector, Vec<Vector>)> {
    let face = |side: f64| (side * Vector::z(), rim([radius; 2], side * height / 2.0));
    vec![face(1.0), face(-1.0)]
}

fn polygon(corners: &[[f64; 2]], fill: &str, out: &mut String) {
    let _ = writeln!(
        out,
        "<polygon class=\"face\" points=\"{}\" fill=\"{fill}\"/>",
        points(corners)
    );
}

/// `x,y x,y …`
fn points(places: &[[f64; 2]]) -> String {
    let places: Vec<String> = places
        .iter()
        .map(|[x, y]| format!("{x:.1},{y:.1}"))
        .collect();
    places.join(" ")
}

/// The corners of the smallest convex polygon around points (Andrew 1979).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let side = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && side(a, b, point) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut around = chain(&mut points.iter().copied());
    around.extend(chain(&mut points.iter().rev().copied()));
    around
}
