//! The schedule of section 4.2: contract the clusters, the biggest first, then merge them greedily,
//! then make the whole symmetric under the final mirror.

use crate::context::Context;
use crate::deform::{DeformParams, Deformer, Igarashi, deformer};
use crate::detect::{DetectParams, Detection, detect, detect_in_plane};
use crate::error::Result;
use crate::optimize::contract::{contract, contract_whole};
use crate::optimize::finish::finish;
use crate::optimize::merge::{merge, ownership};
use crate::optimize::moving::Moving;
use crate::optimize::outcome::{Optimized, Outcome, Step, mirrors, next_id};
use crate::optimize::params::OptimizeParams;
use crate::optimize::part::part;
use crate::optimize::tidy::tidied;
use crate::optimize::untangle::untangle;
use crate::patch::{Symmetry, carry_ids};
use crate::sample::{Sample, Samples};
use crate::shape::wall::Wall;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::{Class, Isometry, Plane};

/// Parameters of [`optimize`].
#[derive(Debug, Clone, Copy)]
pub struct Settings<'a> {
    /// Detection, for pairs that are found again on the way.
    pub detect: &'a DetectParams,
    /// The wall that the surface is, in the plane.
    pub wall: Option<&'a Wall>,
    /// Stiffness of each face, where it is not 1 everywhere.
    pub stiffness: Option<&'a [f64]>,
    /// How far each vertex may be changed, 0 to 1, where the symmetry holds for a part only.
    pub region: Option<&'a [f64]>,
    /// Whether only what the main mirror holds for is made symmetric in the end, and not the whole.
    pub part: bool,
    /// The deformation model.
    pub deform: &'a DeformParams,
    /// The schedule.
    pub optimize: &'a OptimizeParams,
}

/// Coverage that a merge must add to be kept.
const MIN_GAIN: f64 = 0.02;

/// The finish goes on until the asymmetry is this share of the input's, too.
const FINISH_SHARE: f64 = 0.085;

/// Merges tried at the most.
const MERGES: usize = 4;

/// Symmetrizes `surface` from what `detection` found on it.
///
/// # Errors
/// [`crate::Error::Params`], [`crate::Error::Numerical`], [`crate::Error::Cancelled`].
pub fn optimize(
    surface: &Surface,
    detection: &Detection,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Optimized> {
    settings.optimize.check()?;
    if mirrors(detection).next().is_none() {
        return Ok(Optimized::unmoved(surface, detection, Outcome::NoSymmetry));
    }
    let mut deformer = ctx.stage("prepare", |_| prepared(surface, settings))?;
    Schedule {
        moving: moving(surface, detection, settings, deformer.as_mut()),
        settings,
        symmetries: worthwhile(
            &detection.symmetries,
            settings,
            detection.samples.list.len(),
        ),
        region: settings.region.map(<[f64]>::to_vec),
        steps: Vec::new(),
        outcome: Outcome::Converged,
        failed: Vec::new(),
        next_id: next_id(detection),
    }
    .run(ctx)
}

/// Symmetries to enhance, the main one first: not far lower than the highest, by how much of the
/// surface they hold for and how well; of two that claim the same ground and cannot be merged, the
/// first.
fn worthwhile(found: &[Symmetry], settings: Settings<'_>, count: usize) -> Vec<Symmetry> {
    let highest = found.iter().map(|s| s.height).fold(0.0, f64::max);
    let rank = |s: &Symmetry| s.area_fraction * (1.0 - s.rms / settings.detect.patch.tolerance);
    let mut ordered: Vec<&Symmetry> = found
        .iter()
        .filter(|s| s.class == Class::Mirror)
        .filter(|s| s.height >= settings.optimize.min_height * highest)
        .collect();
    ordered.sort_by(|a, b| rank(b).total_cmp(&rank(a)));
    let mut kept: Vec<Symmetry> = Vec::new();
    for s in ordered {
        let conflict = |k: &Symmetry| {
            shared(k, s, count) > MAX_SHARED && !mergeable(k, s, settings.optimize, count)
        };
        if !kept.iter().any(conflict) {
            kept.push(s.clone());
        }
    }
    kept
}

/// A symmetry that shares more than this of its patch with a better one contradicts it, unless both
/// can be merged.
const MAX_SHARED: f64 = 0.6;

/// The share of the smaller patch that lies in both.
fn shared(a: &Symmetry, b: &Symmetry, count: usize) -> f64 {
    let (member_a, member_b) = (a.membership(count), b.membership(count));
    let both = member_a
        .iter()
        .zip(&member_b)
        .filter(|(a, b)| **a && **b)
        .count();
    both as f64 / a.pairs.len().min(b.pairs.len()).max(1) as f64
}

/// Whether two symmetries may be merged: mirrors not too far apart in angle, and enough ground of their own.
fn mergeable(s: &Symmetry, t: &Symmetry, params: &OptimizeParams, count: usize) -> bool {
    if s.plane().normal.dot(&t.plane().normal).abs() < params.merge_angle.to_radians().cos() {
        return false;
    }
    let owned = ownership(s, t, count);
    [s, t].iter().zip(&owned).all(|(s, own)| {
        let kept = own.iter().filter(|o| **o).count();
        2 * kept > s.pairs.len()
    })
}

/// Makes a surface that was `straightened` symmetric under the mirror `plane` that it got there: the last
/// contraction and the finish, until the asymmetry is `asymmetry_before` (that of the bent one, fraction of L) no
/// longer by far. The energy is that beside the straight shape.
///
/// # Errors
/// As [`optimize`].
pub fn complete(
    straightened: &Surface,
    plane: Plane,
    asymmetry_before: f64,
    detection: &Detection,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Optimized> {
    settings.optimize.check()?;
    let mut deformer = ctx.stage("prepare", |_| prepared(straightened, settings))?;
    let schedule = Schedule {
        moving: moving(straightened, detection, settings, deformer.as_mut()),
        settings,
        symmetries: Vec::new(),
        region: settings.region.map(<[f64]>::to_vec),
        steps: Vec::new(),
        outcome: Outcome::Converged,
        failed: Vec::new(),
        next_id: next_id(detection),
    };
    schedule.whole(plane, asymmetry_before, ctx)
}

/// The deformer over `surface`.
///
/// # Errors
/// As [`deformer`].
pub fn prepared(surface: &Surface, settings: Settings<'_>) -> Result<Box<dyn Deformer>> {
    let mut deformer: Box<dyn Deformer> = match settings.wall {
        Some(wall) => Box::new(Igarashi::new(wall.moved(surface.positions.clone()))?),
        None => deformer(surface, settings.deform)?,
    };
    if let Some(stiffness) = settings.stiffness {
        deformer.set_stiffness(stiffness)?;
    }
    Ok(deformer)
}

/// The samples of a detection on a `surface` that a deformer moves.
pub fn moving<'a>(
    surface: &Surface,
    detection: &Detection,
    settings: Settings<'_>,
    deformer: &'a mut dyn Deformer,
) -> Moving<'a> {
    Moving {
        samples: detection.samples.clone(),
        length: settings.deform.length,
        step: settings.optimize.step,
        closest: ClosestPoint::new(surface),
        deformer,
    }
}

struct Schedule<'a> {
    moving: Moving<'a>,
    settings: Settings<'a>,
    symmetries: Vec<Symmetry>,
    /// How far each vertex may be changed in the end, where it is not the whole surface.
    region: Option<Vec<f64>>,
    steps: Vec<Step>,
    outcome: Outcome,
    /// Ids of symmetries whose merge was undone.
    failed: Vec<[u32; 2]>,
    /// The id that the next new symmetry gets; ids are never reused.
    next_id: u32,
}

impl Schedule<'_> {
    fn run(mut self, ctx: &mut Context<'_>) -> Result<Optimized> {
        let asymmetry_before = self.asymmetry(&self.main().plane());
        ctx.stage("contract", |ctx| self.contract_all(ctx))?;
        if self.outcome != Outcome::EnergyLimit {
            ctx.stage("merge", |ctx| self.merge_all(ctx))?;
        }
        if self.settings.part {
            let now = self.moving.snapshot();
            self.region = Some(part(&now.surface, &now.samples, self.main()));
        }
        let plane = self.main().plane();
        self.whole(plane, asymmetry_before, ctx)
    }

    /// The last contraction and the finish, under the mirror of the whole.
    fn whole(
        mut self,
        mut plane: Plane,
        asymmetry_before: f64,
        ctx: &mut Context<'_>,
    ) -> Result<Optimized> {
        let wanted = self.settings.optimize.final_steps > 0;
        if wanted && self.outcome != Outcome::EnergyLimit {
            plane = ctx.stage("contract whole", |ctx| self.contract_whole(plane, ctx))?;
        }
        let mut positions = self.moving.deformer.positions();
        if self.outcome != Outcome::EnergyLimit && self.settings.optimize.finish_rounds > 0 {
            let now = self.moving.deformer.rest().with_positions(positions);
            let params = self.settings.optimize;
            let goal = params.finish_asymmetry.min(FINISH_SHARE * asymmetry_before);
            let settings = Settings {
                region: self.region.as_deref(),
                ..self.settings
            };
            let done = ctx.stage("finish", |ctx| finish(&now, plane, goal, settings, ctx))?;
            self.steps.push(Step::Finish {
                rounds: done.rounds,
                asymmetry: done.asymmetry,
                undone: done.undone,
            });
            plane = done.plane;
            positions = done.positions;
        }
        if let Some(wall) = self.settings.wall {
            // Thin limbs that were pressed together have no thickness to keep them apart.
            let rest = self.moving.deformer.rest();
            positions = untangle(rest, rest.with_positions(positions)).0.positions;
            positions = tidied(wall, positions, &plane)?;
        }
        Ok(Optimized {
            positions,
            plane: Some(plane),
            outcome: self.outcome,
            steps: self.steps,
            energy: self.moving.deformer.energy(),
            next_id: self.next_id,
            goals: Vec::new(),
        })
    }

    /// The symmetry that the whole is to have: the one that holds for most of the surface, best.
    fn main(&self) -> &Symmetry {
        &self.symmetries[0]
    }

    /// Mean distance of the mirrored samples from the surface under `plane`, fraction of L.
    fn asymmetry(&self, plane: &Plane) -> f64 {
        let now = self.moving.snapshot();
        let mirror = Isometry::mirror(plane);
        let list = &now.samples.list;
        let distances = list.iter().map(|s| {
            let hit = now
                .closest
                .nearest(&mirror.apply(&s.position), f64::INFINITY);
            hit.map_or(0.0, |hit| hit.distance)
        });
        distances.sum::<f64>() / list.len().max(1) as f64
    }

    fn contract_all(&mut self, ctx: &mut Context<'_>) -> Result<()> {
        let params = self.settings.optimize;
        let count = self.symmetries.len();
        for k in 0..count {
            ctx.progress(k as f64 / count as f64)?;
            let s = &self.symmetries[k];
            let patch = &self.settings.detect.patch;
            let steps = params.contract_steps;
            let done = contract(&mut self.moving, s, steps, patch, params, ctx)?;
            self.steps.push(Step::Contract {
                symmetry: s.id,
                steps: done.steps,
                couples: done.couples,
                cost: done.cost,
                energy: done.energy,
            });
            self.symmetries[k].q_from_p = Isometry::mirror(&done.plane);
            if done.limited {
                self.outcome = Outcome::EnergyLimit;
                break;
            }
        }
        Ok(())
    }

    /// Greedy merging by distance in transformation space; after each merge the symmetries are found
    /// again, and a merge that gained no ground is undone.
    fn merge_all(&mut self, ctx: &mut Context<'_>) -> Result<()> {
        for _ in 0..MERGES {
            let Some((i, j)) = self.next_merge() else {
                break;
            };
            let before = self.moving.deformer.state();
            let covered = coverage(&self.symmetries);
            let (s, t) = (&self.symmetries[i], &self.symmetries[j]);
            let ids = [s.id, t.id];
            let patch = &self.settings.detect.patch;
            let done = merge(&mut self.moving, [s, t], patch, self.settings.optimize, ctx)?;
            let (samples, found) = self.detect_again(ctx)?;
            // At the energy limit the merge stays as far as it came.
            let kept = done.limited || coverage(&found) > covered + MIN_GAIN;
            self.steps.push(Step::Merge {
                symmetries: ids,
                steps: done.steps,
                distance: done.distance,
                coverage: [covered, coverage(&found)],
                energy: done.energy,
                kept,
            });
            if kept {
                self.moving.samples = samples;
                self.symmetries = found;
            } else {
                self.moving.deformer.restore(&before);
                self.failed.push(ids);
                continue;
            }
            if done.distance[1] >= self.settings.optimize.merged_distance {
                self.outcome = Outcome::StepLimit;
            }
            if done.limited {
                self.outcome = Outcome::EnergyLimit;
                break;
            }
        }
        Ok(())
    }

    /// The nearest two symmetries that may be merged.
    fn next_merge(&self) -> Option<(usize, usize)> {
        let count = self.moving.samples.list.len();
        let space = crate::transform::TransformSpace::new(
            self.moving.samples.list.iter().map(|s| (s.position, 1.0)),
        );
        let mut best: Option<(f64, usize, usize)> = None;
        for i in 0..self.symmetries.len() {
            for j in i + 1..self.symmetries.len() {
                let (s, t) = (&self.symmetries[i], &self.symmetries[j]);
                if self.failed.contains(&[s.id, t.id]) {
                    continue;
                }
                if !mergeable(s, t, self.settings.optimize, count) {
                    continue;
                }
                let mirrors = (s.q_from_p, t.q_from_p);
                let distance = space.distance(&mirrors.0, &mirrors.1);
                if best.as_ref().is_none_or(|b| distance < b.0) {
                    best = Some((distance, i, j));
                }
            }
        }
        best.map(|(_, i, j)| (i, j))
    }

    /// Detection on the shape as it is now; what was known keeps its id.
    fn detect_again(&mut self, ctx: &mut Context<'_>) -> Result<(Samples, Vec<Symmetry>)> {
        let rest = self.moving.deformer.rest();
        let positions = self.moving.deformer.positions();
        let found = match self.settings.wall {
            Some(wall) => detect_in_plane(&wall.moved(positions), self.settings.detect, ctx)?,
            None => detect(&rest.with_positions(positions), self.settings.detect, ctx)?,
        };
        let mut symmetries = worthwhile(&found.symmetries, self.settings, found.samples.list.len());
        let known = (&self.moving.samples, self.symmetries.as_slice());
        self.next_id = carry_ids(rest, known, (&found.samples, &mut symmetries), self.next_id);
        Ok((found.samples, symmetries))
    }

    fn contract_whole(&mut self, plane: Plane, ctx: &mut Context<'_>) -> Result<Plane> {
        let triangles = self.moving.deformer.rest().triangles.clone();
        let region = self.region.as_deref();
        let inside = |s: &Sample| {
            let corners = triangles[s.at.face as usize].iter().zip(s.at.bary);
            let share = |region: &[f64]| corners.map(|(&v, b)| b * region[v as usize]).sum::<f64>();
            region.is_none_or(|region| share(region) >= 0.5)
        };
        let params = self.settings.optimize;
        let done = contract_whole(&mut self.moving, plane, inside, params, ctx)?;
        self.steps.push(Step::ContractWhole {
            steps: done.steps,
            couples: done.couples,
            cost: done.cost,
            energy: done.energy,
        });
        if done.limited {
            self.outcome = Outcome::EnergyLimit;
        }
        Ok(done.plane)
    }
}

/// The largest share of the surface that one mirror holds for.
fn coverage(symmetries: &[Symmetry]) -> f64 {
    symmetries
        .iter()
        .map(|s| s.area_fraction)
        .fold(0.0, f64::max)
}
