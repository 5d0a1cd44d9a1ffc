//! Adding data to a file: bytes, views of them, accessors.

use std::sync::Arc;

use serde_json::{Map, Value, json};

use super::container::Contents;
use super::json::{append, object_mut};
use crate::error::{Error, Result};
use crate::geom::Point;

/// A file that grows.
pub(super) struct Writer {
    pub json: Value,
    pub buffers: Vec<Arc<Vec<u8>>>,
}

/// What a buffer view is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    /// Attributes of vertices, this many bytes apart where that is not their size.
    Vertices(Option<usize>),
    /// Corners of faces.
    Corners,
}

impl Writer {
    /// Adds `bytes` to the first buffer and returns a view of them.
    pub fn view(&mut self, bytes: &[u8], target: Target) -> usize {
        if self.buffers.is_empty() {
            self.buffers.push(Arc::default());
            append(&mut self.json, "buffers", json!({}));
        }
        let buffer = Arc::make_mut(&mut self.buffers[0]);
        buffer.resize(buffer.len().next_multiple_of(4), 0);
        let start = buffer.len();
        buffer.extend_from_slice(bytes);
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() });
        match target {
            Target::Vertices(stride) => {
                if let Some(stride) = stride {
                    view["byteStride"] = json!(stride);
                }
                view["target"] = json!(34962);
            }
            Target::Corners => view["target"] = json!(34963),
        }
        append(&mut self.json, "bufferViews", view)
    }

    /// Adds an accessor with the given members.
    pub fn accessor(&mut self, members: Map<String, Value>) -> usize {
        append(&mut self.json, "accessors", Value::Object(members))
    }

    /// The whole file.
    pub fn finish(mut self) -> Contents {
        for (i, bytes) in self.buffers.iter().enumerate() {
            if let Some(buffer) = object_mut(&mut self.json, &[&"buffers", &i]) {
                buffer.insert("byteLength".into(), json!(bytes.len()));
            }
        }
        Contents {
            json: self.json,
            buffers: self.buffers,
        }
    }
}

/// The bytes of numbers in single precision.
pub(super) fn bytes_of(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

/// The position of vertex `v` in single precision.
pub(super) fn single(p: Point, v: usize) -> Result<[f32; 3]> {
    let single = [p.x, p.y, p.z].map(|c| c as f32);
    let too_large = p
        .iter()
        .zip(single)
        .any(|(c, s)| c.is_finite() && !s.is_finite());
    if too_large {
        return Err(Error::input(
            format!("vertex {v} lies too far away for glTF, which has single precision"),
            "scale the shape down, or write .ply or .obj",
        ));
    }
    Ok(single)
}

/// The least and the greatest of the `width` finite numbers of all rows; `None` where one has no
/// finite number.
pub(super) fn bounds(numbers: &[f32], width: usize) -> Option<(Value, Value)> {
    let mut low = vec![f32::INFINITY; width];
    let mut high = vec![f32::NEG_INFINITY; width];
    for row in numbers.chunks_exact(width) {
        for (k, &n) in row.iter().enumerate().filter(|(_, n)| n.is_finite()) {
            low[k] = low[k].min(n);
            high[k] = high[k].max(n);
        }
    }
    let known = low.iter().zip(&high).all(|(l, h)| l <= h);
    known.then(|| (exact(&low), exact(&high)))
}

/// Numbers that a reader takes for the same in single precision.
fn exact(numbers: &[f32]) -> Value {
    numbers.iter().map(|&n| f64::from(n)).collect()
}
