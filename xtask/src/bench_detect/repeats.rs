//! Copies of one element: for each pair of copies, is what carries one onto the other found, and how
//! much of the copies is covered.

use serde::Serialize;

use super::found::{Found, Symmetry};
use super::place::Motion;
use super::tables::{Section, Table, Verdict, number, of, worst};
use super::trial::{Trial, Trials};
use super::truth::{RepeatPair, Repeats, Shape, Truth};

/// A pair is found when the element's vertices come to within this of where they belong, rms, % of D.
const FOUND: f64 = 1.0;

/// Intersection over union of faces that is wanted.
const OVERLAP: f64 = 0.8;

/// Kinds that turn left hands into right ones.
const IMPROPER: [&str; 4] = ["mirror", "glide", "rotoreflection", "inversion"];

/// Two copies and the find that fits them best.
#[derive(Serialize)]
struct PairOutcome {
    a: i64,
    b: i64,
    /// rms displacement of the first copy's vertices, % of D; none where nothing was found.
    error: Option<f64>,
    /// Whether the find's kind is that of the truth.
    kind_right: bool,
    /// Intersection over union of the patch with copy a, of the image with copy b.
    overlap: [f64; 2],
}

/// What was found with one seed.
#[derive(Serialize)]
struct Outcome {
    seed: u64,
    error: Option<String>,
    /// Finds of any kind.
    finds: usize,
    pairs: Vec<PairOutcome>,
    /// For each element the worst overlap in the pairs found; none where it is in none.
    by_pairs: Vec<Option<f64>>,
    /// For each element the best overlap with a copy of a group's orbit.
    by_orbits: Vec<Option<f64>>,
}

/// A shape and its outcomes.
#[derive(Serialize)]
struct Tried {
    shape: String,
    outcomes: Vec<Outcome>,
}

/// Detection on the shapes with copies; none where there are no such shapes.
pub fn section(shapes: &[Shape], trials: &Trials) -> Option<Section> {
    let mut table = Table::new([
        "shape",
        "seed",
        "finds",
        "pairs",
        "worst error %",
        "right kind",
        "IoU of pairs, by element",
        "IoU of orbits, by element",
    ]);
    let mut all: Vec<Tried> = Vec::new();
    for shape in shapes {
        let Truth::Repeats(truth) = &shape.truth else {
            continue;
        };
        let outcomes: Vec<Outcome> = trials
            .run(&shape.name, &shape.mesh, 0.0)
            .iter()
            .map(|trial| outcome(shape, truth, trial))
            .collect();
        for outcome in &outcomes {
            row(&mut table, &shape.name, outcome);
        }
        all.push(Tried {
            shape: shape.name.clone(),
            outcomes,
        });
    }
    (!all.is_empty()).then(|| Section {
        title: "copies of one element".into(),
        tables: vec![table],
        notes: Vec::new(),
        verdicts: all.iter().flat_map(verdicts).collect(),
        figures: serde_json::to_value(&all).unwrap_or_default(),
    })
}

fn outcome(shape: &Shape, truth: &Repeats, trial: &Trial) -> Outcome {
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

/// The find, or its way back, that carries copy a best onto copy b.
fn best(shape: &Shape, truth: &Repeats, pair: &RepeatPair, found: &Found) -> PairOutcome {
    let ways = found.symmetries.iter().flat_map(|s| {
        let there = (s, s.motion, [&s.patch_faces, &s.image_faces]);
        let back = (s, s.motion.inverse(), [&s.image_faces, &s.patch_faces]);
        [there, back]
    });
    let errors = ways.map(|(s, motion, faces)| (gap(shape, truth, pair, &motion), s, faces));
    let Some((error, symmetry, [patch, image])) = errors.min_by(|x, y| x.0.total_cmp(&y.0)) else {
        return PairOutcome {
            a: pair.a,
            b: pair.b,
            error: None,
            kind_right: false,
            overlap: [0.0; 2],
        };
    };
    PairOutcome {
        a: pair.a,
        b: pair.b,
        error: Some(error),
        kind_right: is_improper(symmetry) == Some(pair.improper),
        overlap: [overlap(truth, patch, pair.a), overlap(truth, image, pair.b)],
    }
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
    fn is_found(&self) -> bool {
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
    fn found(&self) -> usize {
        self.pairs.iter().filter(|p| p.is_found()).count()
    }

    /// The element that is covered worst, by pairs or by orbits, whichever is better for it.
    fn least_overlap(&self) -> f64 {
        let each = self.by_pairs.iter().zip(&self.by_orbits);
        let better = each.map(|(a, b)| a.unwrap_or(0.0).max(b.unwrap_or(0.0)));
        better.min_by(f64::total_cmp).unwrap_or(0.0)
    }
}

fn row(table: &mut Table, shape: &str, outcome: &Outcome) {
    let pairs = &outcome.pairs;
    let right = pairs.iter().filter(|p| p.is_found() && p.kind_right);
    let list = |values: &[Option<f64>]| {
        let words: Vec<String> = values.iter().map(|v| number(*v, 2)).collect();
        words.join(" ")
    };
    table.row([
        shape.to_owned(),
        outcome.seed.to_string(),
        outcome.finds.to_string(),
        of(outcome.found(), pairs.len()),
        number(worst(pairs.iter().map(|p| p.error)), 2),
        of(right.count(), outcome.found()),
        list(&outcome.by_pairs),
        list(&outcome.by_orbits),
    ]);
}

fn verdicts(tried: &Tried) -> [Verdict; 2] {
    let outcomes = &tried.outcomes;
    let whole = |o: &&Outcome| {
        let right = o.pairs.iter().all(|p| p.is_found() && p.kind_right);
        right && !o.pairs.is_empty()
    };
    let least = outcomes
        .iter()
        .map(Outcome::least_overlap)
        .min_by(f64::total_cmp);
    let found: usize = outcomes.iter().map(Outcome::found).sum();
    let pairs: usize = outcomes.iter().map(|o| o.pairs.len()).sum();
    let all = outcomes.iter().filter(whole).count() == outcomes.len();
    let name = &tried.shape;
    [
        Verdict::new(
            format!("{name}: all pairs within {FOUND} % of D, of the right kind"),
            of(found, pairs),
            all,
        ),
        Verdict::at_least(&format!("{name}: least IoU"), least, OVERLAP, ""),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

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
