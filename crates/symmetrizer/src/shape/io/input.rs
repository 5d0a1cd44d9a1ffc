//! Input files: what cannot be read as a whole is refused before it is opened.

use std::fs::{self, File, Metadata};
use std::io::Read;
use std::path::Path;

use crate::error::{Error, Result};

/// Files end before this size, so that every index into one fits in 32 bits.
const LIMIT: u64 = 1 << 32;

const SAVE: &str = "save what comes out of it to a file, and name that file";

/// The bytes of a regular file.
///
/// # Errors
/// [`Error::Input`] for anything that is no regular file, and from 4 GiB on; [`Error::Io`] where
/// the system does not let it be read.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>> {
    check(path)?;
    let file = File::open(path).map_err(|e| Error::io(path, e))?;
    let size = file.metadata().map_or(0, |m| m.len());
    let mut bytes = Vec::with_capacity(usize::try_from(size.min(LIMIT)).unwrap_or(0));
    // Another program may still be writing to it.
    let read = file.take(LIMIT).read_to_end(&mut bytes);
    read.map_err(|e| Error::io(path, e))?;
    Ok(bytes)
}

/// Fails where `path` is no regular file, or too large a one. Opens nothing, because opening a pipe
/// would wait for its other end.
///
/// # Errors
/// As for [`bytes`].
pub(super) fn check(path: &Path) -> Result<()> {
    if path == Path::new("-") {
        let what = "the standard input cannot be read as a shape file";
        return Err(Error::input(what, SAVE));
    }
    let metadata = fs::metadata(path).map_err(|e| Error::io(path, e))?;
    if let Some((what, hint)) = irregular(&metadata) {
        return Err(Error::input(what, hint).in_file(path));
    }
    check_size(metadata.len()).map_err(|e| e.in_file(path))
}

/// Fails from 4 GiB on.
pub(super) fn check_size(bytes: u64) -> Result<()> {
    if bytes < LIMIT {
        return Ok(());
    }
    Err(Error::input(
        "the file is larger than 4 GiB",
        "simplify it first",
    ))
}

/// What it is and what to do instead, if it is no regular file.
fn irregular(metadata: &Metadata) -> Option<(&'static str, &'static str)> {
    if metadata.is_dir() {
        return Some(("this is a directory", "name a file in it"));
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;

        let kind = metadata.file_type();
        if kind.is_fifo() {
            return Some(("this is a pipe, which cannot be read as a shape file", SAVE));
        }
        if kind.is_socket() {
            return Some((
                "this is a socket, which cannot be read as a shape file",
                SAVE,
            ));
        }
        if kind.is_char_device() || kind.is_block_device() {
            return Some((
                "this is a device, which cannot be read as a shape file",
                SAVE,
            ));
        }
    }
    (!metadata.is_file()).then_some(("this is not a regular file", "name a mesh or a drawing"))
}
