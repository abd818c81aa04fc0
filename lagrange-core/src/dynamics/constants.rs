//! The numbers of a system that depend on its parameters alone. Modes differ in them by their branches only.

use super::MOST_MODES;
use super::output_mask::{self, OutputMask};
use crate::arithmetic::Scalar;
use crate::effects::Effects;
use crate::program::{Builder, Numbers, Program, Register, room};
use crate::system::{Description, ErasedSystem, Selection};

/// The constants of a scene.
#[derive(Clone, Debug)]
pub(super) struct Constants<T> {
    /// What the effects need.
    needs: OutputMask,
    /// For each choice of branches that has been met.
    list: Vec<OfBranches<T>>,
}

/// The program of the constants, loaded for a choice of branches.
///
/// Registers: zero | parameters | exact numbers | results.
#[derive(Clone, Debug)]
struct OfBranches<T> {
    branches: Vec<u64>,
    program: Program,
    registers: Vec<T>,
    outputs: Vec<Register>,
    /// The results.
    values: Vec<T>,
    /// Whether the parameters have changed since the results were computed.
    outdated: bool,
}

impl<T: Scalar> Constants<T> {
    /// None yet.
    pub(super) fn new(d: &Description, effects: &Effects) -> Self {
        Self {
            needs: output_mask::of_effects(d, effects),
            list: Vec::new(),
        }
    }

    /// The parameters have changed.
    pub(super) fn outdate(&mut self) {
        self.list.iter_mut().for_each(|one| one.outdated = true);
    }

    /// What is held of the constants with these branches.
    pub(super) fn held<'a>(&'a self, branches: &'a [u64]) -> Selection<'a> {
        let needs = &self.needs;
        Selection { needs, branches }
    }

    /// The constants with these branches, for the parameters of a system; those that nobody asks for are zero.
    pub(super) fn write(
        &mut self,
        system: &dyn ErasedSystem<T>,
        branches: &[u64],
        constants: &mut Vec<T>,
    ) {
        let known = self.list.iter().position(|one| one.branches == branches);
        let index = known.unwrap_or_else(|| {
            let one = OfBranches::load(system, &self.held(branches));
            if self.list.len() == MOST_MODES {
                self.list.remove(0);
            }
            self.list.push(one);
            self.list.len() - 1
        });
        let one = &mut self.list[index];
        one.renew(system);
        constants.clear();
        constants.extend_from_slice(&one.values);
    }
}

impl<T: Scalar> OfBranches<T> {
    /// The constants for what is held.
    fn load(system: &dyn ErasedSystem<T>, held: &Selection) -> Self {
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
            branches: held.branches.to_vec(),
            program,
            registers,
            outputs: outputs.collect(),
            values: Vec::new(),
            outdated: true,
        }
    }

    /// Takes the parameters of a system, if they have changed.
    fn renew(&mut self, system: &dyn ErasedSystem<T>) {
        if !core::mem::take(&mut self.outdated) {
            return;
        }
        for index in 0..system.description().parameters.len() {
            self.registers[1 + index] = system.parameter(index);
        }
        self.program.evaluate(0, &mut self.registers);
        let values = self.outputs.iter();
        self.values.clear();
        self.values
            .extend(values.map(|register| self.registers[register.index()]));
    }
}
