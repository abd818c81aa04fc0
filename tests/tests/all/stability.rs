//! Every hard case keeps its bounds.

use lagrange_problems::catalogue;
use lagrange_problems::stability::CASES;
use lagrange_program::stability::Extent;

#[track_caller]
fn holds(name: &str) {
    let case = CASES.iter().find(|case| case.name == name).expect("a case");
    let report = case.run(Extent::Short);
    for figure in &report.figures {
        let verdict = if figure.holds() { "" } else { "   FAILS" };
        println!(
            "{name}: {}: {:.1e} ≤ {:.0e}{verdict}",
            figure.what, figure.value, figure.bound
        );
    }
    if let Some(surprise) = &report.surprise {
        println!("{name}: {surprise}   FAILS");
    }
    assert!(report.holds(), "{name}");
}

macro_rules! cases {
    ($($test:ident $name:literal)*) => {
        $(#[test]
        fn $test() {
            holds($name);
        })*

        #[test]
        fn every_case_is_tested_and_every_scene_listed() {
            assert_eq!(CASES.iter().map(|case| case.name).collect::<Vec<_>>(), [$($name),*]);
            let catalogue = catalogue::all();
            for case in CASES {
                assert!(catalogue.find(case.scene).is_ok(), "{}", case.scene);
            }
        }
    };
}

cases! {
    bouncing_ball "bouncing-ball"
    thrown_ball "thrown-ball"
    cradle "cradle"
    five_ball_cradle "five-ball-cradle"
    rocking_block "rocking-block"
    string_pendulum "string-pendulum"
    ladder "ladder"
    backspin_ball "backspin-ball"
    belt_oscillator "belt-oscillator"
    coulomb_oscillator "coulomb-oscillator"
    incline_block "incline-block"
    cue_ball "cue-ball"
    turning_push "turning-push"
    hoop_bead "hoop-bead"
    rod_sleeve "rod-sleeve"
    painleve_rod "painleve-rod"
    rod_on_supports "rod-on-supports"
    beam_on_supports "beam-on-supports"
    sled "sled"
    table "table"
    parallelogram "parallelogram"
    slider_crank "slider-crank"
    garden_swing "garden-swing"
    long_pendulum "long-pendulum"
    spherical_pendulum "spherical-pendulum"
    polar_particle "polar-particle"
    tumbling_body "tumbling-body"
    rolling_disk "rolling-disk"
    rattleback "rattleback"
    turntable "turntable"
    spring_pendulum "spring-pendulum"
    unequal_pendulum "unequal-pendulum"
    overdamped_oscillator "overdamped-oscillator"
    catch "catch-by-all-methods"
    dead_positions "dead-positions-by-all-methods"
    coarse_bounces "coarse-bounces"
}
