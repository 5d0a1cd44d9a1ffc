//! Whether partners look alike: reliefs compared at the very turn that the isometry says.

use rayon::prelude::*;

use crate::geom::median;
use crate::patch::ground::Ground;
use crate::patch::symmetry::PatchPair;
use crate::sample::samples::Describer;
use crate::transform::Isometry;

/// Pairs that are looked at, spread evenly over the patch.
const LOOKED_AT: usize = 48;

/// The median, over the pairs of `t`, of the gap between a sample's relief and that of its partner,
/// turned as `t` says: 0 where they are alike, 1.4 for any two places. Pairs across less than the
/// widest curvature radius see the same ground and do not count; 1.4 where there are no others.
pub fn unlikeness(
    ground: &Ground<'_>,
    describer: &Describer<'_>,
    t: &Isometry,
    pairs: &[PatchPair],
) -> f64 {
    let list = &ground.samples.list;
    let apart: Vec<&PatchPair> = pairs
        .iter()
        .filter(|pair| {
            let x = list[pair.sample as usize].position;
            (ground.surface.point(&pair.partner) - x).norm() > 2.0 * ground.samples.radius
        })
        .collect();
    let stride = apart.len().div_ceil(LOOKED_AT).max(1);
    let looked_at: Vec<&PatchPair> = apart.into_iter().step_by(stride).collect();
    let mut gaps: Vec<f64> = looked_at
        .par_iter()
        .filter_map(|pair| {
            let s = &list[pair.sample as usize];
            let (frame, relief) = describer.relief(&pair.partner);
            let turn = frame.angle_of(&t.rotate(&s.frame.e1));
            s.relief.gap_at(&relief, t.is_improper(), turn)
        })
        .collect();
    median(&mut gaps).unwrap_or(std::f64::consts::SQRT_2)
}
