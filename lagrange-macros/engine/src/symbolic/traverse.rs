//! What an expression is made of: sub-expressions, symbols, branches; replacement of symbols.

use super::hash::Memo;
use super::{ExprId, Node, Pool, Rational, Symbol};

impl Pool {
    /// Everything that the roots are made of, the roots included, each once, ascending (a topological order).
    pub fn iter_reachable(&self, roots: &[ExprId]) -> Vec<ExprId> {
        let Some(last) = roots.iter().max() else {
            return Vec::new();
        };
        let mut seen = vec![false; last.index() + 1];
        let mut stack = roots.to_vec();
        while let Some(e) = stack.pop() {
            if !seen[e.index()] {
                seen[e.index()] = true;
                self.node(e).for_each_child(|child| {
                    if !seen[child.index()] {
                        stack.push(child);
                    }
                });
            }
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
            .fold(0, |bits, symbol| bits | 1_u64 << (symbol.0 % 64));
        if self.symbol_bits(e) & bits == 0 {
            return false;
        }
        let mut seen: Memo<ExprId, ()> = Memo::default();
        let mut stack = vec![e];
        let mut found = false;
        while let Some(e) = stack.pop() {
            if self.symbol_bits(e) & bits == 0 || seen.insert(e, ()).is_some() {
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
        let reachable = self.iter_reachable(&[e]).into_iter();
        let mut symbols: Vec<Symbol> = reachable
            .filter_map(|e| {
                if let Node::Symbol(symbol) = self.node(e) {
                    Some(*symbol)
                } else {
                    None
                }
            })
            .collect();
        symbols.sort();
        symbols
    }

    /// All branches that occur, ascending.
    pub fn branches(&self, e: ExprId) -> Vec<usize> {
        let reachable = self.iter_reachable(&[e]).into_iter();
        let mut branches: Vec<usize> = reachable
            .filter_map(|e| {
                if let Node::Select { branch, .. } = self.node(e) {
                    Some(*branch)
                } else {
                    None
                }
            })
            .collect();
        branches.sort();
        branches.dedup();
        branches
    }

    /// e with symbols replaced, all at once. Where that puts 0 under a negative power, the value is infinite.
    pub fn substitute(&mut self, e: ExprId, replacement: &[(Symbol, ExprId)]) -> ExprId {
        let bits = replacement
            .iter()
            .fold(0, |bits, &(symbol, _)| bits | 1_u64 << (symbol.0 % 64));
        self.rebuild(e, bits, |pool, e| match pool.node(e) {
            Node::Symbol(symbol) => replacement
                .iter()
                .find(|(s, _)| s == symbol)
                .map(|&(_, by)| by),
            _ => None,
        })
    }

    /// e with every sub-expression that holds a symbol of `bits` replaced, from the leaves up: by `replace` (of the
    /// old node) where it gives one, else by the same form of the new sub-expressions.
    fn rebuild(
        &mut self,
        e: ExprId,
        bits: u64,
        replace: impl Fn(&Pool, ExprId) -> Option<ExprId>,
    ) -> ExprId {
        let mut known: Memo<ExprId, ExprId> = Memo::default();
        let mut stack = vec![e];
        while let Some(&top) = stack.last() {
            let height = stack.len();
            if self.symbol_bits(top) & bits == 0 {
                known.insert(top, top);
            }
            if !known.contains_key(&top) {
                self.node(top).for_each_child(|child| {
                    if !known.contains_key(&child) {
                        stack.push(child);
                    }
                });
                if stack.len() > height {
                    continue;
                }
                let new = replace(self, top).unwrap_or_else(|| self.with_children(top, &known));
                known.insert(top, new);
            }
            stack.pop();
        }
        known[&e]
    }

    /// The same form of other sub-expressions; those that are not in the map stay.
    pub(super) fn with_children(&mut self, e: ExprId, children: &Memo<ExprId, ExprId>) -> ExprId {
        let new = |e: &ExprId| children.get(e).copied().unwrap_or(*e);
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
