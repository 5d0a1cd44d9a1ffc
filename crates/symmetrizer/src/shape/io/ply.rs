//! Stanford PLY: text and binary, read through `ply-rs-bw`; written as binary little endian.
//!
//! The crate reads the header and the binary elements. Text elements are read here, because its
//! grammar refuses numbers that C programs print (`5.`, `.5`) and elements broken over lines.

use std::io::{BufWriter, Write};

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, PropertyAccess, PropertyDef, PropertyType, ScalarType,
};

use super::ply_elements::{Face, Ignored, Vertex, is_corner_list};
use super::text::{Part, Words};
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::mesh::Mesh;

/// The mesh in the bytes of a PLY file.
pub(super) fn decode(bytes: &[u8]) -> Result<Mesh> {
    let (header, body, lines) = header(bytes)?;
    check_header(&header)?;
    match header.encoding {
        Encoding::Ascii => text(&header, body, lines + 1),
        Encoding::BinaryBigEndian => binary(&header, body, bytes.len(), true),
        Encoding::BinaryLittleEndian => binary(&header, body, bytes.len(), false),
    }
}

/// The header, the bytes after it, and the number of its lines.
fn header(bytes: &[u8]) -> Result<(Header, &[u8], usize)> {
    let (head, body) = split(bytes)?;
    // Comments may be in any encoding and lines end in any way; the crate wants UTF-8 and LF.
    let head = String::from_utf8_lossy(head)
        .replace("\r\n", "\n")
        .replace('\r', "\n");
    let mut reader = Reader::new(head.as_bytes());
    let header = Parser::<Ignored>::new()
        .read_header(&mut reader)
        .map_err(|e| damaged("the header", &e))?;
    Ok((header, body, head.lines().count()))
}

/// The bytes up to and including the line `end_header`, and the rest.
fn split(bytes: &[u8]) -> Result<(&[u8], &[u8])> {
    const END: &[u8] = b"end_header";
    if !bytes.starts_with(b"ply") {
        return Err(Error::input(
            "byte 0: a PLY file starts with the line 'ply', this one does not",
            "is this another kind of file?",
        ));
    }
    let at = bytes.windows(END.len()).position(|w| w == END);
    let at = at.ok_or_else(|| {
        Error::input(
            "the header has no line 'end_header'",
            "the file is cut off; export it again",
        )
    })?;
    let tail = &bytes[at + END.len()..];
    let blank = tail
        .iter()
        .take_while(|&&b| b == b' ' || b == b'\t')
        .count();
    let tail = &tail[blank..];
    // A lone CR ends the line only where the other lines end so too: the next byte may be data.
    let body = tail
        .strip_prefix(b"\r\n")
        .or_else(|| tail.strip_prefix(b"\n"))
        .or_else(|| tail.strip_prefix(b"\r"))
        .unwrap_or(tail);
    Ok((&bytes[..bytes.len() - body.len()], body))
}

fn check_header(header: &Header) -> Result<()> {
    let vertex = element(header, "vertex")?;
    for name in ["x", "y", "z"] {
        match vertex.properties.get(name).map(|p| &p.data_type) {
            Some(PropertyType::Scalar(_)) => {}
            _ => return Err(lacking("vertex", name)),
        }
    }
    let face = element(header, "face")?;
    let corners = face.properties.values().find(|p| is_corner_list(&p.name));
    match corners.map(|p| &p.data_type) {
        Some(PropertyType::List(_, ScalarType::Float | ScalarType::Double)) | None => {
            return Err(lacking("face", "vertex_indices"));
        }
        Some(_) => {}
    }
    // Elements without content would let a short header ask for endless work.
    match header.elements.values().find(|e| e.properties.is_empty()) {
        Some(e) if e.count > 0 => Err(lacking(&e.name, "any")),
        _ => Ok(()),
    }
}

fn element<'a>(header: &'a Header, name: &str) -> Result<&'a ElementDef> {
    header.elements.get(name).ok_or_else(|| {
        let names: Vec<&str> = header.elements.keys().map(String::as_str).collect();
        Error::input(
            format!("the header has no element '{name}', only: {}", names.join(", ")),
            "a mesh needs vertices and faces; a point cloud or triangle strips must be converted first",
        )
    })
}

fn lacking(element: &str, property: &str) -> Error {
    Error::input(
        format!("the element '{element}' has no usable property '{property}'"),
        "vertices need numbers x, y, z; faces a list of integers vertex_indices",
    )
}

fn damaged(part: impl std::fmt::Display, error: &ParseError) -> Error {
    let what = error.to_string().replace("\n\t", "; ").replace('\n', "");
    let cause: String = what.chars().take(200).collect();
    Error::input(
        format!("{part}: {cause}"),
        "the file is damaged or cut off; export it again",
    )
}

/// A mesh with room for the vertices of the header, as far as `body` can hold them.
fn with_room(header: &Header, body: &[u8]) -> Mesh {
    let claimed = header.elements.get("vertex").map_or(0, |e| e.count);
    let mut mesh = Mesh::default();
    mesh.positions.reserve(claimed.min(body.len() / 3));
    mesh
}

struct Binary<'a> {
    rest: &'a [u8],
    size: usize,
    big_endian: bool,
}

fn binary(header: &Header, body: &[u8], size: usize, big_endian: bool) -> Result<Mesh> {
    let mut mesh = with_room(header, body);
    let mut reader = Binary {
        rest: body,
        size,
        big_endian,
    };
    for def in header.elements.values() {
        match def.name.as_str() {
            "vertex" => reader.elements(def, |v: Vertex, _| {
                mesh.positions.push(Point::from(v.position));
                Ok(())
            })?,
            "face" => reader.elements(def, |face: Face, f| {
                mesh.polygons.push(&face.corners(f)?);
                Ok(())
            })?,
            _ => reader.elements(def, |_: Ignored, _| Ok(()))?,
        }
    }
    Ok(mesh)
}

impl Binary<'_> {
    /// Reads the elements of `def` one by one.
    fn elements<E: PropertyAccess>(
        &mut self,
        def: &ElementDef,
        mut take: impl FnMut(E, usize) -> Result<()>,
    ) -> Result<()> {
        let parser = Parser::<E>::new();
        for index in 0..def.count {
            let at = self.size - self.rest.len();
            let element = match self.big_endian {
                true => parser.read_big_endian_element(&mut self.rest, def),
                false => parser.read_little_endian_element(&mut self.rest, def),
            };
            take(element.map_err(|e| broken(def, index, at, &e))?, index)?;
        }
        Ok(())
    }
}

fn broken(def: &ElementDef, index: usize, at: usize, error: &ParseError) -> Error {
    if error.kind() == std::io::ErrorKind::UnexpectedEof {
        return Error::input(
            format!(
                "byte {at}: the file ends within or before {}, of the {} that the header claims",
                Part(&def.name, index),
                def.count
            ),
            "it is cut off, or the count in the header is wrong",
        );
    }
    damaged(format!("byte {at}: {}", Part(&def.name, index)), error)
}

fn text(header: &Header, body: &[u8], line: usize) -> Result<Mesh> {
    let mut mesh = with_room(header, body);
    let mut words = Words::new(body, line, None);
    let mut corners = Vec::new();
    for def in header.elements.values() {
        for index in 0..def.count {
            let position = text_element(&mut words, def, index, &mut corners)?;
            match def.name.as_str() {
                "vertex" => mesh.positions.push(position),
                "face" => mesh.polygons.push(&corners),
                _ => {}
            }
            // Values that the header does not declare.
            words.skip_line();
        }
    }
    Ok(mesh)
}

/// Reads one element: the position where it is a vertex; `corners` are replaced where it is a face.
fn text_element(
    words: &mut Words<'_>,
    def: &ElementDef,
    index: usize,
    corners: &mut Vec<u32>,
) -> Result<Point> {
    let part = Part(&def.name, index);
    let mut position = Point::origin();
    for property in def.properties.values() {
        if let Some(axis) = axis(def, property) {
            position[axis] = words.number(part)?;
        } else if def.name == "face" && is_corner_list(&property.name) {
            corners.clear();
            read_corners(words, part, corners)?;
        } else {
            skip(words, part, property)?;
        }
    }
    Ok(position)
}

fn axis(def: &ElementDef, property: &PropertyDef) -> Option<usize> {
    let axis = ["x", "y", "z"].iter().position(|&n| n == property.name)?;
    (def.name == "vertex").then_some(axis)
}

fn read_corners(words: &mut Words<'_>, part: Part<'_>, corners: &mut Vec<u32>) -> Result<()> {
    for _ in 0..words.index(part)? {
        corners.push(words.index(part)?);
    }
    Ok(())
}

fn skip(words: &mut Words<'_>, part: Part<'_>, property: &PropertyDef) -> Result<()> {
    let count = match property.data_type {
        PropertyType::Scalar(_) => 1,
        PropertyType::List(..) => words.index(part)?,
    };
    for _ in 0..count {
        words.word_of(part)?;
    }
    Ok(())
}

/// Writes binary little endian: `double` coordinates, `int` indices.
pub(super) fn encode(mesh: &Mesh, w: &mut dyn Write) -> Result<()> {
    if i32::try_from(mesh.positions.len()).is_err() {
        return Err(Error::input(
            format!("{} vertices are too many for PLY", mesh.positions.len()),
            "write OBJ instead",
        ));
    }
    // Every reader takes a `uchar` count: `uint` only where a face needs it.
    let wide = mesh.polygons.iter().any(|p| p.len() > usize::from(u8::MAX));
    let bytes = || -> std::io::Result<()> {
        let mut w = BufWriter::new(w);
        w.write_all(head(mesh, wide).as_bytes())?;
        for c in mesh.positions.iter().flat_map(|p| p.iter()) {
            w.write_all(&c.to_le_bytes())?;
        }
        for polygon in mesh.polygons.iter() {
            match wide {
                true => w.write_all(&(polygon.len() as u32).to_le_bytes())?,
                false => w.write_all(&[polygon.len() as u8])?,
            }
            for v in polygon {
                w.write_all(&v.to_le_bytes())?;
            }
        }
        w.flush()
    };
    bytes().map_err(|e| Error::io("", e))
}

fn head(mesh: &Mesh, wide: bool) -> String {
    let count = if wide { "uint" } else { "uchar" };
    format!(
        "ply\nformat binary_little_endian 1.0\n\
         element vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list {count} int vertex_indices\nend_header\n",
        mesh.positions.len(),
        mesh.polygons.len()
    )
}
