//! The store of nodes: one node per form, found again by its hash; and the elementary constructors.

use super::hash::{Memo, Mix};
use super::table::Table;
use super::trigonometry::Square;
use super::{ExprId, Function, Node, Rational, Symbol};
use std::hash::Hasher;

/// What is kept beside each node.
#[derive(Clone, Copy)]
struct Facts {
    hash: u64,
    /// Bit (index mod 63) of each symbol that occurs: a quick "does not depend on". Bit 63: holds a selection.
    symbols: u64,
    /// A product with a factor sin², cos², sinh² or cosh².
    square: bool,
    /// A product with a factor exp or a general power, which merge with their like.
    merging: bool,
    /// Holds a symbol that is not fixed, or a selection.
    varies: bool,
}

/// All expressions of a system.
pub struct Pool {
    nodes: Vec<Node>,
    facts: Vec<Facts>,
    /// Open addressing by hash: id + 1, or 0 for a free place.
    table: Vec<u32>,
    names: Vec<String>,
    /// By symbol.
    fixed: Vec<bool>,
    has_fixed: bool,
    leaves: Vec<ExprId>,
    pub(super) pi: Option<ExprId>,
    pub(super) overflow: bool,
    /// Per direction of differentiation: which memo.
    pub(super) directions: Memo<Vec<(Symbol, ExprId)>, usize>,
    /// Derivatives of nodes along each direction.
    pub(super) derivatives: Vec<Table>,
    /// Sum → (content, sum/content).
    pub(super) primitive: Memo<ExprId, (Rational, ExprId)>,
    /// Product → the squares it contains.
    pub(super) squares: Memo<ExprId, Vec<Square>>,
    /// Expression → multiplied out.
    pub(super) expanded: Table,
    /// Expression → the cheapest form.
    pub(super) simplified: Table,
}

impl Default for Pool {
    fn default() -> Pool {
        Pool::new()
    }
}

impl Pool {
    /// An empty pool.
    pub fn new() -> Pool {
        Pool {
            nodes: Vec::new(),
            facts: Vec::new(),
            table: vec![0; 1024],
            names: Vec::new(),
            fixed: Vec::new(),
            has_fixed: false,
            leaves: Vec::new(),
            pi: None,
            overflow: false,
            directions: Memo::default(),
            derivatives: Vec::new(),
            primitive: Memo::default(),
            squares: Memo::default(),
            expanded: Table::default(),
            simplified: Table::default(),
        }
    }

    /// A new symbol; names are for printing, two symbols may share one.
    pub fn symbol(&mut self, name: &str) -> Symbol {
        let symbol = Symbol(self.names.len() as u32);
        self.names.push(name.to_owned());
        self.fixed.push(false);
        let leaf = self.intern(Node::Symbol(symbol));
        self.leaves.push(leaf);
        symbol
    }

    /// Name of a symbol.
    pub fn name(&self, symbol: Symbol) -> &str {
        &self.names[symbol.index()]
    }

    /// The expression that is just this symbol.
    pub fn leaf(&mut self, symbol: Symbol) -> ExprId {
        self.leaves[symbol.index()]
    }

    /// An integer.
    pub fn integer(&mut self, n: i64) -> ExprId {
        self.number(Rational::integer(n))
    }

    /// An exact number.
    pub fn number(&mut self, n: Rational) -> ExprId {
        self.intern(Node::Number(n))
    }

    /// π
    pub fn pi(&mut self) -> ExprId {
        let pi = self.intern(Node::Pi);
        self.pi = Some(pi);
        pi
    }

    /// The form of an expression.
    pub fn node(&self, e: ExprId) -> &Node {
        &self.nodes[e.index()]
    }

    /// The number, if it is one.
    pub fn as_number(&self, e: ExprId) -> Option<Rational> {
        if let Node::Number(n) = self.node(e) {
            Some(*n)
        } else {
            None
        }
    }

    /// Whether it is the number 0.
    pub fn is_zero(&self, e: ExprId) -> bool {
        matches!(self.node(e), Node::Number(n) if n.is_zero())
    }

    /// Whether it is the number 1.
    pub fn is_one(&self, e: ExprId) -> bool {
        matches!(self.node(e), Node::Number(n) if n.is_one())
    }

    /// Selection on a branch (equal sides: that side).
    pub fn select(&mut self, branch: usize, then: ExprId, otherwise: ExprId) -> ExprId {
        // Inside a side of a branch the same branch is decided.
        let then = match *self.node(then) {
            Node::Select {
                branch: inner,
                then,
                ..
            } if inner == branch => then,
            _ => then,
        };
        let otherwise = match *self.node(otherwise) {
            Node::Select {
                branch: inner,
                otherwise,
                ..
            } if inner == branch => otherwise,
            _ => otherwise,
        };
        if then == otherwise {
            then
        } else {
            self.intern(Node::Select {
                branch,
                then,
                otherwise,
            })
        }
    }

    /// Whether an exact number overflowed on the way (then forms are unreliable; reported as an error).
    pub fn overflowed(&self) -> bool {
        self.overflow
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether nothing has been built.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The result, or 1 with the overflow noted.
    pub(super) fn checked(&mut self, result: Option<Rational>) -> Rational {
        result.unwrap_or_else(|| {
            self.overflow = true;
            Rational::ONE
        })
    }

    pub(super) fn plus(&mut self, a: Rational, b: Rational) -> Rational {
        self.checked(a.checked_add(b))
    }

    pub(super) fn times(&mut self, a: Rational, b: Rational) -> Rational {
        if b.is_one() {
            a
        } else {
            self.checked(a.checked_mul(b))
        }
    }

    pub(super) fn negative(&mut self, a: Rational) -> Rational {
        self.checked(a.checked_neg())
    }

    /// Bits of the symbols that occur.
    pub(super) fn symbol_bits(&self, e: ExprId) -> u64 {
        self.facts[e.index()].symbols
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

    /// The expression of a form, if it has been built.
    pub(super) fn find(&self, node: &Node) -> Option<ExprId> {
        let hash = hash_of(node);
        let mask = self.table.len() - 1;
        let mut at = hash as usize & mask;
        while self.table[at] != 0 {
            let id = self.table[at] - 1;
            if self.facts[id as usize].hash == hash && self.nodes[id as usize] == *node {
                return Some(ExprId(id));
            }
            at = (at + 1) & mask;
        }
        None
    }

    /// The one expression of a form, which must be canonical.
    pub(super) fn intern(&mut self, node: Node) -> ExprId {
        let hash = hash_of(&node);
        let mask = self.table.len() - 1;
        let mut at = hash as usize & mask;
        while self.table[at] != 0 {
            let id = self.table[at] - 1;
            if self.facts[id as usize].hash == hash && self.nodes[id as usize] == node {
                return ExprId(id);
            }
            at = (at + 1) & mask;
        }
        let id = self.nodes.len() as u32;
        self.table[at] = id + 1;
        let facts = Facts {
            hash,
            symbols: self.bits_of(&node),
            square: self.contains_square(&node),
            merging: self.contains_merging(&node),
            varies: self.is_varying(&node),
        };
        self.facts.push(facts);
        self.nodes.push(node);
        if self.nodes.len() * 2 > self.table.len() {
            self.grow();
        }
        ExprId(id)
    }

    fn grow(&mut self) {
        let size = self.table.len() * 4;
        self.table.clear();
        self.table.resize(size, 0);
        for (id, facts) in self.facts.iter().enumerate() {
            let mut at = facts.hash as usize & (size - 1);
            while self.table[at] != 0 {
                at = (at + 1) & (size - 1);
            }
            self.table[at] = id as u32 + 1;
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

fn hash_of(node: &Node) -> u64 {
    let mut mix = Mix::default();
    let rational = |mix: &mut Mix, r: Rational| {
        mix.wide(r.numerator());
        mix.wide(r.denominator());
    };
    let pairs = |mix: &mut Mix, list: &[(ExprId, Rational)]| {
        for &(e, r) in list {
            mix.word(u64::from(e.0));
            rational(mix, r);
        }
    };
    match node {
        Node::Number(n) => {
            mix.word(1);
            rational(&mut mix, *n);
        }
        Node::Pi => mix.word(2),
        Node::Symbol(symbol) => {
            mix.word(3);
            mix.word(u64::from(symbol.0));
        }
        Node::Sum { constant, terms } => {
            mix.word(4);
            rational(&mut mix, *constant);
            pairs(&mut mix, terms);
        }
        Node::Product(factors) => {
            mix.word(5);
            pairs(&mut mix, factors);
        }
        Node::Power(base, exponent) => {
            mix.word(6);
            mix.word(u64::from(base.0));
            mix.word(u64::from(exponent.0));
        }
        Node::Call(f, arguments) => {
            mix.word(7 + 16 * (*f as u64));
            for e in arguments {
                mix.word(u64::from(e.0));
            }
        }
        Node::Select {
            branch,
            then,
            otherwise,
        } => {
            mix.word(8);
            mix.word(*branch as u64);
            mix.word(u64::from(then.0));
            mix.word(u64::from(otherwise.0));
        }
    }
    mix.finish()
}
