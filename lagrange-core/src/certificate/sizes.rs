//! How large the terms of the declared equations are at a state: what rounding errors, and errors of the state, are relative to.

use super::beyond;
use super::equations::{Equations, Situation, change};
use crate::arithmetic::{GOLDEN, uneven};
use crate::declaration::{Evaluator, Inputs, Interval};
use crate::error::Level;
use crate::mode::Mode;
use crate::trajectory::State;

/// Sizes that grow by less than this factor have settled.
const GROWS: f64 = 1.1;

/// Rounding makes of a value so many times the terms that make it: no gradient makes that of a height 1 − cos φ small.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// What rounding makes of a value that consists of `terms`. At the root of 0 its slope is infinite, and says nothing of rounding.
pub(super) fn rounding_of(terms: f64) -> f64 {
    match terms.is_finite() {
        true => ROUNDING * terms,
        false => 0.0,
    }
}

/// Velocities of about 1 more, each by another factor: equal ones would cancel in the speed of a foot, ẏ − ṡ.
fn raised(v: &[f64]) -> Vec<f64> {
    let raised = v.iter().enumerate();
    let raised = raised.map(|(j, v)| (1.0 + uneven(j, GOLDEN)) * (1.0 + v.abs()));
    raised.collect()
}

/// The power of time whose coefficient is the rate of a value that accelerations make, and its factor.
fn rate_of(level: Level) -> (usize, f64) {
    match level {
        Level::Position => (2, 2.0),
        Level::Velocity => (1, 1.0),
    }
}

impl Equations {
    /// [`Self::balance`] at a state, its sizes with everything that rounding errors are relative to: how much it changes
    /// when the time and each position and velocity x changes by 1 + |x| (two large forces that cancel in a spring near its rest length) and
    /// each acceleration by its size and by what the forces of the state could make of it, and what the forces of rows bring from one equation
    /// into another.
    pub fn balance_with_sizes(&mut self, at: Situation<'_>, mode: &Mode) {
        /// Changes of the state, whose rounding errors do not matter and which are small enough to be linear.
        const CHANGE: f64 = 1.0 / 1_048_576.0;
        /// So often the state is changed: what one change leaves as it is, another does not.
        const CHANGES: u64 = 2;
        // Changes follow no rule: by one, such as equal steps from a coordinate to the next, some differences of coordinates would stay as they are, and second
        // differences as in a net, and so would the forces that cancel in them.
        let changed = |x: &[f64], way: f64, random: &mut fastrand::Rng| -> Vec<f64> {
            let changed = x.iter().map(|x| {
                let sign = if random.bool() { way } else { -way };
                x + sign * (0.5 + random.f64()) * CHANGE * (1.0 + x.abs())
            });
            changed.collect()
        };
        let mut beside = Vec::new();
        for seed in 0..CHANGES {
            // What is pressed together by less than a change is free one way.
            for way in [1.0, -1.0] {
                let mut random = fastrand::Rng::with_seed(seed);
                let q = changed(at.q, way, &mut random);
                let v = changed(at.v, way, &mut random);
                self.balance(Situation { q: &q, v: &v, ..at });
                beside.push(self.residual.clone());
            }
        }
        // A force that is a function of the time is rounded as the time is: a fast oscillation far from the beginning.
        self.balance(Situation {
            time: at.time + CHANGE * (1.0 + at.time.abs()),
            ..at
        });
        beside.push(self.residual.clone());
        // Accelerations are rounded beside their own size, each for itself: huge ones that cancel where the inertia nearly vanishes. Those that
        // cancel are rounded beside what they cancel from.
        self.measure_swiftness(at, mode);
        let mut acceleration = at.acceleration.to_vec();
        for (j, &own) in at.acceleration.iter().enumerate() {
            acceleration[j] = own + CHANGE * (own.abs() + self.swiftness[j]);
            self.balance(Situation {
                acceleration: &acceleration,
                ..at
            });
            beside.push(self.residual.clone());
            acceleration[j] = own;
        }
        self.take(at);
        self.balance(at);
        for beside in beside {
            for ((size, there), here) in self.size.iter_mut().zip(beside).zip(&self.residual) {
                let change = (there - here).abs() / CHANGE;
                // Beside an attitude of unit length a root may have no value, as that of 1 − n² where a disc lies nearly flat.
                if change.is_finite() {
                    *size += change;
                }
            }
        }
        let mut size = core::mem::take(&mut self.size);
        let brought = self.brought(&size, mode);
        let sizes = size.iter_mut().zip(brought);
        sizes.for_each(|(size, brought)| *size += brought);
        self.measure_forces_of_rates(&mut size, at, mode);
        self.spread(&mut size, mode);
        self.size = size;
    }

    /// Makes sizes of what balances as large as what the forces of rows bring from others: a load goes on through many, from block to block of a
    /// train that is pushed at its end.
    pub fn spread(&mut self, sizes: &mut [f64], mode: &Mode) {
        for _ in 0..self.d.rows.len() {
            let mut grows = false;
            let brought = self.brought(sizes, mode);
            for (size, brought) in sizes.iter_mut().zip(brought) {
                grows |= brought > GROWS * *size;
                *size = size.max(brought);
            }
            if !grows {
                break;
            }
        }
    }

    /// Per coordinate the most that the force of a row brings into its equation from those of others that the row acts in.
    fn brought(&mut self, sizes: &[f64], mode: &Mode) -> Vec<f64> {
        let mut brought = vec![0.0; sizes.len()];
        for row in 0..self.d.rows.len() {
            if self.acts(row, mode) {
                let (value, level) = self.row(row);
                let force = self.force_of_row(value, level, sizes);
                self.bring(level, force, &mut brought);
            }
        }
        for f in 0..self.d.frictions.len() {
            if self.friction_acts(f, mode) {
                self.bring_by_friction(f, sizes, &mut brought);
            }
        }
        brought
    }

    /// The force of a row that keeps its rate as it is against forces of these sizes, Σ |aₖ| sizeₖ/mₖ / Σ aₖ²/mₖ, m the inertia of coordinates: in all units the
    /// same. Coordinates without inertia follow the others, and count where there are none.
    fn force_of_row(&mut self, value: usize, level: Level, sizes: &[f64]) -> f64 {
        self.values.gradient_size(value, 0, &mut self.sizes_along);
        let elements = self.sizes_along.iter().map(|sizes| sizes[level as usize]);
        let acting = elements.zip(&self.inertia).zip(sizes);
        let acting = acting.filter(|((a, _), _)| *a > 0.0);
        let inertias = acting.clone().map(|((_, m), _)| *m);
        let least = inertias.filter(|m| *m > 0.0).fold(f64::INFINITY, f64::min);
        let (mut along, mut square) = (0.0, 0.0);
        for ((a, &m), size) in acting {
            let mobility = match (least.is_finite(), m > 0.0) {
                (true, true) => least / m,
                (true, false) => 0.0,
                (false, _) => 1.0,
            };
            along += mobility * a * size;
            square += mobility * a * a;
        }
        along / square.max(f64::MIN_POSITIVE)
    }

    /// Makes sizes of what balances as large as the forces that would give coordinates with inertia the terms of the rates of rows in which others have
    /// none: beside these terms the forces of such rows are rounded, and where nothing else acts, as where a body that nothing pushes is
    /// seen by its polar angle, there is no other measure.
    fn measure_forces_of_rates(&mut self, sizes: &mut [f64], at: Situation<'_>, mode: &Mode) {
        for row in 0..self.d.rows.len() {
            if !self.acts(row, mode) {
                continue;
            }
            let (value, level) = self.row(row);
            let (_, terms) = self.acceleration_beside(0.0, value, level, at);
            self.values.gradient_size(value, 0, &mut self.sizes_along);
            let elements = self.sizes_along.iter().map(|sizes| sizes[level as usize]);
            let acting = elements.zip(&self.inertia).filter(|(a, _)| *a > 0.0);
            let (having, without): (Vec<_>, Vec<_>) = acting.partition(|(_, m)| **m > 0.0);
            if !having.is_empty() && !without.is_empty() {
                let mobility: f64 = having.iter().map(|(a, m)| a * a / **m).sum();
                self.bring(level, terms / mobility, sizes);
            }
        }
    }

    /// Takes a force along the value that was looked at last, where it is more than what is brought already.
    fn bring(&self, level: Level, force: f64, brought: &mut [f64]) {
        for (brought, sizes) in brought.iter_mut().zip(&self.sizes_along) {
            *brought = brought.max(sizes[level as usize] * force);
        }
    }

    /// What friction `f` brings from the equations that its normal force balances in into others.
    fn bring_by_friction(&mut self, f: usize, sizes: &[f64], brought: &mut [f64]) {
        let friction = self.declaration.frictions[f];
        let coefficient = self.values.value(friction.kinetic_coefficient);
        for source in self.d.frictions[f].normal.rows(self.d) {
            let (value, level) = self.row(source);
            let force = coefficient * self.force_of_row(value, level, sizes);
            for &slip in friction.slip {
                self.along(slip, Level::Velocity, sizes);
                self.bring(Level::Velocity, force, brought);
            }
        }
    }

    /// Momenta at larger velocities in the state taken, as sizes: what rounding errors of velocities that cancel are relative to. Coordinates without
    /// inertia have what the forces of rows bring into their equations from others.
    pub fn momentum_sizes(&mut self, time: f64, state: &State<f64>, mode: &Mode) -> Vec<f64> {
        let v = raised(&state.v);
        let raised = State::new(state.q.clone(), v);
        self.momenta(time, &raised, &[]);
        let mut sizes: Vec<f64> = self.gradients.iter().map(|g| g.velocity.size).collect();
        if sizes.contains(&0.0) {
            self.measure_inertia(Situation::of_state(time, state));
            let mut spread = sizes.clone();
            self.spread(&mut spread, mode);
            let without = sizes
                .iter_mut()
                .zip(spread)
                .filter(|(size, _)| **size == 0.0);
            without.for_each(|(size, brought)| *size = brought);
        }
        sizes
    }

    /// Energies of none and of each velocity by itself, which do not cancel: what huge velocities are rounded beside, and those of what is
    /// at rest in coordinates that move.
    pub fn energy_of_each(&mut self, at: Situation<'_>) -> f64 {
        let n = at.v.len();
        let mut v = vec![0.0; n];
        let mut sum = 0.0;
        for j in 0..=n {
            v.fill(0.0);
            if let Some(own) = v.get_mut(j) {
                *own = at.v[j];
            }
            let alone = Situation { v: &v, ..at };
            self.balancing.evaluate(alone.inputs(&self.zeros));
            let energies = self.energies();
            sum += energies
                .map(|(value, _)| self.balancing.value(value).abs())
                .sum::<f64>();
        }
        sum
    }

    /// How much a value changes when each position and velocity x changes by 1 + |x|, or by more where its absolute tolerance says so: the
    /// residuals of constraints and gaps are not asked for in finer units.
    pub fn reach(&mut self, value: usize, power: usize, at: Situation<'_>) -> f64 {
        self.reach_with_rounding(value, power, at).0
    }

    /// By how much a coefficient of a value is off that vanishes, and its [`Self::reach`]. Where constraints are about to lose rank the reach is small, and
    /// rounding of the terms says nothing.
    pub fn residual(&mut self, value: usize, power: usize, at: Situation<'_>) -> (f64, f64) {
        let (reach, rounding) = self.reach_with_rounding(value, power, at);
        let error = self.values.coefficient(value, power).abs();
        (beyond(error, rounding), reach)
    }

    fn reach_with_rounding(&mut self, value: usize, power: usize, at: Situation<'_>) -> (f64, f64) {
        let sizes = &mut self.sizes_along;
        let terms = self.values.gradient_size(value, power, sizes);
        let reach = change(sizes, &self.sizes, [at.q, at.v]);
        (reach, rounding_of(terms))
    }

    /// The inertia of each coordinate: its momentum where it moves alone with velocity 1; terms of either sign count alike, so that it is not too
    /// small.
    pub fn measure_inertia(&mut self, at: Situation<'_>) {
        let energies: Vec<usize> = self.energies().map(|(value, _)| value).collect();
        let mut v = vec![0.0; at.v.len()];
        for j in 0..v.len() {
            v[j] = 1.0;
            let alone = Situation { v: &v, ..at };
            self.balancing.evaluate(alone.inputs(&self.zeros));
            let momenta = energies.iter().map(|&value| {
                self.balancing
                    .gradient_size(value, 0, &mut self.sizes_along);
                self.sizes_along[j][1]
            });
            self.inertia[j] = momenta.sum();
            v[j] = 0.0;
        }
    }

    /// Accelerations that forces of the sizes of the last balance would make. What has no inertia at all, as the scalar part of an
    /// attitude that is 1, is moved by the rows that act on it.
    fn measure_swiftness(&mut self, at: Situation<'_>, mode: &Mode) {
        self.balance(at);
        self.measure_inertia(at);
        let without: Vec<usize> = (0..at.v.len())
            .filter(|&i| self.inertia[i] == 0.0)
            .collect();
        let pairs = self.size.iter().zip(&self.inertia);
        for (swift, (size, &inertia)) in self.swiftness.iter_mut().zip(pairs) {
            *swift = if inertia > 0.0 { size / inertia } else { 0.0 };
        }
        if !without.is_empty() {
            self.measure_swiftness_by_rows(&without, at, mode);
        }
    }

    /// Accelerations of coordinates without inertia that balance those of the others in the rows that act, Σ aₖ v̇ₖ ≈ 0: by least squares over
    /// the rows, each in units of what it changes by when each coordinate x changes by 1 + |x|.
    fn measure_swiftness_by_rows(&mut self, without: &[usize], at: Situation<'_>, mode: &Mode) {
        let mut sums = vec![[0.0; 2]; without.len()];
        for row in 0..self.d.rows.len() {
            if !self.acts(row, mode) {
                continue;
            }
            let (value, level) = self.row(row);
            self.values.gradient_size(value, 0, &mut self.sizes_along);
            let elements = || self.sizes_along.iter().map(|sizes| sizes[level as usize]);
            let unit: f64 = elements().zip(at.q).map(|(a, q)| a * (1.0 + q.abs())).sum();
            let moved: f64 = elements().zip(&self.swiftness).map(|(a, s)| a * s).sum();
            for (&i, [products, squares]) in without.iter().zip(&mut sums) {
                let a = self.sizes_along[i][level as usize] / unit;
                if a > 0.0 {
                    *products += a * moved / unit;
                    *squares += a * a;
                }
            }
        }
        for (&i, [products, squares]) in without.iter().zip(sums) {
            if squares > 0.0 {
                self.swiftness[i] = products / squares;
            }
        }
    }

    /// The size of the forces that balance in the run, as a force along the gradient of a value: by velocities for one of velocity
    /// level.
    pub fn force_along(&mut self, value: usize, level: Level) -> f64 {
        let largest = core::mem::take(&mut self.largest);
        let (along, square) = self.along(value, level, &largest);
        self.largest = largest;
        if square > 0.0 { along / square } else { 0.0 }
    }

    /// The largest of these along the slips of a friction.
    pub fn force_along_slips(&mut self, slips: &[usize]) -> f64 {
        let sizes = slips
            .iter()
            .map(|&slip| self.force_along(slip, Level::Velocity));
        sizes.fold(0.0, f64::max)
    }

    /// The gradient of a value times sizes, and its square.
    pub fn along(&mut self, value: usize, level: Level, sizes: &[f64]) -> (f64, f64) {
        self.values.gradient_size(value, 0, &mut self.sizes_along);
        let (mut along, mut square) = (0.0, 0.0);
        for (gradient, size) in self.sizes_along.iter().zip(sizes) {
            let g = gradient[level as usize];
            along += g * size;
            square += g * g;
        }
        (along, square)
    }

    /// The second rate of a value of position level or the first of one of velocity level, and the size of its terms; where that is
    /// not enough, with what the forces of the state could make of accelerations, and velocities rounded beside 1: those of a body that
    /// impacts have brought to rest are the rounding errors of what they were, and so are those that cancel what moves by itself.
    pub fn acceleration(
        &mut self,
        (value, level): (usize, Level),
        at: Situation<'_>,
        mode: &Mode,
    ) -> (f64, f64) {
        self.swiftness.fill(0.0);
        let (error, size) = self.acceleration_beside(0.0, value, level, at);
        if error.abs() <= self.exact * size {
            return (error, size);
        }
        self.measure_swiftness(at, mode);
        let v = raised(at.v);
        self.take(Situation { v: &v, ..at });
        let (_, of_raised) = self.acceleration_beside(1.0, value, level, at);
        self.take(at);
        let (error, size) = self.acceleration_beside(1.0, value, level, at);
        let size = size.max(of_raised);
        match error.abs() <= self.exact * size {
            true => (error, size),
            false => (error, size.max(self.terms(value, level, at))),
        }
    }

    /// The size of the terms that such a rate is made of, also where those of the time cancel one another: by how much it is uncertain where time, state and
    /// accelerations are, beside that.
    fn terms(&self, value: usize, level: Level, at: Situation<'_>) -> f64 {
        /// An uncertainty that is small enough to be linear, and large enough not to be rounding.
        const BLUR: f64 = 1e-9;
        let blurred = |x: f64| Interval::new(x - BLUR * x.abs(), x + BLUR * x.abs());
        let all = |list: &[f64]| -> Vec<Interval> { list.iter().map(|&x| blurred(x)).collect() };
        let mut ranges = Evaluator::new(self.declaration, &self.parameters, [value]);
        let nothing = vec![Interval::default(); self.zeros.len()];
        let (q, v, acceleration) = (all(at.q), all(at.v), all(at.acceleration));
        ranges.evaluate(Inputs {
            time: blurred(at.time),
            q: &q,
            v: &v,
            acceleration: &acceleration,
            forces: &nothing,
            loads: &nothing,
        });
        let (power, factor) = rate_of(level);
        let range = ranges.coefficient(value, power);
        let size = factor * (range.high - range.low) / (2.0 * BLUR);
        if size.is_finite() { size } else { 0.0 }
    }

    /// The same where velocities v have the sizes `least` + |v|.
    fn acceleration_beside(
        &mut self,
        least: f64,
        value: usize,
        level: Level,
        at: Situation<'_>,
    ) -> (f64, f64) {
        let (power, factor) = rate_of(level);
        let sizes = &mut self.sizes_along;
        self.values.gradient_size(value, power, sizes);
        let mut size = 0.0;
        for (i, [_, by_velocity, by_acceleration]) in self.sizes_along.iter().enumerate() {
            let swift = at.acceleration[i].abs() + self.swiftness[i];
            size += by_velocity * (least + at.v[i].abs()) + 0.5 * by_acceleration * swift;
        }
        (
            factor * self.values.coefficient(value, power),
            factor * size,
        )
    }
}
