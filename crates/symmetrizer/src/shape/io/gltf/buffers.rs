//! The bytes of a file's buffers: its binary chunk, data URIs, files beside it.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use base64::Engine;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use serde_json::Value;

use super::json::{DAMAGED, list, required};
use crate::error::{Error, Result};

/// The bytes of every buffer, whose `uri` is taken out of the JSON; `binary` is the binary chunk.
pub(super) fn load(
    json: &mut Value,
    binary: Option<&[u8]>,
    folder: Option<&Path>,
) -> Result<Vec<Arc<Vec<u8>>>> {
    refuse_compressed(json)?;
    let buffers = all(json, binary, folder)?;
    let objects = json.get_mut("buffers").and_then(Value::as_array_mut);
    for buffer in objects.into_iter().flatten() {
        if let Some(buffer) = buffer.as_object_mut() {
            buffer.shift_remove("uri");
        }
    }
    Ok(buffers)
}

fn all(json: &Value, binary: Option<&[u8]>, folder: Option<&Path>) -> Result<Vec<Arc<Vec<u8>>>> {
    let mut files = BTreeMap::new();
    let mut total = 0_u64;
    let mut buffers = Vec::new();
    for (i, buffer) in list(json, "buffers").iter().enumerate() {
        let place = format!("buffer {i}");
        let length = required(buffer, "byteLength", &place)?;
        total = total.saturating_add(length as u64);
        if total > u64::from(u32::MAX) {
            let what = format!("the buffers up to {place} have more than 4 GiB");
            return Err(Error::input(what, "simplify the mesh first"));
        }
        let uri = buffer.get("uri").and_then(Value::as_str);
        let bytes = match (uri, binary) {
            (None, Some(binary)) if i == 0 => Arc::new(binary.to_vec()),
            (None, _) => {
                let what = format!("{place} has neither a 'uri' nor a binary chunk");
                return Err(Error::input(what, DAMAGED));
            }
            (Some(uri), _) if is_data(uri) => Arc::new(embedded(uri, &place)?),
            // A file that several buffers name is read once.
            (Some(uri), _) => match files.get(&(uri, length)) {
                Some(known) => Arc::clone(known),
                None => {
                    let bytes = Arc::new(beside(uri, length, folder, &place)?);
                    files.insert((uri, length), Arc::clone(&bytes));
                    bytes
                }
            },
        };
        buffers.push(of_length(bytes, length, &place)?);
    }
    Ok(buffers)
}

/// Meshes that another program has packed cannot be unpacked here.
fn refuse_compressed(json: &Value) -> Result<()> {
    let packed = |of: &str, name: &str| {
        let views = list(json, "bufferViews").iter();
        let meshes = list(json, "meshes").iter();
        let primitives = meshes.flat_map(|m| list(m, "primitives"));
        let mut anywhere = views.chain(primitives);
        let mut required = list(json, of).iter();
        required.any(|v| v.as_str() == Some(name))
            || anywhere.any(|v| v.get("extensions").is_some_and(|e| e.get(name).is_some()))
    };
    let names = [
        "KHR_draco_mesh_compression",
        "EXT_meshopt_compression",
        "KHR_meshopt_compression",
    ];
    match names.iter().find(|name| packed("extensionsRequired", name)) {
        Some(name) => Err(Error::input(
            format!("the meshes are compressed with {name}, which is not supported"),
            "export the file without compression",
        )),
        None => Ok(()),
    }
}

fn of_length(mut bytes: Arc<Vec<u8>>, length: usize, place: &str) -> Result<Arc<Vec<u8>>> {
    if bytes.len() < length {
        let what = format!("{place} should have {length} bytes but has {}", bytes.len());
        return Err(Error::input(what, "the data is cut off; export it again"));
    }
    if bytes.len() > length {
        // Padding of the chunk or file.
        Arc::make_mut(&mut bytes).truncate(length);
    }
    Ok(bytes)
}

fn is_data(uri: &str) -> bool {
    uri.get(..5)
        .is_some_and(|s| s.eq_ignore_ascii_case("data:"))
}

fn embedded(uri: &str, place: &str) -> Result<Vec<u8>> {
    let lenient = GeneralPurposeConfig::new()
        .with_decode_allow_trailing_bits(true)
        .with_decode_padding_mode(DecodePaddingMode::Indifferent);
    let engine = GeneralPurpose::new(&base64::alphabet::STANDARD, lenient);
    let parts = uri
        .split_once(',')
        .filter(|(head, _)| head.ends_with(";base64"));
    let Some((_, data)) = parts else {
        return Err(Error::input(
            format!("the data URI of {place} is not in base64"),
            "export it again as .glb",
        ));
    };
    engine.decode(data).map_err(|e| {
        Error::input(
            format!("the data URI of {place} cannot be read: {e}"),
            DAMAGED,
        )
    })
}

/// The first `length` bytes of the file that `uri` names.
fn beside(uri: &str, length: usize, folder: Option<&Path>, place: &str) -> Result<Vec<u8>> {
    let relative = relative_path(uri, place)?;
    let Some(folder) = folder else {
        return Err(Error::input(
            format!("{place} is in another file, '{uri}'"),
            "read the .gltf from its own folder, or convert it to .glb",
        ));
    };
    let path = folder.join(relative);
    let cannot = |e: std::io::Error| {
        Error::input(
            format!("the file '{uri}' of {place} cannot be read: {e}"),
            "put it back beside the .gltf",
        )
    };
    let about = std::fs::metadata(&path).map_err(cannot)?;
    if !about.is_file() {
        let what = format!("'{uri}' of {place} is not a file");
        return Err(Error::input(what, "put the file back beside the .gltf"));
    }
    if about.len() > u64::from(u32::MAX) {
        return Err(Error::input(
            format!("the file '{uri}' of {place} is larger than 4 GiB"),
            "simplify the mesh first",
        ));
    }
    let mut bytes = Vec::new();
    let file = std::fs::File::open(&path).map_err(cannot)?;
    let mut file = file.take(length as u64);
    file.read_to_end(&mut bytes).map_err(cannot)?;
    Ok(bytes)
}

/// The path in a relative URI: below the file's folder, on every system.
fn relative_path(uri: &str, place: &str) -> Result<PathBuf> {
    let refused = |why: &str| {
        Error::input(
            format!("the file '{uri}' of {place} {why}"),
            "put the file beside the .gltf and name it without a path",
        )
    };
    let path = unescaped(uri).ok_or_else(|| refused("has a name that cannot be read"))?;
    if path.is_empty() || path.contains('\0') {
        return Err(refused("has a name that cannot be read"));
    }
    if path.starts_with(['/', '\\']) || path.contains(':') {
        return Err(refused("is named by an address or absolute path"));
    }
    if path.split(['/', '\\']).any(|part| part == "..") {
        return Err(refused("lies outside the folder"));
    }
    Ok(PathBuf::from(path))
}

/// `%20` and the like as the characters they stand for.
pub(super) fn unescaped(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        if first != b'%' {
            bytes.push(first);
            continue;
        }
        let digits = after.get(..2).and_then(|d| std::str::from_utf8(d).ok())?;
        if !digits.bytes().all(|d| d.is_ascii_hexdigit()) {
            return None;
        }
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        rest = &after[2..];
    }
    String::from_utf8(bytes).ok()
}
