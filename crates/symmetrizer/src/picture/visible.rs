//! Which triangle each sample of the picture sees.
//!
//! The camera is orthographic, so filling the projected triangles into a depth buffer gives the
//! same samples as casting one ray for each, without a hierarchy and several times faster.

use rayon::prelude::*;

use crate::geom::Vector;

/// Rows that one task fills; fixed, so that the work is cut alike for any number of threads.
const BAND: usize = 64;

/// What one sample sees; small, because a large picture has very many.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    /// Depth, in samples, away from the eye; infinite where nothing is seen.
    depth: f32,
    /// The triangle, meaningless where nothing is seen.
    pub face: u32,
}

impl Sight {
    const NOTHING: Self = Self {
        depth: f32::INFINITY,
        face: u32::MAX,
    };

    /// Whether the sample sees the shape.
    pub fn hits(&self) -> bool {
        self.depth < f32::INFINITY
    }

    /// Depth, in samples, away from the eye; infinite where nothing is seen.
    pub fn depth(&self) -> f64 {
        self.depth.into()
    }
}

/// The samples of a picture, row by row from the top left.
pub(super) struct Sights {
    pub width: usize,
    pub height: usize,
    pub samples: Vec<Sight>,
}

impl Sights {
    /// Fills `triangles` over the vertices projected to sample coordinates. Where depths are equal
    /// the first triangle is seen.
    pub fn new(width: usize, height: usize, projected: &[Vector], triangles: &[[u32; 3]]) -> Self {
        let mut samples = vec![Sight::NOTHING; width * height];
        samples
            .par_chunks_mut(width * BAND)
            .enumerate()
            .for_each(|(band, rows)| {
                let first_row = band * BAND;
                for (face, t) in triangles.iter().enumerate() {
                    let corners = t.map(|v| projected[v as usize]);
                    fill(rows, width, first_row, face as u32, &corners);
                }
            });
        Self {
            width,
            height,
            samples,
        }
    }

    /// What the sample in column `x` and row `y` sees.
    pub fn at(&self, x: usize, y: usize) -> &Sight {
        &self.samples[y * self.width + x]
    }
}

/// Barycentric coordinates of a picture position in a projected triangle; not finite where the
/// triangle is seen edge-on.
pub(super) fn barycentric(corners: &[Vector; 3], x: f64, y: f64) -> [f64; 3] {
    let [a, b, c] = corners;
    let cross = |ux: f64, uy: f64, vx: f64, vy: f64| ux * vy - uy * vx;
    let area = cross(b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
    let at_b = cross(x - a.x, y - a.y, c.x - a.x, c.y - a.y) / area;
    let at_c = cross(b.x - a.x, b.y - a.y, x - a.x, y - a.y) / area;
    [1.0 - at_b - at_c, at_b, at_c]
}

fn fill(rows: &mut [Sight], width: usize, first_row: usize, face: u32, corners: &[Vector; 3]) {
    let height = rows.len() / width;
    let (y0, y1) = span(corners.map(|c| c.y - first_row as f64), height);
    if y0 >= y1 {
        return;
    }
    let (x0, x1) = span(corners.map(|c| c.x), width);
    for y in y0..y1 {
        let py = (first_row + y) as f64 + 0.5;
        for x in x0..x1 {
            let b = barycentric(corners, x as f64 + 0.5, py);
            // A sample on an edge belongs to both sides, so that no gap opens between them.
            if b.iter().all(|w| *w >= -1e-12) {
                let depth = b[0] * corners[0].z + b[1] * corners[1].z + b[2] * corners[2].z;
                let (depth, sight) = (depth as f32, &mut rows[y * width + x]);
                if depth < sight.depth {
                    *sight = Sight { depth, face };
                }
            }
        }
    }
}

/// The samples `first..end` of 0..count whose centres lie between the smallest and largest value.
fn span(values: [f64; 3], count: usize) -> (usize, usize) {
    let low = values[0].min(values[1]).min(values[2]);
    let high = values[0].max(values[1]).max(values[2]);
    // Conversions of floats to integers saturate, and negative ones become 0.
    let first = (low - 0.5).ceil() as usize;
    let end = (high + 0.5).floor() as usize;
    (first.min(count), end.min(count))
}
