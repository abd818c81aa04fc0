//! What stands beside the errors of a declaration: an `impl System` that type-checks, so that one mistake does not
//! become an error at every use of the struct.

use super::names::plain;
use proc_macro2::TokenStream;
use quote::quote;
use syn::DeriveInput;

/// An implementation without equations for whatever struct the tokens are; nothing if they are none.
pub fn fallback(input: TokenStream) -> TokenStream {
    let Ok(input) = syn::parse2::<DeriveInput>(input) else {
        return TokenStream::new();
    };
    let core = quote!(::lagrange_core);
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
    let (name, arithmetic) = (&input.ident, plain("LagrangeArithmetic"));
    let (parameters, arguments, conditions) = generics.split_for_impl();
    let tape = |method: &str| {
        let method = plain(method);
        quote! {
            fn #method<#arithmetic: #core::arithmetic::Arithmetic<Scalar = Self::Scalar>>(
                &self,
                _: &mut #arithmetic,
                _: &#core::system::Held,
                _: &[Self::Scalar],
                _: &[#arithmetic::Node],
                _: &mut [#arithmetic::Node],
            ) {
                ::core::unreachable!()
            }
        }
    };
    let (motion, report, description) = (tape("motion"), tape("report"), empty(&core));
    quote! {
        #[automatically_derived]
        impl #parameters #core::system::System for #name #arguments #conditions {
            type Scalar = #scalar;
            const DESCRIPTION: &'static #core::system::Description = &#description;
            fn parameter(&self, _: usize) -> Self::Scalar {
                ::core::unreachable!()
            }
            fn set_parameter(&mut self, _: usize, _: Self::Scalar) {
                ::core::unreachable!()
            }
            fn start(&self, _: usize, _: Self::Scalar, _: &mut [Self::Scalar], _: &mut [Self::Scalar]) {
                ::core::unreachable!()
            }
            fn constants(&self, _: &#core::system::Held, _: &mut [Self::Scalar]) {
                ::core::unreachable!()
            }
            #motion
            #report
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
            constants: 0,
            motion: #core::system::TapeShape { slots: 0, outputs: 0 },
            report: #core::system::TapeShape { slots: 0, outputs: 0 },
            mass: &[],
            forcing: &[],
            rows: &[],
            couplings: &[],
            kinetic: &[],
            potential: &[],
            constraints: &[],
            contacts: &[],
            frictions: &[],
            forces: &[],
            dissipations: &[],
            branches: &[],
            energy: #core::system::Energy {
                kinetic: #core::system::Place::Zero,
                potential: #core::system::Place::Zero,
                jacobi: #core::system::Place::Zero,
                time_power: #core::system::Place::Zero,
                need: 0,
            },
            momenta: #core::system::Momenta { places: &[], need: 0 },
            observes: &[],
            stops: &[],
            marks: &[],
            starts: &[],
        }
    }
}
