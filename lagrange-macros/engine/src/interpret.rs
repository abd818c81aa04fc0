//! Program → numbers in f64, without rustc: the oracle of the emitted code.
//!
//! Every step is done exactly as the emitted code does it in the value reading, in the same order, so emitted code
//! run on f64 must agree to the last bit.

use crate::plan::{
    Coefficient, Mode, Operation, Program, Start, StartTarget, Tape, Value, ValueRef,
};

/// What a tape is told beside its inputs; as the core's `Selection`.
#[derive(Clone, Copy, Debug)]
pub struct Selection<'a> {
    /// Words of the need mask.
    pub needs: &'a [u64],
    /// Words of the branches that are on their `then` side.
    pub branches: &'a [u64],
}

impl Selection<'_> {
    fn branch(&self, index: usize) -> bool {
        self.branches
            .get(index / 64)
            .is_some_and(|word| word >> (index % 64) & 1 == 1)
    }
}

/// A program with its parameters.
pub struct Machine<'a> {
    program: &'a Program,
    parameters: Vec<f64>,
}

impl Machine<'_> {
    /// `parameters` in order of declaration.
    pub fn new<'a>(program: &'a Program, parameters: &[f64]) -> Machine<'a> {
        Machine {
            program,
            parameters: parameters.to_vec(),
        }
    }

    /// The constants; NaN where nothing that is held asks for one.
    pub fn constants(&self, held: &Selection) -> Vec<f64> {
        self.run(&self.program.constants, held, &[], &self.parameters)
    }

    /// Outputs of the tape before the solve for x = (t, q…, v…); NaN where nothing that is held asks for one.
    pub fn motion(&self, held: &Selection, x: &[f64]) -> Vec<f64> {
        self.run(&self.program.motion, held, &self.constants(held), x)
    }

    /// Outputs of the tape after the solve for x = (t, q…, v…, v̇…, λ…).
    pub fn report(&self, held: &Selection, x: &[f64]) -> Vec<f64> {
        self.run(&self.program.report, held, &self.constants(held), x)
    }

    /// Positions and velocities of a start at time t.
    pub fn start(&self, index: usize, t: f64) -> (Vec<f64>, Vec<f64>) {
        let count = self.program.equations.system.coordinates.len();
        let (mut q, mut v) = (vec![0.0; count], vec![0.0; count]);
        let start = &self.program.starts[index];
        self::start(start, &self.parameters, t, &mut q, &mut v);
        (q, v)
    }

    /// The number at a place, given the constants and the outputs of its stage.
    pub fn number(place: ValueRef, constants: &[f64], outputs: &[f64]) -> f64 {
        match place {
            ValueRef::Zero => 0.0,
            ValueRef::Constant(index) => constants[index],
            ValueRef::Node(index) => outputs[index],
        }
    }

    fn run(&self, tape: &Tape, held: &Selection, constants: &[f64], inputs: &[f64]) -> Vec<f64> {
        run(tape, held, &self.parameters, constants, inputs)
    }
}

/// Positions and velocities of a start at time t, for parameters in order of declaration.
pub fn start(start: &Start, parameters: &[f64], t: f64, q: &mut [f64], v: &mut [f64]) {
    let always = Selection {
        needs: &[1],
        branches: &[],
    };
    let inputs: Vec<f64> = parameters.iter().copied().chain([t]).collect();
    let outputs = run(&start.tape, &always, parameters, &[], &inputs);
    q.fill(0.0);
    v.fill(0.0);
    for (target, value) in start.targets.iter().zip(outputs) {
        match target {
            StartTarget::Position(i) => q[*i] = value,
            StartTarget::Velocity(i) => v[*i] = value,
        }
    }
}

fn run(
    tape: &Tape,
    held: &Selection,
    parameters: &[f64],
    constants: &[f64],
    inputs: &[f64],
) -> Vec<f64> {
    assert_eq!(inputs.len(), tape.inputs, "number of inputs");
    let number = |coefficient| match coefficient {
        Coefficient::Number(number) => number.to_f64(),
        Coefficient::Pi(multiple) => Coefficient::multiple_of_pi(multiple),
        Coefficient::Parameter(index) => parameters[index],
        Coefficient::Constant(index) => constants[index],
    };
    let mut values = vec![f64::NAN; tape.values];
    values[..tape.inputs].copy_from_slice(inputs);
    let mut outputs = vec![f64::NAN; tape.outputs];
    for block in tape
        .blocks
        .iter()
        .filter(|block| block.needs.runs(held.needs))
    {
        for step in &block.steps {
            let (first, second) = apply(step.operation, &|Value(i)| values[i], &number, held);
            values[step.value.0] = first;
            if step.operation.values() == 2 {
                values[step.value.0 + 1] = second;
            }
        }
        for write in &block.writes {
            let value = values[write.value.0];
            match write.mode {
                Mode::Set => outputs[write.output] = value,
                Mode::Add => outputs[write.output] += value,
                Mode::Sub => outputs[write.output] -= value,
            }
        }
    }
    outputs
}

/// The values that an operation defines; the second is meant for pairs only.
fn apply(
    operation: Operation,
    x: &dyn Fn(Value) -> f64,
    number: &dyn Fn(Coefficient) -> f64,
    held: &Selection,
) -> (f64, f64) {
    let single = |value| (value, f64::NAN);
    match operation {
        Operation::Constant(c) => single(number(c)),
        Operation::Add(a, b) => single(x(a) + x(b)),
        Operation::Sub(a, b) => single(x(a) - x(b)),
        Operation::Neg(a) => single(-x(a)),
        Operation::Offset(c, a) => single(number(c) + x(a)),
        Operation::Scale(c, a) => single(number(c) * x(a)),
        Operation::Mul(a, b) => single(x(a) * x(b)),
        Operation::Square(a) => single(x(a) * x(a)),
        Operation::Div(a, b) => single(x(a) / x(b)),
        Operation::Ratio(c, a) => single(number(c) / x(a)),
        Operation::Sqrt(a) => single(x(a).sqrt()),
        Operation::Powf(a, c) => single(x(a).powf(c.to_f64())),
        Operation::Exp(a) => single(x(a).exp()),
        Operation::Ln(a) => single(x(a).ln()),
        Operation::SinCos(a) => x(a).sin_cos(),
        Operation::SinhCosh(a) => (x(a).sinh(), x(a).cosh()),
        Operation::Tan(a) => single(x(a).tan()),
        Operation::Tanh(a) => single(x(a).tanh()),
        Operation::Asin(a) => single(x(a).asin()),
        Operation::Acos(a) => single(x(a).acos()),
        Operation::Atan(a) => single(x(a).atan()),
        Operation::Atan2(a, b) => single(x(a).atan2(x(b))),
        Operation::Select(branch, a, b) => single(x(if held.branch(branch) { a } else { b })),
        Operation::Choose(guard, a, b) => single(if x(guard) >= 0.0 { x(a) } else { x(b) }),
    }
}
