//! A picture in a plane, as plain data: shapes in metres, and where each force acts.
//!
//! A run has the same shapes in the same order at every instant, only their numbers differ. Nothing here knows of pages or pixels.

/// x to the right and y upward, m.
pub type Point = [f64; 2];

/// A scene at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// From the back to the front.
    pub shapes: Vec<Shape>,
    /// Forces.
    pub arrows: Vec<Arrow<2>>,
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
    /// A round body with a mark that shows how far it has turned, counter-clockwise.
    Disc(Point, f64, f64),
    /// A body with corners.
    Block(Vec<Point>),
    /// A rod or a chain, from joint to joint.
    Rod(Vec<Point>),
    /// A string, from joint to joint.
    Rope(Vec<Point>),
    /// A spring between two points.
    Spring(Point, Point),
    /// A point mass.
    Mass(Point),
    /// A fixed point about which something turns.
    Pivot(Point),
    /// Where the body before it has been: its path is drawn through this point.
    Trace(Point),
}

/// A force, drawn as an arrow.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow<const D: usize> {
    /// What it is called.
    pub name: &'static str,
    /// Where it acts, m.
    pub at: [f64; D],
    /// Rows, and the force in newtons per unit of the multiplier of each.
    pub parts: Vec<(usize, [f64; D])>,
    /// What is applied beside them, N.
    pub applied: [f64; D],
}

impl<const D: usize> Arrow<D> {
    /// The force where these act along the rows, N; of impulses, N s, in which applied forces have no part.
    pub fn sum(&self, acting: &[f64], impulse: bool) -> [f64; D] {
        let mut sum = if impulse { [0.0; D] } else { self.applied };
        for (row, along) in &self.parts {
            for (sum, along) in sum.iter_mut().zip(along) {
                *sum += along * acting[*row];
            }
        }
        sum
    }
}

impl Shape {
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
            Shape::Rope(_) => "rope",
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
            Shape::Fixed(points)
            | Shape::Block(points)
            | Shape::Rod(points)
            | Shape::Rope(points) => points.concat(),
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
            Shape::Fixed(points)
            | Shape::Block(points)
            | Shape::Rod(points)
            | Shape::Rope(points) => around(points),
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
    }
}
