//! Names of faces while they are collected.

use std::collections::BTreeMap;

use crate::shape::document::{Layer, NO_ROW, On, Role, Values};

/// Names in the order of their first appearance, and one or none of them for each face so far.
#[derive(Default)]
pub(super) struct Names {
    names: Vec<String>,
    /// The row of each name.
    rows: BTreeMap<String, u32>,
    /// The row of each face, or [`NO_ROW`].
    pub of: Vec<u32>,
}

impl Names {
    /// The row of a name.
    pub fn row(&mut self, name: &str) -> u32 {
        if let Some(&row) = self.rows.get(name) {
            return row;
        }
        let row = self.names.len() as u32;
        self.rows.insert(name.to_owned(), row);
        self.names.push(name.to_owned());
        row
    }

    /// The names as a layer, if any face has one.
    pub fn layer(self, role: Role) -> Option<Layer> {
        let used = self.of.iter().any(|&row| row != NO_ROW);
        used.then(|| Layer {
            name: String::new(),
            on: On::Face,
            role,
            values: Values::Names {
                names: self.names,
                of: self.of,
            },
        })
    }
}
