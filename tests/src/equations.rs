//! The equations of motion of a system in one mode at one state, as dense matrices.

use lagrange_core::__private::program::ValueRef;
use lagrange_core::dynamics::{Dynamics, OutputMask};
use lagrange_core::effects::Effects;
use lagrange_core::mode::Mode;
use lagrange_core::system::System;

/// What the derived equations say at one state.
#[derive(Clone, Debug)]
pub struct Equations {
    /// M, by rows.
    pub mass: Vec<Vec<f64>>,
    /// f of M v̇ = f + Σ aᵀ λ.
    pub forcing: Vec<f64>,
    /// a of every row, dense.
    pub jacobian: Vec<Vec<f64>>,
    /// γ of every row.
    pub bias: Vec<f64>,
    /// g or gap of every row; 0 for rows of velocity level.
    pub position: Vec<f64>,
    /// Rate of g, residual or slip of every row.
    pub velocity: Vec<f64>,
    /// v̇ in the mode.
    pub acceleration: Vec<f64>,
    /// λ of every row in the mode.
    pub force: Vec<f64>,
}

impl Equations {
    /// Evaluates `scene` in `mode` at time 0.
    ///
    /// # Panics
    /// If the library cannot.
    pub fn of<S: System<Scalar = f64>>(scene: &S, mode: &Mode, q: &[f64], v: &[f64]) -> Self {
        let d = scene.description();
        let n = d.coordinates.len();
        let mut dynamics = Dynamics::new(scene, &Effects::all());
        dynamics.set_mode(mode);
        let mut needs = OutputMask::new(d);
        for row in d.rows {
            let wanted = row.needs;
            [
                wanted.jacobian,
                wanted.bias,
                wanted.position,
                wanted.velocity,
            ]
            .into_iter()
            .for_each(|need| needs.insert(need));
        }
        dynamics.set_extra_needs(&needs);
        dynamics.value(0.0, q, v).expect("the equations of motion");
        let number = |place: ValueRef| dynamics.motion(place);
        let mut mass = vec![vec![0.0; n]; n];
        for &(i, j, place) in d.mass {
            mass[i][j] = number(place);
            mass[j][i] = number(place);
        }
        let dense = |row: &[(usize, ValueRef)]| {
            let mut a = vec![0.0; n];
            row.iter().for_each(|&(j, place)| a[j] = number(place));
            a
        };
        Self {
            mass,
            forcing: d.forcing.iter().map(|&place| number(place)).collect(),
            jacobian: d.rows.iter().map(|row| dense(row.jacobian)).collect(),
            bias: d.rows.iter().map(|row| number(row.bias)).collect(),
            position: d
                .rows
                .iter()
                .map(|row| number(row.position.unwrap_or(ValueRef::Zero)))
                .collect(),
            velocity: d.rows.iter().map(|row| number(row.velocity)).collect(),
            acceleration: dynamics.acceleration().to_vec(),
            force: (0..d.rows.len()).map(|row| dynamics.force(row)).collect(),
        }
    }
}
