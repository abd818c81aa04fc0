//! What a picture shows: the forms, and what each is told.

use super::{Expr, Index, Name};

/// `draw(disc[k in 0..2]: (x, y), radius = r, angle = phi)`
#[derive(Clone, Debug)]
pub struct Draw {
    /// The word that says what it is.
    pub word: Name,
    /// What it is.
    pub form: Form,
    /// Where there is one for each index.
    pub index: Option<Index>,
    /// Places, joined by `to`; the height of a floor; the force of an arrow.
    pub places: Vec<Expr>,
    /// `at p`: where an arrow begins.
    pub at: Option<Expr>,
    /// `name = …`: what an arrow is called.
    pub name: Option<Name>,
    /// `radius = …` and the like.
    pub details: Vec<(Detail, Name, Expr)>,
}

/// A form.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Form {
    /// Everything below a height; in space a plane.
    Floor,
    /// A fixed polygon in a plane.
    Ground,
    /// A fixed round surface, seen from outside.
    Shell,
    /// A fixed round hollow, seen from inside; in space the lower half of a sphere.
    Bowl,
    /// A round body, in space a cylinder.
    Disc,
    /// A body with corners in a plane.
    Polygon,
    /// A rectangle, in space a box.
    Box,
    /// A ball in space.
    Sphere,
    /// The half of an ellipsoid below its centre, in space.
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
    /// Where a point has been.
    Path,
    /// A force.
    Arrow,
}

/// What a form may be told beside its places.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Detail {
    /// `radius = r`
    Radius,
    /// `height = h`
    Height,
    /// `size = (a, b)`
    Size,
    /// `angle = phi`
    Angle,
    /// `attitude = body`
    Attitude,
    /// `turn = [0, 0, phi]`
    Turn,
    /// `rolled = [alpha, beta, 0]`
    Rolled,
}

/// What a form is told.
#[derive(Clone, Copy)]
pub struct Rule {
    /// How many places, at least and at most.
    pub places: (usize, usize),
    /// What it must be told.
    pub needs: &'static [Detail],
    /// What it may be told in a plane; `None` if there is no such form there.
    pub plane: Option<&'static [Detail]>,
    /// What it may be told in space.
    pub space: Option<&'static [Detail]>,
}

const TURNED: &[Detail] = &[Detail::Attitude, Detail::Turn];
const MANY: usize = usize::MAX;

impl Form {
    /// All forms with their words.
    pub const ALL: [(&'static str, Form); 16] = [
        ("floor", Form::Floor),
        ("ground", Form::Ground),
        ("shell", Form::Shell),
        ("bowl", Form::Bowl),
        ("disc", Form::Disc),
        ("polygon", Form::Polygon),
        ("box", Form::Box),
        ("sphere", Form::Sphere),
        ("half_ellipsoid", Form::HalfEllipsoid),
        ("rod", Form::Rod),
        ("rope", Form::Rope),
        ("spring", Form::Spring),
        ("mass", Form::Mass),
        ("pivot", Form::Pivot),
        ("path", Form::Path),
        ("arrow", Form::Arrow),
    ];

    /// All that it may be told.
    pub fn details(self) -> Vec<Detail> {
        let rule = self.rule();
        let told = [rule.plane, rule.space].into_iter().flatten().flatten();
        let mut details: Vec<Detail> = Vec::new();
        for detail in told {
            if !details.contains(detail) {
                details.push(*detail);
            }
        }
        details
    }

    /// What it is told.
    pub fn rule(self) -> Rule {
        use Detail::*;
        let rule = |places, needs, plane, space| Rule {
            places,
            needs,
            plane,
            space,
        };
        match self {
            Form::Floor => rule((1, 1), &[], Some(&[]), Some(TURNED)),
            Form::Ground | Form::Polygon => rule((3, MANY), &[], Some(&[]), None),
            Form::Shell | Form::Bowl => rule((1, 1), &[Radius], Some(&[Radius]), Some(&[Radius])),
            Form::Disc => rule(
                (1, 1),
                &[Radius],
                Some(&[Radius, Angle]),
                Some(&[Radius, Height, Attitude, Turn]),
            ),
            Form::Box => rule(
                (1, 1),
                &[Size],
                Some(&[Size, Angle]),
                Some(&[Size, Attitude, Turn]),
            ),
            Form::Sphere => rule(
                (1, 1),
                &[Radius],
                None,
                Some(&[Radius, Attitude, Turn, Rolled]),
            ),
            Form::HalfEllipsoid => rule((1, 1), &[Size], None, Some(&[Size, Attitude, Turn])),
            Form::Rod | Form::Rope => rule((2, MANY), &[], Some(&[]), Some(&[])),
            Form::Spring => rule((2, 2), &[], Some(&[]), Some(&[])),
            Form::Mass | Form::Pivot | Form::Path => rule((1, 1), &[], Some(&[]), Some(&[])),
            Form::Arrow => rule((1, 1), &[], Some(&[]), Some(&[])),
        }
    }
}

impl Detail {
    /// All of them with their words.
    pub const ALL: [(&'static str, Detail); 7] = [
        ("radius", Detail::Radius),
        ("height", Detail::Height),
        ("size", Detail::Size),
        ("angle", Detail::Angle),
        ("attitude", Detail::Attitude),
        ("turn", Detail::Turn),
        ("rolled", Detail::Rolled),
    ];

    /// Its word.
    pub fn word(self) -> &'static str {
        let found = Detail::ALL.iter().find(|(_, detail)| *detail == self);
        found.map_or("", |(word, _)| word)
    }
}
