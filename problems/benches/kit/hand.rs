//! The equations of motion as worked out by hand, in as few coordinates as a mode has: y = (q, v), y′ into `d`.
//!
//! Parameters are the scenes' defaults, known to the compiler.

/// Gravitational acceleration of all scenes, m/s².
pub const G: f64 = 9.81;

/// The rolling sphere and its shell.
pub mod sphere {
    /// Radius of the sphere, m.
    pub const A: f64 = 0.2;
    /// Distance of the centres, m.
    pub const REACH: f64 = 1.2;
    /// Coefficient of kinetic friction.
    pub const KINETIC: f64 = 0.3;
}

/// The mass on the wheel.
pub mod wheel {
    /// Radius, m.
    pub const R: f64 = 0.5;
    /// Mass of the wheel and what its rotation adds, M + I/R², kg.
    pub const ROLLING: f64 = 1.5;
    /// The small mass, kg.
    pub const SMALL: f64 = 0.2;
    /// Coefficient of kinetic friction.
    pub const KINETIC: f64 = 0.5;
}

/// θ̈ = rate · sin θ: a mass that slides on a shell (g/R), a sphere that rolls on it (5/7 g/(R + a)).
pub fn on_shell(rate: f64) -> impl Fn(&[f64; 2], &mut [f64; 2]) + Copy {
    move |y, d| *d = [y[1], rate * y[0].sin()]
}

/// Free flight in (r, θ).
pub fn flight(y: &[f64; 4], d: &mut [f64; 4]) {
    let [r, theta, radial, turn] = *y;
    let (s, c) = theta.sin_cos();
    *d = [
        radial,
        turn,
        r * turn * turn - G * c,
        (G * s - 2.0 * radial * turn) / r,
    ];
}

/// (θ, φ) of the sphere that slips forward.
pub fn sphere_slips(y: &[f64; 4], d: &mut [f64; 4]) {
    let [theta, _, turn, spin] = *y;
    let (s, c) = theta.sin_cos();
    let brake = sphere::KINETIC * (G * c - sphere::REACH * turn * turn);
    *d = [
        turn,
        spin,
        (G * s - brake) / sphere::REACH,
        2.5 * brake / sphere::A,
    ];
}

/// θ̈ of the mass that sticks to the wheel.
pub fn wheel_stuck_turn(theta: f64, turn: f64) -> f64 {
    let (s, c) = theta.sin_cos();
    let (m, r) = (wheel::SMALL, wheel::R);
    m * s * (G + r * turn * turn) / (r * (wheel::ROLLING + 2.0 * m * (1.0 + c)))
}

/// θ of the mass that sticks to the wheel.
pub fn wheel_sticks(y: &[f64; 2], d: &mut [f64; 2]) {
    *d = [y[1], wheel_stuck_turn(y[0], y[1])];
}

/// Normal force of the mass that slips forward over the wheel, and the wheel's acceleration.
pub fn wheel_slip_forces(theta: f64, turn: f64) -> (f64, f64) {
    let (s, c) = theta.sin_cos();
    let rest = wheel::SMALL * (G * c - wheel::R * turn * turn);
    let drag = wheel::KINETIC * (1.0 + c) - s;
    let pushed = rest * drag / (wheel::ROLLING - wheel::SMALL * s * drag);
    (rest + wheel::SMALL * s * pushed, pushed)
}

/// (θ, φ) of the mass that slips forward over the wheel.
pub fn wheel_slips(y: &[f64; 4], d: &mut [f64; 4]) {
    let [theta, _, turn, spin] = *y;
    let (normal, pushed) = wheel_slip_forces(theta, turn);
    let (s, c) = theta.sin_cos();
    let along = G * s - wheel::KINETIC * normal / wheel::SMALL - pushed * c;
    *d = [turn, spin, along / wheel::R, pushed / wheel::R];
}

/// Two equal links of 1 m with 1 kg each; angles from the downward vertical.
pub fn double_pendulum(y: &[f64; 4], d: &mut [f64; 4]) {
    let [first, second, w1, w2] = *y;
    let (s, c) = (first - second).sin_cos();
    let b1 = -s * w2 * w2 - 2.0 * G * first.sin();
    let b2 = s * w1 * w1 - G * second.sin();
    let scale = 1.0 / (2.0 - c * c);
    *d = [w1, w2, (b1 - c * b2) * scale, (2.0 * b2 - c * b1) * scale];
}

/// Five links of 1 m with 1 kg each, by LDLᵀ; angles from the downward vertical.
pub fn chain(y: &[f64; 10], d: &mut [f64; 10]) {
    const N: usize = 5;
    let (angles, rates) = y.split_at(N);
    let mut sines = [(0.0, 0.0); N];
    for (x, angle) in sines.iter_mut().zip(angles) {
        *x = angle.sin_cos();
    }
    let mut l = [[0.0; N]; N];
    let mut b = [0.0; N];
    for i in 0..N {
        let (si, ci) = sines[i];
        b[i] = -G * (N - i) as f64 * si;
        for j in 0..N {
            let (sj, cj) = sines[j];
            let carried = (N - i.max(j)) as f64;
            if j <= i {
                l[i][j] = carried * (ci * cj + si * sj);
            }
            b[i] -= carried * (si * cj - ci * sj) * rates[j] * rates[j];
        }
    }
    for j in 0..N {
        for k in 0..j {
            let factor = l[j][k] * l[k][k];
            for row in &mut l[j..] {
                row[j] -= row[k] * factor;
            }
        }
        let inverse = 1.0 / l[j][j];
        for row in &mut l[j + 1..] {
            row[j] *= inverse;
        }
    }
    for i in 0..N {
        for k in 0..i {
            b[i] -= l[i][k] * b[k];
        }
    }
    for i in (0..N).rev() {
        b[i] /= l[i][i];
        for k in i + 1..N {
            b[i] -= l[k][i] * b[k];
        }
    }
    d[..N].copy_from_slice(rates);
    d[N..].copy_from_slice(&b);
}

/// A mass on a rod of 1 m in (x, y), the rod's force from the constraint's second derivative.
pub fn cartesian_pendulum(y: &[f64; 4], d: &mut [f64; 4]) {
    let [x, z, vx, vz] = *y;
    let pull = (vx * vx + vz * vz - G * z) / (x * x + z * z);
    *d = [vx, vz, -pull * x, -pull * z - G];
}

/// Kepler's problem with μ = 1 in (x, y).
pub fn kepler(y: &[f64; 4], d: &mut [f64; 4]) {
    let [x, z, vx, vz] = *y;
    let square = x * x + z * z;
    let pull = -1.0 / (square * square.sqrt());
    *d = [vx, vz, pull * x, pull * z];
}

/// 1 kg on a spring of 10⁶ N/m and 1 m in (r, θ), θ from the downward vertical.
pub fn spring_pendulum(y: &[f64; 4], d: &mut [f64; 4]) {
    let [r, theta, radial, turn] = *y;
    let (s, c) = theta.sin_cos();
    *d = [
        radial,
        turn,
        r * turn * turn + G * c - 1e6 * (r - 1.0),
        (-G * s - 2.0 * radial * turn) / r,
    ];
}
