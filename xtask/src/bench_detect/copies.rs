//! Finds against true copies of one element: the best find for each pair, and what it covers.

use serde::Serialize;

use super::found::{Found, Symmetry};
use super::place::Motion;
use super::trial::Trial;
use super::truth::{RepeatPair, Repeats, Shape};

/// A pair is found when the element's vertices come to within this of where they belong, rms, % of D.
pub const FOUND: f64 = 1.0;

/// Kinds that turn left hands into right ones.
const IMPROPER: [&str; 4] = ["mirror", "glide", "rotoreflection", "inversion"];

/// Two copies and the find that fits them best.
#[derive(Serialize)]
pub struct PairOutcome {
    /// The first.
    pub a: i64,
    /// The second.
    pub b: i64,
    /// rms displacement of the first copy's vertices, % of D; none where nothing was found.
    pub error: Option<f64>,
    /// Whether the find's kind is that of the truth.
    pub kind_right: bool,
    /// Intersection over union of the patch with copy a, of the image with copy b.
    pub overlap: [f64; 2],
}

/// What was found with one seed.
#[derive(Serialize)]
pub struct Outcome {
    /// The seed.
    pub seed: u64,
    /// Why detection failed.
    pub error: Option<String>,
    /// Finds of any kind.
    pub finds: usize,
    /// All pairs.
    pub pairs: Vec<PairOutcome>,
    /// For each element the worst overlap in the pairs found; none where it is in none.
    pub by_pairs: Vec<Option<f64>>,
    /// For each element the best overlap with a copy of a group's orbit.
    pub by_orbits: Vec<Option<f64>>,
}

/// What was found in `shape` in a trial.
pub fn outcome(shape: &Shape, truth: &Repeats, trial: &Trial) -> Outcome {
    let pairs: Vec<PairOutcome> = truth
        .pairs
        .iter()
        .map(|pair| best(shape, truth, pair, &trial.found))
        .collect();
    let count = truth.face_element.iter().max().map_or(0, |m| m + 1);
    Outcome {
        seed: trial.seed,
        error: trial.error.clone(),
        finds: trial.found.symmetries.len(),
        by_pairs: (0..count).map(|e| in_pairs(&pairs, e)).collect(),
        by_orbits: (0..count)
            .map(|e| in_orbits(truth, &trial.found, e))
            .collect(),
        pairs,
    }
}

/// The find that carries copy a best onto copy b, or back.
fn best(shape: &Shape, truth: &Repeats, pair: &RepeatPair, found: &Found) -> PairOutcome {
    let ways = found
        .symmetries
        .iter()
        .map(|s| (s, way(shape, truth, pair, s)));
    let nearest = ways.min_by(|(_, x), (_, y)| x.0.total_cmp(&y.0));
    PairOutcome {
        a: pair.a,
        b: pair.b,
        error: nearest.map(|(_, (error, _))| error),
        kind_right: nearest.is_some_and(|(s, _)| is_improper(s) == Some(pair.improper)),
        overlap: nearest.map_or([0.0; 2], |(_, (_, overlap))| overlap),
    }
}

/// Error and overlaps of a find, or of its way back where that fits better. A mirror and a half turn
/// are their own way back: where both ways fit, it is the one whose faces do.
fn way(shape: &Shape, truth: &Repeats, pair: &RepeatPair, find: &Symmetry) -> (f64, [f64; 2]) {
    let (patch, image) = (&find.patch_faces, &find.image_faces);
    let covered = |from, to| [overlap(truth, from, pair.a), overlap(truth, to, pair.b)];
    let ways = [
        (find.motion, covered(patch, image)),
        (find.motion.inverse(), covered(image, patch)),
    ];
    let [there, back] = ways.map(|(motion, faces)| (gap(shape, truth, pair, &motion), faces));
    let sum = |(_, [a, b]): (f64, [f64; 2])| a + b;
    let back_is_better = if there.0.max(back.0) <= FOUND {
        sum(back) > sum(there)
    } else {
        back.0 < there.0
    };
    if back_is_better { back } else { there }
}

/// Whether the find is a mirror image, by its kind and by its matrix; none where they disagree.
fn is_improper(symmetry: &Symmetry) -> Option<bool> {
    let named = IMPROPER.contains(&symmetry.kind.as_str());
    (named == symmetry.motion.is_improper()).then_some(named)
}

/// rms distance between where `motion` takes the vertices of copy a and where they belong, % of D.
fn gap(shape: &Shape, truth: &Repeats, pair: &RepeatPair, motion: &Motion) -> f64 {
    let vertices = shape.mesh.positions.iter().zip(&truth.vertex_element);
    let gaps = vertices
        .filter(|&(_, &element)| element == pair.a)
        .map(|(x, _)| (motion.apply(x) - pair.motion.apply(x)).norm_squared());
    let (sum, n) = gaps.fold((0.0, 0), |(sum, n), gap| (sum + gap, n + 1));
    100.0 * (sum / f64::from(n.max(1))).sqrt() / shape.diagonal
}

/// Intersection over union of `faces` with those of an element, by number.
fn overlap(truth: &Repeats, faces: &[u32], element: i64) -> f64 {
    let mut listed = vec![false; truth.face_element.len()];
    for &f in faces {
        if let Some(slot) = listed.get_mut(f as usize) {
            *slot = true;
        }
    }
    let both = listed.iter().zip(&truth.face_element);
    let (mut common, mut any) = (0_u32, 0_u32);
    for (&listed, &of) in both {
        common += u32::from(listed && of == element);
        any += u32::from(listed || of == element);
    }
    f64::from(common) / f64::from(any.max(1))
}

impl PairOutcome {
    /// Whether the find comes near enough.
    pub fn is_found(&self) -> bool {
        self.error.is_some_and(|e| e <= FOUND)
    }
}

fn in_pairs(pairs: &[PairOutcome], element: i64) -> Option<f64> {
    let found = pairs.iter().filter(|p| p.is_found());
    let sides = found.flat_map(|p| [(p.a, p.overlap[0]), (p.b, p.overlap[1])]);
    let mine = sides.filter(|(e, _)| *e == element).map(|(_, iou)| iou);
    mine.min_by(f64::total_cmp)
}

fn in_orbits(truth: &Repeats, found: &Found, element: i64) -> Option<f64> {
    let copies = found.groups.iter().flat_map(|g| &g.orbit);
    let overlaps = copies.map(|faces| overlap(truth, faces, element));
    overlaps.max_by(f64::total_cmp)
}

impl Outcome {
    /// The number of pairs found.
    pub fn found(&self) -> usize {
        self.pairs.iter().filter(|p| p.is_found()).count()
    }

    /// The overlap of the element that is covered worst, by pairs or by orbits, whichever is better
    /// for it.
    pub fn least_overlap(&self) -> f64 {
        let each = self.by_pairs.iter().zip(&self.by_orbits);
        let better = each.map(|(a, b)| a.unwrap_or(0.0).max(b.unwrap_or(0.0)));
        better.min_by(f64::total_cmp).unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use symmetrizer::Mesh;
    use symmetrizer::geom::{Matrix3, Point, Vector};

    use super::super::found::Group;
    use super::super::truth::Truth;
    use super::*;

    /// Two tetrahedra, the second a mirror image of the first in x = 2.
    fn twins() -> (Shape, Motion) {
        let motion = Motion {
            linear: Matrix3::from_diagonal(&Vector::new(-1.0, 1.0, 1.0)),
            translation: Vector::new(4.0, 0.0, 0.0),
        };
        let corners = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 0.7, 0.0],
            [0.0, 0.0, 0.4],
        ];
        let mut positions: Vec<Point> = corners.map(Point::from).into();
        positions.extend(corners.map(|x| motion.apply(&Point::from(x))));
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let both = faces.into_iter().chain(faces.map(|f| f.map(|v| v + 4)));
        let mesh = Mesh::from_triangles(positions, both.collect());
        let truth = Repeats {
            pairs: vec![RepeatPair {
                a: 0,
                b: 1,
                motion,
                improper: true,
            }],
            face_element: vec![0, 0, 0, 0, 1, 1, 1, 1],
            vertex_element: vec![0, 0, 0, 0, 1, 1, 1, 1],
        };
        let shape = Shape {
            name: "twins".into(),
            diagonal: mesh.diagonal(),
            mesh,
            truth: Truth::Repeats(truth),
        };
        (shape, motion)
    }

    /// A find from the second to the first, one face short, and the group that has all.
    #[test]
    fn a_find_counts_either_way_round() {
        let (shape, motion) = twins();
        let Truth::Repeats(truth) = &shape.truth else {
            unreachable!();
        };
        let mirror = |kind: &str, motion: Motion| Symmetry {
            kind: kind.into(),
            motion: motion.inverse(),
            plane: None,
            axis: None,
            order: None,
            rms: 0.0,
            area_fraction: 1.0,
            patch_faces: vec![4, 5, 6],
            image_faces: vec![0, 1, 2, 3],
        };
        let trial = |kind: &str, motion: Motion| Trial {
            seed: 0,
            found: Found {
                symmetries: vec![mirror(kind, motion)],
                groups: vec![Group {
                    name: "pair".into(),
                    axis: None,
                    step: None,
                    orbit: vec![vec![4, 5, 6, 7], vec![0, 1]],
                }],
                continuous: Vec::new(),
            },
            error: None,
        };
        let right = outcome(&shape, truth, &trial("mirror", motion));
        assert_eq!(right.found(), 1);
        assert!(right.pairs[0].kind_right && right.pairs[0].error.unwrap() < 1e-12);
        assert_eq!(right.by_pairs, [Some(1.0), Some(0.75)]);
        assert_eq!(right.by_orbits, [Some(0.5), Some(1.0)]);
        assert_eq!(right.least_overlap(), 1.0);
        assert!(!outcome(&shape, truth, &trial("rotation", motion)).pairs[0].kind_right);
        // Two percent of D beside the truth is too far.
        let mut beside = motion;
        beside.translation.y += 0.02 * shape.diagonal;
        let wrong = outcome(&shape, truth, &trial("mirror", beside));
        assert_eq!(wrong.found(), 0);
        assert!((wrong.pairs[0].error.unwrap() - 2.0).abs() < 1e-9);
        assert_eq!(wrong.by_pairs, [None, None]);
    }

    #[test]
    fn overlaps_of_faces() {
        let truth = Repeats {
            pairs: Vec::new(),
            face_element: vec![-1, 0, 0, 0, 1],
            vertex_element: Vec::new(),
        };
        assert_eq!(overlap(&truth, &[1, 2, 3], 0), 1.0);
        assert_eq!(overlap(&truth, &[0, 1, 2], 0), 0.5);
        assert_eq!(overlap(&truth, &[2, 2, 99], 1), 0.0);
    }
}
