//! The header of a PLY file: read line by line, so that each fault has its line.

use crate::error::{Error, Result};
use crate::shape::document::{Kind, PlyForm, PlyProperty, PlyRemark};

use super::super::text::{at_line, shown};

/// Elements and properties of a header, together; files have some tens.
const MOST: usize = 4096;

/// What a header says, and where the body starts.
pub(super) struct Header<'a> {
    pub form: PlyForm,
    pub elements: Vec<Declared>,
    pub remarks: Vec<PlyRemark>,
    /// The bytes after the header.
    pub body: &'a [u8],
    /// The place of the body in the file, bytes.
    pub start: usize,
    /// The line of the file on which the body starts.
    pub line: usize,
}

/// An element as the header declares it.
pub(super) struct Declared {
    pub name: String,
    pub count: usize,
    pub properties: Vec<PlyProperty>,
}

/// Reads the header.
///
/// # Errors
/// [`crate::Error::Input`] with the line at fault: what is no line of a header, names a type that
/// does not exist, or names an element or a property of an element twice.
pub(super) fn parse(bytes: &[u8]) -> Result<Header<'_>> {
    let mut lines = Lines::new(bytes)?;
    let mut parser = Parser::default();
    while let Some(line) = lines.next_line() {
        if parser.line(line, lines.number)? {
            let form = parser.form.ok_or_else(|| formless(lines.number))?;
            return Ok(Header {
                form,
                elements: parser.elements,
                remarks: parser.remarks,
                body: lines.rest,
                start: bytes.len() - lines.rest.len(),
                line: lines.number + 1,
            });
        }
    }
    Err(Error::input(
        "the header has no line 'end_header'",
        "the file is cut off; export it again",
    ))
}

/// The lines of a header. They end in LF or CR LF, or in CR alone where the first one does: the
/// byte after the last line may be data.
struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
    end: u8,
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self> {
        let after = bytes.strip_prefix(b"ply").map(<[u8]>::first);
        if !after.is_some_and(|b| b.is_none_or(u8::is_ascii_whitespace)) {
            return Err(Error::input(
                "byte 0: a PLY file starts with the line 'ply', this one does not",
                "is this another kind of file?",
            ));
        }
        let first = bytes.iter().position(|b| matches!(b, b'\n' | b'\r'));
        let first = first.unwrap_or(bytes.len());
        let lone = bytes.get(first) == Some(&b'\r') && bytes.get(first + 1) != Some(&b'\n');
        let mut lines = Self {
            rest: bytes,
            number: 0,
            end: if lone { b'\r' } else { b'\n' },
        };
        lines.next_line();
        Ok(lines)
    }

    fn next_line(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let length = self.rest.iter().position(|&b| b == self.end);
        let (line, rest) = self.rest.split_at(length.unwrap_or(self.rest.len()));
        self.rest = rest.get(1..).unwrap_or_default();
        self.number += 1;
        let cut = line.iter().rev().take_while(|&&b| b == b'\r').count();
        Some(&line[..line.len() - cut])
    }
}

#[derive(Default)]
struct Parser {
    form: Option<PlyForm>,
    elements: Vec<Declared>,
    remarks: Vec<PlyRemark>,
    /// Lines besides remarks so far.
    place: usize,
}

impl Parser {
    /// Takes in a line; whether it is the last one.
    fn line(&mut self, line: &[u8], number: usize) -> Result<bool> {
        let text = String::from_utf8_lossy(line);
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        match words.as_slice() {
            [] => return Ok(false),
            ["comment" | "obj_info", ..] => {
                self.remarks.push(PlyRemark {
                    place: self.place,
                    line: line.to_vec(),
                });
                return Ok(false);
            }
            ["end_header"] => return Ok(true),
            ["format", ..] if self.form.is_some() => {
                let what = "the header names its format a second time";
                return Err(at_line(number, what, "remove one of the lines"));
            }
            ["format", name, ..] => self.form = Some(form(name, number)?),
            ["element", name, count] => self.element(name, count, number)?,
            ["property", "list", count, kind, name] => {
                let count = length_kind(name, count, number)?;
                self.property(name, self::kind(kind, number)?, Some(count), number)?;
            }
            ["property", kind, name] => {
                self.property(name, self::kind(kind, number)?, None, number)?;
            }
            _ => return Err(no_line(line, number)),
        }
        self.place += 1;
        if self.place > MOST {
            let what = format!("the header names more than {MOST} elements and properties");
            return Err(at_line(number, what, "write fewer of them to the file"));
        }
        Ok(false)
    }

    fn element(&mut self, name: &str, count: &str, number: usize) -> Result<()> {
        let Ok(count) = count.parse() else {
            let what = format!("'{}' is not a count of elements", shown(count.as_bytes()));
            return Err(at_line(number, what, "a whole number from 0 belongs there"));
        };
        if self.elements.iter().any(|e| e.name == name) {
            let what = format!("the header names the element '{name}' a second time");
            return Err(at_line(number, what, "rename or remove one of them"));
        }
        self.elements.push(Declared {
            name: name.into(),
            count,
            properties: Vec::new(),
        });
        Ok(())
    }

    fn property(
        &mut self,
        name: &str,
        kind: Kind,
        count: Option<Kind>,
        number: usize,
    ) -> Result<()> {
        let Some(element) = self.elements.last_mut() else {
            let what = format!("the property '{name}' belongs to no element");
            return Err(at_line(
                number,
                what,
                "a line 'element' must stand before it",
            ));
        };
        if element.properties.iter().any(|p| p.name == name) {
            let what = format!(
                "the header names the property '{name}' of the element '{}' a second time",
                element.name
            );
            return Err(at_line(number, what, "rename or remove one of them"));
        }
        element.properties.push(PlyProperty {
            name: name.into(),
            kind,
            count,
            values: None,
        });
        Ok(())
    }
}

fn no_line(line: &[u8], number: usize) -> Error {
    at_line(
        number,
        format!("'{}' is not a line of a PLY header", shown(line)),
        "format, element NAME COUNT, property TYPE NAME, property list TYPE TYPE NAME, comment, \
         obj_info and end_header are",
    )
}

fn length_kind(list: &str, name: &str, line: usize) -> Result<Kind> {
    let kind = kind(name, line)?;
    if kind.is_float() {
        let what = format!("the length of the list '{list}' is not a whole number");
        return Err(at_line(line, what, "uchar, int and so on are"));
    }
    Ok(kind)
}

fn formless(line: usize) -> Error {
    at_line(
        line,
        "the header ends without a line 'format'",
        "'format ascii 1.0' or another must be its second line",
    )
}

fn form(name: &str, line: usize) -> Result<PlyForm> {
    match name {
        "ascii" => Ok(PlyForm::Text),
        "binary_little_endian" => Ok(PlyForm::Little),
        "binary_big_endian" => Ok(PlyForm::Big),
        other => Err(at_line(
            line,
            format!("there is no PLY format '{}'", shown(other.as_bytes())),
            "ascii, binary_little_endian and binary_big_endian are known",
        )),
    }
}

fn kind(name: &str, line: usize) -> Result<Kind> {
    Ok(match name {
        "char" | "int8" => Kind::I8,
        "uchar" | "uint8" => Kind::U8,
        "short" | "int16" => Kind::I16,
        "ushort" | "uint16" => Kind::U16,
        "int" | "int32" => Kind::I32,
        "uint" | "uint32" => Kind::U32,
        "float" | "float32" => Kind::F32,
        "double" | "float64" => Kind::F64,
        other => {
            let what = format!("there is no number type '{}'", shown(other.as_bytes()));
            let known = "char, uchar, short, ushort, int, uint, float and double are known";
            return Err(at_line(line, what, known));
        }
    })
}
