//! Roots against polynomials made from their roots.

use super::*;
use core::ops::ControlFlow;
use fastrand::Rng;

fn multiply(p: &[f64], q: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; p.len() + q.len() - 1];
    for (i, p) in p.iter().enumerate() {
        for (j, q) in q.iter().enumerate() {
            product[i + j] += p * q;
        }
    }
    product
}

fn from_roots(roots: &[f64]) -> Vec<f64> {
    roots
        .iter()
        .fold(vec![1.0], |p, &r| multiply(&p, &[-r, 1.0]))
}

fn found(c: &[f64]) -> Vec<Root> {
    let mut list = RootList::new();
    roots(c, &mut list);
    list.to_vec()
}

fn places(c: &[f64]) -> Vec<f64> {
    found(c).iter().map(|root| root.s).collect()
}

#[track_caller]
fn check_close(c: &[f64], expected: &[f64], tolerance: f64) {
    let places = places(c);
    assert_eq!(places.len(), expected.len(), "{places:?} for {expected:?}");
    for (s, r) in places.iter().zip(expected) {
        assert!((s - r).abs() <= tolerance, "{s} for {r}");
    }
}

#[test]
fn lines_and_parabolas() {
    check_close(&[-0.25, 1.0], &[0.25], 1e-16);
    check_close(&[-0.3, 0.0, 1.2], &[0.5], 2e-16);
    check_close(&from_roots(&[0.25, 0.75]), &[0.25, 0.75], 2e-16);
    check_close(&from_roots(&[-0.25, 1.75]), &[], 0.0);
    check_close(&[], &[], 0.0);
    check_close(&[1.0], &[], 0.0);
    check_close(&[0.0; 12], &[], 0.0);
    check_close(&[1.0, 0.0, 0.0, 0.0], &[], 0.0);
}

#[test]
fn leading_zeros_and_tiny_coefficients_do_not_matter() {
    let mut c = from_roots(&[0.25, 0.75]);
    c.extend([0.0, 1e-40, -1e-60, 0.0, 0.0]);
    check_close(&c, &[0.25, 0.75], 2e-16);
    let scaled: Vec<f64> = c.iter().map(|c| c * 1e-200).collect();
    check_close(&scaled, &[0.25, 0.75], 2e-16);
}

#[test]
fn the_end_belongs_to_the_step_and_the_start_does_not() {
    check_close(&from_roots(&[0.0, 0.5, 1.0]), &[0.5, 1.0], 3e-16);
    assert_eq!(found(&[1.0, -1.0]).len(), 1);
    // Ends above zero by less than rounding.
    let end = found(&[1.0, -1.0 + 2e-16]);
    assert_eq!(
        (end.len(), end[0].s, end[0].direction),
        (1, 1.0, Direction::Falling)
    );
    assert!(found(&[1.0, -1.0 + 1e-14]).is_empty());
    // Leaves zero at s = 0.
    assert!(found(&[0.0, 1.0, 1.0]).is_empty());
    assert!(found(&[1e-17, -1.0, -1.0]).is_empty());
}

#[test]
fn a_multiple_zero_at_the_start_hides_no_root_close_to_it() {
    for order in 1..=4 {
        for power in 1..=6 {
            let root = 0.7 * 10f64.powi(-power);
            // What is smaller than that is below the noise all the way to the root.
            if root.powi(order) > 1e-12 {
                let mut c = vec![0.0; order as usize];
                c.extend([root, -1.0]);
                check_close(&c, &[root], 1e-3 * root);
            }
        }
    }
}

#[test]
fn directions_alternate() {
    let list = found(&from_roots(&[0.2, 0.4, 0.9]));
    let directions: Vec<_> = list.iter().map(|root| root.direction).collect();
    assert_eq!(
        directions,
        [Direction::Rising, Direction::Falling, Direction::Rising]
    );
    assert!(list.iter().all(|root| !root.grazing));
}

#[test]
fn random_roots_are_all_found() {
    let mut random = Rng::with_seed(1);
    let mut compared = 0;
    for _ in 0..4000 {
        let inside = random.usize(..6);
        let outside = random.usize(..6);
        let pairs = random.usize(..3);
        let mut expected: Vec<f64> = (0..inside).map(|_| random.f64()).collect();
        expected.sort_by(f64::total_cmp);
        let mut c = from_roots(&expected);
        for _ in 0..outside {
            let beyond = 1.1 + 3.0 * random.f64();
            let r = if random.f64() < 0.5 {
                beyond
            } else {
                1.0 - beyond
            };
            c = multiply(&c, &[-r, 1.0]);
        }
        for _ in 0..pairs {
            let (re, im) = (random.f64(), 0.1 + random.f64());
            c = multiply(&c, &[re * re + im * im, -2.0 * re, 1.0]);
        }
        // Nearer than rounding resolves is for the cluster tests.
        if expected.windows(2).any(|w| w[1] - w[0] < 1e-3)
            || expected.iter().any(|&r| !(1e-3..=0.999).contains(&r))
        {
            continue;
        }
        compared += 1;
        let list = found(&c);
        let places: Vec<f64> = list.iter().map(|root| root.s).collect();
        assert_eq!(list.len(), expected.len(), "{places:?} for {expected:?}");
        for (root, r) in list.iter().zip(&expected) {
            assert!((root.s - r).abs() <= root.width, "{root:?} for {r}");
            assert!(!root.grazing);
        }
        for after in [0.0, 0.5] {
            let later = |root: Root| match root.s > after {
                true => ControlFlow::Break(root),
                false => ControlFlow::Continue(()),
            };
            let expected = list.iter().find(|root| root.s > after);
            assert_eq!(find_root(&c, later), expected.copied());
        }
    }
    assert!(compared > 3000, "{compared}");
}

#[test]
fn quick_answers_agree_with_the_search() {
    // Shifting p up until it has no roots crosses every way to answer.
    let mut random = Rng::with_seed(2);
    for _ in 0..500 {
        let mut c: Vec<f64> = (0..12).map(|_| random.f64() - 0.5).collect();
        for step in 0..40 {
            c[0] = 0.1 * step as f64;
            let samples: Vec<f64> = (1..=2000)
                .map(|i| c.iter().rev().fold(0.0, |p, c| p * (i as f64 / 2000.0) + c))
                .collect();
            let changes = samples.windows(2).filter(|w| w[0] * w[1] < 0.0).count()
                + usize::from(c[0] * samples[0] < 0.0);
            let count = found(&c).len();
            assert!(
                count >= changes && (count - changes).is_multiple_of(2),
                "{count} roots, {changes} changes: {c:?}"
            );
            assert!(count - changes <= 2);
        }
    }
}

#[test]
fn double_roots_are_touches() {
    let mut random = Rng::with_seed(3);
    for _ in 0..500 {
        let r = 0.05 + 0.9 * random.f64();
        let (re, im) = (random.f64(), 0.2 + random.f64());
        let mut c = multiply(&from_roots(&[r, r]), &[re * re + im * im, -2.0 * re, 1.0]);
        c = multiply(&c, &[2.0 + random.f64(), 1.0]);
        let sign = if random.f64() < 0.5 { 1.0 } else { -1.0 };
        c.iter_mut().for_each(|c| *c *= sign);
        let list = found(&c);
        // Rounded coefficients may also have two roots, or none, within the enclosure; it is 1e-7 wide.
        for root in &list {
            assert!((root.s - r).abs() < 1e-6, "{root:?} for {r}");
        }
        match list[..] {
            [root] => {
                assert!(root.grazing);
                let from_above = root.direction == Direction::Falling;
                assert_eq!(from_above, sign > 0.0);
            }
            _ => panic!("{list:?} for a double root at {r}"),
        }
    }
}

#[test]
fn a_near_touch_is_resolved_down_to_rounding() {
    for gap in [1e-3, 1e-6, 1e-9, 1e-12, 1e-14] {
        // (s − 0.6)² ± gap
        let above = [0.36 + gap, -1.2, 1.0];
        assert!(found(&above).is_empty(), "{gap}");
        let below = found(&[0.36 - gap, -1.2, 1.0]);
        assert_eq!(below.len(), 2, "{gap}");
        let apart = below[1].s - below[0].s;
        assert!(
            (apart / (2.0 * gap.sqrt()) - 1.0).abs() < 1e-15 / gap + 1e-12,
            "{gap}: {apart}"
        );
    }
}

#[test]
fn odd_multiplicity_changes_sign() {
    for r in [0.3, 0.5, 0.71] {
        let list = found(&from_roots(&[r, r, r]));
        assert_eq!(list.len(), 1, "{list:?}");
        assert!(!list[0].grazing && list[0].direction == Direction::Rising);
        assert!((list[0].s - r).abs() < 2e-5);
    }
}

#[test]
fn quadruple_roots_end_in_one_touch_or_a_tight_cluster() {
    for r in [0.3, 0.5, 0.71] {
        let list = found(&from_roots(&[r, r, r, r]));
        assert!(!list.is_empty() && list.len() <= 4, "{list:?}");
        assert!(
            list.iter().all(|root| (root.s - r).abs() < 1e-3),
            "{list:?}"
        );
    }
}

#[test]
fn clusters_are_separated() {
    for apart in [1e-2, 1e-3, 1e-4] {
        let expected = [0.5 - apart, 0.5, 0.5 + apart];
        let list = found(&from_roots(&expected));
        assert_eq!(list.len(), 3, "{apart}");
        for (root, r) in list.iter().zip(expected) {
            assert!((root.s - r).abs() <= root.width, "{root:?} for {r}");
        }
    }
}

#[test]
fn equidistant_roots_as_wilkinson_had_them() {
    for n in [5, 8, 10, 12] {
        let expected: Vec<f64> = (1..=n).map(|k| (k as f64 - 0.5) / n as f64).collect();
        let list = found(&from_roots(&expected));
        assert_eq!(list.len(), n);
        for (root, r) in list.iter().zip(&expected) {
            assert!((root.s - r).abs() <= root.width, "{root:?} for {r}");
        }
    }
}

#[test]
fn roots_on_the_borders_of_subdivision_are_not_lost() {
    let expected = [0.25, 0.3125, 0.4375, 0.5, 0.5625, 0.75];
    check_close(&from_roots(&expected), &expected, 1e-10);
    let expected = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875];
    check_close(&from_roots(&expected), &expected, 1e-10);
}

#[test]
fn noise_has_no_roots() {
    let mut random = Rng::with_seed(4);
    for _ in 0..200 {
        // 1 − s + (s − 1) and its like: what remains of exact cancellation.
        let mut c: Vec<f64> = (0..20).map(|_| 1e-17 * (random.f64() - 0.5)).collect();
        c[0] = 1e-15;
        assert!(found(&c).is_empty());
    }
    assert!(found(&[f64::NAN, 1.0, -3.0]).is_empty());
}

/// A search for the roots of such a polynomial must end; whoever asked for it sees its values.
#[test]
fn what_is_not_finite_has_no_roots() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..5 {
            let mut c = [-0.25, 1.0, 0.5, -2.0, 1.0];
            c[place] = bad;
            assert!(places(&c).is_empty());
            assert_eq!(find_root(&c, ControlFlow::Break), None);
        }
    }
}

#[test]
fn the_largest_degree_is_served() {
    // Chebyshev polynomial of degree 12 in s² has degree 24; pad with a factor that has no roots.
    let mut c = from_roots(&[0.2, 0.8]);
    while c.len() <= MAX_DEGREE {
        c = multiply(&c, &[1.0, 0.1]);
    }
    check_close(&c, &[0.2, 0.8], 1e-14);
}

#[test]
fn sine_series_over_a_period() {
    // sin(7 s) has zeros at kπ/7; its series to order 40 is exact to rounding, with terms up to 163.
    let mut c = vec![0.0; 41];
    let mut term = 7.0;
    for k in (1..=39).step_by(2) {
        c[k] = term;
        term *= -49.0 / ((k + 1) * (k + 2)) as f64;
    }
    let expected: Vec<f64> = (1..=2)
        .map(|k| k as f64 * core::f64::consts::PI / 7.0)
        .collect();
    check_close(deflate(&c, 1), &expected, 1e-14);
}

#[test]
fn a_bound_keeps_the_sign_only_of_polynomials_without_roots() {
    let mut random = Rng::with_seed(7);
    let mut kept = 0;
    for _ in 0..20_000 {
        let mut decay = 1.0;
        let c: [f64; 14] = core::array::from_fn(|_| {
            decay *= 0.6;
            decay * (2.0 * random.f64() - 1.0)
        });
        let rest = c[2..].iter().map(|c| c.abs()).sum();
        if keeps_its_sign(&c, rest, 1e-10) {
            kept += 1;
            let mut found = RootList::new();
            roots(&c, &mut found);
            assert!(found.is_empty(), "{c:?}: {:?}", &found[..]);
            let end: f64 = c.iter().sum();
            assert_eq!(end > 0.0, c[0] > 0.0, "{c:?}");
        }
    }
    assert!(kept > 5_000, "{kept}");
    // A start that cannot be told from zero, and a touch.
    assert!(!keeps_its_sign(&[1e-12, 1.0, 0.0, 0.0], 0.0, 1e-10));
    assert!(!keeps_its_sign(&[0.25, -1.0, 1.0, 0.0], 1.0, 1e-10));
}

/// a − eˢ falls through zero at ln a, from wherever the search begins and however far it thinks that is.
#[test]
fn functions_vanish_between_samples() {
    for a in [1.02, 1.5, 2.0, 2.7] {
        let fall = |s: f64| Some(a - s.exp());
        for start in [0.0, 0.3, 0.7, 1.0] {
            for reach in [1e-3, 0.05, 0.4] {
                let first = (start, a - f64::exp(start));
                let [before, after] = bracket(first, reach, fall).expect("values");
                assert!(before.1 >= 0.0 && after.1 <= 0.0, "{a} {start} {reach}");
                let zero = zero_between([before, after], fall).expect("values");
                assert!(
                    (zero - f64::ln(a)).abs() < 1e-15,
                    "{a} {start} {reach}: {zero}"
                );
            }
        }
    }
    let rises = bracket((0.5, 1.0), 0.1, |s| Some(s + 0.5)).expect("values");
    assert!(rises[1].1 > 0.0);
    assert!(bracket((0.5, 1.0), 0.1, |_| None).is_none());
}
