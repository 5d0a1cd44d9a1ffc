//! The surface as clouds of points for fits at three radii.

use crate::sample::signature::SCALES;
use crate::shape::curvature::Cloud;
use crate::shape::surface::Surface;

/// Points of the widest fit stand for cells this wide, in units of its radius: as many as in the narrower ones are enough, and
/// without it nine tenths of all points fitted would be its own.
const CELL: f64 = 1.0 / 9.0;

/// Clouds for fits at the radii r0, 2 r0, 4 r0.
pub struct Clouds {
    fine: Cloud,
    /// For the widest fit, where the fine one has more points than that needs.
    coarse: Option<Cloud>,
    /// Radius of the smallest fit, fraction of L.
    pub r0: f64,
}

impl Clouds {
    /// Those of `surface`, the smallest fit of radius `r0`, fraction of L.
    pub fn new(surface: &Surface, r0: f64) -> Self {
        let fine = Cloud::new(surface, r0 / 4.0);
        Self {
            coarse: fine.coarser(CELL * 4.0 * r0),
            fine,
            r0,
        }
    }

    /// The cloud for fits of a scale, 0 to [`SCALES`], and their radius.
    pub fn at(&self, scale: usize) -> (&Cloud, f64) {
        let radius = self.r0 * f64::from(1 << scale);
        match &self.coarse {
            Some(coarse) if scale + 1 == SCALES => (coarse, radius),
            _ => (&self.fine, radius),
        }
    }
}
