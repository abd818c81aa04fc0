//! A parallelogram linkage that turns through the positions in which its bars are aligned, and is looked at there.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{
    Random, SINGLE_METHODS, TOLERANCES, agree, certified, methods_at, run_by, words,
};

/// Two cranks of length 1, joined by a coupler as long as their distance.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, phi, b),
    kinetic = der(a)^2/2 + der(b)^2/2 + inertia/2 * der(phi)^2 + der(cos(a))^2/2 + der(sin(a))^2/2,
    potential = gravity * sin(a),
    constraint(sideways: cos(a) + span * cos(phi) == span + cos(b)),
    constraint(upward: sin(a) + span * sin(phi) == sin(b)),
    mark(aligned: sin(a)),
    stop(turned: a >= end),
)]
struct Parallelogram {
    inertia: f64,
    gravity: f64,
    span: f64,
    end: f64,
}

/// It stays a parallelogram, φ = 0 and a = b, so that 3/2 ȧ² + g sin a stays what it is, also where the run ends with all bars
/// aligned: there the constraints lose rank, and the crossed linkage is one branch away.
#[test]
fn all_methods_pass_aligned_bars_and_stop_there() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let mut random = Random::new(5);
        for k in 0..12 {
            let end = if k % 2 == 0 { 2.0 * PI } else { 9.0 };
            let scene = Parallelogram {
                inertia: random.between(0.1, 2.0),
                gravity: random.between(0.0, 5.0),
                span: random.between(1.2, 3.0),
                end,
            };
            let (a, rate) = (random.between(0.3, 1.5), random.between(4.0, 8.0));
            let energy = |a: f64, rate: f64| 1.5 * rate * rate + scene.gravity * a.sin();
            let start = state(&[a, 0.0, a], &[rate, 0.0, rate]);
            let motion = run_by(&scene, (method, tolerance), start, 20.0);
            let asked = format!("{method} {tolerance:e}, start {k}");
            let [a1, phi, b] = motion.final_state().q[..] else {
                panic!("three coordinates");
            };
            let bound = 1e3 * tolerance;
            agree(&asked, a1, end, bound);
            agree(&asked, phi, 0.0, bound);
            agree(&asked, b, a1, bound);
            let now = energy(a1, motion.final_state().v[0]);
            agree(&asked, now / energy(a, rate), 1.0, bound);
            let marks = motion.events().iter().filter(|e| e.kind.word() == "mark");
            let passed: Vec<f64> = marks.map(|e| e.state.q[0]).collect();
            assert!(
                passed.len() <= 2 && !passed.is_empty(),
                "{asked}: {:?}",
                words(&motion)
            );
            for (place, angle) in passed.iter().zip([PI, 2.0 * PI]) {
                agree(&asked, *place, angle, bound);
            }
        }
    }
}

/// The same without weight, with a stop near the aligned position.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, phi, b),
    kinetic = der(a)^2/2 + der(b)^2/2 + inertia/2 * der(phi)^2 + der(cos(a))^2/2 + der(sin(a))^2/2,
    constraint(sideways: cos(a) + span * cos(phi) == span + cos(b)),
    constraint(upward: sin(a) + span * sin(phi) == sin(b)),
    stop(near: cos(a) <= -1 + short),
)]
struct Near {
    inertia: f64,
    span: f64,
    short: f64,
}

/// Where constraints are about to lose rank steps leap over the position; what is a function of the motion is no polynomial of so low a degree.
#[test]
fn stops_near_aligned_bars_are_where_they_should_be() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let mut random = Random::new(6);
        for k in 0..10 {
            let near = Near {
                inertia: random.between(0.1, 2.0),
                span: random.between(1.2, 3.0),
                short: 10.0_f64.powf(random.between(-9.0, -3.0)),
            };
            let (a, rate) = (random.between(0.3, 2.0), random.between(1.0, 5.0));
            let start = state(&[a, 0.0, a], &[rate, 0.0, rate]);
            let run = run_by(&near, (method, tolerance), start, 10.0);
            let right = ((near.short - 1.0).acos() - a) / rate;
            // The stop is reached at a flat angle.
            let bound = 1e3 * tolerance / (2.0 * near.short).sqrt().min(1.0);
            agree(
                format!("{method} {tolerance:e}, {k}"),
                run.last_time(),
                right,
                bound,
            );
        }
    }
}

/// A crank and a rocker of lengths `crank` and `rocker`, pivoted `ground` apart, with a coupler: at some position all bars can be aligned.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, phi, b),
    kinetic = inertia/2 * der(a)^2 + 0.7/2 * der(phi)^2 + der(b)^2/2,
    constraint(sideways: crank * cos(a) + coupler * cos(phi) == ground * cos(turn) + rocker * cos(b)),
    constraint(upward: crank * sin(a) + coupler * sin(phi) == ground * sin(turn) + rocker * sin(b)),
    contact(bumper: a <= wall, restitution = 0.8),
    mark(straight: a - aligned),
    stop(turned: a >= end),
)]
struct FourBar {
    inertia: f64,
    crank: f64,
    coupler: f64,
    rocker: f64,
    ground: f64,
    turn: f64,
    aligned: f64,
    wall: f64,
    end: f64,
}

impl FourBar {
    /// Random bars that can be aligned, and angles at which they are.
    fn draw(random: &mut Random) -> (Self, [f64; 3]) {
        loop {
            let [crank, coupler, rocker] = [(); 3].map(|()| random.between(0.5, 2.0));
            let folded = [(); 3].map(|()| random.below(2) as f64);
            let along = |k: usize| 1.0 - 2.0 * folded[k];
            let ground = along(0) * crank + along(1) * coupler - along(2) * rocker;
            if !(0.4..3.0).contains(&ground) {
                continue;
            }
            let turn = random.between(-1.0, 1.0);
            let angles = folded.map(|f| turn + PI * f);
            let bars = Self {
                inertia: random.between(0.2, 2.0),
                crank,
                coupler,
                rocker,
                ground,
                turn,
                aligned: angles[0],
                wall: 100.0,
                end: 100.0,
            };
            return (bars, angles);
        }
    }

    /// The other angles at that of the crank, where the coupler and the rocker meet on one side of the line from the crank's end to the pivot, or
    /// the other: the intersections of two circles.
    fn others(&self, a: f64, side: f64) -> Option<[f64; 2]> {
        let x = self.crank * a.cos() - self.ground * self.turn.cos();
        let y = self.crank * a.sin() - self.ground * self.turn.sin();
        let square = x * x + y * y;
        let cosine = (square + self.rocker.powi(2) - self.coupler.powi(2))
            / (2.0 * self.rocker * square.sqrt());
        (cosine.abs() <= 1.0).then_some(())?;
        let b = y.atan2(x) + side * cosine.acos();
        let phi = (self.rocker * b.sin() - y).atan2(self.rocker * b.cos() - x);
        Some([phi, b])
    }

    /// The rates of the other angles there while the crank turns with 1: what the derivatives of both constraints say.
    fn rates(&self, a: f64, [phi, b]: [f64; 2]) -> [f64; 2] {
        let turned = (phi - b).sin();
        [
            self.crank * (b - a).sin() / (self.coupler * turned),
            self.crank * (phi - a).sin() / (self.rocker * turned),
        ]
    }

    /// The same where all bars are aligned, on the branch that is nearest to these: second derivatives say Σ ± length · rate² = 0, first ones Σ ± length · rate = 0.
    fn rates_aligned(&self, angles: [f64; 3], near: [f64; 2]) -> Option<[f64; 2]> {
        let along = angles.map(|angle| (angle - self.turn).cos().round());
        let [r, c, s] = [
            along[0] * self.crank,
            along[1] * self.coupler,
            along[2] * self.rocker,
        ];
        // r + c φ' = s b' and r + c φ'² = s b'².
        let (square, linear, constant) = (c - c * c / s, -2.0 * r * c / s, r - r * r / s);
        let root = linear * linear - 4.0 * square * constant;
        (root > 0.05).then_some(())?;
        let branches = [-1.0, 1.0].map(|sign| {
            let phi = (-linear + sign * root.sqrt()) / (2.0 * square);
            [phi, (r + c * phi) / s]
        });
        let off = |branch: &[f64; 2]| (branch[0] - near[0]).abs() + (branch[1] - near[1]).abs();
        branches
            .into_iter()
            .min_by(|x, y| off(x).total_cmp(&off(y)))
    }

    /// Twice the kinetic energy while the crank turns with 1.
    fn inertia_of_crank(&self, [phi, b]: [f64; 2]) -> f64 {
        self.inertia + 0.7 * phi * phi + b * b
    }

    /// How long the crank takes from one angle to another, by the midpoint rule: to some per cent.
    fn duration(&self, passage: &Passage, [from, to]: [f64; 2], twice: f64) -> f64 {
        const PARTS: usize = 100;
        let width = (to - from) / PARTS as f64;
        let time = |k: usize| {
            let a = from + width * (k as f64 + 0.5);
            let side = if a < self.aligned {
                1.0
            } else {
                passage.beyond
            };
            let angles = self.others(a, side).expect("in reach");
            (self.inertia_of_crank(self.rates(a, angles)) / twice).sqrt() * width
        };
        (0..PARTS).map(time).sum()
    }

    /// A start `before` the aligned position, the way of the crank to it, and the side and state `after` it on the same branch; nothing if that is out of
    /// reach, or beside another such position.
    fn passage(&self, angles: [f64; 3], before: f64, after: f64) -> Option<Passage> {
        const BESIDE: f64 = 1e-4;
        let clear = |a: f64, side: f64| {
            let [phi, b] = self.others(a, side)?;
            (((phi - b).sin().abs() > 0.05)
                && self
                    .rates(a, [phi, b])
                    .map(f64::abs)
                    .iter()
                    .all(|rate| *rate < 10.0))
            .then_some([phi, b])
        };
        let side = 1.0;
        let start = clear(angles[0] - before, side)?;
        let near = self.rates(angles[0] - BESIDE, self.others(angles[0] - BESIDE, side)?);
        let aligned = self.rates_aligned(angles, near)?;
        let goes_on = |side: f64| {
            let there = self.others(angles[0] + BESIDE, side)?;
            let rates = self.rates(angles[0] + BESIDE, there);
            let off = (rates[0] - aligned[0]).abs() + (rates[1] - aligned[1]).abs();
            (off < 0.1).then_some(side)
        };
        let beyond = [1.0, -1.0].into_iter().find_map(goes_on)?;
        let end = clear(angles[0] + after, beyond)?;
        let all_clear = (1..10).all(|k| {
            let part = k as f64 / 10.0;
            self.others(angles[0] - part * before, side).is_some()
                && self.others(angles[0] + part * after, beyond).is_some()
        });
        all_clear.then_some(Passage {
            start,
            aligned,
            beyond,
            end,
        })
    }
}

/// The other angles at the start, their rates where all bars are aligned, and the other angles at the end, beyond that.
struct Passage {
    start: [f64; 2],
    aligned: [f64; 2],
    /// The side on which the coupler and the rocker meet there.
    beyond: f64,
    end: [f64; 2],
}

/// Bars that come to be aligned at these angles, `way` before and behind which a run begins and ends, the crank with `rate` at first.
struct Linkage {
    bars: FourBar,
    angles: [f64; 3],
    passage: Passage,
    rate: f64,
    way: [f64; 2],
}

/// Linkages of random bars, with their passage, from 0.3–0.7 before the aligned position to 0.2–0.4 behind it, and the rate of the crank at the start.
fn linkages(seed: u64, count: usize) -> Vec<Linkage> {
    let mut random = Random::new(seed);
    let mut found = Vec::new();
    while found.len() < count {
        let (bars, angles) = FourBar::draw(&mut random);
        let [before, after] = [random.between(0.3, 0.7), random.between(0.2, 0.4)];
        let rate = random.between(0.5, 3.0);
        if let Some(passage) = bars.passage(angles, before, after) {
            found.push(Linkage {
                bars,
                angles,
                passage,
                rate,
                way: [before, after],
            });
        }
    }
    found
}

impl Linkage {
    /// The start, and twice its energy.
    fn start(&self) -> (State<f64>, f64) {
        let a = self.angles[0] - self.way[0];
        let rates = self.bars.rates(a, self.passage.start);
        let [phi, b] = self.passage.start;
        let v = [1.0, rates[0], rates[1]].map(|rate| rate * self.rate);
        let twice = self.bars.inertia_of_crank(rates) * self.rate * self.rate;
        (state(&[a, phi, b], &v), twice)
    }
}

/// No weight acts: what the crank's rate is follows from the energy, wherever the linkage is.
#[test]
fn all_methods_stop_where_bars_are_aligned_and_pass_them() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, [1e-6, 1e-9]) {
        for (k, linkage) in linkages(11, 10).iter().enumerate() {
            let Linkage {
                bars,
                angles,
                passage,
                way: [_, after],
                ..
            } = linkage;
            let asked = format!("{method} {tolerance:e}, {k}");
            let (start, twice) = linkage.start();
            let stops = FourBar {
                end: angles[0],
                ..bars.clone()
            };
            let run = run_by(&stops, (method, tolerance), start.clone(), 20.0);
            // The mark is at the instant of the stop.
            let logged = words(&run);
            assert!(
                logged.len() == 2 && logged[0].contains("mark"),
                "{asked}: {logged:?}"
            );
            let bound = 1e3 * tolerance;
            let aligned = bars.inertia_of_crank(passage.aligned);
            agree(&asked, run.final_state().q[0], angles[0], bound);
            let swift = (twice / aligned).sqrt();
            let rates = [1.0, passage.aligned[0], passage.aligned[1]];
            for (v, rate) in run.final_state().v.iter().zip(rates) {
                agree(&asked, *v, swift * rate, bound * swift.max(1.0));
            }
            certified(&asked, &run);

            let end = angles[0] + after;
            let passes = FourBar {
                end,
                ..bars.clone()
            };
            let run = run_by(&passes, (method, tolerance), start, 20.0);
            for (q, angle) in run.final_state().q[1..].iter().zip(passage.end) {
                agree(&asked, (q - angle).sin(), 0.0, bound);
                agree(&asked, (q - angle).cos(), 1.0, bound);
            }
            let swift = twice / bars.inertia_of_crank(bars.rates(end, passage.end));
            agree(
                &asked,
                run.final_state().v[0],
                swift.sqrt(),
                bound * swift.max(1.0),
            );
            assert_eq!(words(&run).len(), 2, "{asked}: {:?}", words(&run));
            certified(&asked, &run);
        }
    }
}

/// The wall throws the crank back: 0.64 of the energy are left, on the same branch. Where rounding would decide on which, the run is refused with that cause.
#[test]
fn impacts_near_aligned_bars_are_right_or_refused() {
    let mut refused = 0;
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let mut random = Random::new(12);
        for (k, linkage) in linkages(13, 12).iter().enumerate() {
            let Linkage {
                bars,
                angles,
                passage,
                way: [before, after],
                ..
            } = linkage;
            let beside = 10.0_f64.powf(random.between(-10.0, -1.0)).min(0.9 * after);
            let beside = if k % 3 == 0 { -beside } else { beside };
            let wall = angles[0] + beside;
            let (start, twice) = linkage.start();
            let bars = FourBar {
                wall,
                ..bars.clone()
            };
            let asked = format!("{method} {tolerance:e}, {k}, {beside:e}");
            let simulation = Simulation::new(&bars).method(method).tolerance(tolerance);
            let until = 1.3 * bars.duration(passage, [angles[0] - before, wall], twice);
            match simulation.run(start, 0.0..until) {
                Ok(run) => {
                    let [a, phi, b] = run.final_state().q[..] else {
                        panic!("three coordinates");
                    };
                    let v = &run.final_state().v;
                    let energy = bars.inertia * v[0] * v[0] + 0.7 * v[1] * v[1] + v[2] * v[2];
                    let impacts = words(&run)
                        .iter()
                        .filter(|word| word.contains("impact"))
                        .count();
                    assert_eq!(impacts, 1, "{asked}: {:?}", words(&run));
                    agree(&asked, energy / twice, 0.64, 1e4 * tolerance);
                    let sides = [1.0, -1.0].map(|side| bars.others(a, side).expect("in reach"));
                    let off = sides.map(|[x, y]| (x - phi).sin().abs() + (y - b).sin().abs());
                    assert!(off[0].min(off[1]) < 1e3 * tolerance, "{asked}: {off:?}");
                }
                Err(failure) => {
                    assert!(beside.abs() < 0.03, "{asked}: {failure}");
                    assert!(
                        matches!(failure.error, Error::Singular { .. }),
                        "{asked}: {failure}"
                    );
                    refused += 1;
                }
            }
        }
    }
    assert!(refused > 0);
}
