//! Votes for rigid and for improper motions: one pair of samples fixes all six degrees of freedom, by
//! its places, its normals and the turn at which the two reliefs lie on each other.
//!
//! Principal directions alone leave their signs open, two candidates a pair; the relief's odd harmonics
//! tell them apart where the ground does, and where it does not all of its turns vote.

use rayon::prelude::*;

use crate::context::Context;
use crate::error::Result;
use crate::geom::{Ambient, Matrix3, Point};
use crate::pair::{Pair, PairParams};
use crate::sample::relief::{Alignment, Sizes};
use crate::sample::{Frame, Probe, Relief, Sample, profile};
use crate::transform::{Class, Isometry, TransformSpace};

/// Samples that are like one by size of their harmonics are aligned with it up to this many times the
/// partners wanted, the most alike first.
const CANDIDATES: usize = 3;
/// Turns at which one pair may vote, the best first: more is a place without direction.
const TURNS: usize = 2;
/// How many times as many partners a probe has that is looked at again.
const GUIDED: usize = 4;
/// A vote's own motion moves the shape by more than this, rms fraction of L: less is the
/// surface lying on itself.
const MIN_MOTION: f64 = 0.1;

/// Probes and for each of them those whose relief is like its own by size of the harmonics, the most alike first: a
/// turn or a mirror image changes nothing of that.
pub struct Likes<'a> {
    /// The probes.
    pub probes: &'a [Probe],
    alike: Vec<Vec<u32>>,
    ambient: Ambient,
}

impl<'a> Likes<'a> {
    /// Of `probes`, samples of a shape that lives in `ambient`.
    pub fn new(probes: &'a [Probe], ambient: Ambient, params: &PairParams) -> Self {
        let sizes: Vec<Sizes> = probes.iter().map(|p| p.sample.relief.sizes()).collect();
        let alike = |s: &Sizes| alike(&sizes, s, params);
        Self {
            probes,
            alike: sizes.par_iter().map(alike).collect(),
            ambient,
        }
    }

    /// The proper or improper votes of all probes, each pair in both directions.
    ///
    /// # Errors
    /// [`crate::Error::Cancelled`].
    pub fn pairs(
        &self,
        class: Class,
        space: &TransformSpace,
        params: &PairParams,
        ctx: &mut Context<'_>,
    ) -> Result<Vec<Pair>> {
        let weight = |p, q| (self.rarity(p) * self.rarity(q)).sqrt();
        let every: Vec<u32> = (0..self.probes.len() as u32).collect();
        let votes = self.votes(&every, class, space, params, weight);
        ctx.progress(1.0)?;
        Ok(votes)
    }

    /// Votes of the probes in `asking` alone, each with more partners: a second look at places that are known
    /// to come again.
    pub fn guided(
        &self,
        asking: &[u32],
        class: Class,
        space: &TransformSpace,
        params: &PairParams,
    ) -> Vec<Pair> {
        let params = PairParams {
            partners: GUIDED * params.partners,
            ..params.clone()
        };
        let weight = |p, _| self.rarity(p);
        self.votes(asking, class, space, &params, weight)
    }

    /// 1 / the number of probes that are like a probe.
    fn rarity(&self, p: u32) -> f64 {
        1.0 / self.alike[p as usize].len().max(1) as f64
    }

    /// The votes of the probes in `asking`, with their `weight`.
    fn votes(
        &self,
        asking: &[u32],
        class: Class,
        space: &TransformSpace,
        params: &PairParams,
        weight: impl Fn(u32, u32) -> f64 + Sync,
    ) -> Vec<Pair> {
        let identity = Isometry::identity();
        let of = |&p: &u32| -> Vec<Pair> {
            let votes = self.partners(p, class, params).into_iter();
            let votes = votes.map(|(q, t)| Pair {
                p: self.probes[p as usize].place,
                q: self.probes[q as usize].place,
                q_from_p: t,
                weight: weight(p, q),
            });
            votes
                .filter(|v| space.distance(&v.q_from_p, &identity) > MIN_MOTION)
                .collect()
        };
        let votes: Vec<Vec<Pair>> = asking.par_iter().map(of).collect();
        votes.into_iter().flatten().collect()
    }

    /// The best partners of probe `p` among those like it, with the motions that carry it to them.
    fn partners(&self, p: u32, class: Class, params: &PairParams) -> Vec<(u32, Isometry)> {
        let s = &self.probes[p as usize].sample;
        let likes = &self.alike[p as usize];
        let mut found: Vec<(f64, u32, f64)> = likes
            .iter()
            .take(CANDIDATES * params.partners)
            .flat_map(|&q| {
                let other = &self.probes[q as usize].sample.relief;
                let turns = self.turns(&s.relief, other, class, params.max_gap);
                turns.into_iter().map(move |a| (a.gap, q, a.turn))
            })
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.truncate(params.partners);
        let place = |s: &Sample, turn: f64| (s.position, s.frame.turned(turn));
        found
            .into_iter()
            .map(|(_, q, turn)| {
                let t = &self.probes[q as usize].sample;
                (q, motion(&place(s, 0.0), &place(t, turn), class))
            })
            .collect()
    }

    /// The turns at which two reliefs lie on each other, the best first: in the plane there is one for each class.
    fn turns(&self, p: &Relief, q: &Relief, class: Class, max_gap: f64) -> Vec<Alignment> {
        let mirrored = class.is_improper();
        match self.ambient {
            Ambient::Space => {
                let mut turns = p.alignments(q, mirrored, max_gap);
                turns.truncate(TURNS);
                turns
            }
            Ambient::Plane => {
                let turn = profile::turn(mirrored);
                let gap = p.gap_at(q, mirrored, turn).filter(|&gap| gap <= max_gap);
                gap.map(|gap| Alignment { turn, gap }).into_iter().collect()
            }
        }
    }
}

/// Those of all whose harmonics are like `s` by size, the most alike first.
fn alike(all: &[Sizes], s: &Sizes, params: &PairParams) -> Vec<u32> {
    let mut found: Vec<(f64, u32)> = all
        .iter()
        .zip(0..)
        .filter_map(|(t, q)| Some((s.least_gap(t)?, q)))
        .filter(|&(gap, _)| gap < params.max_gap)
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    found.into_iter().map(|(_, q)| q).collect()
}

/// The motion that carries one place with its frame to another; improper ones turn the second tangent
/// round.
pub fn motion(p: &(Point, Frame), q: &(Point, Frame), class: Class) -> Isometry {
    let hand = if class.is_improper() { -1.0 } else { 1.0 };
    let from = Matrix3::from_columns(&[p.1.n, p.1.e1, hand * p.1.e2()]);
    let to = Matrix3::from_columns(&[q.1.n, q.1.e1, q.1.e2()]);
    let linear = to * from.transpose();
    Isometry {
        linear,
        translation: q.0.coords - linear * p.0.coords,
    }
}
