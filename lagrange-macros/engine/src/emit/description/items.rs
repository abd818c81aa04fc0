//! Entries for effects, constraints, contacts, frictions, loads, branches and outputs.

use super::{Writer, each};
use crate::derive::{Load, NeedId, OutputId};
use crate::emit::names::{self, index};
use crate::model::{Condition, ItemName, Normal, Restitution, Watch};
use proc_macro2::TokenStream;
use quote::quote;

impl Writer<'_> {
    pub(super) fn effect(&self, name: &ItemName, need: NeedId) -> TokenStream {
        let (core, text, need, optional) =
            (self.core(), &name.text, index(need.0), name.ident.is_some());
        quote!(#core::system::Effect { name: #text, need: #need, optional: #optional })
    }

    pub(super) fn constraints(&self) -> Vec<TokenStream> {
        let core = self.core();
        let constraints = self.program.equations.system.constraints.iter().enumerate();
        let constraints = constraints.map(|(row, constraint)| {
            let (name, row) = (&constraint.name.text, index(row));
            let [while_contact, attitude] = [constraint.while_contact, constraint.attitude]
                .map(|place| names::option(place.map(index)));
            quote! {
                #core::system::Constraint {
                    name: #name, row: #row, while_contact: #while_contact, attitude: #attitude,
                }
            }
        });
        constraints.collect()
    }

    pub(super) fn contacts(&self) -> Vec<TokenStream> {
        let core = self.core();
        let equations = &self.program.equations;
        let (declared, derived) = (&equations.system.contacts, &equations.structure.contacts);
        each(declared, derived, |contact, numbers| {
            let (name, row) = (&contact.name.text, index(numbers.row));
            let (normal_factor, region) = (
                self.maybe(numbers.normal_factor),
                self.maybe(numbers.region),
            );
            let (restitution, need) = (
                self.place(numbers.restitution),
                index(numbers.restitution_need.0),
            );
            let parameters = self.parameters_of([numbers.restitution]);
            let restitution = match contact.restitution {
                Restitution::Newton(_) => {
                    quote!(#core::__private::places::Restitution::Newton(#restitution))
                }
                Restitution::Poisson(_) => {
                    quote!(#core::__private::places::Restitution::Poisson(#restitution))
                }
            };
            quote! {
                #core::system::Contact {
                    name: #name,
                    row: #row,
                    normal_factor: #normal_factor,
                    restitution: #restitution,
                    restitution_need: #need,
                    restitution_parameters: #parameters,
                    region: #region,
                }
            }
        })
    }

    pub(super) fn resultants(&self) -> Vec<TokenStream> {
        let resultants = self.program.equations.system.resultants.iter();
        let list = |constraints: &Vec<usize>| {
            let constraints = constraints.iter().copied().map(index);
            quote!(&[#(#constraints),*])
        };
        resultants.map(list).collect()
    }

    pub(super) fn frictions(&self) -> Vec<TokenStream> {
        let core = self.core();
        let equations = &self.program.equations;
        let (declared, derived) = (&equations.system.frictions, &equations.structure.frictions);
        each(declared, derived, |friction, numbers| {
            let (name, row, components) = (
                &friction.name.text,
                index(numbers.row),
                index(friction.slip.len()),
            );
            let normal = match (friction.normal, numbers.given_normal) {
                (Normal::Contact(contact), _) => {
                    let contact = index(contact);
                    quote!(#core::__private::places::Normal::Contact(#contact))
                }
                (Normal::Constraint(constraint), _) => {
                    let constraint = index(constraint);
                    quote!(#core::__private::places::Normal::Constraint(#constraint))
                }
                (Normal::Resultant(resultant), _) => {
                    let resultant = index(resultant);
                    quote!(#core::__private::places::Normal::Resultant(#resultant))
                }
                (Normal::Given(_), given) => {
                    let given = given.expect("a given normal force has an output");
                    let given = self.place(given);
                    quote!(#core::__private::places::Normal::Given(#given))
                }
            };
            let (stick, slide) = (
                self.place(numbers.static_coefficient),
                self.place(numbers.kinetic_coefficient),
            );
            let need = index(numbers.coefficients_need.0);
            let (rests, slides) = (
                self.parameters_of([numbers.static_coefficient]),
                self.parameters_of([numbers.kinetic_coefficient]),
            );
            quote! {
                #core::system::Friction {
                    name: #name,
                    row: #row,
                    components: #components,
                    normal: #normal,
                    static_coefficient: #stick,
                    kinetic_coefficient: #slide,
                    coefficients_need: #need,
                    static_parameters: #rests,
                    kinetic_parameters: #slides,
                }
            }
        })
    }

    pub(super) fn load(&self, name: &ItemName, load: &Load<OutputId>) -> TokenStream {
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

    pub(super) fn branches(&self) -> Vec<TokenStream> {
        let core = self.core();
        let equations = &self.program.equations;
        let (declared, derived) = (&equations.system.branches, &equations.structure.branches);
        each(declared, derived, |branch, numbers| {
            let (guard, need, after_solve) = (
                self.place(numbers.guard),
                index(numbers.need.0),
                numbers.after_solve,
            );
            let users = numbers.users.iter().map(|user| index(user.0));
            let (then, otherwise) = (&branch.then, &branch.otherwise);
            quote! {
                #core::__private::places::Branch {
                    guard: #guard, need: #need, after_solve: #after_solve, users: &[#(#users),*],
                    then: #then, otherwise: #otherwise,
                }
            }
        })
    }

    pub(super) fn watch(
        &self,
        watch: &Watch,
        (terms, need): &(Vec<OutputId>, NeedId),
    ) -> TokenStream {
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
            quote!(#core::__private::places::Condition::#kind(#item))
        });
        quote! {
            #core::system::Watch {
                name: #name, terms: #terms, conditions: &[#(#conditions),*], need: #need, zeros: #zeros,
            }
        }
    }

    pub(super) fn observes(&self) -> Vec<TokenStream> {
        let core = self.core();
        let equations = &self.program.equations;
        let units = &equations.system.units.observes;
        // Without any unit in a declaration there are none.
        let units = units
            .iter()
            .map(String::as_str)
            .chain(std::iter::repeat(""));
        let derived = equations.structure.observes.iter().zip(units);
        let derived: Vec<_> = derived.collect();
        each(
            &equations.system.observes,
            &derived,
            |observe, ((place, need), unit)| {
                let (name, place, need) = (&observe.name.text, self.place(*place), index(need.0));
                quote!(#core::system::Observe { name: #name, place: #place, need: #need, unit: #unit })
            },
        )
    }
}
