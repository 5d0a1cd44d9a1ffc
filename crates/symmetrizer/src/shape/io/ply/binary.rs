//! The body of a binary PLY file as one column of values per property.

use super::header::{Declared, Header};
use super::{column, ends_early};
use crate::error::{Error, Result};
use crate::shape::document::{Kind, Numbers, PlyForm, PlyProperty, Values};

/// The values of every property of every element.
///
/// # Errors
/// [`Error::Input`] with the byte and the element where the file ends early or a list has a
/// negative length.
pub(super) fn columns(header: &Header<'_>) -> Result<Vec<Vec<Values>>> {
    let mut reader = Reader {
        rest: header.body,
        size: header.start + header.body.len(),
        big: header.form == PlyForm::Big,
    };
    header.elements.iter().map(|e| reader.element(e)).collect()
}

/// The bytes of a number.
pub(super) fn size(kind: Kind) -> usize {
    match kind {
        Kind::I8 | Kind::U8 => 1,
        Kind::I16 | Kind::U16 => 2,
        Kind::I32 | Kind::U32 | Kind::F32 => 4,
        Kind::F64 => 8,
    }
}

struct Reader<'a> {
    rest: &'a [u8],
    size: usize,
    big: bool,
}

type Read<T> = std::result::Result<T, Flaw>;

/// Why a value cannot be read.
enum Flaw {
    Ended,
    Negative(f64),
}

impl<'a> Reader<'a> {
    fn element(&mut self, declared: &Declared) -> Result<Vec<Values>> {
        // The shortest possible element: lists may be empty.
        let least: usize = declared
            .properties
            .iter()
            .map(|p| size(p.count.unwrap_or(p.kind)))
            .sum();
        let rows = declared.count.min(self.rest.len() / least.max(1));
        let many = declared.properties.len().max(1);
        let columns = declared
            .properties
            .iter()
            .map(|p| column(p.count, p.kind, rows, self.rest.len() / size(p.kind) / many));
        let columns = columns.collect();
        match declared.properties.iter().all(|p| p.count.is_none()) {
            true => self.table(declared, least, columns),
            false => self.rows(declared, columns),
        }
    }

    /// Elements of one size: each property in one go.
    fn table(
        &mut self,
        declared: &Declared,
        stride: usize,
        mut columns: Vec<Values>,
    ) -> Result<Vec<Values>> {
        let whole = self.rest.len() / stride.max(1);
        if declared.count > whole && stride > 0 {
            let at = self.size - self.rest.len() + whole * stride;
            return Err(ended(declared, whole, at));
        }
        let bytes = self.take(stride * declared.count).unwrap_or_default();
        let mut offset = 0;
        for (property, values) in declared.properties.iter().zip(&mut columns) {
            if let Values::Rows { numbers, .. } = values {
                append(
                    numbers,
                    Strided {
                        bytes,
                        stride,
                        offset,
                    },
                    self.big,
                );
            }
            offset += size(property.kind);
        }
        Ok(columns)
    }

    /// Elements with lists: one after the other.
    fn rows(&mut self, declared: &Declared, mut columns: Vec<Values>) -> Result<Vec<Values>> {
        for index in 0..declared.count {
            let at = self.size - self.rest.len();
            for (property, values) in declared.properties.iter().zip(&mut columns) {
                self.value(property, values).map_err(|flaw| match flaw {
                    Flaw::Ended => ended(declared, index, at),
                    Flaw::Negative(length) => Error::input(
                        format!(
                            "byte {at}: the list '{}' of {} {index} (counted from 0) has {length} entries",
                            property.name, declared.name
                        ),
                        "the file is damaged; export it again",
                    ),
                })?;
            }
        }
        Ok(columns)
    }

    fn value(&mut self, property: &PlyProperty, values: &mut Values) -> Read<()> {
        let width = size(property.kind);
        match values {
            Values::Rows { numbers, .. } => {
                let bytes = self.take(width).ok_or(Flaw::Ended)?;
                append(numbers, packed(bytes, width), self.big);
            }
            Values::Lists { starts, numbers } => {
                let length = self.length(property.count.unwrap_or(Kind::U8))?;
                let bytes = length.checked_mul(width).and_then(|n| self.take(n));
                append(numbers, packed(bytes.ok_or(Flaw::Ended)?, width), self.big);
                starts.push(numbers.len() as u32);
            }
            Values::Pool { .. } | Values::Names { .. } => {}
        }
        Ok(())
    }

    fn length(&mut self, kind: Kind) -> Read<usize> {
        let bytes = self.take(size(kind)).ok_or(Flaw::Ended)?;
        if let (Kind::U8, [length]) = (kind, bytes) {
            return Ok(usize::from(*length));
        }
        let mut length = Numbers::with_capacity(kind, 1);
        append(&mut length, packed(bytes, size(kind)), self.big);
        let length = length.get(0);
        match length < 0.0 {
            true => Err(Flaw::Negative(length)),
            false => Ok(length as usize),
        }
    }

    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(length)?;
        self.rest = rest;
        Some(taken)
    }
}

fn ended(declared: &Declared, index: usize, at: usize) -> Error {
    ends_early(format_args!("byte {at}"), declared, index)
}

/// Numbers in bytes: one at `offset` of every `stride`.
#[derive(Clone, Copy)]
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
    offset: usize,
}

fn packed(bytes: &[u8], width: usize) -> Strided<'_> {
    Strided {
        bytes,
        stride: width,
        offset: 0,
    }
}

fn extend<T, const N: usize>(list: &mut Vec<T>, from: Strided<'_>, number: impl Fn([u8; N]) -> T) {
    if from.stride == N {
        list.extend(from.bytes.as_chunks().0.iter().copied().map(number));
        return;
    }
    let rows = from.bytes.chunks_exact(from.stride.max(1));
    let at_offset = |row: &[u8]| row.get(from.offset..)?.first_chunk().copied();
    list.extend(rows.filter_map(at_offset).map(number));
}

macro_rules! append {
    ($numbers:expr, $from:expr, $big:expr, $($variant:ident $type:ty),*) => {
        match $numbers {
            $(Numbers::$variant(v) => match $big {
                true => extend(v, $from, <$type>::from_be_bytes),
                false => extend(v, $from, <$type>::from_le_bytes),
            }),*
        }
    };
}

fn append(numbers: &mut Numbers, from: Strided<'_>, big: bool) {
    append!(numbers, from, big,
        I8 i8, U8 u8, I16 i16, U16 u16, I32 i32, U32 u32, F32 f32, F64 f64);
}
