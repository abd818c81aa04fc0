//! Modes in few words: what many contacts or frictions have in common is said once.

use lagrange_core::mode::{Direction, FrictionMode, Mode};
use lagrange_core::system::Description;

/// So many of a kind that do the same are told together.
const MANY: usize = 3;

/// `rim closed, grip sticks`, and of many `all 4 closed, a and b stick, the other 2 slip`.
pub(crate) fn brief(mode: &Mode, description: &Description) -> String {
    let contacts = description.contacts.iter().zip(&mode.contacts);
    let contacts = contacts.map(|(contact, closed)| match closed {
        true => (contact.name, ["closed", "closed"]),
        false => (contact.name, ["open", "open"]),
    });
    let frictions = description.frictions.iter().zip(&mode.frictions);
    let frictions = frictions.filter_map(|(friction, state)| {
        let verbs = match state {
            FrictionMode::Inactive => return None,
            FrictionMode::Stick => ["sticks", "stick"],
            FrictionMode::Slip(sliding) => match sliding.direction {
                Direction::Fixed([s, 0.0]) if s > 0.0 => ["slips forward", "slip forward"],
                Direction::Fixed([s, 0.0]) if s < 0.0 => ["slips backward", "slip backward"],
                _ => ["slips", "slip"],
            },
        };
        Some((friction.name, verbs))
    });
    let mut told = together(&contacts.collect::<Vec<_>>(), "contacts");
    told.extend(together(&frictions.collect::<Vec<_>>(), "frictions"));
    told.extend(mode.sides(description).map(str::to_owned));
    match told.is_empty() {
        true => "smooth".to_owned(),
        false => told.join(", "),
    }
}

/// Names of one kind with what each does: singular and plural.
fn together(items: &[(&str, [&'static str; 2])], kind: &str) -> Vec<String> {
    let mut verbs: Vec<[&str; 2]> = Vec::new();
    for (_, verb) in items {
        if !verbs.contains(verb) {
            verbs.push(*verb);
        }
    }
    let say = |[one, several]: &[&str; 2]| {
        let names: Vec<&str> = items
            .iter()
            .filter(|(_, [verb, _])| verb == one)
            .map(|(name, _)| *name)
            .collect();
        match names.as_slice() {
            all if all.len() == items.len() && all.len() >= MANY => {
                format!("all {} {kind} {several}", all.len())
            }
            many if many.len() > MANY => {
                format!("{} of {} {kind} {several}", many.len(), items.len())
            }
            [name] => format!("{name} {one}"),
            [first @ .., last] => format!("{} and {last} {several}", first.join(", ")),
            [] => String::new(),
        }
    };
    verbs.iter().map(say).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_are_told_together() {
        let say = |list: &[(&str, &'static str)]| {
            let items: Vec<(&str, [&'static str; 2])> = list
                .iter()
                .map(|(name, verb)| (*name, [*verb, *verb]))
                .collect();
            together(&items, "contacts").join(", ")
        };
        assert_eq!(say(&[("rim", "closed")]), "rim closed");
        assert_eq!(say(&[("a", "open"), ("b", "open")]), "a and b open");
        let legs = [
            ("a", "closed"),
            ("b", "closed"),
            ("c", "closed"),
            ("d", "open"),
        ];
        assert_eq!(say(&legs[..3]), "all 3 contacts closed");
        assert_eq!(say(&legs), "a, b and c closed, d open");
    }
}
