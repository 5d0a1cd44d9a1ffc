//! The model parts of a package.

use std::collections::BTreeMap;

use super::model::Model;
use super::package::Package;
use super::xml::{Text, shown};
use crate::error::{Error, Result};

/// A model part.
pub(super) struct Part {
    /// Its entry in the package.
    pub entry: usize,
    /// Its name.
    pub name: String,
    /// Its text.
    pub text: String,
    /// What the text says.
    pub model: Model,
}

/// The part that the package starts with, and all that it refers to.
pub(super) fn parts(package: &mut Package<'_>) -> Result<Vec<Part>> {
    let mut entries = vec![package.start()?];
    let mut known = BTreeMap::from([(entries[0], 0)]);
    let mut parts: Vec<Part> = Vec::new();
    while let Some(&entry) = entries.get(parts.len()) {
        let (name, text) = (package.names()[entry].clone(), package.text(entry)?);
        let mut model = Model::read(Text {
            part: &shown(&name),
            text: &text,
        })?;
        for placed in model.placed_mut() {
            let found = match &placed.path {
                None => entry,
                Some(path) => package.find(path).ok_or_else(|| no_part(&name, path))?,
            };
            placed.part = *known.entry(found).or_insert_with(|| {
                entries.push(found);
                entries.len() - 1
            });
        }
        parts.push(Part {
            entry,
            name,
            text,
            model,
        });
    }
    Ok(parts)
}

fn no_part(from: &str, path: &str) -> Error {
    Error::input(
        format!(
            "{} refers to {}, which is not in the package",
            shown(from),
            shown(path)
        ),
        "the file is damaged; export it again",
    )
}
