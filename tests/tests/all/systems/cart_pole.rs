//! A pole on a cart: hand formulas, momentum and energy.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::equations::Equations;
use lagrange_tests::modes::flight;
use lagrange_tests::{Random, agree, all_agree, closure, run};

/// A cart on a level track with a pole hinged to it, θ from the upward vertical.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, theta),
    define(
        px = x + length * sin(theta),
        py = length * cos(theta),
    ),
    kinetic(rolling: cart/2 * der(x)^2),
    kinetic(swinging: pole/2 * (der(px)^2 + der(py)^2)),
    potential = pole * gravity * py,
    force(hand: x = push),
    observe(total = momentum(x), lean = theta),
)]
struct CartPole {
    cart: f64,
    pole: f64,
    length: f64,
    gravity: f64,
    push: f64,
}

/// ẍ = (F + m sin θ (l θ̇² − g cos θ))/(M + m sin² θ), θ̈ = (g sin θ − ẍ cos θ)/l.
#[test]
fn accelerations_are_those_of_the_hand_formulas() {
    let mut random = Random::new(51);
    for _ in 0..200 {
        let scene = CartPole {
            cart: random.between(0.2, 3.0),
            pole: random.between(0.2, 3.0),
            length: random.between(0.2, 3.0),
            gravity: random.between(1.0, 20.0),
            push: random.between(-5.0, 5.0),
        };
        let (theta, rate) = (random.between(-3.0, 3.0), random.between(-4.0, 4.0));
        let (s, c) = theta.sin_cos();
        let pull = scene.pole * s * (scene.length * rate * rate - scene.gravity * c);
        let cart = (scene.push + pull) / (scene.cart + scene.pole * s * s);
        let expected = [cart, (scene.gravity * s - cart * c) / scene.length];
        let (q, v) = ([0.3, theta], [random.between(-2.0, 2.0), rate]);
        let found = Equations::of(&scene, &flight::<CartPole>(), &q, &v);
        all_agree("v̇", &found.acceleration, &expected, 1e-11);
    }
}

#[test]
fn momentum_grows_with_the_push_only() {
    for push in [0.0, 1.5] {
        let scene = CartPole {
            cart: 1.0,
            pole: 0.3,
            length: 0.7,
            gravity: 9.81,
            push,
        };
        let trajectory = run(&scene, state(&[0.0, 0.2], &[0.0, 0.0]), 5.0);
        for k in 0..=10 {
            let t = 0.5 * f64::from(k);
            let now = trajectory.sampler().at(t).expect("inside");
            agree("momentum", now.observes[0], push * t, 1e-10);
            agree("lean", now.observes[1], now.state.q[1], 0.0);
        }
        let ledger = trajectory.ledger().expect("sampled");
        agree(
            "work",
            ledger.work[0].work,
            push * trajectory.final_state().q[0],
            1e-10,
        );
        assert!(closure(&trajectory) < 1e-11);
    }
}

/// Without the pole's kinetic energy the cart is a mass and the pole has none: θ has no inertia, which is said.
#[test]
fn leaving_out_an_energy_leaves_out_its_inertia() {
    let scene = CartPole {
        cart: 2.0,
        pole: 0.3,
        length: 0.7,
        gravity: 9.81,
        push: 3.0,
    };
    let failure = Simulation::new(&scene)
        .effects(Effects::all().without(CartPole::SWINGING))
        .run(state(&[0.0, 0.2], &[0.0, 0.0]), 0.0..1.0)
        .expect_err("no inertia");
    let Error::Singular { items, .. } = &failure.error else {
        panic!("{failure}")
    };
    assert_eq!(items, &["theta"]);
    // Without the push nothing pushes.
    let trajectory = Simulation::new(&scene)
        .tolerance(1e-12)
        .effects(Effects::all().without(CartPole::HAND))
        .run(state(&[0.0, 0.2], &[0.0, 0.0]), 0.0..1.0)
        .expect("smooth");
    let end = trajectory.sampler().at(1.0).expect("inside");
    agree("momentum", end.observes[0], 0.0, 1e-12);
}
