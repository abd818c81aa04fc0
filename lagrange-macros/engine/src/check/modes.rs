//! Conditions → modes: a check holds in every mode that its conditions leave open.
//!
//! What is not named may be either: an unnamed contact open or closed, the friction of a closed contact sticking or
//! slipping, to either side. `sticks(f)` and `slips(f)` close the contact of f.

use super::mechanics::Mechanics;
use crate::model::{Condition, Normal};

/// More modes than these are not looked through.
pub(super) const MOST_MODES: usize = 256;

/// State of a friction.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Grip {
    /// Its contact is open.
    Inactive,
    /// It sticks.
    Sticks,
    /// It slips, with one component forward (or in any direction in space) or backward.
    Slips { forward: bool },
}

/// State of all contacts and frictions.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Mode {
    pub closed: Vec<bool>,
    pub grips: Vec<Grip>,
    /// Sign of the force of each constraint that carries a slipping friction, the others true.
    pub positive: Vec<bool>,
}

/// All modes that conditions leave open; Err with their number if there are too many.
pub(super) fn modes(mechanics: &Mechanics, conditions: &[Condition]) -> Result<Vec<Mode>, f64> {
    let contact_of = |friction: usize| match mechanics.frictions[friction].normal {
        Normal::Contact(contact) => Some(contact),
        Normal::Constraint(constraint) => mechanics.while_contact[constraint],
        Normal::Given(_) => None,
    };
    let mut contacts: Vec<Vec<bool>> = vec![vec![false, true]; mechanics.contacts.len()];
    let mut grips: Vec<[bool; 2]> = vec![[true, true]; mechanics.frictions.len()];
    for &condition in conditions {
        match condition {
            Condition::Closed(i) => contacts[i].retain(|&closed| closed),
            Condition::Open(i) => contacts[i].retain(|&closed| !closed),
            Condition::Sticks(f) | Condition::Slips(f) => {
                let sticks = matches!(condition, Condition::Sticks(_));
                grips[f][usize::from(sticks)] = false;
                if let Some(contact) = contact_of(f) {
                    contacts[contact].retain(|&closed| closed);
                }
            }
        }
    }
    let estimate = contacts.iter().map(|c| c.len() as f64).product::<f64>();
    if estimate > MOST_MODES as f64 {
        return Err(estimate);
    }
    let mut all = vec![Mode {
        closed: Vec::new(),
        grips: Vec::new(),
        positive: vec![true; mechanics.constraints],
    }];
    for choices in &contacts {
        all = product(&all, choices, |mode, &closed| mode.closed.push(closed));
    }
    for (f, &[sticks, slips]) in grips.iter().enumerate() {
        let mut next = Vec::new();
        for mode in &all {
            let mut choices = Vec::new();
            if contact_of(f).is_some_and(|contact| !mode.closed[contact]) {
                choices.push(Grip::Inactive);
            } else {
                let sides: &[bool] = match mechanics.frictions[f].rows.len() {
                    1 => &[true, false],
                    _ => &[true],
                };
                choices.extend(sticks.then_some(Grip::Sticks));
                let sides = sides.iter().filter(|_| slips);
                choices.extend(sides.map(|&forward| Grip::Slips { forward }));
            }
            next.extend(product(
                std::slice::from_ref(mode),
                &choices,
                |mode, &grip| {
                    mode.grips.push(grip);
                },
            ));
        }
        all = next;
        if all.len() > MOST_MODES {
            return Err(all.len() as f64);
        }
    }
    for (f, friction) in mechanics.frictions.iter().enumerate() {
        if let Normal::Constraint(constraint) = friction.normal {
            let (slipping, rest): (Vec<Mode>, Vec<Mode>) = all
                .into_iter()
                .partition(|mode| matches!(mode.grips[f], Grip::Slips { .. }));
            all = rest;
            all.extend(product(&slipping, &[true, false], |mode, &positive| {
                mode.positive[constraint] = positive;
            }));
        }
    }
    Ok(all)
}

fn product<T>(modes: &[Mode], choices: &[T], apply: impl Fn(&mut Mode, &T)) -> Vec<Mode> {
    let mut all = Vec::new();
    for mode in modes {
        for choice in choices {
            let mut mode = mode.clone();
            apply(&mut mode, choice);
            all.push(mode);
        }
    }
    all
}

impl Mode {
    /// Rows that hold as equations.
    pub fn active(&self, mechanics: &Mechanics) -> Vec<usize> {
        let mut active: Vec<usize> = (0..mechanics.constraints)
            .filter(|&i| mechanics.while_contact[i].is_none_or(|contact| self.closed[contact]))
            .collect();
        let closed = self
            .closed
            .iter()
            .enumerate()
            .filter(|(_, closed)| **closed);
        active.extend(closed.map(|(i, _)| mechanics.constraints + i));
        for (friction, grip) in mechanics.frictions.iter().zip(&self.grips) {
            if *grip == Grip::Sticks {
                active.extend(&friction.rows);
            }
        }
        active
    }

    /// `rim closed, grip slips forward`, or nothing where there are no contacts and frictions.
    pub fn describe(&self, mechanics: &Mechanics) -> String {
        let mut parts = Vec::new();
        for (i, &closed) in self.closed.iter().enumerate() {
            let name = &mechanics.rows[mechanics.constraints + i].name;
            parts.push(format!("{name} {}", if closed { "closed" } else { "open" }));
        }
        for (friction, grip) in mechanics.frictions.iter().zip(&self.grips) {
            let name = &mechanics.rows[friction.rows[0]].name;
            match grip {
                Grip::Inactive => {}
                Grip::Sticks => parts.push(format!("{name} sticks")),
                Grip::Slips { .. } if friction.rows.len() > 1 => {
                    parts.push(format!("{name} slips"));
                }
                Grip::Slips { forward: true } => parts.push(format!("{name} slips forward")),
                Grip::Slips { forward: false } => parts.push(format!("{name} slips backward")),
            }
        }
        parts.join(", ")
    }
}
