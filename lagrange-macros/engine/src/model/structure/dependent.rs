//! Constraints that follow from others, or contradict them.
//!
//! A row that is at every state the same combination of others, aᵢ = Σ cₖ aₖ, says nothing new (if the biases are that
//! combination too) or cannot hold (if they are not). So does a row that is parallel to one other row everywhere.
//! Where parameters decide whether they contradict each other, that is a remark and not a mistake.
//! Rows that are dependent on the constraints only, as in a parallelogram of three cranks, are left to the run.

use super::{Pfaffian, STATES, ZERO, gradient, is_plain, slopes};
use crate::diagnostics::Code;
use crate::model::elaboration::Elaboration;
use crate::model::{Hint, Level};
use crate::sorted::SortedMap;
use crate::symbolic::ExprId;

/// Elimination of larger systems of constraints would take longer than the derivation.
const MOST_OPERATIONS: usize = 3_000_000;

/// A row at one state: its numbers, and the combination of independent rows that they are.
#[derive(Clone)]
struct Reduced {
    numbers: Vec<f64>,
    combination: Vec<f64>,
}

/// Independent rows at one state, each with a column that the others do not have.
#[derive(Clone, Default)]
struct Basis {
    rows: Vec<(usize, Reduced)>,
}

impl Basis {
    /// The row as a combination of independent rows if it is one; else it becomes independent row `number`.
    fn take(&mut self, numbers: Vec<f64>, number: usize) -> Option<Vec<f64>> {
        let size = numbers.iter().fold(0.0, |size: f64, a| size.max(a.abs()));
        let mut left = Reduced {
            numbers,
            combination: vec![0.0; number + 1],
        };
        left.combination[number] = 1.0;
        for (pivot, row) in &self.rows {
            let factor = left.numbers[*pivot] / row.numbers[*pivot];
            subtract(&mut left, row, factor);
        }
        let magnitude = |i: &usize| left.numbers[*i].abs();
        let pivot = (0..left.numbers.len()).max_by(|i, j| magnitude(i).total_cmp(&magnitude(j)))?;
        if magnitude(&pivot) <= ZERO * size {
            // 0 = row − Σ cₖ rowₖ
            left.combination.truncate(number);
            return Some(left.combination.iter().map(|c| -c).collect());
        }
        for (_, row) in &mut self.rows {
            let factor = row.numbers[pivot] / left.numbers[pivot];
            row.combination.resize(number + 1, 0.0);
            subtract(row, &left, factor);
        }
        self.rows.push((pivot, left));
        None
    }
}

fn subtract(from: &mut Reduced, row: &Reduced, factor: f64) {
    for (a, b) in from.numbers.iter_mut().zip(&row.numbers) {
        *a -= factor * b;
    }
    for (a, b) in from.combination.iter_mut().zip(&row.combination) {
        *a -= factor * b;
    }
}

/// What can be said of a row, given the ones before it.
enum Verdict {
    /// It is new, or nothing is certain.
    Independent,
    /// These rows say the same.
    Follows(Vec<usize>),
    /// It cannot hold together with these.
    Contradicts(Vec<usize>),
}

/// Rows that hold together: (constraint or contact, its row).
struct Together<'a> {
    basis: Vec<Basis>,
    independent: Vec<(Subject, &'a Pfaffian)>,
}

/// What a row belongs to.
#[derive(Clone, Copy)]
enum Subject {
    Constraint(usize),
    Contact(usize),
}

impl Elaboration<'_> {
    /// Reports constraints that say nothing new, and those that contradict others.
    pub(super) fn dependent(&mut self, rows: &[Pfaffian]) {
        if rows.len() * rows.len() * self.system.coordinates.len() > MOST_OPERATIONS {
            return;
        }
        let mut always = Together {
            basis: vec![Basis::default(); STATES as usize],
            independent: Vec::new(),
        };
        for (i, row) in rows.iter().enumerate() {
            if is_plain(&self.system.pool, &self.system.constraints[i]) {
                self.judge(&mut always, Subject::Constraint(i), row);
            }
        }
        let (positions, time) = (self.positions(), self.system.time);
        for contact in 0..self.system.contacts.len() {
            let holds = |&i: &usize| {
                let constraint = &self.system.constraints[i];
                constraint.while_contact == Some(contact)
                    && self.system.pool.branches(constraint.residual).is_empty()
            };
            let conditional: Vec<usize> = (0..rows.len()).filter(holds).collect();
            let gap = self.system.contacts[contact].gap;
            if conditional.is_empty() || !self.system.pool.branches(gap).is_empty() {
                continue;
            }
            let touching = gradient(&mut self.system.pool, gap, &positions, time);
            let mut closed = Together {
                basis: always.basis.clone(),
                independent: always.independent.clone(),
            };
            // The contact comes last among equals: a gap that constraints fix already may be meant.
            let before = self.sink.count();
            self.judge(&mut closed, Subject::Contact(contact), &touching);
            if self.sink.count() > before {
                continue;
            }
            for i in conditional {
                self.judge(&mut closed, Subject::Constraint(i), &rows[i]);
            }
        }
    }

    /// Reports gaps that are declared twice, and slips whose two components are one.
    pub(super) fn same_twice(&mut self) {
        let mut gaps: SortedMap<ExprId, usize> = SortedMap::new();
        let everywhere = self.system.contacts.iter().enumerate();
        for (i, contact) in everywhere.filter(|(_, contact)| contact.region.is_none()) {
            let first = *gaps.get_or_insert(contact.gap, i);
            if first != i {
                let first = format!("`{}`", self.system.contacts[first].name.text);
                let (text, at) = (&contact.name.text, contact.name.span);
                self.sink.report(Code::Redundant, at, &[text, &first]);
            }
        }
        let velocities = self.velocities();
        for i in 0..self.system.frictions.len() {
            let components: Vec<_> = self.system.frictions[i]
                .slip
                .iter()
                .map(|(e, _)| *e)
                .collect();
            let [first, second] = components[..] else {
                continue;
            };
            let pool = &mut self.system.pool;
            let rows = [first, second].map(|e| slopes(pool, e, &velocities));
            let one = (1..=STATES).all(|state| {
                let mut basis = Basis::default();
                let values = (self.values(&rows[0], state), self.values(&rows[1], state));
                let (Some(first), Some(second)) = values else {
                    return false;
                };
                basis.take(first, 0).is_some() || basis.take(second, 1).is_some()
            });
            if one {
                let name = &self.system.frictions[i].name;
                self.sink
                    .report(Code::SlipsParallel, name.span, &[&name.text]);
            }
        }
    }

    fn judge<'a>(&mut self, together: &mut Together<'a>, subject: Subject, row: &'a Pfaffian) {
        let verdict = self.verdict(together, subject, row);
        let (code, others) = match (verdict, subject) {
            (Verdict::Independent, _) | (_, Subject::Contact(_)) => return,
            (Verdict::Follows(others), _) => (Code::Redundant, others),
            (Verdict::Contradicts(others), _) => (Code::Contradiction, others),
        };
        let involved: Vec<Subject> = others
            .iter()
            .map(|&k| together.independent[k].0)
            .chain([subject])
            .collect();
        if let (Subject::Constraint(i), true) = (subject, others.is_empty()) {
            let at = self.system.constraints[i].name.span;
            let hint = "it holds at every state or at none: is one of its sides what is meant?";
            let what: [&dyn std::fmt::Display; 3] = [&"constraint", &"coordinate", &hint];
            return self.sink.report(Code::ConstrainsNothing, at, &what);
        }
        let name = |subject: Subject| match subject {
            Subject::Constraint(i) => &self.system.constraints[i].name,
            Subject::Contact(i) => &self.system.contacts[i].name,
        };
        let others: Vec<String> = others
            .into_iter()
            .map(|k| format!("`{}`", name(together.independent[k].0).text))
            .collect();
        let own = name(subject);
        let (at, text) = (own.span, own.text.clone());
        if code == Code::Contradiction && self.has_parameters(&involved) {
            let others = others.join(", ");
            let text = format!(
                "`{text}` holds together with {others} only for some values of the parameters: they restrict the same motion"
            );
            let extent = at.into();
            return self.system.hints.push(Hint { text, extent });
        }
        self.sink.report(code, at, &[&text, &others.join(", ")]);
    }

    /// Whether parameters occur in constraints or gaps.
    fn has_parameters(&self, subjects: &[Subject]) -> bool {
        subjects.iter().any(|subject| {
            let e = match subject {
                Subject::Constraint(i) => self.system.constraints[*i].residual,
                Subject::Contact(i) => self.system.contacts[*i].gap,
            };
            let symbols = self.system.pool.symbols(e);
            let parameters = self.system.parameters.iter();
            parameters
                .into_iter()
                .any(|parameter| symbols.contains(&parameter.symbol))
        })
    }

    fn verdict<'a>(
        &self,
        together: &mut Together<'a>,
        subject: Subject,
        row: &'a Pfaffian,
    ) -> Verdict {
        let number = together.independent.len();
        let states: Option<Vec<Vec<f64>>> = (1..=STATES)
            .map(|state| self.values(&row.slope, state))
            .collect();
        let Some(states) = states else {
            return Verdict::Independent;
        };
        let mut next = together.basis.clone();
        let combinations: Vec<Option<Vec<f64>>> = next
            .iter_mut()
            .zip(states)
            .map(|(basis, numbers)| basis.take(numbers, number))
            .collect();
        let combinations: Option<Vec<Vec<f64>>> = combinations.iter().cloned().collect();
        let Some(combinations) = combinations else {
            // Independent at one of the states: so it is at nearly all.
            if next.iter().all(|basis| basis.rows.len() == number + 1) {
                together.basis = next;
                together.independent.push((subject, row));
            }
            return Verdict::Independent;
        };
        let uses = |k: &usize| combinations.iter().any(|c| c[*k].abs() > ZERO);
        let used: Vec<usize> = (0..number).filter(uses).collect();
        let steady = combinations.windows(2).all(|pair| {
            pair[0]
                .iter()
                .zip(&pair[1])
                .all(|(a, b)| (a - b).abs() <= 1e-7 * a.abs().max(1.0))
        });
        if !steady && used.len() > 1 {
            return Verdict::Independent;
        }
        let others: Vec<(Subject, &Pfaffian)> =
            used.iter().map(|&k| together.independent[k]).collect();
        let agrees = (1..=STATES).zip(&combinations).all(|(state, combination)| {
            let factors: Vec<f64> = used.iter().map(|&k| combination[k]).collect();
            self.agrees(subject, row, &others, &factors, steady, state)
        });
        match agrees {
            true => Verdict::Follows(used),
            false => Verdict::Contradicts(used),
        }
    }

    /// Whether biases, and residuals of positions, are the combination that the slopes are.
    fn agrees(
        &self,
        subject: Subject,
        row: &Pfaffian,
        others: &[(Subject, &Pfaffian)],
        factors: &[f64],
        steady: bool,
        state: u32,
    ) -> bool {
        let residual = |subject: Subject| match subject {
            Subject::Constraint(i) => {
                let constraint = &self.system.constraints[i];
                (constraint.level == Level::Position).then_some(constraint.residual)
            }
            Subject::Contact(i) => Some(self.system.contacts[i].gap),
        };
        let mut checks = vec![(
            row.bias,
            others.iter().map(|(_, other)| other.bias).collect(),
        )];
        let residuals: Option<Vec<_>> = others.iter().map(|(other, _)| residual(*other)).collect();
        if let (true, Some(own), Some(residuals)) = (steady, residual(subject), residuals) {
            checks.push((own, residuals));
        }
        checks.into_iter().all(|(own, others): (_, Vec<_>)| {
            let mut expressions = vec![own];
            expressions.extend(others);
            let Some(values) = self.values(&expressions, state) else {
                return true;
            };
            let parts = values[1..]
                .iter()
                .zip(factors)
                .map(|(value, factor)| value * factor);
            let (sum, size) = parts.fold((0.0, values[0].abs()), |(sum, size), part| {
                (sum + part, size + part.abs())
            });
            (values[0] - sum).abs() <= 1e-7 * size.max(1e-3)
        })
    }
}
