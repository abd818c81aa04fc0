//! Order 0 of a series: every operation as a value, and what its later coefficients take from that.

use super::Expansion;
use super::rules::needs_auxiliary;
use crate::emit::equations::solve::Elimination;
use crate::emit::equations::value;
use crate::emit::names::{self, local};
use crate::emit::operation::Notation;
use crate::plan::mode::Phase;
use crate::plan::mode::products::Row;
use crate::plan::{Coefficient, Operation, Step, Value, ValueRef};
use proc_macro2::{Ident, TokenStream};
use quote::quote;

impl Expansion<'_> {
    /// Order 0 of everything.
    pub(super) fn first(&self, elimination: &Elimination) -> TokenStream {
        let declarations = self.writer.declarations();
        let auxiliary = self.auxiliary_declarations();
        let inputs = self.first_of_inputs();
        let assembly = self.first_of(Phase::Assembly);
        let unknowns = self.first_of_unknowns(elimination);
        let balance = self.first_of(Phase::Balance);
        let accelerations = self.first_of(Phase::Accelerations);
        let velocities = self.first_of_velocities();
        let forces = self.first_of(Phase::Forces);
        let results = self.first_of_results();
        let outputs = self.first_of(Phase::Outputs);
        let sums = self.plan.sums.keys().map(|&output| {
            let sum = names::sum(output);
            self.store(Row::Sum(output), quote!(0), quote!(#sum))
        });
        quote! {
            #declarations
            #auxiliary
            #inputs
            #assembly
            #unknowns
            #balance
            #accelerations
            #velocities
            #forces
            #results
            #outputs
            #(#sums)*
        }
    }

    /// Positions, velocities, time, and the numbers that do not change.
    fn first_of_inputs(&self) -> TokenStream {
        let inputs = self.mode.inputs;
        let number = &self.writer.number;
        let t = local("t");
        let states = (0..inputs.coordinates).map(|j| {
            let position = self.keep_first(inputs.position(j));
            let velocity = self.keep_first(inputs.velocity(j));
            quote!(#position #velocity)
        });
        let time = Row::Value(Value(0));
        let first = self.store(time, quote!(0), quote!(#t));
        let second = self.store(time, quote!(1), quote!(#number::of(1.0)));
        let fixed = self.plan.fixed().map(|constant| {
            let value = self.writer.coefficient(Coefficient::Constant(constant));
            self.store(Row::Fixed(constant), quote!(0), value)
        });
        quote!(#(#states)* #first #second #(#fixed)*)
    }

    /// Eliminates, and solves the linear system.
    fn first_of_unknowns(&self, elimination: &Elimination) -> TokenStream {
        let (writer, mode) = (&self.writer, self.mode);
        let mut code = elimination.code.clone();
        let safe = local("safe");
        code.extend(quote! {
            if !#safe {
                return ::core::result::Result::Err(Refused::Pivot);
            }
        });
        let (solve, mut solution) = elimination.solve_system(writer);
        code.extend(solve);
        if mode.results.system.matrix.len() > mode.results.system.accelerations {
            // Forces feel the rounding of the elimination, the same in every step.
            let residuals = elimination.residuals(writer, &solution);
            let (again, correction) = elimination.solve(writer, residuals, "c");
            code.extend(again);
            let refined = (0..solution.len()).map(|i| local(&format!("w{i}")));
            let refined: Vec<Ident> = refined.collect();
            code.extend(quote!(#(let #refined = #solution + #correction;)*));
            solution = refined;
        }
        for (i, x) in solution.iter().enumerate() {
            let value = mode.inputs.unknown(i);
            let name = writer.value(value);
            code.extend(quote!(let #name = #x;));
            code.extend(self.keep_first(value));
        }
        code
    }

    /// The first two coefficients of the velocities.
    fn first_of_velocities(&self) -> TokenStream {
        let places = self.mode.results.accelerations.iter().enumerate();
        let moving = places.filter(|(_, place)| **place != ValueRef::Zero);
        let lines = moving.map(|(j, place)| {
            let value = self.writer.place(*place);
            let velocity = self.mode.inputs.velocity(j);
            let store = self.store(Row::Value(velocity), quote!(1), value.clone());
            let next = self.d_of_place(*place).map(|_| {
                let (before, now) = (self.before(velocity), self.now(velocity));
                let first = self.writer.value(velocity);
                quote!(let mut #before = #first; let mut #now = #value;)
            });
            quote!(#store #next)
        });
        quote!(#(#lines)*)
    }

    /// Forces, and what is read of the results.
    fn first_of_results(&self) -> TokenStream {
        let (writer, mode) = (&self.writer, self.mode);
        let mut code = TokenStream::new();
        for (r, place) in mode.results.forces.iter().enumerate() {
            if let Some(place) = place {
                let value = writer.place(*place);
                code.extend(self.store(Row::Value(mode.inputs.force(r)), quote!(0), value));
            }
        }
        for (value, place) in value::results(mode) {
            let (name, result) = (writer.value(value), writer.place(place));
            code.extend(quote!(let #name = #result;));
            if value.0 < mode.inputs.force(0).0 {
                code.extend(self.keep_first(value));
            }
        }
        code
    }

    /// Inverses and auxiliary values that leave a block.
    fn auxiliary_declarations(&self) -> TokenStream {
        let number = &self.writer.number;
        let lines = self.optional_steps().map(|step| {
            let (u, i) = (self.auxiliary(step.value), self.inverse(step.value));
            let second =
                needs_auxiliary(step.operation).then(|| quote!(let mut #u = #number::of(0.0);));
            let inverse = self
                .needs_inverse(step)
                .then(|| quote!(let mut #i = #number::of(0.0);));
            quote!(#second #inverse)
        });
        quote!(#(#lines)*)
    }

    /// The values of a phase, what rules of differentiation need beside them, and what is kept.
    fn first_of(&self, phase: Phase) -> TokenStream {
        let blocks = self.mode.blocks(phase).map(|block| {
            let steps = block.steps.iter().map(|step| {
                let (before, after) = self.beside(step);
                let value = self.writer.step(step);
                let kept = (0..step.operation.values())
                    .map(|offset| self.keep_first(Value(step.value.0 + offset)));
                quote!(#before #value #after #(#kept)*)
            });
            let writes = self.writer.writes(block);
            value::in_block(block, quote!(#(#steps)* #writes))
        });
        quote!(#(#blocks)*)
    }

    fn keep_first(&self, value: Value) -> TokenStream {
        let name = self.writer.value(value);
        self.store(Row::Value(value), quote!(0), quote!(#name))
    }

    /// What a step needs besides its value: whether its series exists, an inverse, an auxiliary value.
    fn beside(&self, step: &Step) -> (TokenStream, TokenStream) {
        if !self.plan.varying[step.value.0] {
            return (TokenStream::new(), TokenStream::new());
        }
        let n = |value| self.writer.value(value);
        let number = &self.writer.number;
        let z = step.value;
        let refuse = |condition: TokenStream| {
            quote! {
                if #condition {
                    return ::core::result::Result::Err(Refused::NoSeries);
                }
            }
        };
        let outside = self.writer.declared.contains(&z);
        let set = |name: Ident, value: TokenStream| {
            if outside {
                quote!(#name = #value;)
            } else {
                quote!(let #name = #value;)
            }
        };
        let none = TokenStream::new();
        if let Some(power) = self.plan.power(z) {
            let x = n(power.base);
            let check = match power.positive {
                true => refuse(quote!(!#x.all_positive())),
                false => refuse(quote!(#x.any_zero())),
            };
            return (check, set(self.inverse(z), quote!(#number::of(1.0) / #x)));
        }
        match step.operation {
            Operation::Div(_, y) | Operation::Ratio(_, y) => {
                let name = n(y);
                let check = refuse(quote!(#name.any_zero()));
                (
                    check,
                    set(self.inverse(z), quote!(#number::of(1.0) / #name)),
                )
            }
            Operation::Sqrt(x) => {
                let (x, root) = (n(x), n(z));
                let check = refuse(quote!(!#x.all_positive()));
                (
                    check,
                    set(self.inverse(z), quote!(#number::of(0.5) / #root)),
                )
            }
            Operation::Ln(x) => {
                let x = n(x);
                let check = refuse(quote!(!#x.all_positive()));
                (check, set(self.inverse(z), quote!(#number::of(1.0) / #x)))
            }
            Operation::Tan(_) => {
                let z_value = n(z);
                let u = quote!(#number::of(1.0) + #z_value * #z_value);
                (none, set(self.auxiliary(z), u))
            }
            Operation::Tanh(_) => {
                let z_value = n(z);
                let u = quote!(#number::of(1.0) - #z_value * #z_value);
                (none, set(self.auxiliary(z), u))
            }
            Operation::Asin(x) | Operation::Acos(x) => {
                let x = n(x);
                let check = refuse(quote!(!#x.all_inside_unit()));
                let u = set(
                    self.auxiliary(z),
                    quote!((#number::of(1.0) - #x * #x).sqrt()),
                );
                let name = self.auxiliary(z);
                let inverse = set(self.inverse(z), quote!(#number::of(1.0) / #name));
                (check, quote!(#u #inverse))
            }
            Operation::Atan(x) => {
                let x = n(x);
                let u = set(self.auxiliary(z), quote!(#number::of(1.0) + #x * #x));
                let name = self.auxiliary(z);
                let inverse = set(self.inverse(z), quote!(#number::of(1.0) / #name));
                (none, quote!(#u #inverse))
            }
            Operation::Atan2(y, x) => {
                let (y, x) = (n(y), n(x));
                let u = set(self.auxiliary(z), quote!(#y * #y + #x * #x));
                let name = self.auxiliary(z);
                let check = refuse(quote!(#name.any_zero()));
                let inverse = set(self.inverse(z), quote!(#number::of(1.0) / #name));
                (none, quote!(#u #check #inverse))
            }
            _ => (none.clone(), none),
        }
    }
}
