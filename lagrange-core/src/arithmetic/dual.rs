//! Dual numbers x + Σ xᵢ εᵢ with εᵢ εⱼ = 0: a value and its derivatives in N directions.
//!
//! They are [`Scalar`]s over any scalar, so they nest (second derivatives) and sit under series (sensitivities of
//! Taylor coefficients). Reference: Griewank & Walther 2008, Evaluating Derivatives, section 3.1.

use super::Scalar;
use core::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};
use num_traits::{Num, One, Zero};

/// A value and its derivatives in `N` directions.
///
/// A scene with parameters of this type runs as with `f64`, and everything that its trajectory holds has derivatives: states,
/// forces, impulses and the instants of events, through switches and impacts.
///
/// At an event, and at a stop that ends the run, a derivative is that of the state at an instant which itself moves; elsewhere
/// it is that at a fixed time ([`Sampler::at`](crate::trajectory::Sampler::at)). Where several guards fall at once by symmetry, it is that of the first of them. Left out are how
/// a slip in space turns at its very beginning, and a restitution that was lowered.
///
/// ```
/// use lagrange_core::arithmetic::Dual;
/// use lagrange_core::prelude::*;
///
/// #[derive(Lagrangian, Clone, Debug)]
/// #[lagrange(
///     coordinates(y),
///     kinetic = der(y)^2 / 2,
///     potential = gravity * y,
///     contact(floor: y >= 0, restitution = bounce),
///     start(drop: y = height),
/// )]
/// struct Ball<T = f64> {
///     gravity: T,
///     bounce: T,
///     height: T,
/// }
///
/// let ball: Ball<Dual<f64, 2>> = Ball {
///     gravity: Dual::constant(9.81),
///     bounce: Dual::variable(0.8, 0),
///     height: Dual::variable(1.0, 1),
/// };
/// let start = ball.at(<Ball>::DROP);
/// let trajectory = Simulation::new(&ball).run(start, 0.0..1.5).expect("runs");
/// // The second impact: t = √(2h/g) (1 + 2e).
/// let time = trajectory.events()[1].time;
/// let fall = (2.0 / 9.81_f64).sqrt();
/// assert!((time.value - 2.6 * fall).abs() < 1e-9);
/// assert!((time.derivative[0] - 2.0 * fall).abs() < 1e-9);
/// assert!((time.derivative[1] - 1.3 * fall).abs() < 1e-9);
/// ```
///
/// Steps are chosen for values only; derivatives are about as exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T, const N: usize> {
    /// The number itself.
    pub value: T,
    /// Its derivative in each direction.
    pub derivative: [T; N],
}

impl<T: Scalar, const N: usize> Dual<T, N> {
    /// A number that depends on no direction.
    #[inline(always)]
    pub fn constant(value: T) -> Self {
        Self {
            value,
            derivative: [T::zero(); N],
        }
    }

    /// The independent variable of direction `index`.
    ///
    /// # Panics
    /// If there is no such direction: they are counted from 0 and less than `N`.
    #[inline(always)]
    #[track_caller]
    pub fn variable(value: T, index: usize) -> Self {
        assert!(
            index < N,
            "there is no direction {index} among {N}, counted from 0"
        );
        Self {
            value,
            derivative: core::array::from_fn(|i| if i == index { T::one() } else { T::zero() }),
        }
    }

    /// f(x), given its value and f′(x).
    #[inline(always)]
    fn chain(self, value: T, slope: T) -> Self {
        Self {
            value,
            derivative: self.derivative.map(|d| slope * d),
        }
    }

    /// The same where f′ may be infinite: a direction that does not move x does not move f(x) either.
    #[inline(always)]
    fn chain_singular(self, value: T, slope: T) -> Self {
        Self {
            value,
            derivative: self
                .derivative
                .map(|d| if d.is_zero() { d } else { slope * d }),
        }
    }

    /// Combines the directions of two numbers.
    #[inline(always)]
    fn zip(self, other: Self, value: T, f: impl Fn(T, T) -> T) -> Self {
        Self {
            value,
            derivative: core::array::from_fn(|i| f(self.derivative[i], other.derivative[i])),
        }
    }
}

impl<T: Scalar, const N: usize> Default for Dual<T, N> {
    #[inline(always)]
    fn default() -> Self {
        Self::constant(T::zero())
    }
}

impl<T: Scalar, const N: usize> Add for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, y: Self) -> Self {
        self.zip(y, self.value + y.value, |dx, dy| dx + dy)
    }
}

impl<T: Scalar, const N: usize> Sub for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, y: Self) -> Self {
        self.zip(y, self.value - y.value, |dx, dy| dx - dy)
    }
}

// Product and quotient rule: sums in a product are meant.
#[allow(clippy::suspicious_arithmetic_impl)]
impl<T: Scalar, const N: usize> Mul for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, y: Self) -> Self {
        self.zip(y, self.value * y.value, |dx, dy| {
            dx * y.value + self.value * dy
        })
    }
}

// Product and quotient rule: sums in a product are meant.
#[allow(clippy::suspicious_arithmetic_impl)]
impl<T: Scalar, const N: usize> Div for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn div(self, y: Self) -> Self {
        let quotient = self.value / y.value;
        self.zip(y, quotient, |dx, dy| (dx - quotient * dy) / y.value)
    }
}

impl<T: Scalar, const N: usize> Rem for Dual<T, N> {
    type Output = Self;
    fn rem(self, y: Self) -> Self {
        let rest = self.value % y.value;
        let whole = (self.value - rest) / y.value;
        self.zip(y, rest, |dx, dy| dx - whole * dy)
    }
}

impl<T: Scalar, const N: usize> Neg for Dual<T, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            derivative: self.derivative.map(|d| -d),
        }
    }
}

macro_rules! assign {
    ($($trait:ident :: $method:ident by $operator:tt),*) => {$(
        impl<T: Scalar, const N: usize> $trait for Dual<T, N> {
            #[inline(always)]
            fn $method(&mut self, y: Self) {
                *self = *self $operator y;
            }
        }
    )*};
}

assign!(
    AddAssign::add_assign by +,
    SubAssign::sub_assign by -,
    MulAssign::mul_assign by *,
    DivAssign::div_assign by /,
    RemAssign::rem_assign by %
);

impl<T: Scalar, const N: usize> Zero for Dual<T, N> {
    #[inline(always)]
    fn zero() -> Self {
        Self::constant(T::zero())
    }
    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.derivative.iter().all(T::is_zero)
    }
}

impl<T: Scalar, const N: usize> One for Dual<T, N> {
    #[inline(always)]
    fn one() -> Self {
        Self::constant(T::one())
    }
}

impl<T: Scalar, const N: usize> Num for Dual<T, N> {
    type FromStrRadixErr = T::FromStrRadixErr;
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        T::from_str_radix(text, radix).map(Self::constant)
    }
}

impl<T: Scalar, const N: usize> Scalar for Dual<T, N> {
    const DERIVATIVES: usize = T::DERIVATIVES + 1;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::constant(T::from_f64(x))
    }
    #[inline(always)]
    fn value(self) -> f64 {
        self.value.value()
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain_singular(root, T::one() / (root + root))
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let e = self.value.exp();
        self.chain(e, e)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.chain_singular(self.value.ln(), T::one() / self.value)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
    #[inline(always)]
    fn tan(self) -> Self {
        let t = self.value.tan();
        self.chain(t, T::one() + t * t)
    }
    #[inline(always)]
    fn asin(self) -> Self {
        let x = self.value;
        self.chain_singular(
            x.asin(),
            T::one() / ((T::one() - x) * (T::one() + x)).sqrt(),
        )
    }
    #[inline(always)]
    fn acos(self) -> Self {
        let x = self.value;
        self.chain_singular(
            x.acos(),
            -T::one() / ((T::one() - x) * (T::one() + x)).sqrt(),
        )
    }
    #[inline(always)]
    fn atan(self) -> Self {
        let x = self.value;
        self.chain(x.atan(), T::one() / (T::one() + x * x))
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let (y, x) = (self, x);
        let square = x.value * x.value + y.value * y.value;
        let (along_y, along_x) = (x.value / square, y.value / square);
        y.zip(x, y.value.atan2(x.value), |dy, dx| {
            if dx.is_zero() && dy.is_zero() {
                dx
            } else {
                along_y * dy - along_x * dx
            }
        })
    }
    #[inline(always)]
    fn sinh_cosh(self) -> (Self, Self) {
        let (s, c) = self.value.sinh_cosh();
        (self.chain(s, c), self.chain(c, s))
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        let t = self.value.tanh();
        self.chain(t, T::one() - t * t)
    }
    #[inline(always)]
    fn powf(self, c: f64) -> Self {
        self.chain_singular(
            self.value.powf(c),
            T::from_f64(c) * self.value.powf(c - 1.0),
        )
    }
}
