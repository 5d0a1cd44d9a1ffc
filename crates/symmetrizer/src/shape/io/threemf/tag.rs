//! The tags of an XML text, with the place of each attribute in it.
//!
//! Places are byte ranges of the text, so that a change replaces a few characters and leaves all
//! others as they came.

use std::ops::Range;

use quick_xml::XmlVersion;
use quick_xml::events::attributes::{Attribute, Attributes};

use super::xml::{EXPORT, Text, local, shown};
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

impl<'a> Tag<'a> {
    /// The tag with the text `inside` its brackets, which starts with `name`.
    pub fn new(document: Text<'a>, inside: &'a str, name: &'a str, start: usize) -> Self {
        Self {
            document,
            inside,
            name,
            start,
        }
    }

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
