//! The lines of an XYZ file and what their columns mean.

use super::super::text::{at_line, number, str_of};
use crate::error::Result;
use crate::geom::Vector;
use crate::shape::document::{Kind, Layer, Numbers, On, Role, Values};

/// How far from 1 the length of a normal may be, ...
const UNIT: f64 = 1e-2;
/// ... and the share of the lines where it must not be farther.
const SHARE: f64 = 0.99;

/// The names of a normal's columns.
pub(super) const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
/// The names of a colour's columns.
pub(super) const COLOR: [&str; 3] = ["red", "green", "blue"];

/// The numbers of a file.
#[derive(Default)]
pub(super) struct Table {
    /// The names of the columns, if there are any.
    pub names: Vec<String>,
    /// Numbers per line, from 3.
    pub width: usize,
    /// The numbers of all lines.
    pub numbers: Vec<f64>,
}

impl Table {
    /// The numbers in a text.
    pub fn read(bytes: &[u8]) -> Result<Self> {
        let mut table = Self::default();
        let mut count = None;
        for (i, text) in bytes.split(|&b| b == b'\n').enumerate() {
            let words: Vec<&[u8]> = words(text).collect();
            let first = table.width == 0 && table.names.is_empty();
            match words[..] {
                [] => {}
                [word] if first && count.is_none() => count = Some((i + 1, whole(word, i + 1)?)),
                _ if first && words.iter().all(|w| !is_number(w)) => {
                    let name = |w: &&[u8]| String::from_utf8_lossy(w).into_owned();
                    table.names = words.iter().map(name).collect();
                }
                _ => table.line(&words, i + 1)?,
            }
        }
        match count {
            Some((line, count)) if count != table.rows().len() as u64 => {
                let rows = table.rows().len();
                let what = format!("{count} points are announced, but there are {rows}");
                Err(at_line(
                    line,
                    what,
                    "the file is cut off, or the count is wrong",
                ))
            }
            _ => Ok(table),
        }
    }

    fn line(&mut self, words: &[&[u8]], line: usize) -> Result<()> {
        let wanted = if self.width == 0 {
            self.names.len()
        } else {
            self.width
        };
        let columns = words.len();
        if columns < 3 || (wanted != 0 && columns != wanted) {
            let wanted = wanted.max(3);
            return Err(at_line(
                line,
                format!("{columns} columns where {wanted} are expected"),
                "every line has the same columns, x y z first",
            ));
        }
        self.width = columns;
        for word in words {
            self.numbers.push(number(word, line)?);
        }
        Ok(())
    }

    /// The numbers of each line.
    pub fn rows(&self) -> std::slice::ChunksExact<'_, f64> {
        self.numbers.chunks_exact(self.width.max(1))
    }

    /// Three columns from `first`, one point after the other.
    fn three(&self, first: usize) -> impl Iterator<Item = Vector> {
        self.rows()
            .map(move |r| Vector::new(r[first], r[first + 1], r[first + 2]))
    }

    /// What the columns after the first three mean.
    pub fn layers(&self) -> Vec<Layer> {
        let mut layers = Vec::new();
        let mut column = 3;
        while column < self.width {
            let triple = column + 3 <= self.width;
            let role = if triple {
                self.role(column)
            } else {
                Role::Other
            };
            let width = if role == Role::Other { 1 } else { 3 };
            layers.push(self.layer(column, width, role));
            column += width;
        }
        layers
    }

    fn role(&self, first: usize) -> Role {
        let names = self.names.get(first..first + 3);
        let named = |wanted: [&str; 3]| {
            let mut pairs = names.unwrap_or_default().iter().zip(wanted);
            names.is_some() && pairs.all(|(n, w)| n.eq_ignore_ascii_case(w))
        };
        let unnamed = names.is_none() && self.width == 6;
        let colors = || self.color_kind(first).is_some();
        if named(NORMAL) || (unnamed && self.are_normals(first)) {
            Role::Normal
        } else if (named(COLOR) || named(["r", "g", "b"]) || unnamed) && colors() {
            Role::Color(0)
        } else {
            Role::Other
        }
    }

    fn are_normals(&self, first: usize) -> bool {
        let unit = self.three(first).filter(|n| (n.norm() - 1.0).abs() <= UNIT);
        unit.count() as f64 >= SHARE * self.rows().len() as f64
    }

    /// Colours are whole numbers up to 255, or any from 0 to 1.
    fn color_kind(&self, first: usize) -> Option<Kind> {
        let all = |is: &dyn Fn(f64) -> bool| self.three(first).all(|c| c.iter().all(|&c| is(c)));
        if all(&|c| (0.0..=1.0).contains(&c)) {
            return Some(Kind::F64);
        }
        all(&|c| (0.0..=255.0).contains(&c) && c.fract() == 0.0).then_some(Kind::U8)
    }

    fn layer(&self, first: usize, width: usize, role: Role) -> Layer {
        let kind = match role {
            Role::Color(_) => self.color_kind(first).unwrap_or(Kind::F64),
            _ => Kind::F64,
        };
        let mut numbers = Numbers::with_capacity(kind, width * self.rows().len());
        let values = self.rows().flat_map(|r| &r[first..first + width]);
        values.for_each(|&value| numbers.push(value));
        let name = match (role, self.names.get(first)) {
            (Role::Other, Some(name)) => name.clone(),
            (Role::Other, None) => format!("column {}", first + 1),
            _ => String::new(),
        };
        Layer {
            name,
            on: On::Vertex,
            role,
            values: Values::Rows { width, numbers },
        }
    }
}

/// The words of a line up to its comment.
fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let comment = (0..line.len()).find(|&i| line[i] == b'#' || line[i..].starts_with(b"//"));
    let line = &line[..comment.unwrap_or(line.len())];
    line.split(|&b| separates(b))
        .filter(|word| !word.is_empty())
}

/// Whether a byte stands between words.
pub(super) fn separates(byte: u8) -> bool {
    byte.is_ascii_whitespace() || byte == b',' || byte == b';'
}

/// Whether a word is a number.
pub(super) fn is_number(word: &[u8]) -> bool {
    str_of(word).is_some_and(|text| text.parse::<f64>().is_ok())
}

fn whole(word: &[u8], line: usize) -> Result<u64> {
    let parsed = str_of(word).and_then(|text| text.parse().ok());
    parsed.ok_or_else(|| {
        at_line(
            line,
            "one word, which is not the count of the points",
            "a line has at least x y z",
        )
    })
}
