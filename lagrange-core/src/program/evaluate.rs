//! An encoded program at one point: loaded, run once, and forgotten.

use super::{Builder, Encoded, Numbers, Register, Selection, room};
use crate::arithmetic::Scalar;

impl Encoded {
    /// Its outputs for what is held, from constants, parameters and inputs; none where nothing that is held asks for it.
    pub fn evaluate<T: Scalar>(
        &self,
        held: &Selection,
        constants: &[T],
        parameters: &[T],
        inputs: &[T],
    ) -> Vec<Option<T>> {
        let first = 1 + inputs.len();
        let numbers = Numbers {
            constants: first,
            parameters: first + constants.len(),
            exact: first + constants.len() + parameters.len(),
        };
        let exact = self.numbers.iter().map(|&number| T::from_f64(number));
        let mut registers = vec![T::zero()];
        registers.extend(inputs.iter().chain(constants).chain(parameters));
        registers.extend(exact);
        let places: Vec<Register> = (1..first).map(Register::new).collect();
        let mut builder = Builder::new(registers.len());
        let outputs = builder.load(self, held, numbers, &places);
        let (program, used) = builder.finish();
        registers.resize(room(used), T::zero());
        program.evaluate(0, &mut registers);
        let outputs = outputs.into_iter();
        outputs
            .map(|output| output.map(|register| registers[register.index()]))
            .collect()
    }
}
