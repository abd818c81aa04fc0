//! Why a text is no unit.

/// Why a text is not a unit that can be used.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(in crate::model) enum Refusal {
    /// This symbol is not known; what may be meant.
    Unknown(String, String),
    /// It is a multiple of this coherent unit.
    Multiple(String),
    /// What is wrong with its form, and what to do.
    Form(String, String),
}

/// Its form is wrong.
pub(super) fn form(what: &str, hint: &str) -> Refusal {
    Refusal::Form(what.to_string(), hint.to_string())
}
