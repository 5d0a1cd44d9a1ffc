//! Faces that are there more than once.

use rayon::prelude::*;

use super::faces::Faces;
use super::kind::Kind;

/// The corners of faces, each list turned to a form that does not depend on where the face begins
/// nor on its sense.
#[derive(Default)]
struct Loops {
    faces: Vec<u32>,
    starts: Vec<usize>,
    corners: Vec<u32>,
    /// Whether the list runs against the sense of its face.
    reversed: Vec<bool>,
}

/// The faces whose corners, in places, are those of an earlier face: [`Kind::Duplicate`] in the
/// sense of the first of them, [`Kind::FlippedDuplicate`] in the other.
pub(super) fn find(faces: &Faces<'_>) -> Vec<(u32, Kind)> {
    let loops = Loops::of(faces);
    let mut order: Vec<u32> = (0..loops.faces.len() as u32).collect();
    order.par_sort_unstable_by(|a, b| loops.get(*a).cmp(loops.get(*b)).then(a.cmp(b)));
    let mut found = Vec::new();
    for same in order.chunk_by(|a, b| loops.get(*a) == loops.get(*b)) {
        let sense = loops.reversed[same[0] as usize];
        for &again in &same[1..] {
            let flipped = loops.reversed[again as usize] != sense;
            let kind = if flipped {
                Kind::FlippedDuplicate
            } else {
                Kind::Duplicate
            };
            found.push((loops.faces[again as usize], kind));
        }
    }
    found
}

impl Loops {
    /// The loops of all faces with which nothing is wrong so far; no corner of these is repeated.
    fn of(faces: &Faces<'_>) -> Self {
        let mut loops = Self::default();
        let mut places = Vec::new();
        for (f, polygon) in faces.mesh.polygons.iter().enumerate() {
            if faces.is_sound(f) {
                places.clear();
                places.extend(polygon.iter().map(|&v| faces.places[v as usize]));
                loops.push(f as u32, &places);
            }
        }
        loops.starts.push(loops.corners.len());
        loops
    }

    /// Appends a loop: the smallest corner first, then its smaller neighbour.
    fn push(&mut self, face: u32, places: &[u32]) {
        let n = places.len();
        let least = (0..n).min_by_key(|&k| places[k]).unwrap_or(0);
        let reversed = places[(least + n - 1) % n] < places[(least + 1) % n];
        self.faces.push(face);
        self.starts.push(self.corners.len());
        self.reversed.push(reversed);
        self.corners.extend((0..n).map(|k| {
            let step = if reversed { n - k } else { k };
            places[(least + step) % n]
        }));
    }

    fn get(&self, i: u32) -> &[u32] {
        &self.corners[self.starts[i as usize]..self.starts[i as usize + 1]]
    }
}
