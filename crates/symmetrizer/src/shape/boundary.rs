//! Where a surface ends.

use crate::shape::surface::{Surface, SurfacePoint};

/// Weights below this are rounding.
const NONE: f64 = 1e-9;

/// The sides of triangles that no other triangle shares.
pub struct Boundary {
    /// For each face whether its side opposite each corner is one.
    sides: Vec<[bool; 3]>,
    /// Whether each vertex lies on one.
    vertices: Vec<bool>,
}

impl Boundary {
    /// Of a surface.
    pub fn of(surface: &Surface) -> Self {
        let all = surface.sides();
        let single = |[u, v]: [u32; 2]| {
            let side = [u.min(v), u.max(v)];
            let first = all.partition_point(|s| *s < side);
            all.get(first + 1) != Some(&side)
        };
        let mut vertices = vec![false; surface.positions.len()];
        let mut mark = |ends: [u32; 2]| {
            let found = single(ends);
            ends.iter().for_each(|&v| vertices[v as usize] |= found);
            found
        };
        let triangles = surface.triangles.iter();
        let sides = triangles.map(|&[a, b, c]| [mark([b, c]), mark([c, a]), mark([a, b])]);
        Self {
            sides: sides.collect(),
            vertices,
        }
    }

    /// Whether a point of the `surface` lies on it.
    pub fn holds(&self, surface: &Surface, at: &SurfacePoint) -> bool {
        let corners = surface.triangles[at.face as usize];
        let sides = self.sides[at.face as usize];
        let off: Vec<usize> = (0..3).filter(|&k| at.bary[k] < NONE).collect();
        match off[..] {
            [k] => sides[k],
            [_, _] => (0..3).any(|k| at.bary[k] >= NONE && self.vertices[corners[k] as usize]),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    #[test]
    fn a_square_ends_at_its_sides_and_not_at_its_diagonal() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let positions = corners.map(|[x, y]| Point::new(x, y, 0.0)).to_vec();
        let square = Surface::new(positions, vec![[0, 1, 2], [0, 2, 3]].into());
        let boundary = Boundary::of(&square);
        let holds = |face, bary| boundary.holds(&square, &SurfacePoint { face, bary });
        assert!(holds(0, [0.5, 0.5, 0.0]), "the side from 0 to 1");
        assert!(!holds(0, [0.5, 0.0, 0.5]), "the diagonal");
        assert!(holds(0, [0.0, 1.0, 0.0]), "a corner");
        assert!(!holds(0, [0.4, 0.3, 0.3]), "the inside");
    }
}
