//! `series`: Taylor coefficients of the motion and of everything that guards read, order by order.
//!
//! ```text
//! (x y)ₖ = x₀ yₖ + xₖ y₀ + Σ xⱼ yₖ₋ⱼ        K₀ wₖ = bₖ − Kₖ w₀ − Σ Kⱼ wₖ₋ⱼ        vₖ₊₁ = v̇ₖ/(k+1), qₖ = vₖ₋₁/k
//! ```
//!
//! Where the balance of forces is kept whole, K₀ wₖ = −(K w − b)ₖ with wₖ = 0 on the right: no element of K has a series of its own.
//! That is inverse dynamics, order by order (Luh, Walker & Paul 1980, J. Dyn. Syst. Meas. Control 102, for values).
//!
//! The sums over earlier coefficients come first, several in one loop; one factorization serves every order. Rules: Jorba & Zou
//! 2005, Experimental Mathematics 14, section 2; Griewank & Walther 2008, section 13.2.

use super::super::names::{self, index, local};
use super::solve::Elimination;
use super::value;
use super::writer::Writer;
use crate::ast::Emit;
use crate::plan::mode::products::{Factor, GROUP, Plan, Product, Row};
use crate::plan::mode::{ModeProgram, Phase};
use crate::plan::{Block, Coefficient, Mode, Operation, Program, Step, Value, ValueRef};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use std::collections::BTreeSet;

/// Writes the coefficients of one mode.
struct Expansion<'a> {
    writer: Writer<'a>,
    plan: &'a Plan,
    mode: &'a ModeProgram,
    /// Values whose coefficient leaves its block.
    crossing: BTreeSet<Value>,
}

/// Coefficients up to this order have code of their own in unrolled series; it is that of a tolerance of about 1e-13.
const UNROLLED: usize = 21;

/// So many groups of products are summed together at most: a processor has sixteen registers for their sums and what they add.
const TOGETHER: usize = 8;

fn sum_coefficient(output: usize) -> Ident {
    local(&format!("dsum{output}"))
}

fn system_product(i: usize, j: usize) -> Ident {
    local(&format!("earlier_k{i}_{j}"))
}

/// `impl ModeSeries for …`
pub fn implementation(
    name: &Ident,
    heading: &str,
    program: &Program,
    mode: &ModeProgram,
    plan: &Plan,
) -> TokenStream {
    let system = &program.equations.system;
    let blocks = mode
        .tape
        .blocks
        .iter()
        .filter(|block| !block.needs.is_always());
    let steps = blocks.flat_map(|block| &block.steps);
    let declared = steps
        .flat_map(|step| (0..step.operation.values()).map(|offset| Value(step.value.0 + offset)));
    let expansion = Expansion {
        writer: Writer::new(system, mode, declared.collect()),
        plan,
        mode,
        crossing: names::crossing(&mode.tape),
    };
    let number = expansion.writer.number.clone();
    let elimination = Elimination::new(&expansion.writer, &mode.system);
    let first = expansion.first(&elimination);
    let mut next = TokenStream::new();
    let mut looped = 1;
    if system.emit == Emit::Unrolled {
        for k in 1..=UNROLLED {
            next.extend(expansion.order(k, &elimination));
        }
        looped += UNROLLED;
    }
    next.extend(expansion.orders_from(looped, &elimination));
    let (c, held, order, rows) = (local("c"), local("held"), local("order"), local("rows"));
    let (t, q, v, registers) = (local("t"), local("q"), local("v"), local("registers"));
    let (products, newest) = (local("products"), local("newest"));
    let groups = index(plan.groups);
    let prologue = expansion.writer.prologue();
    let needs = names::needs(program.equations.needs.len());
    let (row_names, count) = (expansion.row_names(), index(plan.rows));
    let result = quote!(::core::result::Result<(), Refused>);
    quote! {
        #[doc = #heading]
        struct #name;
        impl<#number: Number> ModeSeries<#number> for #name {
            #[inline(always)]
            fn expand(
                #registers: Registers,
                #c: &[#number],
                #held: &Selection,
                #order: usize,
                (#t, #q, #v): Arguments<'_, #number>,
                #rows: &mut [Row<#number>],
                #products: &mut [Products<#number>],
            ) -> #result {
                #prologue
                #row_names
                let #rows = first_mut::<#count, _>(#rows);
                let #products = first_mut::<#groups, _>(#products);
                #needs
                #first
                let mut #newest = [Factors::<#number>::none(); #groups];
                #next
                ::core::result::Result::Ok(())
            }
        }
    }
}

impl Expansion<'_> {
    /// A local that belongs to a value. What it is stands before the name: behind it, it could be a part of a declared one.
    fn of(&self, what: &str, value: Value) -> Ident {
        local(&format!("{what}{}", self.writer.locals.stem(value)))
    }

    /// Coefficient k − 1 of a velocity, at hand: what is read back from memory is waited for.
    fn before(&self, velocity: Value) -> Ident {
        self.of("before_", velocity)
    }

    /// Coefficient k of it.
    fn now(&self, velocity: Value) -> Ident {
        self.of("now_", velocity)
    }

    /// Coefficient k of a value.
    fn coefficient_of(&self, value: Value) -> Ident {
        self.of("d", value)
    }

    /// What the rule of a function needs beside its value.
    fn auxiliary(&self, value: Value) -> Ident {
        self.of("u_", value)
    }

    /// Coefficient k of that.
    fn auxiliary_coefficient(&self, value: Value) -> Ident {
        self.of("du_", value)
    }

    /// What the rule of an operation divides by, inverted.
    fn inverse(&self, value: Value) -> Ident {
        self.of("inverse_", value)
    }

    /// Σ xⱼ yₖ₋ⱼ of a product, of several that with this number.
    fn product(&self, value: Value, at: usize) -> Ident {
        match at {
            0 => self.of("earlier_", value),
            _ => self.of(&format!("earlier{at}_"), value),
        }
    }

    /// The number of the row of a series that is kept, as a constant.
    fn row_name(&self, row: Row) -> Ident {
        let stem = |value: Value| self.writer.locals.stem(value);
        let name = match row {
            Row::Value(value) => stem(value),
            Row::Sum(output) => format!("sum{output}"),
            Row::Fixed(constant) => format!("c{constant}"),
        };
        local(&name.to_uppercase())
    }

    /// All coefficients of a series that is kept.
    fn row(&self, row: Row) -> TokenStream {
        let (rows, name) = (local("rows"), self.row_name(row));
        quote!(#rows[#name])
    }

    /// Names the rows, in their order.
    fn row_names(&self) -> TokenStream {
        let mut kept: Vec<(usize, Row)> = self.plan.kept().map(|(&row, &at)| (at, row)).collect();
        kept.sort_unstable();
        let lines = kept.into_iter().map(|(at, row)| {
            let (name, at) = (self.row_name(row), index(at));
            quote!(const #name: usize = #at;)
        });
        quote!(#(#lines)*)
    }

    /// `rows[row][at] = value;`, if the row is kept.
    fn store(&self, row: Row, at: TokenStream, value: TokenStream) -> TokenStream {
        if self.plan.row(row).is_none() {
            return TokenStream::new();
        }
        let row = self.row(row);
        quote!(#row[#at] = #value;)
    }

    /// The coefficient of a value, if it has any.
    fn d(&self, value: Value) -> Option<TokenStream> {
        self.plan.varying[value.0].then(|| {
            let name = self.coefficient_of(value);
            quote!(#name)
        })
    }

    fn d_of_output(&self, output: usize) -> Option<TokenStream> {
        if self.plan.sums.contains_key(&output) {
            let name = sum_coefficient(output);
            return self.plan.sums[&output].then(|| quote!(#name));
        }
        self.d(self.plan.set[&output])
    }

    fn d_of_place(&self, place: ValueRef) -> Option<TokenStream> {
        match place {
            ValueRef::Node(output) => self.d_of_output(output),
            ValueRef::Zero | ValueRef::Constant(_) => None,
        }
    }

    /// Order 0 of everything.
    fn first(&self, elimination: &Elimination) -> TokenStream {
        let (writer, mode, plan) = (&self.writer, self.mode, self.plan);
        let number = &self.writer.number;
        let zero = quote!(0);
        let mut code = writer.declarations();
        code.extend(self.auxiliary_declarations());
        let n = mode.inputs.coordinates;
        let (q, v) = (local("q"), local("v"));
        for j in 0..n {
            let at = index(j);
            code.extend(self.store(
                Row::Value(mode.inputs.position(j)),
                zero.clone(),
                quote!(#q[#at]),
            ));
            code.extend(self.store(
                Row::Value(mode.inputs.velocity(j)),
                zero.clone(),
                quote!(#v[#at]),
            ));
        }
        let (time, one) = (local("t"), quote!(#number::of(1.0)));
        code.extend(self.store(Row::Value(Value(0)), zero.clone(), quote!(#time)));
        code.extend(self.store(Row::Value(Value(0)), quote!(1), one));
        for constant in plan.fixed() {
            let value = writer.coefficient(Coefficient::Constant(constant));
            code.extend(self.store(Row::Fixed(constant), zero.clone(), value));
        }
        code.extend(self.first_of(Phase::Assembly));
        code.extend(elimination.code.clone());
        let safe = local("safe");
        code.extend(quote! {
            if !#safe {
                return ::core::result::Result::Err(Refused::Pivot);
            }
        });
        let right = mode.system.right.iter().map(|place| match place {
            ValueRef::Zero => None,
            place => Some(writer.place(*place)),
        });
        let (solve, mut solution) = elimination.solve(writer, right.collect(), "");
        code.extend(solve);
        if mode.system.matrix.len() > mode.system.accelerations {
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
            let name = self.writer.value(value);
            code.extend(quote!(let #name = #x;));
            code.extend(self.keep_first(value));
        }
        code.extend(self.first_of(Phase::Balance));
        code.extend(self.first_of(Phase::Accelerations));
        for (j, place) in mode.accelerations.iter().enumerate() {
            if *place != ValueRef::Zero {
                let value = writer.place(*place);
                let velocity = mode.inputs.velocity(j);
                code.extend(self.store(Row::Value(velocity), quote!(1), value.clone()));
                if self.d_of_place(*place).is_some() {
                    let (before, now, at) = (self.before(velocity), self.now(velocity), index(j));
                    code.extend(quote!(let (mut #before, mut #now) = (#v[#at], #value);));
                }
            }
        }
        code.extend(self.first_of(Phase::Forces));
        for (r, place) in mode.forces.iter().enumerate() {
            if let Some(place) = place {
                let value = writer.place(*place);
                code.extend(self.store(Row::Value(mode.inputs.force(r)), zero.clone(), value));
            }
        }
        for (value, place) in value::results(mode) {
            let (name, result) = (self.writer.value(value), writer.place(place));
            code.extend(quote!(let #name = #result;));
            if value.0 < mode.inputs.force(0).0 {
                code.extend(self.keep_first(value));
            }
        }
        code.extend(self.first_of(Phase::Outputs));
        for &output in plan.sums.keys() {
            let sum = names::sum(output);
            code.extend(self.store(Row::Sum(output), zero.clone(), quote!(#sum)));
        }
        code
    }

    /// Inverses and auxiliary values that leave a block.
    fn auxiliary_declarations(&self) -> TokenStream {
        let blocks = self.mode.tape.blocks.iter();
        let steps = blocks
            .filter(|block| !block.needs.is_always())
            .flat_map(|block| &block.steps);
        let number = &self.writer.number;
        let lines = steps
            .filter(|step| self.plan.varying[step.value.0])
            .map(|step| {
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

    /// The loop over the orders from `first` on.
    fn orders_from(&self, first: usize, elimination: &Elimination) -> TokenStream {
        let (k, order, first) = (local("k"), local("order"), index(first));
        let body = self.next(elimination);
        quote! {
            for #k in #first..=#order {
                #body
            }
        }
    }

    /// One order, if it is asked for.
    fn order(&self, only: usize, elimination: &Elimination) -> TokenStream {
        let (k, order, only) = (local("k"), local("order"), index(only));
        let body = self.next(elimination);
        quote! {
            if #order < #only {
                return ::core::result::Result::Ok(());
            }
            {
                let #k: usize = #only;
                #body
            }
        }
    }

    /// Coefficient k of everything.
    fn next(&self, elimination: &Elimination) -> TokenStream {
        let (mode, plan) = (self.mode, self.plan);
        let number = &self.writer.number;
        let n = mode.inputs.coordinates;
        let (k, p, weight, share) = (local("k"), local("p"), local("weight"), local("share"));
        let mut body = TokenStream::new();
        // Sums over earlier coefficients.
        let always = plan.always(mode).into_iter();
        let mut products: Vec<_> = always.map(|one| self.named(one)).collect();
        for (i, j, product) in plan.system_products(mode) {
            products.push((system_product(i, j), product));
        }
        body.extend(self.sums(0, &products));
        let crossing = self.crossing.iter().filter(|value| plan.varying[value.0]);
        for value in crossing {
            let name = self.coefficient_of(*value);
            body.extend(quote!(let mut #name = #number::of(0.0);));
        }
        // Coefficient k of the inputs.
        let read = names::read(&mode.tape);
        if read.contains(&Value(0)) {
            let name = self.coefficient_of(Value(0));
            body.extend(quote!(let #name = #number::of(if #k == 1 { 1.0 } else { 0.0 });));
        }
        for j in 0..n {
            let (q, v) = (mode.inputs.position(j), mode.inputs.velocity(j));
            if !plan.varying[q.0] {
                continue;
            }
            let (dq, dv) = (self.coefficient_of(q), self.coefficient_of(v));
            let (before, now) = match self.d_of_place(mode.accelerations[j]) {
                Some(_) => {
                    let (before, now) = (self.before(v), self.now(v));
                    (quote!(#before), quote!(#now))
                }
                None => {
                    let velocity = self.row(Row::Value(v));
                    (quote!(#velocity[(#k - 1) & 31]), quote!(#velocity[#p]))
                }
            };
            body.extend(quote!(let #dq = #before * #share;));
            body.extend(self.store(Row::Value(q), quote!(#p), quote!(#dq)));
            if read.contains(&v) {
                body.extend(quote!(let #dv = #now;));
            }
        }
        body.extend(self.next_of(Phase::Assembly));
        for (&output, &varies) in &plan.sums {
            if varies && self.is_in(output, Phase::Assembly) {
                let d = sum_coefficient(output);
                body.extend(self.store(Row::Sum(output), quote!(#p), quote!(#d)));
            }
        }
        // The linear system.
        let mut right: Vec<Option<TokenStream>> = mode
            .system
            .right
            .iter()
            .map(|place| self.d_of_place(*place))
            .collect();
        if let Some(balance) = &mode.system.balance {
            // What is missing for a balance without coefficient k of the unknowns is what that must give.
            for unknown in self.added_unknowns() {
                let name = self.coefficient_of(unknown);
                body.extend(quote!(let #name = #number::of(0.0);));
            }
            body.extend(self.next_of(Phase::Balance));
            for (right, place) in right.iter_mut().zip(balance) {
                *right = self.d_of_place(*place).map(|d| quote!((-#d)));
            }
        }
        for (i, j, _) in plan.system_products(mode) {
            let w = self.writer.value(mode.inputs.unknown(j));
            let Some(d) = self.d_of_place(mode.system.matrix[i][j]) else {
                continue;
            };
            let earlier = system_product(i, j);
            right[i] = Some(match right[i].take() {
                None => quote!((-(#d * #w + #earlier))),
                Some(sum) => quote!((#sum - (#d * #w + #earlier))),
            });
        }
        let (solve, solution) = elimination.solve(&self.writer, right, "d");
        body.extend(solve);
        for (i, x) in solution.iter().enumerate() {
            let value = mode.inputs.unknown(i);
            let name = self.coefficient_of(value);
            body.extend(quote!(let #name = #x;));
            body.extend(self.keep_next(value));
        }
        body.extend(self.balance_with_unknowns());
        body.extend(self.next_of(Phase::Accelerations));
        for (j, place) in mode.accelerations.iter().enumerate() {
            if let Some(d) = self.d_of_place(*place) {
                let velocity = mode.inputs.velocity(j);
                let (before, now) = (self.before(velocity), self.now(velocity));
                let next = quote!(#d * #number::of(INVERSES[(#k + 1) & 31]));
                body.extend(quote!((#before, #now) = (#now, #next);));
                body.extend(self.store(Row::Value(velocity), quote!((#k + 1) & 31), quote!(#now)));
            }
        }
        body.extend(self.next_of(Phase::Forces));
        for (r, place) in mode.forces.iter().enumerate() {
            if let Some(d) = place.and_then(|place| self.d_of_place(place)) {
                body.extend(self.store(Row::Value(mode.inputs.force(r)), quote!(#p), d));
            }
        }
        for (value, place) in value::results(mode) {
            if let Some(d) = self.d_of_place(place) {
                let name = self.coefficient_of(value);
                body.extend(quote!(let #name = #d;));
                if value.0 < mode.inputs.force(0).0 {
                    body.extend(self.keep_next(value));
                }
            }
        }
        body.extend(self.next_of(Phase::Outputs));
        for (&output, &varies) in &plan.sums {
            if varies && !self.is_in(output, Phase::Assembly) {
                let d = sum_coefficient(output);
                body.extend(self.store(Row::Sum(output), quote!(#p), quote!(#d)));
            }
        }
        body.extend(self.keep_factors(0, &products));
        quote! {
            let #p = #k & 31;
            let #weight = #number::of(#k as f64);
            let #share = #number::of(INVERSES[#p]);
            #body
        }
    }

    /// Coefficient k of what the balance makes of the unknowns, once these are known.
    fn balance_with_unknowns(&self) -> TokenStream {
        let follows = self.mode.follows_unknowns();
        let multiplied = self.plan.multiplied(self.mode);
        let blocks = self.mode.blocks(Phase::Balance);
        let steps = blocks
            .filter(|block| block.needs.is_always())
            .flat_map(|block| &block.steps)
            .filter(|step| {
                let mut values = step.value.0..step.value.0 + step.operation.values();
                values.any(|value| follows[value] && multiplied[value])
            });
        let lines = steps.map(|step| self.kept_coefficient(step, true));
        quote!(#(#lines)*)
    }

    /// Coefficient k of a step, and into its rows. That of the unknowns is not there yet where it is not `known`.
    fn kept_coefficient(&self, step: &Step, known: bool) -> TokenStream {
        let line = self.coefficient(step, known);
        let kept =
            (0..step.operation.values()).map(|offset| self.keep_next(Value(step.value.0 + offset)));
        quote!(#line #(#kept)*)
    }

    /// Unknowns that stand in other operations of the balance than products of series.
    fn added_unknowns(&self) -> BTreeSet<Value> {
        let steps = self
            .mode
            .blocks(Phase::Balance)
            .flat_map(|block| &block.steps);
        let others = steps.filter(|step| match step.operation {
            Operation::Mul(x, y) => !(self.plan.varying[x.0] && self.plan.varying[y.0]),
            _ => true,
        });
        let operands = others.flat_map(|step| step.operation.operands());
        let writes = self
            .mode
            .blocks(Phase::Balance)
            .flat_map(|block| &block.writes);
        operands
            .chain(writes.map(|write| write.value))
            .filter(|value| self.is_unknown(*value))
            .collect()
    }

    fn is_unknown(&self, value: Value) -> bool {
        let inputs = self.mode.inputs;
        (0..inputs.unknowns).any(|i| inputs.unknown(i) == value)
    }

    /// Whether an output belongs to a phase.
    fn is_in(&self, output: usize, phase: Phase) -> bool {
        let mut writes = self.mode.blocks(phase).flat_map(|block| &block.writes);
        writes.any(|write| write.output == output)
    }

    fn named(&self, (value, at, product): (Value, usize, Product)) -> (Ident, Product) {
        (self.product(value, at), product)
    }

    /// Σ xⱼ yₖ₋ⱼ for 0 < j < k of all products, which are in groups from `first` on.
    fn sums(&self, first: usize, products: &[(Ident, Product)]) -> TokenStream {
        let (k, registers) = (local("k"), local("registers"));
        let (memory, newest) = (local("products"), local("newest"));
        let count = products.len().div_ceil(GROUP);
        let together = count.div_ceil(count.div_ceil(TOGETHER).max(1)).max(1);
        let loops = products.chunks(GROUP * together).enumerate();
        let loops = loops.map(|(at, products)| {
            let groups = products.chunks(GROUP).map(|group| {
                let names = group.iter().map(|(name, _)| name);
                let rest = (group.len()..GROUP).map(|_| quote!(_));
                quote!([#(#names,)* #(#rest),*])
            });
            let from = first + at * together;
            let factors = (from..from + products.len().div_ceil(GROUP)).map(|at| {
                let at = index(at);
                quote!((&#memory[#at], #newest[#at]))
            });
            quote! {
                let [#(#groups),*] = Products::sums(#registers, #k, [#(#factors),*]);
            }
        });
        quote!(#(#loops)*)
    }

    /// Keeps coefficient k of the factors of products.
    fn keep_factors(&self, first: usize, products: &[(Ident, Product)]) -> TokenStream {
        let registers = local("registers");
        let (memory, newest, p) = (local("products"), local("newest"), local("p"));
        let groups = products.chunks(GROUP).enumerate().map(|(at, group)| {
            let at = index(first + at);
            // Nobody reads the sums of what a group lacks: it repeats its last product.
            let filled = |place: usize| group[place.min(group.len() - 1)].1;
            let x = (0..GROUP).map(|place| self.factor(filled(place).0));
            let y = (0..GROUP).map(|place| self.factor(filled(place).1));
            quote!(#newest[#at] = #memory[#at].keep(#registers, #p, [#(#x),*], [#(#y),*]);)
        });
        quote!(#(#groups)*)
    }

    /// Coefficient k of a factor.
    fn factor(&self, factor: Factor) -> TokenStream {
        let number = &self.writer.number;
        let of = |value| self.d(value).unwrap_or(quote!(#number::of(0.0)));
        match factor {
            Factor::Value(value) => of(value),
            Factor::Weighted(value) => {
                let (d, weight) = (of(value), local("weight"));
                quote!(#d * #weight)
            }
            Factor::Auxiliary(value) => {
                let name = self.auxiliary_coefficient(value);
                quote!(#name)
            }
            Factor::Sum(output) => {
                let name = sum_coefficient(output);
                quote!(#name)
            }
        }
    }

    /// Coefficient k of the values of a phase.
    fn next_of(&self, phase: Phase) -> TokenStream {
        let blocks = self.mode.blocks(phase).map(|block| {
            let conditional = !block.needs.is_always();
            let products = self.plan.products_of(block).into_iter();
            let products: Vec<_> = products.map(|one| self.named(one)).collect();
            let first = if conditional {
                self.plan.first_group(block)
            } else {
                0
            };
            let sums = conditional.then(|| self.sums(first, &products));
            let factors = conditional.then(|| self.keep_factors(first, &products));
            let known = phase != Phase::Balance;
            let steps = block
                .steps
                .iter()
                .map(|step| self.kept_coefficient(step, known));
            let writes = self.next_writes(block);
            value::in_block(block, quote!(#sums #(#steps)* #factors #writes))
        });
        quote!(#(#blocks)*)
    }

    fn next_writes(&self, block: &Block) -> TokenStream {
        let number = &self.writer.number;
        let writes = block.writes.iter();
        let writes = writes.filter(|write| self.plan.sums.get(&write.output) == Some(&true));
        let lines = writes.map(|write| {
            let sum = sum_coefficient(write.output);
            match (write.mode, self.d(write.value)) {
                (Mode::Set, None) => quote!(let mut #sum = #number::of(0.0);),
                (Mode::Set, Some(d)) => quote!(let mut #sum = #d;),
                (_, None) => TokenStream::new(),
                (Mode::Add, Some(d)) => quote!(#sum = #sum + #d;),
                (Mode::Sub, Some(d)) => quote!(#sum = #sum - #d;),
            }
        });
        quote!(#(#lines)*)
    }

    fn keep_next(&self, value: Value) -> TokenStream {
        if !self.plan.varying[value.0] {
            return TokenStream::new();
        }
        let (d, p) = (self.coefficient_of(value), local("p"));
        self.store(Row::Value(value), quote!(#p), quote!(#d))
    }

    /// Coefficient k of a step. That of the unknowns is not there yet where it is not `known`.
    fn coefficient(&self, step: &Step, known: bool) -> TokenStream {
        if !self.plan.varying[step.value.0] {
            return TokenStream::new();
        }
        let number = &self.writer.number;
        let n = |value| self.writer.value(value);
        let share = local("share");
        let z = step.value;
        let s = |at: usize| self.product(z, at);
        let d = |x: Value| self.d(x);
        let i = self.inverse(z);
        let zero = || quote!(#number::of(0.0));
        let bind = |value: Value, result: TokenStream| {
            let name = self.coefficient_of(value);
            if self.crossing.contains(&value) {
                quote!(#name = #result;)
            } else {
                quote!(let #name = #result;)
            }
        };
        let twice = |x: TokenStream| quote!((#x + #x));
        // −(Σ zⱼ yₖ₋ⱼ)/y₀, j < k
        let divided = |dy: TokenStream| {
            let (z0, s) = (n(z), s(0));
            quote!((-(#z0 * #i)).fused(#dy, -(#s * #i)))
        };
        // What depends on coefficient k of an operand enters last, in one operation: each order waits for it.
        if let Some(power) = self.plan.power(z) {
            let (z0, dx, one, two) = (n(z), d(power.base), s(0), s(1));
            let e = names::float(power.exponent);
            let slope = quote!((#number::of(#e) * #z0 * #i));
            return bind(
                z,
                quote!(#slope.fused(#dx, (#number::of(#e) * #two - #one) * (#share * #i))),
            );
        }
        let result = match step.operation {
            Operation::Add(x, y) => match (d(x), d(y)) {
                (Some(x), Some(y)) => quote!(#x + #y),
                (Some(x), None) | (None, Some(x)) => x,
                (None, None) => zero(),
            },
            Operation::Sub(x, y) => match (d(x), d(y)) {
                (Some(x), Some(y)) => quote!(#x - #y),
                (Some(x), None) => x,
                (None, Some(y)) => quote!(-#y),
                (None, None) => zero(),
            },
            Operation::Neg(x) => {
                let x = d(x);
                quote!(-#x)
            }
            Operation::Offset(_, x) => {
                let x = d(x);
                quote!(#x)
            }
            Operation::Scale(c, x) => {
                let (c, x) = (self.writer.coefficient(c), d(x));
                quote!(#c * #x)
            }
            Operation::Mul(x, y) => {
                let (x0, y0) = (n(x), n(y));
                match (d(x), d(y)) {
                    (Some(_), Some(dy)) if !known && self.is_unknown(x) => {
                        let s = s(0);
                        quote!(#x0.fused(#dy, #s))
                    }
                    (Some(dx), Some(_)) if !known && self.is_unknown(y) => {
                        let s = s(0);
                        quote!(#y0.fused(#dx, #s))
                    }
                    (Some(dx), Some(dy)) => {
                        let s = s(0);
                        quote!(#x0.fused(#dy, #dx.fused(#y0, #s)))
                    }
                    (Some(dx), None) => quote!(#dx * #y0),
                    (None, Some(dy)) => quote!(#x0 * #dy),
                    (None, None) => zero(),
                }
            }
            Operation::Square(x) => {
                let (x0, dx, s) = (n(x), d(x), s(0));
                quote!((#x0 + #x0).fused(#dx, #s))
            }
            Operation::Div(x, y) => match (d(x), d(y).map(divided)) {
                (Some(dx), Some(rest)) => quote!(#i.fused(#dx, #rest)),
                (None, Some(rest)) => rest,
                (dx, None) => quote!(#dx * #i),
            },
            Operation::Ratio(_, y) => d(y).map_or_else(zero, divided),
            Operation::Sqrt(x) => {
                let (dx, s) = (d(x), s(0));
                quote!(#i.fused(#dx, -(#s * #i)))
            }
            Operation::Exp(x) => {
                let (z0, dx, s) = (n(z), d(x), s(0));
                quote!(#z0.fused(#dx, #s * #share))
            }
            Operation::Ln(x) => {
                let (dx, s) = (d(x), s(0));
                quote!(#i.fused(#dx, -(#s * (#share * #i))))
            }
            Operation::SinCos(x) | Operation::SinhCosh(x) => {
                let second = Value(z.0 + 1);
                let (z0, u0, dx) = (n(z), n(second), d(x));
                let (one, two) = (s(0), s(1));
                let first = bind(z, quote!(#u0.fused(#dx, #one * #share)));
                let other = quote!(#z0.fused(#dx, #two * #share));
                let other = match step.operation {
                    Operation::SinCos(_) => bind(second, quote!(-#other)),
                    _ => bind(second, other),
                };
                return quote!(#first #other);
            }
            Operation::Tan(x) | Operation::Tanh(x) => {
                let (z0, u0, dx, one, two) = (n(z), self.auxiliary(z), d(x), s(0), s(1));
                let first = bind(z, quote!(#u0.fused(#dx, #one * #share)));
                let dz = self.coefficient_of(z);
                let half = twice(quote!(#z0 * #dz));
                let change = match step.operation {
                    Operation::Tan(_) => quote!(#half + #two),
                    _ => quote!(-(#half + #two)),
                };
                let second = self.auxiliary_next(z, change);
                return quote!(#first #second);
            }
            Operation::Asin(x) | Operation::Acos(x) => {
                let (x0, dx) = (n(x), d(x));
                let (one, two, three) = (s(0), s(1), s(2));
                let half = twice(quote!(#x0 * #dx));
                let u = quote!(-(#half + #two + #three) * #number::of(0.5) * #i);
                let second = self.auxiliary_next(z, u);
                let turn = match step.operation {
                    Operation::Asin(_) => quote!(#dx),
                    _ => quote!((-#dx)),
                };
                let first = bind(z, quote!((#turn - #one * #share) * #i));
                return quote!(#first #second);
            }
            Operation::Atan(x) => {
                let (x0, dx, one, two) = (n(x), d(x), s(0), s(1));
                let half = twice(quote!(#x0 * #dx));
                let second = self.auxiliary_next(z, quote!(#half + #two));
                let first = bind(z, quote!((#dx - #one * #share) * #i));
                return quote!(#first #second);
            }
            Operation::Atan2(y, x) => {
                let (y0, x0) = (n(y), n(x));
                let (dy, dx) = (d(y).unwrap_or_else(zero), d(x).unwrap_or_else(zero));
                let [one, two, three, four, five] = [s(0), s(1), s(2), s(3), s(4)];
                let half = twice(quote!((#y0 * #dy + #x0 * #dx)));
                let second = self.auxiliary_next(z, quote!(#half + #four + #five));
                let earlier = quote!((#one - #two + #three) * #share);
                let first = bind(z, quote!((#dy * #x0 - #dx * #y0 - #earlier) * #i));
                return quote!(#first #second);
            }
            Operation::Select(branch, x, y) => {
                let (held, branch) = (local("held"), index(branch));
                let (x, y) = (d(x).unwrap_or_else(zero), d(y).unwrap_or_else(zero));
                quote!(if #held.branch(#branch) { #x } else { #y })
            }
            Operation::Powf(..) => unreachable!("a power has the rule of powers"),
            Operation::Constant(_) | Operation::Choose(..) => zero(),
        };
        bind(z, result)
    }

    /// Whether the rule of a step divides by something.
    fn needs_inverse(&self, step: &Step) -> bool {
        use Operation::*;
        let divides = matches!(
            step.operation,
            Div(..) | Ratio(..) | Sqrt(_) | Ln(_) | Asin(_) | Acos(_) | Atan(_) | Atan2(..)
        );
        divides || self.plan.power(step.value).is_some()
    }

    fn auxiliary_next(&self, value: Value, result: TokenStream) -> TokenStream {
        let name = self.auxiliary_coefficient(value);
        quote!(let #name = #result;)
    }
}

fn needs_auxiliary(operation: Operation) -> bool {
    use Operation::*;
    matches!(
        operation,
        Tan(_) | Tanh(_) | Asin(_) | Acos(_) | Atan(_) | Atan2(..)
    )
}
