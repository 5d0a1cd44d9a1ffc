//! Probes: samples where the surface has something to say, as dense as `count` of them can be.
//!
//! Even samples spend most of their number on flat ground when lively elements stand on a plain; two
//! copies of an element are then sampled at places too far apart to look alike.

use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::geom::PointIndex;
use crate::sample::blue_noise::{DARTS_PER_SAMPLE, spacing, spread};
use crate::sample::samples::{Describer, Sample, Samples};
use crate::sample::uniform::uniform;
use crate::shape::SurfacePoint;

/// Ground is lively whose relief has at least this share of the strength that a tenth of the surface
/// exceeds; ours.
const LIVELY: f64 = 0.5;

/// A probe and the even sample that stands for its place.
pub struct Probe {
    /// The sample.
    pub sample: Sample,
    /// Index of the even sample nearest to it.
    pub place: u32,
}

/// Those of the `samples` of an outline that lie where it has something to say: they are as dense as probes need be.
pub fn probes_of_outline(samples: &Samples) -> Vec<Probe> {
    let lively = lively(samples);
    let all = samples.list.iter().zip(lively).zip(0..);
    let probe = |((s, lively), place): ((&Sample, bool), u32)| {
        lively.then_some(Probe { sample: *s, place })
    };
    all.filter_map(probe).collect()
}

/// Which samples lie on lively ground.
fn lively(samples: &Samples) -> Vec<bool> {
    let strengths: Vec<f64> = samples.list.iter().map(|s| s.relief.strength()).collect();
    let mut sorted = strengths.clone();
    sorted.sort_by(f64::total_cmp);
    let high = sorted.get(sorted.len() * 9 / 10).copied().unwrap_or(0.0);
    strengths.iter().map(|s| *s > LIVELY * high).collect()
}

/// About `count` samples of the lively part of the describer's surface; none where there is no such part.
pub fn probes(
    describer: &Describer<'_>,
    samples: &Samples,
    count: usize,
    rng: &mut Pcg64,
) -> Vec<Probe> {
    let surface = describer.surface;
    let lively = lively(samples);
    let share = lively.iter().filter(|l| **l).count() as f64 / lively.len().max(1) as f64;
    if share == 0.0 {
        return Vec::new();
    }
    let places: Vec<[f64; 3]> = samples
        .list
        .iter()
        .map(|s| s.position.coords.into())
        .collect();
    let index = PointIndex::new(&places);
    let place = |at: &SurfacePoint| index.nearest(&surface.point(at).coords.into());
    let thrown = (DARTS_PER_SAMPLE * count) as f64 / share.max(0.02);
    let darts: Vec<SurfacePoint> = uniform(surface, thrown as usize, rng)
        .into_par_iter()
        .filter(|at| place(at).is_some_and(|(i, _)| lively[i as usize]))
        .collect();
    let kept = spread(surface, darts, spacing(share * surface.area(), count), rng);
    kept.par_iter()
        .filter_map(|at| {
            Some(Probe {
                place: place(at)?.0,
                sample: describer.sample(at),
            })
        })
        .collect()
}
