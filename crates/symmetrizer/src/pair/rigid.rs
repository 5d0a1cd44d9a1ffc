//! Votes for rigid and for improper motions: one pair of samples fixes all six degrees of freedom, by
//! its places, its normals and the turn at which the two reliefs lie on each other.
//!
//! Principal directions alone leave their signs open, two candidates a pair; the relief's odd harmonics
//! tell them apart where the ground does, and where it does not all of its turns vote.

use rayon::prelude::*;

use crate::context::Context;
use crate::error::Result;
use crate::geom::{Matrix3, Point};
use crate::pair::{Pair, PairParams};
use crate::sample::relief::Sizes;
use crate::sample::{Frame, Probe, Sample};
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
/// For each probe those whose relief is like its own by size of the harmonics, the most alike first: a
/// turn or a mirror image changes nothing of that.
pub fn likes(probes: &[Probe], params: &PairParams) -> Vec<Vec<u32>> {
    let sizes: Vec<Sizes> = probes.iter().map(|p| p.sample.relief.sizes()).collect();
    let alike = |s: &Sizes| alike(&sizes, s, params);
    sizes.par_iter().map(alike).collect()
}

/// The proper or improper votes of a surface's probes among their `likes`, each pair in both directions.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub fn rigid_pairs(
    probes: &[Probe],
    likes: &[Vec<u32>],
    class: Class,
    space: &TransformSpace,
    params: &PairParams,
    ctx: &mut Context<'_>,
) -> Result<Vec<Pair>> {
    let rarity = |p: u32| 1.0 / likes[p as usize].len().max(1) as f64;
    let identity = Isometry::identity();
    let votes: Vec<Vec<Pair>> = (0..probes.len() as u32)
        .into_par_iter()
        .map(|p| {
            let found = partners(probes, p, &likes[p as usize], class, params);
            let votes = found.into_iter().map(|(q, t)| Pair {
                p: probes[p as usize].place,
                q: probes[q as usize].place,
                q_from_p: t,
                weight: (rarity(p) * rarity(q)).sqrt(),
            });
            votes
                .filter(|v| space.distance(&v.q_from_p, &identity) > MIN_MOTION)
                .collect()
        })
        .collect();
    ctx.progress(1.0)?;
    Ok(votes.into_iter().flatten().collect())
}

/// Votes of the probes in `asking` alone, each with more partners: a second look at places that are known
/// to come again.
pub fn guided_pairs(
    probes: &[Probe],
    likes: &[Vec<u32>],
    asking: &[u32],
    class: Class,
    space: &TransformSpace,
    params: &PairParams,
) -> Vec<Pair> {
    let params = PairParams {
        partners: GUIDED * params.partners,
        ..params.clone()
    };
    let identity = Isometry::identity();
    let votes: Vec<Vec<Pair>> = asking
        .par_iter()
        .map(|&p| {
            let from = &probes[p as usize];
            let likes = &likes[p as usize];
            let found = partners(probes, p, likes, class, &params);
            let weight = 1.0 / likes.len().max(1) as f64;
            let votes = found.into_iter().map(|(q, t)| Pair {
                p: from.place,
                q: probes[q as usize].place,
                q_from_p: t,
                weight,
            });
            votes
                .filter(|v| space.distance(&v.q_from_p, &identity) > MIN_MOTION)
                .collect()
        })
        .collect();
    votes.into_iter().flatten().collect()
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

/// The best partners of probe `p` among `likes`, with the motions that carry it to them.
fn partners(
    probes: &[Probe],
    p: u32,
    likes: &[u32],
    class: Class,
    params: &PairParams,
) -> Vec<(u32, Isometry)> {
    let s = &probes[p as usize].sample;
    let mut found: Vec<(f64, u32, f64)> = likes
        .iter()
        .take(CANDIDATES * params.partners)
        .flat_map(|&q| {
            let other = &probes[q as usize].sample.relief;
            let mut turns = s
                .relief
                .alignments(other, class.is_improper(), params.max_gap);
            turns.truncate(TURNS);
            turns.into_iter().map(move |a| (a.gap, q, a.turn))
        })
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    found.truncate(params.partners);
    let place = |s: &Sample, turn: f64| (s.position, s.frame.turned(turn));
    found
        .into_iter()
        .map(|(_, q, turn)| {
            let t = &probes[q as usize].sample;
            (q, motion(&place(s, 0.0), &place(t, turn), class))
        })
        .collect()
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
