//! Stanford PLY: text and both binary forms, read and written with every property of every element.
//!
//! - reading: [`header`], then [`binary`] or [`ascii`] as one column of values per property, then
//!   [`read`], which makes the columns a document with [`faces`], [`families`] and [`names`].
//! - writing: [`layout`] decides what the columns of the file are, [`write`] writes them.
//!
//! No library reads the file: `ply-rs-bw`, which did, merges what a header names twice, drops the
//! places of comments, and makes an object per element; columns take less than half its time.

mod ascii;
mod binary;
mod columns;
mod faces;
mod families;
mod fate;
mod header;
mod layout;
mod losses;
mod names;
mod naming;
mod read;
mod write;

use header::{Declared, Header};

use super::text::Part;
use crate::error::{Error, Result};
use crate::shape::document::{Document, Kind, Numbers, PlyForm, PlyKept, PlyProperty, Values};

pub(super) use losses::{companions, losses, of_kept};
pub(super) use write::encode;

/// The document in the bytes of a PLY file.
pub(super) fn decode(bytes: &[u8]) -> Result<Document> {
    let header = header::parse(bytes)?;
    check(&header)?;
    let columns = match header.form {
        PlyForm::Text => ascii::columns(&header),
        PlyForm::Little | PlyForm::Big => binary::columns(&header),
    }?;
    read::document(header, columns)
}

/// Fails where the header lacks what a mesh needs.
fn check(header: &Header<'_>) -> Result<()> {
    let Some(vertex) = header.elements.iter().find(|e| e.name == "vertex") else {
        let names: Vec<&str> = header.elements.iter().map(|e| e.name.as_str()).collect();
        return Err(Error::input(
            format!(
                "the header has no element 'vertex', only: {}",
                names.join(", ")
            ),
            "a mesh needs vertices",
        ));
    };
    let lacks = |axis: &str| {
        let found = vertex.properties.iter().find(|p| p.name == axis);
        found.is_none_or(|p| p.count.is_some())
    };
    if let Some(axis) = ["x", "y", "z"].into_iter().find(|axis| lacks(axis)) {
        return Err(lacking("vertex", axis));
    }
    for element in header.elements.iter().filter(|e| e.count > 0) {
        let indices = match element.name.as_str() {
            "face" | "tristrips" => index_list(element).is_some_and(|p| !p.kind.is_float()),
            _ => true,
        };
        if !indices {
            return Err(lacking(&element.name, "vertex_indices"));
        }
        // Elements without content would let a short header ask for endless work.
        if element.properties.is_empty() {
            return Err(lacking(&element.name, "any"));
        }
    }
    Ok(())
}

fn lacking(element: &str, property: &str) -> Error {
    Error::input(
        format!("the element '{element}' has no usable property '{property}'"),
        "vertices need numbers x, y, z; faces a list of integers vertex_indices",
    )
}

fn ends_early(place: impl std::fmt::Display, declared: &Declared, index: usize) -> Error {
    Error::input(
        format!(
            "{place}: the file ends within or before {}, of the {} that the header claims",
            Part(&declared.name, index),
            declared.count
        ),
        "it is cut off, or the count in the header is wrong",
    )
}

/// The axis that a vertex property is.
fn axis(name: &str) -> Option<usize> {
    ["x", "y", "z"].iter().position(|&n| n == name)
}

fn is_position(declared: &Declared, property: &PlyProperty) -> bool {
    declared.name == "vertex" && axis(&property.name).is_some()
}

/// The list of vertex numbers of faces or strips; writers disagree on its name.
fn index_list(declared: &Declared) -> Option<&PlyProperty> {
    let mut lists = declared.properties.iter().filter(|p| p.count.is_some());
    lists.find(|p| matches!(p.name.as_str(), "vertex_indices" | "vertex_index"))
}

fn is_corners(declared: &Declared, property: &PlyProperty) -> bool {
    declared.name == "face" && index_list(declared).is_some_and(|p| p.name == property.name)
}

/// An empty column with room for `rows` values, in lists for no more than `most` numbers.
fn column(count: Option<Kind>, kind: Kind, rows: usize, most: usize) -> Values {
    match count {
        None => Values::Rows {
            width: 1,
            numbers: Numbers::with_capacity(kind, rows),
        },
        Some(_) => {
            let mut starts = Vec::with_capacity(rows + 1);
            starts.push(0);
            Values::Lists {
                starts,
                numbers: Numbers::with_capacity(kind, rows.saturating_mul(3).min(most)),
            }
        }
    }
}

/// How many elements a column has values for.
fn rows(values: &Values) -> usize {
    match values {
        Values::Rows { width, numbers } => numbers.len() / (*width).max(1),
        Values::Lists { starts, .. } => starts.len().saturating_sub(1),
        Values::Pool { rows, .. } => rows.len(),
        Values::Names { of, .. } => of.len(),
    }
}
