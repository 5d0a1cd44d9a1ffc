//! The outer form: text, or a binary file of chunks; and what both hold.

use std::borrow::Cow;
use std::cell::Cell;
use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use base64::Engine;
use serde_json::{Value, json};

use super::buffers;
use super::json::{DAMAGED, list};
use crate::error::{Error, Result};

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BINARY_CHUNK: u32 = 0x004E_4942;

/// JSON without the `uri` of its buffers, and the buffers.
pub(super) struct Contents {
    pub json: Value,
    pub buffers: Vec<Arc<Vec<u8>>>,
}

/// A file being read. How many numbers it may give is bounded by its size, because a few bytes of
/// JSON can name the same data over and over.
pub(super) struct File {
    pub contents: Contents,
    left: Cell<u64>,
}

/// A mesh that is used often gives many times its bytes, so that small files may give more.
const NUMBERS_PER_BYTE: u64 = 256;
const NUMBERS_PER_BYTE_OF_LARGE: u64 = 8;
const LARGE: u64 = 1 << 26;

impl File {
    fn new(contents: Contents, json_bytes: usize) -> Self {
        let buffers = contents.buffers.iter().map(|b| b.len() as u64);
        let bytes = buffers.sum::<u64>() + json_bytes as u64;
        let small = bytes.saturating_mul(NUMBERS_PER_BYTE).min(LARGE);
        let left = Cell::new(small.max(bytes.saturating_mul(NUMBERS_PER_BYTE_OF_LARGE)));
        Self { contents, left }
    }

    /// A file that was read before, so that its size is known to be right.
    pub fn known(json: &Value, buffers: &[Arc<Vec<u8>>]) -> Self {
        let contents = Contents {
            json: json.clone(),
            buffers: buffers.to_vec(),
        };
        let left = Cell::new(u64::MAX);
        Self { contents, left }
    }

    /// Takes `count` numbers off what the file may give.
    pub fn charge(&self, count: usize) -> Result<()> {
        let left = self.left.get().checked_sub(count as u64);
        let Some(left) = left else {
            return Err(Error::input(
                "the file's meshes are used so often that they give far more data than it has bytes",
                "export fewer instances, or each as a mesh of its own",
            ));
        };
        self.left.set(left);
        Ok(())
    }
}

/// The file in `bytes`.
pub(super) fn open(bytes: Vec<u8>, folder: Option<&Path>) -> Result<File> {
    let (text, binary) = if bytes.starts_with(MAGIC) {
        let (text, binary) = chunks(&bytes)?;
        (Cow::Borrowed(text), binary)
    } else {
        (plain(&bytes), None)
    };
    let mut json: Value = serde_json::from_slice(&text).map_err(|e| {
        Error::input(
            format!("the JSON cannot be read: {e}"),
            "is this a glTF file? Otherwise it is damaged; export it again",
        )
    })?;
    check_version(&json)?;
    let buffers = buffers::load(&mut json, binary, folder)?;
    Ok(File::new(Contents { json, buffers }, text.len()))
}

/// Without the mark that some programs put at the start of a text.
fn plain(bytes: &[u8]) -> Cow<'_, [u8]> {
    Cow::Borrowed(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes))
}

fn check_version(json: &Value) -> Result<()> {
    let version = json.pointer("/asset/version").and_then(Value::as_str);
    match version {
        Some(v) if v.split('.').next() == Some("2") => Ok(()),
        Some(v) => Err(Error::input(
            format!("this is glTF {v}"),
            "export it as glTF 2.0",
        )),
        None => Err(Error::input(
            "the JSON has no 'asset.version'",
            "is this a glTF file?",
        )),
    }
}

/// The JSON and the binary chunk of a binary file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>)> {
    let (version, length) = (word(bytes, 4)?, word(bytes, 8)?);
    if version != 2 {
        return Err(Error::input(
            format!("this is binary glTF {version}"),
            "export it as glTF 2.0",
        ));
    }
    let Some(bytes) = bytes.get(..length as usize) else {
        return Err(cut_off(format!(
            "the file should have {length} bytes but has {}",
            bytes.len()
        )));
    };
    let (mut text, mut binary) = (None, None);
    let mut at = 12;
    // What is left after the last chunk may be up to three bytes of padding.
    while at + 8 <= bytes.len() {
        let (size, kind) = (word(bytes, at)? as usize, word(bytes, at + 4)?);
        let end = (at + 8).checked_add(size);
        let chunk = end.and_then(|end| bytes.get(at + 8..end));
        let chunk = chunk.ok_or_else(|| {
            cut_off(format!(
                "the chunk at byte {at} should have {size} bytes but the file ends before"
            ))
        })?;
        match kind {
            JSON_CHUNK if text.is_none() => text = Some(chunk),
            BINARY_CHUNK if binary.is_none() => binary = Some(chunk),
            _ => {}
        }
        at += 8 + size;
    }
    let text = text.ok_or_else(|| Error::input("the file has no JSON chunk", DAMAGED))?;
    Ok((text, binary))
}

fn word(bytes: &[u8], at: usize) -> Result<u32> {
    let word = bytes.get(at..at + 4).and_then(|w| w.try_into().ok());
    word.map(u32::from_le_bytes)
        .ok_or_else(|| cut_off(format!("the file ends at byte {}", bytes.len())))
}

fn cut_off(what: String) -> Error {
    Error::input(what, "the file is cut off; export it again")
}

/// Writes the text form: one file, its buffers as data URIs.
pub(super) fn write_text(contents: Contents, w: &mut dyn Write) -> Result<()> {
    let Contents { mut json, buffers } = contents;
    for (i, bytes) in buffers.iter().enumerate() {
        let data = base64::engine::general_purpose::STANDARD.encode(bytes.as_slice());
        if let Some(buffer) = json.pointer_mut(&format!("/buffers/{i}")) {
            buffer["uri"] = json!(format!("data:application/octet-stream;base64,{data}"));
        }
    }
    serde_json::to_writer_pretty(&mut *w, &json).map_err(|e| system(e.into()))?;
    w.write_all(b"\n").map_err(system)
}

/// Writes the binary form: one file, its buffers made one.
pub(super) fn write_binary(contents: Contents, w: &mut dyn Write) -> Result<()> {
    let Contents { mut json, buffers } = contents;
    let binary = merged(&mut json, buffers);
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let padding = binary
        .as_ref()
        .map_or(0, |b| b.len().next_multiple_of(4) - b.len());
    let chunk = binary.as_ref().map_or(0, |b| 8 + b.len() + padding);
    let Ok(length) = u32::try_from(12 + 8 + text.len() + chunk) else {
        return Err(Error::input(
            "the file would be larger than 4 GiB, which binary glTF cannot hold",
            "write .ply or .obj instead",
        ));
    };
    let mut words = |values: &[u32]| {
        let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_le_bytes()).collect();
        w.write_all(&bytes).map_err(system)
    };
    words(&[u32::from_le_bytes(*b"glTF"), 2, length])?;
    words(&[text.len() as u32, JSON_CHUNK])?;
    w.write_all(&text).map_err(system)?;
    if let Some(binary) = binary {
        let header = [(binary.len() + padding) as u32, BINARY_CHUNK].map(u32::to_le_bytes);
        w.write_all(header.as_flattened()).map_err(system)?;
        w.write_all(&binary).map_err(system)?;
        w.write_all(&[0; 4][..padding]).map_err(system)?;
    }
    Ok(())
}

/// All buffers in one, their views moved; `None` where there are none.
fn merged(json: &mut Value, mut buffers: Vec<Arc<Vec<u8>>>) -> Option<Arc<Vec<u8>>> {
    if buffers.len() < 2 {
        return buffers.pop();
    }
    let mut bytes = Vec::new();
    let mut starts = Vec::new();
    for buffer in &buffers {
        bytes.resize(bytes.len().next_multiple_of(8), 0);
        starts.push(bytes.len());
        bytes.extend_from_slice(buffer);
    }
    let views = json.get_mut("bufferViews").and_then(Value::as_array_mut);
    for view in views.into_iter().flatten() {
        let of = view.get("buffer").and_then(super::json::as_whole);
        let offset = view.get("byteOffset").and_then(super::json::as_whole);
        if let Some(start) = of.and_then(|of| starts.get(of)) {
            view["buffer"] = json!(0);
            view["byteOffset"] = json!(start + offset.unwrap_or(0));
        }
    }
    let mut first = list(json, "buffers").first().cloned().unwrap_or(json!({}));
    first["byteLength"] = json!(bytes.len());
    json["buffers"] = json!([first]);
    Some(Arc::new(bytes))
}

fn system(e: std::io::Error) -> Error {
    Error::io("", e)
}
