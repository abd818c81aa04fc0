//! The textbook's formulas of the five scenes: stated as checks, proven when they are compiled; and tried as a test would.

use lagrange_core::assert_matches;
use lagrange_core::checks::{Checks, Outcome, Verdict};
use lagrange_problems::scenes::{
    MassOnShell, MassOnWheel, RollingSlippingSphere, RollingSphere, SphereInBowl,
};

#[track_caller]
fn proven(checks: &[Verdict], names: &[&str]) {
    let found: Vec<&str> = checks.iter().map(|check| check.name).collect();
    assert_eq!(found, names);
    for check in checks {
        assert!(matches!(check.outcome, Outcome::Proven { .. }), "{check:?}");
    }
}

#[test]
fn every_formula_is_proven() {
    proven(MassOnShell::CHECKS, &["normal", "from_rest", "falling", ""]);
    proven(RollingSphere::CHECKS, &["rolls", "normal", "uphill", ""]);
    proven(
        RollingSlippingSphere::CHECKS,
        &["rolls", "needed", "normal", "slides", "leaves", "spin"],
    );
    proven(
        MassOnWheel::CHECKS,
        &["stuck", "normal", "pushed", "slipping", "thrown"],
    );
    proven(
        SphereInBowl::CHECKS,
        &["swings", "needed", "from_rest", "from_kick"],
    );
    let [.., conserved] = MassOnShell::CHECKS else {
        panic!()
    };
    assert_eq!(conserved.claim, "conserved energy");
    assert_eq!(conserved.outcome, Outcome::Proven { modes: 2 });
}

#[test]
fn the_same_numbers_at_random_states() {
    let wheel = MassOnWheel::default();
    let stuck = Checks::new(&wheel)
        .vary_parameters(0.5)
        .sticks(MassOnWheel::GRIP);
    assert_matches!(stuck, |s, now| now.a(MassOnWheel::THETA) => {
        let (sin, cos) = now.q(MassOnWheel::THETA).sin_cos();
        let square = s.radius * s.radius;
        s.mass * s.radius * sin * (s.gravity + s.radius * now.v(MassOnWheel::THETA).powi(2))
            / (s.wheel * square + s.inertia + 2.0 * s.mass * square * (1.0 + cos))
    });
    let bowl = SphereInBowl::default();
    let rolling = Checks::new(&bowl)
        .vary_parameters(0.2)
        .sticks(SphereInBowl::GRIP);
    assert_matches!(rolling, |s, now| now.force(SphereInBowl::BOWL) =>
        s.mass * s.gravity * now.q(SphereInBowl::THETA).cos()
            + s.mass * (s.radius - s.sphere_radius) * now.v(SphereInBowl::THETA).powi(2));
}
