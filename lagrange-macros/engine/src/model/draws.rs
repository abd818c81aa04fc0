//! What a picture shows: places, sizes and attitudes as expressions, and forces as a sum over the multipliers.
//!
//! A force f(λ) that is linear in the multipliers is Σ λᵢ ∂f/∂λᵢ + f(0): the parts give the arrow of an impulse as well, whose
//! multipliers are others.

use super::depth::{Context, Depth, Reach};
use super::elaborate::item_name;
use super::elaboration::Elaboration;
use super::forces::AS_ITS_PLACE;
use super::meaning::Kind;
use super::value::Value;
use super::{System, Worked};
use crate::ast::{self, Declaration, Detail, Expr, ExprKind, Form, ItemKind};
use crate::diagnostics::{Code, Extent};
use crate::symbolic::{ExprId, Rational, Symbol};

const PLACE: Context = Context::new(Reach::Positions, "a picture");
const FORCE: Context = Context::new(Reach::Forces, "the force of an arrow");

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
                    draw.places.push(vec![self.scalar(height, PLACE)?]);
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

    /// `radius = r` and the like.
    fn details(&mut self, declared: &ast::Draw, spatial: bool, draw: &mut Draw) -> Option<()> {
        let word = &declared.word;
        let rule = declared.form.rule();
        let (allowed, surroundings) = match spatial {
            true => (rule.space, "in space"),
            false => (rule.plane, "in a plane"),
        };
        let Some(allowed) = allowed else {
            let hint = match (declared.form, spatial) {
                (Form::Sphere, _) => "draw a `disc`, or give places three coordinates",
                (_, true) => "draw it with `box`, `rod` or `disc`, or give places two coordinates",
                (_, false) => "draw it with `polygon` or `disc`, or give places three coordinates",
            };
            self.sink.report(
                Code::NotInPicture,
                word,
                &[&word.text, &surroundings, &hint],
            );
            return None;
        };
        for (detail, key, value) in &declared.details {
            if !allowed.contains(detail) {
                let hint = match spatial {
                    true => "bodies in space are turned by `attitude` or `turn`",
                    false => "what is turned in a plane has an `angle`, counter-clockwise",
                };
                self.sink
                    .report(Code::NotInPicture, key, &[&key.text, &surroundings, &hint]);
                return None;
            }
            let turned = !matches!(draw.turn, Turn::None);
            let turns = match detail {
                Detail::Radius => {
                    draw.size.insert(0, self.scalar(value, PLACE)?);
                    continue;
                }
                Detail::Height => {
                    draw.size.push(self.scalar(value, PLACE)?);
                    continue;
                }
                Detail::Size => {
                    draw.size = self.numbers(key, value, if spatial { 3 } else { 2 })?;
                    continue;
                }
                Detail::Angle => Turn::Angle(self.scalar(value, PLACE)?),
                Detail::Attitude => Turn::Attitude(self.body(value)?),
                Detail::Turn => Turn::About(self.turns(key, value, PLACE)?),
                Detail::Rolled => Turn::Rolled(self.numbers(key, value, 3)?),
            };
            if turned {
                self.sink.report(
                    Code::Exclusive,
                    key,
                    &[&key.text, &"what turns it too", &"keep one of them"],
                );
                return None;
            }
            draw.turn = turns;
        }
        let is_told = |needed: &&Detail| !declared.details.iter().any(|(told, ..)| told == *needed);
        if let Some(missing) = rule.needs.iter().find(is_told) {
            let missing = missing.word();
            let add = format!("{missing} = …");
            self.sink
                .report(Code::MissingPart, word, &[&word.text, &missing, &add]);
            return None;
        }
        if let (Form::Disc, true, &[radius]) = (declared.form, spatial, draw.size.as_slice()) {
            let thin = Rational::new(1, 20).unwrap_or(Rational::HALF);
            draw.size.push(self.system.pool.scale(radius, thin));
        }
        Some(())
    }

    /// Whether the size of a body in space, whose faces are made once, does not change.
    fn fixed_size(&mut self, declared: &ast::Draw, draw: &Draw) -> Option<()> {
        let (pool, time) = (&self.system.pool, self.system.time);
        let changes =
            |e: &ExprId| self.depth(&[*e]) > Depth::Parameter || pool.depends_on(*e, time);
        if !draw.size.iter().any(changes) {
            return Some(());
        }
        let word = &declared.word;
        self.sink.report(Code::ChangingSize, word, &[&word.text]);
        None
    }

    /// So many numbers.
    fn numbers(&mut self, key: &ast::Name, value: &Expr, count: usize) -> Option<Vec<ExprId>> {
        let found = self.value(value, PLACE)?;
        let numbers = found.vector().filter(|numbers| numbers.len() == count);
        if numbers.is_none() {
            let given = found.length().unwrap_or(1);
            self.sink
                .report(Code::DetailSize, value.extent, &[&key.text, &count, &given]);
        }
        numbers
    }

    /// A rotation vector, or a list of them.
    pub fn turns(
        &mut self,
        key: &ast::Name,
        value: &Expr,
        context: Context,
    ) -> Option<Vec<ExprId>> {
        let found = self.value(value, context)?;
        let vectors = match &found {
            Value::List(all) if all.iter().all(|one| one.length().is_some()) => all.clone(),
            _ => vec![found],
        };
        let numbers: Option<Vec<Vec<ExprId>>> = vectors
            .iter()
            .map(|one| one.vector().filter(|numbers| numbers.len() == 3))
            .collect();
        if numbers.is_none() {
            let given = vectors
                .iter()
                .map(|one| one.length().unwrap_or(1))
                .find(|count| *count != 3);
            let given = given.unwrap_or_default();
            self.sink
                .report(Code::DetailSize, value.extent, &[&key.text, &3, &given]);
        }
        numbers.map(|numbers| numbers.concat())
    }

    /// The first coordinate of a body of `attitude`.
    fn body(&mut self, value: &Expr) -> Option<usize> {
        let hint = "name the body of an `attitude(body: q)`; angles stand in `turn`";
        let ExprKind::Name(name) = &value.kind else {
            let found = format!("`{value}`");
            self.sink.report(
                Code::Expected,
                value.extent,
                &[&"the name of a body", &found],
            );
            return None;
        };
        if let Some(&first) = self.bodies.get(&name.text) {
            return Some(first);
        }
        match self.names.get(&name.text) {
            None => self.unknown(name),
            Some(entry) => {
                let kind = entry.kind.text();
                self.sink
                    .report(Code::WrongKind, name, &[&name.text, &kind, &"body", &hint]);
            }
        }
        None
    }

    /// `f at p`, or the name of a force that has a place.
    fn arrow(&mut self, declared: &ast::Draw, index: Option<i64>, draw: &mut Draw) -> Option<()> {
        let force = &declared.places[0];
        let components = match &declared.at {
            Some(place) => {
                let value = self.value(place, PLACE)?;
                self.places(&value, place.extent, &mut draw.places)?;
                let found = self.value(force, FORCE)?;
                let components = found
                    .vector()
                    .filter(|components| components.len() == draw.places[0].len());
                if found.length().is_none() {
                    self.sink
                        .report(Code::ScalarForList, force.extent, &[&AS_ITS_PLACE]);
                } else if components.is_none() {
                    let (given, needed) = (found.length().unwrap_or(1), draw.places[0].len());
                    self.sink
                        .report(Code::Lengths, force.extent, &[&given, &needed]);
                }
                components?
            }
            None => {
                let load = self.placed(force)?;
                let (components, place) = placed_force(&self.system, load).unzip();
                draw.loads.push(load);
                let place: Vec<Value> = place.into_iter().flatten().map(Value::Scalar).collect();
                self.places(&Value::List(place), force.extent, &mut draw.places)?;
                components?
            }
        };
        self.parts(&components, force, draw)?;
        draw.name = match (&declared.name, index) {
            (Some(name), None) => name.text.clone(),
            (Some(name), Some(k)) => item_name(name, Some((k, 0, 0))).text,
            (None, _) => self.named_after(draw),
        };
        if draw.name.is_empty() {
            let word = &declared.word;
            self.sink
                .report(Code::MissingPart, word, &[&word.text, &"name", &"name = …"]);
            return None;
        }
        Some(())
    }

    /// The force of this name, if it acts at a place.
    fn placed(&mut self, force: &Expr) -> Option<usize> {
        let named = force.as_reference().filter(|reference| {
            let entry = self.names.get(&reference.name.text);
            entry.is_none_or(|entry| entry.kind == Kind::Force)
        });
        let found = match named {
            Some(reference) => Some(self.item(&reference, &[Kind::Force])?.1),
            None => None,
        };
        let placed = found.filter(|load| placed_force(&self.system, *load).is_some());
        if placed.is_none() {
            let add = "at (x, y)";
            self.sink
                .report(Code::MissingPart, force.extent, &[&"arrow", &"place", &add]);
        }
        placed
    }

    /// A force as a sum over the multipliers.
    fn parts(&mut self, components: &[ExprId], force: &Expr, draw: &mut Draw) -> Option<()> {
        let pool = &self.system.pool;
        let contained: Vec<Symbol> = components.iter().flat_map(|&e| pool.symbols(e)).collect();
        let multipliers = self.system.multipliers();
        let (rows, acting): (Vec<usize>, Vec<Symbol>) = (multipliers.iter().copied())
            .enumerate()
            .filter(|(_, multiplier)| contained.contains(multiplier))
            .unzip();
        let mut columns: Vec<Vec<ExprId>> = vec![Vec::new(); rows.len()];
        for &component in components {
            let nonlinear = self.nonlinear_in(component, &multipliers);
            let split = self
                .system
                .pool
                .coefficients_linear(component, &acting)
                .filter(|_| nonlinear.is_none());
            let Some((slopes, rest)) = split else {
                let name = nonlinear.map(|symbol| self.system.pool.name(symbol).to_owned());
                let name = name.unwrap_or_default();
                self.sink
                    .report(Code::ForceNotLinear, force.extent, &[&name]);
                return None;
            };
            for (column, slope) in columns.iter_mut().zip(slopes) {
                column.push(slope);
            }
            draw.applied.push(rest);
        }
        draw.parts = rows.into_iter().zip(columns).collect();
        for (load, force) in self.system.forces.iter().enumerate() {
            if contained.contains(&force.force) && !draw.loads.contains(&load) {
                draw.loads.push(load);
            }
        }
        Some(())
    }

    /// The names of the items whose forces an arrow shows.
    fn named_after(&self, draw: &Draw) -> String {
        let system = &self.system;
        let constraints = system.constraints.iter().map(|constraint| &constraint.name);
        let contacts = system.contacts.iter().map(|contact| &contact.name);
        let frictions = system.frictions.iter().flat_map(|friction| {
            let components = friction.slip.iter();
            components.map(|_| &friction.name)
        });
        let rows: Vec<_> = constraints.chain(contacts).chain(frictions).collect();
        let loads = draw.loads.iter().map(|load| &system.forces[*load].name);
        let rows = draw.parts.iter().map(|(row, _)| rows[*row]);
        let mut names: Vec<&str> = rows.chain(loads).map(|name| name.text.as_str()).collect();
        names.dedup();
        // Several elements of one item are together called as the item.
        let stem = |name: &str| name.split('[').next().unwrap_or_default().to_string();
        let mut called: Vec<String> = names
            .iter()
            .map(|name| {
                match names
                    .iter()
                    .filter(|other| stem(other) == stem(name))
                    .count()
                {
                    1 => name.to_string(),
                    _ => stem(name),
                }
            })
            .collect();
        called.dedup();
        called.join(" + ")
    }
}

/// The components of a force, and of the place at which it acts.
pub(super) fn placed_force(system: &System, load: usize) -> Option<(Vec<ExprId>, Vec<ExprId>)> {
    let components = &system.forces[load].components;
    let placed = components.iter().map(|&(f, worked)| match worked {
        Worked::Point(p) => Some((f, p)),
        _ => None,
    });
    placed
        .collect::<Option<Vec<_>>>()
        .map(|all| all.into_iter().unzip())
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
