//! A hash-consed pool of expressions: build, differentiate, simplify, evaluate, print. Std only.
//!
//! Building is canonical: sums and products are flat, sorted, with like terms collected and numbers folded
//! exactly, so equal forms have equal ids. sin²u + cos²u = 1 is applied by sums.
//!
//! Architecture invariant: an expression is made of expressions with smaller ids, so ascending ids are a
//! topological order, and what a pool contains depends on nothing but the calls that built it.

mod angles;
mod differentiate;
mod digits;
mod evaluate;
mod expand;
mod factor;
mod facts;
pub mod field;
mod function;
mod group;
mod hash;
mod linear;
mod magnitude;
mod node;
mod operations;
mod pool;
mod print;
mod product;
mod properties;
mod rational;
mod root;
mod sides;
mod simplify;
mod square;
mod sum;
mod table;
mod traverse;
mod trigonometry;
mod zeros;

pub use node::{ExprId, Function, Node, Symbol};
pub use pool::{MOST_OPERANDS, Outgrown, Pool};
pub use rational::Rational;

#[cfg(test)]
mod tests;
