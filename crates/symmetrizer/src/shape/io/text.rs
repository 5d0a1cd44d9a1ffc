//! Reading text files: words and numbers with the line they stand on.

use std::borrow::Cow;

use crate::error::{Error, Result};

/// The words of a text, separated by white space; counts lines as it goes.
pub(super) struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    comment: Option<u8>,
}

impl<'a> Words<'a> {
    /// The words of `bytes`, whose first line has the number `line`; where `comment` is given, the
    /// rest of a line from that byte on is left out.
    pub fn new(bytes: &'a [u8], line: usize, comment: Option<u8>) -> Self {
        Self {
            bytes,
            at: 0,
            line,
            comment,
        }
    }

    /// The line of the last word.
    pub fn line(&self) -> usize {
        self.line
    }

    /// The next word.
    pub fn next_word(&mut self) -> Option<&'a [u8]> {
        self.skip_blank();
        let start = self.at;
        let length = self.bytes[start..]
            .iter()
            .position(|&b| b.is_ascii_whitespace() || Some(b) == self.comment)
            .unwrap_or(self.bytes.len() - start);
        self.at += length;
        (length > 0).then(|| &self.bytes[start..self.at])
    }

    /// Puts back the last `count` bytes of the word just read.
    pub fn put_back(&mut self, count: usize) {
        self.at -= count;
    }

    /// The bytes left on the line of the last word.
    pub fn rest_of_line(&mut self) -> &'a [u8] {
        let start = self.at;
        self.skip_line();
        &self.bytes[start..self.at]
    }

    /// Drops the words left on the line of the last word.
    pub fn skip_line(&mut self) {
        self.at += self.bytes[self.at..]
            .iter()
            .position(|&b| b == b'\n')
            .unwrap_or(self.bytes.len() - self.at);
    }

    /// The next word as a number; `part` says what it belongs to.
    pub fn number(&mut self, part: Part) -> Result<f64> {
        let word = self.word_of(part)?;
        number(word, self.line)
    }

    /// The next word as a count or an index; `part` says what it belongs to.
    pub fn index(&mut self, part: Part) -> Result<u32> {
        let word = self.word_of(part)?;
        let parsed = str_of(word).and_then(|text| text.parse().ok());
        parsed.ok_or_else(|| {
            at_line(
                self.line,
                format!("{part}: '{}' is not a vertex number", shown(word)),
                "indices and corner counts are whole numbers from 0",
            )
        })
    }

    /// The next word; an error where the text ends before it.
    pub fn word_of(&mut self, part: Part) -> Result<&'a [u8]> {
        self.next_word().ok_or_else(|| {
            at_line(
                self.line,
                format!("the file ends within or before {part}"),
                "it is cut off, or the counts in its header are wrong",
            )
        })
    }

    fn skip_blank(&mut self) {
        while let Some(&b) = self.bytes.get(self.at) {
            if Some(b) == self.comment {
                self.skip_line();
            } else if b.is_ascii_whitespace() {
                self.line += usize::from(b == b'\n');
                self.at += 1;
            } else {
                return;
            }
        }
    }
}

/// A numbered part of a file, such as `face 12`, counted from 0.
#[derive(Clone, Copy)]
pub(super) struct Part<'a>(pub &'a str, pub usize);

impl std::fmt::Display for Part<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {} (counted from 0)", self.0, self.1)
    }
}

/// An input error at a line.
pub(super) fn at_line(line: usize, what: impl std::fmt::Display, hint: &str) -> Error {
    Error::input(format!("line {line}: {what}"), hint)
}

/// A word as a number, which may be `nan` or `inf`: one broken vertex must not hide the rest.
pub(super) fn number(word: &[u8], line: usize) -> Result<f64> {
    match str_of(word).and_then(|text| text.parse::<f64>().ok()) {
        Some(value) => Ok(value),
        None => Err(at_line(
            line,
            format!("'{}' is not a number", shown(word)),
            "a coordinate such as -0.25 or 1e-3 belongs there",
        )),
    }
}

/// The start of a word for a message; bytes that are not text show as replacement characters.
pub(super) fn shown(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(40)]);
    text.escape_debug().to_string()
}

/// A name or remark of a file, as [`one_line`] has it.
pub(super) fn label(bytes: &[u8]) -> String {
    one_line(&String::from_utf8_lossy(bytes))
}

/// A text on one line, without blanks around it. Control characters and byte-order marks become
/// replacement characters: a blank in their place could make a keyword of what is none.
pub(super) fn one_line(text: &str) -> String {
    let tame = |c: char| match c {
        c if c.is_ascii_whitespace() => ' ',
        c if c.is_control() || c == '\u{feff}' => char::REPLACEMENT_CHARACTER,
        c => c,
    };
    let text: String = text.chars().map(tame).collect();
    text.trim_matches(' ').to_owned()
}

/// The text without a byte-order mark, as UTF-8 where the mark says UTF-16.
///
/// # Errors
/// [`Error::Input`] for binary data.
pub(super) fn plain(bytes: &[u8]) -> Result<Cow<'_, [u8]>> {
    let wide = |read: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(|c| read([c[0], c[1]]));
        let text = char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER));
        Cow::Owned(text.collect::<String>().into_bytes())
    };
    match bytes {
        [0xfe, 0xff, ..] => return Ok(wide(u16::from_be_bytes)),
        [0xff, 0xfe, ..] => return Ok(wide(u16::from_le_bytes)),
        _ => {}
    }
    if bytes[..bytes.len().min(64)].contains(&0) {
        return Err(Error::input(
            "byte 0: the file is not plain text",
            "give it the extension of its real format, or save it as ASCII or UTF-8",
        ));
    }
    Ok(Cow::Borrowed(
        bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
    ))
}

pub(super) fn str_of(word: &[u8]) -> Option<&str> {
    std::str::from_utf8(word).ok()
}
