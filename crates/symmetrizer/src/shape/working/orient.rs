//! One way round for all faces of a connected part.

use crate::geom::{Point, Vector};

/// A part keeps the way round that this share of its area has; below it, a closed part is turned so
/// that it is not inside out.
const CLEAR_MAJORITY: f64 = 0.75;

/// Turns faces until neighbours run the same way round: across an edge of two faces, these pass it
/// in opposite directions. Parts whose faces agree already stay as they are. Returns how many faces
/// were turned.
pub(super) fn orient(positions: &[Point], triangles: &mut [[u32; 3]]) -> usize {
    let neighbours = Neighbours::of(triangles);
    // For each face whether it is turned against the first face of its part.
    let mut against: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut turned = 0;
    let mut part = Vec::new();
    for first in 0..triangles.len() as u32 {
        if against[first as usize].is_some() {
            continue;
        }
        against[first as usize] = Some(false);
        part.clear();
        part.push(first);
        let mut next = 0;
        while let Some(&f) = part.get(next) {
            next += 1;
            for &(g, same) in neighbours.at(f) {
                if against[g as usize].is_none() {
                    against[g as usize] = against[f as usize].map(|a| a ^ same);
                    part.push(g);
                }
            }
        }
        let is_against = |f: &u32| against[*f as usize] == Some(true);
        if part.iter().any(is_against) {
            let turn_against = turns_against(positions, triangles, &part, is_against);
            for &f in &part {
                if is_against(&f) == turn_against {
                    triangles[f as usize].swap(1, 2);
                    turned += 1;
                }
            }
        }
    }
    turned
}

/// Whether, in a part whose faces disagree, those that are against the first are to be turned, and
/// not the others.
fn turns_against(
    positions: &[Point],
    triangles: &[[u32; 3]],
    part: &[u32],
    is_against: impl Fn(&u32) -> bool,
) -> bool {
    let origin = positions[triangles[part[0] as usize][0] as usize];
    let mut area = [0.0; 2];
    let mut volume = 0.0;
    let mut center = Vector::zeros();
    let corners = |f: &u32| triangles[*f as usize].map(|v| positions[v as usize] - origin);
    let doubled = |[a, b, c]: [Vector; 3]| (b - a).cross(&(c - a));
    for f in part {
        let x = corners(f);
        let size = doubled(x).norm();
        area[usize::from(is_against(f))] += size;
        center += (x[0] + x[1] + x[2]) * (size / 3.0);
    }
    let total = area[0] + area[1];
    if area[0].max(area[1]) >= CLEAR_MAJORITY * total {
        return area[0] >= area[1];
    }
    let center = center / total;
    for f in part {
        let x = corners(f);
        // Six times the signed volume under the face, seen from the part's middle.
        let under = doubled(x).dot(&(x[0] - center));
        volume += if is_against(f) { -under } else { under };
    }
    volume >= 0.0
}

/// The faces across each edge that exactly two faces share.
struct Neighbours {
    starts: Vec<u32>,
    across: Vec<(u32, bool)>,
}

impl Neighbours {
    fn of(triangles: &[[u32; 3]]) -> Self {
        let mut sides: Vec<(u32, u32, u32, bool)> = Vec::with_capacity(3 * triangles.len());
        for (f, &[a, b, c]) in (0..).zip(triangles) {
            for (u, v) in [(a, b), (b, c), (c, a)] {
                sides.push((u.min(v), u.max(v), f, u < v));
            }
        }
        sides.sort_unstable();
        let mut pairs = Vec::new();
        for edge in sides.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            if let [f, g] = edge {
                let same = f.3 == g.3;
                pairs.extend([(f.2, g.2, same), (g.2, f.2, same)]);
            }
        }
        pairs.sort_unstable();
        let mut starts = vec![0; triangles.len() + 1];
        for &(f, ..) in &pairs {
            starts[f as usize + 1] += 1;
        }
        for f in 0..triangles.len() {
            starts[f + 1] += starts[f];
        }
        Self {
            starts,
            across: pairs.into_iter().map(|(_, g, same)| (g, same)).collect(),
        }
    }

    /// The neighbours of a face, and whether they pass the common edge in the same direction.
    fn at(&self, f: u32) -> &[(u32, bool)] {
        let f = f as usize;
        &self.across[self.starts[f] as usize..self.starts[f + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron with all faces outwards.
    fn tetrahedron() -> (Vec<Point>, Vec<[u32; 3]>) {
        let positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
        let positions = positions.map(|p| Point::from(p.map(f64::from)));
        (
            positions.to_vec(),
            vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        )
    }

    fn volume(positions: &[Point], triangles: &[[u32; 3]]) -> f64 {
        let at = |v: u32| positions[v as usize].coords;
        let cone = |t: &[u32; 3]| at(t[0]).dot(&at(t[1]).cross(&at(t[2]))) / 6.0;
        triangles.iter().map(cone).sum()
    }

    #[test]
    fn half_turned_comes_out_outwards() {
        for turned in [[0, 1], [0, 3], [2, 3]] {
            let (positions, mut triangles) = tetrahedron();
            turned.iter().for_each(|&f: &usize| triangles[f].swap(0, 1));
            let moved = positions.iter().map(|p| p + Vector::new(9.0, -7.0, 100.0));
            let moved: Vec<Point> = moved.collect();
            assert_eq!(orient(&moved, &mut triangles), 2);
            assert!((volume(&positions, &triangles) - 1.0 / 6.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_cavity_stays_one() {
        let (positions, mut triangles) = tetrahedron();
        triangles.iter_mut().for_each(|t| t.swap(0, 1));
        let before = triangles.clone();
        assert_eq!(orient(&positions, &mut triangles), 0);
        assert_eq!(triangles, before);
        // The way round of three quarters of it counts, although it is inside out. The slanted face is
        // the largest: turn a small one.
        triangles[1].swap(0, 1);
        assert_eq!(orient(&positions, &mut triangles), 1);
        assert!(volume(&positions, &triangles) < 0.0);
    }

    #[test]
    fn three_faces_at_an_edge_bind_nobody() {
        let mut positions: Vec<Point> = tetrahedron().0;
        positions.push(Point::new(0.0, -1.0, 0.0));
        let mut triangles = vec![[0, 1, 2], [0, 1, 3], [0, 1, 4]];
        assert_eq!(orient(&positions, &mut triangles), 0);
    }
}
