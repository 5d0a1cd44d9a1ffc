//! Binary STL: 80 bytes of header, a count, and 50 bytes for each triangle: its normal, its corners
//! in single precision, and two bytes with which programs do what they like.

use std::io::{BufWriter, Result as IoResult, Write};

use super::normal;
use super::weld::Welder;
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::document::{Document, Kept, Layer, Numbers, On, Role, StlKept, Values};

const HEADER: usize = 80;
const BEGIN: usize = HEADER + 4;
const PER_TRIANGLE: usize = 50;

/// The name of the layer with the two free bytes.
const ATTRIBUTE: &str = "attribute";

/// The size in bytes that the triangle count of a binary file asks for.
pub(super) fn size(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER..BEGIN)?.try_into().ok()?;
    Some(BEGIN as u64 + u64::from(u32::from_le_bytes(count)) * PER_TRIANGLE as u64)
}

/// Whether a layer holds the two free bytes of the triangles.
pub(super) fn is_attribute(layer: &Layer) -> bool {
    layer.role == Role::Other
        && layer.on == On::Face
        && layer.name == ATTRIBUTE
        && matches!(
            &layer.values,
            Values::Rows {
                width: 1,
                numbers: Numbers::U16(_)
            }
        )
}

pub(super) fn decode(bytes: &[u8]) -> Result<Document> {
    let size = size(bytes).ok_or_else(|| truncated(bytes.len(), BEGIN as u64))?;
    let end = usize::try_from(size).ok().filter(|&end| end <= bytes.len());
    let end = end.ok_or_else(|| truncated(bytes.len(), size))?;
    let mut welder = Welder::default();
    let mut attributes = Vec::new();
    for triangle in bytes[BEGIN..end].chunks_exact(PER_TRIANGLE) {
        welder.triangle([12, 24, 36].map(|at| point(&triangle[at..at + 12])));
        attributes.push(u16::from_le_bytes([triangle[48], triangle[49]]));
    }
    let attribute = attributes.iter().any(|a| *a != 0).then(|| Layer {
        name: ATTRIBUTE.into(),
        on: On::Face,
        role: Role::Other,
        values: Values::Rows {
            width: 1,
            numbers: Numbers::U16(attributes),
        },
    });
    Ok(Document {
        mesh: welder.mesh,
        layers: attribute.into_iter().collect(),
        kept: Kept::Stl(StlKept {
            text: false,
            header: bytes[..HEADER].to_vec(),
        }),
    })
}

fn point(bytes: &[u8]) -> Point {
    let mut words = bytes
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    let mut next = || f64::from(words.next().unwrap_or(0.0));
    Point::new(next(), next(), next())
}

fn truncated(length: usize, size: u64) -> Error {
    Error::input(
        format!("byte {length}: the file ends, but as binary STL its header asks for {size} bytes"),
        "it is cut off, or not an STL file; export it again",
    )
}

/// Writes the file.
///
/// # Errors
/// [`Error::Input`] for coordinates or counts that the format has no room for.
pub(super) fn encode(document: &Document, w: &mut dyn Write) -> Result<IoResult<()>> {
    let mesh = &document.mesh;
    let too_far = |p: &Point| p.iter().any(|c| c.is_finite() && !(*c as f32).is_finite());
    if let Some(v) = mesh.positions.iter().position(too_far) {
        return Err(Error::input(
            format!("vertex {v} (counted from 0) is too far out for STL's single precision"),
            "write PLY or OBJ instead, or scale the shape down",
        ));
    }
    let triangles: Vec<([u32; 3], u32)> = mesh.triangles().collect();
    let Ok(count) = u32::try_from(triangles.len()) else {
        return Err(Error::input(
            "there are more triangles than STL can count",
            "write PLY instead",
        ));
    };
    let attribute = document.layers.iter().find(|l| is_attribute(l));
    let bytes = || -> IoResult<()> {
        let mut w = BufWriter::new(w);
        w.write_all(&header(document))?;
        w.write_all(&count.to_le_bytes())?;
        for (corners, face) in triangles {
            for c in normal(document, corners).iter() {
                w.write_all(&(*c as f32).to_le_bytes())?;
            }
            for c in corners
                .iter()
                .flat_map(|&v| mesh.positions[v as usize].coords.data.0[0])
            {
                w.write_all(&(c as f32).to_le_bytes())?;
            }
            let value = attribute.and_then(|l| l.values.get(face as usize, 0));
            w.write_all(&(value.unwrap_or(0.0) as u16).to_le_bytes())?;
        }
        w.flush()
    };
    Ok(bytes())
}

/// The header of the file that the document comes from, or 80 blanks.
fn header(document: &Document) -> [u8; HEADER] {
    let mut header = [b' '; HEADER];
    if let Kept::Stl(kept) = &document.kept
        && kept.header.len() == HEADER
    {
        header.copy_from_slice(&kept.header);
    }
    header
}
