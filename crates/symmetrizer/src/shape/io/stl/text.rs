//! Text STL: the words `facet normal`, `outer loop` and so on are passed over, three times `vertex`
//! make a triangle, and any number of solids follow each other.

use std::io::{BufWriter, Result as IoResult, Write};

use super::super::text::{Part, Words, at_line, label, one_line, shown};
use super::normal;
use super::weld::Welder;
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::document::{Document, Kept, Layer, NameList, On, Role, StlKept, Values};

pub(super) fn decode(bytes: &[u8]) -> Result<Document> {
    let mut words = Words::new(bytes, 1, None);
    let mut welder = Welder::default();
    let mut corners = Vec::with_capacity(3);
    let mut solids = NameList::default();
    let mut solid = None;
    while let Some(word) = words.next_word() {
        match word.to_ascii_lowercase().as_slice() {
            b"solid" => solid = name(words.rest_of_line()),
            b"endsolid" | b"facet" | b"outer" | b"endfacet" => words.skip_line(),
            b"vertex" => corners.push(corner(&mut words, welder.mesh.polygons.len())?),
            b"endloop" => {
                let triangle = corners.as_slice().try_into();
                welder.triangle(triangle.map_err(|_| not_three(words.line(), corners.len()))?);
                solids.push(solid.as_deref());
                corners.clear();
            }
            _ => return Err(unknown(words.line(), word)),
        }
    }
    match corners.len() {
        0 => Ok(Document {
            mesh: welder.mesh,
            layers: solids.finish().map(groups).into_iter().collect(),
            kept: Kept::Stl(StlKept {
                text: true,
                header: Vec::new(),
            }),
        }),
        n => Err(not_three(words.line(), n)),
    }
}

/// The name of a solid, if it has one.
fn name(rest: &[u8]) -> Option<String> {
    let name = label(rest);
    (!name.is_empty()).then_some(name)
}

fn groups(values: Values) -> Layer {
    Layer {
        name: String::new(),
        on: On::Face,
        role: Role::Group,
        values,
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

/// Writes one solid for each run of triangles of one group.
pub(super) fn encode(document: &Document, w: &mut dyn Write) -> IoResult<()> {
    let mut w = BufWriter::new(w);
    let group = document.layer(On::Face, Role::Group);
    let name = |f: u32| group.and_then(|l| l.values.name(f as usize)).unwrap_or("");
    let triangles: Vec<([u32; 3], u32)> = document.mesh.triangles().collect();
    for solid in triangles.chunk_by(|a, b| name(a.1) == name(b.1)) {
        let name = one_line(name(solid[0].1));
        writeln!(w, "{}", format!("solid {name}").trim_end())?;
        for (corners, _) in solid {
            facet(document, *corners, &mut w)?;
        }
        writeln!(w, "{}", format!("endsolid {name}").trim_end())?;
    }
    w.flush()
}

fn facet(document: &Document, corners: [u32; 3], w: &mut dyn Write) -> IoResult<()> {
    let n = normal(document, corners);
    writeln!(w, " facet normal {} {} {}", n.x, n.y, n.z)?;
    writeln!(w, "  outer loop")?;
    for v in corners {
        let p = document.mesh.positions[v as usize];
        writeln!(w, "   vertex {} {} {}", p.x, p.y, p.z)?;
    }
    writeln!(w, "  endloop\n endfacet")
}
