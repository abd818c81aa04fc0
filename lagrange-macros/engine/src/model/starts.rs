//! Named starts: positions and velocities as expressions in parameters and t. What is not named is 0; a body that is
//! not oriented stands along the axes of space.

use super::Start;
use super::depth::{Context, Reach};
use super::elaboration::Elaboration;
use super::value::Value;
use crate::ast::{self, Element, Index, Order, StartValue};
use crate::diagnostics::Code;
use crate::symbolic::ExprId;

const START: Context = Context::new(Reach::Parameters, "a start");

/// (order, coordinate, value)
type Setting = (Order, usize, ExprId);

impl Elaboration<'_> {
    pub fn start(&mut self, declared: &ast::Start) {
        self.each(&declared.head, |this, name| {
            let mut start = Start {
                name,
                positions: Vec::new(),
                velocities: Vec::new(),
            };
            let found: Vec<Option<Vec<Setting>>> = declared
                .values
                .iter()
                .map(|value| this.setting(value))
                .collect();
            for (value, settings) in declared.values.iter().zip(found) {
                for (order, coordinate, e) in settings? {
                    let list = match order {
                        Order::Position => &mut start.positions,
                        Order::Velocity => &mut start.velocities,
                    };
                    if list.iter().any(|(known, _)| *known == coordinate) {
                        let q = &this.system.coordinates[coordinate];
                        let text = match order {
                            Order::Position => q.name.text.clone(),
                            Order::Velocity => this.system.pool.name(q.velocity).to_string(),
                        };
                        this.sink.report(Code::SameTwice, &value.name, &[&text]);
                        return None;
                    }
                    list.push((coordinate, e));
                }
            }
            this.upright(&mut start.positions);
            this.system.starts.push(start);
            Some(this.system.starts.len() - 1)
        });
    }

    /// One `x = e`, for one coordinate or several.
    fn setting(&mut self, declared: &StartValue) -> Option<Vec<Setting>> {
        let (first, length) = self.coordinates_of(&declared.name)?;
        let values = match (&declared.element, length) {
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
        };
        let order = declared.order;
        let settings = values.into_iter().map(|(k, e)| (order, first + k, e));
        Some(settings.collect())
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
                declared.name.text
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
