//! The shape without a symmetry: whatever is found there is wrong.

use serde_json::{Value, json};

use super::trial::{Trial, Trials};
use super::truth::{Shape, Truth};
use super::verify::Verifier;
use crate::tables::{Section, Table, Verdict, number};

/// Detection on the shapes without symmetry; none where there are no such shapes.
pub fn section(shapes: &[Shape], trials: &Trials) -> Option<Section> {
    let mut table = Table::new(["shape", "seed", "find", "area %", "residual %", "moved %"]);
    let mut figures = Vec::new();
    let mut total = 0;
    let mut errors = 0;
    for shape in shapes.iter().filter(|s| matches!(s.truth, Truth::None)) {
        let verifier = Verifier::new(shape);
        for trial in trials.run(&shape.name, &shape.mesh, 0.0) {
            total += finds(&trial);
            errors += usize::from(trial.error.is_some());
            rows(&mut table, shape, &trial, &verifier);
            figures.push(record(shape, &trial));
        }
    }
    (!figures.is_empty()).then(|| Section {
        title: "control: no symmetry".into(),
        tables: vec![table],
        notes: vec![format!("errors {errors}")],
        verdicts: vec![Verdict::new("no finds", total.to_string(), total == 0)],
        figures: figures.into(),
    })
}

/// The number of finds of any kind.
fn finds(trial: &Trial) -> usize {
    let found = &trial.found;
    found.symmetries.len() + found.groups.len() + found.continuous.len()
}

fn rows(table: &mut Table, shape: &Shape, trial: &Trial, verifier: &Verifier<'_>) {
    let mut row = |find: String, figures: [Option<f64>; 3]| {
        let [area, residual, moved] = figures.map(|x| number(x.map(|x| 100.0 * x), 2));
        let seed = trial.seed.to_string();
        table.row([shape.name.clone(), seed, find, area, residual, moved]);
    };
    for s in &trial.found.symmetries {
        let check = verifier.check(s);
        let measured = [check.map(|c| c.residual), check.map(|c| c.moved)];
        row(
            s.kind.clone(),
            [Some(s.area_fraction), measured[0], measured[1]],
        );
    }
    for g in &trial.found.groups {
        row(format!("group {}", g.name), [None; 3]);
    }
    for c in &trial.found.continuous {
        row(c.kind.clone(), [None; 3]);
    }
}

fn record(shape: &Shape, trial: &Trial) -> Value {
    json!({
        "shape": shape.name,
        "seed": trial.seed,
        "error": trial.error,
        "finds": finds(trial),
        "kinds": trial.found.kinds(),
    })
}
