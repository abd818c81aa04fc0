//! The smooth scenes against numbers of 32 digits, closed forms, and what is conserved.
//!
//! Double pendulum, chain and spring pendulum: Taylor series in 170-bit arithmetic at tolerance 1e-44 (heyoka 7.13, by
//! hand-reduced equations). Tolerances of the comparisons are what double precision leaves of these motions.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;

/// The trajectory from a start, at the tightest tolerance.
fn run<S: System<Scalar = f64>>(
    system: &S,
    start: State<f64>,
    until: f64,
) -> Trajectory<S::Scalar> {
    let simulation = Simulation::new(system).tolerance(1e-15);
    simulation
        .run(start, 0.0..until)
        .unwrap_or_else(|stopped| panic!("{stopped}"))
}

fn close(found: &[f64], wanted: &[f64], tolerance: f64) {
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        let error = (found - wanted).abs() / wanted.abs().max(1.0);
        assert!(error < tolerance, "{found} is not {wanted}: {error:e}");
    }
}

fn energy_is_conserved(trajectory: &Trajectory, tolerance: f64) {
    let ledger = trajectory.ledger().expect("a ledger");
    let drift = (ledger.end.jacobi - ledger.start.jacobi).abs() / ledger.scale;
    assert!(drift < tolerance, "energy drifts by {drift:e}");
}

/// Values of `conserved` at both ends.
fn conserved(trajectory: &Trajectory, conserved: impl Fn(&[f64], &[f64]) -> f64) -> [f64; 2] {
    [trajectory.first_state(), trajectory.final_state()].map(|state| conserved(&state.q, &state.v))
}

#[test]
fn double_pendulum() {
    let system = DoublePendulum::default();
    let trajectory = run(&system, system.at(DoublePendulum::REST), 5.0);
    let end = trajectory.final_state();
    close(
        &end.q,
        &[8.191_078_459_414_502, 0.015_016_920_586_249_179],
        1e-11,
    );
    close(
        &end.v,
        &[2.561_275_215_857_095_6, 5.931_712_937_022_135],
        1e-11,
    );
    energy_is_conserved(&trajectory, 1e-13);
}

#[test]
fn five_link_chain() {
    let system = FiveLinkChain::default();
    let trajectory = run(&system, system.at(FiveLinkChain::BENT), 2.0);
    let end = trajectory.final_state();
    let angles = [
        -0.672_831_847_265_994_2,
        -0.795_065_230_969_026_4,
        -0.862_931_895_206_255_7,
        -0.886_710_318_274_563_2,
        -0.862_200_817_226_639_8,
    ];
    let rates = [
        0.225_462_828_834_139_8,
        0.358_631_382_962_610_7,
        -0.116_524_457_594_865_7,
        -0.593_133_603_524_708_9,
        -0.929_087_772_628_452_8,
    ];
    close(&end.q, &angles, 1e-13);
    close(&end.v, &rates, 1e-13);
    energy_is_conserved(&trajectory, 1e-13);
}

#[test]
fn a_chain_without_gravity_keeps_its_angular_momentum() {
    let system = FiveLinkChain {
        gravity: 0.0,
        ..FiveLinkChain::default()
    };
    let mut start = system.at(FiveLinkChain::BENT);
    start.v = vec![1.0, -2.0, 3.0, 0.5, -1.0];
    let trajectory = run(&system, start, 3.0);
    let [before, after] = conserved(&trajectory, |q, v| {
        let (mut x, mut y, mut u, mut w, mut sum) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (angle, rate) in q.iter().zip(v) {
            (x, y) = (x + angle.sin(), y - angle.cos());
            (u, w) = (u + rate * angle.cos(), w + rate * angle.sin());
            sum += x * w - y * u;
        }
        sum
    });
    assert!(
        (after - before).abs() < 1e-12 * before.abs(),
        "{before} became {after}"
    );
    energy_is_conserved(&trajectory, 1e-12);
}

#[test]
fn cartesian_pendulum() {
    let system = CartesianPendulum::default();
    let trajectory = run(&system, system.at(CartesianPendulum::LEVEL), 100.0);
    let end = trajectory.final_state();
    // Jacobi's elliptic functions in 45 digits.
    close(
        &end.q,
        &[0.181_513_351_427_031_38, -0.983_388_480_334_057_5],
        1e-10,
    );
    close(
        &end.v,
        &[-4.319_536_780_534_633, -0.797_297_927_855_360_4],
        1e-10,
    );
    // On its circle to rounding, after a hundred seconds.
    let off = end.q[0].hypot(end.q[1]) - 1.0;
    assert!(off.abs() < 4e-15, "{off:e}");
    energy_is_conserved(&trajectory, 1e-12);
}

#[test]
fn pendulums_swing_and_go_round_as_elliptic_functions_do() {
    for speed in [0.1, 3.0, 6.0, 6.3, 9.0] {
        let system = CartesianPendulum {
            start_speed: speed,
            length: 0.7,
            ..CartesianPendulum::default()
        };
        let start = State::new(vec![0.0, -0.7], vec![speed, 0.0]);
        let known = system.closed_form(&start, 10.0).expect("a closed form");
        let end = run(&system, start, 10.0).final_state().clone();
        close(&end.q, &known.state.q, 1e-11);
        close(&end.v, &known.state.v, 1e-11);
    }
    // Into the upper rest: no digits left.
    let system = CartesianPendulum::default();
    let start = State::new(vec![0.0, -1.0], vec![(4.0 * system.gravity).sqrt(), 0.0]);
    assert_eq!(system.closed_form(&start, 1.0), None);
}

#[test]
fn kepler() {
    let system = Kepler::default();
    let start = system.at(Kepler::PERICENTRE);
    let period = 2.0 * core::f64::consts::PI;
    let trajectory = run(&system, start.clone(), 100.0 * period);
    let end = trajectory.final_state();
    // After whole periods it is where it was; ten digits are what a hundred such orbits leave.
    close(&end.q, &[0.1, 0.0], 1e-9);
    close(&end.v, &[0.0, 19.0_f64.sqrt()], 1e-8);
    energy_is_conserved(&trajectory, 1e-13);
    let [before, after] = conserved(&trajectory, |q, v| q[0] * v[1] - q[1] * v[0]);
    assert!((after - before).abs() < 1e-13, "{before} became {after}");

    for until in [0.3, 3.0, 20.0] {
        let known = system.closed_form(&start, until).expect("a closed form");
        let end = run(&system, start.clone(), until).final_state().clone();
        close(&end.q, &known.state.q, 1e-11);
        close(&end.v, &known.state.v, 1e-11);
    }
    // In 40 digits, for the start as doubles have it.
    let known = system
        .closed_form(&start, 1234.5)
        .expect("a closed form")
        .state;
    close(
        &known.q,
        &[-1.897_049_870_601_653_5, 0.033_457_369_163_046_82],
        1e-14,
    );
    close(
        &known.v,
        &[-0.040_454_674_142_276_74, -0.229_059_021_652_975_43],
        1e-14,
    );
    let escape = State::new(vec![1.0, 0.0], vec![0.0, 1.5]);
    assert_eq!(system.closed_form(&escape, 1.0), None);
}

#[test]
fn stiff_spring_pendulum() {
    let system = StiffSpringPendulum::default();
    let trajectory = run(&system, system.at(StiffSpringPendulum::REST), 10.0);
    let end = trajectory.final_state();
    close(
        &end.q,
        &[1.000_020_655_435_525_7, -0.463_535_154_460_155_5],
        1e-10,
    );
    close(
        &end.v,
        &[-0.001_906_973_885_652_249, 2.636_012_520_190_506],
        1e-10,
    );
    energy_is_conserved(&trajectory, 1e-12);

    let weightless = StiffSpringPendulum {
        gravity: 0.0,
        stiffness: 40.0,
        ..system
    };
    let start = State::new(vec![1.3, 0.2], vec![-0.4, 2.0]);
    let trajectory = run(&weightless, start, 10.0);
    let [before, after] = conserved(&trajectory, |q, v| q[0] * q[0] * v[1]);
    assert!(
        (after - before).abs() < 1e-13 * before,
        "{before} became {after}"
    );
}

#[test]
fn what_leaves_a_shell_does_so_as_quadrature_says() {
    // 45 digits by tanh-sinh quadrature of the closed forms.
    let shell = MassOnShell::default();
    let known = shell
        .closed_form(&shell.at(MassOnShell::REST), 20.0)
        .expect("a closed form");
    close(
        &[known.events[0].1, known.time],
        &[1.641_132_327_593_929_8, 2.061_265_815_602_948_4],
        1e-15,
    );
    let sphere = RollingSphere::default();
    let known = sphere
        .closed_form(&sphere.at(RollingSphere::REST), 20.0)
        .expect("a closed form");
    close(
        &[known.events[0].1, known.time],
        &[2.175_600_372_851_527_7, 2.587_031_734_131_304_4],
        1e-15,
    );
    let theta = f64::atan2(1.607_273_275_448_32, -1.0);
    close(
        &known.state.q,
        &[1.892_967_876_634_564_5, theta, 11.004_985_663_341_148],
        1e-15,
    );
    assert_eq!(shell.closed_form(&shell.at(MassOnShell::REST), 2.0), None);
}
