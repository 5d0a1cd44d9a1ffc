//! Wavefront OBJ: `v` and `f` lines; everything else is passed over.

use std::borrow::Cow;
use std::io::{BufWriter, Write};

use super::text::{at_line, number, plain, shown, str_of};
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::mesh::Mesh;

/// The mesh in the text of an OBJ file.
pub(super) fn decode(bytes: &[u8]) -> Result<Mesh> {
    let mut reader = Reader::default();
    for (line, text) in (Lines {
        rest: plain(bytes)?,
        next: 1,
    }) {
        reader.statement(&text, line)?;
    }
    reader.finish()
}

#[derive(Default)]
struct Reader {
    mesh: Mesh,
    corners: Vec<u32>,
    /// The highest vertex that a face names, with its line: a face may stand before its vertices,
    /// so the range is known at the end only.
    highest: Option<(u32, usize)>,
}

impl Reader {
    fn statement(&mut self, text: &[u8], line: usize) -> Result<()> {
        let mut words = text
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty());
        match words.next() {
            Some(b"v") => self.vertex(words, line),
            Some(b"f" | b"fo") => self.face(words, line),
            _ => Ok(()),
        }
    }

    fn vertex<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>, line: usize) -> Result<()> {
        let mut position = Point::origin();
        let mut given = 0;
        for (coordinate, word) in position.iter_mut().zip(words) {
            *coordinate = number(word, line)?;
            given += 1;
        }
        if given < 3 {
            return Err(at_line(
                line,
                format!("a vertex with {given} coordinates"),
                "three are needed: v x y z",
            ));
        }
        self.mesh.positions.push(position);
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>, line: usize) -> Result<()> {
        self.corners.clear();
        for word in words.take_while(|word| word[0] != b'#') {
            let v = corner(word, self.mesh.positions.len(), line)?;
            if self.highest.is_none_or(|(highest, _)| v > highest) {
                self.highest = Some((v, line));
            }
            self.corners.push(v);
        }
        if self.corners.len() < 3 {
            return Err(at_line(
                line,
                format!("a face with {} corners", self.corners.len()),
                "a face needs at least three; remove the line",
            ));
        }
        self.mesh.polygons.push(&self.corners);
        Ok(())
    }

    fn finish(self) -> Result<Mesh> {
        let count = self.mesh.positions.len();
        match self.highest {
            Some((v, line)) if v as usize >= count => Err(at_line(
                line,
                format!(
                    "the face names vertex {}, but there are only {count} (counted from 1)",
                    u64::from(v) + 1
                ),
                "the file is cut off or its face list is damaged",
            )),
            _ => Ok(self.mesh),
        }
    }
}

/// The 0-based vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`; a negative v counts back from the last
/// of the `count` vertices so far.
fn corner(word: &[u8], count: usize, line: usize) -> Result<u32> {
    let vertex = word.split(|&b| b == b'/').next().unwrap_or(word);
    let index = match str_of(vertex).and_then(|text| text.parse::<i64>().ok()) {
        Some(v) if v > 0 => u32::try_from(v - 1).ok(),
        Some(v) if v < 0 => u32::try_from(v.saturating_add(count as i64)).ok(),
        _ => None,
    };
    index.ok_or_else(|| bad_corner(word, count, line))
}

fn bad_corner(word: &[u8], count: usize, line: usize) -> Error {
    at_line(
        line,
        format!(
            "the face corner '{}' does not name one of the {count} vertices above it",
            shown(word)
        ),
        "vertices count from 1, or from -1 backwards",
    )
}

/// Logical lines with the number of their first physical line; a backslash at the end of a line
/// continues it.
struct Lines<'a> {
    rest: &'a [u8],
    next: usize,
}

impl<'a> Lines<'a> {
    fn physical(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        let ended = rest.strip_prefix(b"\r\n").or_else(|| rest.get(1..));
        self.rest = ended.unwrap_or(&[]);
        self.next += 1;
        Some(line)
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let number = self.next;
        let mut line = Cow::Borrowed(self.physical()?);
        while line.last() == Some(&b'\\') {
            let joined = line.to_mut();
            joined.pop();
            joined.push(b' ');
            match self.physical() {
                Some(more) => joined.extend_from_slice(more),
                None => break,
            }
        }
        Some((number, line))
    }
}

/// Writes an OBJ file; coordinates in the shortest form that reads back to the same bits.
pub(super) fn encode(mesh: &Mesh, w: &mut dyn Write) -> Result<()> {
    let text = || -> std::io::Result<()> {
        let mut w = BufWriter::new(w);
        for p in &mesh.positions {
            writeln!(w, "v {} {} {}", p.x, p.y, p.z)?;
        }
        for polygon in mesh.polygons.iter() {
            write!(w, "f")?;
            for v in polygon {
                write!(w, " {}", u64::from(*v) + 1)?;
            }
            writeln!(w)?;
        }
        w.flush()
    };
    text().map_err(|e| Error::io("", e))
}
