//! Point clouds as surfaces of discs.
//!
//! A cloud has no faces to walk on, but detection only asks a surface for samples by area, closest
//! points that face one way, and curvature fits. A small square in the tangent plane of each point
//! answers all of that. Normals come from the file, or from quadrics over as many neighbours as the
//! noise asks for; the quadrics also take most of the noise out of the points.

mod discs;
mod kept;
mod local;
mod normals;
mod orient;

use crate::error::{Error, Result};
use crate::geom::{Matrix3, Point, Vector, sorted_eigen};

use discs::{areas, squares};
use kept::{distinct, drawn, thin};
use normals::{Fitted, locals};
use orient::{Sided, disagreement, orient};

pub(in crate::shape) use discs::CORNERS;

/// Points in different places that a cloud must have: fewer show no curvature.
pub const FEWEST: usize = 50;

/// Points that become discs at the most: their spacing is then about 0.6 % of L, a third of the
/// distance within which detection calls two surfaces the same.
const MOST_DISCS: usize = 20_000;
/// Points that the discs' normals and the noise are judged by at the most.
const MOST_FITTED: usize = 100_000;
/// Ratio of the middle to the largest variance of all points below which they lie on a line.
const LINE: f64 = 1e-10;
/// Share of neighbours on different sides above which given normals count as directions without a side.
const UNSIDED: f64 = 0.2;
/// Noise, in units of the spacing, from which points are moved onto their quadrics: below it that
/// would only round edges.
const NOISY: f64 = 0.05;
/// Scatter about a quadric, in units of the spacing, that curvature may cause.
const SCATTER: f64 = 0.1;

/// A surface of discs.
#[derive(Debug, Clone)]
pub struct Discs {
    /// The middles of the discs, document coordinates.
    pub points: Vec<Point>,
    /// Their unit normals, on one side, outwards where that can be told.
    pub normals: Vec<Vector>,
    /// Their areas, which sum up to about that of the surface; document units.
    pub areas: Vec<f64>,
    /// The document's point that each disc stands at.
    pub document: Vec<u32>,
    /// The disc that stands for each point of the document; none for those without a finite position.
    pub disc_of_document: Vec<Option<u32>>,
    /// Standard deviation of the points' distance from the surface, document units.
    pub noise: f64,
    /// Side of the square that a point of the document stands for, median; document units.
    pub spacing: f64,
}

impl Discs {
    /// The discs of the points `positions`, with the `given` normals if there is one for each.
    ///
    /// # Errors
    /// [`Error::Input`] for fewer than [`FEWEST`] points in different places and for points on a line.
    pub fn new(positions: &[Point], given: Option<&[Vector]>) -> Result<Self> {
        let (places, number) = distinct(positions);
        if places.len() < FEWEST {
            return Err(Error::input(
                format!("the cloud has {} points in different places", places.len()),
                format!("at least {FEWEST} are needed to see a surface"),
            ));
        }
        let all: Vec<Point> = places.iter().map(|&i| positions[i as usize]).collect();
        let (center, scale) = extent(&all)?;
        // Near the origin and of unit size no sum of squares loses its digits.
        let unit: Vec<Point> = all
            .iter()
            .map(|p| Point::from((p - center) / scale))
            .collect();
        let fitted = Fitted::new(drawn(&unit, MOST_FITTED));
        let (kept, cell) = thin(&unit, MOST_DISCS, fitted.coarse());
        let (mut discs, trust) = Self::over(&fitted, kept.iter().map(|&k| unit[k as usize]));
        let place = |&k: &u32| places[k as usize];
        let given = given.and_then(|given| usable(kept.iter().map(|k| given[place(k) as usize])));
        discs.face(given, &trust);
        discs.areas = areas(&discs.points, &discs.normals);
        discs.document = kept.iter().map(place).collect();
        let disc = |place: Option<u32>| place.map(|p| cell[p as usize]);
        discs.disc_of_document = number.into_iter().map(disc).collect();
        discs.scale(&center, scale);
        Ok(discs)
    }

    /// Discs at the points `at`, with normals to either side, and how far these can be trusted: not
    /// where the points scatter more than by noise, as about a sharp rim.
    fn over(fitted: &Fitted, at: impl Iterator<Item = Point>) -> (Self, Vec<f64>) {
        let mut points: Vec<Point> = at.collect();
        let found = fitted.survey;
        let locals = locals(fitted, &points);
        if found.noise > NOISY * found.spacing {
            points = locals.iter().map(|l| l.foot).collect();
        }
        let usual = 1.5 * found.noise + SCATTER * found.spacing;
        let trust = locals.iter().map(|l| (usual / l.spread).min(1.0)).collect();
        let discs = Self {
            points,
            normals: locals.iter().map(|l| l.normal).collect(),
            areas: Vec::new(),
            document: Vec::new(),
            disc_of_document: Vec::new(),
            noise: found.noise,
            spacing: found.spacing,
        };
        (discs, trust)
    }

    /// Turns the normals to one side, after taking over the `given` ones, whose side counts unless
    /// neighbours disagree about it.
    fn face(&mut self, given: Option<Vec<Vector>>, trust: &[f64]) {
        let is_given = given.is_some();
        if let Some(given) = given {
            self.normals = given;
        }
        let sided = Sided {
            points: &self.points,
            normals: &self.normals,
            trust,
            noise: self.noise,
        };
        if !is_given || disagreement(sided) > UNSIDED {
            self.normals = orient(sided);
        }
    }

    fn scale(&mut self, center: &Point, scale: f64) {
        for p in &mut self.points {
            *p = center + p.coords * scale;
        }
        self.areas.iter_mut().for_each(|a| *a *= scale * scale);
        self.noise *= scale;
        self.spacing *= scale;
    }

    /// The discs as triangles, [`CORNERS`] vertices for each disc in their order.
    pub(in crate::shape) fn triangles(&self) -> (Vec<Point>, Vec<[u32; 3]>) {
        squares(&self.points, &self.normals, &self.areas)
    }
}

/// The middle of `points` and their rms distance from it.
fn extent(points: &[Point]) -> Result<(Point, f64)> {
    let origin = points[0];
    let count = points.len() as f64;
    let mean = points.iter().map(|p| (p - origin) / count).sum::<Vector>();
    let center = origin + mean;
    let covariance: Matrix3 = points
        .iter()
        .map(|p| (p - center) * (p - center).transpose() / count)
        .sum();
    let scale = covariance.trace().sqrt();
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(Error::input(
            "the points are too near to each other or too far away for any arithmetic",
            "check the file's coordinates",
        ));
    }
    let (variances, _) = sorted_eigen(&(covariance / (scale * scale)));
    if variances[1] <= LINE * variances[2] {
        return Err(Error::input(
            "the points lie on a line",
            "a cloud must show a surface",
        ));
    }
    Ok((center, scale))
}

/// Unit vectors, if all are finite and none is zero.
fn usable(normals: impl Iterator<Item = Vector>) -> Option<Vec<Vector>> {
    let unit = |n: Vector| {
        n.try_normalize(1e-12)
            .filter(|n| n.iter().all(|c| c.is_finite()))
    };
    normals.map(unit).collect()
}
