#![allow(missing_docs, dead_code)]
use lagrange_core::prelude::*;
const PI: f64 = core::f64::consts::PI;
pub fn state(q: &[f64], v: &[f64]) -> State<f64> { State::new(q.to_vec(), v.to_vec()) }
#[path = "all/systems/side_by_side.rs"]
mod side_by_side;
