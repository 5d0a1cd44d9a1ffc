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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::sample::signature::SCALES;

    /// On a finely triangulated sphere the widest fit looks at fewer points, and sees the same curvature.
    #[test]
    fn the_widest_fit_sees_the_same_from_fewer_points() {
        let (rows, columns) = (200_u32, 400_u32);
        let mut positions = Vec::new();
        for i in 0..=rows {
            for j in 0..columns {
                let theta = std::f64::consts::PI * f64::from(i) / f64::from(rows);
                let phi = std::f64::consts::TAU * f64::from(j) / f64::from(columns);
                let (s, c) = theta.sin_cos();
                positions.push(Point::new(s * phi.cos(), s * phi.sin(), c));
            }
        }
        let at = |i: u32, j: u32| i * columns + j % columns;
        let mut triangles = Vec::new();
        for i in 0..rows {
            for j in 0..columns {
                triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        let surface = Surface::new(positions, triangles.into());
        let clouds = Clouds::new(&surface, 0.1);
        let x = Point::new(1.0, 0.0, 0.0);
        let count = |(cloud, _): (&Cloud, f64)| {
            let mut count = 0;
            cloud.each_facing(&x, &x.coords, 0.4, |_, _| count += 1);
            count
        };
        let (fine, wide) = (count(clouds.at(0)), count(clouds.at(SCALES - 1)));
        assert!(4 * wide < fine, "{wide} of {fine}");
        for scale in 0..SCALES {
            let (cloud, radius) = clouds.at(scale);
            let fit = cloud.fit(&x, &x.coords, radius).expect("enough points");
            assert!((fit.k1 - 1.0).abs() < 0.05 && (fit.k2 - 1.0).abs() < 0.05);
            assert!((fit.coverage - 1.0).abs() < 0.15, "{}", fit.coverage);
        }
    }
}
