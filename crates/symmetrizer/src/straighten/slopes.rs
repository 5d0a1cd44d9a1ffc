//! What the surface looks like around each sample: its signature as a linear function of the place.

use nalgebra::Vector4;
use rayon::prelude::*;

use crate::field::Reach;
use crate::geom::{Matrix3, Point, Vector};
use crate::sample::Samples;

/// Curvatures that are compared: both, at the first two radii; the third sees too much of the bend.
pub const SIGNS: usize = 4;
/// Radius of the fits, in sample spacings.
const RADIUS: f64 = 2.5;
/// Ridge of the fits, beside the trace of their moment: flat where hardly anything lies around.
const RIDGE: f64 = 0.01;

/// One curvature around a sample.
#[derive(Debug, Clone, Copy)]
pub struct Slope {
    /// At the sample, made even over its surroundings.
    pub value: f64,
    /// Its gradient, tangent, per L.
    pub gradient: Vector,
}

impl Slope {
    /// The value at `way` from the sample.
    pub fn at(&self, way: &Vector) -> f64 {
        self.value + self.gradient.dot(way)
    }
}

/// The slopes of each sample; `None` where a radius reaches over a boundary.
pub fn slopes(samples: &Samples, reach: &Reach) -> Vec<[Option<Slope>; SIGNS]> {
    let all = (0..samples.list.len()).into_par_iter();
    all.map(|s| std::array::from_fn(|sign| slope(samples, reach, s, sign)))
        .collect()
}

/// Weighted least squares for value and gradient over what lies around.
fn slope(samples: &Samples, reach: &Reach, s: usize, sign: usize) -> Option<Slope> {
    let value = |i: usize| samples.list[i].signature.0[sign / 2].map(|k| k[sign % 2]);
    value(s)?;
    let center: Point = samples.list[s].position;
    let radius = RADIUS * samples.spacing;
    let around: Vec<(Vector, f64, f64)> = reach
        .of(s as u32, radius)
        .filter_map(|(j, d)| {
            let weight = (-2.0 * (d / radius).powi(2)).exp();
            let way = samples.list[j as usize].position - center;
            Some((way, value(j as usize)?, weight))
        })
        .collect();
    // Sums of weight times (way, value): their quotient is the mean place and the mean value.
    let sum: Vector4<f64> = around
        .iter()
        .map(|(way, value, weight)| way.push(*value) * *weight)
        .sum();
    let mean = sum / around.iter().map(|a| a.2).sum::<f64>();
    let (place, level) = (mean.xyz(), mean.w);
    let mut moment = Matrix3::zeros();
    let mut right = Vector::zeros();
    for (way, value, weight) in &around {
        let arm = way - place;
        moment += *weight * arm * arm.transpose();
        right += *weight * arm * (value - level);
    }
    let normal = samples.list[s].normal;
    let trace = moment.trace().max(f64::MIN_POSITIVE);
    moment += trace * (normal * normal.transpose() + RIDGE * Matrix3::identity());
    let gradient = moment.try_inverse()? * right;
    let gradient = gradient - normal * normal.dot(&gradient);
    Some(Slope {
        value: level - gradient.dot(&place),
        gradient,
    })
}
