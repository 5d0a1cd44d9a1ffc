//! The line along which a picture has a given value: marching squares between pixel centres, with
//! linear interpolation.

use std::collections::HashMap;

use super::grey::Grey;
use super::threshold::Split;
use crate::geom::Point;

/// A side of a cell: the pixel it starts from, with a frame of one pixel around the picture, and
/// whether it leads down (else right).
type Side = (u32, u32, bool);

/// Closed lines around the shape, drawing units, y upwards. Nothing is taken to be beyond the
/// picture's edge, so that a shape which touches it is closed there.
pub(super) fn rings(grey: &Grey, split: &Split) -> Vec<Vec<Point>> {
    let field = Field { grey, split };
    // Looked up only, never gone through. The line leaves every side into one cell.
    let mut next: HashMap<Side, Side> = HashMap::new();
    let mut starts = Vec::new();
    for y in 0..=grey.height as u32 {
        for x in 0..=grey.width as u32 {
            for (from, to) in field.crossings(x, y) {
                starts.push(from);
                next.insert(from, to);
            }
        }
    }
    let mut rings = Vec::new();
    for start in starts {
        let mut ring = Vec::new();
        let mut at = start;
        while let Some(to) = next.remove(&at) {
            ring.push(field.place(at));
            at = to;
        }
        if ring.len() > 2 {
            rings.push(ring);
        }
    }
    rings
}

struct Field<'a> {
    grey: &'a Grey,
    split: &'a Split,
}

impl Field<'_> {
    /// How far inside the shape a pixel is, in values; pixels are counted with the frame.
    fn depth(&self, x: u32, y: u32) -> f32 {
        let inside = |v: u32, size: usize| (v as usize).checked_sub(1).filter(|v| *v < size);
        let at = inside(x, self.grey.width).zip(inside(y, self.grey.height));
        let Some((px, py)) = at else {
            return self.frame(x, y);
        };
        let v = self.grey.values[py * self.grey.width + px] - self.split.threshold;
        let v = if self.split.lighter { v } else { -v };
        // A line through the very centre of a pixel would belong to two sides.
        if v == 0.0 { -f32::EPSILON } else { v }
    }

    /// Beside a pixel of the shape, as far outside as that is inside: the shape ends at the edge of
    /// the pixel.
    fn frame(&self, x: u32, y: u32) -> f32 {
        let (w, h) = (self.grey.width as u32, self.grey.height as u32);
        let (nx, ny) = (x.clamp(1, w), y.clamp(1, h));
        -self.depth(nx, ny).abs()
    }

    /// The pieces of the line in a cell, from side to side, the shape on the right (y upwards).
    fn crossings(&self, x: u32, y: u32) -> Vec<(Side, Side)> {
        let (top, left) = ((x, y, false), (x, y, true));
        let (bottom, right) = ((x, y + 1, false), (x + 1, y, true));
        let corners = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
        let depths = corners.map(|(x, y)| self.depth(x, y));
        let bits = depths
            .iter()
            .enumerate()
            .map(|(i, d)| u8::from(*d > 0.0) << i);
        match bits.sum::<u8>() {
            0b0001 => vec![(top, left)],
            0b0010 => vec![(right, top)],
            0b0100 => vec![(bottom, right)],
            0b1000 => vec![(left, bottom)],
            0b0011 => vec![(right, left)],
            0b0110 => vec![(bottom, top)],
            0b1100 => vec![(left, right)],
            0b1001 => vec![(top, bottom)],
            0b1110 => vec![(left, top)],
            0b1101 => vec![(top, right)],
            0b1011 => vec![(right, bottom)],
            0b0111 => vec![(bottom, left)],
            // Two opposite corners: joined if the middle is inside.
            0b0101 if self.joined(&depths) => vec![(top, right), (bottom, left)],
            0b0101 => vec![(top, left), (bottom, right)],
            0b1010 if self.joined(&depths) => vec![(left, top), (right, bottom)],
            0b1010 => vec![(right, top), (left, bottom)],
            _ => Vec::new(),
        }
    }

    fn joined(&self, depths: &[f32; 4]) -> bool {
        depths.iter().sum::<f32>() > 0.0
    }

    /// Where the line crosses a side.
    fn place(&self, (x, y, down): Side) -> Point {
        let (a, b) = if down {
            (self.depth(x, y), self.depth(x, y + 1))
        } else {
            (self.depth(x, y), self.depth(x + 1, y))
        };
        let t = f64::from(a) / f64::from(a - b);
        // The centre of the first pixel is half a pixel from the corner, and the frame one more.
        let (x, y) = (f64::from(x) - 0.5, f64::from(y) - 0.5);
        if down {
            Point::new(x, -(y + t), 0.0)
        } else {
            Point::new(x + t, -y, 0.0)
        }
    }
}
