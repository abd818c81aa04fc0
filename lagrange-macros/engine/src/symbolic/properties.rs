//! What is known of each node at once: which symbols occur, whether it varies, which rules can apply to it.

use super::facts::Facts;
use super::table::Table;
use super::{ExprId, Function, Node, Pool, Symbol};

impl Pool {
    /// Bits of the symbols that occur.
    pub(super) fn symbol_bits(&self, e: ExprId) -> u64 {
        self.facts[e.index()].symbols
    }

    /// Whether a selection occurs.
    pub(super) fn holds_selection(&self, e: ExprId) -> bool {
        self.symbol_bits(e) >> 63 == 1
    }

    /// Whether it is a product with a squared sin, cos, sinh or cosh.
    pub(super) fn has_square(&self, e: ExprId) -> bool {
        self.facts[e.index()].square
    }

    /// Whether it is a product with factors that merge with others by more than their base.
    pub(super) fn has_merging(&self, e: ExprId) -> bool {
        self.facts[e.index()].merging
    }

    /// Declares symbols that do not change during a run. Operations on them alone are done once, so they do not
    /// count, and `simplify` prefers forms with few of the others.
    pub fn fix(&mut self, symbols: &[Symbol]) {
        for symbol in symbols {
            self.fixed[symbol.index()] = true;
            self.has_fixed = true;
        }
        // Children come first.
        for i in 0..self.nodes.len() {
            self.facts[i].varies = self.is_varying(&self.nodes[i]);
        }
        self.simplified = Table::default();
    }

    /// Whether it changes during a run: it holds a symbol that is not fixed, or a selection.
    pub fn varies(&self, e: ExprId) -> bool {
        self.facts[e.index()].varies
    }

    pub(super) fn has_fixed(&self) -> bool {
        self.has_fixed
    }

    fn is_varying(&self, node: &Node) -> bool {
        match node {
            Node::Symbol(symbol) => !self.fixed[symbol.index()],
            Node::Select { .. } => true,
            _ => {
                let mut varies = false;
                node.for_each_child(|child| varies |= self.varies(child));
                varies
            }
        }
    }

    pub(super) fn facts_of(&self, hash: u64, node: &Node) -> Facts {
        Facts {
            hash,
            symbols: self.bits_of(node),
            square: self.contains_square(node),
            merging: self.contains_merging(node),
            varies: self.is_varying(node),
        }
    }

    fn bits_of(&self, node: &Node) -> u64 {
        if let Node::Symbol(symbol) = node {
            return symbol_bit(*symbol);
        }
        let mut bits = if matches!(node, Node::Select { .. }) {
            1 << 63
        } else {
            0
        };
        node.for_each_child(|child| bits |= self.facts[child.index()].symbols);
        bits
    }

    fn contains_merging(&self, node: &Node) -> bool {
        let Node::Product(factors) = node else {
            return false;
        };
        factors.iter().any(|&(base, _)| {
            matches!(
                self.node(base),
                Node::Power(..) | Node::Call(Function::Exp, _)
            )
        })
    }

    fn contains_square(&self, node: &Node) -> bool {
        let Node::Product(factors) = node else {
            return false;
        };
        factors.iter().any(|&(base, exponent)| {
            exponent.is_integer()
                && exponent.numerator() >= 2
                && matches!(
                    self.node(base),
                    Node::Call(
                        Function::Sin | Function::Cos | Function::Sinh | Function::Cosh,
                        _
                    )
                )
        })
    }
}

/// Bit of a symbol in the sets that quickly say "does not occur"; symbols 63 apart share one.
pub(super) fn symbol_bit(symbol: Symbol) -> u64 {
    1 << (symbol.0 % 63)
}
