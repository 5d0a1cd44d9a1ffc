//! Places along and across the spine: those of one side, carried to the other by the pairs.

use crate::geom::{Point, Vector, any_orthogonal};
use crate::sample::Samples;
use crate::shape::Surface;
use crate::straighten::Bend;
use crate::straighten::blend::Blend;
use crate::transform::Plane;

/// Directions of the mirror that are tried for the spine.
const DIRECTIONS: usize = 24;
/// Slices along each.
const SLICES: usize = 12;

/// Places on a straightened shape. On one side of the mirror they are its own; the other side has those of
/// its partners, so that a wrong pair breaks any pattern that is drawn by them.
pub struct Chart {
    /// The direction along the spine, in the mirror: that along which local mirrors turn most.
    pub along: Vector,
    /// The direction across it, in the mirror.
    pub across: Vector,
    /// For each vertex how far along it is, 0 to 1, how far across in the same unit, and the share of the
    /// samples around it that have a partner.
    pub places: Vec<[f64; 3]>,
    /// How far along each sample is by itself, 0 to 1.
    pub of_samples: Vec<f64>,
    /// The unit, fraction of L.
    pub length: f64,
}

impl Chart {
    /// Of the surface made `straight` under the mirror `plane`.
    pub fn new(
        bend: &Bend,
        samples: &Samples,
        straight: &Surface,
        plane: &Plane,
        blend: &Blend,
    ) -> Self {
        let at: Vec<Point> = samples.list.iter().map(|s| straight.point(&s.at)).collect();
        let [along, across] = directions(bend, &at, plane);
        let heights = straight.positions.iter().map(|x| along.dot(&x.coords));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
            (l.min(x), h.max(x))
        });
        let length = (high - low).max(f64::MIN_POSITIVE);
        let place =
            |x: &Point| [along.dot(&x.coords) - low, across.dot(&x.coords)].map(|c| c / length);
        // How far the place of its partner is from a sample's own; with it the share that has one.
        let partners = bend.settled.partners.iter().zip(&at);
        let carried = partners.map(|(partner, x)| {
            let Some(q) = partner else {
                return Vector::zeros();
            };
            let own = plane.normal.dot(&x.coords) >= plane.offset;
            let source = if own { *x } else { straight.point(&q.at) };
            let ([a, b], [c, d]) = (place(&source), place(x));
            Vector::new(a - c, b - d, 1.0)
        });
        let carried: Vec<Vector> = carried.collect();
        let ways = blend.means(&carried);
        let places = straight.positions.iter().zip(ways).map(|(x, way)| {
            let [a, b] = place(x);
            let share = way.z.max(f64::MIN_POSITIVE);
            [a + way.x / share, b + way.y / share, way.z]
        });
        Self {
            places: places.collect(),
            of_samples: at.iter().map(|x| place(x)[0]).collect(),
            along,
            across,
            length,
        }
    }
}

/// Along and across the spine: the direction in the mirror along whose slices the turns of the local
/// mirrors differ most, and the other one.
fn directions(bend: &Bend, at: &[Point], plane: &Plane) -> [Vector; 2] {
    let first = any_orthogonal(&plane.normal);
    let second = plane.normal.cross(&first);
    let paired: Vec<(Point, Vector)> = bend
        .field
        .partners
        .iter()
        .zip(at)
        .zip(&bend.turns)
        .filter(|((q, _), _)| q.is_some())
        .map(|((_, x), turn)| (*x, turn.transpose() * Vector::x()))
        .collect();
    let axes = |k: usize| {
        let (sin, cos) = (std::f64::consts::PI * k as f64 / DIRECTIONS as f64).sin_cos();
        [first * cos + second * sin, second * cos - first * sin]
    };
    let best = (0..DIRECTIONS).map(|k| (explained(&paired, &axes(k)[0]), k));
    let best = best.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    let [along, across] = axes(best.map_or(0, |b| b.1));
    [along, across]
}

/// How far the mean normals of slices across `along` are from each other: their variance.
fn explained(paired: &[(Point, Vector)], along: &Vector) -> f64 {
    let heights = || paired.iter().map(|(x, _)| along.dot(&x.coords));
    let low = heights().fold(f64::INFINITY, f64::min);
    let high = heights().fold(f64::NEG_INFINITY, f64::max);
    let mut sums = [(Vector::zeros(), 0.0); SLICES];
    for (height, (_, normal)) in heights().zip(paired) {
        let k = ((height - low) / (high - low) * SLICES as f64) as usize;
        let sum = &mut sums[k.min(SLICES - 1)];
        sum.0 += normal;
        sum.1 += 1.0;
    }
    let full = || sums.iter().filter(|s| s.1 > 0.0);
    let count: f64 = full().map(|s| s.1).sum();
    let mean = full().map(|s| s.0).sum::<Vector>() / count;
    let spread = full().map(|(sum, n)| n * (sum / *n - mean).norm_squared());
    spread.sum::<f64>() / count
}
