//! glTF 2.0, text and binary: the shape of the default scene, in world coordinates.
//!
//! Each node with a mesh gives vertices of its own, so that a mesh used twice is there twice. A file
//! is kept whole; written as glTF again, only the elements that have changed since are replaced, and
//! everything else (materials, pictures, animations, skins, unknown keys) stays.
//!
//! The JSON is read as plain values and the accessors are decoded here, because a deserialised form
//! would drop the keys that it does not know, and because to guard a reader of accessors against
//! damaged ranges takes as much code as to read them.
//!
//! Positions and morph targets are those of the file's rest pose: nodes as they stand, skins
//! applied, morph weights and animations not.

mod accessor;
mod attribute;
mod buffers;
mod columns;
mod container;
mod faces;
mod fresh;
mod json;
mod kept;
mod layers;
mod objects;
mod parts;
mod patch;
mod place;
mod read;
mod replace;
mod scene;
mod seams;
mod skin;
mod span;
mod unshared;
mod writer;

use std::io::Write;
use std::path::Path;

use crate::error::Result;
use crate::shape::document::Document;

pub(super) use kept::{companions, lost_elsewhere};

/// The document in the bytes of a glTF file, text or binary; the buffers it names are looked for in
/// `folder`.
pub(super) fn decode(bytes: Vec<u8>, folder: Option<&Path>) -> Result<Document> {
    let file = container::open(bytes, folder)?;
    let shape = read::shape(&file)?;
    Ok(shape.document(file))
}

/// Writes one text file with its buffers inside.
pub(super) fn encode_text(document: &Document, w: &mut dyn Write) -> Result<()> {
    container::write_text(contents(document)?, w)
}

/// Writes one binary file.
pub(super) fn encode_binary(document: &Document, w: &mut dyn Write) -> Result<()> {
    container::write_binary(contents(document)?, w)
}

/// What a glTF file does not hold of `document`.
pub(super) fn losses(document: &Document) -> Vec<String> {
    kept::losses(document).unwrap_or_else(|| fresh::losses(document))
}

fn contents(document: &Document) -> Result<container::Contents> {
    match kept::with_changes(document)? {
        Some(contents) => Ok(contents),
        None => fresh::contents(document),
    }
}
