//! The elements of an XML text, one after the other.

use quick_xml::events::Event;
use quick_xml::reader::Reader;

use super::tag::Tag;
use crate::error::{Error, Result};

/// What comes next in a text.
pub(super) enum Step<'a> {
    /// An element starts.
    Open(Tag<'a>),
    /// An element ends.
    Close {
        /// Its local name.
        name: &'a str,
        /// Where its start tag starts.
        start: usize,
        /// Where its end tag starts; its end where it has none.
        tag: usize,
        /// Where it ends.
        end: usize,
    },
}

/// The text of a part with the part's name for messages.
#[derive(Clone, Copy)]
pub(super) struct Text<'a> {
    /// The name of the part.
    pub part: &'a str,
    /// The text.
    pub text: &'a str,
}

/// Steps through the elements of a text.
pub(super) struct Elements<'a> {
    document: Text<'a>,
    reader: Reader<&'a [u8]>,
    /// Bytes before the reader's text: a byte-order mark.
    skipped: usize,
    /// The open elements: local name and start.
    open: Vec<(&'a str, usize)>,
    /// An element without content that has been opened and not yet closed.
    empty: bool,
}

impl<'a> Text<'a> {
    /// An input error at a byte of the text.
    pub fn error(self, at: usize, what: impl std::fmt::Display, hint: &str) -> Error {
        let before = self.text.as_bytes().get(..at).unwrap_or_default();
        let line = 1 + before.iter().filter(|&&b| b == b'\n').count();
        let part = self.part;
        Error::input(format!("{part}, line {line} (byte {at}): {what}"), hint)
    }
}

impl<'a> Elements<'a> {
    /// The elements of a text.
    pub fn new(document: Text<'a>) -> Self {
        let plain = document.text.trim_start_matches('\u{feff}');
        Self {
            document,
            reader: Reader::from_str(plain),
            skipped: document.text.len() - plain.len(),
            open: Vec::new(),
            empty: false,
        }
    }

    /// The local names of the elements around the tag that was opened last, outermost first; it
    /// is the last of them.
    pub fn path(&self) -> impl Iterator<Item = &'a str> {
        self.open.iter().map(|(name, _)| *name)
    }

    /// How many elements are open.
    pub fn depth(&self) -> usize {
        self.open.len()
    }

    /// The next start or end of an element; `None` at the end of the text.
    pub fn next_step(&mut self) -> Result<Option<Step<'a>>> {
        if std::mem::take(&mut self.empty) {
            return Ok(self.close(self.position(), self.position()));
        }
        loop {
            let start = self.position();
            let event = self.reader.read_event();
            match event.map_err(|e| self.damaged(&e))? {
                Event::Start(tag) => return self.opened(start, tag.name().0.len(), false),
                Event::Empty(tag) => return self.opened(start, tag.name().0.len(), true),
                Event::End(_) => return Ok(self.close(start, self.position())),
                Event::Eof => return self.ended(),
                _ => {}
            }
        }
    }

    fn position(&self) -> usize {
        self.skipped + self.reader.buffer_position() as usize
    }

    fn opened(&mut self, start: usize, name: usize, empty: bool) -> Result<Option<Step<'a>>> {
        let end = self.position().saturating_sub(1 + usize::from(empty));
        let text = self.document.text;
        let parts = text
            .get(start + 1..end)
            .zip(text.get(start + 1..start + 1 + name));
        let Some((inside, name)) = parts else {
            return Err(self.document.error(start, "a damaged tag", EXPORT));
        };
        self.open.push((local(name), start));
        self.empty = empty;
        Ok(Some(Step::Open(Tag::new(
            self.document,
            inside,
            name,
            start,
        ))))
    }

    fn close(&mut self, tag: usize, end: usize) -> Option<Step<'a>> {
        let (name, start) = self.open.pop()?;
        Some(Step::Close {
            name,
            start,
            tag,
            end,
        })
    }

    fn ended(&self) -> Result<Option<Step<'a>>> {
        match self.open.last() {
            None => Ok(None),
            Some((name, start)) => Err(self.document.error(
                *start,
                format!("the text ends within the element <{}>", shown(name)),
                "the file is cut off; export it again",
            )),
        }
    }

    fn damaged(&self, error: &quick_xml::Error) -> Error {
        let at = self.skipped + self.reader.error_position() as usize;
        self.document.error(at, format!("XML: {error}"), EXPORT)
    }
}

/// The hint for text that is no XML.
pub(super) const EXPORT: &str = "the file is damaged; export it again";

/// A name without its prefix.
pub(super) fn local(name: &str) -> &str {
    name.rsplit(':').next().unwrap_or(name)
}

/// The start of a piece of the file, for a message.
pub(super) fn shown(text: &str) -> String {
    let start: String = text.chars().take(40).collect();
    start.escape_debug().to_string()
}

/// A string as it may stand in a quoted attribute. Characters that XML does not allow become
/// replacement characters.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\t' | '\n' | '\r' => out += &format!("&#{};", c as u32),
            '\0'..'\u{20}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            other => out.push(other),
        }
    }
    out
}
