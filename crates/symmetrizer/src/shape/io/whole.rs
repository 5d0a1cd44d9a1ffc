//! Whole-or-nothing output files: written beside their place, renamed into it when complete.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::temporary::Temporary;
use crate::error::{Error, Result};

/// An output file that is reserved before the slow work and appears when that has succeeded.
///
/// Until [`Output::commit`] the target is as it was; dropped without it, nothing is left behind.
/// Nor is it when the process is killed, on Linux and file systems with unnamed files.
#[derive(Debug)]
pub struct Output {
    target: PathBuf,
    file: BufWriter<Temporary>,
}

impl Output {
    /// Reserves the output file `path`, with a temporary file in the same directory.
    ///
    /// # Errors
    /// [`Error::Input`] where `path` is a directory, a device, or in a directory that does not
    /// exist; [`Error::Io`] where the directory, or the file to be replaced, is not writable.
    pub fn create(path: &Path) -> Result<Self> {
        // Through a link, so that what it points to is replaced and not the link.
        let target = match fs::canonicalize(path) {
            Ok(target) => target,
            Err(_) if path.is_symlink() => return Err(leads_nowhere().in_file(path)),
            Err(_) => path.to_owned(),
        };
        let replaced = replaced(&target).map_err(|e| e.in_file(path))?;
        let temporary = beside(&target).map_err(|e| e.in_file(path))?;
        if let Some(replaced) = replaced {
            let permissions = temporary.file().set_permissions(replaced.permissions());
            permissions.map_err(|e| Error::io(path, e))?;
        }
        Ok(Self {
            target,
            file: BufWriter::new(temporary),
        })
    }

    /// Where the file will appear.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Writes a piece of the file, after the pieces written before.
    ///
    /// # Errors
    /// Those of `content`; its input and system errors without a path get that of the target.
    pub fn write(&mut self, content: impl FnOnce(&mut dyn Write) -> Result<()>) -> Result<()> {
        content(&mut self.file).map_err(|e| e.in_file(&self.target))
    }

    /// Completes the file: its bytes reach the disk, then it takes the place of the target in one
    /// step.
    ///
    /// # Errors
    /// [`Error::Io`], with the target as it was before.
    pub fn commit(self) -> Result<()> {
        let Self { target, file } = self;
        let complete = || -> std::io::Result<()> {
            let temporary = file.into_inner().map_err(|e| e.into_error())?;
            temporary.file().sync_all()?;
            temporary.rename(folder(&target), &target)?;
            // Without this a power cut may undo the rename. The file is in its place either way.
            let _ = File::open(folder(&target)).and_then(|f| f.sync_all());
            Ok(())
        };
        complete().map_err(|e| Error::io(&target, e))
    }
}

fn leads_nowhere() -> Error {
    Error::input(
        "this is a link to a file that is not there",
        "remove the link, or name the file itself",
    )
}

/// The file that the output will replace, if there is one; it must be a writable regular file.
fn replaced(target: &Path) -> Result<Option<Metadata>> {
    let metadata = match fs::metadata(target) {
        Ok(metadata) => metadata,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
        Err(e) => return Err(Error::io("", e)),
    };
    if metadata.is_dir() {
        return Err(Error::input("this is a directory", "name a file in it"));
    }
    if !metadata.is_file() {
        return Err(Error::input(
            "this is a device or a pipe, which cannot be replaced by a file",
            "name a regular file",
        ));
    }
    // A rename needs no permission on the file itself, but who protects a file means it.
    let writable = OpenOptions::new().append(true).open(target);
    writable.map_err(|e| Error::io("", e))?;
    Ok(Some(metadata))
}

/// A temporary file in the directory of `target`, so that the rename stays on one disk.
fn beside(target: &Path) -> Result<Temporary> {
    if target.file_name().is_none() {
        return Err(Error::input("this is not a file name", "name a file"));
    }
    let directory = folder(target);
    if !directory.is_dir() {
        return Err(Error::input(
            format!("there is no directory {}", directory.display()),
            "create it first, or correct the path",
        ));
    }
    Temporary::create(directory).map_err(|e| Error::io("", e))
}

/// The directory of a file.
fn folder(target: &Path) -> &Path {
    match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}
