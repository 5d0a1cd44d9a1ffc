//! Where a field says something: a mirror that drifts enough fits any smooth shape.
//!
//! Two things speak for a partner that growth and settling do not look for by themselves: that it lies as far
//! from its neighbours' partners as the sample from its neighbours (the field is an isometry of the surface
//! onto itself), and that the surface looks alike there, beside how alike any two places look. And where the
//! pairs do not come to lie on each other, however they settle, there is nothing to be found. Decision 0018 has
//! the figures.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::field::around::{Around, is_one_of_two};
use crate::field::grow::Land;
use crate::field::pieces::pieces;
use crate::field::{Partner, SymmetryField};
use crate::geom::median;
use crate::sample::Sample;
use crate::shape::wall::Wall;
use crate::transform::Ambient;

/// Distances along the surface over which stretch is measured, fractions of L.
const SPAN: [f64; 2] = [0.05, 0.115];
/// Mean |log| stretch around a sample above which its partner is not trusted.
const STRETCH: f64 = 0.15;
/// Mean gap of signatures around a sample, beside that of any two, above which it is not.
const UNLIKE: f64 = 0.7;
/// Gap of any two samples below which a shape is too bland to say anything (asinh k r): those of blobs with
/// a few dents have .15 to .25, all shapes with features .4 to .9.
const BLAND: f64 = 0.3;
/// Scores from which a field is accepted, and below which it is refused.
const ACCEPT: f64 = 0.45;
const REFUSE: f64 = 0.2;
/// Mean distance of the pairs around a sample above which it is not, fraction of L.
const AWAY: f64 = 0.002;
/// Distance of a pair that does not fit, fraction of L, and the share of samples without a partner that fits
/// above which a field is not accepted, for it holds for a part at the most ...
const UNFIT: f64 = 0.003;
const PARTIAL: f64 = 0.045;
/// ... unless it scores as much, as those of shapes do that lack a piece.
const SURE: f64 = 0.7;
/// What rivals of an outline's pairing reach up to which it is accepted, and above which it is refused: of those that a
/// person would pair all but one have .17 to .74, hands .78 and .90, animals seen from the side .84 and more.
const RIVAL: [f64; 2] = [0.76, 0.88];
/// Trusted share of the surroundings of a sample below which it is left alone, and above which it may be
/// changed as the rest.
const REGION: [f64; 2] = [0.55, 0.8];
/// Samples that each is compared with for the gap of any two.
const DRAWN: usize = 8;
/// Steps of the golden ratio go through the samples without a pattern.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Whether a field is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Yes.
    Accept,
    /// A person should look.
    Uncertain,
    /// No: it could be found on a shape without any.
    Refuse,
}

/// How far a field is to be trusted.
#[derive(Debug, Clone, PartialEq)]
pub struct Trust {
    /// Whether each sample's partner is.
    pub trusted: Vec<bool>,
    /// The share of the samples that are.
    pub share: f64,
    /// Median gap between the signatures of partners, beside that of any two samples: 0 alike, 1 by chance.
    pub gap: f64,
    /// The latter itself: how much there is to compare (asinh k r).
    pub relief: f64,
    /// Share of the samples that have no partner which fits, however they settle.
    pub unfit: f64,
    /// In the plane, how much the outline looks like its mirror image from other places, too: 0 not at all, 1 as
    /// much. None where its longest ring has its partners on others.
    pub rival: Option<f64>,
}

impl Trust {
    /// Of `field`.
    pub fn of(land: &Land<'_>, field: &SymmetryField) -> Self {
        let gaps = gaps(land, field);
        let relief = relief(land);
        let count = land.samples.list.len();
        let away: Vec<Option<f64>> = field
            .partners
            .iter()
            .map(|q| q.map(|q| q.residual))
            .collect();
        let flat = land.samples.ambient == Ambient::Plane;
        let trusted: Vec<bool> = (0..count as u32)
            .into_par_iter()
            .map(|s| {
                let alike = mean_around(land, s, &gaps) <= UNLIKE * relief;
                let fits = mean_around(land, s, &away) <= AWAY;
                let paired = field.partners[s as usize].is_some();
                // Limbs of the plane turn in their joints, where those of space slide over the surface.
                let isometric = flat || stretch(land, field, s) <= STRETCH;
                paired && alike && fits && isometric
            })
            .collect();
        Self {
            share: trusted.iter().filter(|t| **t).count() as f64 / count.max(1) as f64,
            gap: gap(&gaps, relief),
            relief,
            trusted,
            rival: rival(land, field),
            unfit: mean(
                away.iter()
                    .map(|d| f64::from(u8::from(d.is_none_or(|d| d > UNFIT)))),
            ),
        }
    }

    /// How far the surroundings of each sample may be changed, 0 to 1, where the field holds for a part only:
    /// trusted samples among others that are not count for nothing, nor does a second part.
    pub fn region(&self, land: &Land<'_>) -> Vec<f64> {
        let one = |t: &bool| Some(f64::from(u8::from(*t)));
        let mut share: Vec<Option<f64>> = self.trusted.iter().map(one).collect();
        for _ in 0..2 {
            let samples = (0..share.len() as u32).into_par_iter();
            let around = samples.map(|s| Some(mean_around(land, s, &share)));
            share = around.collect();
        }
        let [low, high] = REGION;
        let say = |s: f64| ((s - low) / (high - low)).clamp(0.0, 1.0);
        let region: Vec<f64> = share.into_iter().flatten().map(say).collect();
        let largest = largest_piece(&land.samples.neighbors, &region);
        let kept = region.iter().zip(largest);
        kept.map(|(share, kept)| if kept { *share } else { 0.0 })
            .collect()
    }

    /// How alike partners look: 1 entirely, 0 no more than any two samples.
    pub fn likeness(&self) -> f64 {
        alike(self.gap)
    }

    /// Trusted share times likeness, 0 to 1.
    pub fn score(&self) -> f64 {
        self.share * self.likeness()
    }

    /// What tells the better of two fields: of those that score alike the one of which less does not fit.
    pub fn worth(&self) -> f64 {
        self.score() - self.unfit
    }

    /// What follows from the figures.
    pub fn verdict(&self) -> Verdict {
        let score = self.score();
        let whole = self.unfit <= PARTIAL || score >= SURE;
        let [sure, none] = RIVAL;
        let rival = self.rival.unwrap_or(0.0);
        // An outline seen at a slant is like its mirror image in no place, and yet in none as much as there.
        let alone = self.rival.is_some() && rival <= sure;
        match () {
            () if score < REFUSE && !alone || rival > none => Verdict::Refuse,
            () if score >= ACCEPT && self.relief >= BLAND && whole && rival <= sure => {
                Verdict::Accept
            }
            () => Verdict::Uncertain,
        }
    }
}

/// How much an outline looks like its mirror image from other places than those of `field`; `None` of a surface, and where the longest
/// ring has its partners on others.
fn rival(land: &Land<'_>, field: &SymmetryField) -> Option<f64> {
    let paired = |wall: &&Wall| !is_one_of_two(wall, land.samples, &field.partners);
    let wall = land.wall.filter(paired)?;
    Some(Around::of(wall, land.samples).rival)
}

/// [`Trust::likeness`] of a `field`, without the rest.
pub fn likeness(land: &Land<'_>, field: &SymmetryField) -> f64 {
    alike(gap(&gaps(land, field), relief(land)))
}

/// How alike partners look, by how unlike they do beside any two samples.
fn alike(gap: f64) -> f64 {
    (1.0 - gap).max(0.0)
}

/// The median gap of partners beside that of any two samples.
fn gap(gaps: &[Option<f64>], relief: f64) -> f64 {
    let mut all: Vec<f64> = gaps.iter().flatten().copied().collect();
    median(&mut all).unwrap_or(f64::INFINITY) / relief.max(f64::MIN_POSITIVE)
}

/// The median gap of any two samples.
fn relief(land: &Land<'_>) -> f64 {
    median(&mut drawn(&land.samples.list)).unwrap_or_default()
}

/// Which samples belong to the largest connected piece where `share` is not 0.
fn largest_piece(neighbors: &[Vec<u32>], share: &[f64]) -> Vec<bool> {
    let pieces = pieces(neighbors, |s| share[s as usize] > 0.0, |_, _| true);
    // The first of several.
    let largest = pieces.into_iter().rev().max_by_key(Vec::len);
    let mut member = vec![false; share.len()];
    let largest = largest.into_iter().flatten();
    largest.for_each(|s| member[s as usize] = true);
    member
}

/// Gap between the signatures of each sample and its partner.
fn gaps(land: &Land<'_>, field: &SymmetryField) -> Vec<Option<f64>> {
    let list = &land.samples.list;
    let gap = |(s, q): (&Sample, &Option<Partner>)| {
        let q = q.as_ref()?.sample as usize;
        s.signature.distance(&list[q].signature)
    };
    list.iter().zip(&field.partners).map(gap).collect()
}

/// Gaps between any two samples, the same two at every run.
fn drawn(list: &[Sample]) -> Vec<f64> {
    let other = |k: usize| ((GOLDEN * (k + 1) as f64).fract() * list.len() as f64) as usize;
    (0..list.len() * DRAWN)
        .map(|k| (k / DRAWN, other(k)))
        .filter(|(i, j)| i != j)
        .filter_map(|(i, j)| list[i].signature.distance(&list[j].signature))
        .collect()
}

fn mean_around(land: &Land<'_>, s: u32, gaps: &[Option<f64>]) -> f64 {
    let near = land.reach.of(s, SPAN[1]);
    mean(near.filter_map(|(j, _)| gaps[j as usize]))
}

/// The mean |log| stretch of the field around a sample, infinite where it has no partners.
fn stretch(land: &Land<'_>, field: &SymmetryField, s: u32) -> f64 {
    let Some(p) = &field.partners[s as usize] else {
        return f64::INFINITY;
    };
    let x = land.samples.list[s as usize].position;
    let around = land.reach.of(s, SPAN[1]).filter(|(_, d)| *d >= SPAN[0]);
    mean(around.filter_map(|(j, _)| {
        let q = field.partners[j as usize].as_ref()?;
        let apart = (land.samples.list[j as usize].position - x).norm();
        let ratio = (p.position - q.position).norm() / apart.max(1e-9);
        Some(ratio.max(1e-9).ln().abs())
    }))
}

/// The mean, infinite of nothing.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(s, n), v| (s + v, n + 1.0));
    if count == 0.0 {
        f64::INFINITY
    } else {
        sum / count
    }
}
