//! The order in which factors stand in a product, and terms in a sum.

use super::Reader;
use crate::inspect::formula::Formula;
use crate::inspect::names::{Kind, Known};
use crate::symbolic::{ExprId, Node, Rational};

/// What an expression is made of.
#[derive(Clone, Copy)]
pub(super) struct Contents {
    /// The last kind of its symbols.
    latest: Option<Kind>,
    /// The first of its symbols.
    symbol: usize,
    /// The first place that one of its symbols has among its kind.
    order: usize,
}

/// Where a factor stands in a product, then among its like.
pub(super) type Rank = (u8, usize, usize);

/// Where a term stands in a sum.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct ValueRef {
    forces: i64,
    rates: i64,
    mixed: bool,
    velocities: Vec<usize>,
    still: bool,
    ranks: Vec<(Rank, Rational)>,
}

impl Default for ValueRef {
    fn default() -> ValueRef {
        ValueRef {
            forces: 0,
            rates: 0,
            mixed: false,
            velocities: Vec::new(),
            still: true,
            ranks: Vec::new(),
        }
    }
}

pub(super) const NUMBER: u8 = 0;

pub(super) const PARAMETER: u8 = 2;

pub(super) const MOVING_SUM: u8 = 10;

pub(super) const FUNCTION: u8 = 11;

impl Reader<'_> {
    /// Whether it holds parameters and time only.
    pub fn is_still(&self, e: ExprId) -> bool {
        self.is_below(e, Kind::Position)
    }

    /// Whether all its symbols are of a kind before this one.
    pub(super) fn is_below(&self, e: ExprId, kind: Kind) -> bool {
        self.contents(e).latest.is_none_or(|latest| latest < kind)
    }

    /// What an expression is made of; once for each.
    pub(super) fn contents(&self, e: ExprId) -> Contents {
        if let Some(known) = self.seen.borrow().get(&e) {
            return *known;
        }
        let mut contents = Contents {
            latest: None,
            symbol: usize::MAX,
            order: usize::MAX,
        };
        if let Node::Symbol(symbol) = self.pool.node(e) {
            let known = self.names.symbol(*symbol);
            contents.latest = Some(known.map_or(Kind::Force, |known| known.kind));
            contents.symbol = symbol.index();
            contents.order = known.map_or(usize::MAX, |known| known.order);
        }
        let mut children = Vec::new();
        self.pool
            .node(e)
            .for_each_child(|child| children.push(child));
        for child in children {
            let inner = self.contents(child);
            contents.latest = contents.latest.max(inner.latest);
            contents.symbol = contents.symbol.min(inner.symbol);
            contents.order = contents.order.min(inner.order);
        }
        self.seen.borrow_mut().insert(e, contents);
        contents
    }

    /// Where a term stands in a sum: what moves most comes first, squares before products, numbers last.
    pub(super) fn place(&self, factors: &[(ExprId, Rational)]) -> ValueRef {
        let mut place = ValueRef::default();
        for &(base, exponent) in factors {
            if let Node::Symbol(symbol) = self.pool.node(base)
                && let Some(known) = self.names.symbol(*symbol)
            {
                let size = i64::try_from(exponent.numerator()).unwrap_or(1);
                match known.kind {
                    Kind::Acceleration => {
                        place.rates -= 16 * size;
                        place.velocities.push(known.order);
                    }
                    Kind::Velocity => {
                        place.rates -= size;
                        place.velocities.push(known.order);
                    }
                    Kind::Force => place.forces += size,
                    _ => {}
                }
            }
            place.still &= self.is_still(base);
            place.ranks.push((self.rank(base), exponent));
        }
        place.velocities.sort_unstable();
        place.mixed = place.velocities.len() > 1;
        place.ranks.sort_unstable();
        place
    }

    /// The rank of a factor that is a formula already.
    pub(super) fn place_of(&self, f: &Formula) -> Rank {
        match f {
            Formula::Number(_) | Formula::Decimal(_) => (NUMBER, 0, 0),
            Formula::Letter(letter) => self
                .names
                .of_letter(letter)
                .map_or((MOVING_SUM, 0, 0), rank_of),
            Formula::Power(base, _) => self.place_of(base),
            Formula::Call(..) => (FUNCTION, usize::MAX, 0),
            _ => (MOVING_SUM, 0, 0),
        }
    }

    pub(super) fn rank(&self, e: ExprId) -> Rank {
        match self.pool.node(e) {
            Node::Number(_) => (NUMBER, 0, 0),
            Node::Pi => (1, 0, 0),
            Node::Symbol(symbol) => match self.names.symbol(*symbol) {
                Some(known) => rank_of(known),
                None => (9, symbol.index(), 0),
            },
            Node::Call(..) => (FUNCTION, self.contents(e).symbol, e.index()),
            // A sum of masses stands where masses stand.
            Node::Sum { .. } if self.is_still(e) => (PARAMETER, self.contents(e).order, e.index()),
            _ => (MOVING_SUM, 0, e.index()),
        }
    }
}

fn rank_of(known: &Known) -> Rank {
    let kind = match known.kind {
        Kind::Parameter => PARAMETER,
        Kind::Time => 3,
        Kind::Position => 4,
        Kind::Velocity => 6,
        Kind::Acceleration => 7,
        Kind::Force => 8,
    };
    (kind, known.order, 0)
}
