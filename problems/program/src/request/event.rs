//! Which event is meant: `rim lost`, or `floor impact 2` for the second one.

use super::Refusal;
use crate::names::{is_element, nearest};
use lagrange_core::prelude::*;
use lagrange_core::system::Description;

/// Kinds of events, as a user writes them.
const KINDS: [EventKind; 10] = [
    EventKind::Lost,
    EventKind::Closed,
    EventKind::Impact,
    EventKind::Accumulates { impacts: 0 },
    EventKind::Slips,
    EventKind::Sticks,
    EventKind::Reverses,
    EventKind::Branches,
    EventKind::Stop,
    EventKind::Mark,
];

/// Words for a kind of event that nobody has to know is called otherwise.
const OTHERWISE: [(&str, &[&str]); 6] = [
    (
        "impact",
        &["hit", "hits", "strikes", "bounce", "bounces", "collision"],
    ),
    (
        "lost",
        &["open", "opens", "leaves", "left", "lift", "lifts", "parts"],
    ),
    ("closed", &["close", "closes", "touch", "touches", "lands"]),
    ("slips", &["slide", "slides", "sliding", "moves"]),
    ("sticks", &["stop", "stops", "rests", "holds", "grips"]),
    ("reverses", &["turns", "reversal", "backward"]),
];

/// Of what there are events.
fn subjects(d: &Description) -> impl Iterator<Item = Subject> {
    (0..d.contacts.len())
        .map(Subject::Contact)
        .chain((0..d.frictions.len()).map(Subject::Friction))
        .chain((0..d.stops.len()).map(Subject::Stop))
        .chain((0..d.marks.len()).map(Subject::Mark))
}

/// What [`event`] names; of an array, the event of each element.
pub(crate) fn events(
    text: &str,
    description: &'static Description,
) -> Result<Vec<(Subject, EventKind, usize)>, Refusal> {
    let item = text.split_whitespace().next().unwrap_or_default();
    let names = subjects(description).map(|subject| subject.name(description));
    let elements: Vec<&str> = names.filter(|name| is_element(name, item)).collect();
    match elements.as_slice() {
        [] => event(text, description).map(|one| vec![one]),
        elements => elements
            .iter()
            .map(|element| event(&text.replacen(item, element, 1), description))
            .collect(),
    }
}

/// What `item kind` or `item kind 2` names: an item, what happens to it, and which of these events it is, counted from 1.
pub(crate) fn event(
    text: &str,
    description: &'static Description,
) -> Result<(Subject, EventKind, usize), Refusal> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let (item, kind, number) = match words[..] {
        [item] => (item, "", Some(1)),
        [item, kind] => (item, kind, Some(1)),
        [item, kind, number] => (item, kind, number.parse().ok().filter(|n| *n > 0)),
        _ => (text, "", None),
    };
    let d = description;
    let names = || subjects(d).map(|subject| subject.name(d));
    let subject = subjects(d).find(|subject| subject.name(d) == item);
    let subject = subject
        .ok_or_else(|| Refusal::unknown("contact, friction, stop or mark", item, names()))?;
    let kinds = || KINDS.iter().filter(|kind| kind.happens_to(subject));
    let found = match kind {
        // A stop or a mark has one kind of event only.
        "" if kinds().count() == 1 => kinds().next(),
        _ => kinds().find(|known| known.word() == kind),
    };
    let kind = *found.ok_or_else(|| {
        let words: Vec<&str> = kinds().map(|kind| kind.word()).collect();
        let meant = OTHERWISE.iter().find(|(_, others)| others.contains(&kind));
        let meant = meant.map(|(word, _)| *word);
        // The words are compared by themselves: beside a long name every kind would be near.
        let meant = meant.filter(|word| words.contains(word));
        let meant = meant.or_else(|| nearest(kind, &words));
        Refusal::Unknown {
            what: "event",
            name: text.to_owned(),
            nearest: meant.map(|word| format!("{item} {word}")),
            known: words.iter().map(|word| format!("{item} {word}")).collect(),
        }
    })?;
    let number = number.ok_or_else(|| Refusal::EventNumber {
        event: text.to_owned(),
        second: format!("{item} {} 2", kind.word()),
    })?;
    Ok((subject, kind, number))
}

#[cfg(test)]
mod tests {
    use super::{event, events};

    #[test]
    fn events_of_an_array_are_those_of_its_elements() {
        let declared = "coordinates(y), kinetic = der(y)^2, contact(step[k in 0..3]: y >= k - 2), contact(top: y <= 9)";
        let scene = crate::file::scene("steps.lagrange", declared).expect("a declaration");
        let d = scene.description();
        let of = |text: &str| events(text, d).map(|all| all.len());
        assert_eq!(of("step impact"), Ok(3));
        assert_eq!(of("step[1] impact"), Ok(1));
        assert_eq!(of("top impact 2"), Ok(1));
        let refusal = events("step hits", d).expect_err("a mistake").to_string();
        assert!(
            refusal.contains("did you mean `step[0] impact`?"),
            "{refusal}"
        );
    }

    #[test]
    fn an_event_in_other_words_is_recognised() {
        let declared =
            "coordinates(x, y), kinetic = der(x)^2 + der(y)^2, contact(right: x <= 1), stop(end: x <= -1),
            friction(rub on right: slip = der(y), static = 1), start(a: x = 0),";
        let scene = crate::file::scene("walls.lagrange", declared).expect("a declaration");
        for (said, answer) in [
            ("right hit", "did you mean `right impact`?"),
            ("right lots", "did you mean `right lost`?"),
            ("right opens", "did you mean `right lost`?"),
            ("rub stops", "did you mean `rub sticks`?"),
            ("end hit", "there are: end stop"),
            (
                "right xyz",
                "there are: right lost, right closed, right impact",
            ),
            ("right lost 0", "`right lost 2` is the second"),
            ("right lost two", "`right lost 2` is the second"),
        ] {
            let refusal = event(said, scene.description()).expect_err(said);
            assert!(refusal.to_string().contains(answer), "{refusal}");
        }
    }
}
