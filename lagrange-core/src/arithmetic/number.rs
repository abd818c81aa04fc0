//! What the equations of a mode work with: a number, or the numbers of several motions side by side.

use super::fours::Fours;
use super::pack::each_lane;
use super::{Pack, Scalar};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// So many units of rounding may be between 1 and a cosine.
const BEYOND: f64 = 8.0;

/// A number of a motion, or one of each of several motions: every operation gives each what it would give it alone.
pub trait Number:
    Fours
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// The same number in every place.
    fn of(x: f64) -> Self;
    /// x y + z, rounded as [`Scalar::mul_add`] rounds.
    fn mul_add(self, y: Self, z: Self) -> Self;
    /// x y + z, rounded once, for code that is compiled for [`Registers`](super::Registers).
    fn fused(self, y: Self, z: Self) -> Self;
    /// √x
    fn sqrt(self) -> Self;
    /// eˣ
    fn exp(self) -> Self;
    /// ln x
    fn ln(self) -> Self;
    /// (sin x, cos x)
    fn sin_cos(self) -> (Self, Self);
    /// tan x
    fn tan(self) -> Self;
    /// asin x
    fn asin(self) -> Self;
    /// acos x
    fn acos(self) -> Self;
    /// atan x
    fn atan(self) -> Self;
    /// Angle of the point (x, y), y = self.
    fn atan2(self, x: Self) -> Self;
    /// (sinh x, cosh x)
    fn sinh_cosh(self) -> (Self, Self);
    /// tanh x
    fn tanh(self) -> Self;
    /// xᶜ for a real exponent.
    fn powf(self, c: f64) -> Self;
    /// Whether every function gives the same of both.
    fn is_same(self, other: Self) -> bool;
    /// Whether one of them is zero.
    fn any_zero(self) -> bool;
    /// Whether all are positive.
    fn all_positive(self) -> bool;
    /// Whether all are between −1 and 1.
    fn all_inside_unit(self) -> bool;
    /// The smaller of both.
    fn lesser(a: Self, b: Self) -> Self;
    /// Whether a pivot of a positive definite matrix has kept a safe share of its diagonal element.
    fn is_positive_share(pivot: Self, diagonal: Self) -> bool;
    /// Whether none of the parts of a row's compliance that vary is nearly all of it.
    fn is_spread(constant: &[Self], varying: &[Self]) -> bool;
    /// Whether a pivot is not small beside what it was before, nor beside the elements below.
    fn is_safe_pivot(pivot: Self, before: Self, below: &[Self]) -> bool;
}

/// An irrational step: the fractions of its multiples lie apart, however many there are.
pub(crate) const GOLDEN: f64 = 0.618_033_988_749_895;

/// A part between 0.5 and 1.5 for each index by an irrational step: no two of them are in a simple ratio.
pub(crate) fn uneven(index: usize, step: f64) -> f64 {
    0.5 + (index as f64 * step).fract()
}

/// What rounding leaves: a share that is meant for double precision, in units of the last place of `T`.
#[inline(always)]
pub(crate) fn rounding<T: Scalar>(of_double: f64) -> f64 {
    of_double * (epsilon::<T>() / f64::EPSILON)
}

/// What a number has beside its value.
pub(crate) fn derivatives<T: Scalar>(x: T) -> T {
    if T::DERIVATIVES == 0 {
        return T::zero();
    }
    x - T::from_f64(x.value())
}

/// The argument of an asin or acos. Rounding may leave the cosine of an angle that is zero beyond ±1, where there is no angle.
#[inline(always)]
pub(crate) fn within_one<T: Scalar>(x: T) -> T {
    let value = x.value();
    if value.abs() > 1.0 && value.abs() <= 1.0 + BEYOND * epsilon::<T>() {
        T::from_f64(value.signum())
    } else {
        x
    }
}

/// The distance from 1 to the next number of a type.
#[inline(always)]
pub(crate) fn epsilon<T: Scalar>() -> f64 {
    let double = T::from_f64(1.0 + f64::EPSILON).value() > 1.0;
    if double {
        f64::EPSILON
    } else {
        f64::from(f32::EPSILON)
    }
}

/// A pivot of M below this share of its diagonal element has lost 10 of 16 digits: M is not safely positive definite. What
/// earlier pivots have lost is missing from this one too: together they must not lose more.
#[inline(always)]
pub(crate) fn positive_definite<T: Scalar>() -> f64 {
    524_288.0 * epsilon::<T>()
}

/// So many times the compliance of all others is more than a row can have beside them: half of the digits.
pub(crate) const LIGHT: f64 = 1e7;

/// Whether no single part of the compliance of a row, Σ aₖ²/mₖ, is nearly all of it, of those whose inertia mₖ varies.
///
/// Where one is, its inertia is next to none: what elimination has rounded of the forces is divided by it. A single part is the whole
/// of a row that knows no other coordinate.
#[inline(always)]
pub(crate) fn is_spread(
    constant: impl Iterator<Item = f64>,
    varying: impl Iterator<Item = f64>,
) -> bool {
    let (mut largest, mut others) = (0.0, constant.sum::<f64>());
    for part in varying {
        let lesser = if part > largest { largest } else { part };
        largest = if part > largest { part } else { largest };
        others += lesser;
    }
    !(others > 0.0 && largest > LIGHT * others)
}

/// Factors of an elimination without exchange of rows up to the inverse of this lose two digits.
const SMALLEST: f64 = 0.01;
/// A pivot that has lost this share to the rows before may be that of a row that follows from them.
const DEPENDENT: f64 = 1e-6;

impl<T: Scalar> Number for T {
    #[inline(always)]
    fn of(x: f64) -> Self {
        T::from_f64(x)
    }
    #[inline(always)]
    fn mul_add(self, y: Self, z: Self) -> Self {
        Scalar::mul_add(self, y, z)
    }
    #[inline(always)]
    fn fused(self, y: Self, z: Self) -> Self {
        Scalar::fused(self, y, z)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Scalar::sqrt(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        Scalar::exp(self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        Scalar::ln(self)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        Scalar::sin_cos(self)
    }
    #[inline(always)]
    fn tan(self) -> Self {
        Scalar::tan(self)
    }
    #[inline(always)]
    fn asin(self) -> Self {
        Scalar::asin(self)
    }
    #[inline(always)]
    fn acos(self) -> Self {
        Scalar::acos(self)
    }
    #[inline(always)]
    fn atan(self) -> Self {
        Scalar::atan(self)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        Scalar::atan2(self, x)
    }
    #[inline(always)]
    fn sinh_cosh(self) -> (Self, Self) {
        Scalar::sinh_cosh(self)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        Scalar::tanh(self)
    }
    #[inline(always)]
    fn powf(self, c: f64) -> Self {
        Scalar::powf(self, c)
    }
    #[inline(always)]
    fn is_same(self, other: Self) -> bool {
        // Zeros of both signs are equal, and so are derivatives that are.
        let bits = |x: T| x.value().to_bits();
        T::DERIVATIVES == 0 && self == other && bits(self) == bits(other)
    }
    #[inline(always)]
    fn any_zero(self) -> bool {
        self.value() == 0.0
    }
    #[inline(always)]
    fn all_positive(self) -> bool {
        self.value() > 0.0
    }
    #[inline(always)]
    fn all_inside_unit(self) -> bool {
        self.value().abs() < 1.0
    }
    #[inline(always)]
    fn lesser(a: Self, b: Self) -> Self {
        if b.value() < a.value() { b } else { a }
    }
    #[inline(always)]
    fn is_positive_share(pivot: Self, diagonal: Self) -> bool {
        let (pivot, diagonal) = (pivot.value(), diagonal.value());
        pivot > positive_definite::<T>() * diagonal && diagonal > 0.0
    }
    #[inline(always)]
    fn is_spread(constant: &[Self], varying: &[Self]) -> bool {
        let number = |part: &Self| part.value();
        is_spread(constant.iter().map(number), varying.iter().map(number))
    }
    #[inline(always)]
    fn is_safe_pivot(pivot: Self, before: Self, below: &[Self]) -> bool {
        let size = pivot.value().abs();
        let below = below.iter().fold(0.0, |largest: f64, x| {
            let x = x.value().abs();
            if x > largest { x } else { largest }
        });
        size > DEPENDENT * before.value().abs() && size >= SMALLEST * below && size > 0.0
    }
}

/// The same for every motion.
macro_rules! each {
    ($($name:ident $(, $argument:ident)*;)*) => {$(
        #[inline(always)]
        fn $name(self $(, $argument: Self)*) -> Self {
            each_lane!(lane => Scalar::$name(self.0[lane] $(, $argument.0[lane])*))
        }
    )*};
}

/// The same for functions that give two numbers.
macro_rules! pair {
    ($x:ident, $name:ident) => {{
        let [mut first, mut second] = [$x; 2];
        let mut lane = 0;
        while lane < L {
            (first.0[lane], second.0[lane]) = Scalar::$name($x.0[lane]);
            lane += 1;
        }
        (first, second)
    }};
}

impl<T: Scalar, const L: usize> Number for Pack<T, L> {
    #[inline(always)]
    fn of(x: f64) -> Self {
        Pack([T::from_f64(x); L])
    }
    each! {
        mul_add, y, z;
        fused, y, z;
        sqrt;
        exp;
        ln;
        tan;
        asin;
        acos;
        atan;
        atan2, x;
        tanh;
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        pair!(self, sin_cos)
    }
    #[inline(always)]
    fn sinh_cosh(self) -> (Self, Self) {
        pair!(self, sinh_cosh)
    }
    #[inline(always)]
    fn powf(self, c: f64) -> Self {
        each_lane!(lane => Scalar::powf(self.0[lane], c))
    }
    #[inline(always)]
    fn is_same(self, other: Self) -> bool {
        (0..L).all(|lane| self.0[lane].is_same(other.0[lane]))
    }
    #[inline(always)]
    fn any_zero(self) -> bool {
        self.0.into_iter().any(Number::any_zero)
    }
    #[inline(always)]
    fn all_positive(self) -> bool {
        self.0.into_iter().all(Number::all_positive)
    }
    #[inline(always)]
    fn all_inside_unit(self) -> bool {
        self.0.into_iter().all(Number::all_inside_unit)
    }
    #[inline(always)]
    fn lesser(a: Self, b: Self) -> Self {
        each_lane!(lane => T::lesser(a.0[lane], b.0[lane]))
    }
    #[inline(always)]
    fn is_positive_share(pivot: Self, diagonal: Self) -> bool {
        (0..L).all(|lane| T::is_positive_share(pivot.0[lane], diagonal.0[lane]))
    }
    #[inline(always)]
    fn is_spread(constant: &[Self], varying: &[Self]) -> bool {
        (0..L).all(|lane| {
            let number = |part: &Self| part.0[lane].value();
            is_spread(constant.iter().map(number), varying.iter().map(number))
        })
    }
    #[inline(always)]
    fn is_safe_pivot(pivot: Self, before: Self, below: &[Self]) -> bool {
        (0..L).all(|lane| {
            below
                .iter()
                .all(|x| T::is_safe_pivot(pivot.0[lane], before.0[lane], &[x.0[lane]]))
                && T::is_safe_pivot(pivot.0[lane], before.0[lane], &[])
        })
    }
}
