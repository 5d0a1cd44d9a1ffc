//! Which triangles of the document the stages run on.

use crate::shape::mesh::Mesh;

/// What was put right in the working surface. The document keeps all of it as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Mended {
    /// Triangles left out because a corner has no finite position.
    pub unplaced: usize,
    /// Triangles left out because two of their corners are in one place.
    pub degenerate: usize,
    /// Triangles left out because an earlier one has the same corners.
    pub duplicate: usize,
    /// Triangles turned to run the same way round as their neighbours.
    pub turned: usize,
}

/// A triangle over welded vertices, its polygon, and its index among the document's triangles.
pub(super) struct Face {
    pub corners: [u32; 3],
    pub polygon: u32,
    pub index: u32,
}

/// The triangles of `mesh` with three corners in three places, each once.
pub(super) fn usable(mesh: &Mesh, welded: &[Option<u32>], mended: &mut Mended) -> Vec<Face> {
    let mut faces = Vec::new();
    for (index, (corners, polygon)) in mesh.triangles().enumerate() {
        let [Some(a), Some(b), Some(c)] = corners.map(|v| welded[v as usize]) else {
            mended.unplaced += 1;
            continue;
        };
        if a == b || b == c || c == a {
            mended.degenerate += 1;
            continue;
        }
        faces.push(Face {
            corners: [a, b, c],
            polygon,
            index: index as u32,
        });
    }
    let all = faces.len();
    drop_duplicates(&mut faces);
    mended.duplicate = all - faces.len();
    faces
}

/// Keeps the first of the faces with the same corners, whichever way round.
fn drop_duplicates(faces: &mut Vec<Face>) {
    let key = |f: &Face| {
        let mut corners = f.corners;
        corners.sort_unstable();
        corners
    };
    let mut order: Vec<([u32; 3], u32)> =
        (0..).zip(faces.iter()).map(|(i, f)| (key(f), i)).collect();
    order.sort_unstable();
    let mut keep = vec![true; faces.len()];
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        same[1..]
            .iter()
            .for_each(|(_, i)| keep[*i as usize] = false);
    }
    let mut keep = keep.into_iter();
    faces.retain(|_| keep.next().unwrap_or(true));
}
