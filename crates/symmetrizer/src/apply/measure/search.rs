//! Looks in all orientations for the planes in which a surface is nearly its own mirror image.
//!
//! Coarse to fine: hundreds of directions are scored on points alone, the distinct best of them
//! move to their local minimum on a few samples, and the survivors again on more.

use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rayon::prelude::*;

use crate::apply::measure::refine::{Fitted, descend, image};
use crate::geom::{Ambient, Matrix3, Point, Vector, sorted_eigen};
use crate::shape::ClosestPoint;
use crate::transform::isometry::Plane;

type Cloud = ImmutableKdTree<f64, 3>;

/// Directions tried: a half sphere's worth, 9 degrees apart; ours.
const DIRECTIONS: usize = 240;
/// Samples mirrored to score a direction; ours.
const SCORED: usize = 300;
/// Points that stand for the surface while directions are scored; ours.
const TARGETS: usize = 4_000;
/// Directions taken further; ours.
const PROMISING: usize = 24;
/// A direction nearer than this to a better one is left to it; ours.
const PROMISING_APART: Apart = Apart {
    degrees: 10.0,
    offset: f64::INFINITY,
};
/// While the search runs, the better one only of two planes nearer than this goes on; ours.
const SAME: Apart = Apart {
    degrees: 3.0,
    offset: 0.01,
};
/// In the end planes nearer than this are one; ours.
const ONE: Apart = Apart {
    degrees: 5.0,
    offset: 0.02,
};

/// One round of the search: every plane still in it descends.
struct Sieve {
    samples: usize,
    rounds: usize,
    /// A plane stops when a round lowers its mean by less than this share.
    gain: f64,
    /// Of planes that are not this far apart the best passes,
    apart: Apart,
    /// at most so many of them,
    pass: usize,
    /// those whose mean is at most this multiple of the best
    reach: f64,
    /// plus this fraction of L, because a few samples cannot tell small means apart.
    slack: f64,
}

/// Ours: generous at first, because a wrong offset can hide the right direction.
const SIEVES: [Sieve; 4] = [
    Sieve {
        samples: 300,
        rounds: 5,
        gain: 0.02,
        apart: SAME,
        pass: 12,
        reach: 1.4,
        slack: 3e-3,
    },
    Sieve {
        samples: 1_250,
        rounds: 12,
        gain: 0.005,
        apart: SAME,
        pass: 12,
        reach: 1.35,
        slack: 1e-3,
    },
    Sieve {
        samples: 5_000,
        rounds: 20,
        gain: 2e-4,
        apart: SAME,
        pass: 12,
        reach: 1.3,
        slack: 6e-4,
    },
    Sieve {
        samples: usize::MAX,
        rounds: 3,
        gain: 3e-4,
        apart: ONE,
        pass: 12,
        reach: 1.3,
        slack: 6e-4,
    },
];

/// How far apart two planes must be to count as two: in angle or in offset.
#[derive(Debug, Clone, Copy)]
struct Apart {
    /// Angle between the normals.
    degrees: f64,
    /// Difference of the distances from the origin, the rest shape's centroid; fraction of L.
    offset: f64,
}

impl Apart {
    fn holds(&self, a: &Plane, b: &Plane) -> bool {
        let cos = a.normal.dot(&b.normal);
        let offset = (a.offset - b.offset * cos.signum()).abs();
        cos.abs() < self.degrees.to_radians().cos() || offset > self.offset
    }
}

/// Local minima of the mean mirror distance of `samples`, best first, at most twelve, more than 5
/// degrees or 2 % of L apart; minima much worse than the best are dropped on the way. Candidates take part whatever they score at first.
pub(super) fn local_minima(
    samples: &[Point],
    candidates: &[Plane],
    closest: &ClosestPoint,
    ambient: Ambient,
) -> Vec<Fitted> {
    let mut planes: Vec<Plane> = candidates.to_vec();
    planes.extend(promising(samples, ambient));
    let mut fitted = Vec::new();
    for sieve in &SIEVES {
        let subset = strided(samples, sieve.samples);
        fitted = planes
            .par_iter()
            .map(|&plane| descend(plane, &subset, closest, sieve.rounds, sieve.gain, ambient))
            .collect();
        fitted = distinct(fitted, &sieve.apart);
        fitted.truncate(sieve.pass);
        let limit = fitted.first().map_or(0.0, |f| f.mean) * sieve.reach + sieve.slack;
        fitted.retain(|f| f.mean <= limit);
        planes = fitted.iter().map(|f| f.plane).collect();
    }
    fitted
}

/// The best of each group of like planes, best first.
fn distinct(mut fitted: Vec<Fitted>, apart: &Apart) -> Vec<Fitted> {
    fitted.sort_by(|a, b| a.mean.total_cmp(&b.mean));
    let mut kept: Vec<Fitted> = Vec::new();
    for f in fitted {
        if kept.iter().all(|k| apart.holds(&k.plane, &f.plane)) {
            kept.push(f);
        }
    }
    kept
}

/// Every k-th sample, about `count` of them.
fn strided(samples: &[Point], count: usize) -> Vec<Point> {
    let stride = (samples.len() / count).max(1);
    samples.iter().copied().step_by(stride).collect()
}

/// The well-separated directions in which the points mirror best, as planes through their centroid.
fn promising(samples: &[Point], ambient: Ambient) -> Vec<Plane> {
    let targets: Vec<[f64; 3]> = strided(samples, TARGETS)
        .into_iter()
        .map(Into::into)
        .collect();
    let Ok(cloud) = Cloud::new_from_slice(&targets) else {
        return Vec::new();
    };
    let scored = strided(samples, SCORED);
    let (centroid, axes) = principal_axes(samples);
    let fitted = directions(&axes, ambient)
        .into_par_iter()
        .map(|n| {
            let plane = Plane::through(&centroid, n);
            let mean = cloud_distance(&plane, &scored, &cloud);
            Fitted { plane, mean }
        })
        .collect();
    let mut best = distinct(fitted, &PROMISING_APART);
    best.truncate(PROMISING);
    best.iter().map(|f| f.plane).collect()
}

/// Mean distance of the mirrored samples from the cloud's points.
fn cloud_distance(plane: &Plane, samples: &[Point], cloud: &Cloud) -> f64 {
    let distance = |x: &Point| {
        let y: [f64; 3] = image(plane, x).into();
        let nearest = cloud
            .query(&y)
            .nearest_one::<SquaredEuclidean<f64>>()
            .execute();
        nearest.distance.sqrt()
    };
    samples.iter().map(distance).sum::<f64>() / samples.len().max(1) as f64
}

/// Centroid and principal axes (columns, by growing variance) of area-uniform samples.
fn principal_axes(samples: &[Point]) -> (Point, Matrix3) {
    let count = samples.len().max(1) as f64;
    let sum: Vector = samples.iter().map(|p| p.coords).sum();
    let centroid = Point::from(sum / count);
    let mut c = Matrix3::zeros();
    for p in samples {
        let v = p - centroid;
        c += v * v.transpose();
    }
    (centroid, sorted_eigen(&(c / count)).1)
}

/// The principal axes and a Fibonacci half sphere laid into them: evenly spread, and turning with
/// the shape, so that a turned shape is searched in the same directions.
fn directions(axes: &Matrix3, ambient: Ambient) -> Vec<Vector> {
    if ambient == Ambient::Plane {
        let longest = axes.column(2);
        let turned = |i: usize| {
            let angle = std::f64::consts::PI * i as f64 / DIRECTIONS as f64;
            let (sin, cos) = angle.sin_cos();
            let (x, y) = (longest.x, longest.y);
            Vector::new(cos * x - sin * y, sin * x + cos * y, 0.0).normalize()
        };
        return (0..DIRECTIONS).map(turned).collect();
    }
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let spread = (0..DIRECTIONS).map(|i| {
        let z = (i as f64 + 0.5) / DIRECTIONS as f64;
        let radius = (1.0 - z * z).sqrt();
        let angle = golden * i as f64;
        axes * Vector::new(radius * angle.cos(), radius * angle.sin(), z)
    });
    let principal = (0..3).map(|k| axes.column(k).into_owned());
    principal.chain(spread).map(|n| n.normalize()).collect()
}
