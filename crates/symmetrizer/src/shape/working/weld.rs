//! One working vertex for the vertices in one place.

use crate::geom::Point;
use crate::shape::mesh::{Mesh, is_finite};

/// Merges used vertices whose coordinates are equal; numbers them in file order. Vertices that no
/// face uses, or without a finite position, have no working vertex.
pub(super) fn weld(mesh: &Mesh) -> (Vec<Option<u32>>, Vec<Point>) {
    let mut used = vec![false; mesh.positions.len()];
    for &v in mesh.polygons.iter().flatten() {
        used[v as usize] = is_finite(&mesh.positions[v as usize]);
    }
    let mut order: Vec<u32> = (0..mesh.positions.len() as u32)
        .filter(|&v| used[v as usize])
        .collect();
    // Adding 0.0 makes -0.0 and 0.0 one place.
    let key = |v: u32| mesh.positions[v as usize].coords.map(|c| c + 0.0);
    let compare = |a: &u32, b: &u32| {
        let (p, q) = (key(*a), key(*b));
        (p.x.total_cmp(&q.x))
            .then(p.y.total_cmp(&q.y))
            .then(p.z.total_cmp(&q.z))
    };
    order.sort_by(|a, b| compare(a, b).then(a.cmp(b)));
    let mut first_at_place = vec![u32::MAX; mesh.positions.len()];
    let mut leader = None;
    for &v in &order {
        if leader.is_none_or(|l| compare(&l, &v).is_ne()) {
            leader = Some(v);
        }
        first_at_place[v as usize] = leader.unwrap_or(v);
    }
    let mut map = vec![None; mesh.positions.len()];
    let mut welded = Vec::new();
    for v in 0..mesh.positions.len() {
        if !used[v] {
            continue;
        }
        let l = first_at_place[v] as usize;
        if map[l].is_none() {
            map[l] = Some(welded.len() as u32);
            welded.push(mesh.positions[l]);
        }
        map[v] = map[l];
    }
    (map, welded)
}

/// Leaves out the working vertices that none of `triangles` uses, and renumbers.
pub(super) fn drop_unused(
    vertex_of_document: &mut [Option<u32>],
    welded: &mut Vec<Point>,
    triangles: &mut [[u32; 3]],
) {
    let mut number = vec![None; welded.len()];
    for &v in triangles.iter().flatten() {
        number[v as usize] = Some(0);
    }
    for (count, n) in (0..).zip(number.iter_mut().flatten()) {
        *n = count;
    }
    let mut is_used = number.iter().map(Option::is_some);
    welded.retain(|_| is_used.next().unwrap_or(false));
    let new = |v: u32| number[v as usize];
    for v in vertex_of_document {
        *v = v.and_then(new);
    }
    for v in triangles.iter_mut().flatten() {
        *v = new(*v).unwrap_or(*v);
    }
}
