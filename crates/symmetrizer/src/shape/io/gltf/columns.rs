//! Layers as attributes of a mesh in a fresh file: which there are, in which type, and their bytes.

use std::ops::Range;

use serde_json::{Map, Value, json};

use super::accessor::{most, size_of};
use super::attribute::{Attribute, attribute_of, direction};
use super::seams::Seams;
use super::writer::{Target, Writer, bounds};
use crate::shape::document::{Document, Kind, Layer, MorphPart, NO_ROW, On, Role};

/// A layer that becomes an attribute.
pub(super) struct Column<'a> {
    pub attribute: Attribute,
    pub layer: &'a Layer,
    kind: Kind,
    normalized: bool,
    width: usize,
}

/// The attributes of a fresh file; where two layers have the same, the first.
pub(super) fn columns(document: &Document) -> Vec<Column<'_>> {
    let mut columns: Vec<Column> = Vec::new();
    for column in document.layers.iter().filter_map(column) {
        if columns.iter().all(|c| c.attribute != column.attribute) {
            columns.push(column);
        }
    }
    columns
}

fn column(layer: &Layer) -> Option<Column<'_>> {
    if layer.on == On::Face || (layer.role == Role::Other && layer.name.is_empty()) {
        return None;
    }
    let attribute = attribute_of(layer.role, &layer.name)?;
    let (kind, width) = (layer.values.numbers()?.kind(), layer.values.width()?);
    let (kind, normalized, width) = form(layer.role, kind, width)?;
    Some(Column {
        attribute,
        layer,
        kind,
        normalized,
        width,
    })
}

/// The type of an attribute, whether it stands for fractions, and its numbers per vertex.
fn form(role: Role, kind: Kind, width: usize) -> Option<(Kind, bool, usize)> {
    let short = matches!(kind, Kind::U8 | Kind::U16);
    let fraction = |width| match short {
        true => Some((kind, true, width)),
        false => Some((Kind::F32, false, width)),
    };
    match (role, width) {
        (Role::Normal | Role::Morph(..), 3) => Some((Kind::F32, false, 3)),
        (Role::Tangent, 3 | 4) => Some((Kind::F32, false, 4)),
        (Role::TexCoord(_), 1..=3) => Some((Kind::F32, false, 2)),
        (Role::Color(_), 3 | 4) | (Role::Weights(_), 4) => fraction(width),
        (Role::Joints(_), 4) => Some((if short { kind } else { Kind::U16 }, false, 4)),
        (Role::Other, 1..=4) => match kind {
            Kind::I8 | Kind::U8 | Kind::I16 | Kind::U16 => Some((kind, false, width)),
            _ => Some((Kind::F32, false, width)),
        },
        (Role::Other, 9 | 16) => Some((Kind::F32, false, width)),
        _ => None,
    }
}

impl Column<'_> {
    /// Adds the values of some vertices to a file and returns their accessor.
    pub fn write(&self, writer: &mut Writer, seams: &Seams, vertices: Range<usize>) -> usize {
        let size = self.width * size_of(self.kind);
        let stride = size.next_multiple_of(4);
        let count = vertices.len();
        let mut bytes = Vec::with_capacity(count * stride);
        let mut singles = Vec::new();
        for v in vertices {
            let start = bytes.len();
            for number in self.row(seams, v) {
                push(&mut bytes, self.kind, number);
                if self.needs_bounds() {
                    singles.push(number as f32);
                }
            }
            bytes.resize(start + stride, 0);
        }
        let view = writer.view(&bytes, Target::Vertices((stride != size).then_some(stride)));
        let mut members = members(view, self.kind, self.width, count);
        if self.normalized {
            members.insert("normalized".into(), json!(true));
        }
        if self.needs_bounds() {
            set_bounds(&mut members, &singles, self.width);
        }
        writer.accessor(members)
    }

    fn needs_bounds(&self) -> bool {
        matches!(self.layer.role, Role::Morph(_, MorphPart::Position))
    }

    /// The numbers of a vertex, as they are to stand in the file.
    fn row(&self, seams: &Seams, v: usize) -> Vec<f64> {
        let element = match self.layer.on {
            On::Corner => seams.corner[v],
            _ => seams.source[v],
        };
        let scale = self.scale();
        let number = |k| {
            self.given(element, k)
                .map_or_else(|| self.missing(k), |n| n * scale)
        };
        let numbers: Vec<f64> = (0..self.width).map(number).collect();
        match direction(self.layer.role) {
            Some(what) => {
                let mut row = [0.0; 4];
                row[..self.width].copy_from_slice(&numbers);
                what.of_unit_length(row)[..self.width].to_vec()
            }
            None => numbers,
        }
    }

    fn given(&self, element: u32, k: usize) -> Option<f64> {
        let has = element != NO_ROW && self.layer.values.width().is_some_and(|w| k < w);
        has.then(|| self.layer.values.get(element as usize, k))
            .flatten()
    }

    /// White, the usual sign of a tangent, or zero.
    fn missing(&self, k: usize) -> f64 {
        match self.layer.role {
            Role::Color(_) => most(self.kind).unwrap_or(1.0),
            Role::Tangent if k == 3 => 1.0,
            _ => 0.0,
        }
    }

    /// Whole colours and weights stand for fractions.
    fn scale(&self) -> f64 {
        let fractions = matches!(self.layer.role, Role::Color(_) | Role::Weights(_));
        let whole = self.layer.values.numbers().and_then(|n| most(n.kind()));
        match whole {
            Some(most) if fractions && self.kind == Kind::F32 => 1.0 / most,
            _ => 1.0,
        }
    }

    /// What of the layer's values the attribute does not hold.
    pub fn loss(&self) -> Option<String> {
        let layer = self.layer;
        let name = match &self.attribute {
            Attribute::Base(name) => name.clone(),
            Attribute::Target(k, name) => format!("{name} of morph target {k}"),
        };
        if layer.values.width().is_some_and(|w| w > self.width) {
            return Some(format!("the third number of {name}"));
        }
        let numbers = layer.values.numbers()?;
        let wide = matches!(numbers.kind(), Kind::F64 | Kind::I32 | Kind::U32);
        let kept = |n: f64| match self.kind {
            Kind::F32 => f64::from((n * self.scale()) as f32) == n * self.scale() || n.is_nan(),
            _ => n >= 0.0 && n <= f64::from(u16::MAX) && n.fract() == 0.0,
        };
        let lossy = wide && !numbers.iter().all(kept);
        lossy.then(|| format!("digits of {name}"))
    }
}

/// The members of an accessor.
pub(super) fn members(view: usize, kind: Kind, width: usize, count: usize) -> Map<String, Value> {
    let component = match kind {
        Kind::I8 => 5120,
        Kind::U8 => 5121,
        Kind::I16 => 5122,
        Kind::U16 => 5123,
        Kind::U32 | Kind::I32 => 5125,
        Kind::F32 | Kind::F64 => 5126,
    };
    let shape = match width {
        1 => "SCALAR",
        2 => "VEC2",
        3 => "VEC3",
        4 => "VEC4",
        9 => "MAT3",
        _ => "MAT4",
    };
    let mut members = Map::new();
    members.insert("bufferView".into(), json!(view));
    members.insert("componentType".into(), json!(component));
    members.insert("count".into(), json!(count));
    members.insert("type".into(), json!(shape));
    members
}

/// Gives an accessor the bounds of its numbers.
pub(super) fn set_bounds(members: &mut Map<String, Value>, numbers: &[f32], width: usize) {
    if let Some((min, max)) = bounds(numbers, width) {
        members.insert("min".into(), min);
        members.insert("max".into(), max);
    }
}

fn push(bytes: &mut Vec<u8>, kind: Kind, number: f64) {
    match kind {
        Kind::I8 => bytes.extend((number.round() as i8).to_le_bytes()),
        Kind::U8 => bytes.extend((number.round() as u8).to_le_bytes()),
        Kind::I16 => bytes.extend((number.round() as i16).to_le_bytes()),
        Kind::U16 => bytes.extend((number.round() as u16).to_le_bytes()),
        Kind::I32 | Kind::U32 => bytes.extend((number.round() as u32).to_le_bytes()),
        Kind::F32 | Kind::F64 => bytes.extend((number as f32).to_le_bytes()),
    }
}
