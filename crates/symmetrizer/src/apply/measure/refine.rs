//! Moves a mirror plane to the nearest minimum of the mean mirror distance.
//!
//! The letters: x a sample; n, d the plane n.x = d; s = n.x - d; y = x - 2 s n the mirror image;
//! q the closest surface point of y; r = y - q, |r| the mirror distance. The plane has three
//! degrees of freedom: n turns by a e1 + b e2 (e1, e2, n orthonormal), d shifts by c, and to first
//! order dy = a (-2 (e1.x) n - 2 s e1) + b (-2 (e2.x) n - 2 s e2) + c 2 n = J (a, b, c).
//!
//! The mean of |r| (not of its square) is minimised, by Gauss-Newton on reweighted squares
//! sum w ((u.dr)^2 + beta |dr|^2), w = 1 / max(|r|, floor), u = r / |r|. Its gradient is exactly that
//! of the mean distance; the term along u lets the image slide along the surface, as in
//! point-to-plane registration, and beta keeps it from sliding off.

use rayon::prelude::*;

use crate::geom::{Ambient, Matrix3, Point, Vector, any_orthogonal};
use crate::shape::ClosestPoint;
use crate::transform::isometry::Plane;

/// Weight of sliding against approaching: ours.
const BETA: f64 = 0.05;
/// Below this share of the mean a distance counts as this share, so that the samples which
/// already fit do not hold the plane where it is; ours.
const FLOOR: f64 = 0.1;
/// Step lengths tried, in Gauss-Newton steps; ours.
const LONGEST: f64 = 2.0;
const SHORTEST: f64 = 0.25;

/// A sample, where its mirror image misses the surface, and by how much.
#[derive(Debug, Clone, Copy)]
struct Match {
    x: Point,
    q: Point,
    /// y - q.
    r: Vector,
    distance: f64,
}

/// A plane and the mean mirror distance of the samples it was fitted to, in units of L.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fitted {
    pub plane: Plane,
    pub mean: f64,
}

/// Where `x` goes.
pub(super) fn image(plane: &Plane, x: &Point) -> Point {
    x - 2.0 * plane.signed_distance(x) * plane.normal
}

/// Lowers the mean mirror distance of `samples` for at most `rounds` rounds, or until a round
/// lowers it by less than the share `gain`. The result is never worse than `start`: a step that
/// does not lower the mean is halved, and then given up.
pub(super) fn descend(
    start: Plane,
    samples: &[Point],
    closest: &ClosestPoint,
    rounds: usize,
    gain: f64,
    ambient: Ambient,
) -> Fitted {
    let matches = first_matches(&start, samples, closest);
    let mut state = State::new(start, matches);
    // Along valleys of the mean the reweighted step is short, so a doubled one is tried first.
    let mut length = LONGEST;
    for _ in 0..rounds {
        let goal = state.mean * (1.0 - gain);
        let Some(next) = state.lower(&mut length, closest, ambient) else {
            break;
        };
        state = next;
        if state.mean > goal {
            break;
        }
    }
    Fitted {
        plane: state.plane,
        mean: state.mean,
    }
}

/// A plane with the matches and the mean that belong to it.
struct State {
    plane: Plane,
    matches: Vec<Match>,
    mean: f64,
}

impl State {
    fn new(plane: Plane, matches: Vec<Match>) -> Self {
        let mean = mean_distance(&matches);
        Self {
            plane,
            matches,
            mean,
        }
    }

    /// A state of lower mean along the Gauss-Newton step, if there is one; `length`, in steps, is
    /// where the search begins and becomes what succeeded.
    fn lower(&self, length: &mut f64, closest: &ClosestPoint, ambient: Ambient) -> Option<Self> {
        let step = gauss_newton(&self.plane, &self.matches, FLOOR * self.mean, ambient)?;
        while *length >= SHORTEST {
            let plane = moved(&self.plane, &(step * *length), ambient);
            let trial = Self::new(plane, next_matches(&plane, &self.matches, closest));
            if trial.mean < self.mean {
                return Some(trial);
            }
            *length /= 2.0;
        }
        None
    }
}

/// The mirror distance of every sample, in order, in units of L.
pub(super) fn distances(plane: &Plane, samples: &[Point], closest: &ClosestPoint) -> Vec<f64> {
    first_matches(plane, samples, closest)
        .iter()
        .map(|m| m.distance)
        .collect()
}

fn first_matches(plane: &Plane, samples: &[Point], closest: &ClosestPoint) -> Vec<Match> {
    samples
        .par_iter()
        .map(|x| find(plane, x, closest, f64::INFINITY))
        .collect()
}

/// As `first_matches`, faster: the last closest point bounds the search.
fn next_matches(plane: &Plane, last: &[Match], closest: &ClosestPoint) -> Vec<Match> {
    last.par_iter()
        .map(|m| {
            let bound = (image(plane, &m.x) - m.q).norm();
            // A little more, because the search wants a strictly smaller distance.
            find(plane, &m.x, closest, bound * (1.0 + 1e-9) + 1e-12)
        })
        .collect()
}

fn find(plane: &Plane, x: &Point, closest: &ClosestPoint, bound: f64) -> Match {
    let y = image(plane, x);
    let hit = closest
        .nearest(&y, bound)
        .or_else(|| closest.nearest(&y, f64::INFINITY));
    let q = hit.map_or(y, |h| h.point);
    let r = y - q;
    Match {
        x: *x,
        q,
        r,
        distance: r.norm(),
    }
}

fn mean_distance(matches: &[Match]) -> f64 {
    matches.iter().map(|m| m.distance).sum::<f64>() / matches.len().max(1) as f64
}

/// The step (a, b, c); none where the samples do not determine it.
fn gauss_newton(plane: &Plane, matches: &[Match], floor: f64, ambient: Ambient) -> Option<Vector> {
    let n = plane.normal;
    let (e1, e2) = tangents(&n, ambient);
    let mut h = Matrix3::zeros();
    let mut g = Vector::zeros();
    for m in matches {
        let w = 1.0 / m.distance.max(floor).max(1e-12);
        let s = plane.signed_distance(&m.x);
        let turned = |e: &Vector| -2.0 * e.dot(&m.x.coords) * n - 2.0 * s * e;
        let j = Matrix3::from_columns(&[turned(&e1), turned(&e2), 2.0 * n]);
        let jr = j.tr_mul(&m.r);
        // u = r / |r|, so that (u.r) u = r and J^T u u^T J = (J^T r)(J^T r)^T / |r|^2.
        let along = w / m.distance.max(1e-12).powi(2);
        h += jr * jr.transpose() * along + j.tr_mul(&j) * (BETA * w);
        g += jr * (w * (1.0 + BETA));
    }
    let damping = 1e-9 * h.trace();
    let step = -(h + Matrix3::identity() * damping).cholesky()?.solve(&g);
    step.iter().all(|v| v.is_finite()).then_some(step)
}

fn moved(plane: &Plane, step: &Vector, ambient: Ambient) -> Plane {
    let (e1, e2) = tangents(&plane.normal, ambient);
    Plane {
        normal: (plane.normal + step.x * e1 + step.y * e2).normalize(),
        offset: plane.offset + step.z,
    }
}

/// In the plane there is one, and nothing for the other.
fn tangents(n: &Vector, ambient: Ambient) -> (Vector, Vector) {
    if ambient == Ambient::Plane {
        return (Vector::z().cross(n), Vector::zeros());
    }
    let e1 = any_orthogonal(n);
    (e1, n.cross(&e1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Surface;

    /// A rough asymmetric terrain.
    fn terrain() -> Surface {
        let n = 12_u32;
        let height = |i: u32, j: u32| f64::from((i * i * 7 + j * 13 + i * j * 5) % 11) / 60.0;
        let positions = (0..=n)
            .flat_map(|j| (0..=n).map(move |i| (i, j)))
            .map(|(i, j)| Point::new(f64::from(i) / 12.0, f64::from(j) / 9.0, height(i, j)))
            .collect();
        let at = |i: u32, j: u32| j * (n + 1) + i;
        let triangles: Vec<[u32; 3]> = (0..n)
            .flat_map(|j| (0..n).map(move |i| (i, j)))
            .flat_map(|(i, j)| {
                let (a, c) = (at(i, j), at(i + 1, j + 1));
                [[a, at(i + 1, j), c], [a, c, at(i, j + 1)]]
            })
            .collect();
        Surface::new(positions, triangles.into())
    }

    #[test]
    fn descending_never_raises_the_mean_and_reports_the_true_one() {
        let surface = terrain();
        let closest = ClosestPoint::new(&surface);
        let samples = &surface.positions;
        let mean = |plane: &Plane| {
            let all = distances(plane, samples, &closest);
            all.iter().sum::<f64>() / all.len() as f64
        };
        for k in 0..40 {
            let angle = f64::from(k);
            let normal = Vector::new(angle.cos(), angle.sin(), (angle * 0.7).sin()).normalize();
            let start = Plane::through(&Point::new(0.5, 0.6, 0.1), normal);
            let end = descend(start, samples, &closest, 15, 1e-4, Ambient::Space);
            assert!(end.mean <= mean(&start));
            // The searches on the way are bounded by the last closest points; the answer is not.
            assert!((end.mean - mean(&end.plane)).abs() < 1e-12);
        }
    }
}
