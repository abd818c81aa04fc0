//! Sizes and turns of what a picture shows.

use super::{Draw, PLACE, Turn};
use crate::ast::{self, Detail, Expr, ExprKind, Form};
use crate::diagnostics::Code;
use crate::model::depth::{Context, Depth};
use crate::model::elaboration::Elaboration;
use crate::model::value::Value;
use crate::symbolic::{ExprId, Rational};

impl Elaboration<'_> {
    /// `radius = r` and the like.
    pub(super) fn details(
        &mut self,
        declared: &ast::Draw,
        spatial: bool,
        draw: &mut Draw,
    ) -> Option<()> {
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
    pub(super) fn fixed_size(&mut self, declared: &ast::Draw, draw: &Draw) -> Option<()> {
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
    pub(in crate::model) fn turns(
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
}
