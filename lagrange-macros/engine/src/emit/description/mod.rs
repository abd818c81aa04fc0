//! The table that says what the numbers of the tapes mean: `lagrange_core::system::Description`.

mod items;

use super::encoded::encoded;
use super::names::{self, index};
use crate::ast::{Domain, Impacts};
use crate::derive::{Equations, NeedId, OutputId};
use crate::model::{EnergyTerm, System, Watch};
use crate::plan::Program;
use crate::sorted::SortedSet;
use crate::symbolic::Symbol;
use proc_macro2::TokenStream;
use quote::quote;

/// `Description { … }`
pub fn description(program: &Program) -> TokenStream {
    let equations = &program.equations;
    let (system, structure) = (&equations.system, &equations.structure);
    let core = &system.core;
    let writer = Writer { program };
    let (name, documentation) = (system.name.to_string(), &system.documentation);
    let needs = index(equations.needs.len());
    let [constants, motion, report] = [&program.constants, &program.motion, &program.report]
        .map(|tape| encoded(&program.equations.system, tape));
    let (parameters, coordinates) = (writer.parameters(), writer.coordinates());
    let (mass, forcing) = (writer.mass(), writer.places(&structure.forcing));
    let inertia = writer.inertia();
    let (rows, couplings) = (writer.rows(), writer.couplings());
    let watched_rows = system.watched_rows().into_iter().map(index);
    let effect = |term: &EnergyTerm, need: &NeedId| writer.effect(&term.name, *need);
    let kinetic = each(&system.kinetic, &structure.kinetic, effect);
    let potential = each(&system.potential, &structure.potential, effect);
    let constraints = writer.constraints();
    let (contacts, frictions) = (writer.contacts(), writer.frictions());
    let resultants = writer.resultants();
    let forces = each(&system.forces, &structure.forces, |force, load| {
        writer.load(&force.name, load)
    });
    let dissipations = each(
        &system.dissipations,
        &structure.dissipations,
        |item, load| writer.load(&item.name, load),
    );
    let (branches, energy) = (writer.branches(), writer.energy());
    let momenta = writer.places(&structure.momenta.0);
    let momenta_need = index(structure.momenta.1.0);
    let observes = writer.observes();
    let watch = |watch: &Watch, numbers: &(Vec<OutputId>, NeedId)| writer.watch(watch, numbers);
    let stops = each(&system.stops, &structure.stops, watch);
    let marks = each(&system.marks, &structure.marks, watch);
    let starts = system.starts.iter().map(|start| &start.name.text);
    let units = units(system);
    let impacts = match system.impacts {
        Impacts::Together => quote!(Together),
        Impacts::InTurn => quote!(InTurn),
    };
    quote! {
        #core::system::Description {
            name: #name,
            documentation: #documentation,
            parameters: &[#(#parameters),*],
            coordinates: &[#(#coordinates),*],
            needs: #needs,
            constants: #constants,
            motion: #motion,
            report: #report,
            mass: &[#(#mass),*],
            inertia: #inertia,
            forcing: #forcing,
            rows: &[#(#rows),*],
            couplings: &[#(#couplings),*],
            watched_rows: &[#(#watched_rows),*],
            kinetic: &[#(#kinetic),*],
            potential: &[#(#potential),*],
            constraints: &[#(#constraints),*],
            contacts: &[#(#contacts),*],
            frictions: &[#(#frictions),*],
            resultants: &[#(#resultants),*],
            forces: &[#(#forces),*],
            dissipations: &[#(#dissipations),*],
            branches: &[#(#branches),*],
            energy: #energy,
            momenta: #core::__private::places::Momenta { places: #momenta, need: #momenta_need },
            observes: &[#(#observes),*],
            stops: &[#(#stops),*],
            marks: &[#(#marks),*],
            starts: &[#(#starts),*],
            units: #units,
            impacts: #core::system::Impacts::#impacts,
        }
    }
}

/// What is declared with what was derived from it.
fn each<A, B>(
    declared: &[A],
    derived: &[B],
    write: impl Fn(&A, &B) -> TokenStream,
) -> Vec<TokenStream> {
    let pairs = declared.iter().zip(derived);
    pairs.map(|(a, b)| write(a, b)).collect()
}

/// `Units { … }`
fn units(system: &System) -> TokenStream {
    let (core, units) = (&system.core, &system.units);
    let (energy, forces, dissipations) = (&units.energy, &units.forces, &units.dissipations);
    let frictions = system.frictions.iter().zip(&units.frictions);
    let frictions = frictions.flat_map(|(friction, unit)| friction.slip.iter().map(move |_| unit));
    let rows = units
        .constraints
        .iter()
        .chain(&units.contacts)
        .chain(frictions);
    quote! {
        #core::system::Units {
            energy: #energy, rows: &[#(#rows),*], forces: &[#(#forces),*], dissipations: &[#(#dissipations),*],
        }
    }
}

/// Writes parts of the table.
struct Writer<'a> {
    program: &'a Program,
}

impl Writer<'_> {
    fn core(&self) -> &TokenStream {
        &self.program.equations.system.core
    }

    fn place(&self, output: OutputId) -> TokenStream {
        names::place(&self.program.equations.system, self.program.place(output))
    }

    fn places(&self, outputs: &[OutputId]) -> TokenStream {
        let places = outputs.iter().map(|output| self.place(*output));
        quote!(&[#(#places),*])
    }

    fn maybe(&self, output: Option<OutputId>) -> TokenStream {
        names::option(output.map(|output| self.place(output)))
    }

    fn parameters(&self) -> Vec<TokenStream> {
        let core = self.core();
        let parameters = self.program.equations.system.parameters.iter();
        let parameters = parameters.map(|parameter| {
            let (name, documentation) = (&parameter.name, &parameter.documentation);
            let (unit, tex) = (&parameter.unit, &parameter.tex);
            let domain = match parameter.domain {
                None => quote!(Any),
                Some(Domain::Positive) => quote!(Positive),
                Some(Domain::NonNegative) => quote!(NonNegative),
            };
            let domain = quote!(#core::system::Domain::#domain);
            quote!(#core::system::Parameter { name: #name, documentation: #documentation, unit: #unit, tex: #tex, domain: #domain })
        });
        parameters.collect()
    }

    fn coordinates(&self) -> Vec<TokenStream> {
        let core = self.core();
        let equations = &self.program.equations;
        let (declared, cyclic) = (&equations.system.coordinates, &equations.structure.cyclic);
        each(declared, cyclic, |coordinate, cyclic| {
            let (name, unit) = (&coordinate.name.text, &coordinate.unit);
            quote!(#core::system::Coordinate { name: #name, unit: #unit, cyclic: #cyclic })
        })
    }

    fn mass(&self) -> Vec<TokenStream> {
        let entries = self.program.equations.structure.mass.iter();
        let entries = entries.map(|(row, column, entry)| {
            let (row, column, entry) = (index(*row), index(*column), self.place(*entry));
            quote!((#row, #column, #entry))
        });
        entries.collect()
    }

    /// The parameters that the kinetic energy's inertia consists of.
    fn inertia(&self) -> TokenStream {
        let equations = &self.program.equations;
        let parameters = (!equations.system.from_lagrangian).then(|| {
            let entries = equations.structure.mass.iter();
            self.parameters_of(entries.map(|(_, _, entry)| *entry))
        });
        names::option(parameters)
    }

    /// The parameters that outputs contain, by index.
    fn parameters_of(&self, outputs: impl IntoIterator<Item = OutputId>) -> TokenStream {
        let Equations {
            system,
            outputs: all,
            ..
        } = &self.program.equations;
        let terms = outputs.into_iter().flat_map(|output| &all[output.0].terms);
        let symbols: SortedSet<Symbol> = terms.flat_map(|(_, e)| system.pool.symbols(*e)).collect();
        let parameters = system.parameters.iter().enumerate();
        let contained = parameters
            .filter(|(_, parameter)| symbols.contains(&parameter.symbol))
            .map(|(i, _)| index(i));
        quote!(&[#(#contained),*])
    }

    fn rows(&self) -> Vec<TokenStream> {
        let core = self.core();
        let rows = self.program.equations.structure.rows.iter().map(|row| {
            let jacobian = row.jacobian.iter().map(|(coordinate, entry)| {
                let (coordinate, entry) = (index(*coordinate), self.place(*entry));
                quote!((#coordinate, #entry))
            });
            let (bias, position, velocity) = (self.place(row.bias), self.maybe(row.position), self.place(row.velocity));
            let rheonomic = row.rheonomic;
            let [a, b, c, d] = row.needs.map(|need| index(need.0));
            quote! {
                #core::__private::places::Row {
                    jacobian: &[#(#jacobian),*],
                    bias: #bias,
                    position: #position,
                    velocity: #velocity,
                    rheonomic: #rheonomic,
                    needs: #core::__private::places::RowNeeds { jacobian: #a, bias: #b, position: #c, velocity: #d },
                }
            }
        });
        rows.collect()
    }

    fn couplings(&self) -> Vec<TokenStream> {
        let core = self.core();
        let couplings = self.program.equations.structure.couplings.iter().map(|coupling| {
            let (coordinate, row) = (index(coupling.coordinate), index(coupling.row));
            let (factor, need) = (self.place(coupling.factor), index(coupling.need.0));
            quote!(#core::__private::places::Coupling { coordinate: #coordinate, row: #row, factor: #factor, need: #need })
        });
        couplings.collect()
    }

    fn energy(&self) -> TokenStream {
        let core = self.core();
        let (kinetic, potential, jacobi, time_power, need) =
            self.program.equations.structure.energy;
        let (kinetic, potential) = (self.place(kinetic), self.place(potential));
        let (jacobi, time_power, need) =
            (self.place(jacobi), self.place(time_power), index(need.0));
        quote! {
            #core::__private::places::Energy {
                kinetic: #kinetic, potential: #potential, jacobi: #jacobi, time_power: #time_power, need: #need,
            }
        }
    }
}
