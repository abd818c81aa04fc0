//! Motion around a centre that attracts with μ/r² (Kepler 1609; Danby 1988, chapter 6).

use super::double_double::DoubleDouble;
use core::f64::consts::{PI, TAU};
use lagrange_core::prelude::State;
use lagrange_program::closed_form::ClosedForm;

/// The state at `until` of a body that starts from `start` (x and y) at time 0; none if the orbit does not close.
///
/// With the eccentric anomaly E, E − e sin E = M = M₀ + √(μ/a³) t, and the axes P (to the pericentre) and Q across:
///
/// ```text
/// q = a (cos E − e) P + a sin E Q′        v = √(μ a)/r · (−sin E P + cos E Q′)        Q′ = √(1 − e²) Q
/// ```
pub(crate) fn elliptic(mu: f64, start: &State<f64>, until: f64) -> Option<ClosedForm> {
    let ([x, y], [u, v]) = (start.q[..].try_into().ok()?, start.v[..].try_into().ok()?);
    let of = DoubleDouble::from;
    let square = |a: f64, b: f64| of(a) * of(a) + of(b) * of(b);
    let r = square(x, y).sqrt();
    // 1/a: a difference of large numbers on eccentric orbits, and t multiplies its error.
    let inverse = of(2.0) / r - square(u, v) / of(mu);
    if !(r.value() > 0.0 && mu > 0.0 && inverse.value() > 0.0 && until.is_finite()) {
        return None;
    }
    let motion = (of(mu) * inverse).sqrt() * inverse;
    let along = (motion * of(until)).reduced(DoubleDouble::TURN).value();

    let a = 1.0 / inverse.value();
    let speed = (mu / a).sqrt();
    let cos = (of(1.0) - r * inverse).value();
    let sin = (of(x) * of(u) + of(y) * of(v)).value() / (speed * a);
    let (e, e0) = (cos.hypot(sin), sin.atan2(cos));
    let r = r.value();
    let p = |q: f64, v: f64| q * e0.cos() / r - v * e0.sin() / speed;
    let q = |q: f64, v: f64| q * e0.sin() / r + v * (e0.cos() - e) / speed;
    let ([px, py], [qx, qy]) = ([p(x, u), p(y, v)], [q(x, u), q(y, v)]);

    let now = eccentric_anomaly(e, e0 - sin + along);
    let distance = 1.0 - e * now.cos();
    let place = |p: f64, q: f64| a * ((now.cos() - e) * p + now.sin() * q);
    let rate = |p: f64, q: f64| speed / distance * (now.cos() * q - now.sin() * p);
    Some(ClosedForm {
        by: "Kepler's equation",
        events: Vec::new(),
        time: until,
        state: State::new(
            vec![place(px, qx), place(py, qy)],
            vec![rate(px, qx), rate(py, qy)],
        ),
        rounding: 1e-15 / (1.0 - e),
    })
}

/// E between −π and π of which E − e sin E = M but for whole turns, for 0 ≤ e < 1.
fn eccentric_anomaly(e: f64, mean: f64) -> f64 {
    let mean = mean - TAU * (mean / TAU).round();
    // From above the root of M > 0 Newton's method falls monotonically, as E − e sin E is convex up to π.
    let above = (mean.abs() + e).min(mean.abs() / (1.0 - e)).min(PI);
    let mut anomaly = above;
    for _ in 0..100 {
        let excess = anomaly - e * anomaly.sin() - mean.abs();
        let next = anomaly - excess / (1.0 - e * anomaly.cos());
        if !(next < anomaly) {
            break;
        }
        anomaly = next;
    }
    anomaly.copysign(mean)
}

#[cfg(test)]
mod tests {
    use super::{TAU, eccentric_anomaly, elliptic};
    use lagrange_core::prelude::State;

    #[test]
    fn keplers_equation_is_solved_everywhere() {
        for e in [0.0, 0.3, 0.9, 0.999] {
            for mean in [-3.0, -1e-9, 0.0, 1e-14, 0.01, 0.5, 2.0, 3.1, 4.0, 6.2, 9.0] {
                let anomaly = eccentric_anomaly(e, mean);
                let residual = (anomaly - e * f64::sin(anomaly) - mean) / TAU;
                let residual = residual - residual.round();
                assert!(residual.abs() < 1e-15, "e = {e}, M = {mean}: {residual:e}");
            }
        }
    }

    #[test]
    fn turned_orbits_keep_energy_momentum_and_their_axis() {
        let (mu, start) = (2.0, State::new(vec![0.3, -0.4], vec![1.1, 1.7]));
        let conserved = |s: &State<f64>| {
            let (r, v) = (s.q[0].hypot(s.q[1]), s.v[0].hypot(s.v[1]));
            let momentum = s.q[0] * s.v[1] - s.q[1] * s.v[0];
            let axis = [
                s.v[1] * momentum - mu * s.q[0] / r,
                -s.v[0] * momentum - mu * s.q[1] / r,
            ];
            [v * v / 2.0 - mu / r, momentum, axis[0], axis[1]]
        };
        for t in [0.0, 0.1, 1.0, 7.0, 100.0] {
            let end = elliptic(mu, &start, t).expect("the orbit closes").state;
            for (now, then) in conserved(&end).into_iter().zip(conserved(&start)) {
                assert!((now - then).abs() < 1e-14, "t = {t}: {now} is not {then}");
            }
        }
    }
}
