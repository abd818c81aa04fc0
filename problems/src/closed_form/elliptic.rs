//! Elliptic integrals of the first kind and the amplitude, for a parameter m = k² from 0 to below 1.
//!
//! Carlson 1979 (R_F by duplication); Abramowitz & Stegun 16.4 and 17.6 (arithmetic–geometric mean).

use super::double_double::DoubleDouble;

/// R_F(x, y, z) = ½ ∫₀^∞ dt / √((t + x)(t + y)(t + z)), at most one of them 0.
fn carlson(x: f64, y: f64, z: f64) -> f64 {
    let mut v = [x, y, z];
    loop {
        let mean = (v[0] + v[1] + v[2]) / 3.0;
        let [a, b, c] = v.map(|part| 1.0 - part / mean);
        if a.abs().max(b.abs()).max(c.abs()) < 2e-3 {
            let (second, third) = (a * b - c * c, a * b * c);
            // The first neglected term is of order 6 in the deviations.
            let series = 1.0 - second / 10.0 + third / 14.0 + second * second / 24.0
                - 3.0 * second * third / 44.0;
            return series / mean.sqrt();
        }
        let [a, b, c] = v.map(f64::sqrt);
        let lambda = a * (b + c) + b * c;
        v = v.map(|part| (part + lambda) / 4.0);
    }
}

/// F(φ | m), with sin φ and cos φ given and the complement 1 − m, for |φ| ≤ π/2.
pub(super) fn first_kind(sin: f64, cos: f64, complement: f64) -> f64 {
    sin * carlson(cos * cos, cos * cos + complement * sin * sin, 1.0)
}

/// K(m) from the complement 1 − m.
pub(super) fn quarter_period(complement: DoubleDouble) -> DoubleDouble {
    let half = DoubleDouble::from(0.5);
    let (mut a, mut b) = (DoubleDouble::from(1.0), complement.sqrt());
    // The digits double with each mean; complements down to 1e-300 take fewer than twelve.
    for _ in 0..12 {
        (a, b) = ((a + b) * half, (a * b).sqrt());
    }
    DoubleDouble::TURN / (a * 4.0.into())
}

/// am(u | m): the φ of which F(φ | m) = u.
pub(super) fn amplitude(u: f64, m: f64) -> f64 {
    let mut a = 1.0;
    let mut b = (1.0 - m).max(0.0).sqrt();
    let mut ratios = Vec::new();
    let mut scale = 1.0;
    while (a - b).abs() > f64::EPSILON * a && ratios.len() < 12 {
        let c = (a - b) / 2.0;
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
        ratios.push(c / a);
        scale *= 2.0;
    }
    let last = scale * a * u;
    ratios
        .iter()
        .rev()
        .fold(last, |phi, ratio| (phi + (ratio * phi.sin()).asin()) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_tables_and_with_itself() {
        // Abramowitz & Stegun, table 17.1: K(1/2); table 17.5: F(30° | sin² 30°).
        let k = quarter_period(0.5.into()).value();
        assert!((k - 1.854_074_677_301_371_9).abs() < 4e-16, "{k}");
        let sixth = core::f64::consts::FRAC_PI_6;
        let f = first_kind(sixth.sin(), sixth.cos(), 0.75);
        assert!((f - 0.529_428_63).abs() < 1e-8, "{f}");
        for m in [0.0, 0.1, 0.5, 0.99, 0.999_999] {
            for phi in [0.0, 1e-9, 0.3, 1.2, 1.57] {
                let u = first_kind(f64::sin(phi), f64::cos(phi), 1.0 - m);
                let back = amplitude(u, m);
                assert!((back - phi).abs() < 1e-14, "am(F({phi} | {m})) = {back}");
            }
            let k = quarter_period(DoubleDouble::from(1.0) - m.into()).value();
            assert!((first_kind(1.0, 0.0, 1.0 - m) - k).abs() < 1e-15 * k, "{m}");
        }
    }
}
