//! Dissipations that give energy wherever one looks: their sign is wrong, as a rule.
//!
//! The power of Q = −∂R/∂v is −v·∂R/∂v. A damper between bodies takes energy always; one to a belt that runs gives some while the belt
//! drags. What gives energy at every state, at parameters that are positive, damps nothing.

use crate::model::Hint;
use crate::model::elaboration::Elaboration;
use crate::symbolic::{ExprId, Symbol};

/// States that are looked at.
const STATES: u32 = 32;

/// Positions and velocities are between a tenth of this and this: a damping that depends on the place may change its sign there.
const REACH: f64 = 10.0;

impl Elaboration<'_> {
    /// Remarks on dissipations that only give energy.
    pub(super) fn feeding(&mut self) {
        let velocities = self.velocities();
        let mut hints = Vec::new();
        for i in 0..self.system.dissipations.len() {
            let rayleigh = self.system.dissipations[i].rayleigh;
            let pool = &mut self.system.pool;
            let terms = super::slopes(pool, rayleigh, &velocities);
            let terms = terms.into_iter().zip(&velocities);
            let terms: Vec<ExprId> = terms
                .map(|(slope, &velocity)| {
                    let velocity = pool.leaf(velocity);
                    pool.mul(slope, velocity)
                })
                .collect();
            let taken = pool.sum(&terms);
            if (0..STATES).all(|state| self.at(taken, state) < 0.0) {
                let name = &self.system.dissipations[i].name;
                let text = format!(
                    "`{}` gives energy at every state, if its parameters are positive: a dissipation that takes energy is positive, as in damping/2 * der(x)^2",
                    name.text
                );
                let extent = name.span.into();
                hints.push(Hint { text, extent });
            }
        }
        self.system.hints.extend(hints);
    }

    /// The value at a state of any signs, with positive parameters and forces.
    fn at(&self, e: ExprId, state: u32) -> f64 {
        let system = &self.system;
        let value = |symbol: Symbol| {
            let place = (symbol.index() + 1) as f64;
            // Irrational steps: no two symbols are in a simple ratio.
            let part = (place * 0.618_033_988_749 + f64::from(state) * 0.414_213_562_373).fract();
            let coordinates = system.coordinates.iter();
            let mut moving = coordinates.flat_map(|c| [c.position, c.velocity]);
            match moving.any(|own| own == symbol) {
                false => 0.4 + part,
                true => {
                    let sign = 0.5 - (7.0 * part).fract();
                    REACH.powf(2.0 * part - 1.0).copysign(sign)
                }
            }
        };
        let mut sides = Vec::new();
        for branch in &system.branches {
            let guard = system.pool.evaluate(&[branch.guard], &value, &|b| sides[b]);
            sides.push(guard[0] >= 0.0);
        }
        system.pool.evaluate(&[e], &value, &|b| sides[b])[0]
    }
}
