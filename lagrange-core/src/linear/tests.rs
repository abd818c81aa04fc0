//! Random systems: the planned solution against the whole system written out and solved by nalgebra.

use super::{Inertia, KktPattern, Shares, Solver};
use crate::effects::Effects;
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::program::{Builder as Loader, Encoded, Register, room};
use crate::system::places::*;
use crate::system::*;
use nalgebra::{DMatrix, DVector};

/// Numbers in −1…1 from a seed.
pub(super) struct Random(fastrand::Rng);

impl Random {
    pub(super) fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }
    pub(super) fn number(&mut self) -> f64 {
        2.0 * self.0.f64() - 1.0
    }
    pub(super) fn below(&mut self, n: usize) -> usize {
        self.0.usize(..n)
    }
    pub(super) fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }
}

/// A system under construction: its numbers, constant or not.
struct Builder {
    random: Random,
    constants: Vec<f64>,
    nodes: Vec<f64>,
}

impl Builder {
    fn place(&mut self, value: f64, constant: bool) -> ValueRef {
        let (list, place): (_, fn(usize) -> ValueRef) = if constant {
            (&mut self.constants, ValueRef::Constant)
        } else {
            (&mut self.nodes, ValueRef::Node)
        };
        list.push(value);
        place(list.len() - 1)
    }

    fn row(&mut self, n: usize, constant: bool, elements: Option<Vec<(usize, f64)>>) -> Row {
        let elements = elements.unwrap_or_else(|| {
            let count = 1 + self.random.below(n.min(3));
            let mut columns: Vec<usize> = (0..n).collect();
            (0..count)
                .map(|_| {
                    (
                        columns.remove(self.random.below(columns.len())),
                        self.random.number(),
                    )
                })
                .collect()
        });
        let jacobian: Vec<(usize, ValueRef)> = elements
            .iter()
            .map(|&(j, a)| (j, self.place(a, constant)))
            .collect();
        let bias = if constant {
            ValueRef::Zero
        } else {
            let x = self.random.number();
            self.place(x, false)
        };
        let velocity = self.random.number();
        Row {
            jacobian: jacobian.leak(),
            bias,
            position: None,
            velocity: self.place(velocity, false),
            rheonomic: false,
            needs: RowNeeds {
                jacobian: 0,
                bias: 0,
                position: 0,
                velocity: 0,
            },
        }
    }
}

/// A random description with its numbers: some rows constant, contacts with friction, a coupled force.
fn random_system(seed: u64) -> (Description, Builder) {
    let mut b = Builder {
        random: Random::new(seed),
        constants: Vec::new(),
        nodes: Vec::new(),
    };
    let n = 3 + b.random.below(4);
    // M = B Bᵀ + 1 with some elements constant
    let factor = DMatrix::from_fn(n, n, |_, _| b.random.number());
    let m = &factor * factor.transpose() + DMatrix::identity(n, n);
    let mut mass = Vec::new();
    for i in 0..n {
        for j in 0..=i {
            let constant = b.random.one_in(2);
            mass.push((i, j, b.place(m[(i, j)], constant)));
        }
    }
    let forcing: Vec<ValueRef> = (0..n)
        .map(|_| {
            let (x, constant) = (b.random.number(), b.random.one_in(3));
            if b.random.one_in(5) {
                ValueRef::Zero
            } else {
                b.place(x, constant)
            }
        })
        .collect();
    let mut rows = Vec::new();
    for _ in 0..3 {
        let constant = b.random.one_in(2);
        rows.push(b.row(n, constant, None));
    }
    let constraint = Constraint {
        name: "constraint",
        row: 0,
        while_contact: None,
        attitude: None,
    };
    let contact = |row| Contact {
        name: "contact",
        row,
        normal_factor: None,
        restitution: Restitution::Newton(ValueRef::Zero),
        restitution_need: 0,
        restitution_parameters: &[],
        region: None,
    };
    let mut contacts = vec![contact(1), contact(2)];
    if b.random.one_in(2) {
        let constant = b.random.one_in(2);
        contacts[0].normal_factor = Some(b.place(1.3, constant));
    }
    let normals = {
        let constant = b.random.one_in(2);
        [
            Normal::Contact(0),
            Normal::Contact(1),
            Normal::Constraint(0),
            Normal::Given(b.place(0.8, constant)),
        ]
    };
    let mut frictions = Vec::new();
    for normal in normals {
        let constant = b.random.one_in(2);
        let components = 1 + b.random.below(2);
        let first = rows.len();
        for _ in 0..components {
            rows.push(b.row(n, constant, None));
        }
        let constant = b.random.one_in(2);
        frictions.push(Friction {
            name: "friction",
            row: first,
            components,
            normal,
            static_coefficient: ValueRef::Zero,
            kinetic_coefficient: b.place(0.2, constant),
            coefficients_need: 0,
            static_parameters: &[],
            kinetic_parameters: &[],
        });
    }
    let coupled = b.random.below(rows.len());
    let coupling = Coupling {
        coordinate: b.random.below(n),
        row: coupled,
        factor: b.place(0.15, seed.is_multiple_of(2)),
        need: 0,
    };
    let description = Description {
        name: "random",
        documentation: "",
        parameters: &[],
        coordinates: vec![0; n]
            .iter()
            .map(|_| Coordinate {
                name: "q",
                unit: "",
                cyclic: false,
            })
            .collect::<Vec<_>>()
            .leak(),
        needs: 1,
        constants: Encoded::NONE,
        motion: Encoded {
            outputs: b.nodes.len(),
            ..Encoded::NONE
        },
        report: Encoded::NONE,
        mass: mass.leak(),
        inertia: None,
        forcing: forcing.leak(),
        rows: rows.leak(),
        couplings: vec![coupling].leak(),
        watched_rows: &[],
        kinetic: &[],
        potential: &[],
        constraints: vec![constraint].leak(),
        contacts: contacts.leak(),
        frictions: frictions.leak(),
        resultants: &[],
        forces: &[],
        dissipations: &[],
        branches: &[],
        energy: Energy {
            kinetic: ValueRef::Zero,
            potential: ValueRef::Zero,
            jacobi: ValueRef::Zero,
            time_power: ValueRef::Zero,
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
    (description, b)
}

fn random_mode(d: &Description, random: &mut Random) -> Mode {
    let mut mode = Mode::open(d);
    for contact in &mut mode.contacts {
        *contact = random.one_in(2);
    }
    for (i, friction) in d.frictions.iter().enumerate() {
        let touching = match friction.normal {
            Normal::Contact(contact) => mode.contacts[contact],
            _ => true,
        };
        let angle: f64 = 3.0 * random.number();
        let fixed = if friction.components == 1 {
            [angle.signum(), 0.0]
        } else {
            [angle.cos(), angle.sin()]
        };
        let direction = if random.one_in(3) {
            Direction::AlongSlip
        } else if friction.components > 1 && random.one_in(2) {
            Direction::Incipient(fixed)
        } else {
            Direction::Fixed(fixed)
        };
        mode.frictions[i] = match (touching, random.below(4)) {
            (false, _) | (_, 0) => FrictionMode::Inactive,
            (_, 1) => FrictionMode::Stick,
            _ => FrictionMode::Slip(Sliding {
                direction,
                normal_sign: angle.signum(),
            }),
        };
    }
    mode
}

/// Accelerations and forces of all rows by the definition: one dense system with an equation per coordinate and row.
fn by_definition(
    d: &Description,
    mode: &Mode,
    read: &dyn Fn(ValueRef) -> f64,
) -> Option<(DVector<f64>, f64)> {
    let (n, rows) = (d.coordinates.len(), d.rows.len());
    let size = n + rows;
    let mut k = DMatrix::zeros(size, size);
    let mut right = DVector::zeros(size);
    for &(i, j, place) in d.mass {
        k[(i, j)] = read(place);
        k[(j, i)] = read(place);
    }
    for (i, &place) in d.forcing.iter().enumerate() {
        right[i] = read(place);
    }
    let mut acts = vec![false; rows];
    acts[0] = true;
    for (contact, &closed) in d.contacts.iter().zip(&mode.contacts) {
        acts[contact.row] = closed;
    }
    let mut slides = vec![None; rows];
    for (friction, state) in d.frictions.iter().zip(&mode.frictions) {
        let mu = read(friction.kinetic_coefficient);
        for component in 0..friction.components {
            let row = friction.row + component;
            match state {
                FrictionMode::Inactive => {}
                FrictionMode::Stick => acts[row] = true,
                FrictionMode::Slip(sliding) => {
                    let slip = |c: usize| read(d.rows[friction.row + c].velocity);
                    let speed = (0..friction.components).map(slip).fold(0.0, f64::hypot);
                    let direction = match sliding.direction {
                        Direction::Fixed(direction) | Direction::Incipient(direction) => {
                            direction[component]
                        }
                        Direction::AlongSlip => slip(component) / speed,
                    };
                    slides[row] = Some(match friction.normal {
                        Normal::Contact(c) => {
                            let factor = d.contacts[c].normal_factor.map_or(1.0, read);
                            (-mu * factor * direction, Some(d.contacts[c].row))
                        }
                        Normal::Constraint(c) => (
                            -mu * sliding.normal_sign * direction,
                            Some(d.constraints[c].row),
                        ),
                        Normal::Given(normal) => (-mu * read(normal) * direction, None),
                        Normal::Resultant(_) => unreachable!("none is drawn"),
                    });
                }
            }
        }
    }
    for (index, row) in d.rows.iter().enumerate() {
        // Every multiplier has its column; what it equals is the row's own equation.
        for &(j, place) in row.jacobian {
            k[(j, n + index)] -= read(place);
        }
        if acts[index] {
            for &(j, place) in row.jacobian {
                k[(n + index, j)] += read(place);
            }
            right[n + index] = -read(row.bias);
        } else {
            k[(n + index, n + index)] = 1.0;
            match slides[index] {
                Some((factor, Some(source))) => k[(n + index, n + source)] = -factor,
                Some((factor, None)) => right[n + index] = factor,
                None => {}
            }
        }
    }
    for coupling in d.couplings {
        k[(coupling.coordinate, n + coupling.row)] -= read(coupling.factor);
    }
    let singular = k.clone().svd(false, false).singular_values;
    let condition = singular.max() / singular.min();
    Some((k.lu().solve(&right)?, condition))
}

/// The nodes of a description, then those of the plan.
fn plan_nodes(
    pattern: &KktPattern<f64>,
    mode: &Mode,
    constants: &[f64],
    nodes: &[f64],
) -> Vec<f64> {
    let factors: Vec<f64> = pattern.program.numbers().collect();
    let numbers = [&[0.0], nodes, constants, &factors].concat();
    let mut loader = Loader::new(numbers.len());
    let mut registers: Vec<Register> = (1..=nodes.len()).map(Register::new).collect();
    let first = 1 + nodes.len();
    pattern
        .program
        .load(&mut loader, first, first + constants.len(), &mut registers);
    let (program, used) = loader.finish();
    let mut values = numbers;
    values.resize(room(used), f64::NAN);
    for (slip_direction, (f, along)) in pattern.sliding.slip_directions.iter().zip(mode.incipient())
    {
        assert_eq!(slip_direction.friction, f);
        for (node, x) in slip_direction.nodes.into_iter().zip(along) {
            values[registers[node].index()] = x;
        }
    }
    program.evaluate(0, &mut values);
    registers
        .iter()
        .map(|register| values[register.index()])
        .collect()
}

/// The same by the plan.
fn by_plan(d: &Description, mode: &Mode, b: &Builder) -> Option<Vec<f64>> {
    let (n, rows) = (d.coordinates.len(), d.rows.len());
    let mut constants = b.constants.clone();
    let mut pattern = KktPattern::default();
    pattern.set(d, &Effects::all(), mode, &mut constants);
    let nodes = plan_nodes(&pattern, mode, &constants, &b.nodes);
    let (free, size) = (pattern.free(), pattern.size());
    let mut solver = Solver::default();
    let matrix = solver.begin(free, size, &pattern.constant[..size * size]);
    for e in &pattern.entries {
        matrix[e.row * size + e.column] += nodes[e.node];
    }
    let inertia = if pattern.elimination.symmetric {
        Inertia::Symmetric
    } else {
        Inertia::General
    };
    solver.factor(inertia, Shares::Any).ok()?;
    let mut right = pattern.constant_load.clone();
    for load in &pattern.loads {
        right[load.row] += load.factor * nodes[load.node];
    }
    let mut w = right[..size].to_vec();
    solver.solve(&mut w);
    let mut x: Vec<f64> = (0..n)
        .map(|j| pattern.elimination.acceleration(j, &w))
        .collect();
    x.resize(n + rows, 0.0);
    for (&row, force) in pattern.kept.iter().zip(&w[free..]) {
        x[n + row] = -force;
    }
    for (i, &row) in pattern.eliminated.iter().enumerate() {
        let elements = &pattern.constant[(size + i) * size..(size + i + 1) * size];
        let part: f64 = elements.iter().zip(&w).map(|(k, x)| k * x).sum();
        x[n + row] = part - right[size + i];
    }
    for e in &pattern.force_entries {
        x[n + pattern.eliminated[e.row - size]] += nodes[e.node] * w[e.column];
    }
    for slide in &pattern.sliding.slides {
        let factor = match slide.factor {
            ValueRef::Zero => 0.0,
            ValueRef::Constant(i) => constants[i],
            ValueRef::Node(i) => nodes[i],
        };
        x[n + slide.row] = slide.source.map_or(factor, |source| factor * x[n + source]);
    }
    Some(x)
}

#[test]
fn planned_solutions_agree_with_the_whole_system() {
    let (mut compared, mut eliminated, mut oblique) = (0, 0, 0);
    for seed in 1..=600 {
        let (d, mut b) = random_system(seed * 7919);
        for _ in 0..4 {
            let mode = random_mode(&d, &mut b.random);
            let read = |place| match place {
                ValueRef::Zero => 0.0,
                ValueRef::Constant(i) => b.constants[i],
                ValueRef::Node(i) => b.nodes[i],
            };
            let Some((expected, condition)) = by_definition(&d, &mode, &read) else {
                continue;
            };
            if condition > 1e6 {
                continue;
            }
            let found = by_plan(&d, &mode, &b)
                .unwrap_or_else(|| panic!("seed {seed}, {mode:?}: no solution"));
            let size = expected.amax();
            for (i, (found, expected)) in found.iter().zip(expected.iter()).enumerate() {
                let error = (found - expected).abs();
                assert!(
                    error <= 1e-14 * condition * size,
                    "seed {seed}, {mode:?}: unknown {i} is off by {error:e}"
                );
            }
            let mut pattern = KktPattern::default();
            pattern.set(&d, &Effects::all(), &mode, &mut b.constants.clone());
            compared += 1;
            eliminated += usize::from(!pattern.eliminated.is_empty());
            oblique += usize::from(!pattern.elimination.symmetric);
        }
    }
    // The draw has met what it is for.
    assert!(
        compared > 1000 && eliminated > 300 && oblique > 100,
        "{compared} {eliminated} {oblique}"
    );
}

#[test]
fn the_mass_matrix_of_a_quaternion_is_never_positive_definite() {
    // Close to the identity one of its minors nearly vanishes, and what rounding leaves of the last pivot is large.
    use super::direct::Direct;
    let inertia = [1.0, 2.0, 3.0];
    let mut direct = Direct::default();
    for k in 0..4000 {
        let last = -1e-9 * 1.003_f64.powi(k);
        let q = [0.999_986, 2.643_827_8e-5, 5.287_639e-3, last];
        let rates = [
            [-q[1], q[0], q[3], -q[2]],
            [-q[2], -q[3], q[0], q[1]],
            [-q[3], q[2], -q[1], q[0]],
        ];
        let mut matrix = [0.0; 16];
        for (row, inertia) in rates.iter().zip(inertia) {
            for (k, x) in matrix.iter_mut().enumerate() {
                *x += 4.0 * inertia * row[k / 4] * row[k % 4];
            }
        }
        assert!(!direct.factor(4, 4, &matrix), "q₃ = {last:e}");
    }
}
