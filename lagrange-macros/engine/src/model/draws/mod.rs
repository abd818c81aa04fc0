//! What a picture shows: forms at places, as expressions of the declaration.

mod arrow;
mod details;

use super::depth::{Context, Reach};
use super::elaboration::Elaboration;
use super::value::Value;
use crate::ast::{self, Declaration, Form, ItemKind};
use crate::diagnostics::{Code, Extent};
use crate::symbolic::ExprId;

pub(super) use arrow::placed_force;

const BY_HEIGHT: &str = "a floor is drawn by its height, `draw(floor: 0)`; from place to place there is `draw(ground: (0, 0) to (l, 0))`";
const PLACE: Context = Context::new(Reach::Positions, "a picture");

/// Places that a picture may have: nobody sees more.
pub(super) const MOST_PLACES: usize = 2_000;

/// Something that a picture shows.
pub struct Draw {
    /// What it is.
    pub form: Form,
    /// What an arrow is called; empty of others.
    pub name: String,
    /// Its places, each of two components in a plane or three in space; the height of a floor is a place of one.
    pub places: Vec<Vec<ExprId>>,
    /// Radius; radius and height of a disc in space; edges or semi-axes.
    pub size: Vec<ExprId>,
    /// How it is turned.
    pub turn: Turn,
    /// Of an arrow: rows, and the force in newtons per unit of the multiplier of each.
    pub parts: Vec<(usize, Vec<ExprId>)>,
    /// Of an arrow: what is in it beside the multipliers, N.
    pub applied: Vec<ExprId>,
    /// Of an arrow: the force items that are in it.
    pub loads: Vec<usize>,
}

/// How something is turned.
pub enum Turn {
    /// Not at all.
    None,
    /// In a plane, counter-clockwise.
    Angle(ExprId),
    /// As the body whose four coordinates begin here.
    Attitude(usize),
    /// By rotation vectors of three components, one after another, each along the axes that the body has by then.
    About(Vec<ExprId>),
    /// By the integrals of its angular velocity about the axes of space.
    Rolled(Vec<ExprId>),
}

impl Draw {
    /// A form at a place.
    pub(super) fn at(form: Form, place: &[ExprId]) -> Draw {
        Draw {
            places: vec![place.to_vec()],
            ..Draw::of(form)
        }
    }

    /// A form without places.
    fn of(form: Form) -> Draw {
        Draw {
            form,
            name: String::new(),
            places: Vec::new(),
            size: Vec::new(),
            turn: Turn::None,
            parts: Vec::new(),
            applied: Vec::new(),
            loads: Vec::new(),
        }
    }
}

impl Elaboration<'_> {
    /// Looks for mistakes in what is drawn. That is done in a copy of all expressions: what is drawn must not change how the
    /// equations come out.
    pub fn check_draws(&mut self, declaration: &Declaration) {
        if drawn(declaration).next().is_none() {
            return;
        }
        let (pool, branches) = (self.system.pool.clone(), self.system.branches.len());
        self.draws(declaration);
        self.system.draws.clear();
        self.system.branches.truncate(branches);
        self.branches.retain(|_, branch| *branch < branches);
        self.system.pool = pool;
    }

    /// Reads what is drawn.
    pub fn draws(&mut self, declaration: &Declaration) {
        let mut found = Vec::new();
        // The others say whether floors are in a plane or in space.
        for floors in [false, true] {
            for (order, draw) in drawn(declaration).enumerate() {
                if floors == (draw.form == Form::Floor) {
                    // A mistake does not hide those of others.
                    let _ = self.draw(draw);
                }
                found.resize(self.system.draws.len(), order);
            }
        }
        let mut ordered: Vec<_> = found.into_iter().zip(self.system.draws.drain(..)).collect();
        ordered.sort_by_key(|(order, _)| *order);
        self.system.draws = ordered.into_iter().map(|(_, draw)| draw).collect();
    }

    fn draw(&mut self, declared: &ast::Draw) -> Option<()> {
        let Some(index) = &declared.index else {
            return self.one_draw(declared, None);
        };
        let (from, to) = self.range(index)?;
        (from..to).try_for_each(|k| {
            self.with_index(&index.name, k, |this| this.one_draw(declared, Some(k)))
        })
    }

    fn one_draw(&mut self, declared: &ast::Draw, index: Option<i64>) -> Option<()> {
        let form = declared.form;
        let mut draw = Draw::of(form);
        match form {
            Form::Floor => {
                for height in &declared.places {
                    match self.value(height, PLACE)? {
                        Value::Scalar(e) => draw.places.push(vec![e]),
                        Value::List(place) => {
                            let told = Code::ListForScalar;
                            self.sink
                                .report(told, height.extent, &[&place.len(), &BY_HEIGHT]);
                            return None;
                        }
                    }
                }
            }
            Form::Arrow => self.arrow(declared, index, &mut draw)?,
            _ => {
                for place in &declared.places {
                    let value = self.value(place, PLACE)?;
                    self.places(&value, place.extent, &mut draw.places)?;
                }
            }
        }
        let (least, most) = form.rule().places;
        if !(least..=most).contains(&draw.places.len()) {
            let takes = match (least, most) {
                (1, 1) => "1 place".to_owned(),
                (2, 2) => "2 places".to_owned(),
                _ => format!("{least} places or more"),
            };
            let count = draw.places.len();
            self.sink.report(
                Code::PlaceCount,
                &declared.word,
                &[&declared.word.text, &takes, &count],
            );
            return None;
        }
        let spatial = self.components(&draw.places) == Some(3);
        self.details(declared, spatial, &mut draw)?;
        if spatial {
            self.fixed_size(declared, &draw)?;
        }
        self.system.draws.push(draw);
        let count: usize = self.system.draws.iter().map(|draw| draw.places.len()).sum();
        if count > MOST_PLACES {
            self.sink
                .report(Code::ManyPlaces, &declared.word, &[&MOST_PLACES]);
            return None;
        }
        Some(())
    }

    /// Number of components of the places of a picture, as far as it is known: of the first of these, or of those before.
    fn components(&self, places: &[Vec<ExprId>]) -> Option<usize> {
        let before = self.system.draws.iter().flat_map(|draw| &draw.places);
        let mut all = before.chain(places).map(Vec::len);
        all.find(|count| *count > 1)
    }

    /// A place, or a list of them.
    fn places(&mut self, value: &Value, at: Extent, places: &mut Vec<Vec<ExprId>>) -> Option<()> {
        let Value::List(elements) = value else {
            let hint = "a place has two coordinates in a plane, `(x, y)`, and three in space";
            self.sink.report(Code::ScalarForList, at, &[&hint]);
            return None;
        };
        let Some(place) = value.vector().filter(|place| !place.is_empty()) else {
            return elements
                .iter()
                .try_for_each(|element| self.places(element, at, places));
        };
        let (count, expected) = (place.len(), self.components(places));
        if !(2..=3).contains(&count) || expected.is_some_and(|expected| expected != count) {
            let expected = expected.map_or("2 or 3".to_owned(), |count| count.to_string());
            self.sink.report(Code::PlaceSize, at, &[&expected, &count]);
            return None;
        }
        places.push(place);
        Some(())
    }
}

/// The items that are drawn, from the back to the front.
pub(super) fn drawn(declaration: &Declaration) -> impl Iterator<Item = &ast::Draw> {
    declaration
        .items
        .iter()
        .filter_map(|item| match &item.kind {
            ItemKind::Draw(draw) => Some(&**draw),
            _ => None,
        })
}
