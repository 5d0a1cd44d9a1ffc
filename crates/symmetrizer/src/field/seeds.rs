//! Where fields begin: what detection's mirrors hold for.

use crate::field::Partner;
use crate::field::grow::Land;
use crate::field::pieces::pieces;
use crate::transform::Isometry;

/// Distances within which a mirror claims a sample, fractions of L, tried in turn.
pub const CLAIMS: [f64; 3] = [0.006, 0.01, 0.015];
/// Smaller pieces are no seeds.
const LEAST: usize = 8;

/// For each sample the partner under that of `mirrors` which fits it best, where it lies within `claim`
/// (fraction of L), in connected pieces.
pub fn seeds(land: &Land<'_>, mirrors: &[Isometry], claim: f64) -> Vec<Option<Partner>> {
    let count = land.samples.list.len();
    let mut best: Vec<Option<(usize, Partner)>> = vec![None; count];
    for (m, t) in mirrors.iter().enumerate() {
        for s in 0..count as u32 {
            let Some(found) = land.image(s, t, claim) else {
                continue;
            };
            let held = &mut best[s as usize];
            if held.is_none_or(|(_, q)| found.residual < q.residual) {
                *held = Some((m, found));
            }
        }
    }
    let mirror = |s: u32| best[s as usize].map(|(m, _)| m);
    let same = |a, b| mirror(a) == mirror(b);
    for piece in pieces(&land.reach.neighbors, |s| mirror(s).is_some(), same) {
        if piece.len() < LEAST {
            piece.iter().for_each(|&s| best[s as usize] = None);
        }
    }
    best.into_iter().map(|b| b.map(|(_, q)| q)).collect()
}
