//! Which numbers the tapes take from the constants: each a parameter-only expression, with the needs that ask for it.

use super::needs::OutputMask;
use super::tape::Coefficient;
use crate::derive::NeedId;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Node, Pool, Symbol};

/// What a constant is.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Source {
    /// One expression, computed for whoever asks.
    Whole(ExprId),
    /// The sum of those terms whose need is held.
    Masked(Vec<(NeedId, ExprId)>),
}

/// The constants that have been asked for.
pub(super) struct Constants {
    /// Index of each field's symbol.
    parameters: SortedMap<Symbol, usize>,
    /// Whether constants may be asked for at all (the constants program itself has only numbers and multiples of π).
    open: bool,
    index: SortedMap<Source, usize>,
    symbols: SortedMap<Symbol, usize>,
    /// In order of index.
    pub sources: Vec<(Source, OutputMask)>,
}

impl Constants {
    /// None yet.
    pub fn new(parameters: SortedMap<Symbol, usize>) -> Constants {
        let (index, symbols) = (SortedMap::new(), SortedMap::new());
        Constants {
            parameters,
            open: true,
            index,
            symbols,
            sources: Vec::new(),
        }
    }

    /// For programs whose only coefficients are exact numbers and multiples of π.
    pub fn closed() -> Constants {
        Constants {
            open: false,
            ..Constants::new(SortedMap::new())
        }
    }

    /// The constant of this source.
    pub fn constant(&mut self, source: Source) -> usize {
        let next = self.sources.len();
        let index = *self.index.get_or_insert(source.clone(), next);
        if index == next {
            self.sources.push((source, OutputMask::default()));
        }
        index
    }

    /// A masked sum as an expression, so that it can be an operand of others.
    pub fn masked(&mut self, pool: &mut Pool, terms: Vec<(NeedId, ExprId)>) -> ExprId {
        let index = self.constant(Source::Masked(terms));
        let symbol = match self.symbols.iter().find(|(_, known)| **known == index) {
            Some((symbol, _)) => *symbol,
            None => {
                let symbol = pool.symbol(&format!("c{index}"));
                self.symbols.insert(symbol, index);
                symbol
            }
        };
        pool.leaf(symbol)
    }

    /// Whether it is a masked sum, which no other constant may contain.
    pub fn is_masked(&self, pool: &Pool, e: ExprId) -> bool {
        matches!(pool.node(e), Node::Symbol(symbol) if self.symbols.contains_key(symbol))
    }

    /// Where a tape finds a fixed expression.
    pub fn coefficient(&mut self, pool: &Pool, e: ExprId) -> Coefficient {
        if let Some(multiple) = pool.as_multiple_of_pi(e) {
            return Coefficient::Pi(multiple);
        }
        match pool.node(e) {
            Node::Number(number) => return Coefficient::Number(*number),
            Node::Symbol(symbol) => {
                if let Some(index) = self.parameters.get(symbol) {
                    return Coefficient::Parameter(*index);
                }
                if let Some(index) = self.symbols.get(symbol) {
                    return Coefficient::Constant(*index);
                }
            }
            _ => {}
        }
        assert!(self.open, "`{}` is not a number", pool.print(e));
        Coefficient::Constant(self.constant(Source::Whole(e)))
    }

    /// Notes who reads a coefficient.
    pub fn ask(&mut self, coefficient: Coefficient, needs: &OutputMask) {
        if let Coefficient::Constant(index) = coefficient {
            self.sources[index].1.join(needs);
        }
    }
}
