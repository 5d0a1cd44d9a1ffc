//! STL, text and binary; triangles in file order, their equal corners made one vertex.
//!
//! Read by our own code: `stl_io` drops the header and the two bytes that a binary triangle carries
//! (colours, for some programs), stops at the first `endsolid` of a text, and takes any file that
//! starts with "solid " for text, which many binary files do (decision 0010).

mod binary;
mod text;
mod weld;

use std::io::Write;

use super::losses::{loose_vertices, numbered, of_layers, of_polygons, of_precision};
use crate::error::{Error, Result};
use crate::geom::Vector;
use crate::shape::document::{Document, Kept, Layer, On, Role};

/// The document in the bytes of an STL file.
pub(super) fn decode(bytes: &[u8]) -> Result<Document> {
    let start = bytes.trim_ascii_start();
    let is_text = start
        .get(..5)
        .is_some_and(|w| w.eq_ignore_ascii_case(b"solid"))
        && binary::size(bytes) != Some(bytes.len() as u64)
        && !bytes[..bytes.len().min(512)].contains(&0);
    if is_text {
        text::decode(bytes)
    } else {
        binary::decode(bytes)
    }
}

/// Writes text where the document comes from a text STL, else binary in single precision; polygons
/// as triangles. Normals are those of the triangles.
pub(super) fn encode(document: &Document, w: &mut dyn Write) -> Result<()> {
    let written = match is_text(document) {
        true => text::encode(document, w),
        false => binary::encode(document, w)?,
    };
    written.map_err(|e| Error::io("", e))
}

/// What STL cannot say of `document`.
pub(super) fn losses(document: &Document) -> Vec<String> {
    let text = is_text(document);
    let mut lost = of_layers(document, |layer| holds(layer, text));
    lost.extend(of_polygons(document));
    if !text {
        lost.extend(of_precision(document));
    }
    let loose = loose_vertices(document);
    lost.extend(numbered(
        loose,
        "vertex without faces",
        "vertices without faces",
    ));
    lost
}

fn holds(layer: &Layer, text: bool) -> bool {
    match layer.role {
        Role::Group => text && layer.on == On::Face,
        _ => !text && binary::is_attribute(layer),
    }
}

fn is_text(document: &Document) -> bool {
    matches!(&document.kept, Kept::Stl(kept) if kept.text)
}

/// The unit normal of a triangle of `document`, or zero for one without area, as the format asks.
fn normal(document: &Document, corners: [u32; 3]) -> Vector {
    let [a, b, c] = corners.map(|v| document.mesh.positions[v as usize]);
    let n = (b - a).cross(&(c - a));
    n.try_normalize(0.0).unwrap_or_else(Vector::zeros)
}
