//! The declared equations at a state: what balances in every coordinate.

use crate::declaration::{Declaration, Evaluator, Gradient, Inputs, Seed, Worked};
use crate::effects::{Effects, Item};
use crate::error::Level;
use crate::integrate::least_size;
use crate::mode::{FrictionMode, Mode};
use crate::system::Description;
use crate::trajectory::State;
use core::cmp::Ordering;

/// What a condition that vanishes is taken for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Zero {
    /// Zero, for which the declaration says what holds.
    AsDeclared,
    /// What it is where this gap opens.
    AsGapOpens(usize),
    /// Less than zero.
    Below,
}

/// Evaluates the declared quantities with the effects of a run.
#[derive(Debug)]
pub(super) struct Equations {
    pub d: &'static Description,
    pub declaration: &'static Declaration,
    pub effects: Effects,
    /// Per coordinate: the size below which its errors are absolute; empty: 1 for all.
    pub sizes: Vec<f64>,
    /// Values of the parameters.
    pub parameters: Vec<f64>,
    /// Constraints, contacts and frictions.
    pub values: Evaluator,
    /// Everything that balances.
    pub balancing: Evaluator,
    /// Per coordinate: what should vanish.
    pub residual: Vec<f64>,
    /// Per coordinate: the sum of the absolute values of its terms.
    pub size: Vec<f64>,
    /// The largest of [`Self::size`] in the run.
    pub largest: Vec<f64>,
    /// Bound of rounding.
    pub exact: f64,
    /// Per coordinate: its inertia, where that has been measured.
    pub inertia: Vec<f64>,
    /// Per coordinate: accelerations that forces of its size would make, where that has been measured.
    pub swiftness: Vec<f64>,
    /// Per row: the value whose rate its force acts along, and its level.
    rows: Vec<(usize, Level)>,
    seeds: Vec<Seed>,
    /// What the last sweep has found.
    pub gradients: Vec<Gradient>,
    pub sizes_along: Vec<[f64; 3]>,
    pub zeros: Vec<f64>,
}

/// A state and what acts in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Situation<'a> {
    pub time: f64,
    pub q: &'a [f64],
    pub v: &'a [f64],
    /// Empty: zero.
    pub acceleration: &'a [f64],
    /// The force of every row; empty: zero.
    pub forces: &'a [f64],
    /// Values of applied forces, for outputs; empty: zero.
    pub loads: &'a [f64],
    /// Whether some forces are chosen among others that move the system in the same way.
    pub shared: bool,
}

/// Change of a value with these derivatives; see [`Equations::reach`].
pub(super) fn change(derivatives: &[[f64; 3]], sizes: &[f64], [q, v]: [&[f64]; 2]) -> f64 {
    let terms = derivatives.iter().enumerate();
    let terms = terms.map(|(i, [by_position, by_velocity, _])| {
        let least = least_size(sizes, i).max(1.0);
        by_position * (least + q[i].abs()) + by_velocity * (least + v[i].abs())
    });
    terms.sum()
}

impl<'a> Situation<'a> {
    /// A state without accelerations and forces.
    pub fn of_state(time: f64, state: &'a State<f64>) -> Self {
        Self {
            time,
            q: &state.q,
            v: &state.v,
            acceleration: &[],
            forces: &[],
            loads: &[],
            shared: false,
        }
    }

    /// The same for an evaluator, with zeros for what is not known.
    pub fn inputs<'b>(&'b self, zeros: &'b [f64]) -> Inputs<'b> {
        let or = |given: &'b [f64]| if given.is_empty() { zeros } else { given };
        Inputs {
            time: self.time,
            q: self.q,
            v: self.v,
            acceleration: or(self.acceleration),
            forces: or(self.forces),
            loads: or(self.loads),
        }
    }
}

/// A generalized force along ∂value/∂q, of velocity level ∂value/∂v.
fn along(value: usize, level: Level, force: f64) -> Seed {
    Seed {
        value,
        variation: match level {
            Level::Position => [force, 0.0],
            Level::Velocity => [0.0, -force],
        },
        gradient: 0.0,
    }
}

/// Level of constraint `i`.
fn level(d: &Description, i: usize) -> Level {
    match d.rows[d.constraints[i].row].position {
        Some(_) => Level::Position,
        None => Level::Velocity,
    }
}

/// The value whose rate the force of a row acts along, and its level.
fn source(d: &Description, declaration: &Declaration, row: usize) -> (usize, Level) {
    if let Some(i) = d.constraints.iter().position(|c| c.row == row) {
        return (declaration.constraints[i], level(d, i));
    }
    if let Some(c) = d.contacts.iter().position(|c| c.row == row) {
        return (declaration.contacts[c].gap, Level::Position);
    }
    let f = d.frictions.iter().position(|f| f.rows().contains(&row));
    let f = f.unwrap_or(0);
    let slip = declaration.frictions[f].slip;
    (slip[row - d.frictions[f].row], Level::Velocity)
}

/// Values of all that balances.
fn balancing(d: &Declaration) -> Vec<usize> {
    let mut values = [d.kinetic, d.potential, d.constraints, d.dissipations].concat();
    values.extend(d.contacts.iter().map(|contact| contact.gap));
    values.extend(d.frictions.iter().flat_map(|friction| friction.slip));
    for &(value, worked) in d.forces.iter().flat_map(|force| force.components) {
        values.push(value);
        if let Worked::Point(p) | Worked::Speed(p) = worked {
            values.push(p);
        }
    }
    values
}

/// Values of constraints, contacts and frictions.
fn surfaces(d: &Declaration) -> Vec<usize> {
    let mut values = d.constraints.to_vec();
    for contact in d.contacts {
        values.extend([contact.gap, contact.restitution]);
        values.extend(
            [contact.normal_factor, contact.region]
                .into_iter()
                .flatten(),
        );
    }
    for friction in d.frictions {
        values.extend([friction.static_coefficient, friction.kinetic_coefficient]);
        values.extend(friction.slip);
        values.extend(friction.normal);
    }
    values
}

impl Equations {
    pub fn new(
        d: &'static Description,
        declaration: &'static Declaration,
        effects: &Effects,
        parameters: &[f64],
        sizes: Vec<f64>,
        exact: f64,
    ) -> Self {
        let n = d.coordinates.len();
        let zero = || vec![0.0; n];
        let least = [n, d.rows.len(), d.forces.len()].into_iter().max();
        Self {
            d,
            declaration,
            effects: effects.clone(),
            sizes,
            parameters: parameters.to_vec(),
            values: Evaluator::new(declaration, parameters, surfaces(declaration)),
            balancing: Evaluator::new(declaration, parameters, balancing(declaration)),
            residual: zero(),
            size: zero(),
            largest: zero(),
            exact,
            inertia: zero(),
            swiftness: zero(),
            rows: (0..d.rows.len())
                .map(|row| source(d, declaration, row))
                .collect(),
            seeds: Vec::new(),
            gradients: vec![Gradient::default(); n],
            sizes_along: vec![[0.0; 3]; n],
            zeros: vec![0.0; least.unwrap_or(n)],
        }
    }

    pub fn includes(&self, item: Item) -> bool {
        self.effects.includes(self.d, item)
    }

    /// Level of constraint `i`.
    pub fn level(&self, i: usize) -> Level {
        level(self.d, i)
    }

    /// Constraints, contacts and frictions of a state.
    pub fn take(&mut self, at: Situation<'_>) {
        self.values.evaluate(at.inputs(&self.zeros));
    }

    /// d/dt ∂L/∂v − ∂L/∂q − Q − Σ λ∇g at a state.
    pub fn balance(&mut self, at: Situation<'_>) {
        self.balancing.evaluate(at.inputs(&self.zeros));
        self.residual.fill(0.0);
        self.size.fill(0.0);
        self.seed(1.0, at.forces);
        let (d, values) = (self.declaration, &self.balancing);
        for (i, force) in d.forces.iter().enumerate() {
            if !self.effects.includes(self.d, Item::Force(i)) {
                continue;
            }
            for &(f, worked) in force.components {
                let f = values.value(f);
                match worked {
                    Worked::Coordinate(j) => {
                        self.residual[j] -= f;
                        self.size[j] += f.abs();
                    }
                    Worked::Point(p) => self.seeds.push(along(p, Level::Position, f)),
                    Worked::Speed(s) => self.seeds.push(along(s, Level::Velocity, f)),
                }
            }
        }
        for (i, &r) in d.dissipations.iter().enumerate() {
            if self.effects.includes(self.d, Item::Dissipation(i)) {
                self.seeds.push(along(r, Level::Velocity, -1.0));
            }
        }
        self.balancing.sweep(&self.seeds, &mut self.gradients);
        let sums = self.residual.iter_mut().zip(&mut self.size);
        for ((residual, size), gradient) in sums.zip(&self.gradients) {
            *residual -= gradient.variation.sum;
            *size += gradient.variation.size;
        }
    }

    /// Choices take what is zero to within the tolerance, in the state that was balanced, for this.
    pub fn take_what_vanishes(&mut self, zero: Zero, at: Situation<'_>, tolerance: f64) {
        let mut guards = self.balancing.guards();
        guards.retain(|&guard| self.vanishes(guard, at, tolerance));
        let opening = match zero {
            Zero::AsGapOpens(gap) => Some(self.gradient(gap)),
            Zero::AsDeclared | Zero::Below => None,
        };
        let side = |guard: usize| {
            let rises = opening.as_ref().map_or(0.0, |opening| {
                let gradient = self.gradient(guard);
                gradient.iter().zip(opening).map(|(a, b)| a * b).sum()
            });
            match zero == Zero::Below || rises < 0.0 {
                true => (guard, Ordering::Less),
                false => (guard, Ordering::Equal),
            }
        };
        let taken: Vec<(usize, Ordering)> = guards.into_iter().map(side).collect();
        self.balancing.take_for(taken);
    }

    /// ∂/∂q of a value of the state that was balanced.
    fn gradient(&mut self, value: usize) -> Vec<f64> {
        let seed = Seed {
            value,
            variation: [0.0; 2],
            gradient: 1.0,
        };
        self.balancing.sweep(&[seed], &mut self.gradients);
        let gradients = self.gradients.iter();
        gradients.map(|gradient| gradient.position.sum).collect()
    }

    /// Choices take what balances for what it is again.
    pub fn take_all_as_it_is(&mut self) {
        self.balancing.take_for([]);
    }

    /// The gap of a contact that is open where the state that was balanced may be on either side of its surface.
    pub fn gap_that_opens(
        &mut self,
        at: Situation<'_>,
        mode: &Mode,
        tolerance: f64,
    ) -> Option<usize> {
        let declaration = self.declaration;
        let contacts = declaration.contacts.iter().enumerate();
        let mut open = contacts.filter(|(c, _)| !mode.contacts[*c]);
        let found = open.find(|(c, contact)| {
            self.includes(Item::Contact(*c)) && self.vanishes(contact.gap, at, tolerance)
        });
        found.map(|(_, contact)| contact.gap)
    }

    /// Whether a value of the state that was balanced is zero to within the tolerance of positions, velocities and the time.
    fn vanishes(&mut self, value: usize, at: Situation<'_>, tolerance: f64) -> bool {
        let (number, rate) = (self.balancing.value(value), self.balancing.rate(value));
        self.balancing
            .gradient_size(value, 0, &mut self.sizes_along);
        let by_state = change(&self.sizes_along, &self.sizes, [at.q, at.v]);
        let by_time = rate.abs() * at.time.abs().max(1.0);
        number.abs() <= tolerance * (by_state + by_time)
    }

    /// Whether what balances at the last state is beyond rounding at first sight.
    pub fn is_beyond(&self) -> bool {
        let mut pairs = self.residual.iter().zip(&self.size);
        pairs.any(|(error, size)| error.abs() > self.exact * size)
    }

    /// The largest error of what balances at the last state, relative to its size.
    pub fn imbalance(&self) -> f64 {
        let pairs = self.residual.iter().zip(&self.size);
        let parts = pairs.filter(|(error, _)| **error != 0.0);
        parts.fold(0.0, |most, (error, size)| most.max(error.abs() / size))
    }

    /// Finds ∂L/∂v and Σ λ∇g at a state: `velocity` and `variation` of [`Self::gradients`].
    pub fn momenta(&mut self, time: f64, state: &State<f64>, impulses: &[f64]) {
        let at = Situation::of_state(time, state);
        self.balancing.evaluate(at.inputs(&self.zeros));
        self.seed(0.0, impulses);
        self.balancing.sweep(&self.seeds, &mut self.gradients);
    }

    /// T or V at the last balance.
    pub fn energy(&self, potential: bool) -> f64 {
        let (values, item): (_, fn(usize) -> Item) = match potential {
            false => (self.declaration.kinetic, Item::Kinetic),
            true => (self.declaration.potential, Item::Potential),
        };
        let taking = values
            .iter()
            .enumerate()
            .filter(|(i, _)| self.includes(item(*i)));
        taking.map(|(_, value)| self.balancing.value(*value)).sum()
    }

    /// v·∂L/∂v − L at the last balance, and the size of its terms.
    pub fn jacobi(&self, at: Situation<'_>) -> (f64, f64) {
        let (mut sum, mut size) = (0.0, 0.0);
        for (i, gradient) in self.gradients.iter().enumerate() {
            let least = least_size(&self.sizes, i).max(1.0);
            let (position, p) = (gradient.position.size, gradient.velocity);
            sum += p.sum * at.v[i];
            size += p.size * (1.0 + at.v[i].abs());
            size += position * (least + at.q[i].abs()) + p.size * (least + at.v[i].abs());
        }
        for (value, sign) in self.energies() {
            sum -= sign * self.balancing.value(value);
            size += self.balancing.value(value).abs();
        }
        (sum, size)
    }

    /// The terms of L that take part, with their signs.
    pub fn energies(&self) -> impl Iterator<Item = (usize, f64)> {
        let kinetic = self.declaration.kinetic.iter().enumerate();
        let kinetic = kinetic.map(|(i, value)| (Item::Kinetic(i), *value, 1.0));
        let potential = self.declaration.potential.iter().enumerate();
        let potential = potential.map(|(i, value)| (Item::Potential(i), *value, -1.0));
        let all = kinetic.chain(potential);
        all.filter_map(|(item, value, sign)| self.includes(item).then_some((value, sign)))
    }

    /// Weights of L, `variation` of it in what balances, and of the forces of all rows.
    fn seed(&mut self, variation: f64, lambda: &[f64]) {
        let mut seeds = core::mem::take(&mut self.seeds);
        seeds.clear();
        seeds.extend(self.energies().map(|(value, sign)| Seed {
            value,
            variation: [sign * variation, 0.0],
            gradient: sign,
        }));
        let acting = lambda
            .iter()
            .enumerate()
            .filter(|(_, force)| **force != 0.0);
        seeds.extend(acting.map(|(row, &force)| {
            let (value, level) = self.rows[row];
            along(value, level, force)
        }));
        self.seeds = seeds;
    }

    /// The normal force of friction `f`, as it is in the state taken with these forces, and the size of forces along its source.
    pub fn normal(&mut self, f: usize, lambda: &[f64]) -> (f64, f64) {
        use crate::system::Normal;
        match self.d.frictions[f].normal {
            Normal::Contact(c) => {
                let declared = self.declaration.contacts[c];
                let factor = declared.normal_factor.map_or(1.0, |e| self.values.value(e));
                let size = self.force_along(declared.gap, Level::Position);
                (factor * lambda[self.d.contacts[c].row], factor * size)
            }
            Normal::Constraint(i) => {
                let size = self.force_along(self.declaration.constraints[i], self.level(i));
                (lambda[self.d.constraints[i].row].abs(), size)
            }
            Normal::Resultant(i) => {
                let (mut square, mut sizes) = (0.0, 0.0);
                for &i in self.d.resultants[i] {
                    let size = self.force_along(self.declaration.constraints[i], self.level(i));
                    square += lambda[self.d.constraints[i].row].powi(2);
                    sizes += size * size;
                }
                (square.sqrt(), sizes.sqrt())
            }
            Normal::Given(_) => {
                let given = self.declaration.frictions[f].normal;
                let normal = given.map_or(0.0, |e| self.values.value(e));
                (normal, normal.abs())
            }
        }
    }

    /// The value whose rate the force of a row acts along, and its level.
    pub fn row(&self, row: usize) -> (usize, Level) {
        self.rows[row]
    }

    /// Whether a row acts in a mode.
    pub fn acts(&self, row: usize, mode: &Mode) -> bool {
        let d = self.d;
        if let Some(i) = d.constraints.iter().position(|c| c.row == row) {
            return self.constraint_acts(i, mode);
        }
        if let Some(c) = d.contacts.iter().position(|c| c.row == row) {
            return self.contact_acts(c, mode);
        }
        d.frictions
            .iter()
            .position(|f| f.rows().contains(&row))
            .is_some_and(|f| self.friction_acts(f, mode))
    }

    /// Whether a constraint acts in a mode.
    pub fn constraint_acts(&self, i: usize, mode: &Mode) -> bool {
        let contact = self.d.constraints[i].while_contact;
        self.includes(Item::Constraint(i)) && contact.is_none_or(|c| mode.contacts[c])
    }

    /// Whether a contact acts in a mode: whether it is closed.
    pub fn contact_acts(&self, c: usize, mode: &Mode) -> bool {
        self.includes(Item::Contact(c)) && mode.contacts[c]
    }

    /// Whether what presses a friction acts in a mode.
    pub fn is_pressed(&self, f: usize, mode: &Mode) -> bool {
        use crate::system::Normal;
        match self.d.frictions[f].normal {
            Normal::Contact(c) => mode.contacts[c],
            normal => (normal.constraints(self.d)).all(|i| self.constraint_acts(i, mode)),
        }
    }

    /// Whether a friction acts in a mode.
    pub fn friction_acts(&self, f: usize, mode: &Mode) -> bool {
        self.includes(Item::Friction(f)) && mode.frictions[f] != FrictionMode::Inactive
    }
}
