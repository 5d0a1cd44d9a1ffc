//! Region growing: how far over the surface a cluster's isometry holds (section 2).

use rayon::prelude::*;

use crate::cluster::Cluster;
use crate::geom::{Point, PointIndex};
use crate::pair::Pair;
use crate::patch::judge::judge;
use crate::patch::refine::{Contact, refine, weigh};
use crate::patch::symmetry::{PatchPair, Refusal, Symmetry};
use crate::sample::Samples;
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
    /// Smallest share of the surface's area for a mirror. 0.08, ours.
    pub min_area: f64,
    /// Smallest share of the surface's area that a copy and its image have together. 0.03, ours.
    pub min_copy: f64,
    /// Largest confusion of the pairs, see [`Symmetry::confusion`]. 0.12, ours: true mirrors of the
    /// models stay below .105, those of shapes without symmetry start at .138.
    pub max_confusion: f64,
    /// Largest sum of the rms residual, in units of the tolerance, and the confusion: a surface that
    /// merely passes by fills the tolerance evenly (rms .58) and looks like many places. 0.6, ours:
    /// true mirrors of the models reach .58, the arms of a chiral shape start at .61.
    pub max_doubt: f64,
    /// Smallest firmness with which a patch holds a rigid motion against sliding. 0.02, ours.
    pub min_firmness: f64,
    /// Smallest height of a symmetry's cluster, as a share of the highest: what fewer votes speak for
    /// is chance. 0.1, ours.
    pub min_height: f64,
}

impl Default for PatchParams {
    fn default() -> Self {
        Self {
            tolerance: 0.02,
            copy_tolerance: 0.008,
            min_cos: 0.75,
            min_area: 0.08,
            min_copy: 0.03,
            max_confusion: 0.12,
            max_doubt: 0.6,
            min_firmness: 0.02,
            min_height: 0.1,
        }
    }
}

impl PatchParams {
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

/// Tolerances of the growing rounds, in units of the class's tolerance: wide first, while the
/// cluster's isometry is still rough.
const MIRROR_ROUNDS: [f64; 6] = [2.5, 2.0, 1.5, 1.0, 1.0, 1.0];
/// As a rigid motion has more freedom, its votes are rougher.
const MOTION_ROUNDS: [f64; 7] = [5.0, 3.0, 2.0, 1.5, 1.0, 1.0, 1.0];
/// In the last rounds contacts are weighed by how well they hold.
const ROBUST: usize = 3;

/// Grows the patch of `cluster`: from the places that voted for it, over neighbouring samples,
/// as long as their images lie on the surface; the isometry is refitted as the patch grows.
///
/// # Errors
/// [`Refusal`] where no symmetry worth the name comes out, with the reason.
pub fn grow_patch(
    ground: &Ground<'_>,
    pairs: &[Pair],
    cluster: &Cluster,
    class: Class,
    space: &TransformSpace,
    params: &PatchParams,
) -> Result<Symmetry, Refusal> {
    let list = &ground.samples.list;
    let mut t = start(ground.samples, pairs, cluster, class, space);
    let votes = cluster.votes.iter().map(|&i| &pairs[i as usize]);
    // Either end of a mirror's vote lies in the patch; else the first does, the second in the image.
    let both = class == Class::Mirror;
    let mut seeds: Vec<u32> = votes
        .flat_map(|v| std::iter::once(v.p).chain(both.then_some(v.q)))
        .collect();
    seeds.sort_unstable();
    seeds.dedup();
    let near = seeds
        .first()
        .map_or(Point::origin(), |&s| list[s as usize].position);
    let refuse = |t: Isometry, reason: String| Refusal {
        class,
        q_from_p: t,
        height: cluster.height,
        reason,
        near,
    };
    let tolerance = params.tolerance_of(class);
    let rounds: &[f64] = if both { &MIRROR_ROUNDS } else { &MOTION_ROUNDS };
    let mut grown = Vec::new();
    for (k, round) in rounds.iter().enumerate() {
        grown = reach(ground, &t, round * tolerance, params.min_cos, &seeds);
        if grown.is_empty() {
            return Err(refuse(t, "its votes do not hold on the surface".into()));
        }
        let mut contacts = contacts(ground, &grown);
        if k + ROBUST >= rounds.len() {
            weigh(&t, &mut contacts);
        }
        t = refine(&t, class, &contacts);
    }
    judge(ground, grown, t, class, cluster.height, params).map_err(|reason| refuse(t, reason))
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

/// The samples that can be reached from a seed over neighbours whose images touch the surface, by
/// sample.
fn reach(
    ground: &Ground<'_>,
    t: &Isometry,
    tolerance: f64,
    min_cos: f64,
    seeds: &[u32],
) -> Vec<PatchPair> {
    let samples = ground.samples;
    let mut seen = vec![false; samples.list.len()];
    let mut front: Vec<u32> = seeds.to_vec();
    for &s in seeds {
        seen[s as usize] = true;
    }
    let mut grown = Vec::new();
    while !front.is_empty() {
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
