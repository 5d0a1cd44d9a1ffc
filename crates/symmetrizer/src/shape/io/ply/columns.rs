//! The columns of a sheet: their types and where their numbers come from.

use std::borrow::Cow;

use super::fate::Fate;
use super::layout::{Column, Source};
use super::{ascii, names};
use crate::shape::document::{Document, Kind, Layer, PlyProperty, Role, Values};

/// The coordinates: of the type that the file had where that is a float or holds all of them; for
/// another document `float` where that loses nothing, else `double`.
pub(super) fn axes<'a>(document: &Document, properties: &[PlyProperty]) -> Vec<Column<'a>> {
    let positions = &document.mesh.positions;
    let fits = |i: usize, kind: Kind| positions.iter().all(|p| ascii::holds(kind, p[i]));
    let single = (0..3).all(|i| fits(i, Kind::F32));
    let in_range = |i: usize| {
        positions
            .iter()
            .all(|p| (p[i] as f32).is_finite() || !p[i].is_finite())
    };
    let kind = |i: usize| {
        let property = properties.iter().find(|p| p.name == AXES[i]);
        match property.map(|p| p.kind) {
            Some(kind) if fits(i, kind) || (kind == Kind::F32 && in_range(i)) => kind,
            None if single => Kind::F32,
            _ => Kind::F64,
        }
    };
    let column = |i: usize| Column {
        name: AXES[i].into(),
        kind: kind(i),
        longest: None,
        count: None,
        source: Source::Axis(i),
        place: None,
    };
    (0..3).map(column).collect()
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// The polygons, with the types that the file had where they suffice.
pub(super) fn corners<'a>(document: &Document, properties: &[PlyProperty]) -> Column<'a> {
    let mut lists = properties.iter().filter(|p| p.count.is_some());
    let before = lists.find(|p| matches!(p.name.as_str(), "vertex_indices" | "vertex_index"));
    let vertices = document.mesh.positions.len();
    let longest = document.mesh.polygons.iter().map(<[u32]>::len).max();
    let kind = before.map(|p| p.kind).filter(|&k| !k.is_float());
    Column {
        name: before.map_or("vertex_indices", |p| &p.name).into(),
        kind: kind
            .filter(|&k| vertices <= holds(k) as usize + 1)
            .unwrap_or(Kind::I32),
        longest: Some(longest.unwrap_or(0)),
        count: None,
        source: Source::Corners,
        place: None,
    }
}

/// A property of an element that is neither vertices nor faces.
pub(super) fn other(property: &PlyProperty) -> Option<Column<'_>> {
    let values = property.values.as_ref()?;
    plain(property.name.clone(), values)
}

/// Values under a name of their own.
fn plain(name: String, values: &Values) -> Option<Column<'_>> {
    let kind = values.numbers()?.kind();
    let (longest, source) = match values {
        Values::Lists { starts, .. } => {
            let longest = starts.windows(2).map(|s| (s[1] - s[0]) as usize).max();
            (Some(longest.unwrap_or(0)), Source::Lists(values))
        }
        _ => (None, Source::Number(Cow::Borrowed(values), 0)),
    };
    Some(Column {
        name,
        kind,
        longest,
        count: None,
        source,
        place: None,
    })
}

/// The columns of a layer under `names`, which the file had where it `is_kept`; names that are its
/// values become `comments`.
pub(super) fn of_layer<'a>(
    document: &'a Document,
    layer: &'a Layer,
    (fate, is_kept): (Fate<'a>, bool),
    names: Vec<String>,
    comments: &mut String,
) -> Vec<Column<'a>> {
    let first = names.first().cloned().unwrap_or_default();
    let values = match (fate, &layer.values) {
        (Fate::Corner, values) => return vec![of_corners(document, values, first)],
        (_, Values::Names { names: list, of }) => {
            comments.push_str(&names::comments(&first, list));
            return vec![Column {
                name: first,
                kind: Kind::I32,
                longest: None,
                count: None,
                source: Source::Name(of),
                place: None,
            }];
        }
        (_, values @ Values::Lists { .. }) => return plain(first, values).into_iter().collect(),
        (Fate::Vertex(values), _) => values,
        (_, values) => Cow::Borrowed(values),
    };
    let Some(numbers) = values.numbers() else {
        return Vec::new();
    };
    let colour = matches!(layer.role, Role::Color(_)) && !is_kept;
    let bytes = colour && numbers.kind().is_float() && numbers.iter().all(is_byte);
    let kind = if bytes { Kind::U8 } else { numbers.kind() };
    let column = |(k, name)| Column {
        name,
        kind,
        longest: None,
        count: None,
        source: match bytes {
            true => Source::Byte(values.clone(), k),
            false => Source::Number(values.clone(), k),
        },
        place: None,
    };
    names.into_iter().enumerate().map(column).collect()
}

/// Whether a colour is one of 8 bits with three digits or more; half a step would let all pass.
fn is_byte(value: f64) -> bool {
    let step = value * 255.0;
    (0.0..=1.0).contains(&value) && (step - step.round()).abs() < 0.0006 * 255.0
}

fn of_corners<'a>(document: &Document, values: &'a Values, name: String) -> Column<'a> {
    let polygons = &document.mesh.polygons;
    let longest = polygons.iter().map(<[u32]>::len).max().unwrap_or(0);
    let mut next = 0;
    let starts = polygons.iter().map(|polygon| {
        let first = next;
        next += polygon.len() as u32;
        first
    });
    let kind = match values {
        // Viewers expect `float` here.
        Values::Pool { .. } => Kind::F32,
        _ => values.numbers().map_or(Kind::F32, |n| n.kind()),
    };
    Column {
        name,
        kind,
        longest: Some(2 * longest),
        count: None,
        source: Source::Corner(values, starts.collect()),
        place: None,
    }
}
/// The largest number of a whole type, as far as it counts here.
fn holds(kind: Kind) -> u32 {
    match kind {
        Kind::I8 => 127,
        Kind::U8 => 255,
        Kind::I16 => 32_767,
        Kind::U16 => 65_535,
        Kind::I32 => i32::MAX as u32,
        _ => u32::MAX,
    }
}

/// The type of a list's length: the one that the file had where that suffices, else `uchar`, which
/// every reader takes, and `uint` only where a list needs it.
pub(super) fn count(longest: usize, before: Option<Kind>) -> Kind {
    let suffices = |&k: &Kind| longest <= holds(k) as usize;
    let fresh = if suffices(&Kind::U8) {
        Kind::U8
    } else {
        Kind::U32
    };
    before.filter(suffices).unwrap_or(fresh)
}
