//! What follows a position or a face on its line.

use super::super::text::{Part, at_line, number};
use super::Prefix;
use crate::error::Result;
use crate::shape::document::{Layer, NO_ROW, Numbers, On, Role, Values};

/// The words of a line up to a comment.
fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let end = line.iter().position(|&b| b == b'#').unwrap_or(line.len());
    let words = line[..end].split(u8::is_ascii_whitespace);
    words.filter(|word| !word.is_empty())
}

/// What follows the positions.
pub(super) struct Columns {
    pub prefix: Prefix,
    normals: Vec<f64>,
    textures: Vec<f64>,
    colors: Colors,
}

impl Columns {
    pub fn new(prefix: Prefix) -> Self {
        Self {
            prefix,
            normals: Vec::new(),
            textures: Vec::new(),
            colors: Colors::default(),
        }
    }

    /// Takes the rest of the line of vertex `v`: a normal, a colour, texture coordinates.
    pub fn read(&mut self, rest: &[u8], line: usize, v: usize) -> Result<()> {
        let words: Vec<&[u8]> = words(rest).collect();
        let normal = if self.prefix.normal { 3 } else { 0 };
        let texture = if self.prefix.texture { 2 } else { 0 };
        let color = words.len().checked_sub(normal + texture);
        let fits = match color {
            Some(n) if self.prefix.color => matches!(n, 3 | 4),
            other => other == Some(0),
        };
        if !fits {
            let part = Part("vertex", v);
            return Err(at_line(
                line,
                format!("{part} has {} values after its position", words.len()),
                "N in the keyword asks for three, C for three or four, ST for two",
            ));
        }
        let (head, tail) = words.split_at(normal);
        let (color, texture) = tail.split_at(tail.len() - texture);
        for word in head {
            self.normals.push(number(word, line)?);
        }
        for word in texture {
            self.textures.push(number(word, line)?);
        }
        self.colors.push(color, line)
    }

    pub fn finish(self) -> Vec<Layer> {
        let rows = |role, width, numbers: Vec<f64>| {
            (!numbers.is_empty()).then_some(Layer {
                name: String::new(),
                on: On::Vertex,
                role,
                values: Values::Rows {
                    width,
                    numbers: Numbers::F64(numbers),
                },
            })
        };
        let normals = rows(Role::Normal, 3, self.normals);
        let textures = rows(Role::TexCoord(0), 2, self.textures);
        let colors = self.colors.layer(On::Vertex);
        [normals, colors, textures].into_iter().flatten().collect()
    }
}

/// Colours of three or four numbers, where there are any: whole ones up to 255, or from 0 to 1.
#[derive(Default)]
pub(super) struct Colors {
    of: Vec<Option<Color>>,
    fractions: bool,
}

/// Red, green and blue, perhaps with an opacity.
type Color = ([f64; 3], Option<f64>);

impl Colors {
    /// Takes what follows a face.
    pub fn read(&mut self, rest: &[u8], line: usize) -> Result<()> {
        let words: Vec<&[u8]> = words(rest).collect();
        self.push(&words, line)
    }

    /// Takes a colour, or nothing. One number is an index into a colour map that no file has.
    fn push(&mut self, words: &[&[u8]], line: usize) -> Result<()> {
        let mut values = Vec::with_capacity(4);
        if words.len() >= 3 {
            for word in words.iter().take(4) {
                let value = number(word, line)?;
                let whole = word.iter().all(u8::is_ascii_digit) && value <= 255.0;
                self.fractions |= !whole;
                values.push(value);
            }
        }
        self.of.push(match values[..] {
            [r, g, b] => Some(([r, g, b], None)),
            [r, g, b, a] => Some(([r, g, b], Some(a))),
            _ => None,
        });
        Ok(())
    }

    /// The layer, where there are colours; with an opacity for all where one has it.
    pub fn layer(self, on: On) -> Option<Layer> {
        let colors = || self.of.iter().flatten();
        colors().next()?;
        let width = if colors().any(|c| c.1.is_some()) {
            4
        } else {
            3
        };
        let opaque = if self.fractions { 1.0 } else { 255.0 };
        let rows = colors().map(|([r, g, b], a)| [*r, *g, *b, a.unwrap_or(opaque)]);
        let flat: Vec<f64> = rows.flat_map(|row| row.into_iter().take(width)).collect();
        let numbers = match self.fractions {
            true => Numbers::F64(flat),
            false => Numbers::U8(flat.iter().map(|&n| n as u8).collect()),
        };
        let values = match self.of.contains(&None) {
            true => Values::Pool {
                width,
                numbers,
                rows: counted(&self.of),
            },
            false => Values::Rows { width, numbers },
        };
        Some(Layer {
            name: String::new(),
            on,
            role: Role::Color(0),
            values,
        })
    }
}

/// The row of each element that has a colour: they are numbered as they come.
fn counted(of: &[Option<Color>]) -> Vec<u32> {
    let mut next = 0..;
    let row = |color: &Option<Color>| color.and_then(|_| next.next()).unwrap_or(NO_ROW);
    of.iter().map(row).collect()
}
