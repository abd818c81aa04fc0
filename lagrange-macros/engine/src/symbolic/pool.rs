//! The store of nodes: one node per form, found again by its hash; and the elementary constructors.

use super::facts::Facts;
use super::hash::{Memo, hash_of};
use super::square::Square;
use super::table::Table;
use super::{ExprId, Node, Rational, Symbol};
use core::fmt;

/// With more expressions and operands than these a pool is full: a derivation that needs them would take a build,
/// unoptimised, half a minute and more.
pub const MOST_OPERANDS: usize = 1_000_000;

/// Exponents go up to this: they multiply where powers are raised, and once more where a square root of a product is, which stays below 2³¹.
pub(super) const MOST_EXPONENT: u128 = 10_000;

/// What has become larger than is kept exactly.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Outgrown {
    /// Numerators and denominators.
    Numbers,
    /// Exponents of products, beyond the largest that is kept.
    Exponents,
}

impl Outgrown {
    /// What is wrong with `what`, in words.
    pub fn of(self, what: &dyn fmt::Display) -> String {
        match self {
            Outgrown::Numbers => format!("the exact numbers of {what} outgrow 38 digits"),
            Outgrown::Exponents => format!("the exponents of {what} outgrow {MOST_EXPONENT}"),
        }
    }
}

/// All expressions of a system.
#[derive(Clone)]
pub struct Pool {
    pub(super) nodes: Vec<Node>,
    pub(super) facts: Vec<Facts>,
    /// Open addressing by hash: id + 1, or 0 for a free place.
    table: Vec<u32>,
    names: Vec<String>,
    /// By symbol.
    pub(super) fixed: Vec<bool>,
    pub(super) has_fixed: bool,
    leaves: Vec<ExprId>,
    pub(super) pi: Option<ExprId>,
    pub(super) outgrown: Option<Outgrown>,
    /// Nodes, and the operands of each.
    size: usize,
    /// With more of them it is full.
    most: usize,
    /// Work done by rewriting: terms and nodes looked at.
    pub(super) effort: u64,
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
            outgrown: None,
            size: 0,
            most: MOST_OPERANDS,
            effort: 0,
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

    /// The number c, if the expression is c π with c ≠ 0.
    pub fn as_multiple_of_pi(&self, e: ExprId) -> Option<Rational> {
        match self.node(e) {
            Node::Pi => Some(Rational::ONE),
            Node::Sum { constant, terms } if constant.is_zero() => match terms[..] {
                [(term, c)] if matches!(self.node(term), Node::Pi) => Some(c),
                _ => None,
            },
            _ => None,
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

    /// What outgrew its bounds first on the way (then forms are unreliable; reported as an error).
    pub fn outgrown(&self) -> Option<Outgrown> {
        self.outgrown
    }

    /// Notes that something has, unless it was noted before.
    pub(super) fn note_outgrown(&mut self, what: Outgrown) {
        self.outgrown = self.outgrown.or(Some(what));
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are too many. Work that builds more stops then, and what it has built is of no use.
    pub fn is_full(&self) -> bool {
        self.size > self.most
    }

    /// Lets it have so many expressions and operands, at first [`MOST_OPERANDS`].
    pub fn allow(&mut self, operands: usize) {
        self.most = operands;
    }

    /// Whether nothing has been built.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The result, or 1 where a number has outgrown its digits, which is noted.
    pub(super) fn checked(&mut self, result: Option<Rational>) -> Rational {
        result.unwrap_or_else(|| {
            self.note_outgrown(Outgrown::Numbers);
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

    /// The expression of a form, if it has been built.
    pub(super) fn find(&self, node: &Node) -> Option<ExprId> {
        self.place(hash_of(node), node).ok()
    }

    /// The one expression of a form, which must be canonical.
    pub(super) fn intern(&mut self, node: Node) -> ExprId {
        let hash = hash_of(&node);
        let at = match self.place(hash, &node) {
            Ok(known) => return known,
            Err(free) => free,
        };
        let id = self.nodes.len() as u32;
        self.table[at] = id + 1;
        self.size += 1;
        node.for_each_child(|_| self.size += 1);
        let facts = self.facts_of(hash, &node);
        self.facts.push(facts);
        self.nodes.push(node);
        if self.nodes.len() * 2 > self.table.len() {
            self.grow();
        }
        ExprId(id)
    }

    /// The expression of a form, or its free place in the table.
    fn place(&self, hash: u64, node: &Node) -> Result<ExprId, usize> {
        let mask = self.table.len() - 1;
        let mut at = hash as usize & mask;
        while self.table[at] != 0 {
            let id = ExprId(self.table[at] - 1);
            if self.facts[id.index()].hash == hash && self.nodes[id.index()] == *node {
                return Ok(id);
            }
            at = (at + 1) & mask;
        }
        Err(at)
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
}
