//! Elliptic functions by the arithmetic-geometric mean (Gauss 1799; Abramowitz & Stegun, 16.4 and 17.6).

/// Arithmetic-geometric mean: the complete elliptic integral K(k) is π / (2 agm(1, √(1 − k²))).
pub fn agm(mut a: f64, mut b: f64) -> f64 {
    for _ in 0..40 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// Jacobi's (sn, cn, dn) of u for the complementary modulus k′ = √(1 − k²), which is given because k may be near 1.
pub fn jacobi(u: f64, complement: f64) -> (f64, f64, f64) {
    let modulus = ((1.0 - complement) * (1.0 + complement)).sqrt();
    let (mut a, mut b, mut c) = (1.0, complement, modulus);
    let mut ratios = Vec::new();
    while c > f64::EPSILON * a && ratios.len() < 30 {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        ratios.push(c / a);
    }
    let mut angle = f64::from(1_u32 << ratios.len()) * a * u;
    let mut after = angle;
    for ratio in ratios.iter().rev() {
        after = angle;
        angle = 0.5 * (angle + (ratio * angle.sin()).asin());
    }
    let (sn, cn) = angle.sin_cos();
    // cos φ₀ / cos (φ₁ − φ₀), which does not cancel; where it does not exist dn is k′.
    let below = (after - angle).cos();
    let dn = if cn.abs() > 0.1 {
        cn / below
    } else {
        (1.0 - (modulus * sn).powi(2)).sqrt()
    };
    (sn, cn, dn)
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
