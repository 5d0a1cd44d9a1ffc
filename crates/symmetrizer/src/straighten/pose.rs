//! The way back: a symmetric shape takes on the pose, or a share of it, that it was straightened from.
//!
//! A place on the spine and its two sides are turned by the same rotation, so that the sides stay mirror
//! images of each other: the mirror is bent with the shape.

use rayon::prelude::*;

use crate::deform::elastic::Motion;
use crate::deform::smooth::SmoothField;
use crate::deform::solver::{Entries, SolveError};
use crate::error::{Error, Result};
use crate::field::grow::Land;
use crate::field::{Partner, SymmetryField};
use crate::geom::{Matrix3, Point, Vector, nearest_orthogonal};
use crate::sample::Sample;
use crate::shape::{ClosestPoint, Surface, SurfacePoint};
use crate::straighten::bend::shared;
use crate::straighten::blend::Blend;
use crate::straighten::turned::turned;
use crate::straighten::{Bend, Straightened};
use crate::transform::{Isometry, Plane};

/// Partners on a symmetric shape lie within this distance of the image, fraction of L, and face its way to
/// within this cosine.
const REACH: f64 = 0.01;
const MIN_COS: f64 = 0.5;
/// Lengths over which the last moves are smoothed, one after the other, fractions of L.
const SMOOTH: [f64; 3] = [0.03, 0.015, 0.007];

/// How firmly samples in the middle keep their rotations beside an edge between neighbours, and those without
/// a partner.
const HELD: f64 = 100.0;
const FREE: f64 = 1e-6;
/// Half of the distance between partners at which that has fallen to 1/e, fraction of L.
const MIDDLE: f64 = 0.05;

/// A symmetric shape in its pose.
pub struct Posed {
    /// Vertex positions.
    pub positions: Vec<Point>,
    /// How far partners lie from opposite each other across the mirrors that were bent with the shape, mean,
    /// fraction of L.
    pub across: f64,
    /// How far the centre line, the middles between partners near it, lies from where it was in the input, rms,
    /// fraction of L.
    pub line: f64,
}

/// `symmetric` under the mirror `plane`, which is `bend` undone as `straight` says and then made symmetric,
/// with `share` (0..=1) of the bend again.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn bend_again(
    land: &Land<'_>,
    bend: &Bend,
    straight: &Straightened,
    (symmetric, plane): (&Surface, &Plane),
    share: f64,
) -> Result<Posed> {
    let back = |turn: &Matrix3| {
        let back = (straight.frame * turn).transpose();
        nalgebra::Rotation3::from_matrix_unchecked(back)
            .powf(share)
            .into_inner()
    };
    let turns = followed(land, &bend.field, &shared(&bend.turns, &bend.field))?;
    let back: Vec<Matrix3> = turns.iter().map(back).collect();
    let turns = Blend::new(land.surface, land.samples).rotations(&back);
    let bent = turned(land, symmetric, &turns, &[])?;
    let mirror = Isometry::mirror(plane);
    let closest = ClosestPoint::new(symmetric);
    let normals: Vec<Vector> = turns.iter().map(|turn| turn * plane.normal).collect();
    let mut sides = Sides {
        normals,
        partners: (0..symmetric.positions.len())
            .into_par_iter()
            .map(|v| {
                let image = mirror.apply(&symmetric.positions[v]);
                let normal = mirror.rotate(&symmetric.vertex_normals[v]);
                let hit = closest.nearest_facing(&image, &normal, MIN_COS, REACH)?;
                Some(hit.at)
            })
            .collect(),
    };
    let mut posed = symmetric.with_positions(bent);
    for length in SMOOTH {
        posed = sides.opposite(&posed, length)?;
    }
    let line = Line::of(&sides, symmetric);
    let over = line.onto(&posed, land.surface);
    let posed = posed.with_positions(posed.positions.iter().map(|x| over.apply(x)).collect());
    for normal in &mut sides.normals {
        *normal = over.rotation * *normal;
    }
    Ok(Posed {
        across: sides.across(&posed),
        line: line.moved(&posed, land.surface),
        positions: posed.positions,
    })
}

/// The rotations of the samples near the middle, and for the rest what goes on evenly from those: a limb keeps
/// the form that it has and follows where it sets on. By itself each limb would turn along its length, and the
/// two sides would no longer be opposite each other.
fn followed(land: &Land<'_>, field: &SymmetryField, turns: &[Matrix3]) -> Result<Vec<Matrix3>> {
    let spread = || -> std::result::Result<Vec<Matrix3>, SolveError> {
        let mut entries = Entries::default();
        for &([i, j], w) in &land.reach.edges {
            let w = w * land.firmness([i, j]);
            entries.add_square(&[(j as usize, 1.0), (i as usize, -1.0)], w);
        }
        let held = |(s, q): (&Sample, &Option<Partner>)| {
            let away = q.map(|q| (q.position - s.position).norm() / 2.0);
            FREE + away.map_or(0.0, |away| HELD * (-(away / MIDDLE).powi(2)).exp())
        };
        let samples = land.samples.list.iter();
        let held: Vec<f64> = samples.zip(&field.partners).map(held).collect();
        for (i, w) in held.iter().enumerate() {
            entries.add(i, i, *w);
        }
        let matrix = entries.factorized(turns.len())?;
        let mut sums = vec![Matrix3::zeros(); turns.len()];
        for k in 0..9 {
            let mut x: Vec<f64> = turns.iter().zip(&held).map(|(t, w)| t[k] * w).collect();
            matrix.solve(&mut x)?;
            sums.iter_mut().zip(&x).for_each(|(s, x)| s[k] = *x);
        }
        Ok(sums.iter().map(|s| nearest_orthogonal(s, false)).collect())
    };
    spread().map_err(|_| Error::Numerical {
        stage: "bend again",
        step: 0,
        what: "the rotations could not be spread".into(),
    })
}

/// The two sides of a shape.
struct Sides {
    /// Normal of the bent mirror at each vertex.
    normals: Vec<Vector>,
    /// The partner of each vertex.
    partners: Vec<Option<SurfacePoint>>,
}

impl Sides {
    /// For each vertex the part of the way to its partner that does not run across the mirror.
    fn misses(&self, posed: &Surface) -> Vec<Vector> {
        let miss = |v: usize| {
            let Some(at) = &self.partners[v] else {
                return Vector::zeros();
            };
            let corners = posed.triangles[at.face as usize].iter().zip(at.bary);
            let there: Vector = corners.map(|(&c, b)| self.normals[c as usize] * b).sum();
            // One normal for both, as both have it when they ask.
            let normal = (self.normals[v] + there).normalize();
            let way = posed.point(at) - posed.positions[v];
            way - normal * normal.dot(&way)
        };
        (0..self.normals.len()).into_par_iter().map(miss).collect()
    }

    /// Each side half of the way to where it is opposite the other; what integration leaves is small, and
    /// smooth but for partners that are none.
    fn opposite(&self, posed: &Surface, length: f64) -> Result<Surface> {
        let halves: Vec<Vector> = self.misses(posed).iter().map(|m| m / 2.0).collect();
        let known = |at: &Option<SurfacePoint>| f64::from(u8::from(at.is_some()));
        let confidence: Vec<f64> = self.partners.iter().map(known).collect();
        let moves = SmoothField::new(posed, None)
            .and_then(|mut field| field.solve(&halves, &confidence, length))
            .map_err(|_| Error::Numerical {
                stage: "bend again",
                step: 0,
                what: "the smoothing system could not be solved".into(),
            })?;
        let moved = posed.positions.iter().zip(moves);
        Ok(posed.with_positions(moved.map(|(x, way)| x + way).collect()))
    }

    /// Mean miss, weighted by area.
    fn across(&self, posed: &Surface) -> f64 {
        let misses = self.misses(posed);
        let weighted = misses.iter().zip(&posed.vertex_areas);
        weighted.map(|(m, a)| m.norm() * a).sum::<f64>() / posed.area()
    }
}

/// The centre line: the middles between partners, the closer they are the more they count.
struct Line {
    /// Vertices, the partner of each, their weights.
    middles: Vec<(usize, SurfacePoint, f64)>,
}

impl Line {
    /// That of a `symmetric` shape.
    fn of(sides: &Sides, symmetric: &Surface) -> Self {
        let middle = |(v, at): (usize, &Option<SurfacePoint>)| {
            let at = (*at)?;
            let away = (symmetric.point(&at) - symmetric.positions[v]).norm() / 2.0;
            let weight = symmetric.vertex_areas[v] * (-(away / MIDDLE).powi(2)).exp();
            Some((v, at, weight))
        };
        let partners = sides.partners.iter().enumerate();
        Self {
            middles: partners.filter_map(middle).collect(),
        }
    }

    /// Where it runs on a state of the shape.
    fn places(&self, on: &Surface) -> Vec<Point> {
        let middles = self.middles.iter();
        middles
            .map(|(v, at, _)| nalgebra::center(&on.positions[*v], &on.point(at)))
            .collect()
    }

    /// The rigid motion that takes the line of `posed` nearest to that of `input`.
    fn onto(&self, posed: &Surface, input: &Surface) -> Motion {
        let weights: Vec<f64> = self.middles.iter().map(|m| m.2).collect();
        if weights.iter().sum::<f64>() > 0.0 {
            Motion::between(&self.places(posed), &self.places(input), &weights)
        } else {
            Motion::rest(Point::origin())
        }
    }

    /// The rms way from that in `input`.
    fn moved(&self, posed: &Surface, input: &Surface) -> f64 {
        let total: f64 = self.middles.iter().map(|m| m.2).sum();
        let ways = self.places(posed).into_iter().zip(self.places(input));
        let squares = ways
            .zip(&self.middles)
            .map(|((x, y), m)| m.2 * (x - y).norm_squared());
        (squares.sum::<f64>() / total.max(f64::MIN_POSITIVE)).sqrt()
    }
}
