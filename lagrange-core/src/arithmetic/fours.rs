//! Four numbers side by side, of any kind.

use super::registers::Registers;
use core::fmt::Debug;

/// Numbers side by side: so many products are summed at once.
pub(crate) const GROUP: usize = 4;

/// Numbers of which four lie side by side, in one register where there are such.
pub trait Fours: Copy {
    /// Four numbers.
    type Four: Copy + Debug + Send + Sync + 'static;
    /// Whether a register takes them.
    const IN_REGISTERS: bool = false;
    /// Four zeros.
    fn zeros() -> Self::Four;
    /// Four numbers. What is read at once is written at once, or the processor waits.
    fn four(registers: Registers, numbers: [Self; GROUP]) -> Self::Four;
    /// The numbers again.
    fn numbers(four: Self::Four) -> [Self; GROUP];
    /// x y of each.
    fn product(registers: Registers, x: Self::Four, y: Self::Four) -> Self::Four;
    /// x + y of each.
    fn sum(registers: Registers, x: Self::Four, y: Self::Four) -> Self::Four;
    /// x y + z of each, as [`Scalar::fused`](super::Scalar::fused).
    fn add_products(
        registers: Registers,
        x: Self::Four,
        y: Self::Four,
        z: Self::Four,
    ) -> Self::Four;
}
