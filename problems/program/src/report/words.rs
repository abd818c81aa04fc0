//! Modes in few words: what many contacts or frictions have in common is said once, and of many conditions those that tell modes apart.

use crate::outcome::Outcome;
use lagrange_core::mode::{Direction, FrictionMode, Mode};
use lagrange_core::system::Description;
use std::collections::BTreeSet;

/// So many of a kind that do the same are told together.
pub(super) const MANY: usize = 3;

/// In a table, so many events of an instant, and sides of branches, are told one by one.
pub(super) const FEW: usize = 4;

/// A name with what it does: singular and plural.
type Doing = (&'static str, [&'static str; 2]);

/// What modes are called that are told of together: `rim closed, grip sticks`, and of many `all 4 closed, a and b stick, the other 2 slip`.
/// No two of them are called alike because they differ in a condition.
pub(crate) struct Names {
    description: &'static Description,
    /// The conditions that hold in the modes: all lists that occur.
    known: Vec<Vec<&'static str>>,
}

impl Names {
    /// Of these modes.
    pub fn new<'a>(
        description: &'static Description,
        modes: impl IntoIterator<Item = &'a Mode>,
    ) -> Self {
        let mut known = Vec::new();
        for mode in modes {
            let sides = mode.sides(description).collect();
            if !known.contains(&sides) {
                known.push(sides);
            }
        }
        Self { description, known }
    }

    /// Of the modes of a run, and of other runs of its scene that are seen beside it.
    pub fn of<'a>(outcome: &'a Outcome, beside: impl IntoIterator<Item = &'a Outcome>) -> Self {
        let same = |other: &&Outcome| core::ptr::eq(other.description, outcome.description);
        let runs = beside.into_iter().filter(same).chain([outcome]);
        let modes = runs.flat_map(|run| {
            let events = run.events.iter();
            let around = events.flat_map(|event| [&event.before, &event.after]);
            run.phases.iter().map(|phase| &phase.mode).chain(around)
        });
        Self::new(outcome.description, modes)
    }

    /// What one of them is called.
    pub fn brief(&self, mode: &Mode) -> String {
        let description = self.description;
        let (contacts, frictions) = (contacts(mode, description), frictions(mode, description));
        let mut said = together(&contacts, "contacts", contacts.len());
        said.extend(together(&frictions, "frictions", frictions.len()));
        let sides: Vec<&str> = mode.sides(description).collect();
        said.extend(some(&sides, &self.own(&sides)));
        joined(&said)
    }

    /// Which of many conditions say in which mode they all hold. Each that is taken excludes most of the other modes.
    fn own(&self, sides: &[&str]) -> Vec<usize> {
        let mut others: Vec<&Vec<&str>> = self.known.iter().collect();
        let mut own = Vec::new();
        loop {
            let excluded = |&place: &usize| {
                let others = others.iter();
                others.filter(|other| other[place] != sides[place]).count()
            };
            let best = (0..sides.len()).rev().max_by_key(excluded);
            let Some(place) = best.filter(|place| excluded(place) > 0) else {
                break;
            };
            others.retain(|other| other[place] == sides[place]);
            own.push(place);
        }
        own.sort_unstable();
        own
    }
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
    let other = after.sides(description);
    let other: Vec<&str> = other.filter(|side| !sides.contains(side)).collect();
    told.extend(some(&other, &[]));
    (!told.is_empty()).then(|| told.join(", "))
}

/// Conditions that hold: of many those at these places, or the first ones where these are none.
fn some(sides: &[&str], own: &[usize]) -> Vec<String> {
    let every = (0..sides.len()).collect::<Vec<_>>();
    let told = match own {
        _ if sides.len() <= FEW.max(own.len() + 1) => &every,
        [] => &every[..MANY],
        own => own,
    };
    let mut some: Vec<String> = told.iter().map(|&place| sides[place].to_owned()).collect();
    if sides.len() > told.len() {
        some.push(format!("{} more conditions", sides.len() - told.len()));
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
    use crate::request::Request;

    /// A body passes eight steps, one after the other; where it is between two of them, two conditions say it.
    #[test]
    fn modes_of_many_conditions_have_different_names() {
        let declared = "coordinates(x, y), kinetic = (der(x)^2 + der(y)^2) / 2, contact(floor: y >= 0), potential = 10 * y,
            force(steps[k in 0..8]: if(x >= k + 1, 0.1, 0) along der(x)), start(go: x = 0, der(x) = 2), until = 4,";
        let scene = crate::file::scene("steps.lagrange", declared).expect("a declaration");
        let outcome = scene.run(&Request::default()).expect("a run");
        let names = Names::of(&outcome, []);
        let told = outcome.phases.iter().map(|phase| names.brief(&phase.mode));
        let between = (1..8).map(|k| format!("x >= {k}, x < {}, 6 more conditions", k + 1));
        let expected = ["x < 1, 7 more conditions".to_owned()];
        let last = ["x >= 8, 7 more conditions".to_owned()];
        let expected = expected.into_iter().chain(between).chain(last);
        assert_eq!(
            told.collect::<Vec<_>>(),
            expected
                .map(|sides| format!("floor closed, {sides}"))
                .collect::<Vec<_>>()
        );
        let alone = Names::new(outcome.description, [&outcome.phases[0].mode]);
        assert_eq!(
            alone.brief(&outcome.phases[0].mode),
            "floor closed, x < 1, x < 2, x < 3, 5 more conditions"
        );
    }

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
