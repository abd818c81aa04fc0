//! Modes in few words: what many contacts or frictions have in common is said once.

use lagrange_core::mode::{Direction, FrictionMode, Mode};
use lagrange_core::system::Description;
use std::collections::BTreeSet;

/// So many of a kind that do the same are told together.
pub(super) const MANY: usize = 3;

/// In a table, so many events of an instant, and sides of branches, are told one by one.
pub(super) const FEW: usize = 4;

/// A name with what it does: singular and plural.
type Doing = (&'static str, [&'static str; 2]);

/// `rim closed, grip sticks`, and of many `all 4 closed, a and b stick, the other 2 slip`.
pub(crate) fn brief(mode: &Mode, description: &Description) -> String {
    let (contacts, frictions) = (contacts(mode, description), frictions(mode, description));
    let mut told = together(&contacts, "contacts", contacts.len());
    told.extend(together(&frictions, "frictions", frictions.len()));
    told.extend(some(mode.sides(description).collect()));
    joined(&told)
}

/// What a mode does that the one before it did not; `None` where they are the same.
pub(super) fn changed(before: &Mode, after: &Mode, description: &Description) -> Option<String> {
    if before == after {
        return None;
    }
    let new = |now: Vec<Doing>, then: Vec<Doing>, kind| {
        let all = now.len();
        let new: Vec<Doing> = now.into_iter().filter(|one| !then.contains(one)).collect();
        together(&new, kind, all)
    };
    let of_contacts = [after, before].map(|mode| contacts(mode, description));
    let of_frictions = [after, before].map(|mode| frictions(mode, description));
    let ([now, then], [rubs, rubbed]) = (of_contacts, of_frictions);
    let mut told = new(now, then, "contacts");
    told.extend(new(rubs, rubbed, "frictions"));
    let sides: BTreeSet<&str> = before.sides(description).collect();
    let other = after
        .sides(description)
        .filter(|side| !sides.contains(side));
    told.extend(some(other.collect()));
    (!told.is_empty()).then(|| told.join(", "))
}

/// Conditions that hold, of many the first ones.
fn some(sides: Vec<&str>) -> Vec<String> {
    let told = match sides.len() > FEW {
        true => MANY,
        false => sides.len(),
    };
    let mut some: Vec<String> = sides[..told].iter().map(|&side| side.to_owned()).collect();
    if sides.len() > told {
        some.push(format!("{} more conditions", sides.len() - told));
    }
    some
}

/// The name of a mode in which nothing is closed, open, sticks or slips.
pub(super) const SMOOTH: &str = "smooth";

fn joined(told: &[String]) -> String {
    match told.is_empty() {
        true => SMOOTH.to_owned(),
        false => told.join(", "),
    }
}

fn contacts(mode: &Mode, description: &Description) -> Vec<Doing> {
    let contacts = description.contacts.iter().zip(&mode.contacts);
    let contacts = contacts.map(|(contact, closed)| match closed {
        true => (contact.name, ["closed", "closed"]),
        false => (contact.name, ["open", "open"]),
    });
    contacts.collect()
}

/// The frictions that act.
fn frictions(mode: &Mode, description: &Description) -> Vec<Doing> {
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
    frictions.collect()
}

/// Names of one kind, of which there are so many in all, with what each does: singular and plural.
fn together(items: &[(&str, [&'static str; 2])], kind: &str, count: usize) -> Vec<String> {
    let mut verbs: Vec<[&str; 2]> = Vec::new();
    for (_, verb) in items {
        if !verbs.contains(verb) {
            verbs.push(*verb);
        }
    }
    let groups = verbs.iter().map(|[one, several]| {
        let names = items.iter().filter(|(_, [verb, _])| verb == one);
        let names: Vec<&str> = names.map(|(name, _)| *name).collect();
        (names, *one, *several)
    });
    let groups: Vec<(Vec<&str>, &str, &str)> = groups.collect();
    // With all but the names of one group, no two modes are called alike.
    let most = groups.iter().map(|(names, ..)| names.len()).max();
    let untold = groups
        .iter()
        .position(|(names, ..)| Some(names.len()) == most);
    let say = |(i, (names, one, several)): (usize, &(Vec<&str>, &str, &str))| match names.as_slice()
    {
        all if all.len() == count && all.len() >= MANY => {
            format!("all {} {kind} {several}", all.len())
        }
        many if many.len() > MANY && Some(i) == untold => {
            format!("{} of {count} {kind} {several}", many.len())
        }
        many if many.len() > MANY => format!("{} {several}", ranges(many)),
        [name] => format!("{name} {one}"),
        [first @ .., last] => format!("{} and {last} {several}", first.join(", ")),
        [] => String::new(),
    };
    groups.iter().enumerate().map(say).collect()
}

/// Names of which those that follow each other in an array are told as a range: `floor[2..6], hit[0]`.
fn ranges(names: &[&str]) -> String {
    let place = |name: &str| {
        let (array, index) = name.strip_suffix(']')?.rsplit_once('[')?;
        Some((array.to_owned(), index.parse::<usize>().ok()?))
    };
    let next = |name: &str| place(name).map(|(array, index)| (array, index + 1));
    let runs = names.chunk_by(|a, b| place(b).is_some() && next(a) == place(b));
    let told = runs.map(|run| match place(run[0]) {
        Some((array, first)) if run.len() > 2 => format!("{array}[{first}..{}]", first + run.len()),
        _ => run.join(", "),
    });
    told.collect::<Vec<_>>().join(", ")
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
            together(&items, "contacts", 4.min(items.len())).join(", ")
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

    #[test]
    fn modes_of_many_contacts_have_different_names() {
        let names: Vec<String> = (0..12).map(|k| format!("hit[{k}]")).collect();
        let say = |closed: &[usize]| {
            let doing = |(k, name)| match closed.contains(&k) {
                true => (name, ["closed", "closed"]),
                false => (name, ["open", "open"]),
            };
            let items = names.iter().map(String::as_str).enumerate().map(doing);
            together(&items.collect::<Vec<_>>(), "contacts", 12).join(", ")
        };
        assert_eq!(
            say(&[0, 3, 4, 5]),
            "hit[0], hit[3..6] closed, 8 of 12 contacts open"
        );
        assert_eq!(
            say(&[3, 4, 5, 6]),
            "8 of 12 contacts open, hit[3..7] closed"
        );
    }
}
