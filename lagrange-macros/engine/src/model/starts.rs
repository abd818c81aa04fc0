//! Named starts: positions and velocities as expressions in parameters and t. What is not named is 0; a body that is
//! not oriented stands along the axes of space.

use super::Start;
use super::elaborate::Elaboration;
use super::reach::{Context, Reach};
use super::value::Value;
use crate::ast::{self, Element, Order, StartValue};
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
        let order = declared.order;
        match (&declared.element, length) {
            (Element::Whole, None) => {
                Some(vec![(order, first, self.scalar(&declared.value, START)?)])
            }
            (Element::Whole, Some(length)) => {
                let hint = format!(
                    "`{0}` has {length} elements: `{0}[k in 0..{length}] = …`",
                    declared.name.text
                );
                match self.value(&declared.value, START)? {
                    Value::Scalar(_) => {
                        self.sink
                            .report(Code::ScalarForList, declared.value.extent, &[&hint]);
                        None
                    }
                    list => {
                        let elements = list.scalars();
                        if elements.len() != length || list.length() != Some(length) {
                            let count = list.length().unwrap_or(1);
                            self.sink.report(
                                Code::Lengths,
                                declared.value.extent,
                                &[&count, &length],
                            );
                            return None;
                        }
                        Some(
                            elements
                                .into_iter()
                                .enumerate()
                                .map(|(k, e)| (order, first + k, e))
                                .collect(),
                        )
                    }
                }
            }
            (Element::One(index), Some(length)) => {
                let k = self.position(index, 0, length)?;
                Some(vec![(
                    order,
                    first + k,
                    self.scalar(&declared.value, START)?,
                )])
            }
            (Element::Each(index), Some(length)) => {
                self.free_index(&index.name)?;
                let (from, to) = self.bounds(&index.range)?;
                let (lower, upper) = (0, length as i64);
                if from < lower || to > upper {
                    let outside = if from < lower { from } else { to - 1 };
                    self.sink.report(
                        Code::IndexRange,
                        index.range.to.extent,
                        &[&outside, &lower, &upper],
                    );
                    return None;
                }
                (from..to)
                    .map(|k| {
                        let e = self.with_index(&index.name, k, |this| {
                            this.scalar(&declared.value, START)
                        })?;
                        Some((order, first + k as usize, e))
                    })
                    .collect()
            }
            (Element::One(_) | Element::Each(_), None) => {
                let hint = format!(
                    "`{}` is one coordinate, take the index away",
                    declared.name.text
                );
                self.sink
                    .report(Code::ScalarForList, &declared.name, &[&hint]);
                None
            }
        }
    }
}
