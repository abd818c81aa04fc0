//! What does not change: momenta on which no energy depends, and energy; and what changes them where something does.

use super::Conserved;
use super::formula::{Formula, Statement};
use super::letter::Letter;
use super::work::Work;
use crate::symbolic::{ExprId, Symbol};

/// The name of what stands for the energy where the two differ.
pub(super) const JACOBI_INTEGRAL: &str = "Jacobi integral";

/// Takers of energy that are named.
const MOST_TAKERS: usize = 8;

/// Choices of numbers at which two forms of the energy are compared.
const SAMPLES: usize = 16;

/// A rate with more to read is shortened: beside what it is the rate of, and when that is conserved, there is one line for it.
const MOST_READ: usize = 80;

/// Momenta that are shown.
const MOST_MOMENTA: usize = 12;

impl Work<'_> {
    /// Momenta that only forces change and the energy. Of a coordinate on which forces depend, as the edge of a contact does, the
    /// momentum is told where there are modes that conserve it.
    pub fn conserved(&mut self) -> Vec<Conserved> {
        let structure = &self.equations.structure;
        let mut list = Vec::new();
        for i in 0..structure.unloaded.len() {
            if list.len() < MOST_MOMENTA
                && structure.unloaded[i]
                && (structure.cyclic[i] || !self.always_pushed(i))
            {
                list.push(self.momentum(i));
            }
        }
        list.push(self.energy());
        list
    }

    /// Whether something other than contacts and frictions changes the momentum of coordinate i.
    fn always_pushed(&mut self, i: usize) -> bool {
        let constraints = self.equations.system.constraints.iter();
        let rows = constraints.zip(&self.equations.structure.rows);
        let mut bilateral = rows.filter(|(constraint, _)| constraint.while_contact.is_none());
        let held = bilateral.any(|(_, row)| row.jacobian.iter().any(|&(j, _)| j == i));
        let applied = self.generalized_load(i, &[]);
        held || !self.pool().is_zero(applied)
    }

    /// ∂L/∂v of a coordinate on which no energy depends: changed by the forces on it alone.
    fn momentum(&mut self, i: usize) -> Conserved {
        let structure = &self.equations.structure;
        let system = &self.equations.system;
        let letter = self.names.letter(system.coordinates[i].position);
        let quantity = self.formula_of(structure.momenta.0[i]);
        let name = Letter::of("p", &subscript(&letter));
        let rows: Vec<usize> = (0..structure.rows.len()).collect();
        let pushing: Vec<usize> = rows
            .iter()
            .copied()
            .filter(|&row| structure.rows[row].jacobian.iter().any(|&(j, _)| j == i))
            .collect();
        let force = self.generalized_load(i, &rows);
        let rate = match self.pool().is_zero(force) {
            true => None,
            false => {
                let force = self.reader.formula(force).shortened(MOST_READ);
                let rate = Formula::Letter(name.clone().rate(1));
                Some(Statement::equal(rate, force))
            }
        };
        let when = match (self.always_pushed(i), pushing.is_empty()) {
            (true, _) => "never on its own".to_owned(),
            (false, true) => "always".to_owned(),
            (false, false) => {
                let mut names: Vec<&str> = Vec::new();
                for &row in &pushing {
                    let name = self.row_name(row);
                    if !names.contains(&name) {
                        names.push(name);
                    }
                }
                format!("while nothing acts at {}", names.join(", "))
            }
        };
        Conserved {
            name: format!("momentum of {}", system.coordinates[i].name.text),
            quantity: Statement::equal(Formula::Letter(name), quantity),
            rate,
            when,
        }
    }

    /// What changes the momentum of a coordinate on which no energy depends: ṗ = ∂L/∂q + Q, and ∂L/∂q = 0.
    fn generalized_load(&mut self, i: usize, rows: &[usize]) -> ExprId {
        let system = &self.equations.system;
        let mut terms = Vec::new();
        for force in &system.forces {
            let own = force.generalized.iter().filter(|&&(j, _)| j == i);
            terms.extend(own.map(|&(_, q)| q));
        }
        for dissipation in &system.dissipations {
            let velocity = system.coordinates[i].velocity;
            let pool = self.pool();
            let slope = pool.differentiate(dissipation.rayleigh, velocity);
            terms.push(pool.neg(slope));
        }
        let multipliers = self.system().multipliers();
        for &row in rows {
            for &(j, entry) in &self.equations.structure.rows[row].jacobian {
                if j == i {
                    let entry = self.output(entry);
                    let pool = self.pool();
                    let multiplier = pool.leaf(multipliers[row]);
                    terms.push(pool.mul(entry, multiplier));
                }
            }
        }
        self.pool().sum(&terms)
    }

    /// The Jacobi integral; T + V where T is quadratic in the velocities.
    fn energy(&mut self) -> Conserved {
        let structure = &self.equations.structure;
        let (kinetic, potential, jacobi, time_power, _) = structure.energy;
        let [t, v, h, power] = [kinetic, potential, jacobi, time_power].map(|o| self.output(o));
        let pool = self.pool();
        let total = pool.add(t, v);
        let beyond = pool.sub(h, total);
        // Two forms of one thing: their difference is zero in numbers, whatever its form. Roots have no value at some numbers.
        let sample = |k: usize| {
            let step = 0.618 + 0.414 * k as f64;
            move |s: Symbol| 0.4 + (step * (s.index() + 1) as f64).fract()
        };
        let values = (0..SAMPLES).map(|k| pool.evaluate(&[beyond, h], &sample(k), &|_| true));
        let finite: Vec<Vec<f64>> = values
            .filter(|values| values.iter().all(|value| value.is_finite()))
            .collect();
        let same = !finite.is_empty()
            && finite
                .iter()
                .all(|values| values[0].abs() <= 1e-9 * (1.0 + values[1].abs()));
        let quantity = match same {
            true => Formula::Sum(vec![
                (false, Formula::Letter(self.names.energies.kinetic.clone())),
                (
                    false,
                    Formula::Letter(self.names.energies.potential.clone()),
                ),
            ]),
            false => self.reader.formula(h),
        };
        let name = match same {
            true => self.names.energies.total.clone(),
            false => self.names.energies.jacobi.clone(),
        };
        let rate = match self.pool().is_zero(power) {
            true => None,
            false => {
                let power = self.reader.formula(power);
                let rate = Formula::Letter(name.clone().rate(1));
                Some(Statement::equal(rate, power))
            }
        };
        let takers = self.takers();
        let mut list = takers[..takers.len().min(MOST_TAKERS)].join(", ");
        if takers.len() > MOST_TAKERS {
            list.push_str(", …");
        }
        let when = match (&rate, takers.is_empty()) {
            (Some(_), true) => "changes with explicit time only".to_owned(),
            (Some(_), false) => format!("changes with explicit time, and where {list}"),
            (None, true) => "always".to_owned(),
            (None, false) => format!("except where {list}"),
        };
        Conserved {
            name: if same { "energy" } else { JACOBI_INTEGRAL }.to_owned(),
            quantity: Statement::equal(Formula::Letter(name), quantity),
            rate,
            when,
        }
    }

    /// What takes energy, or gives some.
    fn takers(&self) -> Vec<String> {
        let system = &self.equations.system;
        let mut takers: Vec<String> = Vec::new();
        let loads = system.forces.iter().map(|f| &f.name);
        let loads = loads.chain(system.dissipations.iter().map(|d| &d.name));
        takers.extend(loads.map(|name| format!("{} acts", name.text)));
        let constraints = system.constraints.iter().map(|c| &c.name);
        let rows = constraints.chain(system.contacts.iter().map(|c| &c.name));
        for (row, name) in rows.enumerate() {
            if self.equations.structure.rows[row].rheonomic {
                takers.push(format!("{} moves", name.text));
            }
        }
        // What moves as it is told carries along what sticks to it.
        let moves = |f: usize| {
            let mut rows = system.slip_rows(f);
            rows.any(|row| self.equations.structure.rows[row].rheonomic)
        };
        let frictions = system.frictions.iter().enumerate();
        takers.extend(frictions.map(|(f, friction)| {
            let does = if moves(f) { "acts" } else { "slips" };
            format!("{} {does}", friction.name.text)
        }));
        if !system.contacts.is_empty() {
            takers.push("an impact takes some".to_owned());
        }
        takers
    }

    /// Name of the item that a row belongs to.
    fn row_name(&self, row: usize) -> &str {
        let system = &self.equations.system;
        let contacts = system.constraints.len();
        if let Some(constraint) = system.constraints.get(row) {
            return &constraint.name.text;
        }
        if let Some(contact) = system.contacts.get(row - contacts) {
            return &contact.name.text;
        }
        let friction =
            (0..system.frictions.len()).find(|&f| self.system().slip_rows(f).contains(&row));
        friction.map_or("", |f| &system.frictions[f].name.text)
    }
}

fn subscript(letter: &Letter) -> String {
    match letter.subscript.as_str() {
        "" => letter.base.clone(),
        own => format!("{},{own}", letter.base),
    }
}
