//! The numbers of a system that depend on its parameters alone.

use crate::arithmetic::Scalar;
use crate::program::{Builder, Numbers, Program, Register, room};
use crate::system::{ErasedSystem, Selection};

/// The program of the constants, loaded for the effects of a scene and the branches of a mode.
///
/// Registers: zero | parameters | exact numbers | results.
#[derive(Clone, Debug)]
pub(super) struct Constants<T> {
    program: Program,
    registers: Vec<T>,
    outputs: Vec<Register>,
}

impl<T: Scalar> Constants<T> {
    /// The constants for what is held.
    pub(super) fn load(system: &dyn ErasedSystem<T>, held: &Selection) -> Self {
        let d = system.description();
        let parameters = d.parameters.len();
        let first = 1 + parameters + d.constants.numbers.len();
        let numbers = Numbers {
            // The constants read parameters and exact numbers only.
            constants: 0,
            parameters: 1,
            exact: 1 + parameters,
        };
        let inputs: Vec<Register> = (1..1 + parameters).map(Register::new).collect();
        let mut builder = Builder::new(first);
        let outputs = builder.load(&d.constants, held, numbers, &inputs);
        let outputs = outputs.into_iter().map(Option::unwrap_or_default);
        let (program, used) = builder.finish();
        let mut registers = vec![T::zero(); room(used)];
        for (register, &number) in registers[1 + parameters..]
            .iter_mut()
            .zip(d.constants.numbers)
        {
            *register = T::from_f64(number);
        }
        Self {
            program,
            registers,
            outputs: outputs.collect(),
        }
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.outputs.len()
    }

    /// Their values for the parameters of a system; those that nobody asks for are zero.
    pub(super) fn evaluate(&mut self, system: &dyn ErasedSystem<T>, constants: &mut Vec<T>) {
        for index in 0..system.description().parameters.len() {
            self.registers[1 + index] = system.parameter(index);
        }
        self.program.evaluate(0, &mut self.registers);
        constants.clear();
        let values = self.outputs.iter();
        constants.extend(values.map(|register| self.registers[register.index()]));
    }
}
