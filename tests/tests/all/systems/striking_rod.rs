//! A rod that strikes a rough floor: an impact with friction off the centre, by Newton's law and by Poisson's.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, closure, event, run};

macro_rules! rod {
    ($name:ident, $restitution:expr) => {
        /// Half length h, turned by θ from the vertical; the lower end strikes.
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange(
                emit = data,
                            coordinates(x, y, theta),
                            kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
                            contact(floor: y - half * cos(theta) >= 0, restitution = $restitution),
                            friction(grip on floor: slip = der(x + half * sin(theta)), static = mu),
                        )]
        struct $name {
            mass: f64,
            inertia: f64,
            half: f64,
            mu: f64,
            e: f64,
        }
    };
}

rod!(NewtonRod, e);
rod!(PoissonRod, poisson(e));

/// What impulses at the end do to its velocity: nn, nt, tt of G; from the moment of each impulse about the centre.
fn response(mass: f64, inertia: f64, half: f64, theta: f64) -> [f64; 3] {
    let (s, c) = theta.sin_cos();
    let (rx, ry) = (half * s, -half * c);
    [
        1.0 / mass + rx * rx / inertia,
        -rx * ry / inertia,
        1.0 / mass + ry * ry / inertia,
    ]
}

/// Velocity of the lower end, (normal, tangential).
fn end_velocity(half: f64, state: &State<f64>) -> [f64; 2] {
    let (s, c) = state.q[2].sin_cos();
    [
        state.v[1] + half * s * state.v[2],
        state.v[0] + half * c * state.v[2],
    ]
}

/// Routh's construction (Routh 1905, section 187; Stronge 2000, chapter 4): the impulse grows along the line of sliding until
/// the slip stops, then along that of sticking or of sliding back; compression ends where the end no longer approaches, and
/// restitution adds the share e of the normal impulse. Returns (Λn, Λt) and whether the slip reversed.
fn routh([nn, nt, tt]: [f64; 3], [vn, vt]: [f64; 2], mu: f64, e: f64) -> ([f64; 2], bool) {
    let sign = vt.signum();
    // Λt per Λn: sliding, then (if the slip stops) sticking or sliding back.
    let first = -mu * sign;
    let slowing = nt + first * tt;
    let stop = if slowing * sign < 0.0 {
        -vt / slowing
    } else {
        f64::INFINITY
    };
    let sticks = (nt / tt).abs() <= mu;
    let second = if sticks { -nt / tt } else { mu * sign };
    let tangential = |p: f64| first * p.min(stop) + second * (p - stop).max(0.0);
    let normal = |p: f64| vn + nn * p + nt * tangential(p);
    // Where compression ends: on one of two straight lines.
    let slope = nn + nt * first;
    let end = if slope > 0.0 && -vn / slope <= stop {
        -vn / slope
    } else {
        stop - normal(stop) / (nn + nt * second)
    };
    let total = (1.0 + e) * end;
    ([total, tangential(total)], !sticks && total > stop)
}

/// Energy of the end's motion that the impulses leave: ½ Λ·(v⁻ + v⁺).
fn gain([nn, nt, tt]: [f64; 3], v: [f64; 2], p: [f64; 2]) -> f64 {
    let after = [v[0] + nn * p[0] + nt * p[1], v[1] + nt * p[0] + tt * p[1]];
    0.5 * (p[0] * (v[0] + after[0]) + p[1] * (v[1] + after[1]))
}

#[test]
fn poisson_restitution_is_that_of_rouths_construction_where_the_slip_does_not_reverse() {
    let mut random = Random::new(5);
    let (mut compared, mut stuck) = (0, 0);
    for _ in 0..200 {
        let rod = PoissonRod {
            mass: random.between(0.5, 2.0),
            inertia: random.between(0.05, 0.5),
            half: random.between(0.3, 1.0),
            mu: random.between(0.05, 1.5),
            e: random.between(0.0, 1.0),
        };
        let theta = random.between(-1.4, 1.4);
        let start = state(
            &[0.0, rod.half * theta.cos() + 0.01, theta],
            &[
                random.between(-2.0, 2.0),
                random.between(-2.0, -1.0),
                random.between(-0.5, 0.5),
            ],
        );
        let trajectory = run(&rod, start, 0.05);
        let hit = event(&trajectory, "floor", "impact");
        let g = response(rod.mass, rod.inertia, rod.half, hit.state.q[2]);
        let v = end_velocity(rod.half, &hit.state);
        let (expected, reverses) = routh(g, v, rod.mu, rod.e);
        let impulses = [hit.impulses[0], hit.impulses[1]];
        let added = gain(g, v, impulses);
        assert!(added < 1e-12, "{added}");
        if reverses || hit.restitution_lowered {
            continue;
        }
        agree("normal impulse", impulses[0] / expected[0], 1.0, 1e-11);
        agree("tangential impulse", impulses[1], expected[1], 1e-11);
        compared += 1;
        stuck += usize::from(impulses[1].abs() < rod.mu * impulses[0] * (1.0 - 1e-9));
        assert!(closure(&trajectory) < 1e-11);
    }
    assert!(compared > 120 && stuck > 30, "{compared} {stuck}");
}

/// Newton's law: (Λn, Λt) with normal speed −e vn after, sticking if the cone lets it, else sliding on or back.
fn newton([nn, nt, tt]: [f64; 3], [vn, vt]: [f64; 2], mu: f64, e: f64) -> Option<[f64; 2]> {
    let (dn, dt) = (-(1.0 + e) * vn, -vt);
    let det = nn * tt - nt * nt;
    let stick = [(tt * dn - nt * dt) / det, (nn * dt - nt * dn) / det];
    if stick[0] >= 0.0 && stick[1].abs() <= mu * stick[0] {
        return Some(stick);
    }
    [1.0, -1.0].into_iter().find_map(|sign| {
        let p = dn / (nn - mu * sign * nt);
        let slip = vt + (nt - mu * sign * tt) * p;
        (p >= 0.0 && sign * slip >= 0.0).then_some([p, -mu * sign * p])
    })
}

#[test]
fn newton_restitution_is_lowered_to_the_largest_that_adds_no_energy() {
    let mut random = Random::new(6);
    let (mut kept, mut lowered) = (0, 0);
    for _ in 0..400 {
        let rod = NewtonRod {
            mass: 1.0,
            inertia: random.between(0.02, 0.3),
            half: 1.0,
            mu: random.between(0.1, 1.0),
            e: random.between(0.3, 1.0),
        };
        let theta = random.between(-1.2, 1.2);
        let start = state(
            &[0.0, theta.cos() + 0.01, theta],
            &[random.between(-3.0, 3.0), -1.0, 0.0],
        );
        let trajectory = run(&rod, start, 0.02);
        let hit = event(&trajectory, "floor", "impact");
        let g = response(rod.mass, rod.inertia, rod.half, hit.state.q[2]);
        let v = end_velocity(rod.half, &hit.state);
        let impulses = [hit.impulses[0], hit.impulses[1]];
        let law = |e: f64| newton(g, v, rod.mu, e).map(|p| (p, gain(g, v, p)));
        let Some((full, added)) = law(rod.e) else {
            continue;
        };
        if added <= 1e-12 {
            assert!(!hit.restitution_lowered);
            agree("normal impulse", impulses[0] / full[0], 1.0, 1e-11);
            agree("tangential impulse", impulses[1], full[1], 1e-11);
            kept += 1;
            continue;
        }
        // A double pendulum that strikes a floor gains as well: Kane & Levinson (1985).
        assert!(hit.restitution_lowered);
        lowered += 1;
        let left = gain(g, v, impulses);
        assert!(left < 1e-12);
        let after = v[0] + g[0] * impulses[0] + g[1] * impulses[1];
        let share = -after / v[0] / rod.e;
        assert!((0.0..1.0).contains(&share), "{share}");
        // A little more of it would add energy, or the law has no solution there.
        let more = law(rod.e * (share + 1e-6));
        assert!(more.is_none_or(|(_, added)| added > -1e-9), "{more:?}");
    }
    assert!(kept > 200 && lowered > 10, "{kept} {lowered}");
}

#[test]
fn without_friction_both_laws_agree() {
    let mut random = Random::new(8);
    for _ in 0..50 {
        let theta = random.between(-1.2, 1.2);
        let e = random.between(0.0, 1.0);
        let start = state(&[0.0, theta.cos() + 0.01, theta], &[0.3, -1.0, 0.2]);
        let [newton, poisson] = [
            {
                let rod = NewtonRod {
                    mass: 1.0,
                    inertia: 0.1,
                    half: 1.0,
                    mu: 0.0,
                    e,
                };
                run(&rod, start.clone(), 0.02).final_state().clone()
            },
            {
                let rod = PoissonRod {
                    mass: 1.0,
                    inertia: 0.1,
                    half: 1.0,
                    mu: 0.0,
                    e,
                };
                run(&rod, start, 0.02).final_state().clone()
            },
        ];
        for (a, b) in newton.v.iter().zip(&poisson.v) {
            agree("v", *a, *b, 1e-12);
        }
    }
}
