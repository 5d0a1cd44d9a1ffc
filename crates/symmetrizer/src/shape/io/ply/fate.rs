//! What becomes of a layer in a PLY file.

use std::borrow::Cow;

use super::names;
use crate::shape::document::{Document, Layer, NO_ROW, On, Role, Values};

/// Where a layer goes.
pub(super) enum Fate<'a> {
    Vertex(Cow<'a, Values>),
    Face,
    Corner,
    Lost,
}

/// How PLY holds a layer of the document.
pub(super) fn fate<'a>(document: &'a Document, layer: &'a Layer) -> Fate<'a> {
    match (layer.on, layer.role, &layer.values) {
        (On::Face, role, Values::Names { .. }) => {
            let first = document.layer(On::Face, role);
            let is_first = first.is_some_and(|first| std::ptr::eq(first, layer));
            match names::property(role).is_some() && is_first {
                true => Fate::Face,
                false => Fate::Lost,
            }
        }
        (_, _, Values::Names { .. }) => Fate::Lost,
        (On::Face, ..) => Fate::Face,
        (On::Vertex, _, values) => Fate::Vertex(Cow::Borrowed(values)),
        (On::Corner, Role::TexCoord(_), values) => match values.width() {
            Some(2..) => Fate::Corner,
            _ => Fate::Lost,
        },
        (On::Corner, Role::Normal | Role::Color(_), values)
            if document.layer(On::Vertex, layer.role).is_none() =>
        {
            agreed(document, values).map_or(Fate::Lost, |v| Fate::Vertex(Cow::Owned(v)))
        }
        (On::Corner, ..) => Fate::Lost,
    }
}

/// Values of corners as values of vertices, where all corners of each vertex have the same.
fn agreed(document: &Document, values: &Values) -> Option<Values> {
    let (width, numbers) = (values.width()?, values.numbers()?);
    let mut of = vec![NO_ROW; document.mesh.positions.len()];
    for (i, &v) in document.mesh.polygons.iter().flatten().enumerate() {
        let row = values.row(i)?;
        let known = of.get_mut(v as usize)?;
        if *known == NO_ROW {
            *known = row as u32;
        }
        let number = |row: usize, k: usize| numbers.get(row * width + k).to_bits();
        if !(0..width).all(|k| number(row, k) == number(*known as usize, k)) {
            return None;
        }
    }
    Some(Values::Pool {
        width,
        numbers: numbers.clone(),
        rows: of,
    })
}
