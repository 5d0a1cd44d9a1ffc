//! The body of a text PLY file as one column of values per property.
//!
//! Read word by word: C programs print numbers such as `5.` and `.5`, and break elements over
//! lines. Values that the header does not declare are passed over to the end of their line.

use super::super::text::{Part, Words, number, str_of};
use super::header::{Declared, Header};
use super::{column, is_corners, is_position};
use crate::error::Result;
use crate::shape::document::{Kind, Numbers, PlyProperty, Values};

/// The values of every property of every element. Coordinates are double, whatever the header
/// says, so that no digit is lost; a column with a number that its type does not hold is double
/// too.
///
/// # Errors
/// [`crate::Error::Input`] with the line of a word that is no number, or where the file ends early.
pub(super) fn columns(header: &Header<'_>) -> Result<Vec<Vec<Values>>> {
    let mut words = Words::new(header.body, header.line, None);
    let size = header.body.len();
    let elements = header.elements.iter();
    elements.map(|e| element(&mut words, e, size)).collect()
}

fn element(words: &mut Words<'_>, declared: &Declared, size: usize) -> Result<Vec<Values>> {
    // A value takes a digit and a separator.
    let room = size / 2 + 1;
    let share = room / declared.properties.len().max(1);
    let mut columns: Vec<Values> = declared
        .properties
        .iter()
        .map(|p| column(p.count, kind(declared, p), declared.count.min(share), share))
        .collect();
    let mut properties = declared.properties.iter();
    let corners = properties.position(|p| is_corners(declared, p));
    for index in 0..declared.count {
        let part = Part(&declared.name, index);
        for (p, values) in columns.iter_mut().enumerate() {
            value(words, part, Some(p) == corners, values)?;
        }
        words.skip_line();
    }
    Ok(columns)
}

fn kind(declared: &Declared, property: &PlyProperty) -> Kind {
    if is_position(declared, property) {
        Kind::F64
    } else if is_corners(declared, property) {
        Kind::U32
    } else {
        property.kind
    }
}

fn value(words: &mut Words<'_>, part: Part<'_>, indices: bool, values: &mut Values) -> Result<()> {
    match values {
        Values::Rows { numbers, .. } => push(numbers, words, part),
        Values::Lists { starts, numbers } => {
            for _ in 0..words.index(part)? {
                match numbers {
                    Numbers::U32(indices_) if indices => indices_.push(words.index(part)?),
                    _ => push(numbers, words, part)?,
                }
            }
            starts.push(numbers.len() as u32);
            Ok(())
        }
        Values::Pool { .. } | Values::Names { .. } => Ok(()),
    }
}

fn push(numbers: &mut Numbers, words: &mut Words<'_>, part: Part<'_>) -> Result<()> {
    let word = words.word_of(part)?;
    let value = number(word, words.line())?;
    // Not by way of the double: that would round twice.
    let single = str_of(word).and_then(|text| text.parse::<f32>().ok());
    if let (Numbers::F32(v), Some(single)) = (&mut *numbers, single)
        && single.is_infinite() == value.is_infinite()
    {
        v.push(single);
        return Ok(());
    }
    if !holds(numbers.kind(), value) {
        *numbers = Numbers::F64(numbers.iter().collect());
    }
    numbers.push(value);
    Ok(())
}

/// Whether `value` is a number of the type.
pub(super) fn holds(kind: Kind, value: f64) -> bool {
    let (low, high) = match kind {
        Kind::I8 => (f64::from(i8::MIN), f64::from(i8::MAX)),
        Kind::U8 => (0.0, f64::from(u8::MAX)),
        Kind::I16 => (f64::from(i16::MIN), f64::from(i16::MAX)),
        Kind::U16 => (0.0, f64::from(u16::MAX)),
        Kind::I32 => (f64::from(i32::MIN), f64::from(i32::MAX)),
        Kind::U32 => (0.0, f64::from(u32::MAX)),
        Kind::F32 => return value.is_nan() || f64::from(value as f32) == value,
        Kind::F64 => return true,
    };
    let negative_zero = value == 0.0 && value.is_sign_negative();
    value.fract() == 0.0 && (low..=high).contains(&value) && !negative_zero
}
