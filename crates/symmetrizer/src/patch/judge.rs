//! Whether a grown patch is a symmetry: area, conditioning, confusion, doubt.

use rayon::prelude::*;

use crate::geom::{Ambient, Point, PointIndex, Vector, median};
use crate::patch::ground::{Ground, contacts, image};
use crate::patch::likeness::unlikeness;
use crate::patch::params::PatchParams;
use crate::patch::refine::{Contact, firmness};
use crate::patch::settle::passing;
use crate::patch::symmetry::{PatchPair, Symmetry};
use crate::sample::Sample;
use crate::sample::samples::Describer;
use crate::transform::{Class, Correspondence, Isometry, MirrorFit, optimal_mirror};

/// A patch to be judged.
pub struct Grown {
    /// The isometry.
    pub t: Isometry,
    /// Its class.
    pub class: Class,
    /// Height of its cluster.
    pub height: f64,
    /// The pairs.
    pub pairs: Vec<PatchPair>,
    /// How far apart contacts may be, fraction of L.
    pub reached: f64,
    /// Whether it follows from other symmetries.
    pub near: bool,
}

/// A motion that follows from other symmetries needs less evidence of its own by this factor,
const DERIVED: f64 = 1.5;
/// where its patch holds it at least this firmly, times its share of the surface: copies of solid
/// elements do, pieces of a wall or of an ear that would slide by a little do not.
const FIRM: f64 = 0.005;

/// The symmetry of a grown patch, or the reason why it is none.
pub fn judge(
    ground: &Ground<'_>,
    describer: &Describer<'_>,
    grown: Grown,
    params: &PatchParams,
) -> Result<Symmetry, String> {
    let Grown { t, class, .. } = grown;
    let squares = grown.pairs.iter().map(|p| p.residual.powi(2));
    let rms = (squares.sum::<f64>() / grown.pairs.len() as f64).sqrt();
    let image = match class {
        Class::Mirror => grown.pairs.iter().map(|p| p.sample).collect(),
        Class::Proper | Class::Improper => image(ground, &grown.pairs),
    };
    let verdict = Judged {
        area_fraction: covered(&grown.pairs, &image, ground.samples.list.len()),
        filled: rms / grown.reached,
    };
    let Verdict {
        confusion,
        is_evident,
    } = match class {
        Class::Mirror => verdict.mirror(ground, &grown, params)?,
        Class::Proper | Class::Improper => verdict.motion(ground, describer, &grown, params)?,
    };
    let q_from_p = match class {
        Class::Mirror => Isometry::mirror(&t.nearest_mirror(&Point::origin()).canonical()),
        Class::Proper | Class::Improper => t,
    };
    Ok(Symmetry {
        id: 0,
        class,
        q_from_p,
        height: grown.height,
        area_fraction: verdict.area_fraction,
        rms,
        confusion,
        doubt: verdict.filled + 2.0 * confusion,
        is_evident,
        is_of_whole: false,
        pairs: grown.pairs,
        image,
    })
}

/// What is judged of a patch.
struct Judged {
    /// Patch and image as a share of the surface.
    area_fraction: f64,
    /// The rms residual in units of what the patch was grown to.
    filled: f64,
}

struct Verdict {
    confusion: f64,
    is_evident: bool,
}

impl Judged {
    fn mirror(
        &self,
        ground: &Ground<'_>,
        grown: &Grown,
        params: &PatchParams,
    ) -> Result<Verdict, String> {
        if self.area_fraction < params.min_area {
            return Err(too_small(self.area_fraction));
        }
        well_conditioned(ground, &grown.pairs)?;
        let confusion = confusion(ground, &grown.pairs);
        if confusion > params.max_confusion {
            return Err(unlike(confusion));
        }
        Ok(Verdict {
            confusion,
            is_evident: true,
        })
    }

    /// A motion must hold its patch, end where the shape does, and have partners that look alike; what
    /// is known and firm is granted [`DERIVED`].
    fn motion(
        &self,
        ground: &Ground<'_>,
        describer: &Describer<'_>,
        grown: &Grown,
        params: &PatchParams,
    ) -> Result<Verdict, String> {
        let slack = if grown.near { DERIVED } else { 1.0 };
        if self.area_fraction < params.min_copy / slack {
            return Err(too_small(self.area_fraction));
        }
        let firmness = held(
            &contacts(ground, &grown.pairs),
            ground.samples.ambient,
            params.min_firmness,
        )?;
        let firm = firmness * self.area_fraction >= FIRM;
        let slack = if firm { slack } else { 1.0 };
        let drift = (self.filled / params.max_filled).max(rim(ground, grown) / params.max_rim);
        if drift > slack {
            return Err(passing(self.filled));
        }
        let unlikeness = unlikeness(ground, describer, &grown.t, &grown.pairs);
        if unlikeness > slack * params.max_unlikeness {
            return Err(unlike(unlikeness));
        }
        let is_evident = self.area_fraction >= params.min_copy
            && drift <= 1.0
            && unlikeness <= params.max_unlikeness;
        if !(is_evident || firm) {
            return Err(too_small(self.area_fraction));
        }
        Ok(Verdict {
            confusion: unlikeness,
            is_evident,
        })
    }
}

fn unlike(confusion: f64) -> String {
    format!("partners look no more alike than many other places ({confusion:.2})")
}

/// The rms residual where a patch ends, in units of what it was grown to: a copy ends where the shape
/// does something else, a surface that passes by drifts away.
fn rim(ground: &Ground<'_>, grown: &Grown) -> f64 {
    let samples = ground.samples;
    let mut member = vec![false; samples.list.len()];
    for pair in &grown.pairs {
        member[pair.sample as usize] = true;
    }
    let ends = |p: &&PatchPair| {
        let near = &samples.neighbors[p.sample as usize];
        near.iter().any(|&n| !member[n as usize])
    };
    let (mut sum, mut count) = (0.0, 0);
    for pair in grown.pairs.iter().filter(ends) {
        sum += pair.residual * pair.residual;
        count += 1;
    }
    if count == 0 {
        return 0.0;
    }
    (sum / f64::from(count)).sqrt() / grown.reached
}

/// The share of all samples that lie in a patch or in its image.
fn covered(grown: &[PatchPair], image: &[u32], count: usize) -> f64 {
    let mut member = vec![false; count];
    let patch = grown.iter().map(|p| p.sample);
    for s in patch.chain(image.iter().copied()) {
        member[s as usize] = true;
    }
    member.iter().filter(|m| **m).count() as f64 / count.max(1) as f64
}

/// Why a patch of this share of the surface is refused.
pub fn too_small(area_fraction: f64) -> String {
    let percent = 100.0 * area_fraction;
    format!("holds for {percent:.1} % of the surface only")
}

/// The conditioning of a mirror's fit: eigenvalue gap and explained share.
fn well_conditioned(ground: &Ground<'_>, grown: &[PatchPair]) -> Result<(), String> {
    let fit = mirror_of(ground, grown).ok_or("its pairs leave the mirror undetermined")?;
    if !fit.is_well_conditioned() {
        return Err(format!(
            "badly conditioned: explains {:.2} of its pairs, eigenvalue gap {:.2}",
            fit.explained, fit.gap
        ));
    }
    Ok(())
}

/// How firmly its contacts hold a motion, which does move them.
fn held(contacts: &[Contact], ambient: Ambient, min_firmness: f64) -> Result<f64, String> {
    let firmness = firmness(contacts, ambient);
    if firmness < min_firmness {
        return Err(format!("slides along itself (firmness {firmness:.3})"));
    }
    let moved = contacts.iter().map(|c| (c.y - c.x).norm_squared());
    let places = contacts.iter().map(|c| c.x.coords);
    let center = places.clone().sum::<Vector>() / contacts.len() as f64;
    let size: f64 = places.map(|x| (x - center).norm_squared()).sum();
    if moved.sum::<f64>() < MIN_MOTION * MIN_MOTION * size {
        return Err("hardly moves its patch".into());
    }
    Ok(firmness)
}

/// A motion moves its patch by at least this much, rms, in units of the patch's own rms radius.
const MIN_MOTION: f64 = 0.4;

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
    optimal_mirror(&pairs, ground.samples.ambient)
}

/// The median, over the pairs, of the share of all samples that look more like the sample than what
/// lies at its partner's place. Pairs across less than the widest curvature radius see the same
/// ground from both sides and do not count.
pub fn confusion(ground: &Ground<'_>, grown: &[PatchPair]) -> f64 {
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
