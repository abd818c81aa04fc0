//! Which letter stands for what, and in which order letters are written.

use super::formula::{Formula, Statement};
use super::letter::Letter;
use crate::ast::Declaration;
use crate::model::{Body, Coordinate, System};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Node, Rational, Symbol};

/// What a symbol of the pool is, in the order in which factors are written.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Kind {
    /// A field.
    Parameter,
    /// t
    Time,
    /// q
    Position,
    /// v
    Velocity,
    /// v̇
    Acceleration,
    /// A multiplier, or an applied force in an output.
    Force,
}

/// How a symbol is written.
#[derive(Clone, Debug)]
pub struct Known {
    /// The letter.
    pub letter: Letter,
    /// What it is.
    pub kind: Kind,
    /// Its place among its kind.
    pub order: usize,
}

/// Letters of a system.
pub struct Names {
    symbols: SortedMap<Symbol, Known>,
    bodies: SortedMap<String, String>,
    roots: SortedMap<ExprId, (Rational, Letter)>,
    declared: SortedMap<String, Letter>,
    /// Letters of the energies.
    pub energies: Energies,
}

/// Letters of what energies a system has.
pub struct Energies {
    /// T
    pub kinetic: Letter,
    /// V
    pub potential: Letter,
    /// E = T + V
    pub total: Letter,
    /// The Jacobi integral h.
    pub jacobi: Letter,
    /// L
    pub lagrangian: Letter,
}

impl Energies {
    /// L = T − V + what is linear in the velocities.
    pub fn lagrangian(&self, linear: Formula) -> Statement {
        let letter = |letter: &Letter| Formula::Letter(letter.clone());
        let parts = [
            letter(&self.kinetic),
            letter(&self.potential).negated(),
            linear,
        ];
        Statement::equal(letter(&self.lagrangian), Formula::sum(parts))
    }
}

/// Letters that physicists write before others in a product, class by class.
const FIRST: [&str; 3] = ["mMIJ", "kcμ", "g"];

impl Names {
    /// Letters of everything that a system names.
    pub fn of(declaration: &Declaration, system: &System) -> Names {
        let declared = declared(declaration, system);
        let mut names = Names {
            symbols: SortedMap::new(),
            bodies: SortedMap::new(),
            roots: SortedMap::new(),
            energies: energies(&declared),
            declared,
        };
        names.roots = names.defined_roots(system);
        names.enter(system.time, Letter::new("t"), Kind::Time, 0);
        for (i, parameter) in system.parameters.iter().enumerate() {
            let field = parameter.name.split('[').next().unwrap_or_default();
            let whole = names.declared(field);
            let letter = match parameter.element {
                Some(element) => whole.element(&element.to_string()),
                None => whole,
            };
            let early = match letter.base.chars().next() {
                Some(c) if letter.is_single() => FIRST.iter().position(|class| class.contains(c)),
                _ => None,
            };
            let order = early.unwrap_or(FIRST.len()) * system.parameters.len() + i;
            names.enter(parameter.symbol, letter, Kind::Parameter, order);
        }
        for body in &system.bodies {
            names.enter_body(system, body);
        }
        for (i, coordinate) in system.coordinates.iter().enumerate() {
            if names.symbols.contains_key(&coordinate.velocity) {
                continue;
            }
            let letter = names.declared(&coordinate.name.text);
            let kinds = [Kind::Position, Kind::Velocity, Kind::Acceleration];
            let symbols = [
                coordinate.position,
                coordinate.velocity,
                coordinate.acceleration,
            ];
            for (rate, (kind, symbol)) in (0..).zip(kinds.into_iter().zip(symbols)) {
                names.enter(symbol, letter.clone().rate(rate), kind, i);
            }
        }
        for (i, (symbol, letter)) in forces(system).into_iter().enumerate() {
            names.enter(symbol, letter, Kind::Force, i);
        }
        names
    }

    /// The rates and axes of a body; they bear its name where there are several.
    fn enter_body(&mut self, system: &System, body: &Body) {
        let taken = self.declared.values().any(|letter| letter.base == "ω");
        let name = match system.bodies.len() == 1 && !taken {
            true => String::new(),
            false => body.name.clone(),
        };
        for k in 0..3 {
            let i = body.first + k;
            let letter = Letter::body_rate(&name, k);
            let turn = &system.coordinates[i];
            self.enter(turn.velocity, letter.clone(), Kind::Velocity, i);
            self.enter(turn.acceleration, letter.rate(2), Kind::Acceleration, i);
            for j in 0..3 {
                let letter = Letter::axis(&name, &k.to_string(), &j.to_string());
                self.enter(body.axes[k][j], letter, Kind::Position, 3 * i + j);
            }
        }
        self.bodies.insert(body.name.clone(), name);
    }

    /// How a body is written in subscripts, of those whose rates are velocities.
    pub fn body(&self, name: &str) -> Option<&str> {
        self.bodies.get(name).map(String::as_str)
    }

    /// The power of an expression that a definition names: a distance is written by its name.
    pub fn root(&self, base: ExprId) -> Option<&(Rational, Letter)> {
        self.roots.get(&base)
    }

    /// The letter of a coordinate, or of the rate of a turn.
    pub fn coordinate(&self, coordinate: &Coordinate) -> Letter {
        match self.symbols.contains_key(&coordinate.position) {
            true => self.letter(coordinate.position),
            false => self.letter(coordinate.velocity),
        }
    }

    fn enter(&mut self, symbol: Symbol, letter: Letter, kind: Kind, order: usize) {
        self.symbols.insert(
            symbol,
            Known {
                letter,
                kind,
                order,
            },
        );
    }

    /// How a symbol is written.
    pub fn symbol(&self, symbol: Symbol) -> Option<&Known> {
        self.symbols.get(&symbol)
    }

    /// What a letter stands for.
    pub fn of_letter(&self, letter: &Letter) -> Option<&Known> {
        self.symbols.values().find(|known| known.letter == *letter)
    }

    /// The letter of a symbol.
    pub fn letter(&self, symbol: Symbol) -> Letter {
        self.symbols
            .get(&symbol)
            .map_or_else(|| Letter::new("?"), |known| known.letter.clone())
    }

    /// The letter of a name in the declaration.
    pub fn declared(&self, name: &str) -> Letter {
        self.declared
            .get(name)
            .cloned()
            .unwrap_or_else(|| Letter::new(name))
    }

    /// Definitions that are roots, by what the root is of.
    fn defined_roots(&self, system: &System) -> SortedMap<ExprId, (Rational, Letter)> {
        let mut roots = SortedMap::new();
        for (name, e) in &system.defined {
            if let Node::Product(factors) = system.pool.node(*e)
                && let [(base, power)] = factors[..]
                && !power.is_integer()
            {
                roots.insert(base, (power, self.declared(name)));
            }
        }
        roots
    }
}

/// Letters of coordinates, fields and definitions. A letter stands for one thing only: where it is that of a force or of something
/// declared before, a name stays as it is.
fn declared(declaration: &Declaration, system: &System) -> SortedMap<String, Letter> {
    let mut taken: Vec<Letter> = forces(system).into_iter().map(|(_, force)| force).collect();
    taken.push(Letter::new("t"));
    let mut declared = SortedMap::new();
    let mut give = |name: &str, letter: Letter| {
        let free = |letter: &Letter| !taken.iter().any(|other| other.looks_like(letter));
        let mut choices = [letter, Letter::new(name)].into_iter();
        let letter = choices.find(free).unwrap_or_else(|| Letter::of(name, ""));
        taken.push(letter.clone());
        declared.insert(name.to_owned(), letter);
    };
    for coordinate in &system.coordinates {
        let name = &coordinate.name.text;
        give(name, Letter::new(name));
    }
    for field in &declaration.fields {
        let name = &field.name.text;
        let mut letter = match field.letter.as_str() {
            "" => Letter::new(name),
            letter => Letter::new(letter),
        };
        letter.tex = field.tex.clone();
        give(name, letter);
    }
    for (name, _) in &system.defined {
        give(name, Letter::new(name));
    }
    declared
}

/// T, V, E and h, or what says the same where these letters are declared.
fn energies(declared: &SortedMap<String, Letter>) -> Energies {
    let free = |usual: &str, otherwise: (&str, &str)| {
        let usual = Letter::new(usual);
        match declared.values().any(|letter| letter.looks_like(&usual)) {
            true => Letter::of(otherwise.0, otherwise.1),
            false => usual,
        }
    };
    Energies {
        kinetic: free("T", ("E", "kin")),
        potential: free("V", ("E", "pot")),
        total: free("E", ("E", "tot")),
        jacobi: free("h", ("h", "J")),
        lagrangian: free("L", ("L", "all")),
    }
}

/// Letters of multipliers and applied forces.
fn forces(system: &System) -> Vec<(Symbol, Letter)> {
    let mut forces = Vec::new();
    for constraint in &system.constraints {
        forces.push((constraint.force, Letter::of("λ", &constraint.name.text)));
    }
    for contact in &system.contacts {
        let base = match contact.normal_factor {
            Some(_) => "λ",
            None => "N",
        };
        forces.push((contact.force, Letter::of(base, &contact.name.text)));
    }
    for friction in &system.frictions {
        for (k, &(_, force)) in friction.slip.iter().enumerate() {
            let letter = Letter::of("F", &friction.name.text);
            let letter = match friction.slip.len() {
                1 => letter,
                _ => letter.element(&k.to_string()),
            };
            forces.push((force, letter));
        }
    }
    for force in &system.forces {
        forces.push((force.force, Letter::of("F", &force.name.text)));
    }
    forces
}
