//! Named starts: positions and velocities as expressions in parameters and t. What is not named is 0; bodies that are turned or spin
//! are [oriented](super::oriented).

use super::Start;
use super::depth::START;
use super::elaboration::Elaboration;
use super::oriented::Oriented;
use super::value::Value;
use crate::ast::{self, Element, Index, Name, StartQuantity, StartValue};
use crate::diagnostics::Code;
use crate::symbolic::ExprId;

impl Elaboration<'_> {
    pub fn start(&mut self, declared: &ast::Start) {
        self.each(&declared.head, |this, name| {
            let mut start = Start {
                name,
                positions: Vec::new(),
                velocities: Vec::new(),
            };
            let mut bodies: Vec<Oriented> = Vec::new();
            // All mistakes are told, not only the first.
            let taken: Vec<Option<()>> = declared
                .values
                .iter()
                .map(|value| match &value.quantity {
                    StartQuantity::Member(member) => this.orient(&mut bodies, value, member),
                    _ => this.set(&mut start, value),
                })
                .collect();
            taken.into_iter().collect::<Option<()>>()?;
            this.place(&mut start, &bodies)?;
            this.system.starts.push(start);
            Some(this.system.starts.len() - 1)
        });
    }

    /// One `x = e` or `der(x) = e`, for one coordinate or several.
    fn set(&mut self, start: &mut Start, declared: &StartValue) -> Option<()> {
        let (first, length) = self.coordinates_of(&declared.name)?;
        let moves = matches!(declared.quantity, StartQuantity::Velocity);
        let values = self.elements_of(declared, length)?;
        let mut values = values.into_iter();
        values.try_for_each(|(k, e)| self.begin(start, moves, (first + k, e), &declared.name))
    }

    /// Sets a position, or a velocity of what `moves`, that is not set already.
    fn begin(
        &mut self,
        start: &mut Start,
        moves: bool,
        (coordinate, e): (usize, ExprId),
        at: &Name,
    ) -> Option<()> {
        let list = match moves {
            false => &mut start.positions,
            true => &mut start.velocities,
        };
        if list.iter().any(|(known, _)| *known == coordinate) {
            let q = &self.system.coordinates[coordinate];
            let text = match moves {
                false => q.name.text.clone(),
                true => self.system.pool.name(q.velocity).to_string(),
            };
            self.sink.report(Code::SameTwice, at, &[&text]);
            return None;
        }
        list.push((coordinate, e));
        Some(())
    }

    /// The elements that are set, of so many, and their values.
    pub fn elements_of(
        &mut self,
        declared: &StartValue,
        length: Option<usize>,
    ) -> Option<Vec<(usize, ExprId)>> {
        Some(match (&declared.element, length) {
            (Element::Whole, None) => vec![(0, self.scalar(&declared.value, START)?)],
            (Element::Whole, Some(length)) => self.all_elements(declared, length)?,
            (Element::One(index), Some(length)) => {
                let k = self.position(index, 0, length)?;
                vec![(k, self.scalar(&declared.value, START)?)]
            }
            (Element::Each(index), Some(length)) => self.some_elements(declared, index, length)?,
            (Element::One(_) | Element::Each(_), None) => {
                let name = &declared.name;
                let hint = format!("`{}` is one coordinate, take the index away", name.text);
                self.sink.report(Code::ScalarForList, name, &[&hint]);
                return None;
            }
        })
    }

    /// `x = [a, b, c]`
    fn all_elements(
        &mut self,
        declared: &StartValue,
        length: usize,
    ) -> Option<Vec<(usize, ExprId)>> {
        let list = self.value(&declared.value, START)?;
        let at = declared.value.extent;
        if let Value::Scalar(_) = list {
            let hint = format!(
                "`{0}` has {length} elements: `{0}[k in 0..{length}] = …`",
                declared.place()
            );
            self.sink.report(Code::ScalarForList, at, &[&hint]);
            return None;
        }
        let elements = list.scalars();
        if elements.len() != length || list.length() != Some(length) {
            let count = list.length().unwrap_or(1);
            self.sink.report(Code::Lengths, at, &[&count, &length]);
            return None;
        }
        Some(elements.into_iter().enumerate().collect())
    }

    /// `x[k in a..b] = e`
    fn some_elements(
        &mut self,
        declared: &StartValue,
        index: &Index,
        length: usize,
    ) -> Option<Vec<(usize, ExprId)>> {
        self.free_index(&index.name)?;
        let (from, to) = self.bounds(&index.range)?;
        let (lower, upper) = (0, length as i64);
        if from < lower || to > upper {
            let outside = if from < lower { from } else { to - 1 };
            let at = index.range.to.extent;
            self.sink
                .report(Code::IndexRange, at, &[&outside, &lower, &upper]);
            return None;
        }
        (from..to)
            .map(|k| {
                let value = |this: &mut Self| this.scalar(&declared.value, START);
                Some((k as usize, self.with_index(&index.name, k, value)?))
            })
            .collect()
    }
}
