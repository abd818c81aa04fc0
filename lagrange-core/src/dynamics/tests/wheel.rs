//! Fixture: a mass on the rim of a rolling wheel, derived by hand. Coordinates x, φ, r, θ (θ from the vertical).

use crate::arithmetic::{Arithmetic, Scalar};
use crate::mode::{FrictionMode, Mode};
use crate::system::*;

#[derive(Clone, Debug)]
pub struct Wheel<T = f64> {
    pub wheel: T,
    pub inertia: T,
    pub mass: T,
    pub radius: T,
    pub gravity: T,
    pub mu_static: T,
    pub mu_kinetic: T,
}

impl<T: Scalar> Wheel<T> {
    pub fn example() -> Self {
        let number = T::from_f64;
        Self {
            wheel: number(2.0),
            inertia: number(1.3),
            mass: number(0.7),
            radius: number(1.1),
            gravity: number(9.81),
            mu_static: number(0.9),
            mu_kinetic: number(0.5),
        }
    }
}

pub const ROLLING: usize = 0;
pub const RIM: usize = 1;
pub const GRIP: usize = 2;

// Needs
const ROLLING_VELOCITY: usize = 1;
const GAP: usize = 2;
const GAP_RATE: usize = 3;
const SLIP: usize = 4;
const ROW: usize = 5;
const COEFFICIENTS: usize = 6;
const ENERGY: usize = 7;
const LIFT: usize = 8;
const TORQUE: usize = 9;

// Motion outputs
const M_XR: usize = 0;
const M_XTH: usize = 1;
const M_THTH: usize = 2;
const F_X: usize = 3;
const F_R: usize = 4;
const F_TH: usize = 5;
const V_ROLLING: usize = 6;
const G_RIM: usize = 7;
const V_RIM: usize = 8;
const V_GRIP: usize = 9;
const F_PHI: usize = 10;

// Constants
const TOTAL: usize = 0;
const INERTIA: usize = 1;
const MASS: usize = 2;
const RADIUS: usize = 3;
const MINUS_RADIUS: usize = 4;
const ONE: usize = 5;
const MU_S: usize = 6;
const MU_K: usize = 7;

const fn needs(position: usize, velocity: usize) -> RowNeeds {
    RowNeeds {
        jacobian: ROW,
        bias: ROW,
        position,
        velocity,
    }
}

const fn coordinate(name: &'static str) -> Coordinate {
    Coordinate {
        name,
        unit: "",
        cyclic: false,
    }
}

use Place::{Constant as C, Node as N, Zero};

pub static WHEEL: Description = Description {
    name: "Wheel",
    documentation: "",
    parameters: &[],
    coordinates: &[
        coordinate("x"),
        coordinate("phi"),
        coordinate("r"),
        coordinate("theta"),
    ],
    needs: 10,
    constants: 8,
    motion: TapeShape {
        slots: 24,
        outputs: 11,
    },
    report: TapeShape {
        slots: 12,
        outputs: 2,
    },
    mass: &[
        (0, 0, C(TOTAL)),
        (1, 1, C(INERTIA)),
        (2, 0, N(M_XR)),
        (2, 2, C(MASS)),
        (3, 0, N(M_XTH)),
        (3, 3, N(M_THTH)),
    ],
    inertia: Some(&[]),
    forcing: &[N(F_X), N(F_PHI), N(F_R), N(F_TH)],
    rows: &[
        Row {
            jacobian: &[(0, C(ONE)), (1, C(MINUS_RADIUS))],
            bias: Zero,
            position: None,
            velocity: N(V_ROLLING),
            needs: needs(0, ROLLING_VELOCITY),
        },
        Row {
            jacobian: &[(2, C(ONE))],
            bias: Zero,
            position: Some(N(G_RIM)),
            velocity: N(V_RIM),
            needs: needs(GAP, GAP_RATE),
        },
        Row {
            jacobian: &[(1, C(MINUS_RADIUS)), (3, C(RADIUS))],
            bias: Zero,
            position: None,
            velocity: N(V_GRIP),
            needs: needs(0, SLIP),
        },
    ],
    couplings: &[],
    kinetic: &[],
    potential: &[],
    constraints: &[Constraint {
        name: "rolling",
        row: ROLLING,
        while_contact: None,
    }],
    contacts: &[Contact {
        name: "rim",
        row: RIM,
        normal_factor: None,
        restitution: Restitution::Newton(Zero),
        restitution_need: 0,
        restitution_parameters: &[],
        region: None,
    }],
    frictions: &[Friction {
        name: "grip",
        row: GRIP,
        components: 1,
        normal: Normal::Contact(0),
        static_coefficient: C(MU_S),
        kinetic_coefficient: C(MU_K),
        coefficients_need: COEFFICIENTS,
        static_parameters: &[],
        kinetic_parameters: &[],
    }],
    forces: &[Load {
        name: "drive",
        need: TORQUE,
        value: Zero,
        power: Zero,
        report_need: 0,
    }],
    dissipations: &[],
    branches: &[],
    energy: Energy {
        kinetic: Zero,
        potential: Zero,
        jacobi: N(0),
        time_power: Zero,
        need: ENERGY,
    },
    momenta: Momenta {
        places: &[],
        need: 0,
    },
    observes: &[Observe {
        name: "lift",
        place: N(1),
        need: LIFT,
        unit: "N",
    }],
    stops: &[],
    marks: &[],
    starts: &[],
    units: crate::system::Units::NONE,
    impacts: crate::system::Impacts::Together,
};

fn held(h: &Held, need: usize) -> bool {
    h.needs[need / 64] >> (need % 64) & 1 == 1
}

impl<T: Scalar> System for Wheel<T> {
    type Scalar = T;
    const DESCRIPTION: &'static Description = &WHEEL;
    fn parameter(&self, _: usize) -> T {
        T::zero()
    }
    fn set_parameter(&mut self, _: usize, _: T) {}
    fn start(&self, _: usize, _: T, _: &mut [T], _: &mut [T]) {}
    fn constants(&self, _: &Held, c: &mut [T]) {
        c[TOTAL] = self.wheel + self.mass;
        c[INERTIA] = self.inertia;
        c[MASS] = self.mass;
        c[RADIUS] = self.radius;
        c[MINUS_RADIUS] = -self.radius;
        c[ONE] = T::one();
        c[MU_S] = self.mu_static;
        c[MU_K] = self.mu_kinetic;
    }

    fn motion<A: Arithmetic<Scalar = T>>(
        &self,
        a: &mut A,
        h: &Held,
        c: &[T],
        x: &[A::Node],
        y: &mut [A::Node],
    ) {
        let (m, g, radius) = (c[MASS], self.gravity, c[RADIUS]);
        let [t, _, _, r, th, vx, vphi, vr, vth] = *x else {
            unreachable!()
        };
        let (s, co) = a.sin_cos(0, th);
        y[M_XR] = a.scale(2, m, s);
        let rc = a.mul(3, r, co);
        y[M_XTH] = a.scale(4, m, rc);
        let r2 = a.square(5, r);
        y[M_THTH] = a.scale(6, m, r2);
        // f_x = m (r θ̇² sinθ − 2 ṙ θ̇ cosθ)
        let w2 = a.square(7, vth);
        let rw2 = a.mul(8, r, w2);
        let first = a.mul(9, rw2, s);
        let vrw = a.mul(10, vr, vth);
        let second = a.mul(11, vrw, co);
        let second = a.scale(12, T::from_f64(2.0), second);
        let f = a.sub(13, first, second);
        y[F_X] = a.scale(13, m, f);
        // f_r = m (r θ̇² − g cosθ)
        let gc = a.scale(14, g, co);
        let f = a.sub(15, rw2, gc);
        y[F_R] = a.scale(15, m, f);
        // f_θ = m r (g sinθ − 2 ṙ θ̇)
        let gs = a.scale(16, g, s);
        let two = a.scale(17, T::from_f64(2.0), vrw);
        let f = a.sub(18, gs, two);
        let f = a.mul(19, r, f);
        y[F_TH] = a.scale(19, m, f);
        // The drive: a torque that grows with time.
        y[F_PHI] = if held(h, TORQUE) {
            a.scale(23, T::from_f64(0.3), t)
        } else {
            a.constant(23, T::zero())
        };
        if held(h, ROLLING_VELOCITY) {
            let turn = a.scale(20, radius, vphi);
            y[V_ROLLING] = a.sub(20, vx, turn);
        }
        if held(h, GAP) {
            y[G_RIM] = a.offset(21, -radius, r);
        }
        if held(h, GAP_RATE) {
            y[V_RIM] = vr;
        }
        if held(h, SLIP) {
            let s = a.sub(22, vth, vphi);
            y[V_GRIP] = a.scale(22, radius, s);
        }
    }

    fn report<A: Arithmetic<Scalar = T>>(
        &self,
        a: &mut A,
        h: &Held,
        c: &[T],
        x: &[A::Node],
        y: &mut [A::Node],
    ) {
        if held(h, LIFT) {
            // N² + r̈
            let n2 = a.square(0, x[13 + RIM]);
            y[1] = a.add(1, n2, x[11]);
        }
        if held(h, ENERGY) {
            // Kinetic energy of the wheel
            let vx2 = a.square(2, x[5]);
            let part = a.scale(3, (c[TOTAL] - c[MASS]) * T::from_f64(0.5), vx2);
            let vphi2 = a.square(4, x[6]);
            let turn = a.scale(5, c[INERTIA] * T::from_f64(0.5), vphi2);
            y[0] = a.add(6, part, turn);
        }
    }
}

/// The mass at rest on the rim.
pub fn stuck() -> Mode {
    Mode {
        contacts: vec![true],
        frictions: vec![FrictionMode::Stick],
        branches: vec![],
    }
}
