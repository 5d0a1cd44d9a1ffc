//! Shading normals: smooth over a smooth surface, split where faces meet at a sharp crease.

use crate::geom::{Point, Vector};
use crate::picture::camera::unit;

/// Cosine of the crease angle, 40 degrees: an edge where the faces turn more than this looks sharp.
const CREASE_COS: f64 = 0.766;
/// Vertices with more faces than this are smoothed as one fan: pairing the faces is quadratic.
const MAX_FAN: usize = 256;

/// A corner of a triangle: the place it stands at, its face and its number in the face.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Corner {
    place: u32,
    face: u32,
    number: u32,
}

/// A normal for each corner of each triangle: a unit vector, or zero where there is no area.
pub(super) fn corner_normals(positions: &[Point], triangles: &[[u32; 3]]) -> Vec<[Vector; 3]> {
    let faces: Vec<Vector> = triangles
        .iter()
        .map(|t| area_vector(positions, t))
        .collect();
    let place = places(positions);
    let mut normals = vec![[Vector::zeros(); 3]; triangles.len()];
    for fan in corners(&place, triangles).chunk_by(|a, b| a.place == b.place) {
        let groups = smooth_groups(fan, |c| neighbours(c, &place, triangles), &faces);
        let mut sums = vec![Vector::zeros(); fan.len()];
        for (corner, &group) in fan.iter().zip(&groups) {
            sums[group] += faces[corner.face as usize];
        }
        for (corner, &group) in fan.iter().zip(&groups) {
            let own = faces[corner.face as usize];
            let normal = unit(sums[group]).or_else(|| unit(own));
            normals[corner.face as usize][corner.number as usize] = normal.unwrap_or_default();
        }
    }
    normals
}

fn corners(place: &[u32], triangles: &[[u32; 3]]) -> Vec<Corner> {
    let mut corners: Vec<Corner> = triangles
        .iter()
        .enumerate()
        .flat_map(|(face, t)| {
            (0..3).map(move |number| Corner {
                place: place[t[number] as usize],
                face: face as u32,
                number: number as u32,
            })
        })
        .collect();
    corners.sort_unstable();
    corners
}

/// The same number for vertices at the same place: seams of a texture are not creases.
fn places(positions: &[Point]) -> Vec<u32> {
    // Adding 0.0 makes -0.0 and 0.0 one place.
    let key = |v: u32| positions[v as usize].coords.map(|c| (c + 0.0).to_bits());
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_by_key(|&v| (<[u64; 3]>::from(key(v)), v));
    let mut place = vec![0; positions.len()];
    for same in order.chunk_by(|&a, &b| key(a) == key(b)) {
        for &v in same {
            place[v as usize] = same[0];
        }
    }
    place
}

/// The places before and after a corner in its face.
fn neighbours(corner: &Corner, place: &[u32], triangles: &[[u32; 3]]) -> [u32; 2] {
    let t = triangles[corner.face as usize];
    [1, 2].map(|k| place[t[(corner.number as usize + k) % 3] as usize])
}

/// Groups the faces around a vertex that hang together across edges without a crease; returns the
/// group of each corner as an index into `fan`.
fn smooth_groups(
    fan: &[Corner],
    neighbours: impl Fn(&Corner) -> [u32; 2],
    faces: &[Vector],
) -> Vec<usize> {
    if fan.len() > MAX_FAN {
        return vec![0; fan.len()];
    }
    let around: Vec<[u32; 2]> = fan.iter().map(neighbours).collect();
    let mut group: Vec<usize> = (0..fan.len()).collect();
    for i in 0..fan.len() {
        for j in 0..i {
            let shares_edge = around[i].iter().any(|v| around[j].contains(v));
            let (a, b) = (group[i], group[j]);
            if a != b && shares_edge && is_smooth(faces, fan[i], fan[j]) {
                group.iter_mut().filter(|g| **g == a).for_each(|g| *g = b);
            }
        }
    }
    group
}

fn is_smooth(faces: &[Vector], a: Corner, b: Corner) -> bool {
    let (m, n) = (&faces[a.face as usize], &faces[b.face as usize]);
    m.dot(n) >= CREASE_COS * m.norm() * n.norm()
}

fn area_vector(positions: &[Point], t: &[u32; 3]) -> Vector {
    let [a, b, c] = t.map(|v| positions[v as usize]);
    0.5 * (b - a).cross(&(c - a))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fold(degrees: f64) -> (Vec<Point>, Vec<[u32; 3]>) {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let positions = vec![
            Point::new(0.0, 0.0, 0.0),
            Point::new(0.0, 1.0, 0.0),
            Point::new(-1.0, 0.0, 0.0),
            Point::new(cos, 0.0, sin),
        ];
        (positions, vec![[0, 1, 2], [0, 3, 1]])
    }

    #[test]
    fn a_gentle_edge_is_smooth_and_a_sharp_one_is_not() {
        let (positions, triangles) = fold(30.0);
        let n = corner_normals(&positions, &triangles);
        assert!((n[0][0] - n[1][0]).norm() < 1e-12);
        let (positions, triangles) = fold(50.0);
        let n = corner_normals(&positions, &triangles);
        assert!((n[0][0].dot(&n[1][0]) - 50_f64.to_radians().cos()).abs() < 1e-12);
    }

    #[test]
    fn a_seam_of_doubled_vertices_is_smooth() {
        let (mut positions, _) = fold(30.0);
        positions.extend([positions[0], positions[1]]);
        let n = corner_normals(&positions, &[[0, 1, 2], [4, 3, 5]]);
        assert!((n[0][0] - n[1][0]).norm() < 1e-12);
    }
}
