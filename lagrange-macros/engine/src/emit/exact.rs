//! The table of exact numbers that words of emitted data name by their places.

use super::names;
use proc_macro2::TokenStream;
use quote::quote;
use std::collections::HashMap;

/// Numbers, each once.
#[derive(Default)]
pub struct Exact {
    numbers: Vec<f64>,
    /// Places of the numbers, by their bits.
    known: HashMap<u64, usize>,
}

impl Exact {
    /// The place of a number.
    pub fn place(&mut self, number: f64) -> usize {
        let next = self.numbers.len();
        let place = *self.known.entry(number.to_bits()).or_insert(next);
        if place == next {
            self.numbers.push(number);
        }
        place
    }

    /// `&[…]`
    pub fn table(&self) -> TokenStream {
        let numbers = self.numbers.iter().map(|number| names::f64(*number));
        quote!(&[#(#numbers),*])
    }
}
