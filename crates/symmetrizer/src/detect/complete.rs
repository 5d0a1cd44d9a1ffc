//! What follows from what was found: products of symmetries whose patches meet, and mirrors beside
//! motions that nearly are ones. Each is verified on the surface like a mode of the votes.

use crate::context::Context;
use crate::detect::surroundings::{Surroundings, as_good, is_same};
use crate::error::Result;
use crate::geom::{Point, PointIndex};
use crate::patch::ground::touch;
use crate::patch::{Candidate, PatchPair, Symmetry, grow_patch};
use crate::transform::{Class, Isometry};

/// Products verified at the most.
const MOST: usize = 240;
/// Symmetries at the most: larger groups are a matter of a continuous one.
const MOST_FOUND: usize = 130;
/// Two patches meet when this share of the smaller one lies in both.
const MEETING: f64 = 0.3;
/// A product that does not stand by itself may hold worse than its better factor by this factor,
const AS_WELL: f64 = 1.5;
/// and by this much, fraction of L.
const SLACK: f64 = 1e-3;
/// A product that holds for this share of its smaller factor's ground holds for most of it.
const KEPT: f64 = 0.7;
/// An improper motion is tried as a mirror when one moves the surface to within this of it, rms fraction
/// of L.
const NEARLY_MIRROR: f64 = 0.04;
/// Less than this is no motion at all.
const MIN_MOTION: f64 = 0.05;

/// Adds to `symmetries` what follows from them and from `drifting`, motions that were refused.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub fn complete(
    surroundings: &Surroundings<'_>,
    symmetries: &mut Vec<Symmetry>,
    drifting: &[(Isometry, f64)],
    ctx: &mut Context<'_>,
) -> Result<()> {
    mirrors_beside(surroundings, symmetries);
    mirrors_of_drifting(surroundings, symmetries, drifting);
    let index = sample_index(surroundings);
    let mut asked: Vec<Isometry> = Vec::new();
    let mut next = 0;
    // Symmetries that are added take part in later products.
    while next < symmetries.len() && symmetries.len() < MOST_FOUND && asked.len() < MOST {
        ctx.progress(asked.len() as f64 / MOST as f64)?;
        for other in 0..=next {
            if !(symmetries[next].is_evident || symmetries[other].is_evident) {
                continue;
            }
            for (t, seeds) in products(surroundings, &index, &symmetries[next], &symmetries[other])
            {
                let near = 0.5 * surroundings.params.cluster.bandwidth;
                let alike = |k: &Isometry| same(surroundings, k, &t, near);
                let known = symmetries.iter().any(|s| alike(&s.q_from_p));
                if known || asked.iter().any(alike) || asked.len() >= MOST {
                    continue;
                }
                asked.push(t);
                let height = symmetries[next].height.min(symmetries[other].height);
                if let Some(s) = verified(surroundings, &t, seeds, height)
                    && tells(&s, [&symmetries[next], &symmetries[other]])
                    && !symmetries
                        .iter()
                        .any(|k| is_same(k, &s, surroundings.space, near))
                    && let Ok(s) = as_good(s, symmetries, surroundings.ground)
                {
                    symmetries.push(s);
                }
            }
        }
        next += 1;
    }
    Ok(())
}

/// Whether a product says more than its factors do: it holds for most of their ground, or carries its
/// patch to another place. What holds for a piece of theirs and lies on itself, as parts of an ear do
/// turned about it, says nothing. What does not stand by itself must hold as well as they do.
fn tells(product: &Symmetry, factors: [&Symmetry; 2]) -> bool {
    let [a, b] = factors.map(|f| f.area_fraction);
    let [r, s] = factors.map(|f| f.rms);
    if !product.is_evident && product.rms > AS_WELL * r.min(s) + SLACK {
        return false;
    }
    product.area_fraction >= KEPT * a.min(b) || product.leaves_its_place()
}

fn same(surroundings: &Surroundings<'_>, a: &Isometry, b: &Isometry, near: f64) -> bool {
    let space = surroundings.space;
    space.distance(a, b) < near || space.distance(a, &b.inverse()) < near
}

fn sample_index(surroundings: &Surroundings<'_>) -> PointIndex<3> {
    let list = &surroundings.ground.samples.list;
    let places: Vec<[f64; 3]> = list.iter().map(|s| s.position.coords.into()).collect();
    PointIndex::new(&places)
}

/// The candidate as a mirror where it is one, else as a motion; nothing where it does not hold.
fn verified(
    surroundings: &Surroundings<'_>,
    t: &Isometry,
    seeds: Vec<u32>,
    height: f64,
) -> Option<Symmetry> {
    let Surroundings {
        ground,
        describer,
        params,
        ..
    } = surroundings;
    let mirror = Isometry::mirror(&t.nearest_mirror(&Point::origin()));
    let is_mirror =
        t.is_improper() && surroundings.space.distance(t, &mirror) < 0.25 * NEARLY_MIRROR;
    let (t, class) = match (is_mirror, t.is_improper()) {
        (true, _) => (mirror, Class::Mirror),
        (false, true) => (*t, Class::Improper),
        (false, false) => (*t, Class::Proper),
    };
    if !params.wanted.classes().contains(&class) {
        return None;
    }
    // A product of motions holds where its factors do; a mirror's other side is no seed.
    let within = (class != Class::Mirror).then(|| ground.samples.around(&seeds, RINGS));
    let candidate = Candidate {
        t,
        class,
        height,
        seeds,
        within,
        near: true,
    };
    let s = grow_patch(ground, describer, &candidate, &params.patch).ok()?;
    surroundings.more_than_sliding(s).ok()
}

/// How many neighbours further than its factors a product may reach.
const RINGS: u32 = 3;

/// Motions a symmetry stands for: itself and its inverse, with their pairs.
fn directions(
    s: &Symmetry,
    index: &PointIndex<3>,
    surroundings: &Surroundings<'_>,
) -> Vec<Directed> {
    let surface = surroundings.ground.surface;
    let arrow = |pair: &PatchPair| {
        let place = surface.point(&pair.partner);
        Some((pair.sample, index.nearest(&place.coords.into())?.0))
    };
    let there: Vec<(u32, u32)> = s.pairs.iter().filter_map(arrow).collect();
    let mut all = vec![Directed {
        t: s.q_from_p,
        arrows: there.clone(),
    }];
    if s.class != Class::Mirror {
        all.push(Directed {
            t: s.q_from_p.inverse(),
            arrows: there.into_iter().map(|(p, q)| (q, p)).collect(),
        });
    }
    all
}

/// A motion and, for each sample of its patch, the sample it comes to lie on.
struct Directed {
    t: Isometry,
    arrows: Vec<(u32, u32)>,
}

/// The products of two symmetries, each way round, with the samples they are thought to hold for.
fn products(
    surroundings: &Surroundings<'_>,
    index: &PointIndex<3>,
    a: &Symmetry,
    b: &Symmetry,
) -> Vec<(Isometry, Vec<u32>)> {
    let count = surroundings.ground.samples.list.len();
    let (first, second) = (
        directions(a, index, surroundings),
        directions(b, index, surroundings),
    );
    let mut found = Vec::new();
    for x in &first {
        for y in &second {
            for (f, g) in [(x, y), (y, x)] {
                let mut starts = vec![false; count];
                for (p, _) in &g.arrows {
                    starts[*p as usize] = true;
                }
                let seeds: Vec<u32> = f
                    .arrows
                    .iter()
                    .filter(|(_, q)| starts[*q as usize])
                    .map(|(p, _)| *p)
                    .collect();
                let least = f.arrows.len().min(g.arrows.len());
                let t = g.t.after(&f.t);
                let moves = surroundings.space.distance(&t, &Isometry::identity()) > MIN_MOTION;
                if moves && seeds.len() as f64 > MEETING * least as f64 {
                    found.push((t, sorted(seeds)));
                }
            }
        }
    }
    found
}

fn sorted(mut seeds: Vec<u32>) -> Vec<u32> {
    seeds.sort_unstable();
    seeds.dedup();
    seeds
}

/// Improper motions that nearly are mirrors become ones where these hold.
fn mirrors_beside(surroundings: &Surroundings<'_>, symmetries: &mut Vec<Symmetry>) {
    let near = 0.5 * surroundings.params.cluster.bandwidth;
    let mut k = 0;
    while k < symmetries.len() {
        let s = &symmetries[k];
        let mirror = Isometry::mirror(&s.q_from_p.nearest_mirror(&Point::origin()));
        let beside = s.class == Class::Improper
            && surroundings.space.distance(&s.q_from_p, &mirror) < NEARLY_MIRROR;
        if beside {
            let ground = s.ground(surroundings.ground.samples.list.len());
            let seeds = (0..)
                .zip(&ground)
                .filter(|(_, m)| **m)
                .map(|(i, _)| i)
                .collect();
            let as_mirror = verified(surroundings, &mirror, seeds, s.height)
                .filter(|m| m.rms < 1.5 * s.rms + 1e-3 && m.area_fraction > 0.5 * s.area_fraction);
            if let Some(m) = as_mirror {
                let known = symmetries
                    .iter()
                    .any(|o| is_same(o, &m, surroundings.space, 0.2 * near));
                if known {
                    symmetries.remove(k);
                    continue;
                }
                symmetries[k] = m;
            }
        }
        k += 1;
    }
}

/// Doubt about a mirror found beside a drifting motion at the most, without that of chance; ours.
const MAX_DOUBT: f64 = 0.42;

/// Mirrors beside refused improper motions, the highest, where they hold as a part that moves as one
/// piece does: within a bend a mirror is never alone, and what votes for it drifts.
fn mirrors_of_drifting(
    surroundings: &Surroundings<'_>,
    symmetries: &mut Vec<Symmetry>,
    drifting: &[(Isometry, f64)],
) {
    let Surroundings {
        ground,
        space,
        params,
        ..
    } = surroundings;
    let near = 0.5 * params.cluster.bandwidth;
    let highest = drifting.iter().map(|d| d.1).fold(0.0, f64::max);
    let high = drifting
        .iter()
        .filter(|d| d.1 >= params.patch.min_height * highest);
    let mut asked: Vec<Isometry> = Vec::new();
    for (t, height) in high.filter(|d| d.0.is_improper()) {
        let mirror = Isometry::mirror(&t.nearest_mirror(&Point::origin()));
        let again = |k: &Isometry| space.distance(k, &mirror) < 0.5 * near;
        let found = symmetries.iter().any(|k| again(&k.q_from_p));
        if space.distance(t, &mirror) > NEARLY_MIRROR || found || asked.iter().any(again) {
            continue;
        }
        asked.push(mirror);
        let well = params.patch.copy_tolerance;
        let touched = touch(ground, &mirror, well, params.patch.min_cos);
        let seeds = touched.into_iter().flatten().map(|p| p.sample).collect();
        let Some(s) = verified(surroundings, &mirror, seeds, *height) else {
            continue;
        };
        let known = symmetries.iter().any(|k| is_same(k, &s, space, near));
        if s.doubt <= MAX_DOUBT
            && !known
            && let Ok(s) = as_good(s, symmetries, ground)
        {
            symmetries.push(s);
        }
    }
}
