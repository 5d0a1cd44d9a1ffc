//! Writing OFF.

use std::io::{BufWriter, Result as IoResult, Write};

use super::super::losses::of_layers;
use crate::error::{Error, Result};
use crate::shape::document::{Document, Kind, Layer, On, Role};

/// Writes an OFF file; numbers in the shortest form that reads back to the same bits.
pub(in super::super) fn encode(document: &Document, w: &mut dyn Write) -> Result<()> {
    let document = &*document.folded();
    let text = || -> IoResult<()> {
        let mut w = BufWriter::new(w);
        let mesh = &document.mesh;
        let columns = columns(document);
        let (vertices, faces) = (mesh.positions.len(), mesh.polygons.len());
        writeln!(w, "{}\n{vertices} {faces} 0", keyword(&columns))?;
        for (v, p) in mesh.positions.iter().enumerate() {
            write!(w, "{} {} {}", p.x, p.y, p.z)?;
            for layer in &columns {
                values(layer, v, &mut w)?;
            }
            writeln!(w)?;
        }
        let color = document
            .layer(On::Face, Role::Color(0))
            .filter(|l| holds(l));
        for (f, polygon) in mesh.polygons.iter().enumerate() {
            write!(w, "{}", polygon.len())?;
            for v in polygon {
                write!(w, " {v}")?;
            }
            if let Some(layer) = color {
                values(layer, f, &mut w)?;
            }
            writeln!(w)?;
        }
        w.flush()
    };
    text().map_err(|e| Error::io("", e))
}

/// What OFF cannot say of `document`.
pub(in super::super) fn losses(document: &Document) -> Vec<String> {
    of_layers(&document.folded(), holds)
}

fn holds(layer: &Layer) -> bool {
    let width = layer.values.width();
    let complete = |on| layer.on == on && layer.values.is_complete();
    match layer.role {
        Role::Normal => complete(On::Vertex) && width == Some(3),
        Role::TexCoord(0) => complete(On::Vertex) && width == Some(2),
        Role::Color(0) => {
            let fits = matches!(width, Some(3 | 4));
            fits && (complete(On::Vertex) || layer.on == On::Face)
        }
        _ => false,
    }
}

/// The layers that follow a position: normal, colour, texture coordinates.
fn columns(document: &Document) -> Vec<&Layer> {
    let roles = [Role::Normal, Role::Color(0), Role::TexCoord(0)];
    let layers = roles
        .into_iter()
        .filter_map(|role| document.layer(On::Vertex, role));
    layers.filter(|l| holds(l)).collect()
}

fn keyword(columns: &[&Layer]) -> String {
    let has = |role, prefix| match columns.iter().any(|l| l.role == role) {
        true => prefix,
        false => "",
    };
    let texture = has(Role::TexCoord(0), "ST");
    let color = has(Role::Color(0), "C");
    let normal = has(Role::Normal, "N");
    format!("{texture}{color}{normal}OFF")
}

/// The values of an element, each after a space.
fn values(layer: &Layer, element: usize, w: &mut dyn Write) -> IoResult<()> {
    let values = &layer.values;
    let whole = layer.role == Role::Color(0);
    for k in 0..values.width().unwrap_or(0) {
        let Some(value) = values.get(element, k) else {
            return Ok(());
        };
        match values.numbers().map(|n| n.kind()) {
            Some(Kind::U8) if whole => write!(w, " {value}")?,
            Some(Kind::U16) if whole => write!(w, " {:?}", value / 65535.0)?,
            // With a point even where it is whole: 1 would be the darkest but one of 256.
            _ if whole => write!(w, " {value:?}")?,
            _ => write!(w, " {value}")?,
        }
    }
    Ok(())
}
