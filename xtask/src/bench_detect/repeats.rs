//! Copies of one element: for each pair of copies, is what carries one onto the other found, and how
//! much of the copies is covered.

use serde::Serialize;

use super::copies::{FOUND, Outcome, outcome};
use super::trial::Trials;
use super::truth::{Shape, Truth};
use crate::tables::{Section, Table, Verdict, number, of, worst};

/// Intersection over union of faces that is wanted.
const OVERLAP: f64 = 0.8;

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
