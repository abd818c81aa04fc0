//! Declaration → [`System`]: first all names, then the items in the order in which they need each other.
//!
//! A name that fails to get a meaning is poisoned: uses of it are silent, since the cause has been reported.

use super::depth::{Depth, Reach};
use super::elaboration::{Elaboration, Pending, Scope};
use super::meaning::{Kind, Meaning, Names};
use super::value::Value;
use super::{ItemName, System};
use crate::ast::{Declaration, Head, Item, ItemKind, Name};
use crate::diagnostics::{Code, Diagnostics, Extent};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Pool, Symbol};
use core::fmt::Display;

/// Resolves all names of a declaration; mistakes go to the sink.
pub fn system(declaration: &Declaration, sink: &mut Diagnostics) -> Option<System> {
    Some(scoped(declaration, sink)?.0)
}

/// Resolves all names of a declaration, and keeps them; mistakes go to the sink.
pub fn scoped(declaration: &Declaration, sink: &mut Diagnostics) -> Option<(System, Scope)> {
    let before = sink.count();
    let mut elaboration = Elaboration::new(declaration, sink);
    elaboration.read_all(declaration);
    elaboration.check_size();
    elaboration.check_draws(declaration);
    elaboration.check_quadratic(declaration);
    elaboration.check_dropped(declaration);
    if elaboration.sink.count() == before {
        elaboration.units(declaration);
        elaboration.structure(declaration);
    }
    let (system, scope) = elaboration.close();
    (sink.count() == before).then_some((system, scope))
}

/// The mechanics of a declaration without mistakes with the rates of its bodies as velocities, for equations that people
/// read (Euler 1758); nothing where there is no body, or where the declaration speaks of its quaternion.
pub fn in_body_rates(declaration: &Declaration) -> Option<System> {
    let mut sink = Diagnostics::new();
    let mut elaboration = Elaboration::new(declaration, &mut sink);
    elaboration.in_body_rates = true;
    elaboration.read_in(declaration, &Pass::MECHANICS);
    let whole = !elaboration.dropped && elaboration.sink.is_empty();
    let defined = elaboration.defined();
    let mut system = elaboration.close().0;
    system.defined = defined;
    (whole && !system.bodies.is_empty()).then_some(system)
}

/// Items are read in this order: each needs only what comes before it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pass {
    Energies,
    Contacts,
    Constraints,
    Frictions,
    Forces,
    Starts,
    Observes,
    Watches,
}

impl Pass {
    const MECHANICS: [Pass; 5] = [
        Pass::Energies,
        Pass::Contacts,
        Pass::Constraints,
        Pass::Frictions,
        Pass::Forces,
    ];

    const ALL: [Pass; 8] = [
        Pass::Energies,
        Pass::Contacts,
        Pass::Constraints,
        Pass::Frictions,
        Pass::Forces,
        Pass::Starts,
        Pass::Observes,
        Pass::Watches,
    ];
}

impl<'a> Elaboration<'a> {
    pub fn new(declaration: &Declaration, sink: &'a mut Diagnostics) -> Elaboration<'a> {
        let mut pool = Pool::new();
        let time = pool.symbol("t");
        let one = pool.integer(1);
        let core = || "::lagrange_core".parse().unwrap_or_default();
        let system = System {
            documentation: declaration.documentation.clone(),
            scalar: declaration.scalar.clone(),
            core: declaration.core.clone().unwrap_or_else(core),
            ..System::empty(declaration.name.clone(), pool, time)
        };
        Elaboration {
            system,
            sink,
            names: Names::new(),
            indices: Vec::new(),
            slip: None,
            branches: SortedMap::new(),
            depths: vec![Depth::Parameter; time.index() + 1],
            directions: vec![(time, one)],
            rates: None,
            definitions: Vec::new(),
            coordinate_names: SortedMap::new(),
            bodies: SortedMap::new(),
            in_body_rates: false,
            outputs: Vec::new(),
            dropped: false,
            overflowed: false,
            unrolled: 0,
            home: declaration.home,
        }
    }

    /// Enters all names and reads all items.
    pub fn read_all(&mut self, declaration: &Declaration) {
        self.read_in(declaration, &Pass::ALL);
    }

    /// Enters all names and reads the items of these passes.
    fn read_in(&mut self, declaration: &Declaration, passes: &[Pass]) {
        let accepted = self.declare(declaration);
        self.check_single_items(declaration);
        self.check_energies(declaration);
        let items = || {
            declaration
                .items
                .iter()
                .zip(&accepted)
                .filter(|(_, accepted)| **accepted)
                .map(|(item, _)| item)
        };
        self.definitions_all(|this, definition| !this.has_force(definition));
        for &pass in passes {
            for item in items() {
                self.read(item, pass);
            }
            if pass == Pass::Forces {
                self.definitions_all(|_, _| true);
            }
        }
    }

    /// A new symbol of this kind.
    pub fn symbol(&mut self, name: &str, depth: Depth) -> Symbol {
        let symbol = self.system.pool.symbol(name);
        self.depths.resize(symbol.index() + 1, Depth::Parameter);
        self.depths[symbol.index()] = depth;
        symbol
    }

    fn read(&mut self, item: &Item, pass: Pass) {
        match (pass, &item.kind) {
            (Pass::Energies, ItemKind::Kinetic(energy)) => {
                self.energy_term(Kind::Kinetic, energy, item.keyword)
            }
            (Pass::Energies, ItemKind::Potential(energy)) => {
                self.energy_term(Kind::Potential, energy, item.keyword)
            }
            (Pass::Energies, ItemKind::Lagrangian(value)) => {
                self.split_lagrangian(value, item.keyword)
            }
            (Pass::Contacts, ItemKind::Contact(contact)) => self.contact(contact),
            (Pass::Constraints, ItemKind::Attitude(attitude)) => self.attitude(attitude),
            (Pass::Constraints, ItemKind::Constraint(constraint)) => self.constraint(constraint),
            (Pass::Frictions, ItemKind::Friction(friction)) => self.friction(friction),
            (Pass::Forces, ItemKind::Force(force)) => self.force(force),
            (Pass::Forces, ItemKind::Dissipation(dissipation)) => self.dissipation(dissipation),
            (Pass::Starts, ItemKind::Start(start)) => self.start(start),
            (Pass::Observes, ItemKind::Observe(observes)) => self.observe(observes),
            (Pass::Watches, ItemKind::Stop(watch)) => self.watch(Kind::Stop, watch),
            (Pass::Watches, ItemKind::Mark(watch)) => self.watch(Kind::Mark, watch),
            _ => {}
        }
        let name = item
            .name()
            .map_or("this item".to_owned(), |name| format!("`{}`", name.text));
        self.check_overflow(item.keyword, &name);
    }

    /// Runs `body` for every element of an item; `body` gives the element's place in the system's list.
    /// After a mistake the other elements are left out: they would repeat it.
    pub fn each(
        &mut self,
        head: &Head,
        mut body: impl FnMut(&mut Self, ItemName) -> Option<usize>,
    ) {
        let name = &head.name;
        let meaning = match &head.index {
            None => body(self, item_name(name, None)).map(|element| Meaning::Item {
                elements: vec![element],
                lower: None,
            }),
            Some(index) => self.range(index).and_then(|(from, to)| {
                let count = (to - from) as usize;
                let elements: Option<Vec<usize>> = (from..to)
                    .map(|k| {
                        let element = item_name(name, Some((k, (k - from) as usize, count)));
                        self.with_index(&index.name, k, |this| body(this, element))
                    })
                    .collect();
                elements.map(|elements| Meaning::Item {
                    elements,
                    lower: Some(from),
                })
            }),
        };
        self.dropped |= meaning.is_none();
        self.settle(&name.text, meaning.unwrap_or(Meaning::Poisoned));
    }

    /// The bounds of an item's index, which may not be empty.
    pub(super) fn range(&mut self, index: &crate::ast::Index) -> Option<(i64, i64)> {
        self.free_index(&index.name)?;
        let (from, to) = self.bounds(&index.range)?;
        if to <= from {
            let at =
                crate::diagnostics::Extent::new(index.range.from.extent, index.range.to.extent);
            self.sink.report(Code::EmptyRange, at, &[&from, &to]);
            return None;
        }
        Some((from, to))
    }

    /// Evaluates a definition and settles its name.
    pub fn define(&mut self, definition: usize) {
        let Pending {
            head,
            value,
            context,
        } = self.definitions[definition].clone();
        self.settle(&head.name.text, Meaning::Busy);
        // A definition does not see the indices and the slip of where it is used.
        let (indices, slip) = (std::mem::take(&mut self.indices), self.slip.take());
        let found = match &head.index {
            None => self.value(&value, context).map(|value| (value, 0)),
            Some(index) => self.range(index).and_then(|(from, to)| {
                let elements: Option<Vec<Value>> = (from..to)
                    .map(|k| self.with_index(&index.name, k, |this| this.value(&value, context)))
                    .collect();
                Some((self.list(elements?, value.extent)?, from))
            }),
        };
        (self.indices, self.slip) = (indices, slip);
        self.dropped |= found.is_none();
        self.check_overflow(head.name.span(), &format!("`{}`", head.name.text));
        let meaning = match found {
            None => Meaning::Poisoned,
            Some((value, lower)) => Meaning::Value {
                depth: self.depth(&value.scalars()),
                value,
                lower,
            },
        };
        self.settle(&head.name.text, meaning);
    }

    /// Whether a definition names something that has a force, itself or by another definition.
    fn has_force(&self, definition: usize) -> bool {
        let mut seen = vec![false; self.definitions.len()];
        let mut next = vec![definition];
        while let Some(definition) = next.pop() {
            if std::mem::replace(&mut seen[definition], true) {
                continue;
            }
            let mut names = Vec::new();
            self.definitions[definition].value.names_into(&mut names);
            for entry in names.into_iter().filter_map(|name| self.names.get(name)) {
                match entry.meaning {
                    Meaning::Pending(other) => next.push(other),
                    Meaning::Item { .. } if entry.kind.has_force() => return true,
                    _ => {}
                }
            }
        }
        false
    }

    /// Evaluates every definition of a kind that nothing has used, so that its mistakes are found.
    fn definitions_all(&mut self, of_kind: impl Fn(&Self, usize) -> bool) {
        for definition in 0..self.definitions.len() {
            let pending = &self.definitions[definition];
            let entry = self.names.get(&pending.head.name.text);
            let is_pending =
                entry.is_some_and(|entry| matches!(entry.meaning, Meaning::Pending(_)));
            let defines = pending.context.reach == Reach::Definition;
            if is_pending && defines && of_kind(self, definition) {
                self.define(definition);
            }
        }
    }

    /// Scalar definitions and their values.
    fn defined(&self) -> Vec<(String, ExprId)> {
        let names = self
            .definitions
            .iter()
            .map(|pending| &pending.head.name.text);
        let worth = names.filter_map(|name| match self.names.get(name)?.meaning {
            Meaning::Value {
                value: Value::Scalar(e),
                ..
            } => Some((name.clone(), e)),
            _ => None,
        });
        worth.collect()
    }

    /// A run has matrices with a row and a column for each of these.
    fn check_size(&mut self) {
        const MOST: usize = 4_000;
        let system = &self.system;
        let coordinates = system.coordinates.iter().map(|one| one.name.span);
        let constraints = system.constraints.iter().map(|one| one.name.span);
        let contacts = system.contacts.iter().map(|one| one.name.span);
        let frictions = system.frictions.iter().map(|one| one.name.span);
        let mut all = coordinates
            .chain(constraints)
            .chain(contacts)
            .chain(frictions);
        let count = all.clone().count();
        if let Some(beyond) = all.nth(MOST) {
            self.sink
                .report(Code::TooManyRows, beyond, &[&count, &MOST]);
        }
    }

    /// Exact numbers and exponents that did not fit make every form doubtful: reported where it first happens.
    pub(super) fn check_overflow(&mut self, at: impl Into<Extent>, name: &dyn Display) {
        if let Some(outgrown) = self.system.pool.outgrown()
            && !self.overflowed
        {
            self.overflowed = true;
            self.sink.report(Code::Overflow, at, &[&outgrown.of(name)]);
        }
    }

    /// Nothing is left out without a message.
    fn check_dropped(&mut self, declaration: &Declaration) {
        if self.dropped && self.sink.is_empty() {
            self.sink.report(Code::Bug, &declaration.name, &[]);
        }
    }
}

/// Name of an element: (index, position, count).
pub(super) fn item_name(name: &Name, element: Option<(i64, usize, usize)>) -> ItemName {
    ItemName {
        text: match element {
            None => name.text.clone(),
            Some((index, ..)) => format!("{}[{index}]", name.text),
        },
        ident: Some(name.ident.clone()),
        element: element.map(|(_, position, count)| (position, count)),
        span: name.span(),
    }
}
