//! Which system results belong to.

use crate::system::Description;
use core::fmt;

/// The system that numbers belong to: what the indices of items mean.
#[derive(Clone, Copy)]
pub(crate) struct Owner(pub &'static Description);

impl fmt::Debug for Owner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.name)
    }
}

impl PartialEq for Owner {
    fn eq(&self, other: &Owner) -> bool {
        self.0.name == other.0.name
    }
}
