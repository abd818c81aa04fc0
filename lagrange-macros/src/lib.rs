//! `#[derive(Lagrangian)]`: the entry point. Everything it does is in `lagrange-engine`.
