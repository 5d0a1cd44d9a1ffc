//! Whether the partners of a motion look alike: reliefs compared at the very turn that it says.

use rayon::prelude::*;

use crate::patch::grow::Ground;
use crate::patch::symmetry::{PatchPair, Symmetry};
use crate::sample::samples::Describer;

/// Pairs that are looked at, spread evenly over the patch.
const LOOKED_AT: usize = 48;

/// The median, over the pairs, of the share of all samples that may look more like the sample, at any
/// turn, than its partner does at the turn of the motion.
pub fn confusion(ground: &Ground<'_>, describer: &Describer<'_>, symmetry: &Symmetry) -> f64 {
    let stride = symmetry.pairs.len().div_ceil(LOOKED_AT).max(1);
    let looked_at: Vec<&PatchPair> = symmetry.pairs.iter().step_by(stride).collect();
    let mut ranks: Vec<f64> = looked_at
        .par_iter()
        .filter_map(|pair| rank(ground, describer, symmetry, pair))
        .collect();
    let middle = ranks.len() / 2;
    if ranks.is_empty() {
        return 1.0;
    }
    *ranks.select_nth_unstable_by(middle, f64::total_cmp).1
}

fn rank(
    ground: &Ground<'_>,
    describer: &Describer<'_>,
    symmetry: &Symmetry,
    pair: &PatchPair,
) -> Option<f64> {
    let list = &ground.samples.list;
    let s = &list[pair.sample as usize];
    let partner = describer.sample(&pair.partner);
    let turn = partner
        .frame
        .angle_of(&symmetry.q_from_p.rotate(&s.frame.e1));
    let mirrored = symmetry.class.is_improper();
    let gap = s.relief.gap_at(&partner.relief, mirrored, turn)?;
    let closer = list
        .iter()
        .filter(|t| s.relief.least_gap(&t.relief).is_some_and(|g| g < gap))
        .count();
    Some(closer as f64 / list.len() as f64)
}
