//! Hard cases: what breaks other programs, with an answer known by other means, and how far from it a run ends.
//!
//! A [`Case`] runs its scene (in [`scenes::hard`](crate::scenes::hard), whose documentation has the answer and its source)
//! at tolerance 1e-12.
//! Bounds are 1e-9 or better; where one is larger, the case says why nothing better can be had.

mod bounces;
mod constraints;
mod coordinates;
mod frictions;
mod kit;
mod methods;
mod rolling;
mod scales;
mod slips;
mod supports;

use lagrange_program::stability::Case;

/// Every case, in the order of the table.
pub static CASES: &[Case] = &[
    Case {
        name: "bouncing-ball",
        scene: "bouncing-ball",
        trouble: "infinitely many impacts: never ends, or stops too early",
        measure: bounces::bouncing_ball,
    },
    Case {
        name: "thrown-ball",
        scene: "thrown-ball",
        trouble: "bounces end while it still moves sideways and slips",
        measure: bounces::thrown_ball,
    },
    Case {
        name: "cradle",
        scene: "cradle",
        trouble: "two impacts at once: order of the list decides",
        measure: bounces::cradle,
    },
    Case {
        name: "five-ball-cradle",
        scene: "five-ball-cradle",
        trouble: "blows passed on: all balls move a little",
        measure: bounces::five_ball_cradle,
    },
    Case {
        name: "rocking-block",
        scene: "rocking-block",
        trouble: "corners strike in turn, ever faster: never stands",
        measure: bounces::rocking_block,
    },
    Case {
        name: "string-pendulum",
        scene: "string-pendulum",
        trouble: "the string pushes, or snaps back softly",
        measure: bounces::string_pendulum,
    },
    Case {
        name: "ladder",
        scene: "ladder",
        trouble: "the wall pulls where it should let go",
        measure: frictions::ladder,
    },
    Case {
        name: "backspin-ball",
        scene: "backspin-ball",
        trouble: "force jumps where rolling begins: chatter, creep",
        measure: frictions::backspin_ball,
    },
    Case {
        name: "belt-oscillator",
        scene: "belt-oscillator",
        trouble: "stick and slip for ever: errors add up",
        measure: frictions::belt_oscillator,
    },
    Case {
        name: "coulomb-oscillator",
        scene: "coulomb-oscillator",
        trouble: "creeps out of its dead band",
        measure: frictions::coulomb_oscillator,
    },
    Case {
        name: "incline-block",
        scene: "incline-block",
        trouble: "slip turns ever faster and has no change of sign",
        measure: slips::incline_block,
    },
    Case {
        name: "cue-ball",
        scene: "cue-ball",
        trouble: "friction chatters in two directions where it rolls",
        measure: slips::cue_ball,
    },
    Case {
        name: "turning-push",
        scene: "turning-push",
        trouble: "0/0: where does a slip begin to?",
        measure: slips::turning_push,
    },
    Case {
        name: "hoop-bead",
        scene: "hoop-bead",
        trouble: "the wire pulls, then pushes: kink of |N|",
        measure: slips::hoop_bead,
    },
    Case {
        name: "rod-sleeve",
        scene: "rod-sleeve",
        trouble: "slip and normal force vanish together",
        measure: slips::rod_sleeve,
    },
    Case {
        name: "painleve-rod",
        scene: "painleve-rod",
        trouble: "no answer, or two: silently wrong",
        measure: frictions::painleve_rod,
    },
    Case {
        name: "rod-on-supports",
        scene: "rod-on-supports",
        trouble: "two grips, one sum: slips too early, one by one",
        measure: supports::rod_on_supports,
    },
    Case {
        name: "beam-on-supports",
        scene: "beam-on-supports",
        trouble: "three supports: singular, or lets go too early",
        measure: supports::beam_on_supports,
    },
    Case {
        name: "sled",
        scene: "sled",
        trouble: "one runner too many: singular, or one pulls",
        measure: supports::sled,
    },
    Case {
        name: "table",
        scene: "table",
        trouble: "four legs, four cones: slips in a direction of the grid",
        measure: supports::table,
    },
    Case {
        name: "parallelogram",
        scene: "parallelogram",
        trouble: "one condition too many, two at dead positions",
        measure: constraints::parallelogram,
    },
    Case {
        name: "slider-crank",
        scene: "slider-crank",
        trouble: "a condition without gradient: stuck, or wrong branch",
        measure: constraints::slider_crank,
    },
    Case {
        name: "garden-swing",
        scene: "garden-swing",
        trouble: "redundant conditions: steps fall to nothing",
        measure: constraints::garden_swing,
    },
    Case {
        name: "long-pendulum",
        scene: "long-pendulum",
        trouble: "conditions and energy drift",
        measure: constraints::long_pendulum,
    },
    Case {
        name: "spherical-pendulum",
        scene: "spherical-pendulum",
        trouble: "angular momentum is lost at the pole",
        measure: coordinates::spherical_pendulum,
    },
    Case {
        name: "polar-particle",
        scene: "polar-particle",
        trouble: "a straight line bends near the origin",
        measure: coordinates::polar_particle,
    },
    Case {
        name: "tumbling-body",
        scene: "tumbling-body",
        trouble: "angles lock; quaternions drift, singular masses",
        measure: coordinates::tumbling_body,
    },
    Case {
        name: "rolling-disk",
        scene: "rolling-disk",
        trouble: "rolling drifts; stiff turns close to the floor",
        measure: rolling::rolling_disk,
    },
    Case {
        name: "rattleback",
        scene: "rattleback",
        trouble: "spin does not reverse, or energy appears",
        measure: rolling::rattleback,
    },
    Case {
        name: "turntable",
        scene: "turntable",
        trouble: "spirals off its circle",
        measure: rolling::turntable,
    },
    Case {
        name: "spring-pendulum",
        scene: "spring-pendulum",
        trouble: "k = 1e8 N/m: damped away, or blows up",
        measure: scales::spring_pendulum,
    },
    Case {
        name: "unequal-pendulum",
        scene: "unequal-pendulum",
        trouble: "masses 1 : 1e8: digits lost in the mass matrix",
        measure: scales::unequal_pendulum,
    },
    Case {
        name: "overdamped-oscillator",
        scene: "overdamped-oscillator",
        trouble: "rates 1 : 1e6: millions of steps",
        measure: scales::overdamped_oscillator,
    },
    Case {
        name: "catch-by-all-methods",
        scene: "string-pendulum",
        trouble: "a long step sees nothing of a guard that bends",
        measure: methods::catch,
    },
    Case {
        name: "dead-positions-by-all-methods",
        scene: "parallelogram",
        trouble: "goes on along the other branch, without a word",
        measure: methods::dead_positions,
    },
    Case {
        name: "coarse-bounces",
        scene: "thrown-ball",
        trouble: "what is left of the bounces is forgotten",
        measure: methods::coarse_bounces,
    },
];
