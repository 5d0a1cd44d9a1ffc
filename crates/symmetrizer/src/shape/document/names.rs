//! Building a layer of names.

use std::collections::HashMap;

use super::layer::{NO_ROW, Values};

/// Collects the name, or none, of one element after the other.
#[derive(Debug, Default)]
pub struct NameList {
    names: Vec<String>,
    known: HashMap<String, u32>,
    of: Vec<u32>,
}

impl NameList {
    /// The next element has this name.
    pub fn push(&mut self, name: Option<&str>) {
        let row = name.map_or(NO_ROW, |name| self.row(name));
        self.of.push(row);
    }

    /// The values, where some element has a name; names stand in the order of their first use.
    pub fn finish(self) -> Option<Values> {
        let Self { names, of, .. } = self;
        (!names.is_empty()).then_some(Values::Names { names, of })
    }

    fn row(&mut self, name: &str) -> u32 {
        if let Some(&row) = self.known.get(name) {
            return row;
        }
        let row = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.known.insert(name.to_owned(), row);
        row
    }
}
