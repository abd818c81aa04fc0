//! Random impacts against what holds for every solution, and known ones against textbooks.

use super::collision::{Collision, ContactRow, FrictionRow, NormalSource};
use super::law::Law;
use super::sequential::{Stuck, Turns};

/// Seeded random numbers.
struct Random(fastrand::Rng);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    fn below(&mut self, n: usize) -> usize {
        self.0.usize(..n)
    }
}

/// What a random collision is made of.
#[derive(Clone, Copy, Debug)]
struct Kind {
    coordinates: usize,
    links: usize,
    contacts: usize,
    /// Slip components of the friction on each contact, 0 for none.
    components: usize,
    /// Whether the constraints carry friction as well.
    rough_links: bool,
    held: bool,
    poisson: bool,
    /// Whether μs > μk.
    static_excess: bool,
}

/// G = A L⁻ᵀ L⁻¹ Aᵀ with random rows, so that any number of rows is possible.
fn collision(random: &mut Random, kind: Kind) -> Collision<f64> {
    let n = kind.coordinates;
    let mut c = Collision {
        links: kind.links,
        ..Collision::default()
    };
    let mut rows = kind.links;
    if kind.held {
        c.conditional.push((rows, random.below(kind.contacts)));
        rows += 1;
    }
    for k in 0..kind.contacts {
        c.touches.push(ContactRow {
            contact: k,
            row: rows,
            restitution: random.between(0.0, 1.0),
            poisson: kind.poisson && random.between(0.0, 1.0) < 0.7,
        });
        rows += 1;
    }
    let touches = (0..kind.contacts).map(NormalSource::ContactRow);
    let links = (0..kind.links).map(NormalSource::ConstraintRow);
    let bearers: Vec<NormalSource> = if kind.rough_links {
        touches.chain(links).collect()
    } else {
        touches.collect()
    };
    for (f, bearer) in bearers.into_iter().enumerate() {
        if kind.components == 0 {
            break;
        }
        let slide = random.between(0.0, 1.2);
        let excess = if kind.static_excess {
            random.between(1.0, 2.0)
        } else {
            1.0
        };
        c.rubs.push(FrictionRow {
            friction: f,
            row: rows,
            components: kind.components,
            bearer,
            while_touch: None,
            factor: 1.0,
            stick: slide * excess,
            slide,
        });
        rows += kind.components;
    }
    c.size = rows;
    let a: Vec<f64> = (0..rows * n).map(|_| random.between(-1.0, 1.0)).collect();
    // Masses of very different size.
    let inverse: Vec<f64> = (0..n)
        .map(|_| 10f64.powf(random.between(-1.0, 1.0)))
        .collect();
    let v: Vec<f64> = (0..n).map(|_| random.between(-1.0, 1.0)).collect();
    for i in 0..rows {
        for j in 0..rows {
            let terms = (0..n).map(|k| a[i * n + k] * inverse[k] * a[j * n + k]);
            c.response.push(terms.sum());
        }
    }
    // Velocities that keep the constraints: v − M⁻¹ Bᵀ (B M⁻¹ Bᵀ)⁻¹ B v.
    let rate = |i: usize, v: &[f64]| -> f64 { (0..n).map(|k| a[i * n + k] * v[k]).sum() };
    let mut v = v;
    for _ in 0..2000 {
        for i in 0..c.links {
            let share = rate(i, &v) / c.g(i, i);
            for k in 0..n {
                v[k] -= inverse[k] * a[i * n + k] * share;
            }
        }
    }
    c.rates = (0..rows).map(|i| rate(i, &v)).collect();
    c.rates[..c.links].fill(0.0);
    c.terms = vec![1.0; rows];
    c
}

fn kinds() -> Vec<Kind> {
    let plain = Kind {
        coordinates: 5,
        links: 0,
        contacts: 2,
        components: 0,
        rough_links: false,
        held: false,
        poisson: false,
        static_excess: false,
    };
    let mut all = Vec::new();
    for contacts in [1, 2, 3, 5] {
        for components in [0, 1, 2] {
            for poisson in [false, true] {
                for links in [0, 1] {
                    all.push(Kind {
                        coordinates: 4 + 2 * contacts,
                        links,
                        contacts,
                        components,
                        poisson,
                        static_excess: links == 1,
                        held: contacts == 2,
                        rough_links: links == 1 && contacts < 3 && components > 0,
                    });
                }
            }
        }
    }
    // More rows than coordinates: they depend on each other.
    all.push(Kind {
        coordinates: 3,
        contacts: 5,
        ..plain
    });
    all.push(Kind {
        coordinates: 4,
        contacts: 4,
        components: 1,
        ..plain
    });
    all.push(Kind {
        coordinates: 4,
        contacts: 4,
        components: 1,
        poisson: true,
        ..plain
    });
    all
}

/// What every solution satisfies.
fn judge(c: &Collision<f64>, law: &Law<f64>, kind: &Kind) {
    let tiny = 1e-11 * law.impulses.iter().fold(1.0, |m, x| f64::max(m, x.abs()));
    let after = |i: usize| -> f64 {
        c.rates[i]
            + (0..c.size)
                .map(|j| c.g(i, j) * law.impulses[j])
                .sum::<f64>()
    };
    let mut gain = 0.0;
    for i in 0..c.size {
        assert!((law.after[i] - after(i)).abs() < tiny, "{kind:?}");
        gain += 0.5 * law.impulses[i] * (c.rates[i] + law.after[i]);
    }
    assert!(gain < tiny, "{kind:?}: gains {gain}");
    for i in 0..c.links {
        assert!(law.after[i].abs() < tiny, "{kind:?}");
    }
    for touch in &c.touches {
        let (impulse, rate) = (law.impulses[touch.row], law.after[touch.row]);
        assert!(
            impulse > -tiny && rate > -tiny,
            "{kind:?}: {impulse} {rate}"
        );
        if !law.lowered && !kind.poisson {
            let bounce = touch.restitution * (-c.rates[touch.row]).max(0.0);
            assert!(
                rate - bounce > -tiny && (rate - bounce) * impulse < tiny,
                "{kind:?}"
            );
        }
    }
    for &(row, k) in &c.conditional {
        if law.impulses[c.touches[k].row] > tiny {
            assert!(law.after[row].abs() < tiny, "{kind:?}");
        }
    }
    for rub in &c.rubs {
        if kind.poisson && matches!(rub.bearer, NormalSource::ConstraintRow(_)) {
            // Its two phases may press either way.
            continue;
        }
        let normal = law.impulses[c.bearing_row(rub)].abs();
        let part = |x: &[f64]| x[rub.rows()].to_vec();
        let (impulse, slip) = (part(&law.impulses), part(&law.after));
        let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mu = if size(&slip) > tiny && !kind.poisson {
            rub.slide
        } else {
            rub.stick
        };
        assert!(
            size(&impulse) < mu * normal + tiny,
            "{kind:?}: outside the cone"
        );
        let against: f64 = impulse.iter().zip(&slip).map(|(x, s)| x * s).sum();
        if kind.poisson {
            continue;
        }
        assert!(against < tiny * (1.0 + normal), "{kind:?}");
        if size(&slip) > 1e3 * tiny {
            assert!(
                (against + rub.slide * normal * size(&slip)).abs() < tiny * (1.0 + normal),
                "{kind:?}"
            );
        }
    }
}

#[test]
fn random_impacts_obey_their_law() {
    let mut random = Random(fastrand::Rng::with_seed(7));
    let mut law = Law::<f64>::default();
    let (mut solved, mut lowered, mut unsolved) = (0, 0, 0);
    for kind in kinds() {
        let (mut here, mut failed) = (0, 0);
        for _ in 0..(if kind.held || kind.components == 2 {
            10
        } else {
            40
        }) {
            let c = collision(&mut random, kind);
            law.phase.within.clear();
            law.phase.within.resize(c.touches.len(), true);
            if !law.solve(&c, &c.rates) {
                failed += 1;
                continue;
            }
            here += 1;
            lowered += usize::from(law.lowered);
            judge(&c, &law, &kind);
        }
        println!("{kind:?}: {here} solved, {failed} not");
        solved += here;
        // A `while` row is a friction without limit: an impact may be impossible (Painlevé).
        unsolved += if kind.held { 0 } else { failed };
    }
    println!("{solved} solved, {unsolved} not, {lowered} lowered");
    assert_eq!(unsolved, 0);
    assert!(lowered > 10);
}

/// A box that comes down on its four lower corners, flat or about an edge that lies, sliding or not, fast or almost at rest.
fn falling_box(random: &mut Random) -> Collision<f64> {
    let [a, b, h] = [0, 1, 2].map(|_| random.between(0.005, 0.3));
    let mass = 10f64.powf(random.between(-2.0, 1.0));
    let inertia = [b * b + h * h, a * a + h * h, a * a + b * b].map(|x| mass * x / 3.0);
    let (down, along) = [0, 1]
        .map(|_| 10f64.powf(random.between(-10.0, 0.0)))
        .into();
    let mut v = [0.0; 6];
    v[2] = -down;
    let lies = random.below(2) == 1;
    if lies {
        // Two corners rest, and do not slip.
        v[3] = down / b;
        v[1] = -h * v[3];
    }
    let slides = random.below(2) == 1;
    if slides {
        v[0] += along * random.between(-1.0, 1.0);
        v[1] += along * random.between(-1.0, 1.0);
        v[5] = along / a * random.between(-1.0, 1.0);
    }
    // Velocities are known to rounding of the unit.
    for v in &mut v {
        *v += 1e-17 * random.between(-1.0, 1.0);
    }
    let corners = [[a, b], [-a, b], [a, -b], [-a, -b]];
    let mut rows: Vec<[f64; 6]> = Vec::new();
    rows.extend(corners.map(|[x, y]| [0.0, 0.0, 1.0, y, -x, 0.0]));
    for [x, y] in corners {
        rows.push([1.0, 0.0, 0.0, 0.0, -h, -y]);
        rows.push([0.0, 1.0, 0.0, h, 0.0, x]);
    }
    let (mu, restitution) = (random.between(0.1, 0.95), random.between(0.0, 0.9));
    let mut c = Collision {
        size: rows.len(),
        ..Collision::default()
    };
    for k in 0..4 {
        c.touches.push(ContactRow {
            contact: k,
            row: k,
            restitution,
            poisson: false,
        });
        c.rubs.push(FrictionRow {
            friction: k,
            row: 4 + 2 * k,
            components: 2,
            bearer: NormalSource::ContactRow(k),
            while_touch: None,
            factor: 1.0,
            stick: mu,
            slide: mu * random.between(0.8, 1.0),
        });
    }
    for row in &rows {
        for other in &rows {
            let linear: f64 = (0..3).map(|i| row[i] * other[i]).sum();
            let turns = (0..3).map(|i| row[3 + i] * other[3 + i] / inertia[i]);
            c.response.push(linear / mass + turns.sum::<f64>());
        }
        let terms = row.iter().zip(&v);
        c.rates.push(terms.clone().map(|(a, v)| a * v).sum());
        let sizes = terms.map(|(a, v)| a.abs() * (v.abs() + 1e-2));
        c.terms.push(sizes.sum());
    }
    let at_rest = match (lies, slides) {
        (false, _) => [0..0, 0..0],
        (true, true) => [0..2, 0..0],
        (true, false) => [0..2, 4..8],
    };
    for row in at_rest.into_iter().flatten() {
        c.drift = c.drift.max(c.rates[row].abs() / c.strength(row));
        c.rates[row] = 0.0;
    }
    c
}

#[test]
fn boxes_that_come_down_on_four_corners_obey_the_law() {
    let mut random = Random(fastrand::Rng::with_seed(11));
    let mut law = Law::<f64>::default();
    let kind = kinds()[0];
    let mut unsolved = Vec::new();
    for number in 0..3000 {
        let c = falling_box(&mut random);
        law.phase.within = vec![true; 4];
        match law.solve(&c, &c.rates) {
            true => judge(&c, &law, &kind),
            false => unsolved.push(number),
        }
    }
    assert!(
        unsolved.is_empty(),
        "{} of 3000: {unsolved:?}",
        unsolved.len()
    );
}

/// Balls on a line, each against the next.
fn row_of_balls(masses: &[f64], speeds: &[f64], e: f64) -> Collision<f64> {
    let contacts = masses.len() - 1;
    let mut c = Collision {
        size: contacts,
        terms: vec![1.0; contacts],
        ..Collision::default()
    };
    for k in 0..contacts {
        c.touches.push(ContactRow {
            contact: k,
            row: k,
            restitution: e,
            poisson: false,
        });
        c.rates.push(speeds[k + 1] - speeds[k]);
        for j in 0..contacts {
            c.response.push(match (k as isize - j as isize).abs() {
                0 => 1.0 / masses[k] + 1.0 / masses[k + 1],
                1 => -1.0 / masses[k.max(j)],
                _ => 0.0,
            });
        }
    }
    c
}

#[test]
fn a_row_of_sixty_four_balls_struck_together_keeps_its_law() {
    // The struck pair has impulse Λ; the others transmit what keeps them at rest relative to each other: with all rates
    // but the first aimed at 0 and the first at e v, the tail moves as one.
    for e in [0.0, 0.5, 1.0] {
        let masses = [1.0; 64];
        let mut speeds = [0.0; 64];
        speeds[0] = 1.0;
        let c = row_of_balls(&masses, &speeds, e);
        let mut law = Law::<f64>::default();
        law.phase.within = vec![true; 63];
        assert!(law.solve(&c, &c.rates));
        // m v = m u + 63 m w and w − u = e v.
        let w = (1.0 + e) / 64.0;
        for k in 0..63 {
            let impulse = w * (63 - k) as f64;
            assert!((law.impulses[k] - impulse).abs() < 1e-13, "{k}");
        }
        assert!(law.search.tried < 5);
    }
}

#[test]
fn in_turn_a_row_passes_the_blow_on() {
    let mut speeds = [0.0; 64];
    speeds[0] = 1.0;
    let c = row_of_balls(&[1.0; 64], &speeds, 1.0);
    let (mut law, mut turns) = (Law::<f64>::default(), Turns::<f64>::default());
    turns.solve(&c, &mut law).expect("an end");
    assert_eq!(turns.count, 63);
    assert!(turns.impulses.iter().all(|x| (x - 1.0).abs() < 1e-13));
}

/// A heavy ball pushes a light one against a wall: Galperin (2003) counts ⌈π/atan √(m/M)⌉ − 1 collisions.
#[test]
fn in_turn_collisions_count_the_digits_of_pi() {
    for (ratio, count) in [(1.0, 3), (1e2, 31), (1e4, 314), (1e6, 3141), (1e8, 31415)] {
        // Gaps: light − wall, heavy − light.
        let mut c = row_of_balls(&[1.0, 1.0, ratio], &[0.0, 0.0, -1.0], 1.0);
        c.response[0] = 1.0;
        let (mut law, mut turns) = (Law::<f64>::default(), Turns::<f64>::default());
        turns.solve(&c, &mut law).expect("an end");
        assert_eq!(turns.count, count);
    }
}

#[test]
fn a_ball_that_is_squeezed_comes_to_rest_or_is_an_error() {
    // Two heavy balls close in on a light one.
    for e in [0.0, 0.5, 0.99] {
        let c = row_of_balls(&[1e3, 1.0, 1e3], &[1.0, 0.0, -1.0], e);
        let (mut law, mut turns) = (Law::<f64>::default(), Turns::<f64>::default());
        turns.solve(&c, &mut law).expect("a limit");
        // By symmetry of the limit: momentum is shared by all that moves together, or they part.
        let mut rates = turns.rates.iter().zip(&turns.noise);
        let parting = rates.all(|(rate, noise)| *rate >= -noise && *noise < 1e-11);
        assert!(parting, "{e}: {:?}", turns.rates);
    }
    // Walls that close in cannot be stopped: light and heavy change places without end.
    let mut c = row_of_balls(&[1.0, 1.0, 1.0], &[1.0, 0.0, -1.0], 1.0);
    c.response = vec![1.0, -1.0, -1.0, 1.0];
    let (mut law, mut turns) = (Law::<f64>::default(), Turns::<f64>::default());
    assert!(matches!(turns.solve(&c, &mut law), Err(Stuck::Endless(_))));
}

/// Coulomb friction with one coefficient on a contact, whose slip is in this row.
fn rub(contact: usize, row: usize, mu: f64) -> FrictionRow<f64> {
    FrictionRow {
        friction: contact,
        row,
        components: 1,
        bearer: NormalSource::ContactRow(contact),
        while_touch: None,
        factor: 1.0,
        stick: mu,
        slide: mu,
    }
}

/// A rod of mass 1 whose foot rests on a rough floor (first contact) and whose other end strikes a rough wall, in the plane.
/// Rows: normals, then slips.
fn wedged_rod(random: &mut Random, poisson: bool) -> Collision<f64> {
    let (inertia, mu) = (random.between(0.05, 0.5), random.between(0.3, 2.0));
    let angle = random.between(0.2, 1.4);
    let (along, up) = (angle.cos(), angle.sin());
    // From the centre to the foot, and to the other end.
    let (foot, end) = ([-along, -up], [along, up]);
    let row = |[x, y]: [f64; 2], [dx, dy]: [f64; 2]| [dx, dy, x * dy - y * dx];
    let wall = random.between(-0.5, 0.5);
    let normal = [-f64::cos(wall), f64::sin(wall)];
    let rows = [
        row(foot, [0.0, 1.0]),
        row(end, normal),
        row(foot, [1.0, 0.0]),
        row(end, [normal[1], -normal[0]]),
    ];
    // It turns about its foot, towards the wall.
    let spin = -1.0;
    let v = [foot[1] * spin, -foot[0] * spin, spin];
    let mut c = Collision {
        size: 4,
        ..Collision::default()
    };
    for a in rows {
        let speed: f64 = a.iter().zip(v).map(|(a, v)| a * v).sum();
        c.rates.push(if speed.abs() < 1e-14 { 0.0 } else { speed });
        c.terms.push(1.0);
        for b in rows {
            c.response
                .push(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] / inertia);
        }
    }
    for k in 0..2 {
        c.touches.push(ContactRow {
            contact: k,
            row: k,
            restitution: if poisson { 0.5 } else { 0.0 },
            poisson,
        });
        c.rubs.push(rub(k, 2 + k, mu));
    }
    c
}

#[test]
fn of_several_impacts_the_one_with_the_least_jump_is_taken() {
    let mut random = Random(fastrand::Rng::with_seed(3));
    let mut several = 0;
    for _ in 0..2000 {
        let c = wedged_rod(&mut random, false);
        let mut law = Law::default();
        law.phase.within = vec![true; 2];
        assert!(law.solve(&c, &c.rates));
        let found = law.search.pattern.clone();
        let jump = |impulses: &[f64]| -> f64 {
            let product = |i: usize| (0..4).map(|j| c.g(i, j) * impulses[j]).sum::<f64>();
            (0..4).map(|i| impulses[i] * product(i)).sum()
        };
        assert_eq!(law.ambiguous, !law.search.others.is_empty());
        several += usize::from(law.ambiguous);
        for other in core::iter::once(&found).chain(&law.search.others) {
            assert!(jump(&found.impulses) <= jump(&other.impulses) * (1.0 + 1e-9));
            // Each satisfies the law, as it is written in the chapter.
            for k in 0..2 {
                let (normal, friction) = (other.impulses[k], other.impulses[2 + k]);
                let rate = |i: usize| {
                    c.rates[i] + (0..4).map(|j| c.g(i, j) * other.impulses[j]).sum::<f64>()
                };
                let (gap, slip, mu) = (rate(k), rate(2 + k), c.rubs[k].stick);
                assert!(normal > -1e-9 && gap > -1e-9 && (normal * gap).abs() < 1e-8);
                assert!(friction.abs() <= mu * normal + 1e-8);
                assert!(slip.abs() < 1e-9 || (friction + slip.signum() * mu * normal).abs() < 1e-8);
            }
        }
    }
    assert!(several > 20, "{several} of 2000");
}

#[test]
fn restitution_does_not_begin_from_rounding() {
    let mut random = Random(fastrand::Rng::with_seed(5));
    for number in 0..2000 {
        let c = wedged_rod(&mut random, true);
        let mut law = Law::default();
        law.phase.within = vec![true; 2];
        assert!(law.solve(&c, &c.rates), "{number}: {c:?}");
        let noise = 1e-9
            * c.rates
                .iter()
                .fold(1.0_f64, |size, rate| size.max(rate.abs()));
        assert!(
            law.after[..2].iter().all(|rate| *rate >= -noise),
            "{number}"
        );
    }
}

/// Levers in a row, of unit inertia: each presses on the next, which turns `ratio` times as fast, and slides on it. All move together; the last one is
/// slower by so much that its contact closes with `approach`.
fn row_of_levers(
    slides: &[f64],
    (ratio, approach): (f64, f64),
    (mu, e): (f64, f64),
) -> Collision<f64> {
    let contacts = slides.len();
    let place = |k: usize| ratio.powi(k as i32 - contacts as i32);
    let mut c = Collision {
        size: 2 * contacts,
        ..Collision::default()
    };
    let mut rows = vec![vec![0.0; contacts + 1]; 2 * contacts];
    for (k, slide) in slides.iter().enumerate() {
        (rows[k][k], rows[k][k + 1]) = (-1.0, 1.0 / ratio);
        rows[contacts + k][k] = -slide;
        c.touches.push(ContactRow {
            contact: k,
            row: k,
            restitution: e,
            poisson: false,
        });
        c.rubs.push(rub(k, contacts + k, mu));
    }
    for a in &rows {
        let sizes = a.iter().enumerate().map(|(k, a)| a.abs() * place(k));
        c.terms.push(sizes.sum());
        for b in &rows {
            c.response.push(a.iter().zip(b).map(|(a, b)| a * b).sum());
        }
    }
    c.rates.resize(contacts, 0.0);
    c.rates[contacts - 1] = -approach;
    let slips = slides.iter().enumerate();
    c.rates.extend(slips.map(|(k, slide)| -slide * place(k)));
    c
}

#[test]
fn weak_impacts_of_a_row_that_slides_fast_are_solved() {
    // All are pressed and slide on: lever k loses δ ratioᵏ, by Λₖ₋₁ / ratio − (1 + μ slideₖ) Λₖ, and the last one gains what its contact asks for.
    let mut random = Random(fastrand::Rng::with_seed(17));
    for number in 0..300 {
        let contacts = 5 + random.below(6);
        let (ratio, mu, e) = (
            random.between(1.5, 5.0),
            random.between(0.02, 0.6),
            random.between(0.0, 0.6),
        );
        let approach = 10f64.powf(random.between(-11.0, -3.0));
        let slides: Vec<f64> = (0..contacts)
            .map(|k| random.between(0.2, 2.0) * ratio.powi(k as i32 - contacts as i32))
            .collect();
        let mut per_loss = vec![0.0; contacts];
        let mut before = 0.0;
        for (k, slide) in slides.iter().enumerate() {
            before = (before / ratio + ratio.powi(k as i32)) / (1.0 + mu * slide);
            per_loss[k] = before;
        }
        let loss =
            ratio.powi(2) * (1.0 + e) * approach / (before + ratio.powi(contacts as i32 + 1));
        let c = row_of_levers(&slides, (ratio, approach), (mu, e));
        let mut law = Law::<f64>::default();
        law.phase.within = vec![true; contacts];
        assert!(
            law.solve(&c, &c.rates),
            "{number}: {contacts} {ratio} {approach:e}"
        );
        assert!(!law.lowered);
        for (k, per_loss) in per_loss.iter().enumerate() {
            let expected = loss * per_loss;
            let error = (law.impulses[k] - expected).abs();
            assert!(error <= 1e-9 * expected, "{number}, {k}: {error:e}");
        }
    }
}

#[test]
fn an_impact_without_solution_names_what_approaches() {
    // A ball that lies against a wall, and a wall that closes in on it.
    let walls = f64::INFINITY;
    let c = row_of_balls(&[walls, 1.0, walls], &[0.0, 0.0, -1.0], 0.5);
    let (mut law, mut turns) = (Law::<f64>::default(), Turns::<f64>::default());
    assert_eq!(turns.solve_groups(&c, &mut law), Err(Stuck::Unsolved(1)));
}
