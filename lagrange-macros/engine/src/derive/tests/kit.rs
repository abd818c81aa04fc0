//! Systems built by hand, and numbers for their symbols.

use crate::derive::{Equations, OutputId, equations};
use crate::diagnostics::Diagnostics;
use crate::model::*;
use crate::symbolic::{ExprId, Function, Pool, Rational, Symbol};
use proc_macro2::{Ident, Span, TokenStream};
use std::collections::BTreeMap;

/// A system under construction: names → expressions, in the notation of the language.
pub struct Build {
    pub system: System,
    names: BTreeMap<String, ExprId>,
}

fn name(text: &str) -> ItemName {
    let ident = (!text.is_empty()).then(|| Ident::new(text, Span::call_site()));
    ItemName { text: text.to_owned(), ident, element: None, span: Span::call_site() }
}

impl Build {
    /// Coordinates and parameters, separated by blanks.
    pub fn new(coordinates: &str, parameters: &str) -> Self {
        let mut pool = Pool::new();
        let mut names = BTreeMap::new();
        let mut symbol = |pool: &mut Pool, text: &str| {
            let symbol = pool.symbol(text);
            names.insert(text.to_owned(), pool.leaf(symbol));
            symbol
        };
        let time = symbol(&mut pool, "t");
        let parameters = parameters
            .split_whitespace()
            .map(|text| Parameter {
                field: Ident::new(text, Span::call_site()),
                element: None,
                name: text.to_owned(),
                symbol: symbol(&mut pool, text),
                documentation: String::new(),
                unit: String::new(),
                tex: String::new(),
            })
            .collect();
        let coordinates = coordinates
            .split_whitespace()
            .map(|text| Coordinate {
                name: name(text),
                position: symbol(&mut pool, text),
                velocity: symbol(&mut pool, &format!("v_{text}")),
                acceleration: symbol(&mut pool, &format!("a_{text}")),
                unit: String::new(),
            })
            .collect();
        let system = System {
            name: Ident::new("Scene", Span::call_site()),
            documentation: String::new(),
            scalar: None,
            core: TokenStream::new(),
            pool,
            time,
            parameters,
            coordinates,
            kinetic: vec![],
            potential: vec![],
            from_lagrangian: false,
            constraints: vec![],
            contacts: vec![],
            frictions: vec![],
            forces: vec![],
            dissipations: vec![],
            branches: vec![],
            starts: vec![],
            observes: vec![],
            stops: vec![],
            marks: vec![],
        };
        Self { system, names }
    }

    /// Parses an expression; `der(e)` is the total time derivative, `v_x`, `a_x` are der(x), der(der(x)),
    /// `if(g, a, b)` is a where g ≥ 0.
    pub fn e(&mut self, text: &str) -> ExprId {
        parse(&mut self.system, &self.names, text)
    }

    fn force(&mut self, text: &str) -> Symbol {
        let force = self.system.pool.symbol(text);
        self.names.insert(text.to_owned(), self.system.pool.leaf(force));
        force
    }

    pub fn define(mut self, text: &str, value: &str) -> Self {
        let value = self.e(value);
        self.names.insert(text.to_owned(), value);
        self
    }

    /// An empty name makes an unnamed term.
    pub fn kinetic(mut self, text: &str, energy: &str) -> Self {
        let energy = self.e(energy);
        self.system.kinetic.push(EnergyTerm { name: name(text), energy });
        self
    }

    pub fn potential(mut self, text: &str, energy: &str) -> Self {
        let energy = self.e(energy);
        self.system.potential.push(EnergyTerm { name: name(text), energy });
        self
    }

    pub fn lagrangian(mut self, lagrangian: &str) -> Self {
        let lagrangian = self.e(lagrangian);
        let zero = self.system.pool.integer(0);
        let rest: Vec<_> = self.system.coordinates.iter().map(|c| (c.velocity, zero)).collect();
        let pool = &mut self.system.pool;
        let at_rest = pool.substitute(lagrangian, &rest);
        let kinetic = pool.sub(lagrangian, at_rest);
        let potential = pool.neg(at_rest);
        self.system.kinetic.push(EnergyTerm { name: name(""), energy: kinetic });
        self.system.potential.push(EnergyTerm { name: name(""), energy: potential });
        self.system.from_lagrangian = true;
        self
    }

    pub fn constraint(mut self, text: &str, level: Level, residual: &str) -> Self {
        let (residual, force) = (self.e(residual), self.force(text));
        self.system.constraints.push(Constraint { name: name(text), level, residual, while_contact: None, force });
        self
    }

    pub fn contact(mut self, text: &str, gap: &str) -> Self {
        let (gap, force) = (self.e(gap), self.force(text));
        let restitution = Restitution::Newton(self.e("0"));
        let name = name(text);
        self.system.contacts.push(Contact { name, gap, normal_factor: None, restitution, region: None, force });
        self
    }

    pub fn friction(mut self, text: &str, normal: Normal, slip: &[&str], coefficient: &str) -> Self {
        let mut components = Vec::new();
        for (k, slip) in slip.iter().enumerate() {
            let label = if k == 0 { text.to_owned() } else { format!("{text}{k}") };
            components.push((self.e(slip), self.force(&label)));
        }
        let coefficient = self.e(coefficient);
        self.system.frictions.push(Friction {
            name: name(text),
            slip: components,
            normal,
            static_coefficient: coefficient,
            kinetic_coefficient: coefficient,
        });
        self
    }

    pub fn load(mut self, text: &str, value: &str, generalized: &[(usize, &str)]) -> Self {
        let value = self.e(value);
        let generalized = generalized.iter().map(|&(i, q)| (i, self.e(q))).collect();
        let force = self.force(text);
        self.system.forces.push(Force { name: name(text), value, generalized, force });
        self
    }

    pub fn dissipation(mut self, text: &str, rayleigh: &str) -> Self {
        let rayleigh = self.e(rayleigh);
        self.system.dissipations.push(Dissipation { name: name(text), rayleigh });
        self
    }

    pub fn observe(mut self, text: &str, value: &str) -> Self {
        let value = self.e(value);
        self.system.observes.push(Observe { name: name(text), value });
        self
    }

    pub fn stop(mut self, text: &str, terms: &[&str]) -> Self {
        let terms = terms.iter().map(|term| self.e(term)).collect();
        self.system.stops.push(Watch { name: name(text), terms, conditions: vec![], zeros: false });
        self
    }

    /// The equations, or what is wrong with the system.
    pub fn try_derive(self) -> Result<Derived, String> {
        let mut sink = Diagnostics::new();
        match equations(self.system, &mut sink) {
            Some(equations) => Ok(Derived { equations, names: self.names }),
            None => Err(sink.to_string()),
        }
    }

    pub fn derive(self) -> Derived {
        self.try_derive().unwrap_or_else(|message| panic!("{message}"))
    }
}

fn parse(system: &mut System, names: &BTreeMap<String, ExprId>, text: &str) -> ExprId {
    let text: Vec<char> = text.chars().filter(|c| !c.is_whitespace()).collect();
    let mut parser = Parser { system, names, text: &text, at: 0 };
    let e = parser.sum();
    assert_eq!(parser.at, text.len(), "left over: {}", text[parser.at..].iter().collect::<String>());
    e
}

/// Precedence climbing over characters.
struct Parser<'a> {
    system: &'a mut System,
    names: &'a BTreeMap<String, ExprId>,
    text: &'a [char],
    at: usize,
}

impl Parser<'_> {
    fn take(&mut self, c: char) -> bool {
        let found = self.text.get(self.at) == Some(&c);
        self.at += usize::from(found);
        found
    }

    fn pool(&mut self) -> &mut Pool {
        &mut self.system.pool
    }

    fn sum(&mut self) -> ExprId {
        let mut e = self.term();
        loop {
            if self.take('+') {
                let right = self.term();
                e = self.pool().add(e, right);
            } else if self.take('-') {
                let right = self.term();
                e = self.pool().sub(e, right);
            } else {
                return e;
            }
        }
    }

    fn term(&mut self) -> ExprId {
        let mut e = self.sign();
        loop {
            if self.take('*') {
                let right = self.sign();
                e = self.pool().mul(e, right);
            } else if self.take('/') {
                let right = self.sign();
                e = self.pool().div(e, right).expect("division by zero");
            } else {
                return e;
            }
        }
    }

    fn sign(&mut self) -> ExprId {
        if self.take('-') {
            let e = self.sign();
            return self.pool().neg(e);
        }
        let base = self.atom();
        if !self.take('^') {
            return base;
        }
        let exponent = self.sign();
        self.pool().pow(base, exponent).expect("zero to a negative power")
    }

    fn atom(&mut self) -> ExprId {
        if self.take('(') {
            let e = self.sum();
            assert!(self.take(')'));
            return e;
        }
        let from = self.at;
        while self.text.get(self.at).is_some_and(|c| c.is_alphanumeric() || *c == '_' || *c == '.') {
            self.at += 1;
        }
        let word: String = self.text[from..self.at].iter().collect();
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            let number = Rational::parse(&word).expect("number");
            return self.pool().number(number);
        }
        if !self.take('(') {
            return *self.names.get(&word).unwrap_or_else(|| panic!("unknown name `{word}`"));
        }
        let mut arguments = vec![self.sum()];
        while self.take(',') {
            arguments.push(self.sum());
        }
        assert!(self.take(')'));
        match word.as_str() {
            "der" => {
                let system = &mut *self.system;
                let pool = &mut system.pool;
                let mut direction = vec![(system.time, pool.integer(1))];
                for c in &system.coordinates {
                    direction.push((c.position, pool.leaf(c.velocity)));
                    direction.push((c.velocity, pool.leaf(c.acceleration)));
                }
                pool.derivative_along(arguments[0], &direction)
            }
            "sqrt" => self.pool().sqrt(arguments[0]),
            "if" => {
                let branch = self.system.branches.len();
                self.system.branches.push(Branch {
                    guard: arguments[0],
                    text: "if".to_owned(),
                    span: Span::call_site(),
                });
                self.pool().select(branch, arguments[1], arguments[2])
            }
            _ => {
                let f = Function::from_name(&word).unwrap_or_else(|| panic!("unknown function `{word}`"));
                self.pool().call(f, &arguments)
            }
        }
    }
}

/// Derived equations with the names of their system.
pub struct Derived {
    pub equations: Equations,
    names: BTreeMap<String, ExprId>,
}

/// Values by name.
pub type Point = BTreeMap<String, f64>;

impl Derived {
    /// Random values between 0.3 and 1.7 for every name, so that roots and quotients are safe.
    pub fn point(&self, random: &mut Random) -> Point {
        let leaf = |(name, e): (&String, &ExprId)| {
            let pool = &self.equations.system.pool;
            matches!(pool.node(*e), crate::symbolic::Node::Symbol(_)).then(|| (name.clone(), random.between(0.3, 1.7)))
        };
        self.names.iter().filter_map(leaf).collect()
    }

    /// Value of an output with all needs held; branches by the sign of their guards.
    pub fn value(&self, output: OutputId, point: &Point) -> f64 {
        self.equations.outputs[output.0].terms.iter().map(|&(_, term)| self.evaluate(term, point)).sum()
    }

    /// Value of an expression.
    pub fn evaluate(&self, e: ExprId, point: &Point) -> f64 {
        let system = &self.equations.system;
        let pool = &system.pool;
        let symbols = |s: Symbol| point[pool.name(s)];
        let then = |branch: usize| self.evaluate(system.branches[branch].guard, point) >= 0.0;
        pool.evaluate(&[e], &symbols, &then)[0]
    }

    /// Mᵢⱼ
    pub fn mass(&self, i: usize, j: usize, point: &Point) -> f64 {
        let wanted = (i.max(j), i.min(j));
        let entry = self.equations.structure.mass.iter().find(|&&(i, j, _)| (i, j) == wanted);
        entry.map_or(0.0, |&(_, _, output)| self.value(output, point))
    }

    /// fᵢ
    pub fn forcing(&self, i: usize, point: &Point) -> f64 {
        self.value(self.equations.structure.forcing[i], point)
    }

    /// aᵢ of a row, dense.
    pub fn jacobian(&self, row: usize, point: &Point) -> Vec<f64> {
        let mut dense = vec![0.0; self.equations.system.coordinates.len()];
        for &(i, output) in &self.equations.structure.rows[row].jacobian {
            dense[i] = self.value(output, point);
        }
        dense
    }

    /// (v̇, λ) with these rows acting: M v̇ − aᵀλ = f, a v̇ = −γ.
    pub fn accelerations(&self, rows: &[usize], point: &Point) -> Vec<f64> {
        let n = self.equations.system.coordinates.len();
        let size = n + rows.len();
        let mut matrix = vec![vec![0.0; size]; size];
        let mut right = vec![0.0; size];
        for i in 0..n {
            for j in 0..n {
                matrix[i][j] = self.mass(i, j, point);
            }
            right[i] = self.forcing(i, point);
        }
        for (k, &row) in rows.iter().enumerate() {
            for (i, a) in self.jacobian(row, point).into_iter().enumerate() {
                matrix[n + k][i] = a;
                matrix[i][n + k] = -a;
            }
            right[n + k] = -self.value(self.equations.structure.rows[row].bias, point);
        }
        solve(matrix, right)
    }

    /// (i, j) of the entries of M that are not structurally zero.
    pub fn pattern(&self) -> Vec<(usize, usize)> {
        self.equations.structure.mass.iter().map(|&(i, j, _)| (i, j)).collect()
    }

    /// Asserts that an output has one term, which equals `wanted` and needs no more operations.
    #[track_caller]
    pub fn expect(&mut self, output: OutputId, wanted: &str) {
        let terms = &self.equations.outputs[output.0].terms;
        let [(_, got)] = terms[..] else { panic!("{} has {} terms", self.printed(output), terms.len()) };
        let system = &mut self.equations.system;
        let wanted = parse(system, &self.names, wanted);
        let pool = &mut system.pool;
        let difference = pool.sub(got, wanted);
        let difference = pool.simplify(difference);
        let (printed, form) = (pool.print(got), pool.print(wanted));
        assert!(pool.is_zero(difference), "got {printed}, want {form}");
        let (cost, bound) = (pool.operations(&[got]), pool.operations(&[wanted]));
        assert!(cost <= bound, "{printed} has {cost} operations, {form} has {bound}");
    }

    /// The terms of an output, printed.
    pub fn printed(&self, output: OutputId) -> String {
        let pool = &self.equations.system.pool;
        let terms: Vec<String> =
            self.equations.outputs[output.0].terms.iter().map(|&(_, term)| pool.print(term)).collect();
        terms.join(" + ")
    }

    /// Operations of M and f together.
    pub fn operations(&self) -> usize {
        let structure = &self.equations.structure;
        let outputs = structure.mass.iter().map(|&(_, _, o)| o).chain(structure.forcing.iter().copied());
        let terms: Vec<ExprId> =
            outputs.flat_map(|o| self.equations.outputs[o.0].terms.iter().map(|&(_, e)| e)).collect();
        self.equations.system.pool.operations(&terms)
    }
}

/// Solves A x = b by elimination with pivoting.
pub fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).expect("not empty");
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            for j in k..n {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        b[k] = (b[k] - (k + 1..n).map(|j| a[k][j] * b[j]).sum::<f64>()) / a[k][k];
    }
    b
}

/// Seeded random numbers (xorshift; Marsaglia 2003).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() >> 16) as usize % n
    }
}

/// Asserts relative agreement to rounding.
#[track_caller]
pub fn close(what: &str, got: f64, want: f64) {
    assert!((got - want).abs() <= 1e-12 * (1.0 + want.abs()), "{what}: got {got}, want {want}");
}
