//! Region growing: how far over the surface a cluster's isometry holds (section 2).

use rayon::prelude::*;

use crate::cluster::Cluster;
use crate::geom::{Point, PointIndex};
use crate::pair::Pair;
use crate::patch::judge::{Grown, judge, too_small};
use crate::patch::refine::{Contact, refine, weigh};
use crate::patch::symmetry::{PatchPair, Refusal, Symmetry};
use crate::sample::Samples;
use crate::sample::samples::Describer;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::{Ambient, Class, Correspondence, Isometry, TransformSpace, optimal_mirror};

/// When an isometry holds for a part of the surface.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PatchParams {
    /// Largest distance of a sample's image from the surface, fraction of L. 0.02, ours.
    pub tolerance: f64,
    /// Largest distance of a sample's image from the surface for other isometries than mirrors, fraction
    /// of L. 0.008, ours: six degrees of freedom fit more by chance.
    pub copy_tolerance: f64,
    /// Smallest cosine between carried and found normal. 0.75, ours (41 degrees).
    pub min_cos: f64,
    /// Where a patch ends, within the tolerance: at residuals this many times those of the quarter that
    /// holds best, times 1.5. 6, ours.
    pub end: f64,
    /// Smallest share of the surface's area for a mirror. 0.08, ours.
    pub min_area: f64,
    /// Smallest share of the surface's area that a copy and its image have together. 0.03, ours.
    pub min_copy: f64,
    /// Largest confusion of a mirror's pairs, see [`Symmetry::confusion`]. 0.18, ours.
    pub max_confusion: f64,
    /// Largest doubt about a mirror: the rms residual in units of the tolerance (a surface that merely
    /// passes by fills the tolerance evenly: .58), twice the confusion, and the share of its height
    /// that comes by chance. 0.8, ours, decision 0013: true mirrors of the models reach .77, false ones
    /// start at .88.
    pub max_doubt: f64,
    /// Largest rms residual of a motion, in units of what its patch was grown to: exact copies with even
    /// noise have .33. 0.385, ours.
    pub max_filled: f64,
    /// Largest rms residual where the patch of a motion ends, in the same units. 0.43, ours: copies end
    /// with .37, what passes by with .45.
    pub max_rim: f64,
    /// Largest share of a motion's height that its votes reach when their second places are shuffled. 0.03,
    /// ours.
    pub max_chance: f64,
    /// Largest median gap between the reliefs of a motion's partners. 0.6, ours.
    pub max_unlikeness: f64,
    /// Smallest firmness with which a patch holds a rigid motion against sliding. 0.02, ours.
    pub min_firmness: f64,
    /// Smallest height of a symmetry's cluster, as a share of the highest: what fewer votes speak for
    /// is chance. 0.15, ours.
    pub min_height: f64,
}

impl Default for PatchParams {
    fn default() -> Self {
        Self {
            tolerance: 0.02,
            copy_tolerance: 0.008,
            min_cos: 0.75,
            end: 6.0,
            min_area: 0.08,
            min_copy: 0.03,
            max_confusion: 0.18,
            max_doubt: 0.8,
            max_filled: 0.385,
            max_rim: 0.43,
            max_chance: 0.03,
            max_unlikeness: 0.6,
            min_firmness: 0.02,
            min_height: 0.15,
        }
    }
}

impl PatchParams {
    /// Smallest share of the surface's area.
    pub fn least_area(&self, class: Class) -> f64 {
        match class {
            Class::Mirror => self.min_area,
            Class::Proper | Class::Improper => self.min_copy,
        }
    }

    /// Largest distance of a sample's image from the surface, fraction of L.
    pub fn tolerance_of(&self, class: Class) -> f64 {
        match class {
            Class::Mirror => self.tolerance,
            Class::Proper | Class::Improper => self.copy_tolerance,
        }
    }
}

/// The surface that patches are grown on.
pub struct Ground<'a> {
    /// The surface.
    pub surface: &'a Surface,
    /// Its closest points.
    pub closest: &'a ClosestPoint,
    /// Its samples.
    pub samples: &'a Samples,
}

/// A growing round.
#[derive(Debug, Clone, Copy)]
struct Round {
    /// Tolerance, in units of the class's.
    tolerance: f64,
    /// How many neighbours away from the seeds it grows at the most.
    rings: u32,
}

impl Round {
    const fn far(tolerance: f64) -> Self {
        Self {
            tolerance,
            rings: u32::MAX,
        }
    }

    const fn near(tolerance: f64) -> Self {
        Self {
            tolerance,
            rings: 1,
        }
    }
}

/// Tolerances of the growing rounds, in units of the class's tolerance: wide first, while the
/// cluster's isometry is still rough.
const WIDE: [Round; 6] = [
    Round::far(2.5),
    Round::far(2.0),
    Round::far(1.5),
    Round::far(1.0),
    Round::far(1.0),
    Round::far(1.0),
];
/// For mirrors a second time, as if only what holds well were there: a part that moves as one piece is
/// not drawn towards its neighbours.
const NARROW: [Round; 4] = [
    Round::far(1.2),
    Round::far(0.8),
    Round::far(0.4),
    Round::far(0.4),
];
/// As a rigid motion has more freedom, its votes are rougher.
/// The first are fitted to the places that voted and what is next to them alone: plain ground around
/// an element, where most motions nearly hold, would draw the fit to itself.
const MOTION: [Round; 6] = [
    Round::near(5.0),
    Round::near(3.0),
    Round::near(2.0),
    Round::far(1.5),
    Round::far(1.0),
    Round::far(1.0),
];
/// Residual up to which a place speaks for one of two mirrors, in units of the tolerance.
const WELL: f64 = 0.4;
/// Share of the least area that a candidate must reach while it settles.
const HOPEFUL: f64 = 0.8;
/// Rounds of settling at the most.
const SETTLING: usize = 12;
/// Settled: contacts move by less than this from round to round, fraction of L.
const SETTLED: f64 = 2e-5;

/// Grows the patch of `cluster`: from the places that voted for it, over neighbouring samples,
/// as long as their images lie on the surface; the isometry is refitted as the patch grows, in the
/// end to the part of the patch for which it holds best. Of `known` ground, where there is some, it is
/// known that it comes again: the patch then is a part of it, and needs less evidence.
///
/// # Errors
/// [`Refusal`] where no symmetry worth the name comes out, with the reason.
pub fn grow_patch(
    ground: &Ground<'_>,
    describer: &Describer<'_>,
    pairs: &[Pair],
    cluster: &Cluster,
    class: Class,
    space: &TransformSpace,
    known: Option<&[bool]>,
    params: &PatchParams,
) -> Result<Symmetry, Box<Refusal>> {
    let t = start(ground.samples, pairs, cluster, class, space);
    let votes = cluster.votes.iter().map(|&i| &pairs[i as usize]);
    // Either end of a mirror's vote lies in the patch; else the first does, the second in the image.
    let both = class == Class::Mirror;
    let seeds = votes.flat_map(|v| std::iter::once(v.p).chain(both.then_some(v.q)));
    let candidate = Candidate {
        t,
        class,
        height: cluster.height,
        seeds: sorted(seeds.collect()),
        within: known.map(<[bool]>::to_vec),
        near: known.is_some(),
    };
    verify(ground, describer, &candidate, params)
}

fn sorted(mut samples: Vec<u32>) -> Vec<u32> {
    samples.sort_unstable();
    samples.dedup();
    samples
}

/// An isometry that may be a symmetry, and the samples where it is thought to hold.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The isometry, to be refined.
    pub t: Isometry,
    /// Its class.
    pub class: Class,
    /// Height of the cluster it came from.
    pub height: f64,
    /// Samples to grow from, increasing.
    pub seeds: Vec<u32>,
    /// The samples it may grow over; all where there is none.
    pub within: Option<Vec<bool>>,
    /// Whether it is known that there is something: a mirror then draws in nothing further away, a motion
    /// needs less evidence of its own.
    pub near: bool,
}

/// Grows the patch of a candidate, as [`grow_patch`] does that of a cluster.
///
/// # Errors
/// As [`grow_patch`].
pub fn verify(
    ground: &Ground<'_>,
    describer: &Describer<'_>,
    candidate: &Candidate,
    params: &PatchParams,
) -> Result<Symmetry, Box<Refusal>> {
    let Candidate { class, seeds, .. } = candidate;
    let refuse = |t: Isometry, reason: String| {
        Box::new(Refusal {
            class: *class,
            q_from_p: t,
            height: candidate.height,
            reason,
            near: seeds.first().map_or(Point::origin(), |&s| {
                ground.samples.list[s as usize].position
            }),
        })
    };
    let tolerance = params.tolerance_of(*class);
    let mirror = *class == Class::Mirror;
    let settled = if mirror && candidate.near {
        settle(ground, candidate, &NARROW, params)
    } else if mirror {
        let both = [&WIDE[..], &NARROW[..]].map(|rounds| settle(ground, candidate, rounds, params));
        let [wide, narrow] = both;
        best_supported(ground, wide, narrow, params)
    } else {
        settle(ground, candidate, &MOTION, params)
    };
    let Settled { t, spread } = settled.map_err(|reason| refuse(candidate.t, reason))?;
    // A patch ends where the isometry no longer holds as it does where it holds best.
    let reached = (params.end * spread).clamp(0.25 * tolerance, tolerance);
    let grown = reach(ground, &t, reached, params.min_cos, candidate, u32::MAX);
    if grown.is_empty() {
        return Err(refuse(t, NOWHERE.into()));
    }
    let grown = Grown {
        t,
        class: *class,
        height: candidate.height,
        pairs: grown,
        reached,
        near: candidate.near,
    };
    judge(ground, describer, grown, params).map_err(|reason| refuse(t, reason))
}

/// An isometry that has come to rest on the surface.
struct Settled {
    t: Isometry,
    /// How well it holds where it holds best, fraction of L.
    spread: f64,
}

/// Why a candidate that holds nowhere is refused.
const NOWHERE: &str = "its votes do not hold on the surface";

/// Refits a candidate's isometry while its patch grows in `rounds`, then to where it holds best.
///
/// # Errors
/// The reason why nothing can come of it.
fn settle(
    ground: &Ground<'_>,
    candidate: &Candidate,
    rounds: &[Round],
    params: &PatchParams,
) -> Result<Settled, String> {
    let Candidate { class, seeds, .. } = candidate;
    let tolerance = params.tolerance_of(*class);
    let mut t = candidate.t;
    for round in rounds {
        let bound = round.tolerance * tolerance;
        let grown = reach(ground, &t, bound, params.min_cos, candidate, round.rings);
        if round.tolerance <= 1.0 {
            hopeful(ground, &grown, params.least_area(*class))?;
        }
        let mut contacts = contacts(ground, &grown);
        if *class != Class::Mirror && !grown.is_empty() {
            weigh(&t, &mut contacts, scale(&grown, seeds, 0.5));
        }
        t = refine(&t, *class, &contacts);
    }
    let last = rounds.last().map_or(1.0, |r| r.tolerance) * tolerance;
    let mut spread = 0.0;
    for _ in 0..SETTLING {
        let grown = reach(ground, &t, last, params.min_cos, candidate, u32::MAX);
        if grown.is_empty() {
            return Err(NOWHERE.into());
        }
        hopeful(ground, &grown, params.least_area(*class))?;
        spread = scale(&grown, seeds, 0.25);
        let mut contacts = contacts(ground, &grown);
        weigh(&t, &mut contacts, spread);
        let next = refine(&t, *class, &contacts);
        let moved = contacts
            .iter()
            .map(|c| (next.apply(&c.x) - t.apply(&c.x)).norm_squared());
        let moved = (moved.sum::<f64>() / contacts.len() as f64).sqrt();
        t = next;
        if moved < SETTLED {
            break;
        }
    }
    Ok(Settled { t, spread })
}

/// Refuses what has not come near the area of a patch: most candidates have not, and to settle them is
/// most of the work.
fn hopeful(ground: &Ground<'_>, grown: &[PatchPair], least: f64) -> Result<(), String> {
    let at_most = 2.0 * grown.len() as f64 / ground.samples.list.len() as f64;
    if at_most < HOPEFUL * least {
        return Err(too_small(at_most));
    }
    Ok(())
}

/// Of two the one that holds well for more of the surface.
fn best_supported(
    ground: &Ground<'_>,
    wide: Result<Settled, String>,
    narrow: Result<Settled, String>,
    params: &PatchParams,
) -> Result<Settled, String> {
    let well = WELL * params.tolerance;
    let support = |s: &Result<Settled, String>| {
        s.as_ref().map_or(0.0, |s| {
            let touched = touch(ground, &s.t, well, params.min_cos);
            let share = |p: PatchPair| 1.0 - (p.residual / well).powi(2);
            touched.into_iter().flatten().map(share).sum::<f64>()
        })
    };
    if support(&narrow) > support(&wide) {
        narrow
    } else {
        wide
    }
}

/// 1.5 times the `quantile` of the residuals of those pairs that the candidate was found by.
fn scale(grown: &[PatchPair], seeds: &[u32], quantile: f64) -> f64 {
    let seeded = grown
        .iter()
        .filter(|p| seeds.binary_search(&p.sample).is_ok());
    let mut residuals: Vec<f64> = seeded.map(|p| p.residual).collect();
    if residuals.is_empty() {
        residuals = grown.iter().map(|p| p.residual).collect();
    }
    let at = ((residuals.len() - 1) as f64 * quantile) as usize;
    1.5 * *residuals.select_nth_unstable_by(at, f64::total_cmp).1
}

/// The isometry that a cluster's votes agree on: appendix A for mirrors, else the mean of the cloud.
fn start(
    samples: &Samples,
    pairs: &[Pair],
    cluster: &Cluster,
    class: Class,
    space: &TransformSpace,
) -> Isometry {
    let mean = || space.nearest(&cluster.mode, class.is_improper());
    if class != Class::Mirror {
        return mean();
    }
    let votes: Vec<Correspondence> = cluster
        .votes
        .iter()
        .map(|&i| &pairs[i as usize])
        .map(|v| Correspondence {
            p: samples.list[v.p as usize].position,
            q: samples.list[v.q as usize].position,
            weight: v.weight,
        })
        .collect();
    optimal_mirror(&votes, Ambient::Space).map_or_else(mean, |fit| Isometry::mirror(&fit.plane))
}

/// For each sample the closest facing surface point to its image under `t`, where it is near enough.
pub fn touch(
    ground: &Ground<'_>,
    t: &Isometry,
    tolerance: f64,
    min_cos: f64,
) -> Vec<Option<PatchPair>> {
    (0..ground.samples.list.len() as u32)
        .into_par_iter()
        .map(|s| touch_one(ground, t, s, tolerance, min_cos))
        .collect()
}

fn touch_one(
    ground: &Ground<'_>,
    t: &Isometry,
    sample: u32,
    tolerance: f64,
    min_cos: f64,
) -> Option<PatchPair> {
    let s = &ground.samples.list[sample as usize];
    let (image, normal) = (t.apply(&s.position), t.rotate(&s.normal));
    let hit = ground
        .closest
        .nearest_facing(&image, &normal, min_cos, tolerance)?;
    Some(PatchPair {
        sample,
        partner: hit.at,
        residual: hit.distance,
    })
}

/// The samples that can be reached from a seed over at most `rings` neighbours whose images touch the
/// surface, by sample.
fn reach(
    ground: &Ground<'_>,
    t: &Isometry,
    tolerance: f64,
    min_cos: f64,
    candidate: &Candidate,
    rings: u32,
) -> Vec<PatchPair> {
    let samples = ground.samples;
    let mut seen = match &candidate.within {
        Some(within) => within.iter().map(|inside| !inside).collect(),
        None => vec![false; samples.list.len()],
    };
    let mut front: Vec<u32> = candidate.seeds.clone();
    for &s in &candidate.seeds {
        seen[s as usize] = true;
    }
    let mut grown = Vec::new();
    let mut ring = 0;
    while !front.is_empty() && ring <= rings {
        ring += 1;
        let touched: Vec<PatchPair> = front
            .par_iter()
            .with_min_len(64)
            .filter_map(|&s| touch_one(ground, t, s, tolerance, min_cos))
            .collect();
        front.clear();
        for pair in &touched {
            for &next in &samples.neighbors[pair.sample as usize] {
                if !seen[next as usize] {
                    seen[next as usize] = true;
                    front.push(next);
                }
            }
        }
        grown.extend(touched);
    }
    grown.sort_by_key(|p| p.sample);
    grown
}

/// The pairs of a patch as contacts of weight 1.
pub fn contacts(ground: &Ground<'_>, grown: &[PatchPair]) -> Vec<Contact> {
    grown
        .iter()
        .map(|pair| Contact {
            x: ground.samples.list[pair.sample as usize].position,
            y: ground.surface.point(&pair.partner),
            normal: ground.surface.normal(&pair.partner),
            weight: 1.0,
        })
        .collect()
}

/// The samples that lie in the image of a patch: those next to a partner and facing its way.
pub fn image(ground: &Ground<'_>, grown: &[PatchPair]) -> Vec<u32> {
    let partners: Vec<Point> = grown
        .iter()
        .map(|p| ground.surface.point(&p.partner))
        .collect();
    let places: Vec<[f64; 3]> = partners.iter().map(|p| p.coords.into()).collect();
    let index = PointIndex::new(&places);
    let list = &ground.samples.list;
    // Partners lie as densely as samples do: none is further from one than the spacing.
    (0..list.len() as u32)
        .into_par_iter()
        .filter(|&i| {
            let s = &list[i as usize];
            index
                .within(&s.position.coords.into(), ground.samples.spacing)
                .into_iter()
                .any(|k| {
                    ground
                        .surface
                        .normal(&grown[k as usize].partner)
                        .dot(&s.normal)
                        > 0.25
                })
        })
        .collect()
}
