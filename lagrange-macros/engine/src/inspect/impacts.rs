//! What happens at an impact: the balance of momenta, and the laws of impact.

use super::Impact;
use super::excerpt::excerpt;
use super::formula::{Formula, Relation, Statement};
use super::letter::{Letter, Mark};
use super::work::Work;
use crate::model::{Normal, Restitution};
use crate::symbolic::ExprId;

impl Work<'_> {
    /// What happens at an impact of each contact alone.
    pub fn impacts(&mut self) -> Vec<Impact> {
        let shown = excerpt(self.system().contacts.len());
        shown
            .into_iter()
            .map(|contact| self.impact(contact))
            .collect()
    }

    fn impact(&mut self, contact: usize) -> Impact {
        let system = &self.equations.system;
        let item = &system.contacts[contact];
        let row = self.system().contact_row(contact);
        let bilateral: Vec<usize> = (0..system.constraints.len())
            .filter(|&i| {
                system.constraints[i]
                    .while_contact
                    .is_none_or(|c| c == contact)
            })
            .collect();
        let mut rows = bilateral.clone();
        rows.push(row);
        let mut note = String::new();
        for (i, friction) in system.frictions.iter().enumerate() {
            if matches!(friction.normal, Normal::Contact(c) if c == contact) {
                rows.extend(self.system().slip_rows(i));
                note = format!(
                    "The impulse of {} makes its slip zero if that takes no more than static friction allows, \
                     else it is kinetic friction against the slip.",
                    friction.name.text
                );
            }
        }
        let mut equations = Vec::new();
        for i in excerpt(system.coordinates.len()) {
            let left = self.inertia(i, &[]).with_jumps();
            equations.push(Statement::equal(left, self.impulses(i, &rows)));
        }
        for &row in &bilateral {
            let after = self.rate(row, &[]).with_velocities(Mark::After);
            equations.push(Statement::equal(after, Formula::ZERO));
        }
        let rate = self.rate(row, &[]);
        match item.restitution {
            Restitution::Newton(e) => {
                let after = rate.with_velocities(Mark::After);
                equations.push(Statement::equal(after, self.restituted(e, &rate)));
            }
            Restitution::Poisson(e) => {
                note = format!(
                    "Poisson: the impulse of restitution is {} times that of compression. {note}",
                    super::print::text::formula(&self.reader.formula(e))
                );
            }
        }
        let approaching = rate.with_velocities(Mark::Before);
        Impact {
            contact: item.name.text.clone(),
            when: [
                Statement::equal(self.reader.formula(item.gap), Formula::ZERO),
                Statement::new(approaching, Relation::Below, Formula::ZERO),
            ],
            region: self.region(contact, &[]),
            equations,
            note: note.trim().to_owned(),
        }
    }

    /// −e ṡ⁻
    fn restituted(&mut self, e: ExprId, rate: &Formula) -> Formula {
        let before = rate.with_velocities(Mark::Before);
        match (self.pool().is_zero(e), self.pool().is_one(e)) {
            (true, _) => Formula::ZERO,
            (_, true) => before.negated(),
            _ => {
                let (minus, before) = before.signed();
                let product = Formula::Product(vec![self.reader.formula(e), before]);
                if minus { product } else { product.negated() }
            }
        }
    }

    /// Row i of Σ aᵀΛ.
    fn impulses(&mut self, i: usize, rows: &[usize]) -> Formula {
        let multipliers = self.system().multipliers();
        let structure = &self.equations.structure;
        let mut terms = Vec::new();
        for &row in rows {
            for &(j, entry) in &structure.rows[row].jacobian {
                if j == i {
                    let entry = self.output(entry);
                    let pool = self.pool();
                    let multiplier = pool.leaf(multipliers[row]);
                    terms.push(pool.mul(entry, multiplier));
                }
            }
        }
        let impulse = |letter: &Letter| match letter.base.as_str() {
            "λ" | "N" | "F" if letter.rate == 0 && !letter.subscript.is_empty() => Letter {
                base: "Λ".to_owned(),
                ..letter.clone()
            },
            _ => letter.clone(),
        };
        let forces: Vec<Letter> = rows
            .iter()
            .map(|&r| self.names.letter(multipliers[r]))
            .collect();
        self.side_by_side(&terms)
            .with_letters(&|letter| match forces.contains(letter) {
                true => impulse(letter),
                false => letter.clone(),
            })
    }
}
