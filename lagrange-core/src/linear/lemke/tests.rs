//! Random problems against the enumeration of all bases.

use super::{Lemke, Outcome};
use crate::linear::tests::Random;
use nalgebra::{DMatrix, DVector};

/// All w of solutions with a regular basis, by enumeration.
fn enumerate(m: &DMatrix<f64>, q: &DVector<f64>) -> Vec<DVector<f64>> {
    let n = q.len();
    let mut found = Vec::new();
    for code in 0..1_usize << n {
        let active: Vec<usize> = (0..n).filter(|i| code >> i & 1 == 1).collect();
        let part = m.select_rows(&active).select_columns(&active);
        let right = -q.select_rows(&active);
        let solution = match active.len() {
            0 => Some(right),
            _ => part.lu().solve(&right),
        };
        let Some(z) = solution else {
            continue;
        };
        let mut whole = DVector::zeros(n);
        for (&i, &x) in active.iter().zip(z.iter()) {
            whole[i] = x;
        }
        // A basis that rounding alone makes regular solves nothing.
        if violation(m, q, &whole) <= 1e-9 {
            found.push(m * &whole + q);
        }
    }
    found
}

/// The greatest violation of the problem by `z`.
fn violation(m: &DMatrix<f64>, q: &DVector<f64>, z: &DVector<f64>) -> f64 {
    let w = m * z + q;
    let pairs = w.iter().zip(z.iter());
    pairs
        .map(|(&w, &z)| (-w).max(-z).max(w.min(z)))
        .fold(0.0, f64::max)
}

fn solve(m: &DMatrix<f64>, q: &DVector<f64>) -> (Outcome, DVector<f64>) {
    let rows: Vec<f64> = m.transpose().iter().copied().collect();
    let mut lemke = Lemke::default();
    let outcome = lemke.solve(&rows, q.as_slice());
    for (i, &z) in lemke.z().iter().enumerate() {
        assert!(
            z == 0.0 || lemke.is_active(i),
            "an inactive unknown is not zero"
        );
    }
    (outcome, DVector::from_column_slice(lemke.z()))
}

/// A Gᵀ G of a random rank, or with a skew part; sometimes with equal rows and zeros in q, so that it is degenerate.
fn semidefinite(random: &mut Random, n: usize) -> (DMatrix<f64>, DVector<f64>) {
    let rank = 1 + random.below(n);
    let coarse = random.one_in(2);
    let number = |random: &mut Random| {
        let x = random.number();
        if coarse { (2.0 * x).round() } else { x }
    };
    let g = DMatrix::from_fn(rank, n, |_, _| number(random));
    let mut m = g.transpose() * g;
    if random.one_in(2) {
        let skew = DMatrix::from_fn(n, n, |_, _| number(random));
        m += &skew - skew.transpose();
    }
    let q = DVector::from_fn(n, |_, _| number(random));
    (m, q)
}

#[test]
fn semidefinite_problems_are_solved_or_have_no_solution() {
    let mut random = Random::new(0x5eed_1234);
    let (mut solved, mut rays) = (0, 0);
    for _ in 0..3000 {
        let n = 1 + random.below(6);
        let (m, q) = semidefinite(&mut random, n);
        let all = enumerate(&m, &q);
        let (outcome, z) = solve(&m, &q);
        match outcome {
            Outcome::Solved => {
                let bad = violation(&m, &q, &z);
                assert!(bad < 1e-8 * (1.0 + z.amax()), "{m}{q}{z}: {bad}");
                solved += 1;
            }
            Outcome::Ray => {
                assert!(all.is_empty(), "a solution was missed: {m}{q}{:?}", all[0]);
                rays += 1;
            }
            Outcome::Limit => panic!("cycles: {m}{q}"),
        }
    }
    assert!(solved > 1000 && rays > 100, "{solved} and {rays}");
}

#[test]
fn the_solution_of_a_positive_definite_problem_is_the_only_one() {
    let mut random = Random::new(77);
    for _ in 0..500 {
        let n = 1 + random.below(7);
        let g = DMatrix::from_fn(n, n, |_, _| random.number());
        let m = g.transpose() * &g + DMatrix::identity(n, n) * 0.01;
        let q = DVector::from_fn(n, |_, _| random.number());
        let (outcome, z) = solve(&m, &q);
        assert_eq!(outcome, Outcome::Solved);
        let w = &m * &z + &q;
        for other in enumerate(&m, &q) {
            assert!((&w - other).amax() < 1e-8);
        }
    }
}

/// Contacts with friction in a plane as Stewart & Trinkle write them, w = (g, s⁺, s⁻, cone) for z = (λ, f⁺, f⁻, σ):
/// copositive, and solvable for every approach velocity (Stewart & Trinkle 1996).
#[test]
fn impacts_with_friction_always_have_a_solution() {
    let mut random = Random::new(4242);
    for _ in 0..400 {
        let contacts = 1 + random.below(4);
        let coordinates = 2 + random.below(4);
        let rows = DMatrix::from_fn(2 * contacts, coordinates, |_, _| random.number());
        let delassus = &rows * rows.transpose();
        let v = DVector::from_fn(coordinates, |_, _| random.number());
        let before = &rows * v;
        let mut m = DMatrix::zeros(4 * contacts, 4 * contacts);
        let mut q = DVector::zeros(4 * contacts);
        // Rows and columns of normal, tangential and opposite direction in the Delassus matrix.
        let source = |k: usize| match k % 4 {
            0 => (2 * (k / 4), 1.0),
            1 => (2 * (k / 4) + 1, 1.0),
            _ => (2 * (k / 4) + 1, -1.0),
        };
        for i in (0..4 * contacts).filter(|i| i % 4 < 3) {
            let (a, s) = source(i);
            q[i] = s * before[a];
            for j in (0..4 * contacts).filter(|j| j % 4 < 3) {
                let (b, t) = source(j);
                m[(i, j)] = s * t * delassus[(a, b)];
            }
        }
        for c in 0..contacts {
            let mu = 1.0 + random.number();
            let at = 4 * c;
            m[(at + 3, at)] = mu;
            for k in [1, 2] {
                m[(at + 3, at + k)] = -1.0;
                m[(at + k, at + 3)] = 1.0;
            }
        }
        let (outcome, z) = solve(&m, &q);
        assert_eq!(outcome, Outcome::Solved, "{m}{q}");
        let bad = violation(&m, &q, &z);
        assert!(bad < 1e-8 * (1.0 + z.amax()), "{bad}");
    }
}

/// A row of touching balls hit at one end, all normals equal: every pivot ties.
#[test]
fn a_long_row_of_equal_contacts_does_not_cycle() {
    let n = 64;
    let m = DMatrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    });
    for first in [-1.0, 0.0] {
        let q = DVector::from_fn(n, |i, _| if i == 0 { first } else { 0.0 });
        let (outcome, z) = solve(&m, &q);
        assert_eq!(outcome, Outcome::Solved);
        assert!(violation(&m, &q, &z) < 1e-12);
        // Second differences of z vanish but at the end.
        assert!((z[0] + first * n as f64 / (n + 1) as f64).abs() < 1e-12);
    }
}

#[track_caller]
fn check_solution(m: &[f64; 9], q: [f64; 3], expected: [f64; 3]) {
    let (m, q) = (
        DMatrix::from_row_slice(3, 3, m),
        DVector::from_row_slice(&q),
    );
    let (outcome, z) = solve(&m, &q);
    assert_eq!(outcome, Outcome::Solved);
    assert!((z - DVector::from_row_slice(&expected)).amax() < 1e-14);
}

/// Kostreva, "Cycling in linear complementarity problems", Mathematical Programming 16 (1979): by the first of equal ratios the
/// pivots come back to where they were, although the matrix has one solution for every q.
#[test]
fn a_problem_that_is_known_to_cycle_is_solved() {
    let m = [1.0, 2.0, 0.0, 0.0, 1.0, 2.0, 2.0, 0.0, 1.0];
    check_solution(&m, [-1.0; 3], [1.0 / 3.0; 3]);
}

/// The artificial unknown reaches zero together with another one. If that one leaves, the next pivot finds a ray, which proves
/// nothing, since the matrix is not copositive plus.
#[test]
fn the_artificial_unknown_leaves_first() {
    let m = [1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 0.0];
    check_solution(&m, [-1.0, 1.0, -1.0], [1.0, 0.0, 0.0]);
}
