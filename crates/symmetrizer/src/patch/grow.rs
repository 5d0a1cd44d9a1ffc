//! Verification and region growing: how far over the surface a cluster's mirror holds.

use rayon::prelude::*;

use crate::cluster::Cluster;
use crate::geom::{Point, PointIndex, Vector};
use crate::pair::Pair;
use crate::patch::refine::{Contact, refine_plane};
use crate::patch::symmetry::{PatchPair, Refusal, Symmetry};
use crate::sample::{Sample, Samples};
use crate::shape::{ClosestPoint, Surface};
use crate::transform::{Ambient, Correspondence, Isometry, MirrorFit, Plane, optimal_mirror};

/// When a mirror holds for a part of the surface.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PatchParams {
    /// Largest distance of a mirrored sample from the surface, fraction of L. 0.02, ours.
    pub tolerance: f64,
    /// Smallest cosine between mirrored and found normal. 0.75, ours (41 degrees).
    pub min_cos: f64,
    /// Smallest share of the surface's area for a symmetry. 0.08, ours.
    pub min_area: f64,
    /// Largest confusion of the pairs, see [`Symmetry::confusion`]. 0.12, ours: true mirrors of the
    /// models stay below .105, those of shapes without symmetry start at .138.
    pub max_confusion: f64,
    /// Largest sum of the rms residual, in units of the tolerance, and the confusion: a surface that
    /// merely passes by fills the tolerance evenly (rms .58) and looks like many places. 0.6, ours:
    /// true mirrors of the models reach .58, the arms of a chiral shape start at .61.
    pub max_doubt: f64,
    /// Smallest height of a symmetry's cluster, as a share of the highest: what fewer votes speak for
    /// is chance. 0.1, ours.
    pub min_height: f64,
}

impl Default for PatchParams {
    fn default() -> Self {
        Self {
            tolerance: 0.02,
            min_cos: 0.75,
            min_area: 0.08,
            max_confusion: 0.12,
            max_doubt: 0.6,
            min_height: 0.1,
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

/// Tolerances of the growing rounds, in units of [`PatchParams::tolerance`]: wide first, while the
/// cluster's plane is still rough.
const ROUNDS: [f64; 6] = [2.5, 2.0, 1.5, 1.0, 1.0, 1.0];

/// Grows the patch of `cluster`: from the places that voted for it, over neighbouring samples,
/// as long as their mirror images lie on the surface; the mirror is refitted as the patch grows.
///
/// # Errors
/// [`Refusal`] where no symmetry worth the name comes out, with the reason.
pub fn grow_patch(
    ground: &Ground<'_>,
    pairs: &[Pair],
    cluster: &Cluster,
    params: &PatchParams,
) -> Result<Symmetry, Refusal> {
    let list = &ground.samples.list;
    let votes: Vec<Correspondence> = cluster
        .votes
        .iter()
        .map(|&i| &pairs[i as usize])
        .map(|v| Correspondence {
            p: list[v.p as usize].position,
            q: list[v.q as usize].position,
            weight: v.weight,
        })
        .collect();
    let refuse = |plane: Plane, reason: String| Refusal {
        plane,
        height: cluster.height,
        reason,
        near: votes.first().map_or(Point::origin(), |v| v.p),
    };
    let Some(first) = optimal_mirror(&votes, Ambient::Space) else {
        let plane = Plane {
            normal: Vector::x(),
            offset: 0.0,
        };
        return Err(refuse(
            plane,
            "its votes leave the mirror undetermined".into(),
        ));
    };
    let mut plane = first.plane;
    let seeds: Vec<u32> = cluster
        .votes
        .iter()
        .flat_map(|&i| [pairs[i as usize].p, pairs[i as usize].q])
        .collect();
    let mut grown = Vec::new();
    for round in ROUNDS {
        let touched = touch(ground, &plane, round * params.tolerance, params.min_cos);
        grown = connected(ground.samples, touched, &seeds);
        if grown.is_empty() {
            return Err(refuse(plane, "its votes do not hold on the surface".into()));
        }
        plane = refine_plane(&plane, &contacts(ground, &grown));
    }
    assess(ground, grown, plane, cluster.height, params).map_err(|reason| refuse(plane, reason))
}

/// For each sample the closest facing surface point to its mirror image, where it is near enough.
pub fn touch(
    ground: &Ground<'_>,
    plane: &Plane,
    tolerance: f64,
    min_cos: f64,
) -> Vec<Option<PatchPair>> {
    let mirror = Isometry::mirror(plane);
    ground
        .samples
        .list
        .par_iter()
        .enumerate()
        .map(|(i, s)| {
            let image = mirror.apply(&s.position);
            let normal = mirror.rotate(&s.normal);
            let hit = ground
                .closest
                .nearest_facing(&image, &normal, min_cos, tolerance)?;
            Some(PatchPair {
                sample: i as u32,
                partner: hit.at,
                residual: hit.distance,
            })
        })
        .collect()
}

/// The samples that can be reached from a seed over touched neighbours.
fn connected(samples: &Samples, touched: Vec<Option<PatchPair>>, seeds: &[u32]) -> Vec<PatchPair> {
    let mut reached = vec![false; touched.len()];
    let mut stack: Vec<u32> = Vec::new();
    for &s in seeds {
        if touched[s as usize].is_some() && !reached[s as usize] {
            reached[s as usize] = true;
            stack.push(s);
        }
    }
    while let Some(s) = stack.pop() {
        for &t in &samples.neighbors[s as usize] {
            if touched[t as usize].is_some() && !reached[t as usize] {
                reached[t as usize] = true;
                stack.push(t);
            }
        }
    }
    touched
        .into_iter()
        .zip(reached)
        .filter_map(|(pair, reached)| pair.filter(|_| reached))
        .collect()
}

fn contacts(ground: &Ground<'_>, grown: &[PatchPair]) -> Vec<Contact> {
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

/// The symmetry of a grown patch, or the reason why it is none.
fn assess(
    ground: &Ground<'_>,
    grown: Vec<PatchPair>,
    plane: Plane,
    height: f64,
    params: &PatchParams,
) -> Result<Symmetry, String> {
    let count = ground.samples.list.len();
    let area_fraction = grown.len() as f64 / count as f64;
    if area_fraction < params.min_area {
        return Err(format!(
            "holds for {:.1} % of the surface only",
            100.0 * area_fraction
        ));
    }
    let fit = mirror_of(ground, &grown).ok_or("its pairs leave the mirror undetermined")?;
    if !fit.is_well_conditioned() {
        return Err(format!(
            "badly conditioned: explains {:.2} of its pairs, eigenvalue gap {:.2}",
            fit.explained, fit.gap
        ));
    }
    let confusion = confusion(ground, &grown);
    if confusion > params.max_confusion {
        return Err(format!(
            "partners look no more alike than many other places (confusion {confusion:.2})"
        ));
    }
    let mean_square = grown.iter().map(|p| p.residual.powi(2)).sum::<f64>() / grown.len() as f64;
    let rms = mean_square.sqrt();
    if rms / params.tolerance + confusion > params.max_doubt {
        return Err(format!(
            "its image passes by the surface rather than lies on it (rms {:.2} of the tolerance, \
             confusion {confusion:.2})",
            rms / params.tolerance
        ));
    }
    Ok(Symmetry {
        id: 0,
        plane: plane.canonical(),
        height,
        area_fraction,
        rms,
        confusion,
        explained: fit.explained,
        gap: fit.gap,
        pairs: grown,
    })
}

/// Appendix A over a patch's pairs.
pub fn mirror_of(ground: &Ground<'_>, pairs: &[PatchPair]) -> Option<MirrorFit> {
    let pairs: Vec<Correspondence> = pairs
        .iter()
        .map(|pair| Correspondence {
            p: ground.samples.list[pair.sample as usize].position,
            q: ground.surface.point(&pair.partner),
            weight: 1.0,
        })
        .collect();
    optimal_mirror(&pairs, Ambient::Space)
}

/// The median, over the pairs, of the share of all samples that look more like the sample than what
/// lies at its partner's place. Pairs across less than the widest curvature radius see the same
/// ground from both sides and do not count.
fn confusion(ground: &Ground<'_>, grown: &[PatchPair]) -> f64 {
    let list = &ground.samples.list;
    let places: Vec<[f64; 3]> = list.iter().map(|s| s.position.coords.into()).collect();
    let index = PointIndex::new(&places);
    let too_near = 2.0 * ground.samples.radius;
    let mut ranks: Vec<f64> = grown
        .par_iter()
        .filter_map(|pair| {
            let s = &list[pair.sample as usize];
            let y = ground.surface.point(&pair.partner);
            if (y - s.position).norm() < too_near {
                return None;
            }
            let normal = ground.surface.normal(&pair.partner);
            let distance = |t: &Sample| (t.position - y).norm_squared();
            let there = index
                .within(&y.coords.into(), 1.5 * ground.samples.spacing)
                .into_iter()
                .map(|j| &list[j as usize])
                .filter(|t| t.normal.dot(&normal) > 0.5)
                .min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
            let gap = s.signature.distance(&there.signature)?;
            let closer = list
                .iter()
                .filter(|t| s.signature.distance(&t.signature).is_some_and(|d| d < gap))
                .count();
            Some(closer as f64 / list.len() as f64)
        })
        .collect();
    median(&mut ranks).unwrap_or(1.0)
}

fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}
