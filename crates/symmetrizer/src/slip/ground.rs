//! The samples as slippage analysis sees them: positions, normals, what noise does to them, who is
//! next to whom.

use rayon::prelude::*;

use crate::geom::{Point, PointIndex, Vector};
use crate::sample::{Sample, Samples};
use crate::slip::params::SlipParams;
use crate::slip::twist::{Moments, Twist};

/// Share of the mismatch of neighbouring normals that is the error of one of them; ours, measured on a
/// surface of revolution with noise up to 1 % of D.
const NOISE_SHARE: f64 = 0.35;
/// Normals with smaller errors, radians, are clean; ours.
const CLEAN: f64 = 0.001;
/// Angles up to this many tolerances count as sliding; ours. A surface that merely passes by the slide
/// fills them evenly, or as the cube of the distance, with an rms of 2.3 or 1.5 tolerances.
pub const GATE: f64 = 4.0;

/// Samples with normals and tolerance.
pub struct Ground {
    /// Positions.
    pub positions: Vec<Point>,
    /// Unit normals.
    pub normals: Vec<Vector>,
    /// Samples next to each other that face like ways.
    pub facing: Vec<Vec<u32>>,
    /// Samples within reach of each other, across creases too.
    pub around: Vec<Vec<u32>>,
    /// Smallest distance between samples, fraction of L.
    pub spacing: f64,
    /// rms error of the normals, radians, as neighbours tell.
    pub noise: f64,
    /// rms angle, radians, up to which samples slide.
    pub tolerance: f64,
}

impl Ground {
    /// The ways to see `samples`: with normals that keep creases, and, where those are not clean, with
    /// normals fitted over a neighbourhood, which noise spares and creases spoil.
    pub fn views(samples: &Samples, params: &SlipParams) -> Vec<Self> {
        let crisp = Self::new(samples, params, |s| s.crisp);
        if crisp.noise <= CLEAN {
            return vec![crisp];
        }
        vec![crisp, Self::new(samples, params, |s| s.frame.n)]
    }

    fn new(samples: &Samples, params: &SlipParams, normal: impl Fn(&Sample) -> Vector) -> Self {
        let positions: Vec<Point> = samples.list.iter().map(|s| s.position).collect();
        let normals: Vec<Vector> = samples.list.iter().map(normal).collect();
        let noise = NOISE_SHARE * mismatch(&positions, &normals, &samples.neighbors);
        let places: Vec<[f64; 3]> = positions.iter().map(|x| x.coords.into()).collect();
        let index = PointIndex::new(&places);
        let around = places
            .par_iter()
            .map(|x| index.within(x, 2.1 * samples.spacing))
            .collect();
        Self {
            positions,
            normals,
            facing: samples.neighbors.clone(),
            around,
            spacing: samples.spacing,
            noise,
            tolerance: params.tolerance.hypot(noise),
        }
    }

    /// The largest angle that counts as sliding, radians.
    pub fn gate(&self) -> f64 {
        GATE * self.tolerance
    }

    /// The angle, radians, at which `twist` moves sample `i` off the surface. Half a spacing beside the
    /// axis, where directions mean little, it fades.
    pub fn angle(&self, twist: &Twist, i: u32) -> f64 {
        let x = &self.positions[i as usize];
        let velocity = twist.velocity(x);
        let blur = 0.25 * self.spacing * self.spacing * twist.omega.norm_squared();
        let speed = (velocity.norm_squared() + blur).sqrt();
        if speed <= 0.0 {
            return 0.0;
        }
        (velocity.dot(&self.normals[i as usize]).abs() / speed)
            .min(1.0)
            .asin()
    }

    /// The sums of samples, all of weight 1.
    pub fn moments(&self, samples: &[u32]) -> Moments {
        self.weighted(samples.iter().map(|&i| (i, 1.0)))
    }

    /// The sums of weighted samples.
    pub fn weighted(&self, samples: impl Iterator<Item = (u32, f64)>) -> Moments {
        Moments::of(samples.map(|(i, w)| {
            let i = i as usize;
            (&self.positions[i], &self.normals[i], w)
        }))
    }

    /// Where `samples` are on average.
    pub fn centroid(&self, samples: &[u32]) -> Point {
        let sum: Vector = samples
            .iter()
            .map(|&i| self.positions[i as usize].coords)
            .sum();
        Point::from(sum / samples.len().max(1) as f64)
    }
}

/// Lower quartile over neighbours of |(n + m) . (y - x)| / |y - x|: on a smooth surface, where the chord makes
/// equal angles with both normals, it vanishes to third order; noise does not, and spares no place.
fn mismatch(positions: &[Point], normals: &[Vector], neighbors: &[Vec<u32>]) -> f64 {
    let mut all: Vec<f64> = Vec::new();
    for (i, near) in neighbors.iter().enumerate() {
        for &j in near.iter().filter(|&&j| j as usize > i) {
            let chord = positions[j as usize] - positions[i];
            let sum = normals[i] + normals[j as usize];
            all.push(sum.dot(&chord).abs() / chord.norm().max(1e-12));
        }
    }
    if all.is_empty() {
        return 0.0;
    }
    let quarter = all.len() / 4;
    *all.select_nth_unstable_by(quarter, f64::total_cmp).1
}
