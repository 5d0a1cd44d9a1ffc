//! Files that are not what their extension says: what downloads and archives leave behind.

use crate::error::{Error, Result};

/// Fails for a web page, a Git LFS pointer or an archive under the name of a shape.
pub(super) fn check(bytes: &[u8], packed: bool) -> Result<()> {
    let start = bytes[..bytes.len().min(64)]
        .trim_ascii_start()
        .to_ascii_lowercase();
    let begins = |with: &[&[u8]]| with.iter().any(|w| start.starts_with(w));
    let refuse = |what: &str, hint: &str| Err(Error::input(format!("byte 0: {what}"), hint));
    if begins(&[b"<!doctype html", b"<html"]) {
        return refuse(
            "this is a web page",
            "the download failed; fetch the file itself",
        );
    }
    if begins(&[b"version https://git-lfs"]) {
        return refuse(
            "this is a Git LFS pointer, not the file itself",
            "run `git lfs pull` where it comes from",
        );
    }
    let archive = bytes.starts_with(&[0x1f, 0x8b])
        || bytes.starts_with(b"BZh")
        || bytes.starts_with(b"\xfd7zXZ")
        || bytes.starts_with(b"7z\xbc\xaf")
        || bytes.starts_with(&[0x28, 0xb5, 0x2f, 0xfd])
        || (bytes.starts_with(b"PK\x03\x04") && !packed);
    if archive {
        return refuse("this is a compressed archive", "unpack it first");
    }
    Ok(())
}
