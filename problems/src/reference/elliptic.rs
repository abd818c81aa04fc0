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
