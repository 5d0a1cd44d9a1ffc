//! XYZ: a point per line, and perhaps a normal, a colour or other numbers behind it.
//!
//! Numbers are separated by blanks, tabs, commas or semicolons; `#` and `//` start comments. The
//! first line may have the count of the points or the names of the columns. Without names, three
//! further columns are normals if they have unit length, or else colours if they can be.

use std::io::{BufWriter, Write};

use super::losses::{counted, of_layers};
use super::text::{at_line, number, plain, str_of};
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::shape::document::{Document, Kind, Layer, Numbers, On, Role, Values};
use crate::shape::mesh::Mesh;

/// How far from 1 the length of a normal may be, ...
const UNIT: f64 = 1e-2;
/// ... and the share of the lines where it must not be farther.
const SHARE: f64 = 0.99;

const NORMAL: [&str; 3] = ["nx", "ny", "nz"];
const COLOR: [&str; 3] = ["red", "green", "blue"];

/// The points in the text of an XYZ file.
pub(super) fn decode(bytes: &[u8]) -> Result<Document> {
    let table = Table::read(plain(bytes)?)?;
    let positions = table.rows().map(|r| Point::new(r[0], r[1], r[2]));
    Ok(Document {
        mesh: Mesh {
            positions: positions.collect(),
            ..Mesh::default()
        },
        layers: table.layers(),
        ..Document::default()
    })
}

/// The numbers of a file.
#[derive(Default)]
struct Table {
    /// The names of the columns, if there are any.
    names: Vec<String>,
    /// Numbers per line, from 3.
    width: usize,
    numbers: Vec<f64>,
}

impl Table {
    fn read(bytes: &[u8]) -> Result<Self> {
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

    fn rows(&self) -> std::slice::ChunksExact<'_, f64> {
        self.numbers.chunks_exact(self.width.max(1))
    }

    /// Three columns from `first`, one point after the other.
    fn three(&self, first: usize) -> impl Iterator<Item = Vector> {
        self.rows()
            .map(move |r| Vector::new(r[first], r[first + 1], r[first + 2]))
    }

    /// What the columns after the first three mean.
    fn layers(&self) -> Vec<Layer> {
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

fn separates(byte: u8) -> bool {
    byte.is_ascii_whitespace() || byte == b',' || byte == b';'
}

fn is_number(word: &[u8]) -> bool {
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

/// Whether a layer is written.
fn holds(layer: &Layer) -> bool {
    let Values::Rows { width, numbers } = &layer.values else {
        return false;
    };
    let color = matches!(numbers.kind(), Kind::U8 | Kind::F32 | Kind::F64);
    layer.on == On::Vertex
        && match layer.role {
            Role::Normal => *width == 3,
            Role::Color(0) => *width == 3 && color,
            Role::Other => *width == 1,
            _ => false,
        }
}

/// Writes the points with their normals, colours and further numbers. The names of the columns come
/// first where a reader could not tell them.
pub(super) fn encode(document: &Document, w: &mut dyn Write) -> Result<()> {
    let layers: Vec<&Layer> = document.layers.iter().filter(|l| holds(l)).collect();
    let table = table(document, &layers);
    let told = table.layers();
    let meaning = |l: &Layer| (l.role, l.name.clone(), l.values.width());
    let clear = told
        .iter()
        .map(meaning)
        .eq(layers.iter().map(|l| meaning(l)));
    let text = || -> std::io::Result<()> {
        let mut w = BufWriter::new(w);
        if !clear {
            writeln!(
                w,
                "x y z{}",
                layers.iter().map(|l| names(l)).collect::<String>()
            )?;
        }
        for row in table.rows() {
            write!(w, "{} {} {}", row[0], row[1], row[2])?;
            for value in &row[3..] {
                write!(w, " {value}")?;
            }
            writeln!(w)?;
        }
        w.flush()
    };
    text().map_err(|e| Error::io("", e))
}

fn table(document: &Document, layers: &[&Layer]) -> Table {
    let mut table = Table {
        width: 3,
        ..Table::default()
    };
    table.width += layers
        .iter()
        .filter_map(|l| l.values.width())
        .sum::<usize>();
    for (v, p) in document.mesh.positions.iter().enumerate() {
        table.numbers.extend(p.iter());
        for layer in layers {
            let columns = 0..layer.values.width().unwrap_or(0);
            table
                .numbers
                .extend(columns.filter_map(|k| layer.values.get(v, k)));
        }
    }
    table
}

/// The names of a layer's columns, each after a blank.
fn names(layer: &Layer) -> String {
    match layer.role {
        Role::Normal => format!(" {}", NORMAL.join(" ")),
        Role::Color(_) => format!(" {}", COLOR.join(" ")),
        _ => format!(" {}", word(&layer.name)),
    }
}

/// A name as one word that is neither a number nor a comment.
fn word(name: &str) -> String {
    let plain = |c: char| {
        if c.is_ascii() && (separates(c as u8) || c.is_control()) {
            '_'
        } else {
            c
        }
    };
    let name: String = name.chars().map(plain).collect();
    let name = name.replace('#', "_").replace("//", "__");
    if name.is_empty() || is_number(name.as_bytes()) {
        return format!("_{name}");
    }
    name
}

/// What is lost in an XYZ file: the faces, and what is not a number per point.
pub(super) fn losses(document: &Document) -> Vec<String> {
    let faces = counted(document.mesh.polygons.len(), "face");
    let layers = of_layers(document, holds);
    faces.into_iter().chain(layers).collect()
}
