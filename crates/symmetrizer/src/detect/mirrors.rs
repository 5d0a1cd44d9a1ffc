//! The mirrors among the modes of their cloud.

use crate::cluster::{Cluster, ClusterParams};
use crate::context::Context;
use crate::detect::Cloud;
use crate::detect::apart::apart;
use crate::detect::pass::{Explain, Pass, explain_near};
use crate::detect::search::Found;
use crate::detect::surroundings::{Surroundings, as_good, is_same};
use crate::error::Result;
use crate::pair::mirror_pairs;
use crate::patch::ground::touch;
use crate::patch::{Ground, Refusal, Symmetry};
use crate::transform::{Class, Isometry};

/// Kernel radius of the second pass, in units of that of the first: parts of a bend, whose mirrors are near
/// each other, are one mode in the wider.
const FINER: f64 = 0.7;
/// A doubtful mirror may be one of several that support each other up to this doubt; ours.
const MAX_SUPPORTED: f64 = 1.1;
/// Mirrors that support each other hold for at least this share of the surface; ours.
const MIN_SUPPORTED: f64 = 0.5;

/// Mirrors in three passes: first those of different ground, each taking the votes of its patch with it;
/// the same once more among the places that none holds for, paired anew; then those that share their
/// ground with one found already and hold there as well as it does.
pub fn mirrors(
    surroundings: &Surroundings<'_>,
    clusters: Vec<Cluster>,
    cloud: &mut Cloud,
    ctx: &mut Context<'_>,
) -> Result<Found> {
    let mut found = Found::default();
    let all = cloud.votes.clone();
    let wide = Pass {
        explain: Explain::Ground,
        kernel: surroundings.params.cluster.clone(),
        highest: 0.0,
    };
    wide.take(surroundings, clusters, cloud, &mut found, ctx)?;
    let large = |s: &Symmetry| s.area_fraction >= MIN_SUPPORTED;
    if found.symmetries.is_empty() && !found.doubtful.iter().any(large) {
        return Ok(found);
    }
    if let Some(mut rest) = rest(surroundings, &found.symmetries, ctx)? {
        let guided = Pass {
            explain: Explain::Ground,
            kernel: surroundings.params.cluster.clone(),
            highest: found.highest(),
        };
        let clusters = rest.clusters(&guided.kernel);
        guided.take(surroundings, clusters, &mut rest, &mut found, ctx)?;
    }
    let explained = std::mem::replace(&mut cloud.votes, all);
    let bandwidth = FINER * surroundings.params.cluster.bandwidth;
    let known: Vec<Isometry> = found.symmetries.iter().map(|s| s.q_from_p).collect();
    let in_the_finer = |t| cloud.votes.density(&surroundings.space.embed(t), bandwidth);
    let fine = Pass {
        explain: Explain::Mode,
        kernel: ClusterParams { bandwidth },
        highest: known.iter().map(in_the_finer).fold(0.0, f64::max),
    };
    for t in &known {
        explain_near(cloud, surroundings, t);
    }
    let clusters = cloud.clusters(&fine.kernel);
    fine.take(surroundings, clusters, cloud, &mut found, ctx)?;
    cloud.votes = explained;
    consistent(surroundings, &mut found);
    apart(surroundings, &mut found.symmetries);
    Ok(found)
}

/// The votes among places that none of the mirrors found holds for, paired anew: each finds its partner
/// among fewer.
fn rest(
    surroundings: &Surroundings<'_>,
    mirrors: &[Symmetry],
    ctx: &mut Context<'_>,
) -> Result<Option<Cloud>> {
    let Surroundings {
        ground,
        space,
        params,
        ..
    } = surroundings;
    let patch = &params.patch;
    let mut left = vec![true; ground.samples.list.len()];
    for s in mirrors {
        let touched = touch(ground, &s.q_from_p, 0.5 * patch.tolerance, patch.min_cos);
        for (l, t) in left.iter_mut().zip(touched) {
            *l &= t.is_none();
        }
    }
    let count = left.iter().filter(|l| **l).count();
    if (count as f64) < patch.min_area * left.len() as f64 || mirrors.is_empty() {
        return Ok(None);
    }
    let pairs = mirror_pairs(ground.samples, Some(&left), &params.pair, ctx)?;
    let within = (*space, ground.samples.ambient);
    Ok(Some(Cloud::new(Class::Mirror, pairs, within)))
}

impl Found {
    /// The height of the highest symmetry.
    fn highest(&self) -> f64 {
        self.symmetries.iter().map(|s| s.height).fold(0.0, f64::max)
    }

    /// Keeps a doubtful mirror for [`consistent`].
    pub fn put_aside(&mut self, symmetry: Symmetry, ground: &Ground<'_>) {
        let doubt = symmetry.doubt;
        let reason = format!(
            "doubtful ({doubt:.2}): partners look no more alike than many other places (confusion \
             {:.2}), its image passes by the surface, or as many votes come by chance",
            symmetry.confusion
        );
        if doubt <= MAX_SUPPORTED {
            self.doubtful.push(symmetry.clone());
        }
        self.refused.push(*symmetry.refuse(reason, ground.samples));
    }
}

/// Accepts doubtful mirrors that support each other: three of which one is the mirror image of the
/// second in the third, as the planes of a three-fold or higher axis are. Two planes at right angles
/// are no support: any roundish shape has some.
fn consistent(surroundings: &Surroundings<'_>, found: &mut Found) {
    let Surroundings {
        ground,
        space,
        params,
        ..
    } = surroundings;
    let near = 0.5 * params.cluster.bandwidth;
    let doubtful = found.doubtful.iter();
    let doubtful = doubtful.filter(|s| s.area_fraction >= MIN_SUPPORTED);
    let all: Vec<Symmetry> = found.symmetries.iter().chain(doubtful).cloned().collect();
    let third = |a: &Isometry, b: &Isometry| {
        let image = a.after(&b.after(a));
        let apart = space.distance(&image, a) > near && space.distance(&image, b) > near;
        apart
            && all
                .iter()
                .any(|c| space.distance(&image, &c.q_from_p) < near)
    };
    for s in std::mem::take(&mut found.doubtful) {
        let large = s.area_fraction >= MIN_SUPPORTED;
        let supported = large && all.iter().any(|b| third(&s.q_from_p, &b.q_from_p));
        let again = found.symmetries.iter().any(|k| is_same(k, &s, space, near));
        if again {
            continue;
        }
        if !supported {
            found.doubtful.push(s);
        } else if let Ok(s) = as_good(s, &found.symmetries, ground) {
            found
                .refused
                .retain(|r: &Refusal| space.distance(&r.q_from_p, &s.q_from_p) > 1e-9);
            found.symmetries.push(s);
        }
    }
}
