//! Which modes there are, which of them are shown, and what they are called.

use super::work::Work;
use crate::model::{Normal, System};
use std::fmt;

/// Of more modes only those with no contact closed, one, or all are shown.
const MOST_SHOWN: u128 = 24;

/// How a friction acts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum State {
    /// Its contact is open.
    Inactive,
    Sticks,
    Forward,
    Backward,
    /// Two components: in any direction.
    Slips,
}

impl State {
    /// As the program says it.
    pub fn verb(self) -> &'static str {
        match self {
            State::Inactive => "",
            State::Sticks => "sticks",
            State::Forward => "slips forward",
            State::Backward => "slips backward",
            State::Slips => "slips",
        }
    }
}

/// Which contacts are closed, and how each friction acts.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Choice {
    pub contacts: Vec<bool>,
    pub frictions: Vec<State>,
}

/// Modes to show, and how many there are.
pub(super) struct Chosen {
    pub shown: Vec<Choice>,
    pub count: u128,
}

/// No mode is called so.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct UnknownMode {
    /// As asked for.
    pub name: String,
    /// Modes that exist; not all if there are many.
    pub known: Vec<String>,
}

impl fmt::Display for UnknownMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no mode is called `{}`; there are: ", self.name)?;
        let known: Vec<String> = self.known.iter().map(|k| format!("`{k}`")).collect();
        f.write_str(&known.join(", "))
    }
}

impl std::error::Error for UnknownMode {}

/// States of a friction while it can act.
pub(super) fn states(system: &System, friction: usize) -> &'static [State] {
    match system.frictions[friction].slip.len() {
        1 => &[State::Sticks, State::Forward, State::Backward],
        _ => &[State::Sticks, State::Slips],
    }
}

/// Whether a friction can act while these contacts are closed.
pub(super) fn acts(system: &System, friction: usize, contacts: &[bool]) -> bool {
    match system.frictions[friction].normal {
        Normal::Contact(contact) => contacts[contact],
        _ => true,
    }
}

/// All modes or, where they are many, some; or the one that is asked for.
pub(super) fn choose(work: &Work, mode: Option<&str>) -> Result<Chosen, UnknownMode> {
    let system = work.system();
    let count = count(system);
    let contacts = system.contacts.len();
    let mut shown = Vec::new();
    if count <= MOST_SHOWN {
        for bits in 0..1_usize << contacts {
            let closed = (0..contacts).map(|i| bits >> i & 1 == 1).collect();
            with_frictions(system, closed, usize::MAX, &mut shown);
        }
    } else {
        with_frictions(system, vec![false; contacts], 1, &mut shown);
        for one in Work::shown(contacts) {
            let closed = (0..contacts).map(|i| i == one).collect();
            with_frictions(system, closed, 3, &mut shown);
        }
        if contacts > 1 {
            with_frictions(system, vec![true; contacts], 1, &mut shown);
        }
    }
    let Some(asked) = mode else {
        return Ok(Chosen { shown, count });
    };
    match find(system, asked) {
        Some(choice) => Ok(Chosen {
            shown: vec![choice],
            count,
        }),
        None => Err(UnknownMode {
            name: asked.to_owned(),
            known: shown.iter().map(|choice| name(system, choice)).collect(),
        }),
    }
}

/// All states of the frictions beside these contacts; frictions have only their first state once there are so many.
fn with_frictions(system: &System, contacts: Vec<bool>, most: usize, shown: &mut Vec<Choice>) {
    let mut list: Vec<Vec<State>> = vec![Vec::new()];
    for friction in 0..system.frictions.len() {
        let states = match acts(system, friction, &contacts) {
            true => states(system, friction),
            false => &[State::Inactive],
        };
        let states = match list.len() * states.len() <= most {
            true => states,
            false => &states[..1],
        };
        list = list
            .iter()
            .flat_map(|before| states.iter().map(|&s| [before.as_slice(), &[s]].concat()))
            .collect();
    }
    shown.extend(list.into_iter().map(|frictions| Choice {
        contacts: contacts.clone(),
        frictions,
    }));
}

/// How many modes there are.
fn count(system: &System) -> u128 {
    let mut count: u128 = 1;
    for contact in 0..system.contacts.len() {
        let own = (0..system.frictions.len())
            .filter(|&f| matches!(system.frictions[f].normal, Normal::Contact(c) if c == contact));
        let closed: u128 = own.map(|f| states(system, f).len() as u128).product();
        count = count.saturating_mul(1 + closed);
    }
    for friction in 0..system.frictions.len() {
        if !matches!(system.frictions[friction].normal, Normal::Contact(_)) {
            count = count.saturating_mul(states(system, friction).len() as u128);
        }
    }
    count
}

/// The mode called so: `rim closed, grip sticks`; open contacts need not be named.
fn find(system: &System, text: &str) -> Option<Choice> {
    let clauses: Vec<String> = text
        .split(',')
        .map(|clause| clause.split_whitespace().collect::<Vec<_>>().join(" "))
        .filter(|clause| !clause.is_empty() && clause != "smooth")
        .collect();
    let mut used = 0;
    let mut said = |item: &str, verb: &str| {
        let found = clauses
            .iter()
            .any(|clause| *clause == format!("{item} {verb}"));
        used += usize::from(found);
        found
    };
    let mut contacts = Vec::new();
    for contact in &system.contacts {
        let closed = said(&contact.name.text, "closed");
        if said(&contact.name.text, "open") && closed {
            return None;
        }
        contacts.push(closed);
    }
    let mut frictions = Vec::new();
    for (i, friction) in system.frictions.iter().enumerate() {
        let mut state = State::Inactive;
        for &candidate in states(system, i) {
            if said(&friction.name.text, candidate.verb()) {
                if state != State::Inactive || !acts(system, i, &contacts) {
                    return None;
                }
                state = candidate;
            }
        }
        if state == State::Inactive && acts(system, i, &contacts) {
            return None;
        }
        frictions.push(state);
    }
    (used == clauses.len()).then_some(Choice {
        contacts,
        frictions,
    })
}

/// The mode in words, as the program says them.
pub(super) fn name(system: &System, choice: &Choice) -> String {
    let mut words = Vec::new();
    for (contact, closed) in system.contacts.iter().zip(&choice.contacts) {
        let verb = if *closed { "closed" } else { "open" };
        words.push(format!("{} {verb}", contact.name.text));
    }
    for (friction, state) in system.frictions.iter().zip(&choice.frictions) {
        if *state != State::Inactive {
            words.push(format!("{} {}", friction.name.text, state.verb()));
        }
    }
    match words.is_empty() {
        true => "smooth".to_owned(),
        false => words.join(", "),
    }
}
