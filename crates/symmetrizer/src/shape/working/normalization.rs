//! Working coordinates: the area centroid is the origin, L is 1.

use crate::error::{Error, Result};
use crate::geom::{Point, Vector};

/// The similarity between document coordinates and working coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Normalization {
    /// Area centroid in document coordinates.
    pub center: Point,
    /// The scale L in document units.
    pub scale: f64,
}

impl Normalization {
    /// Document -> working coordinates.
    pub fn to_working(&self, p: &Point) -> Point {
        Point::from((p - self.center) / self.scale)
    }

    /// Working -> document coordinates.
    pub fn to_document(&self, p: &Point) -> Point {
        self.center + p.coords * self.scale
    }
}

/// Area centroid and L = 4 x area-weighted rms radius, both exact integrals over the triangles.
pub(super) fn normalize(positions: &[Point], triangles: &[[u32; 3]]) -> Result<Normalization> {
    let no_area = || {
        Error::input(
            "the faces have no area",
            "all of them are degenerate: check the file's coordinates",
        )
    };
    // A first origin near the shape keeps far-away coordinates from cancelling.
    let origin = positions.first().copied().ok_or_else(no_area)?;
    let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize] - origin);
    let area = |[a, b, c]: &[Vector; 3]| 0.5 * (b - a).cross(&(c - a)).norm();
    let mut total = 0.0;
    let mut moment = Vector::zeros();
    for t in triangles {
        let x = corners(t);
        let w = area(&x);
        total += w;
        moment += (x[0] + x[1] + x[2]) * (w / 3.0);
    }
    if !(total > 0.0 && total.is_finite()) {
        return Err(no_area());
    }
    let mean = moment / total;
    let mut second = 0.0;
    for t in triangles {
        let x = corners(t).map(|v| v - mean);
        // Exact integral of |x|^2 over a triangle: (|a|^2 + |b|^2 + |c|^2 + |a+b+c|^2) / 12.
        let sum: f64 = x.iter().map(|v| v.norm_squared()).sum();
        second += area(&x) * (sum + (x[0] + x[1] + x[2]).norm_squared()) / 12.0;
    }
    let scale = 4.0 * (second / total).sqrt();
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(no_area());
    }
    Ok(Normalization {
        center: origin + mean,
        scale,
    })
}
