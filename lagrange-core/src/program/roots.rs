//! Series of roots whose argument vanishes where they begin.
//!
//! The speed of a body at rest is √(v·v): of v = v₁ τ + v₂ τ² + … it is |v₁| τ + …, a series for what comes after, though √x has none at 0.
//! Coefficient k of such a root needs coefficients of its argument beyond k, which the recurrences of a series have not yet when they
//! need it. Where the root enters what it is made of with a factor that vanishes too, as in a drag −c |v| v, an expansion with too few of
//! its coefficients is right to some order, and the argument in it to more: the expansion is repeated until nothing changes.
//!
//! What stays at rest has a root that stays zero. It must be the only motion there: in r̈ = √r, Norton's dome (Norton 2003, Causation as
//! folk science, section 3), r = 0 is not. There √r does not exist for r < 0, as √(v·v) does on all sides.

use super::instruction::{Instruction, Op, Register};
use crate::arithmetic::Scalar;
use crate::arithmetic::products::{ROW, Row};

/// A root that begins at zero, whose coefficients are given.
#[derive(Clone, Debug)]
pub(super) struct Root<T> {
    /// What stands in its place in the program.
    own: Instruction,
    /// n of x^(n/2).
    halves: usize,
    /// Whether states nearby have it too.
    surrounded: bool,
    coefficients: Row<T>,
}

impl<T: Copy> Root<T> {
    /// The instruction that it is.
    pub(super) fn own(&self) -> Instruction {
        self.own
    }

    /// Coefficient k.
    pub(super) fn coefficient(&self, k: usize) -> T {
        self.coefficients[k % ROW]
    }
}

impl<T: Scalar> Root<T> {
    /// If an instruction is a root that is zero where the registers are `first`; on two sides they are `beside`.
    pub(super) fn of(own: Instruction, first: &[T], beside: &[Vec<T>; 2]) -> Option<Root<T>> {
        let at = |registers: &[T], register: Register| registers[register.index()].value();
        let halves = match own.op {
            Op::Sqrt => 1.0,
            _ => 2.0 * at(first, own.y),
        };
        let is_root = halves.fract() == 0.0 && (1.0..=16.0).contains(&halves);
        // Of a number with derivatives, those of a root at zero are infinite.
        let has_series = T::DERIVATIVES == 0 && is_root && at(first, own.x) == 0.0;
        has_series.then(|| Root {
            own,
            halves: halves as usize,
            surrounded: beside.iter().all(|near| at(near, own.x) >= 0.0),
            coefficients: [T::zero(); ROW],
        })
    }

    /// The instruction in its place: what is copied from where it goes stays there.
    pub(super) fn given(&self) -> Instruction {
        let Instruction { to, y, .. } = self.own;
        Instruction {
            op: Op::Copy,
            to,
            x: to,
            y,
        }
    }

    /// Takes the coefficients that follow from those of its argument; whether any has changed. None if it has no series.
    pub(super) fn follow(&mut self, argument: &[T]) -> Option<bool> {
        let found = half_power(argument, self.halves)?;
        let stays = found.iter().all(|c| c.value() == 0.0);
        let alone = self.halves > 1 || self.surrounded;
        let same = |(a, b): (&T, &T)| a.value() == b.value();
        let changed = !found.iter().zip(&self.coefficients).all(same);
        self.coefficients = found;
        (!stays || alone).then_some(changed)
    }
}

/// x^(n/2) for τ > 0 of a series that begins at zero; none if there is no such series.
fn half_power<T: Scalar>(x: &[T], halves: usize) -> Option<Row<T>> {
    let mut base = [T::zero(); ROW];
    let times = match halves % 2 {
        0 => {
            base.iter_mut().zip(x).for_each(|(base, &x)| *base = x);
            halves / 2
        }
        _ => {
            root(x, &mut base)?;
            halves
        }
    };
    let mut power = base;
    for _ in 1..times {
        let before = power;
        for (k, c) in power.iter_mut().enumerate() {
            *c = (0..=k).fold(T::zero(), |sum, i| sum + before[i] * base[k - i]);
        }
    }
    Some(power)
}

/// √x, in the place of zeros: none if the first power of x is odd, or its coefficient negative.
fn root<T: Scalar>(x: &[T], root: &mut Row<T>) -> Option<()> {
    let Some(first) = x.iter().position(|c| c.value() != 0.0) else {
        return Some(());
    };
    let lead = x[first].sqrt();
    if first % 2 == 1 || !(lead.value() > 0.0) {
        return None;
    }
    // √(τ²ᵖ w) = τᵖ √w
    let w = &x[first..];
    let s = &mut root[first / 2..];
    s[0] = lead;
    for k in 1..w.len() {
        let earlier = (1..k).fold(T::zero(), |sum, i| sum + s[i] * s[k - i]);
        s[k] = (w[k] - earlier) / (lead + lead);
    }
    Some(())
}
