//! Fixture: a point mass on a unit rod in Cartesian coordinates x, y (y up), with rows that depend on one another.

use crate::arithmetic::Arithmetic;
use crate::system::Place::{Constant as C, Node as N};
use crate::system::*;

#[derive(Clone, Debug)]
pub struct Pendulum {
    pub mass: f64,
    pub gravity: f64,
}

pub const ROD: usize = 0;
/// The same rod again: 2 (x² + y² − 1) = 0.
pub const TWIN: usize = 1;
/// The same rod growing: x² + y² − 1 − t² = 0.
pub const GROWING: usize = 2;

const ACROSS: usize = 1;
const UP: usize = 2;

const NEEDS: RowNeeds = RowNeeds {
    jacobian: 0,
    bias: 0,
    position: 0,
    velocity: 0,
};

const ALONG: &[(usize, Place)] = &[(0, N(0)), (1, N(1))];
const TWICE: &[(usize, Place)] = &[(0, N(5)), (1, N(6))];

pub static PENDULUM: Description = Description {
    name: "Pendulum",
    documentation: "",
    parameters: &[],
    coordinates: &[
        Coordinate {
            name: "x",
            unit: "m",
            cyclic: false,
        },
        Coordinate {
            name: "y",
            unit: "m",
            cyclic: false,
        },
    ],
    needs: 3,
    constants: 3,
    motion: TapeShape {
        slots: 21,
        outputs: 12,
    },
    report: TapeShape {
        slots: 0,
        outputs: 0,
    },
    mass: &[(0, 0, C(0)), (1, 1, C(1))],
    inertia: Some(&[]),
    forcing: &[Place::Zero, C(2)],
    rows: &[
        Row {
            jacobian: ALONG,
            bias: N(2),
            position: Some(N(3)),
            velocity: N(4),
            needs: NEEDS,
        },
        Row {
            jacobian: TWICE,
            bias: N(7),
            position: Some(N(8)),
            velocity: N(9),
            needs: NEEDS,
        },
        Row {
            jacobian: ALONG,
            bias: N(10),
            position: Some(N(11)),
            velocity: N(4),
            needs: NEEDS,
        },
    ],
    couplings: &[],
    kinetic: &[
        Effect {
            name: "across",
            need: ACROSS,
            optional: true,
        },
        Effect {
            name: "up",
            need: UP,
            optional: true,
        },
    ],
    potential: &[],
    constraints: &[
        Constraint {
            name: "rod",
            row: ROD,
            while_contact: None,
        },
        Constraint {
            name: "twin",
            row: TWIN,
            while_contact: None,
        },
        Constraint {
            name: "growing",
            row: GROWING,
            while_contact: None,
        },
    ],
    contacts: &[],
    frictions: &[],
    forces: &[],
    dissipations: &[],
    branches: &[],
    energy: Energy {
        kinetic: Place::Zero,
        potential: Place::Zero,
        jacobi: Place::Zero,
        time_power: Place::Zero,
        need: 0,
    },
    momenta: Momenta {
        places: &[],
        need: 0,
    },
    observes: &[],
    stops: &[],
    marks: &[],
    starts: &[],
    units: crate::system::Units::NONE,
    impacts: crate::system::Impacts::Together,
};

impl System for Pendulum {
    type Scalar = f64;
    const DESCRIPTION: &'static Description = &PENDULUM;
    fn parameter(&self, _: usize) -> f64 {
        0.0
    }
    fn set_parameter(&mut self, _: usize, _: f64) {}
    fn start(&self, _: usize, _: f64, _: &mut [f64], _: &mut [f64]) {}
    fn constants(&self, held: &Held, c: &mut [f64]) {
        c[0] = if held.needs[0] >> ACROSS & 1 == 1 {
            self.mass
        } else {
            0.0
        };
        c[1] = if held.needs[0] >> UP & 1 == 1 {
            self.mass
        } else {
            0.0
        };
        c[2] = -self.mass * self.gravity;
    }

    fn motion<A: Arithmetic<Scalar = f64>>(
        &self,
        a: &mut A,
        _: &Held,
        _: &[f64],
        s: &[A::Node],
        o: &mut [A::Node],
    ) {
        let [t, x, y, vx, vy] = *s else {
            unreachable!()
        };
        o[0] = a.scale(0, 2.0, x);
        o[1] = a.scale(1, 2.0, y);
        let (vx2, vy2) = (a.square(2, vx), a.square(3, vy));
        let v2 = a.add(4, vx2, vy2);
        o[2] = a.scale(5, 2.0, v2);
        let (x2, y2) = (a.square(6, x), a.square(7, y));
        let r2 = a.add(8, x2, y2);
        o[3] = a.offset(9, -1.0, r2);
        let (along_x, along_y) = (a.mul(10, o[0], vx), a.mul(11, o[1], vy));
        o[4] = a.add(12, along_x, along_y);
        // Twin
        o[5] = a.scale(13, 4.0, x);
        o[6] = a.scale(14, 4.0, y);
        o[7] = a.scale(15, 4.0, v2);
        o[8] = a.scale(16, 2.0, o[3]);
        o[9] = a.scale(17, 2.0, o[4]);
        // Growing
        o[10] = a.offset(18, -2.0, o[2]);
        let t2 = a.square(19, t);
        o[11] = a.sub(20, o[3], t2);
    }

    fn report<A: Arithmetic<Scalar = f64>>(
        &self,
        _: &mut A,
        _: &Held,
        _: &[f64],
        _: &[A::Node],
        _: &mut [A::Node],
    ) {
    }
}
