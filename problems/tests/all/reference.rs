//! What results are compared with is itself compared with tables and closed forms.

use lagrange_problems::reference::{agm, extrapolate, integral, jacobi, over_a_turn};

#[test]
fn values_of_abramowitz_and_stegun() {
    // 16.5: at K/2, sn = 1/√(1 + k′); K from table 17.1, m = 0.5.
    let complement = 0.5_f64.sqrt();
    let quarter = core::f64::consts::FRAC_PI_2 / agm(1.0, complement);
    assert!((quarter - 1.854_074_677_301_371_9).abs() < 1e-15);
    let (sn, cn, dn) = jacobi(0.5 * quarter, complement);
    assert!((sn - 1.0 / (1.0 + complement).sqrt()).abs() < 1e-15);
    assert!((cn - (complement / (1.0 + complement)).sqrt()).abs() < 1e-15);
    assert!((dn - complement.sqrt()).abs() < 1e-15);
    for u in [0.1, 0.7, 1.3, 2.9, 5.0] {
        let (sn, cn, dn) = jacobi(u, 0.1);
        assert!((sn * sn + cn * cn - 1.0).abs() < 1e-14);
        assert!((dn * dn + 0.99 * sn * sn - 1.0).abs() < 1e-13, "{u}");
    }
}

#[test]
fn known_integrals() {
    let inverse_root = integral(|x| 1.0 / x.sqrt(), 0.0, 4.0);
    assert!((inverse_root - 4.0).abs() < 1e-12);
    // Bessel's I₀(1).
    let mean = over_a_turn(|x| x.cos().exp()) / core::f64::consts::TAU;
    assert!((mean - 1.266_065_877_752_008_3).abs() < 1e-15);
}

#[test]
fn harmonic_motion() {
    let y = extrapolate(|_, y: &[f64; 2]| [y[1], -y[0]], 0.0, 10.0, [1.0, 0.0], 40);
    assert!((y[0] - 10.0_f64.cos()).abs() < 1e-13);
    assert!((y[1] + 10.0_f64.sin()).abs() < 1e-13);
}
