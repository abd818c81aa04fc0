//! The units of what names stand for.

use super::check::Checker;
use super::dimension::Dimension;
use super::shape::Shape;
use crate::ast::{Expr, ExprKind, Name};
use crate::model::meaning::Meaning;

impl Checker<'_, '_> {
    pub fn with_index<R>(&mut self, name: &Name, k: i64, body: impl FnOnce(&mut Self) -> R) -> R {
        self.elaboration.indices.push((name.text.clone(), k));
        let result = body(self);
        self.elaboration.indices.pop();
        result
    }

    /// What a name stands for.
    pub(super) fn name(&mut self, name: &Name) -> Option<Shape> {
        let text = name.text.as_str();
        match text {
            "pi" => return Some(Shape::One(Dimension::ONE.into())),
            "t" => return Some(Shape::One(Dimension::TIME.into())),
            "energy" => return Some(Shape::One(self.energy.clone())),
            _ => {}
        }
        if self
            .elaboration
            .indices
            .iter()
            .any(|(known, _)| known == text)
        {
            return Some(Shape::One(Dimension::ONE.into()));
        }
        if let Some(shape) = self.names.get(text) {
            return shape.clone();
        }
        let entry = self.elaboration.names.get(text)?;
        if let Meaning::Item { elements, lower } = &entry.meaning {
            let (kind, lower) = (entry.kind, *lower);
            let mut shapes: Vec<Shape> = elements
                .clone()
                .into_iter()
                .map(|element| self.forces.of(kind, element))
                .collect::<Option<_>>()?;
            return match lower {
                None => shapes.pop(),
                Some(_) => Some(Shape::List(shapes)),
            };
        }
        self.definition(text)
    }

    /// A definition or output, read once.
    pub fn definition(&mut self, text: &str) -> Option<Shape> {
        let pending = self
            .elaboration
            .definitions
            .iter()
            .find(|pending| pending.head.name.text == text)?
            .clone();
        let indices = std::mem::take(&mut self.elaboration.indices);
        let found = match &pending.head.index {
            None => self.shape(&pending.value, None),
            Some(index) => self
                .elaboration
                .bounds(&index.range)
                .and_then(|(from, to)| {
                    let elements = (from..to).map(|k| {
                        self.with_index(&index.name, k, |this| this.shape(&pending.value, None))
                    });
                    elements.collect::<Option<_>>().map(Shape::List)
                }),
        };
        self.elaboration.indices = indices;
        self.names.insert(text.to_string(), found.clone());
        found
    }

    /// Where the indices of a list begin.
    pub(super) fn lower(&self, base: &Expr) -> i64 {
        let ExprKind::Name(name) = &base.kind else {
            return 0;
        };
        match self
            .elaboration
            .names
            .get(&name.text)
            .map(|entry| &entry.meaning)
        {
            Some(Meaning::Value { lower, .. }) => *lower,
            Some(Meaning::Item { lower, .. }) => lower.unwrap_or(0),
            _ => 0,
        }
    }
}
