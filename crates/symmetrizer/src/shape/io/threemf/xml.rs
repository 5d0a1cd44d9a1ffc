//! The tags of an XML text, with the place of each tag and attribute in it.
//!
//! Places are byte ranges of the text, so that a change replaces a few characters and leaves all
//! others as they came.

use std::ops::Range;

use quick_xml::XmlVersion;
use quick_xml::events::Event;
use quick_xml::events::attributes::{Attribute, Attributes};
use quick_xml::reader::Reader;

use crate::error::{Error, Result};

/// A start tag, or an element without content.
#[derive(Clone, Copy)]
pub(super) struct Tag<'a> {
    document: Text<'a>,
    /// Between `<` and `>`.
    inside: &'a str,
    /// The name as it stands, with its prefix.
    name: &'a str,
    /// Where the tag starts.
    pub start: usize,
}

/// An attribute and where it stands.
pub(super) struct Place {
    /// Name, sign and quoted value.
    pub whole: Range<usize>,
    /// The value without its quotes.
    pub value: Range<usize>,
}

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
        Ok(Some(Step::Open(Tag {
            document: self.document,
            inside,
            name,
            start,
        })))
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

const EXPORT: &str = "the file is damaged; export it again";

impl<'a> Tag<'a> {
    /// The prefix of the name with its colon, or nothing.
    pub fn prefix(&self) -> &'a str {
        &self.name[..self.name.len() - local(self.name).len()]
    }

    /// The name without its prefix.
    pub fn local(&self) -> &'a str {
        local(self.name)
    }

    /// The value of an attribute of the format's core, which has no prefix.
    pub fn value(&self, name: &str) -> Result<Option<String>> {
        self.find(|key| key == name)?
            .map(|a| self.plain(&a))
            .transpose()
    }

    /// The value of an attribute of an extension, which has some prefix.
    pub fn extended(&self, name: &str) -> Result<Option<String>> {
        let found = self.find(|key| key.contains(':') && local(key) == name)?;
        found.map(|a| self.plain(&a)).transpose()
    }

    /// An attribute that must be there, as a number.
    pub fn number(&self, name: &str) -> Result<f64> {
        let wanted = "a coordinate such as -0.25 or 1e-3 belongs there";
        self.parsed(name, wanted)?.ok_or_else(|| self.missing(name))
    }

    /// An attribute that must be there, as an index or id.
    pub fn index(&self, name: &str) -> Result<u32> {
        self.optional_index(name)?.ok_or_else(|| self.missing(name))
    }

    /// An attribute as an index or id, where it is there.
    pub fn optional_index(&self, name: &str) -> Result<Option<u32>> {
        self.parsed(name, "indices and ids are whole numbers from 0")
    }

    fn parsed<T: std::str::FromStr>(&self, name: &str, hint: &str) -> Result<Option<T>> {
        let Some(attribute) = self.find(|key| key == name)? else {
            return Ok(None);
        };
        // Almost always there is nothing to unescape.
        if let Ok(value) = attribute.value.trim().parse() {
            return Ok(Some(value));
        }
        let text = self.plain(&attribute)?;
        match text.trim().parse() {
            Ok(value) => Ok(Some(value)),
            Err(_) => {
                let what = format!("<{}> has {name}=\"{}\"", shown(self.name), shown(&text));
                Err(self.document.error(self.start, what, hint))
            }
        }
    }

    /// Where an attribute stands that must be there.
    pub fn must_place(&self, name: &str) -> Result<Place> {
        self.place(|key| key == name)?
            .ok_or_else(|| self.missing(name))
    }

    /// Where the attribute stands whose name `is` picks.
    pub fn place(&self, is: impl Fn(&str) -> bool) -> Result<Option<Place>> {
        let Some(attribute) = self.find(is)? else {
            return Ok(None);
        };
        let offset = |part: &str| {
            let base = self.document.text.as_ptr() as usize;
            (part.as_ptr() as usize).wrapping_sub(base)
        };
        let key = offset(attribute.key.into_inner());
        let value = offset(&attribute.value);
        let value = value..value + attribute.value.len();
        Ok(Some(Place {
            whole: key..value.end + 1,
            value,
        }))
    }

    /// All attributes whose names `are` picks, as they stand, each after a blank.
    pub fn copied(&self, are: impl Fn(&str) -> bool) -> Result<String> {
        let mut text = String::new();
        for attribute in self.attributes() {
            let attribute = attribute.map_err(|e| self.damaged(&e))?;
            let key = attribute.key.into_inner();
            if are(key) {
                let quote = if attribute.value.contains('"') {
                    '\''
                } else {
                    '"'
                };
                text += &format!(" {key}={quote}{}{quote}", attribute.value);
            }
        }
        Ok(text)
    }

    /// Fails where an attribute is damaged, also one that nobody asks for.
    pub fn check(&self) -> Result<()> {
        self.find(|_| false).map(|_| ())
    }

    /// An input error at this tag.
    pub fn error(&self, what: impl std::fmt::Display, hint: &str) -> Error {
        self.document.error(self.start, what, hint)
    }

    fn missing(&self, name: &str) -> Error {
        let what = format!("<{}> has no attribute '{name}'", shown(self.name));
        self.document.error(self.start, what, EXPORT)
    }

    fn attributes(&self) -> Attributes<'a> {
        let mut attributes = Attributes::new(self.inside, self.name.len());
        attributes.with_checks(false);
        attributes
    }

    fn find(&self, is: impl Fn(&str) -> bool) -> Result<Option<Attribute<'a>>> {
        for attribute in self.attributes() {
            let attribute = attribute.map_err(|e| self.damaged(&e))?;
            if is(attribute.key.into_inner()) {
                return Ok(Some(attribute));
            }
        }
        Ok(None)
    }

    fn plain(&self, attribute: &Attribute<'_>) -> Result<String> {
        let value = attribute.normalized_value(XmlVersion::Implicit1_0);
        Ok(value.map_err(|e| self.damaged(&e))?.into_owned())
    }

    fn damaged(&self, error: &dyn std::fmt::Display) -> Error {
        let what = format!("<{}>: {error}", shown(self.name));
        self.document.error(self.start, what, EXPORT)
    }
}

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
