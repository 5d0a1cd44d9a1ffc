//! The signature of a sample: its curvatures at three radii, in a form that mirrors leave alone.

use crate::geom::Vector;
use crate::shape::curvature::{Cloud, Curvature};
use crate::shape::surface::{Surface, SurfacePoint};

/// The number of radii: r0, 2 r0, 4 r0 (docs/definitions.md: r0 = 2.5 median edges, within 0.02 and 0.1 L).
pub const SCALES: usize = 3;

/// Curvatures at each radius r as (asinh k1 r, asinh k2 r): dimensionless, the same for a shape
/// and its mirror image. A radius whose ball reaches over a boundary is `None`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Signature(pub [Option<[f64; 2]>; SCALES]);

impl Signature {
    /// Root mean square difference over the radii that both have; `None` with fewer than two.
    pub fn distance(&self, other: &Self) -> Option<f64> {
        let mut sum = 0.0;
        let mut common = 0;
        for (a, b) in self.0.iter().zip(&other.0) {
            if let (Some(a), Some(b)) = (a, b) {
                sum += (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
                common += 1;
            }
        }
        (common >= 2).then(|| (sum / f64::from(common)).sqrt())
    }

    /// The largest |asinh k r|: near 0 on flat ground, which tells nothing.
    pub fn strength(&self) -> f64 {
        let all = self.0.iter().flatten().flatten();
        all.fold(0.0, |m: f64, k| m.max(k.abs()))
    }
}

/// The radius r0 of the smallest fit, fraction of L: wide enough for the triangles, narrow enough that
/// the widest fit still sees a part and not the whole.
pub fn base_radius(surface: &Surface) -> f64 {
    (2.5 * surface.median_edge()).clamp(0.02, 0.1)
}

/// The signature at a surface point, its frame's first direction (that of k1 at the middle radius,
/// where the curvatures differ enough to define one) and the fitted normal of that radius.
pub fn describe(
    surface: &Surface,
    cloud: &Cloud,
    at: &SurfacePoint,
    r0: f64,
) -> (Signature, Option<Vector>, Vector) {
    let x = surface.point(at);
    let n = surface.normal(at);
    let radius = |s: usize| r0 * f64::from(1 << s);
    let fits: [Option<Curvature>; SCALES] = std::array::from_fn(|s| cloud.fit(&x, &n, radius(s)));
    let signature = std::array::from_fn(|s| {
        let k = fits[s].filter(|k| k.coverage > MIN_COVERAGE)?;
        Some([(k.k1 * radius(s)).asinh(), (k.k2 * radius(s)).asinh()])
    });
    let middle = fits[1];
    let e1 = middle
        .filter(|k| (k.k1 - k.k2) * radius(1) > MIN_ANISOTROPY)
        .map(|k| k.e1);
    (Signature(signature), e1, middle.map_or(n, |k| k.normal))
}

/// The normal that [`describe`] gives.
pub fn normal(surface: &Surface, cloud: &Cloud, at: &SurfacePoint, r0: f64) -> Vector {
    let n = surface.normal(at);
    let fit = cloud.fit(&surface.point(at), &n, 2.0 * r0);
    fit.map_or(n, |k| k.normal)
}

/// Below this share of a full disc the ball hangs over a boundary.
const MIN_COVERAGE: f64 = 0.6;

/// Curvature difference, in units of 1/r, above which principal directions are worth comparing.
const MIN_ANISOTROPY: f64 = 0.15;
