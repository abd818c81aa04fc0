//! A ball that strikes a corner of two rough walls at once, where the law of impact has more than one solution.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree};

/// A ball in its plane; both walls are `reach` away from the origin.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    kinetic = (der(x)^2 + der(y)^2) / 2 + radius^2/5 * der(phi)^2,
    contact(right: reach - x >= 0, restitution = bounce),
    friction(side on right: slip = der(y) + radius * der(phi), static = mu, kinetic = share * mu),
    contact(top: reach - y >= 0, restitution = bounce),
    friction(ceiling on top: slip = der(x) - radius * der(phi), static = mu, kinetic = share * mu),
)]
struct Corner {
    radius: f64,
    reach: f64,
    bounce: f64,
    mu: f64,
    share: f64,
}

/// The same with the other wall declared first.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    kinetic = (der(x)^2 + der(y)^2) / 2 + radius^2/5 * der(phi)^2,
    contact(top: reach - y >= 0, restitution = bounce),
    friction(ceiling on top: slip = der(x) - radius * der(phi), static = mu, kinetic = share * mu),
    contact(right: reach - x >= 0, restitution = bounce),
    friction(side on right: slip = der(y) + radius * der(phi), static = mu, kinetic = share * mu),
)]
struct Exchanged {
    radius: f64,
    reach: f64,
    bounce: f64,
    mu: f64,
    share: f64,
}

/// Speeds after the impact, of the solution that is taken and of all others.
fn solutions<S: System<Scalar = f64>>(corner: &S, speeds: [f64; 3]) -> (bool, Vec<Vec<f64>>) {
    let start = state(&[0.0; 3], &speeds);
    let run = Simulation::new(corner).run(start, 0.0..1.5).expect("a run");
    let event = &run.events()[0];
    let others = event
        .other_impacts
        .iter()
        .map(|other| other.v_after.clone());
    let all = core::iter::once(event.state_after.v.clone()).chain(others);
    (event.ambiguous, all.collect())
}

/// At equal speeds without spin one friction sticks and the other slides: which, nothing says. Both are told, each the mirror image of the other.
#[test]
fn a_ball_in_a_symmetric_corner_has_two_ways() {
    let corner = Corner {
        radius: 0.1,
        reach: 1.0,
        bounce: 0.5,
        mu: 1.0,
        share: 0.5,
    };
    let (ambiguous, all) = solutions(&corner, [1.0, 1.0, 0.0]);
    assert!(ambiguous && all.len() > 1, "{all:?}");
    let mirrored = |v: &[f64]| [v[1], v[0], -v[2]];
    for v in &all {
        let image = mirrored(v);
        let has = all
            .iter()
            .any(|w| w.iter().zip(image).all(|(x, y)| (x - y).abs() < 1e-9));
        assert!(has, "{all:?}");
    }
}

/// Which wall is declared first does not matter where the jumps of the solutions differ.
#[test]
fn the_order_of_declaration_does_not_matter() {
    let mut random = Random::new(2);
    let mut several = 0;
    for case in 0..60 {
        let [bounce, mu, share] = [0.0, 0.3, 0.4].map(|least| random.between(least, 1.0));
        let (radius, reach) = (0.1, 1.0);
        let speeds = [1.0, 1.0, random.between(-30.0, 30.0)];
        let (flag, first) = solutions(
            &Corner {
                radius,
                reach,
                bounce,
                mu,
                share,
            },
            speeds,
        );
        let (same, second) = solutions(
            &Exchanged {
                radius,
                reach,
                bounce,
                mu,
                share,
            },
            speeds,
        );
        assert!(
            flag == same && first.len() == second.len(),
            "{case}: {first:?} {second:?}"
        );
        several += usize::from(flag);
        for (a, b) in first[0].iter().zip(&second[0]) {
            agree(format!("{case}"), *a, *b, 1e-9);
        }
    }
    assert!(several > 0, "none of them has several");
}
