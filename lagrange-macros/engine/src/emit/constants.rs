//! Which names of a declaration become constants of its struct, in capitals: `theta` and `rim` are `MassOnWheel::THETA` and `MassOnWheel::RIM`.

use crate::ast::{Declaration, Energy, Head, ItemKind, Name, Observe};
use crate::diagnostics::{Code, Diagnostics};
use crate::model::shouting;
use crate::parse::Glimpse;
use crate::sorted::SortedMap;
use proc_macro2::Ident;

/// Constants that systems have beside those of their names.
pub(super) const OF_SYSTEMS: [&str; 3] = ["CHECKS", "DECLARATION", "DESCRIPTION"];

/// What observes. A constant of it that is taken is left out: an output may be called as what it observes is, or as a constant of all systems.
pub(super) const OUTPUT: &str = "ObserveId";

/// The type of the constants of an item, by the word that begins it; what is not listed observes.
const KINDS: [(&str, &str); 11] = [
    ("coordinates", "CoordinateId"),
    ("kinetic", "KineticId"),
    ("potential", "PotentialId"),
    ("constraint", "ConstraintId"),
    ("contact", "ContactId"),
    ("friction", "FrictionId"),
    ("force", "ForceId"),
    ("dissipation", "DissipationId"),
    ("start", "StartId"),
    ("stop", "StopId"),
    ("mark", "MarkId"),
];

/// A name that becomes a constant.
pub(super) struct Constant<'a> {
    /// Type of the constant.
    pub kind: &'static str,
    pub name: &'a Name,
    pub indexed: bool,
}

impl<'a> Constant<'a> {
    /// That of an item which begins with this word.
    fn new(keyword: &str, name: &'a Name, indexed: bool) -> Self {
        let known = KINDS.iter().find(|(word, _)| *word == keyword);
        Self {
            kind: known.map_or(OUTPUT, |(_, kind)| kind),
            name,
            indexed,
        }
    }

    fn of(keyword: &str, head: &'a Head) -> Self {
        Self::new(keyword, &head.name, head.index.is_some())
    }
}

/// Those of a declaration, in its order.
fn constants(declaration: &Declaration) -> Vec<Constant<'_>> {
    declaration
        .items
        .iter()
        .flat_map(|item| of(&item.kind))
        .collect()
}

/// Those of a struct whose attributes may be wrong.
pub(super) fn glimpsed(seen: &Glimpse) -> impl Iterator<Item = Constant<'_>> {
    let names = seen.names.iter();
    names.map(|seen| Constant::new(seen.keyword, &seen.name, seen.indexed))
}

fn of(item: &ItemKind) -> Vec<Constant<'_>> {
    match item {
        ItemKind::Coordinates(list) => list
            .iter()
            .map(|one| Constant::new("coordinates", &one.name, one.length.is_some()))
            .collect(),
        ItemKind::Attitude(attitude) => vec![
            Constant::new("coordinates", &attitude.coordinates, true),
            Constant::new("constraint", &attitude.body, false),
        ],
        ItemKind::Observe(list) => list
            .iter()
            .map(|observe| match observe {
                Observe::Known(name) => Constant::new("observe", name, false),
                Observe::New(head, _) => Constant::of("observe", head),
            })
            .collect(),
        ItemKind::Kinetic(item) => energy("kinetic", item),
        ItemKind::Potential(item) => energy("potential", item),
        ItemKind::Constraint(item) => vec![Constant::of("constraint", &item.head)],
        ItemKind::Contact(item) => vec![Constant::of("contact", &item.head)],
        ItemKind::Friction(item) => vec![Constant::of("friction", &item.head)],
        ItemKind::Force(item) => vec![Constant::of("force", &item.head)],
        ItemKind::Dissipation(item) => vec![Constant::of("dissipation", &item.head)],
        ItemKind::Start(item) => vec![Constant::of("start", &item.head)],
        ItemKind::Stop(item) => vec![Constant::of("stop", &item.head)],
        ItemKind::Mark(item) => vec![Constant::of("mark", &item.head)],
        ItemKind::Define(_)
        | ItemKind::Lagrangian(_)
        | ItemKind::Impacts(_)
        | ItemKind::Emit(_)
        | ItemKind::Check(_)
        | ItemKind::Draw(_) => Vec::new(),
    }
}

/// That of an energy, if it has a name.
fn energy<'a>(keyword: &str, energy: &'a Energy) -> Vec<Constant<'a>> {
    let head = energy.head.iter();
    head.map(|head| Constant::of(keyword, head)).collect()
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
