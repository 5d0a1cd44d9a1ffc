//! Shapes that are symmetric in more than one mirror: an axis, a row, three planes, a turned vase.

use serde::Serialize;
use symmetrizer::geom::Vector;

use super::compare::{self, AxisError, Find, Nearest, RIGID, Standing, best_axis};
use super::found::Found;
use super::place::Axis;
use super::trial::{Trial, Trials};
use super::truth::{Cluster, Shape, Truth};
use super::verify::Verifier;
use crate::tables::{Section, Table, Verdict, number, of, worst};

/// The group of three planes at right angles.
const THREE_PLANES: &str = "D2h";

/// What was found with one seed.
#[derive(Serialize)]
struct Outcome {
    seed: u64,
    error: Option<String>,
    /// All that was found, by kind.
    kinds: String,
    /// Mirrors, true ones or not.
    mirrors: usize,
    #[serde(flatten)]
    answer: Answer,
}

/// What is asked of each kind of shape.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum Answer {
    /// The axis of the right order, if there is one.
    Axis(Option<AxisError>),
    /// Rows of the right number, and the best one's error in its step, % of D.
    Row { rows: usize, step: Option<f64> },
    /// The planes, whether the group is named, what else was found.
    Planes {
        planes: Vec<Nearest>,
        group: bool,
        finds: Vec<Find>,
    },
    /// The number of continuous symmetries, and the error of the best axis of revolution.
    Revolution {
        continuous: usize,
        axis: Option<AxisError>,
    },
}

/// A shape and its outcomes.
#[derive(Serialize)]
struct Tried {
    shape: String,
    outcomes: Vec<Outcome>,
}

/// Detection on the shapes with axes, rows, several planes and continuous symmetries; none where
/// there are no such shapes.
pub fn section(shapes: &[Shape], trials: &Trials) -> Option<Section> {
    let mut table = Table::new([
        "shape",
        "seed",
        "wanted",
        "angle",
        "offset %",
        "mirrors",
        "all finds",
    ]);
    let mut verdicts = Vec::new();
    let mut all = Vec::new();
    for shape in shapes.iter().filter(|s| is_asked(&s.truth)) {
        let verifier = Verifier::new(shape);
        let outcomes: Vec<Outcome> = trials
            .run(&shape.name, &shape.mesh, 0.0)
            .iter()
            .filter_map(|trial| outcome(shape, trial, &verifier))
            .collect();
        for outcome in &outcomes {
            row(&mut table, shape, outcome);
        }
        verdicts.extend(verdicts_on(shape, &outcomes));
        all.push(Tried {
            shape: shape.name.clone(),
            outcomes,
        });
    }
    (!all.is_empty()).then(|| Section {
        title: "axes, rows, groups, continuous symmetries".into(),
        tables: vec![table],
        notes: Vec::new(),
        verdicts,
        figures: serde_json::to_value(&all).unwrap_or_default(),
    })
}

fn is_asked(truth: &Truth) -> bool {
    matches!(
        truth,
        Truth::Rotation { .. } | Truth::Row { .. } | Truth::Planes(_) | Truth::Revolution(_)
    )
}

fn outcome(shape: &Shape, trial: &Trial, verifier: &Verifier<'_>) -> Option<Outcome> {
    let (found, d) = (&trial.found, shape.diagonal);
    let answer = match &shape.truth {
        Truth::Rotation { axis, order } => Answer::Axis(rotation(found, axis, *order, d)),
        Truth::Row { step, count } => row_of(found, step, *count, d),
        Truth::Planes(planes) => planes_of(found, planes, d, verifier),
        Truth::Revolution(axis) => revolution(found, axis, d),
        _ => return None,
    };
    Some(Outcome {
        seed: trial.seed,
        error: trial.error.clone(),
        kinds: found.kinds(),
        mirrors: found.planes().count(),
        answer,
    })
}

/// The best axis of the order wanted, of a group or of a single rotation.
fn rotation(found: &Found, truth: &Axis, order: u32, d: f64) -> Option<AxisError> {
    let groups = found
        .groups
        .iter()
        .filter(|g| cyclic_order(&g.name) == Some(order));
    let single = found.symmetries.iter();
    let single = single.filter(|s| s.kind == "rotation" && s.order == Some(order));
    let axes = groups
        .filter_map(|g| g.axis)
        .chain(single.filter_map(|s| s.axis));
    best_axis(axes, truth, d)
}

/// The order of a group `C5`, `C5v`, `C5h`.
fn cyclic_order(name: &str) -> Option<u32> {
    let rest = name.strip_prefix('C')?;
    rest.trim_end_matches(['v', 'h']).parse().ok()
}

/// The rows of `count`, and how near the best one's step comes, either way round.
fn row_of(found: &Found, truth: &Vector, count: u32, d: f64) -> Answer {
    let name = format!("row {count}");
    let rows = || found.groups.iter().filter(|g| g.name == name);
    let steps = rows().filter_map(|g| g.step);
    let gap = |step: Vector| (step - truth).norm().min((step + truth).norm());
    Answer::Row {
        rows: rows().count(),
        step: steps.map(|s| 100.0 * gap(s) / d).min_by(f64::total_cmp),
    }
}

fn planes_of(found: &Found, planes: &[Cluster], d: f64, verifier: &Verifier<'_>) -> Answer {
    let nearest = planes.iter().map(|p| compare::nearest(found, p, d, RIGID));
    let finds = found.symmetries.iter();
    Answer::Planes {
        planes: nearest.collect(),
        group: found.groups.iter().any(|g| g.name == THREE_PLANES),
        finds: finds
            .map(|s| compare::find(s, d, [planes, &[]], verifier))
            .collect(),
    }
}

fn revolution(found: &Found, truth: &Axis, d: f64) -> Answer {
    let turned = found.continuous.iter().filter(|c| c.kind == "revolution");
    Answer::Revolution {
        continuous: found.continuous.len(),
        axis: best_axis(turned.filter_map(|c| c.axis), truth, d),
    }
}

impl Answer {
    /// In words: what is asked, whether it is there, its errors.
    fn cells(&self) -> [String; 3] {
        let yes = |there: bool| if there { "found" } else { "missing" };
        let errors = |axis: &Option<AxisError>| {
            [axis.map(|a| a.angle), axis.map(|a| a.offset)].map(|x| number(x, 3))
        };
        match self {
            Self::Axis(axis) => {
                let [angle, offset] = errors(axis);
                [format!("axis {}", yes(axis.is_some())), angle, offset]
            }
            Self::Row { rows, step } => [format!("rows: {rows}"), "-".into(), number(*step, 3)],
            Self::Planes { planes, group, .. } => [
                format!(
                    "{} planes, group {}",
                    of(planes.iter().filter(|p| p.recalled).count(), planes.len()),
                    yes(*group)
                ),
                number(worst(planes.iter().map(|p| p.angle)), 3),
                number(worst(planes.iter().map(|p| p.offset)), 3),
            ],
            Self::Revolution { axis, .. } => {
                let [angle, offset] = errors(axis);
                [format!("revolution {}", yes(axis.is_some())), angle, offset]
            }
        }
    }

    /// Whether the goal is met; accuracy of an axis within half a degree.
    fn is_met(&self, mirrors: usize) -> bool {
        let near = |axis: &Option<AxisError>| axis.is_some_and(|a| a.angle <= 0.5);
        match self {
            Self::Axis(axis) => near(axis),
            Self::Row { rows, .. } => *rows == 1,
            Self::Planes { planes, group, .. } => *group && planes.iter().all(|p| p.recalled),
            Self::Revolution { continuous, axis } => near(axis) && *continuous == 1 && mirrors == 0,
        }
    }
}

fn row(table: &mut Table, shape: &Shape, outcome: &Outcome) {
    let [wanted, angle, offset] = outcome.answer.cells();
    table.row([
        shape.name.clone(),
        outcome.seed.to_string(),
        wanted,
        angle,
        offset,
        outcome.mirrors.to_string(),
        outcome
            .error
            .clone()
            .unwrap_or_else(|| outcome.kinds.clone()),
    ]);
}

/// The goal of a shape, over all seeds, and whether there were mirrors where there are none.
fn verdicts_on(shape: &Shape, outcomes: &[Outcome]) -> Vec<Verdict> {
    let (goal, chiral) = match &shape.truth {
        Truth::Rotation { order, .. } => {
            (format!("an axis of order {order} within 0.5 degrees"), true)
        }
        Truth::Row { count, .. } => (format!("one row of {count}"), false),
        Truth::Planes(planes) => (format!("{} planes and {THREE_PLANES}", planes.len()), false),
        _ => (
            "one axis within 0.5 degrees, continuous, no planes".into(),
            false,
        ),
    };
    let met = outcomes
        .iter()
        .filter(|o| o.answer.is_met(o.mirrors))
        .count();
    let all = met == outcomes.len();
    let mut verdicts = vec![Verdict::new(goal, of(met, outcomes.len()), all)];
    if chiral {
        let mirrors: usize = outcomes.iter().map(|o| o.mirrors).sum();
        verdicts.push(Verdict::new(
            "no mirrors there",
            mirrors.to_string(),
            mirrors == 0,
        ));
    }
    let finds = outcomes.iter().filter_map(|o| match &o.answer {
        Answer::Planes { finds, .. } => Some(finds),
        _ => None,
    });
    let wrong = finds
        .map(|f| compare::count(f, Standing::False))
        .sum::<usize>();
    if matches!(shape.truth, Truth::Planes(_)) {
        verdicts.push(Verdict::new(
            "no false finds there",
            wrong.to_string(),
            wrong == 0,
        ));
    }
    verdicts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_are_read_from_names() {
        assert_eq!(cyclic_order("C5"), Some(5));
        assert_eq!(cyclic_order("C12v"), Some(12));
        assert_eq!(cyclic_order("D5"), None);
        assert_eq!(cyclic_order("row 5"), None);
    }
}
