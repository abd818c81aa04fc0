//! Items of the declaration, as written, in order.

use super::formula::{Formula, Relation, Statement};
use super::letter::Letter;
use super::names::Names;
use super::{Item, Part};
use crate::ast::{
    Action, Check, Claim, Clause, Contact, Coordinate, Declaration, Element, Expr, Friction,
    FrictionLaw, Head, Impacts, Index, ItemKind, ModeWord, Observe, Premise, Reference,
    Restitution, Start, StartQuantity, Trigger, Watch,
};

/// All items that say something about the system.
pub(super) fn items(declaration: &Declaration, names: &Names) -> Vec<Item> {
    let mut items = Vec::new();
    for item in &declaration.items {
        written(&item.kind, names, &mut items);
    }
    items
}

fn written(kind: &ItemKind, names: &Names, items: &mut Vec<Item>) {
    let mut add = |keyword, name: String, parts| {
        items.push(Item {
            keyword,
            name,
            parts,
        })
    };
    let formula = |e| Part::Formula(names.written(e));
    let unnamed = String::new;
    match kind {
        ItemKind::Coordinates(list) => add("coordinates", unnamed(), coordinates(list, names)),
        ItemKind::Define(definitions) => {
            for definition in definitions {
                let defined = equal(&definition.head, &definition.value, names);
                add("define", range(&definition.head.index), vec![defined]);
            }
        }
        ItemKind::Kinetic(term) => add("kinetic", name(&term.head), vec![formula(&term.value)]),
        ItemKind::Potential(term) => {
            add("potential", name(&term.head), vec![formula(&term.value)]);
        }
        ItemKind::Lagrangian(value) => add("lagrangian", unnamed(), vec![formula(value)]),
        ItemKind::Constraint(item) => {
            let sides = (names.written(&item.left), names.written(&item.right));
            let parts = vec![Part::Statement(Statement::equal(sides.0, sides.1))];
            let contact = item.while_contact.as_ref();
            let condition = contact.map(|(_, contact)| format!(" while {}", referred(contact)));
            let title = head_name(&item.head) + &condition.unwrap_or_default();
            add("constraint", title, parts);
        }
        ItemKind::Contact(item) => add("contact", head_name(&item.head), contact(item, names)),
        ItemKind::Friction(item) => {
            let on: Vec<String> = item.on.iter().map(referred).collect();
            let on = match on.as_slice() {
                [] => String::new(),
                [one] => format!(" on {one}"),
                many => format!(" on ({})", many.join(", ")),
            };
            let title = head_name(&item.head) + &on;
            add("friction", title, friction(item, names));
        }
        ItemKind::Force(force) => {
            add(
                "force",
                head_name(&force.head),
                action(&force.action, names),
            );
        }
        ItemKind::Dissipation(item) => {
            let parts = vec![formula(&item.value)];
            add("dissipation", head_name(&item.head), parts);
        }
        ItemKind::Start(item) => add("start", head_name(&item.head), start(item, names)),
        ItemKind::Observe(observes) => {
            let parts = observes.iter().map(|observe| match observe {
                Observe::Known(name) => Part::Formula(Formula::Letter(names.declared(&name.text))),
                Observe::New(head, value) => equal(head, value, names),
            });
            add("observe", unnamed(), parts.collect());
        }
        ItemKind::Stop(watch) => add("stop", head_name(&watch.head), trigger(watch, names)),
        ItemKind::Mark(watch) => add("mark", head_name(&watch.head), trigger(watch, names)),
        ItemKind::Attitude(attitude) => {
            let quaternion = Formula::Letter(Letter::new(&attitude.coordinates.text));
            let body = attitude.body.text.clone();
            add("attitude", body, vec![Part::Formula(quaternion)]);
        }
        ItemKind::Check(check) => add("check", name(&check.head), claim(check, names)),
        ItemKind::Impacts(Impacts::InTurn) => add("impacts", unnamed(), vec![word("in turn")]),
        // What is drawn says nothing of the motion.
        ItemKind::Impacts(Impacts::Together) | ItemKind::Emit(_) | ItemKind::Draw(_) => {}
    }
}

fn word(text: &str) -> Part {
    Part::Word(text.to_owned())
}

/// name = value
fn equal(head: &Head, value: &Expr, names: &Names) -> Part {
    let letter = Formula::Letter(head_letter(head, names));
    Part::Statement(Statement::equal(letter, names.written(value)))
}

/// `x`, or `x₀ … xₙ`
fn coordinates(coordinates: &[Coordinate], names: &Names) -> Vec<Part> {
    let mut parts = Vec::new();
    for coordinate in coordinates {
        let letter = names.declared(&coordinate.name.text);
        let Some(length) = &coordinate.length else {
            parts.push(Part::Formula(Formula::Letter(letter)));
            continue;
        };
        let length = length.to_string();
        let last = match length.parse::<usize>() {
            Ok(count) => count.saturating_sub(1).to_string(),
            Err(_) => format!("{length}-1"),
        };
        parts.push(Part::Formula(Formula::Letter(letter.clone().element("0"))));
        parts.push(word("…"));
        parts.push(Part::Formula(Formula::Letter(letter.element(&last))));
    }
    parts
}

fn action(action: &Action, names: &Names) -> Vec<Part> {
    let formula = |e| Part::Formula(names.written(e));
    match action {
        Action::Generalized(coordinate, value) => {
            let coordinate = Part::Formula(names.reference(coordinate));
            vec![word("on"), coordinate, word(":"), formula(value)]
        }
        Action::At(value, point) => vec![formula(value), word("at"), formula(point)],
        Action::Along(value, speed) => vec![formula(value), word("along"), formula(speed)],
    }
}

fn contact(contact: &Contact, names: &Names) -> Vec<Part> {
    let formula = |e| Part::Formula(names.written(e));
    let mut parts = vec![Part::Statement(names.comparison(&contact.gap))];
    if let Some(point) = &contact.at {
        parts.extend([word("at"), formula(point)]);
    }
    if let Some(region) = &contact.region {
        parts.extend([word("where"), Part::Statement(names.comparison(region))]);
    }
    match &contact.restitution {
        Some(Restitution::Newton(e)) => parts.extend([word("restitution"), formula(e)]),
        Some(Restitution::Poisson(e)) => parts.extend([word("restitution (Poisson)"), formula(e)]),
        None => {}
    }
    parts
}

fn friction(friction: &Friction, names: &Names) -> Vec<Part> {
    let equal = |name: &str, e| {
        Part::Statement(Statement::equal(
            Formula::Letter(Letter::of(name, "")),
            names.written(e),
        ))
    };
    let mut parts = vec![equal("slip", &friction.slip)];
    match &friction.law {
        FrictionLaw::Coefficients {
            normal,
            stick,
            slide,
        } => {
            parts.extend(normal.iter().map(|e| equal("normal", e)));
            parts.push(equal("static", stick));
            parts.extend(slide.iter().map(|e| equal("kinetic", e)));
        }
        FrictionLaw::Limit(limit) => parts.push(equal("limit", limit)),
    }
    parts
}

fn claim(check: &Check, names: &Names) -> Vec<Part> {
    let equal = |a, b| Part::Statement(Statement::equal(names.written(a), names.written(b)));
    let mut parts = match &check.claim {
        Claim::Equal(left, right) => vec![equal(left, right)],
        Claim::Conserved(e) => vec![Part::Formula(names.written(e)), word("conserved")],
    };
    if !check.premises.is_empty() {
        parts.push(word("when"));
    }
    for (i, premise) in check.premises.iter().enumerate() {
        if i > 0 {
            parts.push(word("and"));
        }
        parts.push(match premise {
            Premise::Mode(verb, item) => mode_word(*verb, item),
            Premise::AtLeast(comparison) => Part::Statement(names.comparison(comparison)),
            Premise::Equal(left, right) => equal(left, right),
        });
    }
    parts
}

/// `rim closed`
fn mode_word(word: ModeWord, item: &Reference) -> Part {
    let verb = match word {
        ModeWord::Closed => "closed",
        ModeWord::Open => "open",
        ModeWord::Sticks => "sticks",
        ModeWord::Slips => "slips",
    };
    Part::Word(format!("{} {verb}", referred(item)))
}

/// `rim`, `wall[k]`
fn referred(item: &Reference) -> String {
    match &item.element {
        Some(element) => format!("{}[{element}]", item.name.text),
        None => item.name.text.clone(),
    }
}

fn start(start: &Start, names: &Names) -> Vec<Part> {
    let values = start.values.iter().map(|value| {
        let (letter, rate) = match &value.quantity {
            StartQuantity::Position => (names.declared(&value.name.text), 0),
            StartQuantity::Velocity => (names.declared(&value.name.text), 1),
            StartQuantity::Member(member) => (names.member(&value.name.text, &member.text), 0),
        };
        let letter = match &value.element {
            Element::Whole => letter,
            Element::One(index) => letter.element(&index.to_string()),
            Element::Each(index) => letter.element(&index.name.text),
        };
        Part::Statement(Statement::equal(
            Formula::Letter(letter.rate(rate)),
            names.written(&value.value),
        ))
    });
    values.collect()
}

fn trigger(watch: &Watch, names: &Names) -> Vec<Part> {
    match &watch.trigger {
        Trigger::Zero(value) => vec![Part::Statement(Statement::new(
            names.written(value),
            Relation::Equal,
            Formula::ZERO,
        ))],
        Trigger::All(clauses) => {
            let clause = |clause: &Clause| match clause {
                Clause::Comparison(comparison) => Part::Statement(names.comparison(comparison)),
                Clause::Mode(word, item) => mode_word(*word, item),
            };
            let joined = clauses.iter().enumerate().flat_map(|(i, joined)| {
                let and = (i > 0).then(|| word("and"));
                and.into_iter().chain([clause(joined)])
            });
            joined.collect()
        }
    }
}

fn name(head: &Option<Head>) -> String {
    head.as_ref().map(head_name).unwrap_or_default()
}

fn head_name(head: &Head) -> String {
    match &head.index {
        Some(index) => format!("{}[{}]", head.name.text, span(index)),
        None => head.name.text.clone(),
    }
}

fn head_letter(head: &Head, names: &Names) -> Letter {
    let letter = names.declared(&head.name.text);
    match &head.index {
        Some(index) => letter.element(&index.name.text),
        None => letter,
    }
}

fn range(index: &Option<Index>) -> String {
    index.as_ref().map(span).unwrap_or_default()
}

fn span(index: &Index) -> String {
    format!(
        "{} in {}..{}",
        index.name.text, index.range.from, index.range.to
    )
}
