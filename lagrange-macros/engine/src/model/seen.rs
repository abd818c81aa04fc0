//! What a picture shows where a declaration draws nothing: what its names and forces say of places.
//!
//! A vector of `observe` that is a length is a point, and names that differ in one letter, `x` and `y`, `bob_x` and `bob_y`, `x1` and `y1`, are
//! the coordinates of one. Where one of them is `z`, or the vector has three, the picture is in space. A contact whose gap is the height of a point over a level gives a floor.

use super::depth::Depth;
use super::draws::{Draw, MOST_PLACES, placed_force};
use super::elaboration::Elaboration;
use super::meaning::{Kind, Meaning};
use crate::ast::Form;
use crate::symbolic::ExprId;

/// Paths of more points would hide each other.
const PATHS: usize = 8;

impl Elaboration<'_> {
    /// Draws what can be seen of a declaration.
    pub fn seen(&mut self) {
        let space = self.points(3);
        let points = match space.is_empty() {
            true => self.points(2),
            false => space,
        };
        let Some(first) = points.first().filter(|_| points.len() <= MOST_PLACES) else {
            return;
        };
        let components = first.len();
        let floors = self.floors(&points);
        let mut draws: Vec<Draw> = floors.iter().map(|floor| floor.level()).collect();
        if points.len() <= PATHS {
            draws.extend(points.iter().map(|point| Draw::at(Form::Path, point)));
        }
        draws.extend(points.iter().map(|point| Draw::at(Form::Mass, point)));
        let pool = &mut self.system.pool;
        let (zero, one) = (pool.integer(0), pool.integer(1));
        for floor in floors {
            let mut upward = vec![zero; components];
            upward[components - 1] = one;
            let contact = &self.system.contacts[floor.contact];
            draws.push(Draw {
                name: contact.name.text.clone(),
                parts: vec![(self.system.constraints.len() + floor.contact, upward)],
                applied: vec![zero; components],
                ..Draw::at(Form::Arrow, &points[floor.point])
            });
        }
        for (load, force) in self.system.forces.iter().enumerate() {
            let placed = placed_force(&self.system, load);
            if let Some((applied, place)) = placed.filter(|(_, place)| place.len() == components) {
                draws.push(Draw {
                    name: force.name.text.clone(),
                    applied,
                    loads: vec![load],
                    ..Draw::at(Form::Arrow, &place)
                });
            }
        }
        self.system.draws = draws;
    }

    /// Points of two or three coordinates.
    fn points(&self, components: usize) -> Vec<Vec<ExprId>> {
        let mut points = self.observed(components);
        for name in self.names.keys() {
            for (at, _) in name.match_indices('x') {
                let letters = ["x", "y", "z"].iter().take(components);
                let lists: Option<Vec<Vec<ExprId>>> = letters
                    .map(|letter| {
                        let mut other = name.clone();
                        other.replace_range(at..=at, letter);
                        self.placing(&other)
                    })
                    .collect();
                let Some(lists) = lists else {
                    continue;
                };
                let count = lists.iter().map(Vec::len).min().unwrap_or(0);
                points.extend((0..count).map(|k| lists.iter().map(|list| list[k]).collect()));
            }
        }
        points
    }

    /// Vectors of `observe` with so many components that are places.
    fn observed(&self, components: usize) -> Vec<Vec<ExprId>> {
        let observes = &self.system.observes;
        let named = |name: &str| observes.iter().position(|o| o.name.text == name);
        let is_length = |&i: &usize| match self.system.units.observes.get(i) {
            Some(unit) => unit == "m",
            None => true,
        };
        let first = observes.iter();
        let vectors = first.filter_map(|o| o.name.text.strip_suffix("[0]"));
        let places = vectors.filter_map(|vector| {
            let element = |k: usize| named(&format!("{vector}[{k}]"));
            let elements: Option<Vec<usize>> = (0..components).map(element).collect();
            let elements = elements.filter(|_| element(components).is_none())?;
            let values: Vec<ExprId> = elements.iter().map(|&i| observes[i].value).collect();
            let places = self.depth(&values) == Depth::Position;
            (places && elements.iter().all(is_length)).then_some(values)
        });
        places.collect()
    }

    /// The values of a name that depends on positions.
    fn placing(&self, name: &str) -> Option<Vec<ExprId>> {
        let entry = self.names.get(name)?;
        let places = matches!(
            entry.kind,
            Kind::Coordinate | Kind::Definition | Kind::Output
        );
        match &entry.meaning {
            Meaning::Value { value, depth, .. } if places && *depth == Depth::Position => {
                Some(value.scalars())
            }
            _ => None,
        }
    }

    /// Contacts of points with levels.
    fn floors(&mut self, points: &[Vec<ExprId>]) -> Vec<Floor> {
        let gaps: Vec<ExprId> = self.system.contacts.iter().map(|c| c.gap).collect();
        let mut floors = Vec::new();
        for (contact, gap) in gaps.into_iter().enumerate() {
            for (point, place) in points.iter().enumerate() {
                let Some(&height) = place.last() else {
                    continue;
                };
                let level = self.system.pool.sub(height, gap);
                if self.depth(&[level]) == Depth::Parameter {
                    floors.push(Floor {
                        contact,
                        point,
                        level,
                    });
                }
            }
        }
        floors
    }
}

/// A contact that is a level under a point.
struct Floor {
    contact: usize,
    point: usize,
    level: ExprId,
}

impl Floor {
    fn level(&self) -> Draw {
        Draw::at(Form::Floor, &[self.level])
    }
}
