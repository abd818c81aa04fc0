//! What stands beside the errors of a declaration: an `impl System` that type-checks and handles of its names, so that one mistake does not become an
//! error at every use of the struct.

use super::constants::{glimpsed, screaming};
use super::derivation;
use super::handles::{self, Indices};
use super::names;
use crate::parse::{Glimpse, glimpse};
use crate::sorted::SortedSet;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::{DeriveInput, GenericParam};

/// An implementation without equations for whatever struct the tokens are, with handles of the names that they seem to declare; nothing if they
/// are none.
pub fn fallback(input: TokenStream) -> TokenStream {
    let Ok(input) = syn::parse2::<DeriveInput>(input) else {
        return TokenStream::new();
    };
    let seen = glimpse(&input);
    let core = seen.core.clone();
    let core = core.unwrap_or_else(|| quote!(::lagrange_core));
    let mut tokens = implementation(&input, &core);
    if input.generics.const_params().next().is_none() {
        tokens.extend(placeholders(&input, &seen, &core));
    }
    tokens
}

/// Handles of all names, so that their uses are not reported as well.
fn placeholders(input: &DeriveInput, seen: &Glimpse, core: &TokenStream) -> TokenStream {
    // How many elements an indexed item has is not known here: enough for every index that is used.
    let many = [0; 1024];
    let (mut handles, mut taken) = (Vec::new(), SortedSet::new());
    for constant in glimpsed(seen) {
        let name = screaming(&constant.name.ident);
        if taken.insert(name.to_string()) {
            let indices = match constant.indexed {
                true => Indices::Many(&many),
                false => Indices::One(0),
            };
            let text = "Not derived.";
            handles.push(handles::handle(core, &name, constant.kind, indices, text));
        }
    }
    let target = applied(input, |_| quote!(f64));
    let mut tokens = handles::inherent(target.clone(), &handles);
    tokens.extend(derivation::nothing(target, core));
    tokens
}

/// The struct with what stands for its type parameters; its references may last for ever.
fn applied(input: &DeriveInput, of: impl Fn(&syn::TypeParam) -> TokenStream) -> TokenStream {
    let name = &input.ident;
    let arguments = input
        .generics
        .params
        .iter()
        .map(|parameter| match parameter {
            GenericParam::Lifetime(_) => quote!('static),
            GenericParam::Type(parameter) => of(parameter),
            GenericParam::Const(parameter) => parameter.ident.to_token_stream(),
        });
    let arguments: Vec<TokenStream> = arguments.collect();
    match arguments.is_empty() {
        true => quote!(#name),
        false => quote!(#name<#(#arguments),*>),
    }
}

fn implementation(input: &DeriveInput, core: &TokenStream) -> TokenStream {
    let mut generics = input.generics.clone();
    let scalar = generics
        .type_params()
        .next()
        .map(|parameter| parameter.ident.clone());
    for parameter in generics.type_params_mut() {
        parameter
            .bounds
            .push(syn::parse_quote!(#core::arithmetic::Scalar));
    }
    let scalar = scalar.map_or(quote!(f64), |scalar| quote!(#scalar));
    if generics.lifetimes().next().is_some() {
        let params = core::mem::take(&mut generics.params).into_iter();
        let others = params.filter(|parameter| !matches!(parameter, GenericParam::Lifetime(_)));
        (generics.params, generics.where_clause) = (others.collect(), None);
    }
    let target = applied(input, |parameter| parameter.ident.to_token_stream());
    let (parameters, _, conditions) = generics.split_for_impl();
    let (description, read_tables) = (empty(core), names::read_tables(core));
    quote! {
        #[automatically_derived]
        impl #parameters #core::system::System for #target #conditions {
            type Scalar = #scalar;
            fn copy(&self) -> Self {
                ::core::unreachable!()
            }
            #read_tables
            fn parameter(&self, _: usize) -> Self::Scalar {
                ::core::unreachable!()
            }
            fn set_parameter(&mut self, _: usize, _: Self::Scalar) {
                ::core::unreachable!()
            }
            fn start(&self, _: usize, _: Self::Scalar, _: &mut [Self::Scalar], _: &mut [Self::Scalar]) {
                ::core::unreachable!()
            }
        }

        #[automatically_derived]
        impl #parameters #core::system::Derived for #target #conditions {
            const DESCRIPTION: &'static #core::system::Description = &#description;
            const DECLARATION: &'static #core::__private::declaration::Declaration = &#core::__private::declaration::Declaration::NONE;
        }
    }
}

/// A description of nothing.
fn empty(core: &TokenStream) -> TokenStream {
    quote! {
        #core::system::Description {
            name: "",
            documentation: "",
            parameters: &[],
            coordinates: &[],
            needs: 0,
            constants: #core::__private::program::Encoded::NONE,
            motion: #core::__private::program::Encoded::NONE,
            report: #core::__private::program::Encoded::NONE,
            mass: &[],
            inertia: ::core::option::Option::None,
            forcing: &[],
            rows: &[],
            couplings: &[],
            watched_rows: &[],
            kinetic: &[],
            potential: &[],
            constraints: &[],
            contacts: &[],
            frictions: &[],
            resultants: &[],
            forces: &[],
            dissipations: &[],
            branches: &[],
            energy: #core::__private::places::Energy {
                kinetic: #core::__private::program::ValueRef::Zero,
                potential: #core::__private::program::ValueRef::Zero,
                jacobi: #core::__private::program::ValueRef::Zero,
                time_power: #core::__private::program::ValueRef::Zero,
                need: 0,
            },
            momenta: #core::__private::places::Momenta { places: &[], need: 0 },
            observes: &[],
            stops: &[],
            marks: &[],
            starts: &[],
            impacts: #core::system::Impacts::Together,
            units: #core::system::Units::NONE,
        }
    }
}
