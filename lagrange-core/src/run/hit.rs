//! What ends a step.

/// What happens first within a step.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Hit {
    /// Nothing: the whole step is good.
    Nothing,
    /// Guards of the mode fall through zero (`fallen` in the locator) at this part of the step.
    Guards(f64),
    /// A slip of two components has turned by a quarter within the step, which ends at this part of it; or one that fades has
    /// passed zero by its error.
    Turned(f64),
    /// Stop `index` becomes true at this part of the step.
    Stop(usize, f64),
}

impl Hit {
    /// Where the step ends.
    pub(super) fn end(&self) -> f64 {
        match *self {
            Hit::Nothing => 1.0,
            Hit::Guards(s) | Hit::Turned(s) | Hit::Stop(_, s) => s,
        }
    }
}
