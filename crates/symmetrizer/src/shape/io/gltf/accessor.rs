//! Accessors: typed numbers in a buffer. Every range is checked before anything is read.

use serde_json::Value;

use super::container::File;
use super::json::{DAMAGED, element, required, whole};
use super::span::{Span, span};
use crate::error::{Error, Result};
use crate::shape::document::{Kind, Numbers};

/// A checked accessor.
#[derive(Debug, Clone)]
pub(super) struct Accessor {
    pub index: usize,
    pub kind: Kind,
    /// Whether whole numbers stand for fractions of the type's maximum.
    pub normalized: bool,
    /// Numbers per element.
    pub width: usize,
    /// How many elements there are.
    pub count: usize,
    /// Where they lie; `None` where they are zeros.
    pub dense: Option<Span>,
    pub sparse: Option<Sparse>,
    column: Column,
}

/// A column of a matrix, or a whole vector.
#[derive(Debug, Clone, Copy)]
struct Column {
    numbers: usize,
    bytes: usize,
}

/// Elements that replace others.
#[derive(Debug, Clone)]
pub(super) struct Sparse {
    count: usize,
    kind: Kind,
    indices: Span,
    values: Span,
}

impl Accessor {
    /// Accessor `index`, which `place` names.
    pub fn new(file: &File, index: usize, place: &str) -> Result<Self> {
        let json = element(&file.contents.json, "accessors", index, place)?;
        let place = format!("accessor {index}");
        let kind = kind(json, &place)?;
        let (width, column) = shape(json, kind, &place)?;
        let count = required(json, "count", &place)?;
        let size = width / column.numbers * column.bytes;
        let dense = match whole(json, "bufferView", &place)? {
            Some(view) => Some(span(file, json, view, count, size, &place)?),
            None => None,
        };
        let sparse = match json.get("sparse") {
            Some(json) => Some(sparse(file, json, count, size, &place)?),
            None => None,
        };
        Ok(Self {
            index,
            kind,
            normalized: json.get("normalized").and_then(Value::as_bool) == Some(true),
            width,
            count,
            dense,
            sparse,
            column,
        })
    }

    /// All numbers as they stand in the file.
    pub fn numbers(&self, file: &File) -> Result<Numbers> {
        let count = self.count.checked_mul(self.width);
        let count = count.ok_or_else(|| too_many(self.index))?;
        file.charge(count)?;
        let mut numbers = Numbers::with_capacity(self.kind, count);
        match &self.dense {
            Some(span) => {
                (0..self.count).for_each(|i| self.element(file, span, i, |n| numbers.push(n)));
            }
            None => (0..count).for_each(|_| numbers.push(0.0)),
        }
        if let Some(sparse) = &self.sparse {
            self.replace(file, sparse, &mut numbers)?;
        }
        Ok(numbers)
    }

    /// All numbers, with whole ones that stand for fractions as these fractions.
    pub fn floats(&self, file: &File) -> Result<Vec<f64>> {
        let numbers = self.numbers(file)?;
        let unit = if self.normalized {
            most(self.kind)
        } else {
            None
        };
        Ok(match unit {
            Some(most) => numbers.iter().map(|n| (n / most).max(-1.0)).collect(),
            None => numbers.iter().collect(),
        })
    }

    fn element(&self, file: &File, span: &Span, i: usize, mut each: impl FnMut(f64)) {
        let start = span.start + i * span.stride;
        let bytes = &file.contents.buffers[span.buffer][start..start + span.size];
        let number = size_of(self.kind);
        for column in bytes.chunks_exact(self.column.bytes) {
            let numbers = column.chunks_exact(number).take(self.column.numbers);
            numbers.for_each(|bytes| each(read(self.kind, bytes)));
        }
    }

    fn replace(&self, file: &File, sparse: &Sparse, numbers: &mut Numbers) -> Result<()> {
        let Span {
            buffer,
            start,
            stride,
            size,
            ..
        } = sparse.indices;
        for i in 0..sparse.count {
            let at = start + i * stride;
            let bytes = &file.contents.buffers[buffer][at..at + size];
            let index = read(sparse.kind, bytes) as usize;
            if index >= self.count {
                return Err(Error::input(
                    format!(
                        "the sparse part of accessor {} replaces element {index}, but there are only {}",
                        self.index, self.count
                    ),
                    DAMAGED,
                ));
            }
            let mut k = index * self.width;
            self.element(file, &sparse.values, i, |n| {
                numbers.set(k, n);
                k += 1;
            });
        }
        Ok(())
    }
}

/// The largest number of a whole type that stands for fractions.
pub(super) fn most(kind: Kind) -> Option<f64> {
    match kind {
        Kind::I8 => Some(f64::from(i8::MAX)),
        Kind::U8 => Some(f64::from(u8::MAX)),
        Kind::I16 => Some(f64::from(i16::MAX)),
        Kind::U16 => Some(f64::from(u16::MAX)),
        Kind::I32 => Some(f64::from(i32::MAX)),
        Kind::U32 => Some(f64::from(u32::MAX)),
        Kind::F32 | Kind::F64 => None,
    }
}

/// Bytes of a number.
pub(super) fn size_of(kind: Kind) -> usize {
    match kind {
        Kind::I8 | Kind::U8 => 1,
        Kind::I16 | Kind::U16 => 2,
        Kind::I32 | Kind::U32 | Kind::F32 => 4,
        Kind::F64 => 8,
    }
}

fn kind(json: &Value, place: &str) -> Result<Kind> {
    match required(json, "componentType", place)? {
        5120 => Ok(Kind::I8),
        5121 => Ok(Kind::U8),
        5122 => Ok(Kind::I16),
        5123 => Ok(Kind::U16),
        5125 => Ok(Kind::U32),
        5126 => Ok(Kind::F32),
        other => Err(Error::input(
            format!("{place} has the unknown component type {other}"),
            DAMAGED,
        )),
    }
}

/// Numbers per element, and its columns, which start at multiples of four bytes in a matrix.
fn shape(json: &Value, kind: Kind, place: &str) -> Result<(usize, Column)> {
    let name = json.get("type").and_then(Value::as_str).unwrap_or("");
    let column = |numbers, to: usize| Column {
        numbers,
        bytes: (numbers * size_of(kind)).next_multiple_of(to),
    };
    match name {
        "SCALAR" => Ok((1, column(1, 1))),
        "VEC2" => Ok((2, column(2, 1))),
        "VEC3" => Ok((3, column(3, 1))),
        "VEC4" => Ok((4, column(4, 1))),
        "MAT2" => Ok((4, column(2, 4))),
        "MAT3" => Ok((9, column(3, 4))),
        "MAT4" => Ok((16, column(4, 4))),
        other => {
            let shown: String = other.chars().take(40).collect();
            let what = format!("{place} has the unknown type '{shown}'");
            Err(Error::input(what, DAMAGED))
        }
    }
}

fn sparse(file: &File, json: &Value, count: usize, size: usize, of: &str) -> Result<Sparse> {
    let place = format!("the sparse part of {of}");
    let replaced = required(json, "count", &place)?;
    if replaced > count {
        let what = format!("{place} replaces {replaced} of {count} elements");
        return Err(Error::input(what, DAMAGED));
    }
    let part = |key: &str| json.get(key).unwrap_or(&Value::Null);
    let (indices, values) = (part("indices"), part("values"));
    let kind = kind(indices, &place)?;
    if !matches!(kind, Kind::U8 | Kind::U16 | Kind::U32) {
        let what = format!("{place} has indices that are no unsigned whole numbers");
        return Err(Error::input(what, DAMAGED));
    }
    let at = |part: &Value, size| {
        let view = required(part, "bufferView", &place)?;
        span(file, part, view, replaced, size, &place)
    };
    Ok(Sparse {
        count: replaced,
        kind,
        indices: at(indices, size_of(kind))?,
        values: at(values, size)?,
    })
}

fn read(kind: Kind, bytes: &[u8]) -> f64 {
    match *bytes {
        [a] if kind == Kind::I8 => f64::from(a as i8),
        [a] => f64::from(a),
        [a, b] if kind == Kind::I16 => f64::from(i16::from_le_bytes([a, b])),
        [a, b] => f64::from(u16::from_le_bytes([a, b])),
        [a, b, c, d] if kind == Kind::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
        [a, b, c, d] => f64::from(u32::from_le_bytes([a, b, c, d])),
        _ => f64::NAN,
    }
}

fn too_many(index: usize) -> Error {
    Error::input(format!("accessor {index} has too many elements"), DAMAGED)
}
