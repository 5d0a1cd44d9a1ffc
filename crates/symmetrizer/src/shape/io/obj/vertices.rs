//! `v` with what may follow the position, and the pools of `vt` and `vn`.

use std::ops::RangeInclusive;

use super::super::text::{at_line, number};
use crate::error::Result;
use crate::geom::Point;
use crate::shape::document::{Layer, NO_ROW, Numbers, On, Role, Values};

/// The vertices: positions, and further values of those that have some.
#[derive(Default)]
pub(super) struct Vertices {
    positions: Vec<Point>,
    /// 1 for a weight, 3 for a colour, 4 for a colour with opacity: as the first vertex that has
    /// more than a position.
    width: usize,
    extra: Vec<f64>,
    /// The row in `extra` of each vertex.
    rows: Vec<u32>,
}

impl Vertices {
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    pub fn read<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>, line: usize) -> Result<()> {
        let mut values = [0.0; 7];
        let mut given = 0;
        for (value, word) in values.iter_mut().zip(words) {
            *value = number(word, line)?;
            given += 1;
        }
        if given < 3 {
            return Err(at_line(
                line,
                format!("a vertex with {given} coordinates"),
                "three are needed: v x y z",
            ));
        }
        self.positions
            .push(Point::new(values[0], values[1], values[2]));
        self.take_extra(&values[3..given]);
        Ok(())
    }

    fn take_extra(&mut self, extra: &[f64]) {
        // Five or six numbers: a colour is three, what is beyond is not known to anyone.
        let extra = match extra.len() {
            2 => &extra[..1],
            _ => extra,
        };
        if self.width == 0 {
            self.width = extra.len();
        }
        let fits = self.width > 0 && extra.len() == self.width;
        self.rows.push(match fits {
            true => (self.extra.len() / self.width) as u32,
            false => NO_ROW,
        });
        if fits {
            self.extra.extend_from_slice(extra);
        }
    }

    pub fn finish(self) -> (Vec<Point>, Vec<Layer>) {
        if self.width == 0 {
            return (self.positions, Vec::new());
        }
        let (name, role) = match self.width {
            1 => ("w", Role::Other),
            _ => ("", Role::Color(0)),
        };
        let layer = Layer {
            name: name.into(),
            on: On::Vertex,
            role,
            values: rows_or_pool(self.width, Numbers::F64(self.extra), self.rows),
        };
        (self.positions, vec![layer])
    }
}

/// Plain rows where every element has one.
fn rows_or_pool(width: usize, numbers: Numbers, rows: Vec<u32>) -> Values {
    match rows.contains(&NO_ROW) {
        true => Values::Pool {
            width,
            numbers,
            rows,
        },
        false => Values::Rows { width, numbers },
    }
}

/// The rows of `vt` or `vn`, which face corners name.
#[derive(Default)]
pub(super) struct Pool {
    numbers: Vec<f64>,
    ends: Vec<usize>,
}

impl Pool {
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    pub fn read<'a>(
        &mut self,
        words: impl Iterator<Item = &'a [u8]>,
        line: usize,
        widths: RangeInclusive<usize>,
    ) -> Result<()> {
        let before = self.numbers.len();
        for word in words.take(*widths.end()) {
            self.numbers.push(number(word, line)?);
        }
        let given = self.numbers.len() - before;
        if !widths.contains(&given) {
            return Err(at_line(
                line,
                format!("a row of {given} numbers"),
                "vt needs one to three, vn three",
            ));
        }
        self.ends.push(self.numbers.len());
        Ok(())
    }

    /// The layer, where there are rows; shorter rows are filled up with zeros.
    pub fn layer(self, role: Role, rows: Vec<u32>) -> Option<Layer> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        let lengths = starts.zip(&self.ends).map(|(start, end)| end - start);
        let width = lengths.max()?;
        let values = Values::Pool {
            width,
            numbers: Numbers::F64(self.filled(width)),
            rows,
        };
        Some(Layer {
            name: String::new(),
            on: On::Corner,
            role,
            values,
        })
    }

    fn filled(self, width: usize) -> Vec<f64> {
        if self.numbers.len() == width * self.ends.len() {
            return self.numbers;
        }
        let mut filled = Vec::with_capacity(width * self.ends.len());
        let mut start = 0;
        for (k, &end) in self.ends.iter().enumerate() {
            filled.extend_from_slice(&self.numbers[start..end]);
            filled.resize((k + 1) * width, 0.0);
            start = end;
        }
        filled
    }
}
