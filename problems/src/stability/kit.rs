//! Short ways to run a scene and to look at what it did.

use lagrange_core::__private::program::ValueRef;
use lagrange_core::dynamics::OutputMask;
use lagrange_core::prelude::*;
use lagrange_program::stability::Surprise;

/// The tolerance of every case.
pub const TOLERANCE: f64 = 1e-12;

/// Runs a scene from a named start at time 0.
pub fn run<S: System<Scalar = f64>>(
    scene: &S,
    start: StartId,
    until: f64,
) -> Result<Trajectory<S::Scalar>, Surprise> {
    run_by(scene, (Method::Taylor, TOLERANCE), start, until)
}

/// The same by a method at a tolerance.
pub fn run_by<S: System<Scalar = f64>>(
    scene: &S,
    (method, tolerance): (Method, f64),
    start: StartId,
    until: f64,
) -> Result<Trajectory<S::Scalar>, Surprise> {
    let simulation = Simulation::new(scene).method(method).tolerance(tolerance);
    Ok(simulation.run(scene.at(start), 0.0..until)?)
}

/// |found − expected| over |expected|.
pub fn relative(found: f64, expected: f64) -> f64 {
    ((found - expected) / expected).abs()
}

/// |found − expected|
pub fn distance(found: f64, expected: f64) -> f64 {
    (found - expected).abs()
}

/// The `n`-th event (from 0) of an item and kind.
pub fn event<'a>(
    trajectory: &'a Trajectory,
    item: &str,
    kind: &str,
    n: usize,
) -> Result<&'a Event<f64>, Surprise> {
    let mut events = trajectory.events().iter();
    let is =
        |e: &&Event<f64>| e.subject.name(trajectory.description()) == item && e.kind.word() == kind;
    events
        .by_ref()
        .filter(is)
        .nth(n)
        .ok_or_else(|| Surprise::Missing {
            event: format!("{item} {kind}"),
        })
}

/// Demands that exactly these events happened, in this order.
pub fn story(trajectory: &Trajectory, expected: &[&str]) -> Result<(), Surprise> {
    let tell = |e: &Event<f64>| format!("{} {}", e.subject.name(trajectory.description()), e.kind);
    let found: Vec<String> = trajectory.events().iter().map(tell).collect();
    if found == expected {
        return Ok(());
    }
    Err(Surprise::Story {
        found,
        expected: expected.iter().map(|e| (*e).to_owned()).collect(),
    })
}

/// Closure of the energy ledger relative to its scale.
pub fn closure(trajectory: &Trajectory) -> Result<f64, Surprise> {
    let ledger = trajectory.ledger()?;
    Ok(ledger.closure.abs() / ledger.scale)
}

/// The largest residual of an equation of positions, and the deepest penetration, at the beginning of every step; in the
/// unit of the scene.
pub fn violation(trajectory: &Trajectory) -> Result<f64, Surprise> {
    let d = trajectory.description();
    let mut needs = OutputMask::new(d);
    for row in d.rows {
        needs.insert(row.needs.position);
    }
    let mut dynamics = trajectory.dynamics();
    dynamics.set_extra_needs(&needs);
    let mut sampler = trajectory.sampler();
    let mut worst: f64 = 0.0;
    for t in trajectory.step_times().chain([trajectory.last_time()]) {
        let now = sampler.at(t)?;
        dynamics.tape(t, &now.state.q, &now.state.v);
        let position = |row: usize| dynamics.motion(d.rows[row].position.unwrap_or(ValueRef::Zero));
        let equations = d.constraints.iter().map(|c| position(c.row).abs());
        let contacts = d.contacts.iter().zip(&now.mode.contacts);
        let gaps = contacts.map(|(c, closed)| {
            let gap = position(c.row);
            if *closed { gap.abs() } else { -gap }
        });
        worst = equations.chain(gaps).fold(worst, f64::max);
    }
    Ok(worst)
}

/// In space.
pub type Vector = [f64; 3];

/// a × b
pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
