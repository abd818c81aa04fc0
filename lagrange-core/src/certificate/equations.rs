//! The declared equations at a state: what balances in every coordinate, and how large its terms are.

use crate::declaration::{Declaration, Evaluator, Inputs, Seed, Worked};
use crate::effects::{Effects, Item};
use crate::integrate::least_size;
use crate::mode::{FrictionMode, Mode};
use crate::system::Description;
use crate::trajectory::State;

/// Evaluates the declared quantities with the effects of a run.
#[derive(Debug)]
pub(super) struct Equations {
    pub d: &'static Description,
    pub declaration: &'static Declaration,
    pub effects: Effects,
    pub parameters: Vec<f64>,
    /// Per coordinate: the size below which its errors are absolute; empty: 1 for all.
    pub sizes: Vec<f64>,
    pub values: Evaluator,
    /// Per coordinate: what should vanish.
    pub residual: Vec<f64>,
    /// Per coordinate: the sum of the absolute values of its terms.
    pub size: Vec<f64>,
    /// The largest of [`Self::size`] in the run.
    pub largest: Vec<f64>,
    /// Bound of rounding.
    pub exact: f64,
    /// Per coordinate: accelerations that forces of its size would make, where that has been measured.
    pub swiftness: Vec<f64>,
    seeds: [Vec<Seed>; 2],
    gradient: [Vec<f64>; 3],
    zeros: Vec<f64>,
    loads: Vec<f64>,
}

/// A state and what acts in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Situation<'a> {
    pub time: f64,
    pub q: &'a [f64],
    pub v: &'a [f64],
    /// Empty: zero.
    pub acceleration: &'a [f64],
    /// Of every row; empty: zero.
    pub forces: &'a [f64],
    /// Values of applied forces, for outputs; empty: zero.
    pub loads: &'a [f64],
}

/// A quantity that should vanish or stay positive, by its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Level {
    /// A function of positions; its rate vanishes with it.
    Position,
    /// Linear in the velocities.
    Velocity,
}

impl Equations {
    pub fn new(
        d: &'static Description,
        declaration: &'static Declaration,
        effects: &Effects,
        parameters: Vec<f64>,
        sizes: Vec<f64>,
        exact: f64,
    ) -> Self {
        let n = d.coordinates.len();
        let zero = || vec![0.0; n];
        Self {
            d,
            declaration,
            effects: effects.clone(),
            parameters,
            sizes,
            values: Evaluator::new(declaration),
            residual: zero(),
            size: zero(),
            largest: zero(),
            exact,
            swiftness: zero(),
            seeds: [Vec::new(), Vec::new()],
            gradient: [zero(), zero(), zero()],
            zeros: vec![0.0; n.max(d.rows.len())],
            loads: vec![0.0; d.forces.len()],
        }
    }

    pub fn includes(&self, item: Item) -> bool {
        self.effects.includes(self.d, item)
    }

    /// Level of constraint `i`.
    pub fn level(&self, i: usize) -> Level {
        match self.d.rows[self.d.constraints[i].row].position {
            Some(_) => Level::Position,
            None => Level::Velocity,
        }
    }

    /// Takes a state.
    pub fn take(&mut self, at: Situation<'_>) {
        let (n, m) = (self.d.coordinates.len(), self.d.rows.len());
        let zeros = &self.zeros;
        fn or<'a>(given: &'a [f64], zeros: &'a [f64]) -> &'a [f64] {
            if given.is_empty() { zeros } else { given }
        }
        self.values.evaluate(Inputs {
            parameters: &self.parameters,
            time: at.time,
            q: at.q,
            v: at.v,
            acceleration: or(at.acceleration, &zeros[..n]),
            forces: or(at.forces, &zeros[..m]),
            loads: or(at.loads, &self.loads),
        });
    }

    /// d/dt ∂L/∂v − ∂L/∂q − Q − Σ λ∇g at the state taken, with the forces `lambda` of all rows.
    pub fn balance(&mut self, lambda: &[f64]) {
        self.begin();
        // Each energy once as it changes with v, and twice as it changes with q: see `crate::declaration`.
        self.seed_energies(1, 1.0);
        self.seed_energies(0, -2.0);
        self.seed_rows(lambda);
        let (d, values) = (self.declaration, &self.values);
        let [still, moving] = &mut self.seeds;
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
                    Worked::Point(p) => still.push((p, 0, -f)),
                    Worked::Speed(s) => moving.push((s, 0, -f)),
                }
            }
        }
        for (i, &r) in d.dissipations.iter().enumerate() {
            if self.effects.includes(self.d, Item::Dissipation(i)) {
                moving.push((r, 0, 1.0));
            }
        }
        self.sweep();
    }

    /// [`Self::balance`] at a state, which is taken. Where something is beyond rounding at first sight, with all its sizes.
    pub fn balance_at(&mut self, at: Situation<'_>, mode: &Mode) {
        self.take(at);
        self.balance(at.forces);
        self.swiftness.fill(0.0);
        let beyond = |(error, size): (&f64, &f64)| error.abs() > self.exact * size;
        if self.residual.iter().zip(&self.size).any(beyond) {
            self.balance_with_sizes(at, mode);
        }
    }

    /// [`Self::balance`] at a state, which is taken, its sizes with everything that rounding errors are relative to: how much it changes
    /// when each position and velocity x changes by 1 + |x| (two large forces that cancel in a spring near its rest length), and
    /// what the forces of rows bring from one equation into another.
    fn balance_with_sizes(&mut self, at: Situation<'_>, mode: &Mode) {
        /// Changes of the state, whose rounding errors do not matter and which are small enough to be linear.
        const CHANGE: f64 = 1.0 / 1_048_576.0;
        let changed = |x: &[f64]| -> Vec<f64> {
            let signs = [1.0, -1.0, 1.0, 1.0, -1.0].into_iter().cycle();
            let signed = x.iter().zip(signs);
            signed
                .map(|(x, s)| x + s * CHANGE * (1.0 + x.abs()))
                .collect()
        };
        let (q, v) = (changed(at.q), changed(at.v));
        self.take(Situation { q: &q, v: &v, ..at });
        self.balance(at.forces);
        let beside = self.residual.clone();
        self.take(at);
        self.balance(at.forces);
        for ((size, there), here) in self.size.iter_mut().zip(beside).zip(&self.residual) {
            *size += (there - here).abs() / CHANGE;
        }
        let mut brought = vec![0.0; self.size.len()];
        for row in 0..self.d.rows.len() {
            if self.acts(row, mode) {
                let (value, level) = self.row(row);
                let (along, square) = self.along(value, level, &self.size.clone());
                for (brought, g) in brought.iter_mut().zip(&self.gradient[0]) {
                    *brought += g * along / square.max(f64::MIN_POSITIVE);
                }
            }
        }
        for f in 0..self.d.frictions.len() {
            if self.friction_acts(f, mode) {
                self.bring_by_friction(f, &mut brought);
            }
        }
        for (size, brought) in self.size.iter_mut().zip(brought) {
            *size += brought;
        }
    }

    /// What friction `f` brings from the equations that its normal force balances in into others.
    fn bring_by_friction(&mut self, f: usize, brought: &mut [f64]) {
        use crate::system::Normal;
        let source = match self.d.frictions[f].normal {
            Normal::Contact(c) => self.d.contacts[c].row,
            Normal::Constraint(i) => self.d.constraints[i].row,
            Normal::Given(_) => return,
        };
        let sizes = self.size.clone();
        let (value, level) = self.row(source);
        let (along, square) = self.along(value, level, &sizes);
        let friction = self.declaration.frictions[f];
        let coefficient = self.values.value(friction.kinetic_coefficient);
        let force = coefficient * along / square.max(f64::MIN_POSITIVE);
        for &slip in friction.slip {
            self.along(slip, Level::Velocity, &sizes);
            for (brought, g) in brought.iter_mut().zip(&self.gradient[0]) {
                *brought += g * force;
            }
        }
    }

    /// Momenta at velocities that are larger by 1, all of one sign, added to the sizes: what rounding errors of velocities
    /// that cancel are relative to.
    pub fn add_momentum_sizes(&mut self, time: f64, state: &State<f64>) {
        let v: Vec<f64> = state.v.iter().map(|v| 1.0 + v.abs()).collect();
        self.take(Situation {
            time,
            q: &state.q,
            v: &v,
            acceleration: &[],
            forces: &[],
            loads: &[],
        });
        let residual = self.residual.clone();
        self.add_momenta(1.0);
        self.residual = residual;
    }

    /// T or V at the state taken.
    pub fn energy(&self, potential: bool) -> f64 {
        let (values, item): (_, fn(usize) -> Item) = match potential {
            false => (self.declaration.kinetic, Item::Kinetic),
            true => (self.declaration.potential, Item::Potential),
        };
        let taking = values
            .iter()
            .enumerate()
            .filter(|(i, _)| self.includes(item(*i)));
        taking.map(|(_, value)| self.values.value(*value)).sum()
    }

    /// v·∂L/∂v − L at the state taken, and the size of its terms.
    pub fn jacobi(&mut self, at: Situation<'_>) -> (f64, f64) {
        self.begin();
        self.add_momenta(1.0);
        let (mut sum, mut size) = (0.0, 0.0);
        for ((p, s), v) in self.residual.iter().zip(&self.size).zip(at.v) {
            sum += p * v;
            size += s * (1.0 + v.abs());
        }
        let kinetic = self.declaration.kinetic.iter().enumerate();
        let kinetic = kinetic.map(|(i, value)| (Item::Kinetic(i), *value, -1.0));
        let potential = self.declaration.potential.iter().enumerate();
        let potential = potential.map(|(i, value)| (Item::Potential(i), *value, 1.0));
        for (item, value, sign) in kinetic.chain(potential) {
            if self.includes(item) {
                sum += sign * self.values.value(value);
                size += self.values.value(value).abs() + self.reach(value, 0, at);
            }
        }
        (sum, size)
    }

    /// ±∂L/∂v at the state taken, added to what balances since [`Self::begin`].
    pub fn add_momenta(&mut self, factor: f64) {
        self.seeds.iter_mut().for_each(Vec::clear);
        self.seed_energies_at(1, 0, factor);
        self.sweep();
    }

    /// − Σ λ∇g at the state taken, added to what balances.
    pub fn add_impulses(&mut self, impulses: &[f64]) {
        self.seeds.iter_mut().for_each(Vec::clear);
        self.seed_rows(impulses);
        self.sweep();
    }

    pub fn begin(&mut self) {
        self.residual.fill(0.0);
        self.size.fill(0.0);
        self.seeds.iter_mut().for_each(Vec::clear);
    }

    fn seed_energies(&mut self, power: usize, factor: f64) {
        self.seed_energies_at(power, power, factor);
    }

    fn seed_energies_at(&mut self, sweep: usize, power: usize, factor: f64) {
        let (kinetic, potential) = (self.declaration.kinetic, self.declaration.potential);
        for (i, &value) in kinetic.iter().enumerate() {
            if self.effects.includes(self.d, Item::Kinetic(i)) {
                self.seeds[sweep].push((value, power, factor));
            }
        }
        for (i, &value) in potential.iter().enumerate() {
            if self.effects.includes(self.d, Item::Potential(i)) {
                self.seeds[sweep].push((value, power, -factor));
            }
        }
    }

    fn seed_rows(&mut self, lambda: &[f64]) {
        for (i, &value) in self.declaration.constraints.iter().enumerate() {
            let force = lambda[self.d.constraints[i].row];
            let sweep = usize::from(self.level(i) == Level::Velocity);
            self.seeds[sweep].push((value, 0, -force));
        }
        for (contact, place) in self.declaration.contacts.iter().zip(self.d.contacts) {
            self.seeds[0].push((contact.gap, 0, -lambda[place.row]));
        }
        for (friction, place) in self.declaration.frictions.iter().zip(self.d.frictions) {
            for (k, &slip) in friction.slip.iter().enumerate() {
                self.seeds[1].push((slip, 0, -lambda[place.row + k]));
            }
        }
        self.seeds
            .iter_mut()
            .for_each(|seeds| seeds.retain(|seed| seed.2 != 0.0));
    }

    fn sweep(&mut self) {
        for (power, seeds) in self.seeds.iter().enumerate() {
            self.values
                .sweep(seeds, power, &mut self.residual, &mut self.size);
        }
    }

    /// How much a value changes when each position and velocity x changes by 1 + |x|, or by more where its absolute tolerance says so: the
    /// residuals of constraints and gaps are not asked for in finer units.
    pub fn reach(&mut self, value: usize, power: usize, at: Situation<'_>) -> f64 {
        let mut sum = 0.0;
        for (k, state) in [at.q, at.v].into_iter().enumerate() {
            let gradient = &mut self.gradient[k];
            gradient.fill(0.0);
            self.values
                .gradient_size(&[(value, power, 1.0)], k, gradient);
            let terms = gradient.iter().zip(state).enumerate();
            let size = |i| least_size(&self.sizes, i).max(1.0);
            sum += terms
                .map(|(i, (g, x))| g * (size(i) + x.abs()))
                .sum::<f64>();
        }
        sum
    }

    /// Remembers the sizes of the forces that balance at the state taken.
    pub fn status(&mut self, at: Situation<'_>) {
        self.take(at);
        self.balance(at.forces);
        for (largest, size) in self.largest.iter_mut().zip(&self.size) {
            *largest = largest.max(*size);
        }
    }

    /// Accelerations that forces of the sizes of the last balance would make. The inertia of a coordinate is its momentum where
    /// all velocities are 1; terms of either sign count alike, so that it is not too small.
    fn measure_swiftness(&mut self, at: Situation<'_>) {
        let ones = vec![1.0; at.v.len()];
        self.take(Situation { v: &ones, ..at });
        let mut inertia = vec![0.0; ones.len()];
        for (i, &value) in self.declaration.kinetic.iter().enumerate() {
            if self.effects.includes(self.d, Item::Kinetic(i)) {
                self.values
                    .gradient_size(&[(value, 0, 1.0)], 1, &mut inertia);
            }
        }
        for ((swift, size), inertia) in self.swiftness.iter_mut().zip(&self.size).zip(inertia) {
            *swift = if inertia > 0.0 { size / inertia } else { 0.0 };
        }
        self.take(at);
    }

    /// The size of the forces that balance in the run, as a force along the gradient of a value: by velocities for one of velocity
    /// level.
    pub fn force_along(&mut self, value: usize, level: Level) -> f64 {
        let largest = core::mem::take(&mut self.largest);
        let (along, square) = self.along(value, level, &largest);
        self.largest = largest;
        if square > 0.0 { along / square } else { 0.0 }
    }

    /// The gradient of a value times sizes, and its square; the gradient stays in `gradient[0]`.
    fn along(&mut self, value: usize, level: Level, sizes: &[f64]) -> (f64, f64) {
        let gradient = &mut self.gradient[0];
        gradient.fill(0.0);
        let power = usize::from(level == Level::Velocity);
        self.values
            .gradient_size(&[(value, 0, 1.0)], power, gradient);
        let pairs = gradient.iter().zip(sizes);
        let along = pairs.map(|(g, size)| g * size).sum();
        (along, gradient.iter().map(|g| g * g).sum())
    }

    /// The second rate of a value of position level or the first of one of velocity level, and the size of its terms.
    pub fn acceleration(&mut self, value: usize, level: Level, at: Situation<'_>) -> (f64, f64) {
        let (error, size) = self.acceleration_at_sight(value, level, at);
        if error.abs() <= self.exact * size {
            return (error, size);
        }
        self.measure_swiftness(at);
        self.acceleration_at_sight(value, level, at)
    }

    fn acceleration_at_sight(
        &mut self,
        value: usize,
        level: Level,
        at: Situation<'_>,
    ) -> (f64, f64) {
        let (power, factor) = match level {
            Level::Position => (2, 2.0),
            Level::Velocity => (1, 1.0),
        };
        let mut size = 0.0;
        for (k, state) in [at.q, at.v, at.acceleration]
            .into_iter()
            .enumerate()
            .skip(1)
        {
            let gradient = &mut self.gradient[k];
            gradient.fill(0.0);
            self.values
                .gradient_size(&[(value, power, 1.0)], k, gradient);
            let half = if k == 2 { 0.5 } else { 1.0 };
            let terms = gradient.iter().zip(state).zip(&self.swiftness);
            size += terms
                .map(|((g, x), swift)| half * g * if k == 2 { x.abs() + swift } else { x.abs() })
                .sum::<f64>();
        }
        (
            factor * self.values.coefficient(value, power),
            factor * size,
        )
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
            Normal::Given(_) => {
                let given = self.declaration.frictions[f].normal;
                let normal = given.map_or(0.0, |e| self.values.value(e));
                (normal, normal.abs())
            }
        }
    }

    /// The value whose rate the force of a row acts along, and its level.
    pub fn row(&self, row: usize) -> (usize, Level) {
        let d = self.d;
        if let Some(i) = d.constraints.iter().position(|c| c.row == row) {
            return (self.declaration.constraints[i], self.level(i));
        }
        if let Some(c) = d.contacts.iter().position(|c| c.row == row) {
            return (self.declaration.contacts[c].gap, Level::Position);
        }
        let on = |f: &crate::system::Friction| (f.row..f.row + f.components).contains(&row);
        let f = d.frictions.iter().position(on).unwrap_or(0);
        let slip = self.declaration.frictions[f].slip;
        (slip[row - d.frictions[f].row], Level::Velocity)
    }

    /// Whether a row acts in a mode.
    fn acts(&self, row: usize, mode: &Mode) -> bool {
        let d = self.d;
        if let Some(i) = d.constraints.iter().position(|c| c.row == row) {
            return self.constraint_acts(i, mode);
        }
        if let Some(c) = d.contacts.iter().position(|c| c.row == row) {
            return mode.contacts[c];
        }
        let on = |f: &crate::system::Friction| (f.row..f.row + f.components).contains(&row);
        d.frictions
            .iter()
            .position(on)
            .is_some_and(|f| self.friction_acts(f, mode))
    }

    /// Whether a constraint acts in a mode.
    pub fn constraint_acts(&self, i: usize, mode: &Mode) -> bool {
        let contact = self.d.constraints[i].while_contact;
        self.includes(Item::Constraint(i)) && contact.is_none_or(|c| mode.contacts[c])
    }

    /// Whether what presses a friction acts in a mode.
    pub fn is_pressed(&self, f: usize, mode: &Mode) -> bool {
        use crate::system::Normal;
        match self.d.frictions[f].normal {
            Normal::Contact(c) => mode.contacts[c],
            Normal::Constraint(i) => self.constraint_acts(i, mode),
            Normal::Given(_) => true,
        }
    }

    /// Whether a friction acts in a mode.
    pub fn friction_acts(&self, f: usize, mode: &Mode) -> bool {
        self.includes(Item::Friction(f)) && mode.frictions[f] != FrictionMode::Inactive
    }
}
