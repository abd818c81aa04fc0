//! Chains of links in plane: arrays and sums.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::equations::Equations;
use lagrange_tests::modes::flight;
use lagrange_tests::{Random, agree, all_agree, closure, run, run_by};

/// A chain of n links in ten lines.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[2]),
    define(
        x[k in 0..2] = sum(i in 0..k+1: length[i] * sin(theta[i])),
        y[k in 0..2] = sum(i in 0..k+1: -length[i] * cos(theta[i])),
    ),
    kinetic = sum(k in 0..2: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..2: mass[k] * gravity * y[k]),
)]
struct Chain {
    mass: [f64; 2],
    length: [f64; 2],
    gravity: f64,
}

#[test]
fn a_chain_of_two_links_is_the_double_pendulum() {
    let chain = Chain {
        mass: [1.0; 2],
        length: [1.0; 2],
        gravity: 9.81,
    };
    let trajectory = run(&chain, state(&[2.0, 2.5], &[0.0; 2]), 5.0);
    let end = trajectory.final_state();
    // heyoka in multiple precision (170 bits); the motion amplifies errors about 1e4 times.
    agree("θ₀", end.q[0], 8.191_078_459_414_503, 1e-8);
    agree("θ₁", end.q[1], 0.015_016_920_586_249_179, 1e-8);
    agree("ω₀", end.v[0], 2.561_275_215_857_095_5, 1e-8);
    assert!(closure(&trajectory) < 1e-11);
}

#[test]
fn methods_agree() {
    let chain = Chain {
        mass: [1.0, 0.5],
        length: [1.0, 0.7],
        gravity: 9.81,
    };
    let start = state(&[0.4, -0.3], &[0.0, 1.0]);
    let reference = run(&chain, start.clone(), 2.0);
    for (method, tolerance, accuracy) in [
        ("dop853", 1e-12, 1e-10),
        ("dopri5", 1e-11, 1e-9),
        ("verner98", 1e-12, 1e-10),
        ("rk4:0.0005", 1e-9, 1e-9),
    ] {
        let end = run_by(&chain, (method, tolerance), start.clone(), 2.0);
        for (a, b) in end.final_state().q.iter().zip(&reference.final_state().q) {
            agree(method, *a, *b, accuracy);
        }
    }
}

/// Six links.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[6]),
    define(
        x[k in 0..6] = sum(i in 0..k+1: length[i] * sin(theta[i])),
        y[k in 0..6] = sum(i in 0..k+1: -length[i] * cos(theta[i])),
    ),
    kinetic = sum(k in 0..6: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..6: mass[k] * gravity * y[k]),
)]
struct LongChain {
    mass: [f64; 6],
    length: [f64; 6],
    gravity: f64,
}

/// Twelve links: the derivation of large systems, and a tape that is data.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[12]),
    define(
        x[k in 0..12] = sum(i in 0..k+1: length[i] * sin(theta[i])),
        y[k in 0..12] = sum(i in 0..k+1: -length[i] * cos(theta[i])),
    ),
    kinetic = sum(k in 0..12: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..12: mass[k] * gravity * y[k]),
)]
struct LongestChain {
    mass: [f64; 12],
    length: [f64; 12],
    gravity: f64,
}

#[test]
fn a_chain_of_twelve_is_that_of_the_hand_formulas() {
    let mut random = Random::new(43);
    for _ in 0..50 {
        let chain = LongestChain {
            mass: [(); 12].map(|()| random.between(0.1, 3.0)),
            length: [(); 12].map(|()| random.between(0.1, 2.0)),
            gravity: 9.81,
        };
        let q = [(); 12].map(|()| random.between(-3.0, 3.0));
        let v = [(); 12].map(|()| random.between(-3.0, 3.0));
        let (m, f) = by_hand((&chain.mass, &chain.length), 9.81, &q, &v);
        let found = Equations::of(&chain, &flight::<LongestChain>(), &q, &v);
        for (found, m) in found.mass.iter().zip(&m) {
            all_agree("M", found, m, 1e-12);
        }
        all_agree("f", &found.forcing, &f, 1e-12);
    }
}

#[test]
fn a_chain_of_twelve_keeps_its_energy() {
    let chain = LongestChain {
        mass: [0.3; 12],
        length: [0.25; 12],
        gravity: 9.81,
    };
    let bent: Vec<f64> = (0..12).map(|i| 0.8 - 0.1 * f64::from(i)).collect();
    for (method, accuracy) in [("taylor", 1e-11), ("dop853", 1e-8)] {
        let run = run_by(&chain, (method, 1e-12), state(&bent, &[0.0; 12]), 2.0);
        assert!(closure(&run) < accuracy, "{method}: {}", closure(&run));
    }
}

/// With μᵢⱼ the mass below both joints: Mᵢⱼ = μᵢⱼ lᵢ lⱼ cos(θᵢ − θⱼ), fᵢ = −Σⱼ μᵢⱼ lᵢ lⱼ sin(θᵢ − θⱼ) θ̇ⱼ² − μᵢᵢ g lᵢ sin θᵢ.
fn by_hand<const N: usize>(
    (mass, length): (&[f64; N], &[f64; N]),
    gravity: f64,
    q: &[f64; N],
    v: &[f64; N],
) -> (Vec<Vec<f64>>, Vec<f64>) {
    let below = |i: usize, j: usize| mass[i.max(j)..].iter().sum::<f64>();
    let pair = |i: usize, j: usize| below(i, j) * length[i] * length[j];
    let m = (0..N)
        .map(|i| (0..N).map(|j| pair(i, j) * (q[i] - q[j]).cos()).collect())
        .collect();
    let f = (0..N)
        .map(|i| {
            let turning: f64 = (0..N)
                .map(|j| pair(i, j) * (q[i] - q[j]).sin() * v[j] * v[j])
                .sum();
            -turning - below(i, i) * gravity * length[i] * q[i].sin()
        })
        .collect();
    (m, f)
}

#[test]
fn chains_are_those_of_the_hand_formulas() {
    let mut random = Random::new(41);
    for _ in 0..200 {
        let chain = LongChain {
            mass: [(); 6].map(|()| random.between(0.1, 3.0)),
            length: [(); 6].map(|()| random.between(0.1, 2.0)),
            gravity: 9.81,
        };
        let q = [(); 6].map(|()| random.between(-3.0, 3.0));
        let v = [(); 6].map(|()| random.between(-3.0, 3.0));
        let (m, f) = by_hand((&chain.mass, &chain.length), 9.81, &q, &v);
        let found = Equations::of(&chain, &flight::<LongChain>(), &q, &v);
        for i in 0..6 {
            all_agree("M", &found.mass[i], &m[i], 1e-12);
            // M v̇ = f.
            let product: f64 = (0..6).map(|j| m[i][j] * found.acceleration[j]).sum();
            let size = f.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
            agree("M v̇ = f", product / size, f[i] / size, 1e-11);
        }
        all_agree("f", &found.forcing, &f, 1e-12);

        let double = Chain {
            mass: [chain.mass[0], chain.mass[1]],
            length: [chain.length[0], chain.length[1]],
            gravity: 9.81,
        };
        let (m, f) = by_hand(
            (&double.mass, &double.length),
            9.81,
            &[q[0], q[1]],
            &[v[0], v[1]],
        );
        let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        let expected = [
            (f[0] * m[1][1] - m[0][1] * f[1]) / determinant,
            (m[0][0] * f[1] - m[1][0] * f[0]) / determinant,
        ];
        let found = Equations::of(&double, &flight::<Chain>(), &q[..2], &v[..2]);
        all_agree("double pendulum", &found.acceleration, &expected, 1e-10);
    }
}

#[test]
fn a_long_chain_keeps_its_energy() {
    let chain = LongChain {
        mass: [1.0, 0.5, 0.8, 0.3, 0.6, 0.2],
        length: [0.5, 0.4, 0.3, 0.4, 0.2, 0.3],
        gravity: 9.81,
    };
    let trajectory = run(
        &chain,
        state(&[1.5, 1.0, 0.5, 0.0, -0.5, -1.0], &[0.0; 6]),
        5.0,
    );
    assert!(closure(&trajectory) < 1e-11);
}

/// The double pendulum in Cartesian coordinates with two rods.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[2], y[2]),
    kinetic = sum(k in 0..2: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..2: mass[k] * gravity * y[k]),
    constraint(upper: x[0]^2 + y[0]^2 == length[0]^2),
    constraint(lower: (x[1] - x[0])^2 + (y[1] - y[0])^2 == length[1]^2),
)]
struct Rods {
    mass: [f64; 2],
    length: [f64; 2],
    gravity: f64,
}

#[test]
fn rods_and_angles_agree() {
    let (mass, length) = ([1.0, 0.5], [1.0, 0.7]);
    let rods = Rods {
        mass,
        length,
        gravity: 9.81,
    };
    let chain = Chain {
        mass,
        length,
        gravity: 9.81,
    };
    let q = [0.8_f64, -0.3];
    let place = [
        q[0].sin(),
        q[0].sin() + 0.7 * q[1].sin(),
        -q[0].cos(),
        -q[0].cos() - 0.7 * q[1].cos(),
    ];
    let one = run(&chain, state(&q, &[0.0; 2]), 3.0);
    let two = run(&rods, state(&place, &[0.0; 4]), 3.0);
    let (a, b) = (&one.final_state().q, &two.final_state().q);
    agree("x₀", b[0], a[0].sin(), 1e-9);
    agree("x₁", b[1], a[0].sin() + 0.7 * a[1].sin(), 1e-9);
    agree("y₁", b[3], -a[0].cos() - 0.7 * a[1].cos(), 1e-9);
    assert!(closure(&two) < 1e-10);
}
