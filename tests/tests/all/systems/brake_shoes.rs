//! A friction that holds a body which also lies against something that runs: what rubs there depends on how the load is shared, and the contact may carry
//! nothing of it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, words};

/// A brake shoe on a running drum, in a guide with dry friction.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(p, u),
    kinetic = drum/2 * der(p)^2 + der(u)^2/2,
    contact(shoe: u >= 0),
    friction(guide: slip = der(u), limit = (holds, slides)),
    friction(lining on shoe: slip = der(p), static = mu, kinetic = mu),
    force(cylinder: u = if(t <= 1, -press + (press + lift) * t, lift)),
)]
struct Brake {
    drum: f64,
    holds: f64,
    slides: f64,
    mu: f64,
    press: f64,
    lift: f64,
}

/// What pulls the shoe off is less than what holds its guide: it stays, whatever pressed it before.
#[test]
fn a_guide_holds_its_shoe() {
    let mut random = Random::new(1902);
    for k in 0..30 {
        let holds = random.between(0.2, 2.0);
        let press = if k % 3 == 0 {
            -0.9 * holds
        } else {
            random.between(0.0, 6.0)
        };
        let brake = Brake {
            drum: 3.0,
            holds,
            slides: holds * random.between(0.05, 1.0),
            mu: random.between(0.1, 0.6),
            press,
            lift: 0.9 * holds,
        };
        let start = state(&[0.0; 2], &[random.between(3.0, 6.0), 0.0]);
        for pair in methods_at(METHODS, [1e-6, 1e-9]) {
            let run = run_by(&brake, pair, start.clone(), 2.0);
            certified(format!("{pair:?}"), &run);
            let what = format!("{brake:?} by {pair:?}: {:?}", words(&run));
            agree(what, run.final_state().q[1], 0.0, 1e-12);
            if press < 0.0 {
                // Nothing presses the lining, and the drum runs on.
                agree("speed", run.final_state().v[0], start.v[0], 1e-12);
            }
        }
    }
}

/// A block that is pressed to a wall, which holds it, above a running belt, and a ball that falls beside it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z, ball),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2 + der(ball)^2)/2,
    potential = 10 * (y + ball),
    contact(wall: z >= 0),
    contact(belt: y >= 0),
    contact(ground: ball >= 0),
    friction(hold on wall: slip = der(y), static = 0.5, kinetic = 0.05),
    friction(rub on belt: slip = der(x) - 1, static = 0.3, kinetic = 0.3),
    force(press: z = -20),
    force(thread: y = pull * (1 - exp(-6*t))),
)]
struct Block {
    pull: f64,
}

/// A thread pulls by no more than the wall holds beyond the weight: the block loses the belt and stays where it is as the ball lands.
#[test]
fn a_block_that_a_wall_holds_stays_as_a_ball_lands_beside_it() {
    let modes = Block { pull: 12.0 };
    for (pair, pull) in
        methods_at(METHODS, TOLERANCES).flat_map(|pair| [(pair, 12.0), (pair, 19.0)])
    {
        let block = Block { pull };
        let run = run_by(&block, pair, state(&[0.0, 0.0, 0.0, 20.0], &[0.0; 4]), 4.0);
        certified(format!("{pair:?}"), &run);
        let names = words(&run);
        let what = format!("{pair:?}: {names:?}");
        agree(&what, run.final_state().q[1], 0.0, 1e-12);
        assert!(!names.contains(&"hold slips".to_owned()), "{what}");
        assert!(names.contains(&"belt lost".to_owned()), "{what}");
    }
    // All modes of such a state are told, the one that a run takes first.
    let held = state(&[0.0, 0.0, 0.0, 1.0], &[0.0; 4]);
    let listed = Simulation::new(&modes)
        .feasible_modes(3.0, &held)
        .expect("modes");
    let lifted: Vec<f64> = listed.iter().map(|now| now.acceleration[1]).collect();
    agree("held", lifted[0], 0.0, 1e-12);
    agree(
        "let go",
        lifted[1],
        2.0 * (1.0 - (-18.0_f64).exp()) - 1.0,
        1e-6,
    );
}
