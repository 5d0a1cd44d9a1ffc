//! Area-uniform samples of a surface.

use rand::{Rng, RngExt};

use crate::shape::{Surface, SurfacePoint};

/// `count` points spread uniformly over the area, one in each of `count` equal slices of the
/// cumulative area: every part of the surface gets its share to within one sample, which makes
/// means over the samples far less noisy than independent points do.
///
/// The points come in the order of their faces, so any stride through them is again an
/// area-uniform sample. Empty where the surface has no (finite) area.
pub fn uniform(surface: &Surface, count: usize, rng: &mut impl Rng) -> Vec<SurfacePoint> {
    let areas = &surface.face_areas;
    let total = surface.area();
    let Some(last) = areas.iter().rposition(|&a| a > 0.0) else {
        return Vec::new();
    };
    if !total.is_finite() {
        return Vec::new();
    }
    let mut face = 0;
    let mut end = areas[0];
    let mut points = Vec::with_capacity(count);
    for slice in 0..count {
        let at = (slice as f64 + rng.random::<f64>()) / count as f64 * total;
        // Rounding may leave `at` beyond the sum of the areas; a face without area gets no point.
        while at >= end && face < last {
            face += 1;
            end += areas[face];
        }
        points.push(SurfacePoint {
            face: face as u32,
            bary: in_triangle(rng),
        });
    }
    points
}

/// Uniform barycentric coordinates: the unit square folded along its diagonal.
fn in_triangle(rng: &mut impl Rng) -> [f64; 3] {
    let (u, v): (f64, f64) = (rng.random(), rng.random());
    let (u, v) = if u + v > 1.0 {
        (1.0 - u, 1.0 - v)
    } else {
        (u, v)
    };
    [1.0 - u - v, u, v]
}
