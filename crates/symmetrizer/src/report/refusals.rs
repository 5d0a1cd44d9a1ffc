//! What was looked at and refused, as the report has it: the highest, and how many for which reason.

use serde::Serialize;

use crate::apply::measure::PlaneReport;
use crate::job::Detected;
use crate::patch::Refusal;
use crate::report::place::{Matrix, Place};
use crate::transform::Class;

/// Refused clusters of a class in the report at the most: a motion is looked for at hundreds.
const LISTED: usize = 12;

/// A cluster that is no symmetry, in document coordinates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RefusalReport {
    /// The cloud it was found in.
    pub class: Class,
    /// Rows of the 4x4 matrix of its isometry, acting on columns.
    pub matrix: Matrix,
    /// The plane of a mirror.
    #[serde(flatten)]
    pub plane: Option<PlaneReport>,
    /// Kernel density of its votes.
    pub height: f64,
    /// Why it was refused, for people.
    pub reason: String,
}

/// How many clusters of a class were refused for a reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct RefusedCount {
    /// The cloud.
    pub class: Class,
    /// The reason without its figures.
    pub reason: String,
    /// How many.
    pub count: usize,
}

/// The highest refused clusters of each class.
pub fn highest(found: &Detected) -> Vec<RefusalReport> {
    let listed = highest_of(found).into_iter();
    listed.map(|r| report(r, found)).collect()
}

/// The refused clusters that are listed and drawn: some of each class, the highest first.
pub fn highest_of(found: &Detected) -> Vec<&Refusal> {
    let refused = &found.detection.refused;
    // Within a class they come in the order in which they were looked at, the highest first.
    let of = |class: Class| {
        refused
            .iter()
            .filter(move |r| r.class == class)
            .take(LISTED)
    };
    Class::ALL.into_iter().flat_map(of).collect()
}

/// All refused clusters by class and reason, the most frequent reasons first.
pub fn counts(found: &Detected) -> Vec<RefusedCount> {
    let mut counts: Vec<RefusedCount> = Vec::new();
    for refusal in &found.detection.refused {
        let reason = without_figures(&refusal.reason);
        let same = |c: &&mut RefusedCount| c.class == refusal.class && c.reason == reason;
        match counts.iter_mut().find(same) {
            Some(known) => known.count += 1,
            None => counts.push(RefusedCount {
                class: refusal.class,
                reason,
                count: 1,
            }),
        }
    }
    counts.sort_by(|a, b| a.class.cmp(&b.class).then(b.count.cmp(&a.count)));
    counts
}

fn report(refusal: &Refusal, found: &Detected) -> RefusalReport {
    let normalization = &found.working.normalization;
    let plane = || {
        refusal
            .q_from_p
            .nearest_mirror(&crate::geom::Point::origin())
    };
    RefusalReport {
        class: refusal.class,
        matrix: Place(&found.working).matrix(&refusal.q_from_p),
        plane: (refusal.class == Class::Mirror).then(|| PlaneReport::new(&plane(), normalization)),
        height: refusal.height,
        reason: refusal.reason.clone(),
    }
}

/// The reason without what is in brackets, numbers as dots.
fn without_figures(reason: &str) -> String {
    let plain = reason.split(" (").next().unwrap_or(reason);
    let word = |word: &str| {
        let number = word.trim_end_matches(',');
        match number.parse::<f64>() {
            Ok(_) => word.replace(number, "..."),
            Err(_) => word.to_owned(),
        }
    };
    let words: Vec<String> = plain.split(' ').map(word).collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::without_figures;

    #[test]
    fn reasons_are_told_apart_by_their_words() {
        let same = [
            (
                "holds for 3.1 % of the surface only",
                "holds for ... % of the surface only",
            ),
            (
                "slides along itself (firmness 0.010)",
                "slides along itself",
            ),
            (
                "explains 0.83 of it, gap 0.2, or",
                "explains ... of it, gap ..., or",
            ),
            ("hardly moves its patch", "hardly moves its patch"),
        ];
        for (reason, plain) in same {
            assert_eq!(without_figures(reason), plain);
        }
    }
}
