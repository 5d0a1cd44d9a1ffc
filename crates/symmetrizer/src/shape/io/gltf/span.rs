//! Ranges of bytes: buffer views and the elements in them.

use std::ops::Range;

use serde_json::Value;

use super::container::File;
use super::json::{DAMAGED, element, list, required, whole};
use crate::error::{Error, Result};

/// Where elements lie in a buffer; the last one ends within it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    pub view: usize,
    pub buffer: usize,
    /// Byte of the first element.
    pub start: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
    /// Bytes of an element.
    pub size: usize,
}

/// Where `count` elements of `size` bytes lie in `view`, offset as `json` says.
pub(super) fn span(
    file: &File,
    json: &Value,
    view: usize,
    count: usize,
    size: usize,
    place: &str,
) -> Result<Span> {
    let (buffer, within, stride) = view_range(file, view, place)?;
    let offset = whole(json, "byteOffset", place)?.unwrap_or(0);
    let stride = stride.unwrap_or(size);
    if stride < size {
        let what = format!("the elements of {place} overlap: {size} bytes every {stride} bytes");
        return Err(Error::input(what, DAMAGED));
    }
    let last = count.saturating_sub(1).checked_mul(stride);
    let bytes = last.and_then(|last| last.checked_add(if count > 0 { size } else { 0 }));
    let start = within.start.checked_add(offset);
    let end = start.zip(bytes).and_then(|(s, b)| s.checked_add(b));
    match (start, end) {
        (Some(start), Some(end)) if end <= within.end => Ok(Span {
            view,
            buffer,
            start,
            stride,
            size,
        }),
        _ => Err(Error::input(
            format!(
                "the {count} elements of {place} end after buffer view {view}, at byte {offset} of its {} bytes",
                within.len()
            ),
            "the file is damaged or cut off; export it again",
        )),
    }
}

/// The buffer, the bytes and the stride of a buffer view.
pub(super) fn view_range(
    file: &File,
    view: usize,
    place: &str,
) -> Result<(usize, Range<usize>, Option<usize>)> {
    let json = element(&file.contents.json, "bufferViews", view, place)?;
    let place = format!("buffer view {view}");
    let buffer = required(json, "buffer", &place)?;
    let size = match file.contents.buffers.get(buffer) {
        Some(bytes) => bytes.len(),
        None => {
            let count = list(&file.contents.json, "buffers").len();
            let what = format!("{place} names buffer {buffer}, but there are only {count}");
            return Err(Error::input(what, DAMAGED));
        }
    };
    let start = whole(json, "byteOffset", &place)?.unwrap_or(0);
    let length = required(json, "byteLength", &place)?;
    let end = start.checked_add(length).filter(|&end| end <= size);
    let end = end.ok_or_else(|| {
        Error::input(
            format!("{place} ({length} bytes from byte {start}) ends after buffer {buffer}, which has {size} bytes"),
            "the file is damaged or cut off; export it again",
        )
    })?;
    Ok((buffer, start..end, whole(json, "byteStride", &place)?))
}
