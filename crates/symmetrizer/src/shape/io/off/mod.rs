//! Geomview OFF, text: `OFF`, the counts, the vertices, the faces; comments from `#`. A prefix says
//! what follows each position: `N` a normal, `C` a colour, `ST` texture coordinates.

mod rows;
mod write;

use self::rows::{Colors, Columns};
use super::text::{Part, Words, at_line, plain, shown, str_of};
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::document::{Document, On};
use crate::shape::mesh::{Mesh, Polygons};

pub(super) use write::{encode, losses};

/// What follows a vertex's position, in this order.
#[derive(Debug, Clone, Copy, Default)]
struct Prefix {
    normal: bool,
    color: bool,
    texture: bool,
}

impl Prefix {
    fn any(self) -> bool {
        self.normal || self.color || self.texture
    }
}

/// The document in the text of an OFF file.
pub(super) fn decode(bytes: &[u8]) -> Result<Document> {
    let text = plain(bytes)?;
    let mut words = Words::new(&text, 1, Some(b'#'));
    let prefix = keyword(&mut words)?;
    let vertices = count(&mut words, "vertices", text.len() / 5)?;
    let line = words.line();
    let faces = count(&mut words, "faces", text.len() / 3)?;
    let one_line = words.line() == line;
    edge_count(&mut words, one_line);
    let mut columns = Columns::new(prefix);
    let positions = positions(&mut words, vertices, &mut columns)?;
    let mut colors = Colors::default();
    let polygons = polygons(&mut words, faces, &mut colors)?;
    nothing_left(&mut words, faces)?;
    let mut layers = columns.finish();
    layers.extend(colors.layer(On::Face));
    Ok(Document {
        mesh: Mesh {
            positions,
            polygons,
        },
        layers,
        ..Document::default()
    })
}

/// What vertices carry beyond their position, from the keyword: `COFF`, `NOFF`, `STOFF`. The
/// keyword is optional, and the counts may follow it without a space.
fn keyword(words: &mut Words<'_>) -> Result<Prefix> {
    let word = words.word_of(Part("the header: line", 0))?;
    let Some(at) = word.windows(3).position(|w| w == b"OFF") else {
        return no_keyword(words, word);
    };
    let (prefix, suffix) = (&word[..at], &word[at + 3..]);
    words.put_back(suffix.len());
    let texture = prefix.starts_with(b"ST");
    let rest = prefix.strip_prefix(b"ST").unwrap_or(prefix);
    if !rest.iter().all(|b| b"CN".contains(b)) {
        return Err(unsupported(word));
    }
    Ok(Prefix {
        normal: rest.contains(&b'N'),
        color: rest.contains(&b'C'),
        texture,
    })
}

fn no_keyword(words: &mut Words<'_>, word: &[u8]) -> Result<Prefix> {
    if !word.iter().all(u8::is_ascii_digit) {
        return Err(at_line(
            words.line(),
            format!("'{}' where an OFF file has the word OFF", shown(word)),
            "is this another kind of file?",
        ));
    }
    words.put_back(word.len());
    Ok(Prefix::default())
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

fn positions(words: &mut Words<'_>, count: usize, columns: &mut Columns) -> Result<Vec<Point>> {
    let mut positions = Vec::with_capacity(count);
    for v in 0..count {
        let part = Part("vertex", v);
        let [x, y, z] = [
            words.number(part)?,
            words.number(part)?,
            words.number(part)?,
        ];
        positions.push(Point::new(x, y, z));
        if columns.prefix.any() {
            columns.read(words.rest_of_line(), words.line(), v)?;
        }
    }
    Ok(positions)
}

fn polygons(words: &mut Words<'_>, count: usize, colors: &mut Colors) -> Result<Polygons> {
    let mut polygons = Polygons::default();
    let mut corners = Vec::new();
    for f in 0..count {
        let part = Part("face", f);
        corners.clear();
        for _ in 0..words.index(part)? {
            corners.push(words.index(part)?);
        }
        polygons.push(&corners);
        colors.read(words.rest_of_line(), words.line())?;
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
