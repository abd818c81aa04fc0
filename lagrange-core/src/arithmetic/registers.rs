//! Registers of four numbers: functions that are compiled for a processor that has them.

#[cfg(target_arch = "x86_64")]
use core::marker::PhantomData;

/// What shows that the processor has registers of four numbers, and uses them.
#[cfg(target_arch = "x86_64")]
pub type Registers = pulp::x86::V3;
/// The registers of a processor for which code is compiled in one way only.
#[cfg(not(target_arch = "x86_64"))]
#[derive(Clone, Copy, Debug)]
pub struct Registers;

/// A function of arguments `A` that is compiled for registers of four numbers: its implementation is `#[inline(always)]`.
pub trait Body<A> {
    /// What it returns.
    type Output;
    /// The function.
    fn run(registers: Registers, arguments: A) -> Self::Output;
}

/// Calls a function that is compiled for registers of four numbers; its arguments again if the processor does not have them.
// Each kind of processor would cost the compiler its time once more.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
pub(crate) fn across<B: Body<A>, A>(arguments: A) -> Result<B::Output, A> {
    struct Across<B, A>(Registers, A, PhantomData<B>);

    impl<A, B: Body<A>> pulp::NullaryFnOnce for Across<B, A> {
        type Output = B::Output;

        #[inline(always)]
        fn call(self) -> B::Output {
            B::run(self.0, self.1)
        }
    }
    match Registers::try_new() {
        Some(processor) => {
            Ok(processor.vectorize(Across::<B, A>(processor, arguments, PhantomData)))
        }
        None => Err(arguments),
    }
}

/// Calls a function.
#[cfg(not(target_arch = "x86_64"))]
#[inline(always)]
pub(crate) fn across<B: Body<A>, A>(arguments: A) -> Result<B::Output, A> {
    Ok(B::run(Registers, arguments))
}
