//! What the columns of a written PLY file are: a sheet per element, a column per property.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::fate::{Fate, fate};
use super::{columns, naming, rows};
use crate::shape::document::{Document, Kept, Kind, PlyElement, PlyKept, PlyProperty, Values};

/// An element of the file.
pub(super) struct Sheet<'a> {
    pub name: &'a str,
    pub rows: usize,
    pub columns: Vec<Column<'a>>,
    /// Comments that belong before it.
    pub comments: String,
    /// Its line in the header that is kept.
    pub place: Option<usize>,
}

/// A property of the file.
pub(super) struct Column<'a> {
    pub name: String,
    pub kind: Kind,
    /// Of lists: the length of the longest.
    pub longest: Option<usize>,
    /// Of lists: the type of their length.
    pub count: Option<Kind>,
    pub source: Source<'a>,
    /// Its line in the header that is kept.
    pub place: Option<usize>,
}

/// Where the numbers of a column come from.
pub(super) enum Source<'a> {
    /// One coordinate of the positions.
    Axis(usize),
    /// The polygons.
    Corners,
    /// One number of each row, 0 where there is no row.
    Number(Cow<'a, Values>, usize),
    /// The same, from 0..1 to 0..255.
    Byte(Cow<'a, Values>, usize),
    /// The lists.
    Lists(&'a Values),
    /// Two numbers of each corner of a polygon; the first corner of each polygon.
    Corner(&'a Values, Vec<u32>),
    /// The number of the name, -1 where there is none.
    Name(&'a [u32]),
}

/// The sheets of the document, in the order that is kept; else vertices, then faces.
pub(super) fn sheets(document: &Document) -> Vec<Sheet<'_>> {
    let kept = kept(document);
    let mut sheets = Vec::new();
    let mut place = 1;
    for element in kept.map_or(&[][..], |k| &k.elements) {
        sheets.push(sheet(document, &element.name, Some((element, place))));
        place += 1 + element.properties.len();
    }
    let has = |sheets: &[Sheet<'_>], name| sheets.iter().any(|s| s.name == name);
    if !has(&sheets, "vertex") {
        sheets.insert(0, sheet(document, "vertex", None));
    }
    if !has(&sheets, "face") && !document.mesh.polygons.is_empty() {
        let after = sheets.iter().position(|s| s.name == "vertex").unwrap_or(0) + 1;
        sheets.insert(after, sheet(document, "face", None));
    }
    sheets
}

/// What is kept of the PLY file that the document comes from.
pub(super) fn kept(document: &Document) -> Option<&PlyKept> {
    match &document.kept {
        Kept::Ply(kept) => Some(kept),
        _ => None,
    }
}

fn sheet<'a>(
    document: &'a Document,
    name: &'a str,
    kept: Option<(&'a PlyElement, usize)>,
) -> Sheet<'a> {
    let properties = kept.map_or(&[][..], |(e, _)| &e.properties);
    let mut sheet = Sheet {
        name,
        rows: match name {
            "vertex" => document.mesh.positions.len(),
            "face" => document.mesh.polygons.len(),
            _ => properties
                .first()
                .and_then(|p| p.values.as_ref())
                .map_or(0, rows),
        },
        columns: match name {
            "vertex" => columns::axes(document, properties),
            "face" => vec![columns::corners(document, properties)],
            _ => properties.iter().filter_map(columns::other).collect(),
        },
        comments: String::new(),
        place: kept.map(|k| k.1),
    };
    if matches!(name, "vertex" | "face") {
        add_layers(document, properties, &mut sheet);
    }
    // Stable: what is not kept stays behind, in the order of the layers.
    let line = |c: &Column<'_>| properties.iter().position(|p| p.name == c.name);
    sheet
        .columns
        .sort_by_cached_key(|c| line(c).unwrap_or(usize::MAX));
    for column in &mut sheet.columns {
        column.place = line(column).and_then(|l| Some(kept?.1 + 1 + l));
        let before = properties.iter().find(|p| p.name == column.name);
        let count = before.and_then(|p| p.count);
        column.count = column.longest.map(|longest| columns::count(longest, count));
    }
    sheet
}

fn add_layers<'a>(document: &'a Document, properties: &[PlyProperty], sheet: &mut Sheet<'a>) {
    let mut used: BTreeSet<String> = sheet.columns.iter().map(|c| c.name.clone()).collect();
    let layers = document.layers.iter().filter_map(|layer| {
        let fate = fate(document, layer);
        let (on, width) = match fate {
            Fate::Vertex(_) => ("vertex", layer.values.width().unwrap_or(1)),
            Fate::Face => ("face", layer.values.width().unwrap_or(1)),
            Fate::Corner => ("face", 1),
            Fate::Lost => return None,
        };
        (on == sheet.name).then_some((layer, fate, width))
    });
    let mut layers: Vec<_> = layers.map(|l| (l, None)).collect();
    // The kept names go to those who had them; only then are new ones made.
    for ((layer, _, width), names) in &mut layers {
        *names = naming::own_names(layer, *width, properties, &used);
        used.extend(names.iter().flatten().cloned());
    }
    for ((layer, fate, width), own) in layers {
        let is_kept = own.is_some();
        let names = own.unwrap_or_else(|| naming::new_names(layer, width, &used));
        used.extend(names.iter().cloned());
        let comments = &mut sheet.comments;
        let columns = columns::of_layer(document, layer, (fate, is_kept), names, comments);
        sheet.columns.extend(columns);
    }
}
