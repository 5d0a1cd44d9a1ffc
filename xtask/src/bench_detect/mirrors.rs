//! Mirrors: how near the true ones are found, and what else is.

use serde::Serialize;
use serde_json::json;

use super::compare::{Find, LOOSE, Nearest, RIGID, Standing, count, find, nearest};
use super::trial::{Trial, Trials};
use super::truth::{Cluster, Shape, Truth};
use super::verify::Verifier;
use crate::tables::{Section, Table, Verdict, median, number, of, percent};

/// What was found with one seed.
#[derive(Debug, Serialize)]
struct Outcome {
    seed: u64,
    error: Option<String>,
    /// For each rigid mirror.
    rigid: Vec<Nearest>,
    /// For each of the others.
    loose: Vec<Nearest>,
    finds: Vec<Find>,
}

/// A shape and its outcomes.
#[derive(Serialize)]
struct Tried {
    shape: String,
    noise_in_file: f64,
    outcomes: Vec<Outcome>,
}

/// Detection on the shapes with known mirrors, with `noise` (fraction of D) added; none where there
/// are no such shapes.
pub fn section(shapes: &[Shape], trials: &Trials, noise: f64) -> Option<Section> {
    let [mut rigid_table, mut loose_table, mut false_table] =
        [rigid_head(), loose_head(), false_head()];
    let mut tried = Vec::new();
    for shape in shapes {
        let Truth::Mirrors {
            clusters,
            noise: in_file,
        } = &shape.truth
        else {
            continue;
        };
        let (rigid, loose): (Vec<Cluster>, _) = clusters.iter().partition(|c| c.is_rigid());
        // Finds are verified on the shape without the noise that was added.
        let verifier = Verifier::new(shape);
        let outcomes = trials.run(&shape.name, &shape.mesh, noise);
        let outcomes: Vec<Outcome> = outcomes
            .iter()
            .map(|trial| outcome(trial, shape, [&rigid, &loose], &verifier))
            .collect();
        let one = Tried {
            shape: shape.name.clone(),
            noise_in_file: *in_file,
            outcomes,
        };
        rigid_row(&mut rigid_table, &one);
        loose_rows(&mut loose_table, &one, &loose);
        false_rows(&mut false_table, &one);
        tried.push(one);
    }
    if tried.is_empty() {
        return None;
    }
    let (title, tables, verdicts) = if noise > 0.0 {
        let title = format!("mirrors, {} % noise added", 100.0 * noise);
        let tables = vec![rigid_table, false_table];
        (title, tables, noisy_verdicts(&tried))
    } else {
        let tables = vec![rigid_table, loose_table, false_table];
        ("mirrors".to_owned(), tables, verdicts(&tried))
    };
    Some(Section {
        title,
        tables,
        notes: vec![summary(&tried)],
        verdicts,
        figures: json!({ "noise_added": noise, "shapes": tried }),
    })
}

fn outcome(
    trial: &Trial,
    shape: &Shape,
    [rigid, loose]: [&[Cluster]; 2],
    verifier: &Verifier<'_>,
) -> Outcome {
    let d = shape.diagonal;
    let all = |truth: &[Cluster], limits| -> Vec<Nearest> {
        let each = truth.iter().map(|c| nearest(&trial.found, c, d, limits));
        each.collect()
    };
    let finds = trial.found.symmetries.iter();
    Outcome {
        seed: trial.seed,
        error: trial.error.clone(),
        rigid: all(rigid, RIGID),
        loose: all(loose, LOOSE),
        finds: finds
            .map(|s| find(s, d, [rigid, loose], verifier))
            .collect(),
    }
}

impl Tried {
    fn rigid(&self) -> impl Iterator<Item = &Nearest> {
        self.outcomes.iter().flat_map(|o| &o.rigid)
    }

    fn finds(&self) -> impl Iterator<Item = &Find> {
        self.outcomes.iter().flat_map(|o| &o.finds)
    }
}

fn rigid_head() -> Table {
    Table::new([
        "shape", "planes", "recalled", "angle", "offset %", "finds", "true", "verified", "false",
    ])
}

fn rigid_row(table: &mut Table, tried: &Tried) {
    let planes = tried.rigid().count();
    table.row([
        tried.shape.clone(),
        (planes / tried.outcomes.len().max(1)).to_string(),
        of(tried.rigid().filter(|n| n.recalled).count(), planes),
        number(median(tried.rigid().map(|n| n.angle)), 3),
        number(median(tried.rigid().map(|n| n.offset)), 3),
        tried.finds().count().to_string(),
        count(tried.finds(), Standing::True).to_string(),
        count(tried.finds(), Standing::Verified).to_string(),
        count(tried.finds(), Standing::False).to_string(),
    ]);
}

fn loose_head() -> Table {
    Table::new([
        "not scored: bending or small parts",
        "vertices",
        "rms %",
        "found",
        "angle",
        "offset %",
    ])
}

fn loose_rows(table: &mut Table, tried: &Tried, clusters: &[Cluster]) {
    for (k, cluster) in clusters.iter().enumerate() {
        let of_cluster = || tried.outcomes.iter().filter_map(|o| o.loose.get(k));
        table.row([
            tried.shape.clone(),
            number(Some(cluster.fraction), 2),
            number(Some(100.0 * cluster.rms), 2),
            of(
                of_cluster().filter(|n| n.recalled).count(),
                tried.outcomes.len(),
            ),
            number(median(of_cluster().map(|n| n.angle)), 2),
            number(median(of_cluster().map(|n| n.offset)), 2),
        ]);
    }
}

fn false_head() -> Table {
    Table::new([
        "neither true nor verified",
        "seed",
        "kind",
        "area %",
        "residual %",
    ])
}

fn false_rows(table: &mut Table, tried: &Tried) {
    for outcome in &tried.outcomes {
        let wrong = outcome
            .finds
            .iter()
            .filter(|f| f.standing == Standing::False);
        for find in wrong {
            table.row([
                tried.shape.clone(),
                outcome.seed.to_string(),
                find.kind.clone(),
                number(Some(100.0 * find.area_fraction), 1),
                number(find.residual.map(|r| 100.0 * r), 2),
            ]);
        }
    }
}

/// Recall in percent at the rigid mirrors.
fn recall(tried: &[Tried]) -> Option<f64> {
    let all = || tried.iter().flat_map(Tried::rigid);
    percent(all().filter(|n| n.recalled).count(), all().count())
}

fn summary(tried: &[Tried]) -> String {
    let finds = || tried.iter().flat_map(Tried::finds);
    let [is_true, verified, wrong] =
        [Standing::True, Standing::Verified, Standing::False].map(|s| count(finds(), s));
    let errors = tried.iter().flat_map(|t| &t.outcomes);
    let errors = errors.filter(|o| o.error.is_some()).count();
    format!(
        "finds {}: true {is_true}, verified extras {verified}, neither {wrong}; errors {errors}",
        finds().count()
    )
}

fn verdicts(tried: &[Tried]) -> Vec<Verdict> {
    let with = |noisy: bool| {
        let fits = move |t: &&Tried| (t.noise_in_file > 0.0) == noisy;
        tried.iter().filter(fits).flat_map(Tried::rigid)
    };
    let finds = || tried.iter().flat_map(Tried::finds);
    let good = finds().filter(|f| f.standing != Standing::False).count();
    let mut verdicts = Vec::new();
    if with(false).next().is_some() {
        let (angle, offset) = (
            median(with(false).map(|n| n.angle)),
            median(with(false).map(|n| n.offset)),
        );
        verdicts.push(Verdict::at_most("median angle", angle, 0.2, " degrees"));
        verdicts.push(Verdict::at_most("median offset", offset, 0.1, " % of D"));
    }
    if with(true).next().is_some() {
        let angle = median(with(true).map(|n| n.angle));
        verdicts.push(Verdict::at_most(
            "median angle, 0.2 % noise in the file",
            angle,
            0.5,
            " degrees",
        ));
    }
    if let Some(recall) = recall(tried) {
        verdicts.push(Verdict::at_least("recall", Some(recall), 95.0, " %"));
    }
    let precision = percent(good, finds().count());
    verdicts.push(Verdict::at_least("precision", precision, 95.0, " %"));
    verdicts
}

fn noisy_verdicts(tried: &[Tried]) -> Vec<Verdict> {
    let recall = recall(tried).into_iter();
    recall
        .map(|r| Verdict::at_least("recall", Some(r), 80.0, " %"))
        .collect()
}
