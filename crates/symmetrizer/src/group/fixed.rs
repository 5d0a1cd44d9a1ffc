//! Points that several isometries fix.

use crate::geom::{Matrix3, Point, Vector, sorted_eigen};
use crate::group::Within;
use crate::transform::Isometry;

/// The point nearest to the support's centroid that all of `isometries` fix within the tolerance:
/// the least squares of T x - x, where directions along which the support's radius makes less
/// than the tolerance are left alone. `None` where there is none: translations, screws, parallel
/// planes, axes that pass each other.
pub(super) fn common_fixed_point(isometries: &[Isometry], within: Within<'_>) -> Option<Point> {
    let centre = within.space.centre();
    let mut a = Matrix3::zeros();
    let mut b = Vector::zeros();
    for t in isometries {
        let d = t.linear - Matrix3::identity();
        a += d.transpose() * d;
        b += d.transpose() * (t.apply(&centre) - centre);
    }
    let (values, vectors) = sorted_eigen(&a);
    let slack = within.tolerance / within.space.radius();
    let least = slack * slack * isometries.len() as f64;
    let x = (0..3)
        .filter(|&i| values[i] > least)
        .map(|i| vectors.column(i) * (-vectors.column(i).dot(&b) / values[i]))
        .fold(centre, |x, step| x + step);
    let fixed = |t: &Isometry| (t.apply(&x) - x).norm() <= within.tolerance;
    isometries.iter().all(fixed).then_some(x)
}

/// The largest sets of `isometries`, by index, that fix a point together, each grown from one of
/// them in the order given. One may be in several: a mirror plane can hold the centres of many
/// groups. What fixes no point is in none.
pub fn fixed_together(isometries: &[Isometry], within: Within<'_>) -> Vec<Vec<usize>> {
    let mut sets: Vec<Vec<usize>> = (0..isometries.len())
        .filter_map(|seed| grown(seed, isometries, within))
        .collect();
    sets.sort_by(|a, b| b.len().cmp(&a.len()).then_with(|| a.cmp(b)));
    let mut kept: Vec<Vec<usize>> = Vec::new();
    for set in sets {
        let inside = |larger: &Vec<usize>| set.iter().all(|i| larger.contains(i));
        if !kept.iter().any(inside) {
            kept.push(set);
        }
    }
    kept
}

/// `seed` and all that can be added to it, one after the other.
fn grown(seed: usize, isometries: &[Isometry], within: Within<'_>) -> Option<Vec<usize>> {
    let mut chosen = vec![isometries[seed]];
    common_fixed_point(&chosen, within)?;
    let mut set = vec![seed];
    for (i, t) in isometries.iter().enumerate() {
        if i == seed {
            continue;
        }
        chosen.push(*t);
        if common_fixed_point(&chosen, within).is_some() {
            set.push(i);
        } else {
            chosen.pop();
        }
    }
    set.sort_unstable();
    Some(set)
}
