//! Fields and coordinates become symbols, and every other name is entered, so that items may use names that are
//! declared later.

use super::depth::{Context, Depth, Reach};
use super::elaborate::item_name;
use super::elaboration::{Elaboration, Pending};
use super::meaning::{Kind, Meaning};
use super::value::Value;
use super::{Coordinate, ItemName, Parameter};
use crate::ast::{self, Declaration, Expr, Field, Head, ItemKind, Name, Observe, Reference};
use crate::diagnostics::Code;

const DEFINITION: Context = Context::new(Reach::Definition, "a definition");
const OUTPUT: Context = Context::new(Reach::Outputs, "an output");

impl Elaboration<'_> {
    /// Enters all names; says which items have names of their own and can be read.
    pub fn declare(&mut self, declaration: &Declaration) -> Vec<bool> {
        for field in &declaration.fields {
            self.field(field);
        }
        for item in &declaration.items {
            match &item.kind {
                ItemKind::Coordinates(coordinates) => {
                    coordinates
                        .iter()
                        .for_each(|coordinate| self.declare_coordinate(coordinate));
                }
                ItemKind::Attitude(attitude) => self.declare_attitude(attitude),
                _ => {}
            }
        }
        let declares =
            |kind: &ItemKind| matches!(kind, ItemKind::Coordinates(_) | ItemKind::Attitude(_));
        if !declaration.items.iter().any(|item| declares(&item.kind)) {
            self.sink
                .report(Code::NoCoordinates, &declaration.name, &[]);
        }
        declaration
            .items
            .iter()
            .map(|item| self.declare_item(&item.kind))
            .collect()
    }

    pub(super) fn field(&mut self, field: &Field) {
        if self
            .enter(&field.name, Kind::Field, Meaning::Poisoned)
            .is_none()
        {
            return;
        }
        let length = field
            .length
            .map_or(1, |n| i64::try_from(n).unwrap_or(i64::MAX));
        if self.unroll(length, (&field.name).into()).is_none() {
            return;
        }
        let mut one = |element: Option<usize>| {
            let name = match element {
                None => field.name.text.clone(),
                Some(k) => format!("{}[{k}]", field.name.text),
            };
            let symbol = self.symbol(&name, Depth::Parameter);
            self.system.parameters.push(Parameter {
                field: field.name.ident.clone(),
                element,
                name,
                symbol,
                documentation: field.documentation.clone(),
                unit: String::new(),
                tex: field.tex.clone(),
                letter: field.letter.clone(),
                domain: field.domain,
            });
            Value::Scalar(self.system.pool.leaf(symbol))
        };
        let value = match field.length {
            None => one(None),
            Some(length) => Value::List((0..length).map(|k| one(Some(k))).collect()),
        };
        self.settle_value(&field.name, value, Depth::Parameter);
    }

    fn declare_coordinate(&mut self, coordinate: &ast::Coordinate) {
        let length = match &coordinate.length {
            None => Some(None),
            Some(length) => self.length(length).map(Some),
        };
        match length {
            Some(length) => {
                self.declare_array(&coordinate.name, length);
            }
            None => {
                self.dropped = true;
                self.enter(&coordinate.name, Kind::Coordinate, Meaning::Poisoned);
            }
        }
    }

    /// Enters a coordinate or an array of them; gives the first.
    pub fn declare_array(&mut self, name: &Name, length: Option<usize>) -> Option<usize> {
        self.enter(name, Kind::Coordinate, Meaning::Poisoned)?;
        let first = self.system.coordinates.len();
        let value = match length {
            None => self.add_coordinate(item_name(name, None)),
            Some(length) => {
                let element = |k| item_name(name, Some((k as i64, k, length)));
                Value::List(
                    (0..length)
                        .map(|k| self.add_coordinate(element(k)))
                        .collect(),
                )
            }
        };
        self.coordinate_names
            .insert(name.text.clone(), (first, length));
        self.settle_value(name, value, Depth::Position);
        Some(first)
    }

    fn settle_value(&mut self, name: &Name, value: Value, depth: Depth) {
        let meaning = Meaning::Value {
            value,
            lower: 0,
            depth,
        };
        self.settle(&name.text, meaning);
    }

    /// The number of elements of an array.
    fn length(&mut self, length: &Expr) -> Option<usize> {
        let zero = ast::Range {
            from: Expr {
                kind: ast::ExprKind::Number(ast::Decimal {
                    digits: 0,
                    exponent: 0,
                }),
                extent: length.extent,
            },
            to: length.clone(),
        };
        let (_, count) = self.bounds(&zero)?;
        if count <= 0 {
            self.sink
                .report(Code::EmptyRange, length.extent, &[&0, &count]);
        }
        usize::try_from(count).ok().filter(|&count| count > 0)
    }

    pub(super) fn add_coordinate(&mut self, name: ItemName) -> Value {
        let position = self.symbol(&name.text, Depth::Position);
        let velocity = self.symbol(&format!("der({})", name.text), Depth::Velocity);
        let acceleration = self.symbol(&format!("der(der({}))", name.text), Depth::Acceleration);
        let (v, a) = (
            self.system.pool.leaf(velocity),
            self.system.pool.leaf(acceleration),
        );
        self.directions.extend([(position, v), (velocity, a)]);
        self.system.coordinates.push(Coordinate {
            name,
            position,
            velocity,
            acceleration,
            unit: String::new(),
        });
        Value::Scalar(self.system.pool.leaf(position))
    }

    /// Whether the item can be read later.
    fn declare_item(&mut self, item: &ItemKind) -> bool {
        let (head, kind): (&Head, Kind) = match item {
            ItemKind::Define(definitions) => {
                for definition in definitions {
                    self.pend(
                        &definition.head,
                        &definition.value,
                        Kind::Definition,
                        DEFINITION,
                    );
                }
                return true;
            }
            ItemKind::Observe(observes) => {
                for observe in observes {
                    if let Observe::New(head, value) = observe {
                        self.pend(head, value, Kind::Output, OUTPUT);
                    }
                }
                return true;
            }
            ItemKind::Impacts(impacts) => {
                self.system.impacts = *impacts;
                return true;
            }
            ItemKind::Emit(emit) => {
                self.system.emit = *emit;
                return true;
            }
            ItemKind::Attitude(attitude) => return self.enter_body(attitude),
            ItemKind::Coordinates(_) | ItemKind::Lagrangian(_) | ItemKind::Draw(_) => return true,
            ItemKind::Kinetic(energy) | ItemKind::Potential(energy) => {
                let kind = match item {
                    ItemKind::Kinetic(_) => Kind::Kinetic,
                    _ => Kind::Potential,
                };
                match &energy.head {
                    None => return true,
                    Some(head) => (head, kind),
                }
            }
            ItemKind::Constraint(item) => (&item.head, Kind::Constraint),
            ItemKind::Contact(item) => (&item.head, Kind::Contact),
            ItemKind::Friction(item) => (&item.head, Kind::Friction),
            ItemKind::Force(item) => (&item.head, Kind::Force),
            ItemKind::Dissipation(item) => (&item.head, Kind::Dissipation),
            ItemKind::Start(item) => (&item.head, Kind::Start),
            ItemKind::Stop(item) => (&item.head, Kind::Stop),
            ItemKind::Mark(item) => (&item.head, Kind::Mark),
            ItemKind::Check(item) => match &item.head {
                None => return true,
                Some(head) => (head, Kind::Check),
            },
        };
        let elements = Vec::new();
        self.enter(
            &head.name,
            kind,
            Meaning::Item {
                elements,
                lower: None,
            },
        )
        .is_some()
    }

    fn pend(&mut self, head: &Head, value: &Expr, kind: Kind, context: Context) {
        let index = self.definitions.len();
        if self
            .enter(&head.name, kind, Meaning::Pending(index))
            .is_some()
        {
            self.definitions.push(Pending {
                head: head.clone(),
                value: value.clone(),
                context,
            });
        }
    }

    /// The coordinate that a reference names.
    pub fn coordinate(&mut self, reference: &Reference) -> Option<usize> {
        let name = &reference.name;
        let (first, length) = self.coordinates_of(name)?;
        match (&reference.element, length) {
            (None, None) => Some(first),
            (Some(element), Some(length)) => Some(first + self.position(element, 0, length)?),
            (None, Some(length)) => {
                let hint = format!("name one of them, `{}[0]`", name.text);
                self.sink
                    .report(Code::ListForScalar, name, &[&length, &hint]);
                None
            }
            (Some(element), None) => {
                let hint = format!("`{}` is one coordinate, take the index away", name.text);
                self.sink
                    .report(Code::ScalarForList, element.extent, &[&hint]);
                None
            }
        }
    }

    /// The first coordinate of a name, and the length of an array.
    pub fn coordinates_of(&mut self, name: &Name) -> Option<(usize, Option<usize>)> {
        if let Some(&found) = self.coordinate_names.get(&name.text) {
            return Some(found);
        }
        match self.names.get(&name.text).map(|entry| entry.kind) {
            None => self.unknown_of(name, &[Kind::Coordinate]),
            Some(Kind::Coordinate) => {} // poisoned
            Some(kind) => {
                let known: Vec<String> = self
                    .coordinate_names
                    .keys()
                    .map(|name| format!("`{name}`"))
                    .collect();
                let hint = format!("coordinates are {}", known.join(", "));
                self.sink.report(
                    Code::WrongKind,
                    name,
                    &[&name.text, &kind.text(), &"coordinate", &hint],
                );
            }
        }
        None
    }
}
