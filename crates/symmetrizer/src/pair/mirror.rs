//! Votes for mirrors: two places fix the plane, frames are a test only.

use nalgebra::center;
use rayon::prelude::*;

use crate::context::Context;
use crate::error::Result;
use crate::geom::Vector;
use crate::pair::{Pair, PairParams};
use crate::sample::{Sample, Samples};
use crate::transform::{Isometry, Plane};

/// The mirror votes of a sampled surface: pairs with like signatures whose normals the pair's own
/// mirror exchanges, weighted by distinctiveness; where only some samples are to be looked `among`,
/// partners and distinctiveness are those among them.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub fn mirror_pairs(
    samples: &Samples,
    among: Option<&[bool]>,
    params: &PairParams,
    ctx: &mut Context<'_>,
) -> Result<Vec<Pair>> {
    let list = &samples.list;
    let chosen = |i: &usize| among.is_none_or(|a| a[*i]);
    let chosen: Vec<usize> = (0..list.len()).filter(chosen).collect();
    let likes: Vec<Vec<(f64, usize)>> = list
        .par_iter()
        .map(|s| alike(list, &chosen, s, params.tolerance))
        .collect();
    ctx.progress(0.5)?;
    // The one weight that matters: without it the bunny's head is lost among its back's votes.
    let rarity = |i: usize| 1.0 / likes[i].len().max(1) as f64;
    let per_sample: Vec<Vec<Pair>> = chosen
        .par_iter()
        .map(|&p| partners(list, &likes[p], p, params, rarity))
        .collect();
    let mut pairs: Vec<Pair> = per_sample.into_iter().flatten().collect();
    // A pair chosen from both of its ends is one vote.
    pairs.sort_by_key(|v| (v.p, v.q));
    pairs.dedup_by_key(|v| (v.p, v.q));
    ctx.progress(1.0)?;
    Ok(pairs)
}

/// The `chosen` samples with signatures like that of `s`, and how far these are from it.
fn alike(list: &[Sample], chosen: &[usize], s: &Sample, tolerance: f64) -> Vec<(f64, usize)> {
    let gap = |&q: &usize| Some((s.signature.distance(&list[q].signature)?, q));
    let all = chosen.iter().filter_map(gap);
    all.filter(|(gap, _)| *gap < tolerance).collect()
}

/// The best partners of sample `p` among those that look alike, as pairs with the smaller index first, weighted by
/// `rarity`.
fn partners(
    list: &[Sample],
    likes: &[(f64, usize)],
    p: usize,
    params: &PairParams,
    rarity: impl Fn(usize) -> f64,
) -> Vec<Pair> {
    if list[p].signature.strength() < params.min_strength {
        return Vec::new();
    }
    let others = likes.iter().filter(|(_, q)| *q != p);
    let mut found: Vec<(f64, usize, Plane)> = others
        .filter_map(|&(gap, q)| Some((gap, q, mirror_of(&list[p], &list[q], params)?)))
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    found.truncate(params.partners);
    found
        .into_iter()
        .map(|(_, q, plane)| Pair {
            p: p.min(q) as u32,
            q: p.max(q) as u32,
            q_from_p: Isometry::mirror(&plane),
            weight: (rarity(p) * rarity(q)).sqrt(),
        })
        .collect()
}

/// The mirror that exchanges two samples, where it also exchanges their normals and, where both
/// have them, their principal directions.
pub fn mirror_of(p: &Sample, q: &Sample, params: &PairParams) -> Option<Plane> {
    let between = p.position - q.position;
    let distance = between.norm();
    if distance < params.min_distance {
        return None;
    }
    let n = between / distance;
    let reflect = |v: &Vector| v - 2.0 * n.dot(v) * n;
    if (reflect(&p.normal) - q.normal).norm() > params.normal_tolerance {
        return None;
    }
    if let (Some(e_p), Some(e_q)) = (p.e1, q.e1)
        && reflect(&e_p).dot(&e_q).abs() < MIN_FRAME_AGREEMENT
    {
        return None;
    }
    Some(Plane::through(&center(&p.position, &q.position), n))
}

/// Cosine of the largest angle between principal directions of a pair, 40 degrees (ours).
const MIN_FRAME_AGREEMENT: f64 = 0.77;
