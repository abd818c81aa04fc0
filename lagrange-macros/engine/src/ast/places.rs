//! Where names are declared, for messages about a run.

use super::{Declaration, ItemKind, Name};

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
            let start = name.ident.span().start();
            (name.text.clone(), start.line, start.column + 1)
        };
        fields.chain(items).map(place).collect()
    }
}
