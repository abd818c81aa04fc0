//! More modes than are all looked at: what need not let go holds, and of several impacts that follow the law most sticks.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, all_agree, certified, run_by};

/// Five blocks, one upon the other; the lowest is pushed off. How they are pressed follows from contacts.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[5], y[5]),
    kinetic = sum(i in 0..5: der(x[i])^2 + der(y[i])^2) / 2,
    potential = 10 * sum(i in 0..5: y[i]),
    contact(c0: y[0] >= 0),
    contact(c1: y[1] >= y[0]),
    contact(c2: y[2] >= y[1]),
    contact(c3: y[3] >= y[2]),
    contact(c4: y[4] >= y[3]),
    friction(f0 on c0: slip = der(x[0]), static = more * mu[0], kinetic = mu[0]),
    friction(f1 on c1: slip = der(x[1] - x[0]), static = more * mu[1], kinetic = mu[1]),
    friction(f2 on c2: slip = der(x[2] - x[1]), static = more * mu[2], kinetic = mu[2]),
    friction(f3 on c3: slip = der(x[3] - x[2]), static = more * mu[3], kinetic = mu[3]),
    friction(f4 on c4: slip = der(x[4] - x[3]), static = more * mu[4], kinetic = mu[4]),
)]
struct Stack {
    mu: [f64; 5],
    more: f64,
}

/// The same with the loads written down, so that there are few enough modes for all to be looked at.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[5]),
    kinetic = sum(i in 0..5: der(x[i])^2) / 2,
    friction(f0: slip = der(x[0]), normal = 50, static = more * mu[0], kinetic = mu[0]),
    friction(f1: slip = der(x[1] - x[0]), normal = 40, static = more * mu[1], kinetic = mu[1]),
    friction(f2: slip = der(x[2] - x[1]), normal = 30, static = more * mu[2], kinetic = mu[2]),
    friction(f3: slip = der(x[3] - x[2]), normal = 20, static = more * mu[3], kinetic = mu[3]),
    friction(f4: slip = der(x[4] - x[3]), normal = 10, static = more * mu[4], kinetic = mu[4]),
)]
struct Loaded {
    mu: [f64; 5],
    more: f64,
}

#[test]
fn what_is_not_overcome_holds() {
    let mut random = Random::new(576);
    for _ in 0..60 {
        let mu = [0; 5].map(|_| 0.1 * (1 + random.below(5)) as f64);
        let more = [1.1, 1.2, 1.5, 2.0][random.below(4)];
        let speed = (1 + random.below(3)) as f64;
        let [stack, loaded] = [Stack { mu, more }, Stack { mu, more }];
        let loaded = Loaded {
            mu: loaded.mu,
            more: loaded.more,
        };
        let mut v = [0.0; 10];
        v[0] = speed;
        for pair in [("auto", 1e-9), ("dop853", 1e-9)] {
            let what = format!("{stack:?} at {speed} by {pair:?}");
            let run = run_by(&stack, pair, state(&[0.0; 10], &v), 3.0);
            let few = run_by(&loaded, pair, state(&[0.0; 5], &v[..5]), 3.0);
            certified(&what, &run);
            all_agree(what, &run.final_state().q[..5], &few.final_state().q, 1e-7);
        }
    }
}

/// Three blocks that fall onto a belt together, each with a speed of its own along it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[3], y[3]),
    kinetic = sum(i in 0..3: mass[i] * (der(x[i])^2 + der(y[i])^2)) / 2,
    contact(c0: y[0] >= 0),
    contact(c1: y[1] >= y[0]),
    contact(c2: y[2] >= y[1]),
    friction(f0 on c0: slip = der(x[0]) - belt, static = holds[0], kinetic = slides[0]),
    friction(f1 on c1: slip = der(x[1] - x[0]), static = holds[1], kinetic = slides[1]),
    friction(f2 on c2: slip = der(x[2] - x[1]), static = holds[2], kinetic = slides[2]),
)]
struct Falling {
    mass: [f64; 3],
    belt: f64,
    holds: [f64; 3],
    slides: [f64; 3],
}

/// What the blocks do if each friction sticks (0) or slides in a direction, and the impulses along them.
fn speeds_after(
    scene: &Falling,
    v: [f64; 3],
    normal: [f64; 3],
    does: [i32; 3],
) -> ([f64; 3], [f64; 3]) {
    // Unknown are the three impulses along the frictions: what slides gives its own, what sticks an equation of its slip.
    let mut matrix = [[0.0; 4]; 3];
    let slip =
        |speeds: [f64; 3], f: usize| speeds[f] - if f == 0 { scene.belt } else { speeds[f - 1] };
    let after = |impulses: [f64; 3]| {
        let mut speeds = v;
        for f in 0..3 {
            speeds[f] += impulses[f] / scene.mass[f];
            if f > 0 {
                speeds[f - 1] -= impulses[f] / scene.mass[f - 1];
            }
        }
        speeds
    };
    let unit = |k: usize| core::array::from_fn(|f| f64::from(u8::from(f == k)));
    for f in 0..3 {
        if does[f] == 0 {
            let free = slip(after([0.0; 3]), f);
            for (k, entry) in matrix[f][..3].iter_mut().enumerate() {
                *entry = slip(after(unit(k)), f) - free;
            }
            matrix[f][3] = -free;
        } else {
            matrix[f][f] = 1.0;
            matrix[f][3] = -f64::from(does[f]) * scene.slides[f] * normal[f];
        }
    }
    for k in 0..3 {
        let pivot = (k..3).max_by(|&a, &b| matrix[a][k].abs().total_cmp(&matrix[b][k].abs()));
        matrix.swap(k, pivot.unwrap_or(k));
        for row in 0..3 {
            if row != k {
                let factor = matrix[row][k] / matrix[k][k];
                let upper = matrix[k];
                (matrix[row].iter_mut().zip(upper)).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    let impulses = core::array::from_fn(|k| matrix[k][3] / matrix[k][k]);
    (after(impulses), impulses)
}

/// All 27 possibilities: of those that follow the law the one in which most sticks.
#[test]
fn of_several_impacts_most_sticks() {
    let mut random = Random::new(577);
    let mut several = 0;
    for _ in 0..400 {
        let mass = [0; 3].map(|_| [0.5, 1.0, 2.0][random.below(3)]);
        let slides = [0; 3].map(|_| random.between(0.05, 0.4));
        let more = [0; 3].map(|_| random.between(1.1, 2.0));
        let v = [0; 3].map(|_| random.between(-3.0, 3.0));
        let scene = Falling {
            mass,
            belt: random.between(-2.0, 2.0),
            holds: core::array::from_fn(|f| more[f] * slides[f]),
            slides,
        };
        let normal: [f64; 3] = core::array::from_fn(|f| 5.0 * mass[f..].iter().sum::<f64>());
        let mut found: Vec<(usize, [f64; 3])> = Vec::new();
        for choice in 0..27 {
            let does = [choice % 3 - 1, choice / 3 % 3 - 1, choice / 9 - 1];
            let (speeds, impulses) = speeds_after(&scene, v, normal, does);
            let holds = (0..3).all(|f| {
                let slip = speeds[f] - if f == 0 { scene.belt } else { speeds[f - 1] };
                match does[f] {
                    0 => impulses[f].abs() <= scene.holds[f] * normal[f],
                    sign => slip * f64::from(sign) > 0.0,
                }
            });
            if holds {
                found.push((does.iter().filter(|&&does| does == 0).count(), speeds));
            }
        }
        let most = found
            .iter()
            .map(|(sticks, _)| *sticks)
            .max()
            .expect("a solution");
        let mut best = found.iter().filter(|(sticks, _)| *sticks == most);
        let (Some((_, speeds)), None) = (best.next(), best.next()) else {
            continue;
        };
        several += usize::from(found.len() > 1);
        let start = state(&[0.0; 6], &[v[0], v[1], v[2], -5.0, -5.0, -5.0]);
        let run = run_by(&scene, ("auto", 1e-9), start, 0.001);
        let what = format!("{scene:?} from {v:?}: {found:?}");
        let impact = &run.events()[0];
        all_agree(what, &impact.state_after.v[..3], speeds, 1e-10);
    }
    assert!(several > 20, "{several}");
}
