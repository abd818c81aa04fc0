//! What `draw(…)` declares: forms, with the values that place and size them. Nothing here knows of pages or pixels.

/// Something that a picture shows.
#[derive(Clone, Copy, Debug)]
pub struct Draw {
    /// What it is.
    pub form: Form,
    /// What an arrow is called; empty of others.
    pub name: &'static str,
    /// Its places, m, each of two components in a plane or three in space. The height of a floor is a place of one.
    pub places: &'static [&'static [usize]],
    /// Radius; radius and height of a disc in space; edges or semi-axes, m.
    pub size: &'static [usize],
    /// How it is turned.
    pub turn: Turn,
    /// Of an arrow: rows, and the force in newtons per unit of the multiplier of each.
    pub parts: &'static [(usize, &'static [usize])],
    /// Of an arrow: forces in it beside the multipliers, N.
    pub applied: &'static [usize],
    /// Of an arrow: the applied forces that are in it.
    pub loads: &'static [usize],
}

/// What something looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Everything below a height; in space a plane.
    Floor,
    /// A fixed polygon in a plane.
    Ground,
    /// A fixed round surface, seen from outside.
    Shell,
    /// A fixed round hollow, seen from inside; in space the lower half of a sphere.
    Bowl,
    /// A round body, in space a cylinder along its third axis.
    Disc,
    /// A body with corners in a plane.
    Polygon,
    /// A rectangle, in space a box, around its place.
    Box,
    /// A ball in space.
    Sphere,
    /// The half of an ellipsoid that lies below its centre, in space.
    HalfEllipsoid,
    /// Straight from joint to joint.
    Rod,
    /// As a rod, but thin.
    Rope,
    /// From end to end.
    Spring,
    /// A point mass.
    Mass,
    /// A fixed point about which something turns.
    Pivot,
    /// Where its place has been so far.
    Path,
    /// A force.
    Arrow,
}

/// How something is turned, rad.
#[derive(Clone, Copy, Debug)]
pub enum Turn {
    /// Not at all.
    None,
    /// In a plane, counter-clockwise.
    Angle(usize),
    /// As a body of `attitude`, whose four coordinates begin with this one.
    Attitude(usize),
    /// By rotation vectors of three components, one after another, each along the axes that the body has by then.
    About(&'static [usize]),
    /// By the integrals of its angular velocity about the axes of space: how it is turned depends on the way that they went.
    Rolled(&'static [usize]),
}
