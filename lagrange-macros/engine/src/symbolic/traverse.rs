//! What an expression is made of: sub-expressions, symbols, branches; replacement of symbols.

use super::properties::symbol_bit;
use super::table::{Flags, Table};
use super::{ExprId, Function, Node, Pool, Rational, Symbol};

impl Pool {
    /// Everything that the roots are made of, the roots included, each once, ascending (a topological order).
    pub fn iter_reachable(&self, roots: &[ExprId]) -> Vec<ExprId> {
        let Some(last) = roots.iter().max() else {
            return Vec::new();
        };
        let mut seen = vec![false; last.index() + 1];
        let mut found = Vec::new();
        let mut stack = roots.to_vec();
        while let Some(e) = stack.pop() {
            if !seen[e.index()] {
                seen[e.index()] = true;
                found.push(e);
                self.node(e).for_each_child(|child| {
                    if !seen[child.index()] {
                        stack.push(child);
                    }
                });
            }
        }
        // Few expressions of a large pool are sorted faster than the pool is looked through.
        if found.len() < seen.len() / 16 {
            found.sort_unstable();
            return found;
        }
        (0..=last.0)
            .filter(|&id| seen[id as usize])
            .map(ExprId)
            .collect()
    }

    /// Whether the symbol occurs.
    pub fn depends_on(&self, e: ExprId, symbol: Symbol) -> bool {
        self.depends_on_any(e, &[symbol])
    }

    /// Whether one of the symbols occurs.
    pub fn depends_on_any(&self, e: ExprId, symbols: &[Symbol]) -> bool {
        let bits = symbols
            .iter()
            .fold(0, |bits, symbol| bits | symbol_bit(*symbol));
        if self.symbol_bits(e) & bits == 0 {
            return false;
        }
        let mut seen = Flags::default();
        let mut stack = vec![e];
        let mut found = false;
        while let Some(e) = stack.pop() {
            if self.symbol_bits(e) & bits == 0 || !seen.raise(e, 0) {
                continue;
            }
            if let Node::Symbol(symbol) = self.node(e) {
                found |= symbols.contains(symbol);
            }
            if found {
                return true;
            }
            self.node(e).for_each_child(|child| stack.push(child));
        }
        false
    }

    /// All symbols that occur, ascending.
    pub fn symbols(&self, e: ExprId) -> Vec<Symbol> {
        let mut symbols = Vec::new();
        self.visit(
            e,
            |_| false,
            |node| {
                if let Node::Symbol(symbol) = node {
                    symbols.push(*symbol);
                }
            },
        );
        symbols.sort();
        symbols
    }

    /// All branches that occur, ascending.
    pub fn branches(&self, e: ExprId) -> Vec<usize> {
        let mut branches = Vec::new();
        let whole = |e| !self.holds_selection(e);
        self.visit(e, whole, |node| {
            if let Node::Select { branch, .. } = node {
                branches.push(*branch);
            }
        });
        branches.sort();
        branches.dedup();
        branches
    }

    /// Whether something in it is infinite for all values of the symbols: a negative power of 0, or its logarithm.
    pub fn has_pole(&self, e: ExprId) -> bool {
        let delicate = self.what_has_poles(&[e]);
        delicate.into_iter().any(|e| self.is_zero(e))
    }

    /// What the roots have under negative powers and in logarithms: where it is 0, they are infinite.
    pub fn what_has_poles(&self, roots: &[ExprId]) -> Vec<ExprId> {
        let mut found = Vec::new();
        for e in self.iter_reachable(roots) {
            match self.node(e) {
                Node::Product(factors) => {
                    let below = factors
                        .iter()
                        .filter(|(_, exponent)| exponent.is_negative());
                    found.extend(below.map(|&(base, _)| base));
                }
                Node::Call(Function::Ln, arguments) => found.push(arguments[0]),
                _ => {}
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Shows each distinct sub-expression once, in no particular order; what `skip` says is left out with all below it.
    fn visit(&self, e: ExprId, skip: impl Fn(ExprId) -> bool, mut show: impl FnMut(&Node)) {
        let mut seen = Flags::default();
        let mut stack = vec![e];
        while let Some(e) = stack.pop() {
            if skip(e) || !seen.raise(e, 0) {
                continue;
            }
            let node = self.node(e);
            show(node);
            node.for_each_child(|child| stack.push(child));
        }
    }

    /// e with symbols replaced, all at once. Where that puts 0 under a negative power, the value is infinite.
    pub fn substitute(&mut self, e: ExprId, replacement: &[(Symbol, ExprId)]) -> ExprId {
        let symbols: Vec<Symbol> = replacement.iter().map(|&(symbol, _)| symbol).collect();
        let bits = Pool::bits(&symbols);
        let mut known = Table::default();
        let untouched = |pool: &Pool, e| pool.symbol_bits(e) & bits == 0;
        self.ascend(e, &mut known, untouched, |pool, e, known| {
            match pool.node(e) {
                Node::Symbol(symbol) => replacement
                    .iter()
                    .find(|(s, _)| s == symbol)
                    .map_or(e, |&(_, by)| by),
                _ => pool.with_children(e, known),
            }
        })
        .unwrap_or(e)
    }

    /// Bits of symbols, to compare with those of an expression.
    pub(super) fn bits(symbols: &[Symbol]) -> u64 {
        symbols
            .iter()
            .fold(0, |bits, symbol| bits | symbol_bit(*symbol))
    }

    /// Fills a map from the leaves of e up: each distinct sub-expression once, after its children, by `build` from
    /// the map so far. What `skip` says is left out with all below it. The entry of e, if it is not skipped.
    pub(super) fn ascend(
        &mut self,
        e: ExprId,
        known: &mut Table,
        skip: impl Fn(&Pool, ExprId) -> bool,
        mut build: impl FnMut(&mut Pool, ExprId, &Table) -> ExprId,
    ) -> Option<ExprId> {
        if skip(self, e) {
            return None;
        }
        let mut stack = vec![e];
        while let Some(&top) = stack.last() {
            if !known.holds(top) {
                let height = stack.len();
                self.node(top).for_each_child(|child| {
                    if !known.holds(child) && !skip(self, child) {
                        stack.push(child);
                    }
                });
                if stack.len() > height {
                    continue;
                }
                let new = build(self, top, known);
                known.set(top, new);
            }
            stack.pop();
        }
        known.get(e)
    }

    /// The same form of other sub-expressions; those that are not in the map stay.
    pub(super) fn with_children(&mut self, e: ExprId, children: &Table) -> ExprId {
        let new = |e: &ExprId| children.get(*e).unwrap_or(*e);
        let mut changed = false;
        self.node(e)
            .for_each_child(|child| changed |= new(&child) != child);
        if !changed {
            return e;
        }
        let pairs = |list: &[(ExprId, Rational)]| {
            list.iter().map(|(e, r)| (new(e), *r)).collect::<Vec<_>>()
        };
        match self.node(e) {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => e,
            Node::Sum { constant, terms } => {
                let (constant, terms) = (*constant, pairs(terms));
                self.linear(constant, terms)
            }
            Node::Product(factors) => {
                let factors = pairs(factors);
                self.monomial(Rational::ONE, &factors)
            }
            Node::Power(base, exponent) => {
                let (base, exponent) = (new(base), new(exponent));
                match self.as_number(exponent) {
                    Some(r) => self.raise(base, r),
                    None => self.power(base, exponent),
                }
            }
            Node::Call(f, arguments) => {
                let (f, arguments) = (*f, arguments.iter().map(new).collect::<Vec<_>>());
                self.call(f, &arguments)
            }
            Node::Group(e) => {
                let e = new(e);
                self.group(e)
            }
            Node::Select {
                branch,
                then,
                otherwise,
            } => {
                let (branch, then, otherwise) = (*branch, new(then), new(otherwise));
                self.select(branch, then, otherwise)
            }
        }
    }
}
