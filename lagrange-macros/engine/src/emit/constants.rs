//! Which names of a declaration become constants of its struct, in capitals: `theta` and `rim` are `MassOnWheel::THETA` and `MassOnWheel::RIM`.

use crate::ast::{Declaration, Energy, Head, ItemKind, Name, Observe};
use crate::diagnostics::{Code, Diagnostics};
use crate::model::shouting;
use crate::sorted::SortedMap;
use proc_macro2::Ident;

/// Constants that systems have beside those of their names.
pub(super) const OF_SYSTEMS: [&str; 3] = ["CHECKS", "DECLARATION", "DESCRIPTION"];

/// What observes. A constant of it that is taken is left out: an output may be called as what it observes is, or as a constant of all systems.
pub(super) const OUTPUT: &str = "ObserveId";

/// A name that becomes a constant.
pub(super) struct Constant<'a> {
    /// Type of the constant.
    pub kind: &'static str,
    pub name: &'a Name,
    pub indexed: bool,
}

impl<'a> Constant<'a> {
    fn new(kind: &'static str, name: &'a Name, indexed: bool) -> Self {
        Self {
            kind,
            name,
            indexed,
        }
    }

    fn of(kind: &'static str, head: &'a Head) -> Self {
        Self::new(kind, &head.name, head.index.is_some())
    }
}

/// Those of a declaration, in its order.
pub(super) fn constants(declaration: &Declaration) -> Vec<Constant<'_>> {
    declaration
        .items
        .iter()
        .flat_map(|item| of(&item.kind))
        .collect()
}

fn of(item: &ItemKind) -> Vec<Constant<'_>> {
    match item {
        ItemKind::Coordinates(list) => list
            .iter()
            .map(|one| Constant::new("CoordinateId", &one.name, one.length.is_some()))
            .collect(),
        ItemKind::Attitude(attitude) => vec![
            Constant::new("CoordinateId", &attitude.coordinates, true),
            Constant::new("ConstraintId", &attitude.body, false),
        ],
        ItemKind::Observe(list) => list
            .iter()
            .map(|observe| match observe {
                Observe::Known(name) => Constant::new(OUTPUT, name, false),
                Observe::New(head, _) => Constant::of(OUTPUT, head),
            })
            .collect(),
        ItemKind::Kinetic(item) => energy("KineticId", item),
        ItemKind::Potential(item) => energy("PotentialId", item),
        ItemKind::Constraint(item) => vec![Constant::of("ConstraintId", &item.head)],
        ItemKind::Contact(item) => vec![Constant::of("ContactId", &item.head)],
        ItemKind::Friction(item) => vec![Constant::of("FrictionId", &item.head)],
        ItemKind::Force(item) => vec![Constant::of("ForceId", &item.head)],
        ItemKind::Dissipation(item) => vec![Constant::of("DissipationId", &item.head)],
        ItemKind::Start(item) => vec![Constant::of("StartId", &item.head)],
        ItemKind::Stop(item) => vec![Constant::of("StopId", &item.head)],
        ItemKind::Mark(item) => vec![Constant::of("MarkId", &item.head)],
        ItemKind::Define(_)
        | ItemKind::Lagrangian(_)
        | ItemKind::Impacts(_)
        | ItemKind::Emit(_)
        | ItemKind::Check(_)
        | ItemKind::Draw(_) => Vec::new(),
    }
}

/// That of an energy, if it has a name.
fn energy<'a>(kind: &'static str, energy: &'a Energy) -> Vec<Constant<'a>> {
    let head = energy.head.iter();
    head.map(|head| Constant::of(kind, head)).collect()
}

/// Reports different names that become one constant, and names whose constant every system has.
pub fn clashes(declaration: &Declaration, sink: &mut Diagnostics) {
    let mut taken: SortedMap<String, &str> = SortedMap::new();
    for Constant { kind, name, .. } in constants(declaration) {
        let text = name.text.as_str();
        let constant = screaming(&name.ident).to_string();
        if kind != OUTPUT && OF_SYSTEMS.contains(&constant.as_str()) {
            sink.report(Code::ConstantOfSystems, name, &[&text, &constant]);
        }
        match taken.get(&constant) {
            Some(first) if *first != text => {
                sink.report(Code::HandleClash, name, &[&text, first, &constant]);
            }
            Some(_) => {}
            None => {
                taken.insert(constant, text);
            }
        }
    }
}

/// `muStatic` and `mu_static` → `MU_STATIC`; `r#static` → `STATIC`.
pub(super) fn screaming(ident: &Ident) -> Ident {
    let text = ident.to_string();
    let name = shouting(text.strip_prefix("r#").unwrap_or(&text));
    Ident::new(&name, ident.span())
}
