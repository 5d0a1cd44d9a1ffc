//! Polygons cut into triangles without new vertices.

use crate::geom::{Point, Vector};

/// Polygons of more corners than this are cut as fans even where they are not convex: clipping ears
/// takes time with the cube of the corners.
const MOST: usize = 256;

/// The triangles of a polygon with `n` corners at `positions`: n - 2 of them, as corner numbers.
///
/// A convex polygon becomes a fan around its first corner. Another one has its ears clipped, the
/// polygon seen along its normal (Newell's), so that no triangle lies outside of it; corners on a
/// straight line become triangles without area, because every vertex has to be in one.
pub fn triangulate(positions: &[Point]) -> Vec<[u32; 3]> {
    let n = positions.len();
    match flattened(positions) {
        Some(flat) if n > 3 && n <= MOST && !is_convex(&flat) => clip_ears(&flat),
        _ => (1..n.saturating_sub(1) as u32)
            .map(|k| [0, k, k + 1])
            .collect(),
    }
}

/// The polygon in the plane across its normal; `None` where it has none.
fn flattened(positions: &[Point]) -> Option<Vec<[f64; 2]>> {
    let first = positions.first()?;
    let next = positions.iter().cycle().skip(1);
    let turns = positions
        .iter()
        .zip(next)
        .map(|(p, q)| (p - first).cross(&(q - first)));
    let normal: Vector = turns.sum();
    let normal = normal
        .try_normalize(f64::MIN_POSITIVE)
        .filter(|n| n.iter().all(|c| c.is_finite()))?;
    let u = normal.cross(&Vector::ith(normal.iamin(), 1.0)).normalize();
    let v = normal.cross(&u);
    let flat = positions
        .iter()
        .map(|p| [(p - first).dot(&u), (p - first).dot(&v)]);
    Some(flat.collect())
}

/// Twice the signed area of a triangle.
fn area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn is_convex(flat: &[[f64; 2]]) -> bool {
    let n = flat.len();
    (0..n).all(|k| area([flat[k], flat[(k + 1) % n], flat[(k + 2) % n]]) >= 0.0)
}

fn clip_ears(flat: &[[f64; 2]]) -> Vec<[u32; 3]> {
    let mut ring: Vec<u32> = (0..flat.len() as u32).collect();
    let mut triangles = Vec::with_capacity(flat.len() - 2);
    while ring.len() > 3 {
        let ear = ear(flat, &ring);
        triangles.push(around(&ring, ear));
        ring.remove(ear);
    }
    triangles.push([ring[0], ring[1], ring[2]]);
    triangles
}

/// Corner k of the ring between its neighbours.
fn around(ring: &[u32], k: usize) -> [u32; 3] {
    let n = ring.len();
    [ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]]
}

/// The first proper ear; where there is none (the rest is a line, or crosses itself) the corner
/// with the least area.
fn ear(flat: &[[f64; 2]], ring: &[u32]) -> usize {
    let corners = |k: usize| around(ring, k).map(|v| flat[v as usize]);
    let is_ear = |k: &usize| {
        let ear = corners(*k);
        let own = around(ring, *k);
        let others = ring.iter().filter(|v| !own.contains(v));
        area(ear) > 0.0
            && !others
                .into_iter()
                .any(|&v| is_inside(flat[v as usize], ear))
    };
    let least = || {
        let size = |k: &usize| area(corners(*k)).abs();
        (0..ring.len()).min_by(|a, b| size(a).total_cmp(&size(b)))
    };
    (0..ring.len()).find(is_ear).or_else(least).unwrap_or(0)
}

/// Whether a point is inside of a triangle that turns left, or on its rim but at no corner.
fn is_inside(p: [f64; 2], [a, b, c]: [[f64; 2]; 3]) -> bool {
    let inside = [[a, b, p], [b, c, p], [c, a, p]]
        .into_iter()
        .all(|t| area(t) >= 0.0);
    inside && p != a && p != b && p != c
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flat(corners: &[[f64; 2]]) -> Vec<Point> {
        corners
            .iter()
            .map(|c| Point::new(c[0], 2.0, c[1]))
            .collect()
    }

    fn sizes(corners: &[Point]) -> Vec<f64> {
        let size = |t: [u32; 3]| {
            let [a, b, c] = t.map(|v| corners[v as usize]);
            // Seen along -y the polygons below turn left.
            -(b - a).cross(&(c - a)).y / 2.0
        };
        triangulate(corners).into_iter().map(size).collect()
    }

    #[test]
    fn convex_polygons_are_fans() {
        let square = flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(triangulate(&square), [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn a_dart_is_cut_at_its_notch() {
        let dart = flat(&[[0.0, 0.0], [4.0, 0.0], [1.0, 1.0], [0.0, 4.0]]);
        let sizes = sizes(&dart);
        assert_eq!(sizes.len(), 2);
        assert!(sizes.iter().all(|s| *s > 0.0), "{sizes:?}");
        assert!((sizes.iter().sum::<f64>() - 4.0).abs() < 1e-12);
    }

    #[test]
    fn every_corner_is_in_a_triangle() {
        // An L with corners on straight lines.
        let l = flat(&[
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
            [0.0, 1.0],
        ]);
        let triangles = triangulate(&l);
        assert_eq!(triangles.len(), 6);
        assert!((0..8).all(|v| triangles.iter().flatten().any(|w| *w == v)));
        let sizes = sizes(&l);
        assert!(sizes.iter().all(|s| *s >= 0.0), "{sizes:?}");
        assert!((sizes.iter().sum::<f64>() - 3.0).abs() < 1e-12);
    }

    #[test]
    fn anything_has_two_triangles_less_than_corners() {
        let nan = Point::new(f64::NAN, 0.0, 0.0);
        for corners in [vec![], vec![nan; 2], vec![nan; 5], vec![Point::origin(); 6]] {
            assert_eq!(triangulate(&corners).len(), corners.len().saturating_sub(2));
        }
    }
}
