//! What PLY does not hold of a document, and what no other format holds of a PLY file.

use super::super::losses::{counted, numbered, of_layers};
use super::fate::{Fate, fate};
use super::{PlyKept, rows};
use crate::shape::document::{Document, Layer, On, Role, Values};

/// What is lost when `document` is written as PLY.
pub(in super::super) fn losses(document: &Document) -> Vec<String> {
    let mut lost = of_layers(document, |l| !matches!(fate(document, l), Fate::Lost));
    for layer in &document.layers {
        match fate(document, layer) {
            Fate::Lost => {}
            Fate::Corner => {
                lost.extend(missing(layer));
                lost.extend(third(layer));
                lost.extend(precision(layer));
            }
            Fate::Vertex(_) if layer.on == On::Corner => {}
            Fate::Vertex(_) | Fate::Face => lost.extend(missing(layer)),
        }
    }
    lost
}

/// What other formats lose of the rest of a PLY file.
pub(in super::super) fn of_kept(kept: &PlyKept) -> Vec<String> {
    let others = kept.elements.iter().filter_map(|e| {
        let count = e.properties.first()?.values.as_ref().map(rows)?;
        let rows = numbered(count, "row", "rows")?;
        Some(format!("the element '{}' ({rows})", e.name))
    });
    let remarks = counted(kept.remarks.len(), "comment line");
    others.chain(remarks).collect()
}

/// The textures that comments name.
pub(in super::super) fn companions(kept: &PlyKept) -> Vec<String> {
    let lines = kept
        .remarks
        .iter()
        .map(|r| String::from_utf8_lossy(&r.line));
    let name = |line: &str| {
        let rest = line.trim().strip_prefix("comment")?.trim_start();
        let name = rest.strip_prefix("TextureFile")?.trim();
        (!name.is_empty()).then(|| name.to_owned())
    };
    lines.filter_map(|line| name(&line)).collect()
}

/// Elements without values are written with 0.
fn missing(layer: &Layer) -> Option<String> {
    let Values::Pool { rows, .. } = &layer.values else {
        return None;
    };
    let count = (0..rows.len())
        .filter(|&i| layer.values.row(i).is_none())
        .count();
    let of = match layer.on {
        On::Vertex => "vertices",
        On::Corner => "corners",
        On::Face => "faces",
    };
    let what = match layer.role {
        Role::Normal => "normal".into(),
        Role::TexCoord(_) => "texture coordinates".into(),
        Role::Color(_) => "colour".into(),
        _ => format!("value of '{}'", layer.name),
    };
    (count > 0).then(|| format!("which {count} {of} have no {what} (they get 0)"))
}

/// Lists of a face hold two texture coordinates per corner.
fn third(layer: &Layer) -> Option<String> {
    let (width, numbers) = (layer.values.width()?, layer.values.numbers()?);
    let used = (width > 2)
        && numbers
            .iter()
            .enumerate()
            .any(|(i, n)| i % width > 1 && n != 0.0);
    used.then(|| "the third texture coordinate (per corner)".to_owned())
}

/// Shared texture coordinates become `float`, which is what viewers read.
fn precision(layer: &Layer) -> Option<String> {
    let Values::Pool { numbers, .. } = &layer.values else {
        return None;
    };
    let change = numbers.iter().map(|n| (f64::from(n as f32) - n).abs());
    let most = change.filter(|c| c.is_finite()).fold(0.0, f64::max);
    (most > 0.0)
        .then(|| format!("digits of the texture coordinates, which change by up to {most:.1e}"))
}
