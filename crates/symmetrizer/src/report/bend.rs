//! What is said about a bend.

use serde::Serialize;

use crate::field::trust::Verdict;
use crate::optimize::Step;
use crate::straighten::Bend;

/// A bend and whether it is believed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BendReport {
    /// Whether the symmetry under it is there.
    pub verdict: Verdict,
    /// What the verdict follows from, 0 to 1: the trusted share times the likeness of partners.
    pub score: f64,
    /// Share of the surface whose partners are trusted: as far from each other as they should be, and alike.
    pub trusted: f64,
    /// 1 where partners look alike (curvatures), 0 where they do no more than any two places.
    pub likeness: f64,
    /// How much there is to compare: the median difference of any two places' curvatures, asinh(k r).
    pub relief: f64,
    /// Share of the surface whose mirror image does not come to lie on the rest, however the shape is bent: where
    /// it is large, the symmetry is one of a part.
    pub unfit: f64,
    /// Of an outline, how much it looks like its mirror image from other places, too: 0 not at all, 1 as much.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rival: Option<f64>,
    /// The largest angle by which local mirrors turn over the shape, degrees.
    pub degrees: f64,
    /// How much of it was removed, degrees.
    pub removed: f64,
    /// Bends that showed in the rest once it was, and were undone one after the other, degrees each.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub further: Vec<f64>,
    /// What was kept of it; none where all was removed, or nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub kept: Option<KeptReport>,
}

/// A shape that is symmetric about an axis that is still bent.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KeptReport {
    /// How much of the bend, degrees.
    pub degrees: f64,
    /// How far partners lie from opposite each other across the bent mirror, mean, % of D.
    pub across: f64,
    /// How far the centre line, the middles between partners near it, lies from where it was in the input, rms,
    /// % of D.
    pub line: f64,
}

impl BendReport {
    /// Of `bend`, nothing removed yet.
    pub fn new(bend: &Bend) -> Self {
        Self {
            verdict: bend.trust.verdict(),
            score: bend.trust.score(),
            trusted: bend.trust.share,
            likeness: (1.0 - bend.trust.gap).max(0.0),
            relief: bend.trust.relief,
            unfit: bend.trust.unfit,
            rival: bend.trust.rival,
            degrees: bend.degrees,
            removed: 0.0,
            further: Vec::new(),
            kept: None,
        }
    }

    /// Takes from the `steps` of the work what was undone after the first bend.
    pub fn follow(&mut self, steps: &[Step]) {
        let bends = steps.iter().filter_map(|step| match step {
            Step::Straighten { bend, .. } => Some(*bend),
            _ => None,
        });
        self.further = bends.skip(1).collect();
    }
}
