//! The modes that contacts and frictions can be in, each with its unknowns, equations and guards.

use super::formula::{Formula, Relation, Statement};
use super::motion::Known;
use super::work::Work;
use super::{Guard, Mode};
use crate::model::{Level, Normal, System};
use crate::symbolic::{ExprId, Rational, Symbol};
use std::fmt;

/// Of more modes only those with no contact closed, one, or all are shown.
const MOST_SHOWN: u128 = 24;

/// Systems with more coordinates are not solved.
const MOST_SOLVED: usize = 6;

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

impl Work<'_> {
    /// Rows whose accelerations are zero in a mode.
    pub fn acting(&self, choice: &Choice) -> Vec<usize> {
        let system = self.system();
        let mut rows = Vec::new();
        for (i, c) in system.constraints.iter().enumerate() {
            if c.while_contact
                .is_none_or(|contact| choice.contacts[contact])
            {
                rows.push(i);
            }
        }
        let closed = choice
            .contacts
            .iter()
            .enumerate()
            .filter(|(_, closed)| **closed);
        rows.extend(closed.map(|(i, _)| self.contact_row(i)));
        for (i, state) in choice.frictions.iter().enumerate() {
            if *state == State::Sticks {
                rows.extend(self.slip_rows(i));
            }
        }
        rows
    }

    /// Rows of a friction.
    pub fn slip_rows(&self, friction: usize) -> std::ops::Range<usize> {
        let system = self.system();
        let before: usize = system.frictions[..friction]
            .iter()
            .map(|f| f.slip.len())
            .sum();
        let first = self.contact_row(system.contacts.len()) + before;
        first..first + system.frictions[friction].slip.len()
    }

    /// A mode in full.
    pub fn mode(&mut self, choice: &Choice) -> Mode {
        let system = &self.program.equations.system;
        let acting = self.acting(choice);
        let mut loaded = acting.clone();
        for (i, state) in choice.frictions.iter().enumerate() {
            if !matches!(state, State::Inactive | State::Sticks) {
                loaded.extend(self.slip_rows(i));
            }
        }
        loaded.sort_unstable();
        let pins = self.pins(&acting);
        let mut replaced: Vec<(Symbol, ExprId)> = Vec::new();
        let zero = self.pool().integer(0);
        let mut known = Vec::new();
        for &(row, coordinate, value) in &pins {
            let item = &system.coordinates[coordinate];
            replaced.push((item.position, value));
            replaced.push((item.velocity, zero));
            replaced.push((item.acceleration, zero));
            let letter = Formula::Letter(self.names.letter(item.position));
            known.push((row, Statement::equal(letter, self.reader.formula(value))));
        }
        let mut unknowns = Vec::new();
        for (i, coordinate) in system.coordinates.iter().enumerate() {
            if !pins.iter().any(|&(_, pinned, _)| pinned == i) {
                unknowns.push(self.names.letter(coordinate.acceleration));
            }
        }
        let multipliers = self.multipliers();
        unknowns.extend(
            loaded
                .iter()
                .map(|&row| self.names.letter(multipliers[row])),
        );
        let mut equations = Vec::new();
        for i in Work::shown(system.coordinates.len()) {
            equations.push(self.balance(i, &loaded, &pins, &replaced));
        }
        let free = |row: &usize| !pins.iter().any(|(pinned, ..)| pinned == row);
        let rows: Vec<usize> = acting.iter().copied().filter(free).collect();
        for at in Work::shown(rows.len()) {
            equations.push(self.acceleration(rows[at], &replaced));
        }
        for (i, state) in choice.frictions.iter().enumerate() {
            equations.extend(self.sliding(i, *state));
        }
        let solution = self.solution(choice, (&acting, &loaded), &pins, &replaced);
        let guards = self.guards(choice, &replaced);
        let [operations, with_guards] = self.operations(choice);
        Mode {
            name: name(system, choice),
            known: known.into_iter().map(|(_, statement)| statement).collect(),
            unknowns,
            equations,
            solution,
            guards,
            operations,
            with_guards,
        }
    }

    /// Accelerations and multipliers in closed form; nothing for friction that makes the equations nonlinear.
    fn solution(
        &mut self,
        choice: &Choice,
        (acting, loaded): (&[usize], &[usize]),
        pins: &[(usize, usize, ExprId)],
        known: &Known,
    ) -> Vec<Statement> {
        let system = &self.program.equations.system;
        if !self.solves || system.coordinates.len() > MOST_SOLVED {
            return Vec::new();
        }
        let mut residuals = Vec::new();
        for i in 0..system.coordinates.len() {
            let mut terms = self.load_terms(i, loaded, known);
            for term in self.inertia_terms(i, known) {
                terms.push(self.pool().neg(term));
            }
            residuals.push(self.pool().sum(&terms));
        }
        for &row in acting {
            if !pins.iter().any(|&(pinned, ..)| pinned == row) {
                residuals.push(self.acceleration_residual(row, known));
            }
        }
        for (i, state) in choice.frictions.iter().enumerate() {
            let sign = match state {
                State::Inactive | State::Sticks => continue,
                State::Forward => Rational::ONE,
                State::Backward => Rational::MINUS_ONE,
                State::Slips => return Vec::new(),
            };
            let item = &system.frictions[i];
            let normal = match item.normal {
                Normal::Contact(contact) => {
                    let contact = &system.contacts[contact];
                    let force = self.pool().leaf(contact.force);
                    match contact.normal_factor {
                        Some(factor) => self.pool().mul(force, factor),
                        None => force,
                    }
                }
                Normal::Constraint(_) => return Vec::new(),
                Normal::Given(e) => e,
            };
            let pool = self.pool();
            let strength = pool.mul(item.kinetic_coefficient, normal);
            let strength = pool.scale(strength, sign);
            let force = pool.leaf(item.slip[0].1);
            let law = pool.add(force, strength);
            residuals.push(pool.substitute(law, known));
        }
        let mut unknowns: Vec<Symbol> = Vec::new();
        for (i, coordinate) in system.coordinates.iter().enumerate() {
            if !pins.iter().any(|&(_, pinned, _)| pinned == i) {
                unknowns.push(coordinate.acceleration);
            }
        }
        let multipliers = self.multipliers();
        unknowns.extend(loaded.iter().map(|&row| multipliers[row]));
        self.solved(&residuals, &unknowns)
    }

    /// Rows that say coordinate = value, with the value: (row, coordinate, value).
    fn pins(&mut self, acting: &[usize]) -> Vec<(usize, usize, ExprId)> {
        let system = &self.program.equations.system;
        let structure = &self.program.equations.structure;
        let parameters: Vec<Symbol> = system.parameters.iter().map(|p| p.symbol).collect();
        let mut pins: Vec<(usize, usize, ExprId)> = Vec::new();
        for &row in acting {
            let held = system
                .constraints
                .get(row)
                .is_none_or(|c| c.level == Level::Position);
            let (Some(position), [(coordinate, entry)]) = (
                structure.rows[row].position,
                structure.rows[row].jacobian.as_slice(),
            ) else {
                continue;
            };
            let (gap, entry) = (self.output(position), self.output(*entry));
            let Some(sign) = self.is_unit(entry).filter(|_| held) else {
                continue;
            };
            let symbol = system.coordinates[*coordinate].position;
            let pool = self.pool();
            let leaf = pool.leaf(symbol);
            // g = ±(q − value)
            let scaled = pool.scale(gap, sign);
            let value = pool.sub(leaf, scaled);
            let fixed = pool.symbols(value).iter().all(|s| parameters.contains(s));
            if fixed && !pins.iter().any(|&(_, other, _)| other == *coordinate) {
                pins.push((row, *coordinate, value));
            }
        }
        pins
    }

    /// The balance of coordinate i; of a pinned one solved for the force that holds it.
    fn balance(
        &mut self,
        i: usize,
        loaded: &[usize],
        pins: &[(usize, usize, ExprId)],
        known: &Known,
    ) -> Statement {
        let inertia = self.inertia_terms(i, known);
        let load = self.load_terms(i, loaded, known);
        let pin = pins.iter().find(|&&(_, coordinate, _)| coordinate == i);
        if let Some(&(row, ..)) = pin {
            let multiplier = self.multipliers()[row];
            let pool = self.pool();
            let difference: Vec<ExprId> = {
                let mut all = load;
                all.extend(inertia.iter().map(|&term| pool.neg(term)));
                all
            };
            let rest = pool.sum(&difference);
            let factor = pool.differentiate(rest, multiplier);
            if let Some(sign) = pool.as_number(factor).filter(|n| n.is_unit()) {
                let leaf = pool.leaf(multiplier);
                let scaled = pool.scale(rest, sign);
                // ±λ + rest = 0
                let value = pool.sub(leaf, scaled);
                let left = Formula::Letter(self.names.letter(multiplier));
                return Statement::equal(left, self.reader.formula(value));
            }
            return Statement::equal(self.reader.formula(rest), Formula::ZERO);
        }
        Statement::equal(self.side_by_side(&inertia), self.side_by_side(&load))
    }

    /// F = ∓μ N
    fn sliding(&mut self, friction: usize, state: State) -> Vec<Statement> {
        let item = &self.program.equations.system.frictions[friction];
        let strength = self.strength(friction, item.kinetic_coefficient);
        let letters: Vec<Formula> = item
            .slip
            .iter()
            .map(|&(_, force)| Formula::Letter(self.names.letter(force)))
            .collect();
        match state {
            State::Inactive | State::Sticks => Vec::new(),
            State::Forward => vec![Statement::equal(letters[0].clone(), strength.negated())],
            State::Backward => vec![Statement::equal(letters[0].clone(), strength)],
            State::Slips => {
                let slip: Vec<Formula> = self
                    .slip_rows(friction)
                    .map(|row| self.rate(row, &[]))
                    .collect();
                let size = norm(&slip);
                letters
                    .into_iter()
                    .zip(slip)
                    .map(|(letter, slip)| {
                        let share = Formula::Fraction(Box::new(slip), Box::new(size.clone()));
                        let force = Formula::Product(vec![strength.clone(), share]);
                        Statement::equal(letter, force.negated())
                    })
                    .collect()
            }
        }
    }

    /// μ N
    fn strength(&mut self, friction: usize, coefficient: ExprId) -> Formula {
        let system = &self.program.equations.system;
        let coefficient = self.reader.formula(coefficient);
        let normal = match system.frictions[friction].normal {
            Normal::Contact(contact) => {
                let item = &system.contacts[contact];
                let pool = self.pool();
                let mut normal = pool.leaf(item.force);
                if let Some(factor) = item.normal_factor {
                    normal = pool.mul(normal, factor);
                }
                self.reader.formula(normal)
            }
            Normal::Constraint(constraint) => {
                let letter = self.names.letter(system.constraints[constraint].force);
                Formula::Absolute(Box::new(Formula::Letter(letter)))
            }
            Normal::Given(e) if self.pool().is_one(e) => return coefficient,
            Normal::Given(e) => self.reader.formula(e),
        };
        match (coefficient, normal) {
            (Formula::Product(a), Formula::Product(b)) => Formula::Product([a, b].concat()),
            (Formula::Product(mut a), b) => {
                a.push(b);
                Formula::Product(a)
            }
            (a, Formula::Product(b)) => Formula::Product([vec![a], b].concat()),
            (a, b) => Formula::Product(vec![a, b]),
        }
    }

    fn guards(&mut self, choice: &Choice, known: &Known) -> Vec<Guard> {
        let system = &self.program.equations.system;
        let mut guards = Vec::new();
        for at in Work::shown(system.contacts.len()) {
            let contact = &system.contacts[at];
            let name = &contact.name.text;
            if choice.contacts[at] {
                let force = Formula::Letter(self.names.letter(contact.force));
                guards.push(Guard {
                    meaning: format!("{name} presses"),
                    statement: Statement::new(force, Relation::AtLeast, Formula::ZERO),
                    otherwise: format!("{name} lost"),
                });
            } else {
                let gap = self.pool().substitute(contact.gap, known);
                let gap = self.reader.formula(gap);
                guards.push(Guard {
                    meaning: format!("{name} is open"),
                    statement: Statement::new(gap, Relation::AtLeast, Formula::ZERO),
                    otherwise: format!("impact at {name}"),
                });
            }
        }
        for (i, state) in choice.frictions.iter().enumerate() {
            let item = &system.frictions[i];
            let name = &item.name.text;
            let row = self.slip_rows(i).start;
            match state {
                State::Inactive => {}
                State::Sticks => {
                    let forces: Vec<Formula> = item
                        .slip
                        .iter()
                        .map(|&(_, force)| Formula::Letter(self.names.letter(force)))
                        .collect();
                    let most = self.strength(i, item.static_coefficient);
                    guards.push(Guard {
                        meaning: format!("static friction of {name} suffices"),
                        statement: Statement::new(norm(&forces), Relation::AtMost, most),
                        otherwise: format!("{name} slips"),
                    });
                }
                State::Forward | State::Backward => {
                    let relation = match state {
                        State::Forward => Relation::Above,
                        _ => Relation::Below,
                    };
                    let slip = self.rate(row, known);
                    guards.push(Guard {
                        meaning: format!("{name} {}", state.verb()),
                        statement: Statement::new(slip, relation, Formula::ZERO),
                        otherwise: format!("{name} sticks, or slips the other way"),
                    });
                }
                State::Slips => {
                    let slip: Vec<Formula> =
                        self.slip_rows(i).map(|row| self.rate(row, known)).collect();
                    guards.push(Guard {
                        meaning: format!("{name} slips"),
                        statement: Statement::new(norm(&slip), Relation::Above, Formula::ZERO),
                        otherwise: format!("{name} sticks, or slips on"),
                    });
                }
            }
        }
        guards
    }
}

/// |a| of one component, √(a² + b²) of two.
fn norm(components: &[Formula]) -> Formula {
    let two = || Box::new(Formula::Number(Rational::integer(2)));
    match components {
        [one] => Formula::Absolute(Box::new(one.clone())),
        many => {
            let squares = many
                .iter()
                .map(|c| (false, Formula::Power(Box::new(c.clone()), two())));
            Formula::Root(Box::new(Formula::Sum(squares.collect())))
        }
    }
}
