//! The plane pendulum, swinging or going round (Jacobi 1829; Whittaker 1937, section 44).

use super::double_double::DoubleDouble;
use super::elliptic::{amplitude, first_kind, quarter_period};
use core::f64::consts::{FRAC_PI_2, PI};
use lagrange_core::prelude::State;
use lagrange_program::closed_form::ClosedForm;

/// The state at `until` (x and y, upward) of a mass on a rod that starts from `start` at time 0; none if it would come
/// to rest upside down, or so nearly that no digits are left.
///
/// With θ from the bottom, ω₀ = √(g/l) and k the ratio of energy to that of the top:
///
/// ```text
/// k < 1:  sin(θ/2) = k sin φ,  θ̇ = 2 ω₀ k cos φ,  φ = am(ω₀ t + u₀ | k²)
/// k > 1:  θ/2 = φ,  θ̇ = ±2 ω₀ k dn,  φ = am(±k ω₀ t + u₀ | 1/k²)
/// ```
pub(crate) fn swing(
    length: f64,
    gravity: f64,
    start: &State<f64>,
    until: f64,
) -> Option<ClosedForm> {
    let ([x, y], [u, v]) = (start.q[..].try_into().ok()?, start.v[..].try_into().ok()?);
    let of = DoubleDouble::from;
    let twice = of(2.0);
    let rate = (of(gravity) / of(length)).sqrt();
    let kinetic = (of(u) * of(u) + of(v) * of(v)) / twice;
    let m = (kinetic + of(gravity) * (of(y) + of(length))) / (twice * of(gravity) * of(length));
    if !(length > 0.0 && gravity > 0.0 && (m.value() - 1.0).abs() > 1e-6 && until.is_finite()) {
        return None;
    }
    let half = f64::atan2(x, -y) / 2.0;
    let turning = (u * -y + v * x) / (length * length);
    let slow = rate.value();
    let k = m.value().max(0.0).sqrt();

    let (sin, cos, turning) = if k < 1.0 {
        let complement = of(1.0) - m;
        let period = quarter_period(complement) * of(4.0);
        let phase = half.sin().atan2(turning / (2.0 * slow));
        let from = argument(phase, complement.value(), period.value() / 4.0);
        let phi = amplitude(from + (rate * of(until)).reduced(period).value(), m.value());
        let sin = k * phi.sin();
        (sin, (1.0 - sin * sin).sqrt(), 2.0 * slow * k * phi.cos())
    } else {
        let m = of(1.0) / m;
        let complement = of(1.0) - m;
        let period = quarter_period(complement) * twice;
        let from = argument(half, complement.value(), period.value() / 2.0);
        let along = (rate / m.sqrt() * of(until)).reduced(period).value();
        let phi = amplitude(from + along.copysign(along * turning), m.value());
        let dn = (1.0 - m.value() * phi.sin().powi(2)).sqrt();
        (
            phi.sin(),
            phi.cos(),
            (2.0 * slow * k * dn).copysign(turning),
        )
    };
    let (sine, cosine) = (2.0 * sin * cos, 1.0 - 2.0 * sin * sin);
    Some(ClosedForm {
        by: "Jacobi's elliptic functions",
        events: Vec::new(),
        time: until,
        state: State::new(
            vec![length * sine, -length * cosine],
            vec![length * turning * cosine, length * turning * sine],
        ),
        // A start is on its circle to rounding only, which changes the period: in proportion to time.
        rounding: 1e-15 + 0.5 * f64::EPSILON * slow * until,
    })
}

/// F(φ | m) for −π ≤ φ ≤ π.
fn argument(phi: f64, complement: f64, quarter: f64) -> f64 {
    let inside = if phi.abs() > FRAC_PI_2 {
        phi - PI.copysign(phi)
    } else {
        phi
    };
    let whole = if phi.abs() > FRAC_PI_2 {
        (2.0 * quarter).copysign(phi)
    } else {
        0.0
    };
    whole + first_kind(inside.sin(), inside.cos(), complement)
}

#[cfg(test)]
mod tests {
    use super::swing;
    use lagrange_core::prelude::State;

    fn state(q: [f64; 2], v: [f64; 2]) -> State<f64> {
        State::new(q.to_vec(), v.to_vec())
    }

    #[test]
    fn known_instants_of_known_motions() {
        // From the level, at rest, the period is 4 K(1/2) √(l/g).
        let (l, g) = (2.0, 9.81);
        let period = 4.0 * 1.854_074_677_301_371_9 * f64::sqrt(l / g);
        let at = |t: f64| swing(l, g, &state([l, 0.0], [0.0, 0.0]), t).expect("it swings");
        for (t, q) in [
            (0.0, [l, 0.0]),
            (0.25 * period, [0.0, -l]),
            (0.5 * period, [-l, 0.0]),
            (7.75 * period, [0.0, -l]),
        ] {
            let found = at(t).state.q;
            assert!((found[0] - q[0]).abs() < 1e-13 && (found[1] - q[1]).abs() < 1e-13);
        }
    }

    #[test]
    fn every_motion_starts_where_it_starts_and_can_be_continued() {
        for start in [
            state([0.0, -1.0], [7.0, 0.0]),
            state([0.0, -1.0], [-7.0, 0.0]),
            state([0.0, -1.0], [3.0, 0.0]),
            state([-0.6, -0.8], [-1.6, 1.2]),
            state([0.6, 0.8], [-0.8, 0.6]),
            state([-0.6, 0.8], [0.8, 0.6]),
        ] {
            let at = |from: &State<f64>, t| swing(1.0, 9.81, from, t).expect("a motion").state;
            let same = |a: &State<f64>, b: &State<f64>| {
                let (a, b) = (a.q.iter().chain(&a.v), b.q.iter().chain(&b.v));
                a.zip(b).all(|(a, b)| (a - b).abs() < 2e-14)
            };
            assert!(same(&at(&start, 0.0), &start), "{start:?}");
            let (once, twice) = (at(&start, 1.7), at(&at(&start, 1.0), 0.7));
            assert!(same(&once, &twice), "{start:?}: {once:?}, {twice:?}");
        }
    }
}
