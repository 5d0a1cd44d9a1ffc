//! STL: text and binary; triangles in file order, their equal corners made one vertex.
//!
//! `stl_io` does the binary form. Text is read here: that crate stops at the first `endsolid`, so
//! it would drop the other solids of a file, and it takes any file that starts with "solid " as
//! text, which many binary files do.

use std::collections::HashMap;
use std::io::{Cursor, Write};

use stl_io::{Normal, Triangle, Vertex};

use super::text::{Part, Words, at_line, shown};
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::shape::mesh::Mesh;

const HEADER: usize = 84;
const PER_TRIANGLE: usize = 50;

/// The mesh in the bytes of an STL file.
pub(super) fn decode(bytes: Vec<u8>) -> Result<Mesh> {
    let start = bytes.trim_ascii_start();
    let is_text = start
        .get(..5)
        .is_some_and(|w| w.eq_ignore_ascii_case(b"solid"))
        && binary_size(&bytes) != Some(bytes.len() as u64)
        && !bytes[..bytes.len().min(512)].contains(&0);
    if is_text { text(&bytes) } else { binary(bytes) }
}

/// Vertices by their coordinates, numbered as they appear.
#[derive(Default)]
struct Welder {
    mesh: Mesh,
    known: HashMap<[u64; 3], u32>,
}

impl Welder {
    fn triangle(&mut self, corners: [Point; 3]) {
        let corners = corners.map(|p| self.vertex(p));
        self.mesh.polygons.push(&corners);
    }

    fn vertex(&mut self, p: Point) -> u32 {
        // Adding zero makes -0 into 0: they are one place.
        let key = [p.x, p.y, p.z].map(|c| (c + 0.0).to_bits());
        let positions = &mut self.mesh.positions;
        *self.known.entry(key).or_insert_with(|| {
            positions.push(p);
            (positions.len() - 1) as u32
        })
    }
}

/// The size in bytes that the triangle count of a binary file asks for.
fn binary_size(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?.try_into().ok()?;
    Some(HEADER as u64 + u64::from(u32::from_le_bytes(count)) * PER_TRIANGLE as u64)
}

fn binary(mut bytes: Vec<u8>) -> Result<Mesh> {
    let size = binary_size(&bytes).ok_or_else(|| truncated(bytes.len(), HEADER as u64))?;
    if size > bytes.len() as u64 {
        return Err(truncated(bytes.len(), size));
    }
    // `stl_io` would take a header that starts with "solid" for the text form.
    bytes[..HEADER - 4].fill(0);
    let mut cursor = Cursor::new(bytes);
    let unreadable = |e: std::io::Error| Error::input(e.to_string(), "export the file again");
    let mut welder = Welder::default();
    for triangle in stl_io::create_stl_reader(&mut cursor).map_err(unreadable)? {
        let corners = triangle.map_err(unreadable)?.vertices;
        welder.triangle(corners.map(|v| Point::from(v.0.map(f64::from))));
    }
    Ok(welder.mesh)
}

fn truncated(length: usize, size: u64) -> Error {
    Error::input(
        format!("byte {length}: the file ends, but as binary STL its header asks for {size} bytes"),
        "it is cut off, or not an STL file; export it again",
    )
}

/// Text: the words `facet normal`, `outer loop` and so on are passed over, three times `vertex`
/// make a triangle, and any number of solids follow each other.
fn text(bytes: &[u8]) -> Result<Mesh> {
    let mut words = Words::new(bytes, 1, None);
    let mut welder = Welder::default();
    let mut corners = Vec::with_capacity(3);
    while let Some(word) = words.next_word() {
        match word.to_ascii_lowercase().as_slice() {
            b"solid" | b"endsolid" | b"facet" | b"outer" | b"endfacet" => words.skip_line(),
            b"vertex" => corners.push(corner(&mut words, welder.mesh.polygons.len())?),
            b"endloop" => {
                let triangle = corners.as_slice().try_into();
                welder.triangle(triangle.map_err(|_| not_three(words.line(), corners.len()))?);
                corners.clear();
            }
            _ => return Err(unknown(words.line(), word)),
        }
    }
    match corners.len() {
        0 => Ok(welder.mesh),
        n => Err(not_three(words.line(), n)),
    }
}

fn corner(words: &mut Words<'_>, triangle: usize) -> Result<Point> {
    let part = Part("triangle", triangle);
    Ok(Point::new(
        words.number(part)?,
        words.number(part)?,
        words.number(part)?,
    ))
}

fn not_three(line: usize, corners: usize) -> Error {
    at_line(
        line,
        format!("a facet with {corners} vertices"),
        "a facet has three; the file is cut off or damaged",
    )
}

fn unknown(line: usize, word: &[u8]) -> Error {
    at_line(
        line,
        format!("'{}' is not a word of an STL file", shown(word)),
        "the file is damaged; export it again",
    )
}

/// Writes binary STL in single precision, polygons as fans.
pub(super) fn encode(mesh: &Mesh, w: &mut dyn Write) -> Result<()> {
    let vertices = single_precision(mesh)?;
    let triangle = |corners: [u32; 3]| Triangle {
        normal: normal(corners.map(|v| &mesh.positions[v as usize])),
        vertices: corners.map(|v| vertices[v as usize]),
    };
    let triangles: Vec<Triangle> = mesh.triangles().map(|(t, _)| triangle(t)).collect();
    stl_io::write_stl(&mut &mut *w, triangles.iter()).map_err(|e| Error::io("", e))
}

fn single_precision(mesh: &Mesh) -> Result<Vec<Vertex>> {
    let rounded = |(v, p): (usize, &Point)| {
        let single = [p.x, p.y, p.z].map(|c| c as f32);
        if single.iter().all(|c| c.is_finite()) {
            return Ok(Vertex::new(single));
        }
        Err(Error::input(
            format!("vertex {v} (counted from 0) is too far out for STL's single precision"),
            "write PLY or OBJ instead, or scale the shape down",
        ))
    };
    mesh.positions.iter().enumerate().map(rounded).collect()
}

/// The unit normal, or zero for a triangle without area, as the format asks.
fn normal([a, b, c]: [&Point; 3]) -> Normal {
    let n = (b - a).cross(&(c - a));
    let unit = n.try_normalize(0.0).unwrap_or_else(Vector::zeros);
    Normal::new([unit.x, unit.y, unit.z].map(|c| c as f32))
}
