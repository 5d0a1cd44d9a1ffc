//! The zip file around the parts: finds them, unpacks them within a bound, copies them.

use std::collections::BTreeMap;
use std::io::{Cursor, Read, Write};

use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, DateTime, ZipArchive};

use super::xml::{Elements, Step, Text, shown};
use crate::error::{Error, Result};

/// A part may unpack to this many times the size of the file ...
const RATIO: u64 = 256;
/// ... and this many bytes.
const SLACK: u64 = 16 << 20;

/// An open package.
pub(super) struct Package<'a> {
    archive: ZipArchive<Cursor<&'a [u8]>>,
    /// The names of the entries, with `/` between folders and without a leading one.
    names: Vec<String>,
    /// The entries by their names in lower case.
    entries: BTreeMap<String, usize>,
    /// Bytes that may still be unpacked.
    left: u64,
}

/// How many bytes the content of a file of `size` bytes may take.
pub(super) fn bound(size: usize) -> u64 {
    (size as u64).saturating_mul(RATIO).saturating_add(SLACK)
}

impl<'a> Package<'a> {
    /// Opens the package in the bytes of a file.
    pub fn open(bytes: &'a [u8]) -> Result<Self> {
        let unreadable = |e: zip::result::ZipError| {
            Error::input(
                format!("this is not a readable zip file, as 3MF files are: {e}"),
                "it is cut off or damaged; export it again",
            )
        };
        let archive = ZipArchive::new(Cursor::new(bytes)).map_err(unreadable)?;
        if archive.has_duplicate_names() {
            return Err(Error::input(
                "two parts of the package have the same name",
                "export the file again",
            ));
        }
        let names = (0..archive.len()).map(|i| archive.name_for_index(i));
        let normal = |name: &str| name.replace('\\', "/").trim_start_matches('/').to_owned();
        let names = names.map(|name| match name {
            Some(Ok(name)) => normal(&name),
            _ => String::new(),
        });
        let names: Vec<String> = names.collect();
        let entries = names.iter().enumerate().rev();
        Ok(Self {
            entries: entries.map(|(i, n)| (n.to_ascii_lowercase(), i)).collect(),
            names,
            archive,
            left: bound(bytes.len()),
        })
    }

    /// The names of all entries.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The entry of a part, by its name or the path in a reference; upper and lower case are the
    /// same.
    pub fn find(&self, path: &str) -> Option<usize> {
        let path = path.trim_start_matches('/').to_ascii_lowercase();
        self.entries.get(&path).copied()
    }

    /// The entry of the model that the package starts with.
    pub fn start(&mut self) -> Result<usize> {
        let related = match self.find("_rels/.rels") {
            Some(entry) => self.related(entry)?,
            None => None,
        };
        let any = |n: &String| n.to_ascii_lowercase().ends_with(".model");
        related
            .or_else(|| self.names.iter().position(any))
            .ok_or_else(|| {
                Error::input(
                    format!(
                        "none of the {} parts of the zip file is a 3D model",
                        self.names.len()
                    ),
                    "is this a 3MF file? Export it again",
                )
            })
    }

    /// The entry that the relationships name as the 3D model.
    fn related(&mut self, entry: usize) -> Result<Option<usize>> {
        let text = self.text(entry)?;
        let mut elements = Elements::new(Text {
            part: "_rels/.rels",
            text: &text,
        });
        while let Some(step) = elements.next_step()? {
            let Step::Open(tag) = step else { continue };
            let kind = tag.value("Type")?.unwrap_or_default();
            if tag.local() == "Relationship" && kind.ends_with("/3dmodel") {
                let target = tag.value("Target")?.unwrap_or_default();
                return Ok(self.find(&target));
            }
        }
        Ok(None)
    }

    /// The unpacked text of an entry.
    ///
    /// # Errors
    /// [`Error::Input`] where it is damaged, no UTF-8, or larger than a file of this size may
    /// honestly hold.
    pub fn text(&mut self, entry: usize) -> Result<String> {
        let name = self.names[entry].clone();
        let damaged = |e: &dyn std::fmt::Display| {
            let what = format!("the part {} cannot be unpacked: {e}", shown(&name));
            Error::input(what, "the file is damaged; export it again")
        };
        let file = self.archive.by_index(entry).map_err(|e| damaged(&e))?;
        let mut bytes = Vec::new();
        let unpacked = file.take(self.left + 1).read_to_end(&mut bytes);
        unpacked.map_err(|e| damaged(&e))?;
        if bytes.len() as u64 > self.left {
            return Err(Error::input(
                format!(
                    "the part {} unpacks to over {RATIO} times the size of the file",
                    shown(&name)
                ),
                "no honest model does; if this one does, store it with less compression",
            ));
        }
        self.left -= bytes.len() as u64;
        utf8(&name, bytes)
    }

    /// The package with new texts for some entries; everything else is copied as it is packed.
    pub fn with_texts(&mut self, texts: &BTreeMap<usize, String>) -> Result<Vec<u8>> {
        let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
        for entry in 0..self.archive.len() {
            let file = self.archive.by_index_raw(entry).map_err(unwritable)?;
            let Some(text) = texts.get(&entry) else {
                writer.raw_copy_file(file).map_err(unwritable)?;
                continue;
            };
            let options = file.options().large_file(text.len() as u64 >= LARGE);
            let name = String::from_utf8_lossy(file.name_raw()).into_owned();
            writer.start_file(name, options).map_err(unwritable)?;
            writer
                .write_all(text.as_bytes())
                .map_err(|e| Error::io("", e))?;
        }
        let comment = self.archive.comment().to_vec();
        let commented = writer.set_raw_comment(comment.into_boxed_slice());
        commented.map_err(unwritable)?;
        Ok(writer.finish().map_err(unwritable)?.into_inner())
    }
}

/// Zip needs its longer form from 4 GiB on, packed or not.
const LARGE: u64 = 0xff00_0000;

/// A new package with these parts.
pub(super) fn packed(parts: &[(&str, String)]) -> Result<Vec<u8>> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in parts {
        // Always the same date, so that the same shape makes the same file.
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::default())
            .large_file(text.len() as u64 >= LARGE);
        writer.start_file(*name, options).map_err(unwritable)?;
        writer
            .write_all(text.as_bytes())
            .map_err(|e| Error::io("", e))?;
    }
    Ok(writer.finish().map_err(unwritable)?.into_inner())
}

fn unwritable(error: zip::result::ZipError) -> Error {
    match error {
        zip::result::ZipError::Io(e) => Error::io("", e),
        other => Error::input(
            format!("the parts of the package cannot be copied: {other}"),
            "the file is damaged; export it again",
        ),
    }
}

fn utf8(name: &str, bytes: Vec<u8>) -> Result<String> {
    String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        let what = format!("{}, byte {at}: this is not UTF-8 text", shown(name));
        Error::input(what, "export the file again, with UTF-8 text")
    })
}
