//! Geomview OFF, text: `OFF`, the counts, the vertices, the faces; comments from `#`.

use std::io::{BufWriter, Write};

use super::text::{Part, Words, at_line, plain, shown, str_of};
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::mesh::{Mesh, Polygons};

/// The mesh in the text of an OFF file.
pub(super) fn decode(bytes: &[u8]) -> Result<Mesh> {
    let mut words = Words::new(plain(bytes)?, 1, Some(b'#'));
    let attributes = keyword(&mut words)?;
    let vertices = count(&mut words, "vertices", bytes.len() / 5)?;
    let line = words.line();
    let faces = count(&mut words, "faces", bytes.len() / 3)?;
    let one_line = words.line() == line;
    edge_count(&mut words, one_line);
    let mesh = Mesh {
        positions: positions(&mut words, vertices, attributes)?,
        polygons: polygons(&mut words, faces)?,
    };
    nothing_left(&mut words, faces)?;
    Ok(mesh)
}

/// Whether vertices carry values beyond their position, from the keyword: `COFF`, `NOFF`, `STOFF`.
/// The keyword is optional, and the counts may follow it without a space.
fn keyword(words: &mut Words<'_>) -> Result<bool> {
    let word = words.word_of(Part("the header: line", 0))?;
    let Some(at) = word.windows(3).position(|w| w == b"OFF") else {
        return no_keyword(words, word);
    };
    let (prefix, suffix) = (&word[..at], &word[at + 3..]);
    words.put_back(suffix.len());
    if !prefix.iter().all(|b| b"STCN".contains(b)) {
        return Err(unsupported(word));
    }
    Ok(!prefix.is_empty())
}

fn no_keyword(words: &mut Words<'_>, word: &[u8]) -> Result<bool> {
    if !word.iter().all(u8::is_ascii_digit) {
        return Err(at_line(
            words.line(),
            format!("'{}' where an OFF file has the word OFF", shown(word)),
            "is this another kind of file?",
        ));
    }
    words.put_back(word.len());
    Ok(false)
}

fn unsupported(word: &[u8]) -> Error {
    Error::input(
        format!("OFF files of the kind '{}' are not supported", shown(word)),
        "export as plain OFF with three coordinates",
    )
}

/// A count of the header; `most` is what a file of this size can hold, so that a wrong header
/// cannot make us reserve more memory than the file has content.
fn count(words: &mut Words<'_>, of: &str, most: usize) -> Result<usize> {
    let word = words.word_of(Part("the counts: line", 1))?;
    if word == b"BINARY" {
        return Err(unsupported(b"OFF BINARY"));
    }
    match str_of(word).and_then(|text| text.parse::<u64>().ok()) {
        Some(n) if n <= most as u64 => Ok(n as usize),
        Some(n) => Err(at_line(
            words.line(),
            format!("the header claims {n} {of}, more than a file of this size can hold"),
            "correct the counts: vertices, faces, edges",
        )),
        None => Err(at_line(
            words.line(),
            format!("'{}' is not a number of {of}", shown(word)),
            "after OFF come three counts: vertices, faces, edges",
        )),
    }
}

/// Passes over the third count. Some writers leave it out: then the line that has the other two
/// ends before it.
fn edge_count(words: &mut Words<'_>, one_line: bool) {
    let line = words.line();
    if let Some(word) = words.next_word()
        && one_line
        && words.line() != line
    {
        words.put_back(word.len());
    }
}

fn positions(words: &mut Words<'_>, count: usize, attributes: bool) -> Result<Vec<Point>> {
    let mut positions = Vec::with_capacity(count);
    for v in 0..count {
        let part = Part("vertex", v);
        let [x, y, z] = [
            words.number(part)?,
            words.number(part)?,
            words.number(part)?,
        ];
        positions.push(Point::new(x, y, z));
        if attributes {
            words.skip_line();
        }
    }
    Ok(positions)
}

fn polygons(words: &mut Words<'_>, count: usize) -> Result<Polygons> {
    let mut polygons = Polygons::default();
    let mut corners = Vec::new();
    for f in 0..count {
        let part = Part("face", f);
        corners.clear();
        for _ in 0..words.index(part)? {
            corners.push(words.index(part)?);
        }
        polygons.push(&corners);
        // A colour may follow.
        words.skip_line();
    }
    Ok(polygons)
}

/// More words after the last face mean that the counts are too small: nothing is dropped silently.
fn nothing_left(words: &mut Words<'_>, faces: usize) -> Result<()> {
    match words.next_word() {
        None => Ok(()),
        Some(word) => Err(at_line(
            words.line(),
            format!(
                "'{}' after the last of the {faces} faces that the header claims",
                shown(word)
            ),
            "correct the counts: vertices, faces, edges",
        )),
    }
}

/// Writes an OFF file; coordinates in the shortest form that reads back to the same bits.
pub(super) fn encode(mesh: &Mesh, w: &mut dyn Write) -> Result<()> {
    let text = || -> std::io::Result<()> {
        let mut w = BufWriter::new(w);
        let (vertices, faces) = (mesh.positions.len(), mesh.polygons.len());
        writeln!(w, "OFF\n{vertices} {faces} 0")?;
        for p in &mesh.positions {
            writeln!(w, "{} {} {}", p.x, p.y, p.z)?;
        }
        for polygon in mesh.polygons.iter() {
            write!(w, "{}", polygon.len())?;
            for v in polygon {
                write!(w, " {v}")?;
            }
            writeln!(w)?;
        }
        w.flush()
    };
    text().map_err(|e| Error::io("", e))
}
