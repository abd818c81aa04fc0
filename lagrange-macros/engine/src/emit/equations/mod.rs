//! The equations of each mode as Rust: `constants`, `value` and `series`, and the table that says where their numbers are.

mod series;
mod solve;
mod value;
mod writer;

use super::names::{self, Locals, index, local, plain};
use super::scalar;
use crate::derive::Stage;
use crate::modes::FrictionState;
use crate::plan::mode::{ModeProgram, Phase, products};
use crate::plan::{Program, ValueRef};
use proc_macro2::TokenStream;
use quote::quote;

/// Everything of `impl System` that belongs to modes; nothing if no mode is emitted.
pub fn equations(program: &Program) -> TokenStream {
    if program.modes.is_empty() {
        return TokenStream::new();
    }
    let core = &program.equations.system.core;
    let number = writer::number(&program.equations.system);
    let (mut structures, mut constants) = (Vec::new(), Vec::new());
    let (mut values, mut value_entries) = (Vec::new(), Vec::new());
    let (mut series, mut series_entries) = (Vec::new(), Vec::new());
    for (at, mode) in program.modes.iter().enumerate() {
        let plan = products::Plan::new(mode);
        structures.push(structure(program, mode, &plan));
        let body = mode_constants(program, mode);
        let at_index = index(at);
        constants.push(quote!(#at_index => { #body }));
        let (value, one_series) = (plain(&format!("value_{at}")), plain(&format!("Series{at}")));
        let words = mode.mode.name(&program.equations.system);
        let heading = format!(
            " {words}: {} operations.",
            mode.operations(Phase::Accelerations)
        );
        values.push(value::function(&value, &heading, program, mode, &plan));
        value_entries.push(quote!(#value::<#number> as ValueFn<#number>));
        let sums = plan.convolutions();
        let heading = format!(" {words}: {sums} sums over earlier coefficients for each new one.");
        series.push(series::implementation(
            &one_series,
            &heading,
            program,
            mode,
            &plan,
        ));
        series_entries.push(quote!(across::<#one_series, #number> as SeriesFn<#number>));
    }
    let motion = motion(program);
    let (mode, held, signs, c) = (local("mode"), local("held"), local("signs"), local("c"));
    // Clippy looks for every lint at every expression, although what a derive has written is allowed everything: minutes for code that nobody
    // wrote. It sees the defaults of the trait.
    let unless_linted = quote!(#[cfg(not(clippy))]);
    quote! {
        #unless_linted
        const MODES: &'static [#core::__private::equations::ModeStructure] = &[#(#structures),*];

        #unless_linted
        fn mode_constants(
            &self,
            #mode: usize,
            #held: &#core::__private::program::Selection,
            #signs: &[Self::Scalar],
            #c: &mut [Self::Scalar],
        ) -> bool {
            use #core::__private::equations::{first, first_mut};
            use #core::arithmetic::Scalar;
            match #mode {
                #(#constants)*
                _ => false,
            }
        }

        #motion

        #unless_linted
        fn mode_values<#number: #core::__private::Number>(
        ) -> &'static [#core::__private::equations::ValueFn<#number>] {
            use #core::__private::equations::{Arguments, Turn, ValueFn, first, first_mut};
            use #core::__private::{Number, program::Selection};
            #(#values)*
            const { &[#(#value_entries),*] }
        }

        #unless_linted
        fn mode_series<#number: #core::__private::Number>(
        ) -> &'static [#core::__private::equations::SeriesFn<#number>] {
            use #core::__private::equations::{
                Arguments, Factors, INVERSES, Memory, ModeSeries, Refused, Registers, STRIDE, SeriesFn,
                across, first, first_mut, keep,
            };
            use #core::__private::{Number, program::Selection};
            #(#series)*
            const { &[#(#series_entries),*] }
        }
    }
}

/// `ModeStructure { … }`
fn structure(program: &Program, mode: &ModeProgram, plan: &products::Plan) -> TokenStream {
    let core = &program.equations.system.core;
    let contacts = &mode.mode.contacts;
    let frictions = mode.mode.frictions.iter().map(|state| match state {
        FrictionState::Inactive => quote!(Inactive),
        FrictionState::Stick => quote!(Stick),
        FrictionState::Slip(_) => quote!(Slip),
    });
    let left_out = names::option(mode.mode.left_out.map(index));
    let system = &program.equations.system;
    let pins = mode.results.pins.iter().map(|&(j, place)| {
        let (j, place) = (index(j), names::place(system, place));
        quote!((#j, #place))
    });
    let (mut motion, mut report) = (Vec::new(), Vec::new());
    for extra in &mode.results.extras {
        let (Some(row), ValueRef::Node(node)) =
            (plan.extra_row(mode, extra), program.place(extra.output))
        else {
            continue;
        };
        let (node, row) = (index(node), index(row));
        let list = match program.equations.outputs[extra.output.0].stage {
            Stage::Motion => &mut motion,
            Stage::Report => &mut report,
        };
        list.push(quote!((#node, #row)));
    }
    let count = index(mode.constants.outputs);
    let (rows, products) = (index(plan.rows), index(plan.groups));
    let turns = index(writer::turns_of(mode).count());
    let (gives_rows, numbers) = (mode.gives_rows(), index(value::numbers(mode, plan)));
    quote! {
        #core::__private::equations::ModeStructure {
            contacts: &[#(#contacts),*],
            frictions: &[#(#core::__private::equations::FrictionState::#frictions),*],
            left_out: #left_out,
            constants: #count,
            pins: &[#(#pins),*],
            rows: #rows,
            products: #products,
            turns: #turns,
            motion: &[#(#motion),*],
            report: &[#(#report),*],
            gives_rows: #gives_rows,
            values: #numbers,
        }
    }
}

/// `fn motion`: the motion program as a straight line.
fn motion(program: &Program) -> TokenStream {
    let system = &program.equations.system;
    let core = &system.core;
    let n = system.coordinates.len();
    let (held, c, nodes) = (local("held"), local("c"), local("nodes"));
    let (t, q, v) = (local("t"), local("q"), local("v"));
    let input = |at: usize| {
        let (of_state, at) = match at {
            0 => return quote!(#t),
            at if at <= n => (&q, index(at - 1)),
            at => (&v, index(at - 1 - n)),
        };
        quote!(#of_state[#at])
    };
    let locals = Locals::new(writer::state_names(system)).naming_pairs(&program.motion);
    let sum = local("sum");
    let out = ("nodes", |value: &_| quote!(#sum += #value;));
    let body = scalar::masked(program, &program.motion, out, &locals, input);
    let (coordinates, constants) = (index(n), index(program.constants.outputs));
    quote! {
        #[cfg(not(clippy))]
        fn motion(
            &self,
            #held: &#core::__private::program::Selection,
            #c: &[Self::Scalar],
            (#t, #q, #v): #core::__private::equations::Arguments<'_, Self::Scalar>,
            #nodes: &mut [Self::Scalar],
        ) -> bool {
            use #core::__private::equations::{first, first_mut};
            use #core::arithmetic::Scalar;
            let (#q, #v) = (first::<#coordinates, _>(#q), first::<#coordinates, _>(#v));
            let #c = first::<#constants, _>(#c);
            let mut #sum = <Self::Scalar as ::core::default::Default>::default();
            #body
            Scalar::value(#sum).is_finite()
        }
    }
}

/// The body of `mode_constants` for one mode.
fn mode_constants(program: &Program, mode: &ModeProgram) -> TokenStream {
    let system = &program.equations.system;
    let core = &system.core;
    let fields: Vec<_> = system.parameters.iter().map(names::field).collect();
    let parameters = fields.len();
    let signs = local("signs");
    let input = |at: usize| match fields.get(at) {
        Some(field) => field.clone(),
        None => {
            let at = index(at - parameters);
            quote!(#signs[#at])
        }
    };
    let locals = writer::constant_inputs(system);
    let out = ("c", |_: &_| TokenStream::new());
    let body = scalar::masked(program, &mode.constants, out, &locals, input);
    let place = |place: &ValueRef| match place {
        ValueRef::Constant(at) => {
            let c = scalar::output("c", *at);
            quote!(Scalar::value(*#c).abs())
        }
        ValueRef::Zero | ValueRef::Node(_) => quote!(0.0),
    };
    let tests = mode.results.divisors.iter().map(|(pivot, against)| {
        let pivot = place(pivot);
        let against = against.iter().map(place);
        quote!(#core::__private::equations::is_safe_divisor(#pivot, &[#(#against),*]))
    });
    let positive = mode.results.system.positive.iter().map(|place| {
        let inertia = match place {
            ValueRef::Constant(at) => {
                let c = scalar::output("c", *at);
                quote!(Scalar::value(*#c))
            }
            ValueRef::Zero | ValueRef::Node(_) => quote!(0.0),
        };
        quote!(#inertia > 0.0)
    });
    let mut conditions: Vec<TokenStream> = tests.chain(positive).collect();
    if conditions.is_empty() {
        conditions.push(quote!(true));
    }
    quote!(#body #(#conditions)&&*)
}
