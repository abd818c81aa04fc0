//! Dual numbers of dual numbers.

use super::*;

#[test]
fn dual_numbers_nest() {
    // f = x³ y: f_xy = 3 x²
    type Inner = Dual<f64, 1>;
    let x = Dual::<Inner, 1>::variable(Dual::constant(0.7), 0);
    let y = Dual::<Inner, 1>::constant(Dual::variable(2.0, 0));
    let f = Scalar::powf(x, 3.0) * y;
    assert!((f.derivative[0].derivative[0] - 3.0 * 0.49).abs() < 1e-14);
}
