//! Face corners: `v`, `v/vt`, `v//vn`, `v/vt/vn`, counted from 1 or backwards from -1.

use super::super::text::{shown, str_of};
use crate::shape::document::NO_ROW;

/// A corner that names no vertex.
pub(super) const NO_VERTEX: u32 = u32::MAX;

/// The 0-based vertex, texture coordinate and normal of a corner; those that are not given, or not
/// a number, are [`NO_ROW`]. The second value is false where the vertex is not an index at all.
pub(super) fn corner(word: &[u8], counts: [usize; 3]) -> ([u32; 3], bool) {
    let mut parts = word.split(|&b| b == b'/');
    let indices = counts.map(|count| parts.next().and_then(|part| index(part, count)));
    let named = indices.map(|i| i.unwrap_or(NO_ROW));
    (named, indices[0].is_some())
}

/// The 0-based index of a word; a negative one counts back from the last of `count`.
fn index(part: &[u8], count: usize) -> Option<u32> {
    let value = str_of(part)?.parse::<i64>().ok()?;
    let index = match value {
        1.. => value - 1,
        0 => return None,
        _ => value.saturating_add(count as i64),
    };
    u32::try_from(index).ok().filter(|&i| i != NO_VERTEX)
}

/// What is wrong with a corner that names no vertex.
pub(super) fn bad(word: &[u8], count: usize) -> String {
    format!(
        "the face corner '{}' does not name one of the {count} vertices above it; they count from \
         1, or from -1 backwards",
        shown(word)
    )
}

/// The corners of a line or point element with negative indices made absolute, because these depend
/// on where in the file they stand.
pub(super) fn absolute<'a>(words: impl Iterator<Item = &'a [u8]>, counts: [usize; 3]) -> String {
    let one = |word: &'a [u8]| {
        let parts = word.split(|&b| b == b'/').zip(counts);
        let parts: Vec<String> = parts.map(|(p, count)| from_one(p, count)).collect();
        parts.join("/")
    };
    let all: Vec<String> = words.map(one).collect();
    all.join(" ")
}

fn from_one(part: &[u8], count: usize) -> String {
    match index(part, count) {
        Some(i) if part.starts_with(b"-") => (u64::from(i) + 1).to_string(),
        _ => String::from_utf8_lossy(part).into_owned(),
    }
}
