//! How a scene is drawn, as plain data: shapes in metres, and where each force acts.
//!
//! A scene says it beside its declaration, for one instant: `fn drawing(&self, t, q) -> Drawing`. It gives the same shapes in
//! the same order at every instant, only their numbers differ. Nothing here knows of pages or pixels.

/// x to the right and y upward, m.
pub type Point = [f64; 2];

/// A scene at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// From the back to the front.
    pub shapes: Vec<Shape>,
    /// Forces of the declaration's items.
    pub arrows: Vec<Arrow>,
}

/// Something with a place.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Ground that does not move: everything below a height.
    Floor(f64),
    /// A fixed polygon: ramps, walls, tables.
    Fixed(Vec<Point>),
    /// A fixed round body, seen from outside.
    Shell(Point, f64),
    /// A fixed round hollow, seen from inside.
    Bowl(Point, f64),
    /// A round body with a mark that shows how far it has turned, clockwise.
    Disc(Point, f64, f64),
    /// A body with corners.
    Block(Vec<Point>),
    /// A rod, a string or a chain, from joint to joint.
    Rod(Vec<Point>),
    /// A spring between two points.
    Spring(Point, Point),
    /// A point mass.
    Mass(Point),
    /// A fixed point about which something turns.
    Pivot(Point),
    /// Where the body before it has been: its path is drawn through this point.
    Trace(Point),
}

/// The force of an item, drawn as an arrow.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// Name of the constraint, contact or friction.
    pub force: &'static str,
    /// Where it acts.
    pub at: Point,
    /// Force in newtons per unit of the item's multiplier: where a positive one points to.
    pub along: Point,
}

impl Drawing {
    /// Of these shapes.
    pub fn of(shapes: impl IntoIterator<Item = Shape>) -> Self {
        Self {
            shapes: shapes.into_iter().collect(),
            arrows: Vec::new(),
        }
    }

    /// Links of one length hung from the origin, at angles from the downward vertical; with the path of the end.
    pub fn chain(length: f64, angles: &[f64]) -> Self {
        let mut joints = vec![[0.0; 2]];
        for angle in angles {
            let last = joints[joints.len() - 1];
            joints.push(from_bottom(last, length, *angle));
        }
        let masses = joints[1..].iter().copied().map(Shape::Mass);
        let trace = Shape::Trace(joints[joints.len() - 1]);
        let links = Shape::Rod(joints.clone());
        let hung = [trace, links, Shape::Pivot([0.0; 2])];
        Self::of(hung.into_iter().chain(masses))
    }

    /// The same with an arrow for the force of an item.
    #[must_use]
    pub fn force(mut self, force: &'static str, at: Point, along: Point) -> Self {
        self.arrows.push(Arrow { force, at, along });
        self
    }
}

impl Shape {
    /// A wedge that ends in a point.
    pub fn support(tip: Point, height: f64) -> Self {
        let (half, low) = (0.4 * height, tip[1] - height);
        Shape::Fixed(vec![tip, [tip[0] + half, low], [tip[0] - half, low]])
    }

    /// One word.
    pub fn kind(&self) -> &'static str {
        match self {
            Shape::Floor(_) => "floor",
            Shape::Fixed(_) => "fixed",
            Shape::Shell(..) => "shell",
            Shape::Bowl(..) => "bowl",
            Shape::Disc(..) => "disc",
            Shape::Block(_) => "block",
            Shape::Rod(_) => "rod",
            Shape::Spring(..) => "spring",
            Shape::Mass(_) => "mass",
            Shape::Pivot(_) => "pivot",
            Shape::Trace(_) => "trace",
        }
    }

    /// Its numbers in the order of the declaration: x before y, centre, radius, angle.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Shape::Floor(height) => vec![*height],
            Shape::Shell([x, y], radius) | Shape::Bowl([x, y], radius) => vec![*x, *y, *radius],
            Shape::Disc([x, y], radius, angle) => vec![*x, *y, *radius, *angle],
            Shape::Fixed(points) | Shape::Block(points) | Shape::Rod(points) => points.concat(),
            Shape::Spring(from, to) => [*from, *to].concat(),
            Shape::Mass(at) | Shape::Pivot(at) | Shape::Trace(at) => at.to_vec(),
        }
    }

    /// Corners of a box around it: lowest and highest x, lowest and highest y. A floor has no width.
    pub fn extent(&self) -> [f64; 4] {
        let round = |[x, y]: Point, r: f64| [x - r, x + r, y - r, y + r];
        match self {
            Shape::Floor(height) => [f64::INFINITY, f64::NEG_INFINITY, *height, *height],
            Shape::Shell(at, r) | Shape::Bowl(at, r) | Shape::Disc(at, r, _) => round(*at, *r),
            Shape::Fixed(points) | Shape::Block(points) | Shape::Rod(points) => around(points),
            Shape::Spring(from, to) => around(&[*from, *to]),
            Shape::Mass(at) | Shape::Pivot(at) | Shape::Trace(at) => around(&[*at]),
        }
    }
}

/// A box around points.
fn around(points: &[Point]) -> [f64; 4] {
    let nothing = [
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::INFINITY,
        f64::NEG_INFINITY,
    ];
    points
        .iter()
        .fold(nothing, |b, &[x, y]| union(b, [x, x, y, y]))
}

/// A box around two.
pub fn union(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [
        a[0].min(b[0]),
        a[1].max(b[1]),
        a[2].min(b[2]),
        a[3].max(b[3]),
    ]
}

/// The point at a distance from `centre`, at an angle from the **upward** vertical, clockwise.
pub fn from_top(centre: Point, distance: f64, angle: f64) -> Point {
    [
        centre[0] + distance * angle.sin(),
        centre[1] + distance * angle.cos(),
    ]
}

/// The point at a distance from `centre`, at an angle from the **downward** vertical, counter-clockwise.
pub fn from_bottom(centre: Point, distance: f64, angle: f64) -> Point {
    [
        centre[0] + distance * angle.sin(),
        centre[1] - distance * angle.cos(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_hold_what_is_drawn() {
        assert_eq!(
            Shape::Disc([1.0, 2.0], 0.5, 3.0).extent(),
            [0.5, 1.5, 1.5, 2.5]
        );
        let rod = Shape::Rod(vec![[0.0, 0.0], [-1.0, 4.0]]);
        assert_eq!(rod.extent(), [-1.0, 0.0, 0.0, 4.0]);
        assert_eq!(rod.numbers(), [0.0, 0.0, -1.0, 4.0]);
        let ground = union(Shape::Floor(-1.0).extent(), rod.extent());
        assert_eq!(ground, [-1.0, 0.0, -1.0, 4.0]);
        assert_eq!(from_top([1.0, 0.0], 2.0, 0.0), [1.0, 2.0]);
        assert_eq!(from_bottom([1.0, 0.0], 2.0, 0.0), [1.0, -2.0]);
    }
}
