//! Numbers of a page with the digits that a curve shows.

use crate::number::significant;
use crate::report::plot::CONSTANT;

/// Values with the digits that a curve shows; what is no finite number is none.
pub(super) fn told(values: &[Option<f64>]) -> Vec<Option<f64>> {
    let finite = || values.iter().map(|value| value.filter(|x| x.is_finite()));
    let mut told = short(finite().flatten().collect()).into_iter();
    finite()
        .map(|value| value.and_then(|_| told.next()))
        .collect()
}

/// Numbers with the digits that a curve shows: six, or so many that a hundred-thousandth of what they span is left of what is
/// almost constant, unless only rounding changes it.
pub(super) fn short(values: Vec<f64>) -> Vec<f64> {
    let finite = || values.iter().copied().filter(|x| x.is_finite());
    let span = finite().fold(f64::MIN, f64::max) - finite().fold(f64::MAX, f64::min);
    let size = finite().fold(0.0, |size: f64, x| size.max(x.abs()));
    let unit = 10_f64.powf(5.0 - span.log10().floor());
    let short = |x: f64| {
        let six = significant(x);
        let fine = (x * unit).round() / unit;
        let coarse = span > CONSTANT * size && (six - x).abs() > 1e-5 * span;
        if coarse && fine.is_finite() {
            fine
        } else {
            six
        }
    };
    values.iter().map(|&x| short(x)).collect()
}

#[cfg(test)]
mod tests {
    use super::short;

    /// A length that changes by a hundred-thousandth is a curve, not three steps.
    #[test]
    fn what_is_almost_constant_keeps_its_changes() {
        let length = |k: usize| 1.0 + 1e-5 * (k as f64 * 0.1).sin();
        let exact: Vec<f64> = (0..60).map(length).collect();
        let told = short(exact.clone());
        for (a, b) in told.iter().zip(&exact) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
            assert!(a.to_string().len() <= 12, "{a}");
        }
        assert_eq!(short(vec![1234567.0, 0.0, f64::NAN]), [1234570.0, 0.0, 0.0]);
        assert_eq!(short(vec![0.1 + 0.2; 3]), [0.3; 3]);
        let noise = [1.23456789, 1.23456789 + 1e-15];
        assert_eq!(short(noise.to_vec()), [1.23457; 2]);
        assert_eq!(short(Vec::new()), Vec::<f64>::new());
    }
}
