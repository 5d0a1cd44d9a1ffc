//! Writing OBJ.

use std::io::{BufWriter, Result as IoResult, Write};

use super::super::losses::of_layers;
use super::super::text::one_line;
use crate::error::{Error, Result};
use crate::shape::document::{Document, Kept, Layer, NO_ROW, Numbers, On, Role, Values};

/// Writes an OBJ file; numbers in the shortest form that reads back to the same bits.
pub(in super::super) fn encode(document: &Document, w: &mut dyn Write) -> Result<()> {
    let text = || -> IoResult<()> {
        let mut w = BufWriter::new(w);
        head(document, &mut w)?;
        vertices(document, &mut w)?;
        let textures = Rows::of(document, Role::TexCoord(0));
        let normals = Rows::of(document, Role::Normal);
        textures.write("vt", &mut w)?;
        normals.write("vn", &mut w)?;
        faces(document, [&textures, &normals], &mut w)?;
        if let Kept::Obj(kept) = &document.kept {
            for statement in &kept.statements {
                line(statement, &mut w)?;
            }
        }
        w.flush()
    };
    text().map_err(|e| Error::io("", e))
}

/// What OBJ cannot say of `document`.
pub(in super::super) fn losses(document: &Document) -> Vec<String> {
    of_layers(document, holds)
}

fn holds(layer: &Layer) -> bool {
    let width = layer.values.width();
    match (layer.role, layer.on) {
        (Role::Color(0), On::Vertex) => matches!(width, Some(3 | 4)),
        (Role::TexCoord(0), On::Vertex | On::Corner) => matches!(width, Some(1..=3)),
        (Role::Normal, On::Vertex | On::Corner) => width == Some(3),
        (Role::Object | Role::Group | Role::Material | Role::Smoothing, On::Face) => true,
        (Role::Other, On::Vertex) => layer.name == "w" && width == Some(1),
        _ => false,
    }
}

fn head(document: &Document, w: &mut dyn Write) -> IoResult<()> {
    let Kept::Obj(kept) = &document.kept else {
        return Ok(());
    };
    for comment in &kept.comments {
        line(comment, w)?;
    }
    for library in &kept.libraries {
        line(&format!("mtllib {library}"), w)?;
    }
    Ok(())
}

fn vertices(document: &Document, w: &mut dyn Write) -> IoResult<()> {
    let is_extra =
        |l: &&Layer| l.on == On::Vertex && matches!(l.role, Role::Color(0) | Role::Other);
    let extra = document.layers.iter().filter(is_extra).find(|l| holds(l));
    for (v, p) in document.mesh.positions.iter().enumerate() {
        write!(w, "v {} {} {}", p.x, p.y, p.z)?;
        if let Some((layer, row)) = extra.and_then(|l| Some((l, l.values.row(v)?))) {
            let numbers = layer.values.numbers();
            let width = layer.values.width().unwrap_or(0);
            for k in 0..width {
                write!(w, " {}", numbers.map_or(0.0, |n| shade(n, row * width + k)))?;
            }
        }
        writeln!(w)?;
    }
    Ok(())
}

/// A colour value from 0 to 1: those of whole types count to the type's maximum.
fn shade(numbers: &Numbers, i: usize) -> f64 {
    let value = numbers.get(i);
    match numbers {
        Numbers::U8(_) => value / 255.0,
        Numbers::U16(_) => value / 65535.0,
        _ => value,
    }
}

/// The rows of a layer that corners name, be it per vertex or per corner.
struct Rows<'a> {
    layer: Option<&'a Layer>,
}

impl<'a> Rows<'a> {
    fn of(document: &'a Document, role: Role) -> Self {
        let on_corners = document.layer(On::Corner, role);
        let layer = on_corners.or_else(|| document.layer(On::Vertex, role));
        Self {
            layer: layer.filter(|l| holds(l)),
        }
    }

    fn write(&self, keyword: &str, w: &mut dyn Write) -> IoResult<()> {
        let values = self.layer.map(|l| &l.values);
        let parts = values.and_then(|v| Some((v.numbers()?, v.width()?)));
        let Some((numbers, width)) = parts else {
            return Ok(());
        };
        for row in 0..numbers.len() / width.max(1) {
            write!(w, "{keyword}")?;
            for k in 0..width {
                write!(w, " {}", numbers.get(row * width + k))?;
            }
            writeln!(w)?;
        }
        Ok(())
    }

    /// The row, counted from 1, of corner `corner` at vertex `vertex`.
    fn at(&self, corner: usize, vertex: u32) -> Option<usize> {
        let layer = self.layer?;
        let element = match layer.on {
            On::Vertex => vertex as usize,
            _ => corner,
        };
        layer.values.row(element).map(|row| row + 1)
    }
}

/// The keywords of the names that faces stand under, in the order in which they are written.
const NAMES: [(&str, Role); 4] = [
    ("o", Role::Object),
    ("g", Role::Group),
    ("usemtl", Role::Material),
    ("s", Role::Smoothing),
];

fn faces(document: &Document, rows: [&Rows<'_>; 2], w: &mut dyn Write) -> IoResult<()> {
    let named = |(keyword, role)| Some((keyword, document.layer(On::Face, role)?));
    let names: Vec<(&str, &Layer)> = NAMES.into_iter().filter_map(named).collect();
    let mut now = vec![NO_ROW; names.len()];
    let mut corner = 0;
    for (f, polygon) in document.mesh.polygons.iter().enumerate() {
        for ((keyword, layer), now) in names.iter().zip(&mut now) {
            let Values::Names { of, .. } = &layer.values else {
                continue;
            };
            if of[f] != *now {
                *now = of[f];
                let name = layer.values.name(f).unwrap_or("");
                line(&format!("{keyword} {}", one_line(name)), w)?;
            }
        }
        write!(w, "f")?;
        for &v in polygon {
            write!(w, " {}", u64::from(v) + 1)?;
            match rows.map(|r| r.at(corner, v)) {
                [None, None] => {}
                [Some(texture), None] => write!(w, "/{texture}")?,
                [None, Some(normal)] => write!(w, "//{normal}")?,
                [Some(texture), Some(normal)] => write!(w, "/{texture}/{normal}")?,
            }
            corner += 1;
        }
        writeln!(w)?;
    }
    Ok(())
}

/// A line, with a blank after a backslash at its end, which would join it with the next.
fn line(text: &str, w: &mut dyn Write) -> IoResult<()> {
    let text = text.trim_end();
    let end = if text.ends_with('\\') { " " } else { "" };
    writeln!(w, "{text}{end}")
}
