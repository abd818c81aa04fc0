//! Coefficients against Butcher's order conditions: Σ bᵢ Φᵢ(τ) = 1/γ(τ) for every rooted tree τ, and with s^|τ| for the dense
//! output at s (Hairer, Nørsett & Wanner 1993, sections II.2 and II.6).

use crate::integrate::tableau::{Estimate, Tableau, Weights};
use crate::integrate::{dop853, dopri5, rk4, verner98};

/// A rooted tree by what it does to a tableau: its order, its density γ and Φᵢ for each stage.
#[derive(Clone)]
struct Tree {
    order: usize,
    density: f64,
    weights: Vec<f64>,
}

/// All rooted trees up to `order`.
fn trees(tableau: &Tableau, order: usize) -> Vec<Tree> {
    let stages = tableau.nodes.len();
    // aᵢⱼ Φⱼ of a tree, once for each tree.
    let planted = |tree: &Tree| -> Vec<f64> {
        tableau
            .stages
            .iter()
            .map(|row| apply(row, &tree.weights))
            .collect()
    };
    let mut all: Vec<(Tree, Vec<f64>)> = Vec::new();
    for order in 1..=order {
        // Forests of order − 1 nodes, trees in ascending index so that each forest occurs once.
        let mut forests = vec![(
            order - 1,
            0,
            Tree {
                order: 1,
                density: 1.0,
                weights: vec![1.0; stages],
            },
        )];
        while let Some((left, from, forest)) = forests.pop() {
            if left == 0 {
                let density = forest.density * order as f64;
                let tree = Tree {
                    order,
                    density,
                    ..forest
                };
                let planted = planted(&tree);
                all.push((tree, planted));
                continue;
            }
            for (index, (tree, planted)) in all.iter().enumerate().skip(from) {
                // Trees of the present order are not yet branches.
                if tree.order > left {
                    continue;
                }
                let weights = forest
                    .weights
                    .iter()
                    .zip(planted)
                    .map(|(a, b)| a * b)
                    .collect();
                let density = forest.density * tree.density;
                forests.push((
                    left - tree.order,
                    index,
                    Tree {
                        order: 1,
                        density,
                        weights,
                    },
                ));
            }
        }
    }
    all.into_iter().map(|(tree, _)| tree).collect()
}

fn apply(weights: Weights, stages: &[f64]) -> f64 {
    weights.iter().map(|&(i, weight)| weight * stages[i]).sum()
}

/// Σ bᵢ(s) Φᵢ from the Bernstein weights.
fn dense(tableau: &Tableau, s: f64, stages: &[f64]) -> f64 {
    let degree = tableau.dense.len() + 1;
    let inner = tableau.dense.iter().map(|weights| apply(weights, stages));
    let last = apply(tableau.stages[tableau.end], stages);
    let mut binomial = 1.0;
    let mut sum = 0.0;
    for (m, b) in inner.chain([last]).enumerate() {
        let m = m + 1;
        binomial = binomial * (degree + 1 - m) as f64 / m as f64;
        sum += b * binomial * s.powi(m as i32) * (1.0 - s).powi((degree - m) as i32);
    }
    sum
}

fn check(tableau: &Tableau, embedded: &[(Weights, usize)], dense_order: usize) {
    assert_eq!(tableau.nodes.len(), tableau.stages.len());
    for (row, node) in tableau.stages.iter().zip(tableau.nodes) {
        let sum: f64 = row.iter().map(|(_, a)| a).sum();
        assert!((sum - node).abs() < 1e-13, "row sum {sum} for {node}");
    }
    let all = trees(tableau, tableau.order + 1);
    let counts = [1, 1, 2, 4, 9, 20, 48, 115, 286, 719];
    for (i, count) in counts[..=tableau.order].iter().enumerate() {
        assert_eq!(
            all.iter().filter(|tree| tree.order == i + 1).count(),
            *count
        );
    }
    let b = tableau.stages[tableau.end];
    let mut worst_above = 0.0f64;
    for tree in &all {
        let exact = 1.0 / tree.density;
        let error = (apply(b, &tree.weights) - exact).abs();
        if tree.order <= tableau.order {
            assert!(error < 1e-13, "order {}: {error:e}", tree.order);
        } else {
            worst_above = worst_above.max(error);
        }
        for &(weights, order) in embedded {
            if tree.order <= order {
                let difference = apply(weights, &tree.weights);
                assert!(
                    difference.abs() < 1e-13,
                    "embedded, order {}: {difference:e}",
                    tree.order
                );
            }
        }
        if tree.order <= dense_order {
            for s in [0.1, 0.25, 0.5, 0.8, 0.95] {
                let error =
                    dense(tableau, s, &tree.weights) - exact * f64::powi(s, tree.order as i32);
                assert!(
                    error.abs() < 1e-13,
                    "dense at {s}, order {}: {error:e}",
                    tree.order
                );
            }
        }
    }
    assert!(worst_above > 1e-7, "the order is higher than said");
}

#[test]
fn dormand_prince_853() {
    let Estimate::Combined { fifth, third } = dop853::TABLEAU.estimate else {
        panic!("two estimates")
    };
    check(&dop853::TABLEAU, &[(fifth, 5), (third, 3)], 7);
}

#[test]
fn dormand_prince_54() {
    let Estimate::Embedded(weights) = dopri5::TABLEAU.estimate else {
        panic!("one estimate")
    };
    check(&dopri5::TABLEAU, &[(weights, 4)], 4);
}

#[test]
fn verner_98() {
    let Estimate::Embedded(weights) = verner98::TABLEAU.estimate else {
        panic!("one estimate")
    };
    check(&verner98::TABLEAU, &[(weights, 8)], 8);
}

#[test]
fn runge_kutta_4() {
    check(&rk4::TABLEAU, &[], 0);
}
