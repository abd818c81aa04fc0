//! Dual numbers of the crate num-dual, to and from those here (feature `num-dual`).
//!
//! They are no [`Scalar`](super::Scalar)s themselves: two of them are equal where their values are, and a run must tell apart
//! states that differ in derivatives only.

use super::Dual;
use nalgebra::SVector;
use num_dual::{Derivative, Dual64, DualSVec64};

impl From<Dual64> for Dual<f64, 1> {
    fn from(x: Dual64) -> Self {
        Self {
            value: x.re,
            derivative: [x.eps],
        }
    }
}

impl From<Dual<f64, 1>> for Dual64 {
    fn from(x: Dual<f64, 1>) -> Self {
        Self::new(x.value, x.derivative[0])
    }
}

impl<const N: usize> From<DualSVec64<N>> for Dual<f64, N> {
    fn from(x: DualSVec64<N>) -> Self {
        Self {
            value: x.re,
            derivative: x.eps.0.map_or([0.0; N], |eps| eps.data.0[0]),
        }
    }
}

impl<const N: usize> From<Dual<f64, N>> for DualSVec64<N> {
    fn from(x: Dual<f64, N>) -> Self {
        Self::new(x.value, Derivative::some(SVector::from(x.derivative)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let x = Dual64::new(2.0, 3.0);
        let y = Dual64::from(Dual::from(x));
        assert_eq!((x.re, x.eps), (y.re, y.eps));
        let p = Dual::<f64, 2>::variable(0.5, 1);
        assert_eq!(Dual::from(DualSVec64::from(p)), p);
        assert_eq!(
            Dual::from(DualSVec64::from_re(4.0)),
            Dual::<f64, 2>::constant(4.0)
        );
    }
}
