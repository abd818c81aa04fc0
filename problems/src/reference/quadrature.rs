//! Integrals of smooth functions.

/// ∫ f over [a, b] by the tanh–sinh rule (Takahasi & Mori 1974), which bears integrable singularities at both ends; `f` is
/// given the distance from `a`.
pub fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let (half, step) = (0.5 * (b - a), 1.0 / 64.0);
    let mut sum = 0.0;
    for k in -260..=260 {
        let u = f64::from(k) * step;
        let w = core::f64::consts::FRAC_PI_2 * u.sinh();
        // 1 + tanh w without cancellation.
        let from_a = half * 2.0 / (1.0 + (-2.0 * w).exp());
        let weight = core::f64::consts::FRAC_PI_2 * u.cosh() / w.cosh().powi(2);
        let value = f(from_a);
        if value.is_finite() && weight > 0.0 {
            sum += weight * value;
        }
    }
    sum * step * half
}

/// ∫ f over [0, 2π] for a smooth f of that period, by the trapezoidal rule with 4096 points, which converges
/// geometrically (Trefethen & Weideman 2014).
pub fn over_a_turn(f: impl Fn(f64) -> f64) -> f64 {
    const SIDE: u32 = 64;
    let step = core::f64::consts::TAU / f64::from(SIDE * SIDE);
    // Sums of sums: rounding grows with their length.
    let part = |i: u32| {
        (0..SIDE)
            .map(|k| f(step * f64::from(SIDE * i + k)))
            .sum::<f64>()
    };
    (0..SIDE).map(part).sum::<f64>() * step
}
