//! Writing: the header, then the sheets row by row.

use std::fmt::Write as _;
use std::io::Write;

use super::binary::size;
use super::layout::{Column, Sheet, Source, kept, sheets};
use crate::error::{Error, Result};
use crate::shape::document::{Document, Kind, PlyForm, PlyRemark};

/// Bytes that are gathered before they are written.
const PIECE: usize = 1 << 16;

/// Writes the form of the PLY file that the document comes from, else binary little endian.
pub(in super::super) fn encode(document: &Document, w: &mut dyn Write) -> Result<()> {
    if i32::try_from(document.mesh.positions.len()).is_err() {
        let count = document.mesh.positions.len();
        return Err(Error::input(
            format!("{count} vertices are too many for PLY"),
            "write OBJ instead",
        ));
    }
    let kept = kept(document);
    let form = kept.map_or(PlyForm::default(), |k| k.form);
    let sheets = sheets(document);
    let remarks = kept.map_or(&[][..], |k| &k.remarks);
    let mut out = Out {
        form,
        bytes: head(form, &sheets, remarks),
        text: String::new(),
    };
    let mut bytes = || -> std::io::Result<()> {
        for sheet in &sheets {
            for row in 0..sheet.rows {
                for column in &sheet.columns {
                    out.value(document, column, row);
                }
                out.end_row();
                if out.bytes.len() >= PIECE {
                    w.write_all(&out.bytes)?;
                    out.bytes.clear();
                }
            }
        }
        w.write_all(&out.bytes)?;
        w.flush()
    };
    bytes().map_err(|e| Error::io("", e))
}

fn head(form: PlyForm, sheets: &[Sheet<'_>], remarks: &[PlyRemark]) -> Vec<u8> {
    let mut head = Head {
        bytes: b"ply\n".to_vec(),
        remarks,
    };
    let form = match form {
        PlyForm::Text => "ascii",
        PlyForm::Little => "binary_little_endian",
        PlyForm::Big => "binary_big_endian",
    };
    head.line(Some(0), &format!("format {form} 1.0\n"));
    for sheet in sheets {
        let element = format!("{}element {} {}\n", sheet.comments, sheet.name, sheet.rows);
        head.line(sheet.place, &element);
        for column in &sheet.columns {
            let list = column.count.map(|c| format!("list {} ", name(c)));
            let (list, kind) = (list.unwrap_or_default(), name(column.kind));
            head.line(
                column.place,
                &format!("property {list}{kind} {}\n", column.name),
            );
        }
    }
    head.line(Some(usize::MAX), "end_header\n");
    head.bytes
}

struct Head<'a> {
    bytes: Vec<u8>,
    remarks: &'a [PlyRemark],
}

impl Head<'_> {
    /// Writes a line after the remarks that stand before it.
    fn line(&mut self, place: Option<usize>, line: &str) {
        while let (Some(place), Some((remark, rest))) = (place, self.remarks.split_first()) {
            if remark.place > place {
                break;
            }
            let one_line = remark
                .line
                .iter()
                .map(|&b| if b == b'\n' { b' ' } else { b });
            self.bytes.extend(one_line);
            self.bytes.push(b'\n');
            self.remarks = rest;
        }
        self.bytes.extend_from_slice(line.as_bytes());
    }
}

fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::I8 => "char",
        Kind::U8 => "uchar",
        Kind::I16 => "short",
        Kind::U16 => "ushort",
        Kind::I32 => "int",
        Kind::U32 => "uint",
        Kind::F32 => "float",
        Kind::F64 => "double",
    }
}

struct Out {
    form: PlyForm,
    bytes: Vec<u8>,
    text: String,
}

impl Out {
    fn value(&mut self, document: &Document, column: &Column<'_>, row: usize) {
        let kind = column.kind;
        match &column.source {
            Source::Axis(axis) => {
                let value = document.mesh.positions[row][*axis];
                // In text the type is a name only: all digits stay.
                let text = self.form == PlyForm::Text;
                self.number(if text { Kind::F64 } else { kind }, value);
            }
            Source::Corners => {
                let polygon = document.mesh.polygons.get(row);
                self.length(column, polygon.len());
                for &v in polygon {
                    self.number(kind, f64::from(v));
                }
            }
            Source::Number(values, k) => self.number(kind, values.get(row, *k).unwrap_or(0.0)),
            Source::Byte(values, k) => {
                let value = values.get(row, *k).unwrap_or(0.0);
                self.number(kind, (value * 255.0).round());
            }
            Source::Lists(values) => self.list(column, values, row),
            Source::Corner(values, starts) => {
                let corners = document.mesh.polygons.get(row).len();
                self.length(column, 2 * corners);
                let first = starts[row] as usize;
                for i in 0..2 * corners {
                    let value = values.get(first + i / 2, i % 2);
                    self.number(kind, value.unwrap_or(0.0));
                }
            }
            Source::Name(of) => {
                let name = i32::try_from(of[row]).unwrap_or(-1);
                self.number(kind, f64::from(name));
            }
        }
    }

    fn list(&mut self, column: &Column<'_>, values: &crate::shape::document::Values, row: usize) {
        if let crate::shape::document::Values::Lists { starts, numbers } = values {
            let range = starts[row] as usize..starts[row + 1] as usize;
            self.length(column, range.len());
            for i in range {
                self.number(column.kind, numbers.get(i));
            }
        }
    }

    fn length(&mut self, column: &Column<'_>, length: usize) {
        self.number(column.count.unwrap_or(Kind::U32), length as f64);
    }

    fn number(&mut self, kind: Kind, value: f64) {
        match self.form {
            PlyForm::Text => self.word(kind, value),
            PlyForm::Little => self
                .bytes
                .extend_from_slice(&bytes(kind, value)[..size(kind)]),
            PlyForm::Big => {
                let mut bytes = bytes(kind, value);
                bytes[..size(kind)].reverse();
                self.bytes.extend_from_slice(&bytes[..size(kind)]);
            }
        }
    }

    fn word(&mut self, kind: Kind, value: f64) {
        self.text.clear();
        // Writing to a string cannot fail.
        let _ = match kind {
            Kind::F32 => write!(self.text, "{}", value as f32),
            _ => write!(self.text, "{value}"),
        };
        self.bytes.extend_from_slice(self.text.as_bytes());
        self.bytes.push(b' ');
    }

    /// Ends a line of text.
    fn end_row(&mut self) {
        if self.form == PlyForm::Text {
            match self.bytes.last_mut() {
                Some(last @ b' ') => *last = b'\n',
                _ => self.bytes.push(b'\n'),
            }
        }
    }
}

/// The bytes of a number, the lowest first, and zeros.
fn bytes(kind: Kind, value: f64) -> [u8; 8] {
    let mut all = [0; 8];
    match kind {
        Kind::I8 => all[..1].copy_from_slice(&(value as i8).to_le_bytes()),
        Kind::U8 => all[..1].copy_from_slice(&(value as u8).to_le_bytes()),
        Kind::I16 => all[..2].copy_from_slice(&(value as i16).to_le_bytes()),
        Kind::U16 => all[..2].copy_from_slice(&(value as u16).to_le_bytes()),
        Kind::I32 => all[..4].copy_from_slice(&(value as i32).to_le_bytes()),
        Kind::U32 => all[..4].copy_from_slice(&(value as u32).to_le_bytes()),
        Kind::F32 => all[..4].copy_from_slice(&(value as f32).to_le_bytes()),
        Kind::F64 => all = value.to_le_bytes(),
    }
    all
}
