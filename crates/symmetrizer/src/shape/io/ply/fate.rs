//! What becomes of a layer in a PLY file.

use std::borrow::Cow;

use super::names;
use crate::shape::document::{Document, Layer, On, Role, Values};

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
            document
                .agreed(values)
                .map_or(Fate::Lost, |v| Fate::Vertex(Cow::Owned(v)))
        }
        (On::Corner, ..) => Fate::Lost,
    }
}
