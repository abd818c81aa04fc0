//! An oscillator with a damper so strong that its two rates of decay are far apart.

use lagrange_macros::Lagrangian;

/// A mass on a spring, in a damper that lets it creep.
///
/// Its displacement is a sum of two decays, exp(−slow t) and exp(−fast t). The fast one is over at once, but it keeps explicit steps short
/// for ever: they are bounded by stability and no longer by accuracy.
///
/// What to expect: x = x₀ (fast exp(−slow t) − slow exp(−fast t))/(fast − slow), and, also with `fast` = 10⁶/s, a run of
/// some hundred or thousand steps instead of millions.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m"),
    kinetic   = mass/2 * der(x)^2,
    potential = mass/2 * slow * fast * x^2,
    dissipation(damper: mass/2 * (slow + fast) * der(x)^2),
    start(drawn: x = displacement),
    draw(floor: 0),
    draw(spring: (-2*displacement, displacement/10) to (x - displacement/10, displacement/10)),
    draw(box: (x, displacement/10), size = (displacement/5, displacement/5)),
)]
pub struct OverdampedOscillator<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// The slow rate of decay, 1/s.
    #[lagrange(unit = "1/s")]
    pub slow: T,
    /// The fast rate of decay, 1/s.
    #[lagrange(unit = "1/s")]
    pub fast: T,
    /// Displacement x₀ at the start, m.
    #[lagrange(unit = "m")]
    pub displacement: T,
}

impl Default for OverdampedOscillator {
    fn default() -> Self {
        Self {
            mass: 1.0,
            slow: 1.0,
            fast: 1e4,
            displacement: 1.0,
        }
    }
}
