//! Down a round hill from rest, off it, and in a parabola to the ground.

use super::elliptic::first_kind;
use lagrange_core::prelude::State;
use lagrange_program::closed_form::ClosedForm;

/// A hill and what moves on it: R θ̈ = g′ sin θ, until N = 0.
pub(crate) struct Hill {
    /// Radius of the path of the centre, m.
    pub radius: f64,
    /// Gravity in flight, m/s².
    pub gravity: f64,
    /// g′/g: 1 for what slides, 5/7 for a solid sphere that rolls.
    pub share: f64,
    /// cos θ of leaving over cos θ₀: 2/3 for what slides, 10/17 for a solid sphere that rolls.
    pub leaving: f64,
    /// Height of the ground, m; the top of the hill is at +`radius`.
    pub ground: f64,
}

/// A moment of the motion of the centre.
pub(crate) struct Moment {
    /// Time, s.
    pub time: f64,
    /// Angle from the top, rad.
    pub theta: f64,
    /// dθ/dt, rad/s.
    pub turning: f64,
    /// Distance from the centre of the hill, m, and its rate.
    pub r: f64,
    /// dr/dt, m/s.
    pub rising: f64,
}

impl Hill {
    /// Leaving, and landing, from rest at θ₀; none if θ₀ is not on the upper half right of the top.
    ///
    /// The time to leave is √(R/g′) F(ψ | cos²(θ₀/2)), with
    /// tan ψ = √(sin²(θ/2) − sin²(θ₀/2)) / (cos(θ/2) sin(θ₀/2)): Whittaker 1937, section 44, upside down.
    pub(crate) fn descent(&self, from: f64) -> Option<[Moment; 2]> {
        if !(from > 0.0 && from < core::f64::consts::FRAC_PI_2 && self.gravity > 0.0) {
            return None;
        }
        let cos = self.leaving * from.cos();
        let theta = cos.acos();
        let fall = from.cos() * (1.0 - self.leaving);
        let turning = (2.0 * self.share * self.gravity / self.radius * fall).sqrt();
        let small = (from / 2.0).sin();
        // sin²(θ/2) − sin²(θ₀/2) = (cos θ₀ − cos θ)/2
        let (opposite, adjacent) = ((fall / 2.0).sqrt(), (theta / 2.0).cos() * small);
        let slant = opposite.hypot(adjacent);
        let slow = (self.radius / (self.share * self.gravity)).sqrt();
        let time = slow * first_kind(opposite / slant, adjacent / slant, small * small);

        let (x, y) = (self.radius * theta.sin(), self.radius * cos);
        let speed = self.radius * turning;
        let (u, v) = (speed * cos, -speed * theta.sin());
        let below = (v * v + 2.0 * self.gravity * (y - self.ground)).sqrt();
        let flight = (v + below) / self.gravity;
        let (x, y, v) = (x + u * flight, self.ground, -below);
        let r = x.hypot(y);
        let leave = Moment {
            time,
            theta,
            turning,
            r: self.radius,
            rising: 0.0,
        };
        let land = Moment {
            time: time + flight,
            theta: x.atan2(y),
            turning: (u * y - v * x) / (r * r),
            r,
            rising: (x * u + y * v) / r,
        };
        Some([leave, land])
    }
}

/// The closed form of a descent that ends on the ground before `until`.
pub(crate) fn landing(
    moments: &[Moment; 2],
    until: f64,
    contact: &'static str,
    state: State<f64>,
) -> Option<ClosedForm> {
    let [leave, land] = moments;
    (land.time < until).then(|| ClosedForm {
        by: "an elliptic integral and a parabola",
        events: vec![(contact, leave.time), ("floor stop", land.time)],
        time: land.time,
        state,
        rounding: 2e-15,
    })
}
