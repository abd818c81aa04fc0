//! Which parts of the tapes a mode asks for.

use crate::effects::{Effects, Item};
use crate::linear::acts;
use crate::mode::{Direction, FrictionMode, Mode};
use crate::system::{Description, Normal};
use core::ops::Deref;

/// A set of needs; reads as those of a [`Selection`](crate::program::Selection).
#[derive(Debug, Default, Eq)]
pub struct OutputMask {
    words: Vec<u64>,
}

impl PartialEq for OutputMask {
    // A few words are compared sooner than a call of `memcmp` is made.
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.words.iter().eq(&other.words)
    }
}

impl Clone for OutputMask {
    fn clone(&self) -> Self {
        let words = self.words.clone();
        Self { words }
    }

    fn clone_from(&mut self, other: &Self) {
        self.words.clone_from(&other.words);
    }
}

impl Deref for OutputMask {
    type Target = [u64];
    fn deref(&self) -> &[u64] {
        &self.words
    }
}

impl OutputMask {
    /// Only need 0, which is always held.
    pub fn new(description: &Description) -> Self {
        let mut set = Self {
            words: vec![0; description.needs.div_ceil(64).max(1)],
        };
        set.insert(0);
        set
    }

    /// Adds a need.
    #[inline]
    pub fn insert(&mut self, need: usize) {
        self.words[need / 64] |= 1 << (need % 64);
    }

    /// Takes a need out.
    #[inline]
    pub fn remove(&mut self, need: usize) {
        self.words[need / 64] &= !(1 << (need % 64));
    }

    /// Whether the need is held.
    #[inline]
    pub fn contains(&self, need: usize) -> bool {
        self.words[need / 64] >> (need % 64) & 1 == 1
    }

    /// Whether all needs of another set of the same system are held.
    pub(super) fn includes(&self, other: &Self) -> bool {
        let mut words = self.words.iter().zip(&other.words);
        !self.words.is_empty() && words.all(|(word, other)| other & !word == 0)
    }

    /// Takes out all needs, also need 0.
    #[inline]
    pub(super) fn empty(&mut self) {
        self.words.clear();
    }

    /// Adds all needs of another set of the same system.
    pub fn extend(&mut self, other: &[u64]) {
        for (word, other) in self.words.iter_mut().zip(other) {
            *word |= other;
        }
    }

    /// Replaces the words of the set.
    pub(super) fn assign(&mut self, words: impl Iterator<Item = u64>) {
        for (word, new) in self.words.iter_mut().zip(words) {
            *word = new;
        }
    }

    /// Leaves only need 0.
    pub fn clear(&mut self) {
        self.words.fill(0);
        self.insert(0);
    }
}

/// The needs of the effects of a scene: everything but the contributions of what is left out.
pub(super) fn of_effects(description: &Description, effects: &Effects) -> OutputMask {
    let mut needs = OutputMask::new(description);
    needs.words.fill(u64::MAX);
    let spare = needs.words.len() * 64 - description.needs.max(1);
    if let Some(last) = needs.words.last_mut() {
        *last >>= spare;
    }
    // An item of another system is refused when a run begins.
    let d = description;
    let contribution = |item: Item| match item {
        Item::Kinetic(i) => d.kinetic.get(i).map(|energy| energy.need),
        Item::Potential(i) => d.potential.get(i).map(|energy| energy.need),
        Item::Force(i) => d.forces.get(i).map(|force| force.need),
        Item::Dissipation(i) => d.dissipations.get(i).map(|load| load.need),
        _ => None,
    };
    let missing = effects.left_out().filter_map(contribution);
    missing.for_each(|need| needs.remove(need));
    needs.insert(0);
    needs
}

/// The needs of the named energies, without need 0.
pub(super) fn of_energies(description: &Description) -> OutputMask {
    let mut needs = OutputMask::new(description);
    let energies = description.kinetic.iter().chain(description.potential);
    energies.for_each(|energy| needs.insert(energy.need));
    needs.remove(0);
    needs
}

/// What the equations of motion of a mode need: inertia, forces, the rows that act, sliding friction.
pub(super) fn of_motion(description: &Description, effects: &Effects, mode: &Mode) -> OutputMask {
    let mut needs = of_energies_and_forces(description, effects);
    for (i, row) in description.rows.iter().enumerate() {
        if acts(description, effects, mode, i) {
            needs.insert(row.needs.jacobian);
            needs.insert(row.needs.bias);
        }
    }
    for (i, friction) in description.frictions.iter().enumerate() {
        let FrictionMode::Slip(sliding) = mode.frictions[i] else {
            continue;
        };
        if !effects.includes(description, Item::Friction(i)) {
            continue;
        }
        needs.insert(friction.coefficients_need);
        for row in &description.rows[friction.rows()] {
            needs.insert(row.needs.jacobian);
            if !matches!(sliding.direction, Direction::Fixed(_)) {
                needs.insert(row.needs.velocity);
            }
        }
    }
    needs
}

/// What the equations of motion and the guards need in one mode or another of a scene.
fn of_all_modes(description: &Description, effects: &Effects) -> OutputMask {
    let mut needs = of_energies_and_forces(description, effects);
    let mut hold = |item: Item, list: &[usize]| {
        if effects.includes(description, item) {
            list.iter().for_each(|&need| needs.insert(need));
        }
    };
    let of_row = |row: usize| {
        let row = description.rows[row].needs;
        [row.jacobian, row.bias, row.position, row.velocity]
    };
    for (i, constraint) in description.constraints.iter().enumerate() {
        hold(Item::Constraint(i), &of_row(constraint.row));
    }
    for (i, contact) in description.contacts.iter().enumerate() {
        hold(Item::Contact(i), &of_row(contact.row));
    }
    for (i, friction) in description.frictions.iter().enumerate() {
        hold(Item::Friction(i), &[friction.coefficients_need]);
        (friction.rows()).for_each(|row| hold(Item::Friction(i), &of_row(row)));
    }
    add_branch_guards(description, &mut needs);
    needs
}

/// Sums over earlier coefficients for each new one of the Taylor series of the motion and the guards, of all modes of a scene
/// together: what is left out has none.
pub(crate) fn products(description: &Description, effects: &Effects) -> usize {
    description
        .motion
        .products(&of_all_modes(description, effects))
}

/// What a projection needs: inertia, and Jacobian, position and velocity of the rows that act.
pub(super) fn of_rows(description: &Description, effects: &Effects, mode: &Mode) -> OutputMask {
    let mut needs = of_inertia(description, effects);
    for (i, row) in description.rows.iter().enumerate() {
        if acts(description, effects, mode, i) {
            needs.insert(row.needs.jacobian);
            needs.insert(row.needs.velocity);
            if row.position.is_some() {
                needs.insert(row.needs.position);
            }
        }
    }
    needs
}

/// Need 0 and the kinetic energies that act.
fn of_inertia(description: &Description, effects: &Effects) -> OutputMask {
    let mut needs = OutputMask::new(description);
    for (i, effect) in description.kinetic.iter().enumerate() {
        if effects.includes(description, Item::Kinetic(i)) {
            needs.insert(effect.need);
        }
    }
    needs
}

/// Need 0 and the energies, forces and dissipations that act.
fn of_energies_and_forces(description: &Description, effects: &Effects) -> OutputMask {
    let mut needs = of_inertia(description, effects);
    let mut hold = |item: Item, need: usize| {
        if effects.includes(description, item) {
            needs.insert(need);
        }
    };
    for (i, effect) in description.potential.iter().enumerate() {
        hold(Item::Potential(i), effect.need);
    }
    for (i, load) in description.forces.iter().enumerate() {
        hold(Item::Force(i), load.need);
    }
    for (i, load) in description.dissipations.iter().enumerate() {
        hold(Item::Dissipation(i), load.need);
    }
    needs
}

/// What the guards of a mode need beside the equations of motion: the gap of each open contact, the region of each
/// closed one, the coefficients of each friction that sticks, the slip of each that slides, and the guards of the branches
/// that anything held in `needs` uses.
///
/// Pass the needs of the motion in `needs`; the guards are added.
pub fn add_guards(
    description: &Description,
    effects: &Effects,
    mode: &Mode,
    needs: &mut OutputMask,
) {
    for (i, contact) in description.contacts.iter().enumerate() {
        let asks = !mode.contacts[i] || contact.region.is_some();
        if effects.includes(description, Item::Contact(i)) && asks {
            needs.insert(description.rows[contact.row].needs.position);
        }
    }
    for (i, friction) in description.frictions.iter().enumerate() {
        if !effects.includes(description, Item::Friction(i)) {
            continue;
        }
        match mode.frictions[i] {
            FrictionMode::Inactive => {}
            FrictionMode::Stick => {
                needs.insert(friction.coefficients_need);
                if let Normal::Contact(contact) = friction.normal {
                    needs.insert(
                        description.rows[description.contacts[contact].row]
                            .needs
                            .jacobian,
                    );
                }
            }
            FrictionMode::Slip(_) => {
                for row in &description.rows[friction.rows()] {
                    needs.insert(row.needs.velocity);
                }
            }
        }
    }
    add_branch_guards(description, needs);
}

/// The guards of the branches that anything held uses, and of the branches that those guards use.
pub fn add_branch_guards(description: &Description, needs: &mut OutputMask) {
    loop {
        let mut grew = false;
        for branch in description.branches {
            if !needs.contains(branch.need) && branch.users.iter().any(|&user| needs.contains(user))
            {
                needs.insert(branch.need);
                grew = true;
            }
        }
        if !grew {
            return;
        }
    }
}
