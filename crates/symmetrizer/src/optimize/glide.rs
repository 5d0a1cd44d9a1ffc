//! Optimizing sample positions (section 4.1): pairs glide over the surface to where they are
//! symmetric, so that only the shape's own asymmetry is left to deform.

use rayon::prelude::*;

use crate::geom::Point;
use crate::optimize::moving::{Couple, fit_mirror};
use crate::patch::Ground;
use crate::shape::SurfacePoint;
use crate::transform::{Isometry, Plane, TransformSpace, displacements};

/// Rounds at the most: five suffice (section 4.1, figure 5).
const ROUNDS: usize = 8;

/// What gliding did to a cluster.
#[derive(Debug, Clone)]
pub struct Glided {
    /// The optimal mirror after gliding.
    pub plane: Plane,
    /// Variance of the pairs' own mirrors in transformation space, L^2, before the first round and
    /// after each.
    pub variance: Vec<f64>,
}

/// Moves both ends of each couple along their optimal displacements and back onto the surface, by no
/// more than the sample spacing from where they began, and fits the mirror anew, until the
/// cluster's variance falls no further. `None` where the couples leave the mirror undetermined.
pub fn glide(ground: &Ground<'_>, couples: &mut [Couple]) -> Option<Glided> {
    let list = &ground.samples.list;
    let space = TransformSpace::new(list.iter().map(|s| (s.position, 1.0)));
    let origin: Vec<(Point, Point)> = ends(ground, couples);
    let mut plane = fit_mirror(couples, &origin, ground.samples.ambient)?.plane;
    let mut variance = vec![spread(&space, couples, &origin)];
    for _ in 0..ROUNDS {
        let mirror = Isometry::mirror(&plane);
        let moved: Vec<Couple> = couples
            .par_iter()
            .zip(&origin)
            .map(|(c, start)| glide_couple(ground, c, start, &mirror))
            .collect();
        let places = ends(ground, &moved);
        let Some(next) = fit_mirror(&moved, &places, ground.samples.ambient) else {
            break;
        };
        let now = spread(&space, &moved, &places);
        let before = variance[variance.len() - 1];
        if now >= before {
            break;
        }
        couples.copy_from_slice(&moved);
        plane = next.plane;
        variance.push(now);
        if now > 0.99 * before {
            break;
        }
    }
    Some(Glided { plane, variance })
}

fn ends(ground: &Ground<'_>, couples: &[Couple]) -> Vec<(Point, Point)> {
    let place = |at: &SurfacePoint| ground.surface.point(at);
    couples.iter().map(|c| (place(&c.p), place(&c.q))).collect()
}

fn glide_couple(
    ground: &Ground<'_>,
    c: &Couple,
    start: &(Point, Point),
    mirror: &Isometry,
) -> Couple {
    let (p, q) = (ground.surface.point(&c.p), ground.surface.point(&c.q));
    let (d_p, d_q) = displacements(&p, &q, mirror);
    let slide = |at: SurfacePoint, target: Point, start: &Point| {
        let normal = ground.surface.normal(&at);
        // Not beyond the spacing from where the sample began, to avoid drifting.
        let shift = target - start;
        let reach = ground.samples.spacing;
        let target = start + shift * (reach / shift.norm().max(reach));
        ground
            .closest
            .nearest_facing(&target, &normal, 0.5, 2.0 * reach)
            .map_or(at, |hit| hit.at)
    };
    Couple {
        p: slide(c.p, p + d_p, &start.0),
        q: slide(c.q, q + d_q, &start.1),
        ..*c
    }
}

/// The variance of the couples' own mirrors: mean |phi(T_i) - mean phi|^2. Couples whose ends
/// nearly meet define no mirror of their own and do not count.
fn spread(space: &TransformSpace, couples: &[Couple], ends: &[(Point, Point)]) -> f64 {
    let phi: Vec<_> = couples
        .iter()
        .zip(ends)
        .filter_map(|(_, (p, q))| {
            let between = p - q;
            let distance = between.norm();
            (distance > MIN_DISTANCE).then(|| {
                let plane = Plane::through(&nalgebra::center(p, q), between / distance);
                space.embed(&Isometry::mirror(&plane))
            })
        })
        .collect();
    let n = phi.len().max(1) as f64;
    let mean = phi.iter().sum::<crate::transform::space::Phi>() / n;
    phi.iter().map(|x| (x - mean).norm_squared()).sum::<f64>() / n
}

/// As for votes: nearer ends make their mirror a matter of noise.
const MIN_DISTANCE: f64 = 0.06;
