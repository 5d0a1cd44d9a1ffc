//! The volume a surface encloses, with its holes closed.

use std::collections::BTreeMap;

use crate::geom::{Point, Vector};
use crate::shape::Surface;

/// The signed volume (units of L^3, positive for outward normals) of the surface, each connected
/// boundary closed by a fan about the mean of its vertices: unlike the bare sum over the faces it
/// does not depend on where an open surface lies.
pub(super) fn volume(surface: &Surface) -> f64 {
    // Near the surface, so that a shape far from the origin does not cancel.
    let origin = surface.positions.first().copied().unwrap_or_default();
    let cone = |a: Vector, b: Vector, c: Vector| a.dot(&b.cross(&c)) / 6.0;
    let at = |v: u32| surface.positions[v as usize] - origin;
    let faces: f64 = surface
        .triangles
        .iter()
        .map(|&[a, b, c]| cone(at(a), at(b), at(c)))
        .sum();
    let boundary = boundary(&surface.triangles);
    let centers = centers(&boundary, &surface.positions);
    let fans: f64 = boundary
        .iter()
        .zip(&centers)
        // The face runs u -> v, so its lid runs v -> u.
        .map(|(&([u, v], times), center)| times * cone(center - origin, at(v), at(u)))
        .sum();
    faces + fans
}

/// Directed edges that more faces run along than against, with the difference, sorted.
fn boundary(triangles: &[[u32; 3]]) -> Vec<([u32; 2], f64)> {
    let mut directed: Vec<([u32; 2], bool)> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[u, v]| ([u.min(v), u.max(v)], u < v))
        .collect();
    directed.sort_unstable();
    directed
        .chunk_by(|a, b| a.0 == b.0)
        .filter_map(|group| {
            let [u, v] = group[0].0;
            let forward = group.iter().filter(|e| e.1).count() as i64;
            match 2 * forward - group.len() as i64 {
                0 => None,
                n if n > 0 => Some(([u, v], n as f64)),
                n => Some(([v, u], -n as f64)),
            }
        })
        .collect()
}

/// For each boundary edge the mean of the vertices of the boundary component it belongs to.
fn centers(boundary: &[([u32; 2], f64)], positions: &[Point]) -> Vec<Point> {
    let mut leader: BTreeMap<u32, u32> = BTreeMap::new();
    for &([u, v], _) in boundary {
        let (a, b) = (find(&mut leader, u), find(&mut leader, v));
        leader.insert(a.max(b), a.min(b));
    }
    let vertices: Vec<u32> = leader.keys().copied().collect();
    let mut sums: BTreeMap<u32, (Vector, f64)> = BTreeMap::new();
    for v in vertices {
        let sum = sums.entry(find(&mut leader, v)).or_default();
        sum.0 += positions[v as usize].coords;
        sum.1 += 1.0;
    }
    boundary
        .iter()
        .map(|&([u, _], _)| {
            let (sum, count) = sums[&find(&mut leader, u)];
            Point::from(sum / count)
        })
        .collect()
}

/// The smallest vertex joined to `v`; shortens the way for the next call.
fn find(leader: &mut BTreeMap<u32, u32>, v: u32) -> u32 {
    let mut root = v;
    while let Some(&up) = leader.get(&root).filter(|&&up| up != root) {
        root = up;
    }
    let mut at = v;
    while let Some(up) = leader.insert(at, root).filter(|&up| up != root && up != at) {
        at = up;
    }
    root
}
