//! Normals of a cloud, its noise, and its points brought onto the surface that they scatter about.

use std::f64::consts::PI;

use rayon::prelude::*;

use super::local::{Local, local};
use crate::geom::{Point, PointIndex};

/// Neighbours of a fit at the least: a quadric has six parameters.
const FEWEST: usize = 12;
/// Neighbours of a fit at the most.
const MOST: usize = 320;
/// Neighbours by which spacing and noise are judged first: so few see one sheet of a thin shape.
const SURVEYED: usize = 12;
/// Points at which they are judged.
const SURVEYS: usize = 3000;
/// Noise, in units of the neighbours' reach, from which more neighbours are needed to judge it.
const THICK: f64 = 0.3;
/// Error of a normal that noise may cause, radians: about 3.5 degrees.
const WANTED: f64 = 0.06;

/// What a survey of a cloud found.
#[derive(Debug, Clone, Copy)]
pub(super) struct Survey {
    /// Neighbours that it took.
    count: usize,
    /// Side of the square that a point stands for, median.
    pub spacing: f64,
    /// Standard deviation of the points' distance from the surface, median.
    pub noise: f64,
}

/// The points that normals are fitted to.
pub(super) struct Fitted {
    points: Vec<Point>,
    index: PointIndex<3>,
    /// What they are like.
    pub survey: Survey,
}

impl Fitted {
    /// Surveys `points`.
    pub fn new(points: Vec<Point>) -> Self {
        let places: Vec<[f64; 3]> = points.iter().map(|p| p.coords.into()).collect();
        let index = PointIndex::new(&places);
        Self {
            survey: survey(&points, &index),
            points,
            index,
        }
    }

    /// Size of the cells of which one point each is enough: 0, or where the points lie in many layers
    /// within the noise, so much that a cell holds most of them.
    pub fn coarse(&self) -> f64 {
        let Survey { noise, spacing, .. } = self.survey;
        if noise > spacing { 2.0 * noise } else { 0.0 }
    }

    /// So many of the points next to `x`, the nearest first, with their squared distances.
    fn near(&self, x: &Point, count: usize) -> Vec<(u32, f64)> {
        self.index.nearest_n(&x.coords.into(), count)
    }
}

/// Spacing and noise of `points`.
fn survey(points: &[Point], index: &PointIndex<3>) -> Survey {
    let mut count = SURVEYED;
    loop {
        let found = survey_by(points, index, count);
        let reach = found.spacing * (count as f64 / PI).sqrt();
        if found.noise <= THICK * reach || count >= MOST {
            return found;
        }
        count *= 2;
    }
}

fn survey_by(points: &[Point], index: &PointIndex<3>, count: usize) -> Survey {
    let found: Vec<(f64, f64)> = points
        .par_iter()
        .step_by(points.len().div_ceil(SURVEYS))
        .map(|x| {
            let hits = index.nearest_n(&x.coords.into(), count + 1);
            let fit = local(x, &places(points, &hits));
            (side(&hits), fit.spread)
        })
        .collect();
    Survey {
        count,
        spacing: median(found.iter().map(|f| f.0)),
        noise: median(found.iter().map(|f| f.1)),
    }
}

/// Side of the square that a point stands for, by the distance of the last of its neighbours.
fn side(hits: &[(u32, f64)]) -> f64 {
    let reach = hits.last().map_or(0.0, |h| h.1);
    (PI * reach / hits.len().max(2) as f64).sqrt()
}

fn places(points: &[Point], hits: &[(u32, f64)]) -> Vec<Point> {
    hits.iter().map(|h| points[h.0 as usize]).collect()
}

/// The middle one of `values`; 0 of none.
pub(super) fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    let middle = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// The surface next to each of the points `at`, by so many of the `fitted` ones around it that the
/// noise turns the normal by about [`WANTED`] at the most.
pub(super) fn locals(fitted: &Fitted, at: &[Point]) -> Vec<Local> {
    let survey = &fitted.survey;
    at.par_iter()
        .map(|x| {
            let mut count = enough(survey.noise, side(&fitted.near(x, survey.count)));
            loop {
                let hits = fitted.near(x, count);
                let fit = local(x, &places(&fitted.points, &hits));
                // A scanner's lines may lie closer along than across.
                if !fit.in_line || count >= MOST || hits.len() == fitted.points.len() {
                    return fit;
                }
                count *= 2;
            }
        })
        .collect()
}

/// How many neighbours steady a normal: a plane over k of them reaches r = spacing sqrt(k / pi), and
/// noise turns it by about 2 noise / (r sqrt k); and r is 2.5 times the noise, so that it is the
/// surface that they spread along.
fn enough(noise: f64, spacing: f64) -> usize {
    let thick = noise / spacing;
    let steady = (2.0 * PI.sqrt() * thick / WANTED).max(6.0 * PI * thick * thick);
    (steady.ceil() as usize).clamp(FEWEST, MOST)
}
