//! Where names are declared, for messages about a run.

use super::{Declaration, ItemKind, Name};
use crate::diagnostics::Extent;

impl Declaration {
    /// Fields, coordinates and the items that can be left out, each with its line and column, from 1.
    pub fn places(&self) -> Vec<(String, usize, usize)> {
        let fields = self.fields.iter().map(|field| &field.name);
        let items = self.items.iter().flat_map(|item| match &item.kind {
            ItemKind::Coordinates(coordinates) => coordinates
                .iter()
                .map(|coordinate| &coordinate.name)
                .collect(),
            _ => Vec::from_iter(item.name()),
        });
        let place = |name: &Name| {
            let (line, column) = Extent::from(name.ident.span()).place();
            (name.text.clone(), line, column)
        };
        fields.chain(items).map(place).collect()
    }
}
