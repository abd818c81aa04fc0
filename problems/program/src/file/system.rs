//! A system that is data: tables that were read, and numbers for its parameters.

use lagrange_core::__private::declaration::Declaration;
use lagrange_core::Derivation;
use lagrange_core::system::{Description, System};
use lagrange_engine::interpret;
use lagrange_engine::plan::Start;

/// What all systems of one file have in common.
pub(super) struct Tables {
    pub description: Description,
    pub declaration: Declaration,
    pub derivation: Derivation,
    pub starts: Vec<Start>,
}

/// A system of a file. No functions are emitted for its modes: the core interprets their equations.
#[derive(Clone)]
pub(super) struct FileSystem {
    pub tables: &'static Tables,
    pub parameters: Vec<f64>,
}

impl System for FileSystem {
    type Scalar = f64;

    fn copy(&self) -> Self {
        self.clone()
    }

    fn description(&self) -> &'static Description {
        &self.tables.description
    }

    fn declaration(&self) -> &'static Declaration {
        &self.tables.declaration
    }

    fn derivation(&self) -> &'static Derivation {
        &self.tables.derivation
    }

    fn parameter(&self, index: usize) -> f64 {
        self.parameters[index]
    }

    fn set_parameter(&mut self, index: usize, value: f64) {
        self.parameters[index] = value;
    }

    fn start(&self, index: usize, t: f64, q: &mut [f64], v: &mut [f64]) {
        interpret::start(&self.tables.starts[index], &self.parameters, t, q, v);
    }
}
