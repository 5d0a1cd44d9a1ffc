//! The line through the middle of a limb.

use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::Surface;

/// The vertices of the slices of a limb, from one end to the other.
pub struct CenterLine {
    slices: Vec<Vec<u32>>,
}

impl CenterLine {
    /// Slices of this thickness where `distance` is between `from` and `to`.
    pub fn new(distance: &[f64], from: f64, to: f64, thickness: f64) -> Self {
        let mut slices = vec![Vec::new(); ((to - from) / thickness).round().max(1.0) as usize];
        for (v, d) in (0..).zip(distance) {
            if (from..to).contains(d) {
                let slice = ((d - from) / thickness) as usize;
                let last = slices.len() - 1;
                slices[slice.min(last)].push(v);
            }
        }
        slices.retain(|s| !s.is_empty());
        Self { slices }
    }

    /// The middle of each slice, by the areas that its vertices have at rest.
    pub fn points(&self, rest: &Surface, positions: &[Point]) -> Vec<Point> {
        let middle = |slice: &Vec<u32>| {
            let area = |v: &u32| rest.vertex_areas[*v as usize];
            let sum = |s: Vector, v: &u32| s + positions[*v as usize].coords * area(v);
            let total: f64 = slice.iter().map(area).sum();
            Point::from(slice.iter().fold(Vector::zeros(), sum) / total)
        };
        self.slices.iter().map(middle).collect()
    }

    /// How far the line is from its chord at the most, as a share of the chord.
    pub fn sag(&self, rest: &Surface, positions: &[Point]) -> f64 {
        let points = self.points(rest, positions);
        let (first, last) = (points[0], points[points.len() - 1]);
        let chord = last - first;
        let off = |p: &Point| (p - first).cross(&chord).norm() / chord.norm_squared();
        points.iter().map(off).fold(0.0, f64::max)
    }
}
