//! The table that says what the numbers of the tapes mean: `lagrange_core::system::Description`.

use super::names::{self, index};
use crate::ast::Impacts;
use crate::derive::{Load, NeedId, OutputId};
use crate::model::{Condition, ItemName, Normal, Restitution, System, Watch};
use crate::plan::{Program, Tape};
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
    let constants = index(program.constants.outputs);
    let (motion, report) = (writer.shape(&program.motion), writer.shape(&program.report));

    let parameters = system.parameters.iter().map(|parameter| {
        let (name, documentation) = (&parameter.name, &parameter.documentation);
        let (unit, tex) = (&parameter.unit, &parameter.tex);
        quote!(#core::system::Parameter { name: #name, documentation: #documentation, unit: #unit, tex: #tex })
    });
    let coordinates =
        system
            .coordinates
            .iter()
            .zip(&structure.cyclic)
            .map(|(coordinate, cyclic)| {
                let (name, unit) = (&coordinate.name.text, &coordinate.unit);
                quote!(#core::system::Coordinate { name: #name, unit: #unit, cyclic: #cyclic })
            });
    let mass = structure.mass.iter().map(|(row, column, entry)| {
        let (row, column, entry) = (index(*row), index(*column), writer.place(*entry));
        quote!((#row, #column, #entry))
    });
    let forcing = writer.places(&structure.forcing);
    let (rows, couplings) = (writer.rows(), writer.couplings());
    let kinetic = system
        .kinetic
        .iter()
        .zip(&structure.kinetic)
        .map(|(term, need)| writer.effect(&term.name, *need));
    let potential = system
        .potential
        .iter()
        .zip(&structure.potential)
        .map(|(term, need)| writer.effect(&term.name, *need));
    let (constraints, contacts, frictions) =
        (writer.constraints(), writer.contacts(), writer.frictions());
    let forces = system
        .forces
        .iter()
        .zip(&structure.forces)
        .map(|(force, load)| writer.load(&force.name, load));
    let dissipations = system
        .dissipations
        .iter()
        .zip(&structure.dissipations)
        .map(|(item, load)| writer.load(&item.name, load));
    let (branches, energy) = (writer.branches(), writer.energy());
    let momenta = writer.places(&structure.momenta.0);
    let momenta_need = index(structure.momenta.1.0);
    let observes = system
        .observes
        .iter()
        .zip(&structure.observes)
        .enumerate()
        .map(|(i, (observe, (place, need)))| {
            let unit = system.units.observes.get(i).map_or("", String::as_str);
            let (name, place, need) = (&observe.name.text, writer.place(*place), index(need.0));
            quote!(#core::system::Observe { name: #name, place: #place, need: #need, unit: #unit })
        });
    let stops = system
        .stops
        .iter()
        .zip(&structure.stops)
        .map(|(watch, numbers)| writer.watch(watch, numbers));
    let marks = system
        .marks
        .iter()
        .zip(&structure.marks)
        .map(|(watch, numbers)| writer.watch(watch, numbers));
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
            forcing: #forcing,
            rows: &[#(#rows),*],
            couplings: &[#(#couplings),*],
            kinetic: &[#(#kinetic),*],
            potential: &[#(#potential),*],
            constraints: &[#(#constraints),*],
            contacts: &[#(#contacts),*],
            frictions: &[#(#frictions),*],
            forces: &[#(#forces),*],
            dissipations: &[#(#dissipations),*],
            branches: &[#(#branches),*],
            energy: #energy,
            momenta: #core::system::Momenta { places: #momenta, need: #momenta_need },
            observes: &[#(#observes),*],
            stops: &[#(#stops),*],
            marks: &[#(#marks),*],
            starts: &[#(#starts),*],
            units: #units,
            impacts: #core::system::Impacts::#impacts,
        }
    }
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
        match output {
            Some(output) => {
                let place = self.place(output);
                quote!(::core::option::Option::Some(#place))
            }
            None => quote!(::core::option::Option::None),
        }
    }

    fn shape(&self, tape: &Tape) -> TokenStream {
        let (core, slots, outputs) = (self.core(), index(tape.slots), index(tape.outputs));
        quote!(#core::system::TapeShape { slots: #slots, outputs: #outputs })
    }

    fn effect(&self, name: &ItemName, need: NeedId) -> TokenStream {
        let (core, text, need, optional) =
            (self.core(), &name.text, index(need.0), name.ident.is_some());
        quote!(#core::system::Effect { name: #text, need: #need, optional: #optional })
    }

    fn rows(&self) -> Vec<TokenStream> {
        let core = self.core();
        let rows = self.program.equations.structure.rows.iter().map(|row| {
            let jacobian = row.jacobian.iter().map(|(coordinate, entry)| {
                let (coordinate, entry) = (index(*coordinate), self.place(*entry));
                quote!((#coordinate, #entry))
            });
            let (bias, position, velocity) = (self.place(row.bias), self.maybe(row.position), self.place(row.velocity));
            let [a, b, c, d] = row.needs.map(|need| index(need.0));
            quote! {
                #core::system::Row {
                    jacobian: &[#(#jacobian),*],
                    bias: #bias,
                    position: #position,
                    velocity: #velocity,
                    needs: #core::system::RowNeeds { jacobian: #a, bias: #b, position: #c, velocity: #d },
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
            quote!(#core::system::Coupling { coordinate: #coordinate, row: #row, factor: #factor, need: #need })
        });
        couplings.collect()
    }

    fn constraints(&self) -> Vec<TokenStream> {
        let core = self.core();
        let constraints = self.program.equations.system.constraints.iter().enumerate();
        let constraints = constraints.map(|(row, constraint)| {
            let (name, row) = (&constraint.name.text, index(row));
            let while_contact = match constraint.while_contact {
                Some(contact) => {
                    let contact = index(contact);
                    quote!(::core::option::Option::Some(#contact))
                }
                None => quote!(::core::option::Option::None),
            };
            quote!(#core::system::Constraint { name: #name, row: #row, while_contact: #while_contact })
        });
        constraints.collect()
    }

    fn contacts(&self) -> Vec<TokenStream> {
        let core = self.core();
        let equations = &self.program.equations;
        let contacts = equations
            .system
            .contacts
            .iter()
            .zip(&equations.structure.contacts);
        let contacts = contacts.map(|(contact, numbers)| {
            let (name, row) = (&contact.name.text, index(numbers.row));
            let (normal_factor, region) = (
                self.maybe(numbers.normal_factor),
                self.maybe(numbers.region),
            );
            let (restitution, need) = (
                self.place(numbers.restitution),
                index(numbers.restitution_need.0),
            );
            let restitution = match contact.restitution {
                Restitution::Newton(_) => quote!(#core::system::Restitution::Newton(#restitution)),
                Restitution::Poisson(_) => {
                    quote!(#core::system::Restitution::Poisson(#restitution))
                }
            };
            quote! {
                #core::system::Contact {
                    name: #name,
                    row: #row,
                    normal_factor: #normal_factor,
                    restitution: #restitution,
                    restitution_need: #need,
                    region: #region,
                }
            }
        });
        contacts.collect()
    }

    fn frictions(&self) -> Vec<TokenStream> {
        let core = self.core();
        let equations = &self.program.equations;
        let frictions = equations
            .system
            .frictions
            .iter()
            .zip(&equations.structure.frictions);
        let frictions = frictions.map(|(friction, numbers)| {
            let (name, row, components) = (
                &friction.name.text,
                index(numbers.row),
                index(friction.slip.len()),
            );
            let normal = match (friction.normal, numbers.given_normal) {
                (Normal::Contact(contact), _) => {
                    let contact = index(contact);
                    quote!(#core::system::Normal::Contact(#contact))
                }
                (Normal::Constraint(constraint), _) => {
                    let constraint = index(constraint);
                    quote!(#core::system::Normal::Constraint(#constraint))
                }
                (Normal::Given(_), given) => {
                    let given = given.expect("a given normal force has an output");
                    let given = self.place(given);
                    quote!(#core::system::Normal::Given(#given))
                }
            };
            let (stick, slide) = (
                self.place(numbers.static_coefficient),
                self.place(numbers.kinetic_coefficient),
            );
            let need = index(numbers.coefficients_need.0);
            quote! {
                #core::system::Friction {
                    name: #name,
                    row: #row,
                    components: #components,
                    normal: #normal,
                    static_coefficient: #stick,
                    kinetic_coefficient: #slide,
                    coefficients_need: #need,
                }
            }
        });
        frictions.collect()
    }

    fn load(&self, name: &ItemName, load: &Load<OutputId>) -> TokenStream {
        let (core, name, need) = (self.core(), &name.text, index(load.need.0));
        let (value, power, report_need) = (
            self.place(load.value),
            self.place(load.power),
            index(load.report_need.0),
        );
        quote! {
            #core::system::Load {
                name: #name, need: #need, value: #value, power: #power, report_need: #report_need,
            }
        }
    }

    fn branches(&self) -> Vec<TokenStream> {
        let core = self.core();
        let equations = &self.program.equations;
        let branches = equations
            .system
            .branches
            .iter()
            .zip(&equations.structure.branches);
        let branches = branches.map(|(branch, numbers)| {
            let (guard, need, after_solve) = (self.place(numbers.guard), index(numbers.need.0), numbers.after_solve);
            let users = numbers.users.iter().map(|user| index(user.0));
            let text = &branch.text;
            quote! {
                #core::system::Branch {
                    guard: #guard, need: #need, after_solve: #after_solve, users: &[#(#users),*], text: #text,
                }
            }
        });
        branches.collect()
    }

    fn energy(&self) -> TokenStream {
        let core = self.core();
        let (kinetic, potential, jacobi, time_power, need) =
            self.program.equations.structure.energy;
        let (kinetic, potential) = (self.place(kinetic), self.place(potential));
        let (jacobi, time_power, need) =
            (self.place(jacobi), self.place(time_power), index(need.0));
        quote! {
            #core::system::Energy {
                kinetic: #kinetic, potential: #potential, jacobi: #jacobi, time_power: #time_power, need: #need,
            }
        }
    }

    fn watch(&self, watch: &Watch, (terms, need): &(Vec<OutputId>, NeedId)) -> TokenStream {
        let core = self.core();
        let (name, terms, need, zeros) = (
            &watch.name.text,
            self.places(terms),
            index(need.0),
            watch.zeros,
        );
        let conditions = watch.conditions.iter().map(|condition| {
            let (kind, item) = match condition {
                Condition::Closed(item) => (names::plain("Closed"), item),
                Condition::Open(item) => (names::plain("Open"), item),
                Condition::Sticks(item) => (names::plain("Sticks"), item),
                Condition::Slips(item) => (names::plain("Slips"), item),
            };
            let item = index(*item);
            quote!(#core::system::Condition::#kind(#item))
        });
        quote! {
            #core::system::Watch {
                name: #name, terms: #terms, conditions: &[#(#conditions),*], need: #need, zeros: #zeros,
            }
        }
    }
}
