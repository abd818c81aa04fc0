//! Many contacts and frictions that decide at once: too many to try all combinations.

use lagrange_core::prelude::*;

/// Blocks in a row, touching each other, on a rough floor, each pushed by a force of its own.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[32], y[32]),
    kinetic   = sum(k in 0..32: mass/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..32: mass * gravity * y[k]),
    contact(floor[k in 0..32]: y[k] >= 0),
    contact(pair[k in 0..31]: x[k+1] - x[k] >= width),
    friction(grip[k in 0..32] on floor[k]: slip = der(x[k]), static = mu),
    force(shove[k in 0..32]: x[k] = push[k]),
    start(resting: x[k in 0..32] = k * width),
)]
struct Crowd<T = f64> {
    mass: T,
    width: T,
    gravity: T,
    mu: T,
    push: [T; 32],
}

/// Accelerations of the crowd: each group of blocks that stay together has the mean of its forces, less the friction that
/// it can have; neighbours that would run into each other make one group (pool adjacent violators: Barlow et al. 1972,
/// Statistical Inference under Order Restrictions, section 1.2).
fn accelerations(crowd: &Crowd) -> Vec<f64> {
    let limit = crowd.mu * crowd.mass * crowd.gravity;
    let of = |force: f64, count: usize| {
        let (mass, limit) = (crowd.mass * count as f64, limit * count as f64);
        force.signum() * (force.abs() - limit).max(0.0) / mass
    };
    let mut groups: Vec<(f64, usize)> = Vec::new();
    for &force in &crowd.push {
        groups.push((force, 1));
        while let [.., (f, m), (g, n)] = groups[..]
            && of(f, m) >= of(g, n)
        {
            groups.pop();
            groups.pop();
            groups.push((f + g, m + n));
        }
    }
    let each = groups
        .iter()
        .flat_map(|&(force, count)| vec![of(force, count); count]);
    each.collect()
}

#[test]
fn a_crowd_that_is_pushed_parts_and_slides_as_it_must() {
    let mut modes = 0;
    for seed in 1..14 {
        for strength in [0.2, 0.5, 1.0, 2.0, 5.0] {
            let wave = |k: usize| ((seed * (k + 1) * (k + 1)) as f64 * 0.37).sin();
            let crowd = Crowd {
                mass: 0.1,
                width: 0.02,
                gravity: 9.81,
                mu: 0.3,
                push: core::array::from_fn(|k| strength * wave(k)),
            };
            let simulation = Simulation::new(&crowd).tolerance(1e-10);
            let trajectory = simulation.run(crowd.at(Crowd::RESTING), 0.0..1e-3);
            let trajectory =
                trajectory.unwrap_or_else(|f| panic!("{seed} {strength}: {}", f.error));
            let now = trajectory.sampler().at(0.0).expect("a start");
            let expected = accelerations(&crowd);
            for (k, expected) in expected.iter().enumerate() {
                let found = now.acceleration[k];
                assert!(
                    (found - expected).abs() < 1e-9 * (1.0 + strength / crowd.mass),
                    "{seed} {strength}: block {k} accelerates at {found}, not {expected}"
                );
            }
            modes += usize::from(expected.iter().any(|a| *a != 0.0));
        }
    }
    assert!(modes > 40, "{modes}");
}

/// Plates on each other on a floor that is jerked away.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[16], y[16]),
    kinetic   = sum(k in 0..16: mass/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..16: mass * gravity * y[k]),
    contact(floor: y[0] >= 0),
    contact(pair[k in 0..15]: y[k+1] - y[k] >= height),
    friction(base on floor: slip = der(x[0]) - jerk * t^2 / 2, static = mu[0]),
    friction(grip[k in 0..15] on pair[k]: slip = der(x[k+1]) - der(x[k]), static = mu[k+1]),
    start(resting: y[k in 0..16] = k * height),
)]
struct Plates<T = f64> {
    mass: T,
    height: T,
    gravity: T,
    jerk: T,
    mu: [T; 16],
}

/// A face slips when friction there can no longer move the plate above it and hold against what drags on that one from above:
/// m a + μ' N' = μ N, where N is the weight above the face and primes belong to the next one.
#[test]
fn plates_slip_one_after_the_other() {
    let plates = Plates {
        mass: 0.1,
        height: 0.02,
        gravity: 9.81,
        jerk: 5.0,
        mu: core::array::from_fn(|k| 0.5 - 0.02 * k as f64),
    };
    let simulation = Simulation::new(&plates).tolerance(1e-12);
    let start = plates.at(Plates::RESTING);
    let trajectory = simulation.run(start, 0.0..2.0).expect("a run");
    let slips: Vec<f64> = trajectory.events().iter().map(|e| e.time).collect();
    assert_eq!(slips.len(), 16);
    for (k, time) in slips.iter().enumerate() {
        let (mu, above) = (&plates.mu, k as f64);
        let drag = above * mu.get(16 - k).unwrap_or(&0.0);
        let expected = (mu[15 - k] * (above + 1.0) - drag) * plates.gravity / plates.jerk;
        assert!((time / expected - 1.0).abs() < 1e-12, "{time} {expected}");
    }
}

/// Where all coefficients are equal all faces reach their limit together, but only the lowest slips.
#[test]
fn of_equal_plates_only_the_lowest_face_slips() {
    let plates = Plates {
        mass: 0.1,
        height: 0.02,
        gravity: 9.81,
        jerk: 5.0,
        mu: [0.3; 16],
    };
    let simulation = Simulation::new(&plates).tolerance(1e-12);
    let start = plates.at(Plates::RESTING);
    let trajectory = simulation.run(start, 0.0..1.2).expect("a run");
    let [event] = trajectory.events() else {
        panic!("{} events", trajectory.events().len());
    };
    let expected: f64 = 0.3 * plates.gravity / plates.jerk;
    assert!((event.time / expected - 1.0).abs() < 1e-12);
    assert_eq!(event.subject, Subject::Friction(0));
}
