//! XYZ: a point per line, and perhaps a normal, a colour or other numbers behind it.
//!
//! Numbers are separated by blanks, tabs, commas or semicolons; `#` and `//` start comments. The
//! first line may have the count of the points or the names of the columns. Without names, three
//! further columns are normals if they have unit length, or else colours if they can be.

mod table;

use std::io::{BufWriter, Write};

use super::losses::{counted, of_layers};
use super::text::plain;
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::document::{Document, Kind, Layer, On, Role, Values};
use crate::shape::mesh::Mesh;
use table::{COLOR, NORMAL, Table, is_number, separates};

/// The points in the text of an XYZ file.
pub(super) fn decode(bytes: &[u8]) -> Result<Document> {
    let table = Table::read(&plain(bytes)?)?;
    let positions = table.rows().map(|r| Point::new(r[0], r[1], r[2]));
    Ok(Document {
        mesh: Mesh {
            positions: positions.collect(),
            ..Mesh::default()
        },
        layers: table.layers(),
        ..Document::default()
    })
}

/// Whether a layer is written.
fn holds(layer: &Layer) -> bool {
    let Values::Rows { width, numbers } = &layer.values else {
        return false;
    };
    let color = matches!(numbers.kind(), Kind::U8 | Kind::F32 | Kind::F64);
    layer.on == On::Vertex
        && match layer.role {
            Role::Normal => *width == 3,
            Role::Color(0) => *width == 3 && color,
            Role::Other => *width == 1,
            _ => false,
        }
}

/// Writes the points with their normals, colours and further numbers. The names of the columns come
/// first where a reader could not tell them.
pub(super) fn encode(document: &Document, w: &mut dyn Write) -> Result<()> {
    let document = &*document.folded();
    let layers: Vec<&Layer> = document.layers.iter().filter(|l| holds(l)).collect();
    let table = table(document, &layers);
    let told = table.layers();
    let meaning = |l: &Layer| (l.role, l.name.clone(), l.values.width());
    let clear = told
        .iter()
        .map(meaning)
        .eq(layers.iter().map(|l| meaning(l)));
    let text = || -> std::io::Result<()> {
        let mut w = BufWriter::new(w);
        if !clear {
            writeln!(
                w,
                "x y z{}",
                layers.iter().map(|l| names(l)).collect::<String>()
            )?;
        }
        for row in table.rows() {
            write!(w, "{} {} {}", row[0], row[1], row[2])?;
            for value in &row[3..] {
                write!(w, " {value}")?;
            }
            writeln!(w)?;
        }
        w.flush()
    };
    text().map_err(|e| Error::io("", e))
}

fn table(document: &Document, layers: &[&Layer]) -> Table {
    let mut table = Table {
        width: 3,
        ..Table::default()
    };
    table.width += layers
        .iter()
        .filter_map(|l| l.values.width())
        .sum::<usize>();
    for (v, p) in document.mesh.positions.iter().enumerate() {
        table.numbers.extend(p.iter());
        for layer in layers {
            let columns = 0..layer.values.width().unwrap_or(0);
            table
                .numbers
                .extend(columns.filter_map(|k| layer.values.get(v, k)));
        }
    }
    table
}

/// The names of a layer's columns, each after a blank.
fn names(layer: &Layer) -> String {
    match layer.role {
        Role::Normal => format!(" {}", NORMAL.join(" ")),
        Role::Color(_) => format!(" {}", COLOR.join(" ")),
        _ => format!(" {}", word(&layer.name)),
    }
}

/// A name as one word that is neither a number nor a comment.
fn word(name: &str) -> String {
    let plain = |c: char| {
        if c.is_ascii() && (separates(c as u8) || c.is_control()) {
            '_'
        } else {
            c
        }
    };
    let name: String = name.chars().map(plain).collect();
    let name = name.replace('#', "_").replace("//", "__");
    if name.is_empty() || is_number(name.as_bytes()) {
        return format!("_{name}");
    }
    name
}

/// What is lost in an XYZ file: the faces, and what is not a number per point.
pub(super) fn losses(document: &Document) -> Vec<String> {
    let faces = counted(document.mesh.polygons.len(), "face");
    let layers = of_layers(&document.folded(), holds);
    faces.into_iter().chain(layers).collect()
}
