//! Cuts where neighbouring local mirrors disagree: a false cluster has seeded there.

use crate::field::Partner;
use crate::field::grow::Land;
use crate::field::pieces::pieces;
use crate::transform::Isometry;

/// Neighbours' maps that take a sample to places further apart than this disagree, fraction of L.
const APART: f64 = 0.05;

/// Removes the pieces of a field that meet another across a cut, all but the largest; whether there were
/// any.
pub fn torn(land: &Land<'_>, partners: &mut [Option<Partner>], maps: &[Option<Isometry>]) -> bool {
    let agree = |a: u32, b: u32| {
        let (Some(s), Some(t)) = (&maps[a as usize], &maps[b as usize]) else {
            return None;
        };
        let x = &land.samples.list[a as usize].position;
        Some((s.apply(x) - t.apply(x)).norm() <= APART)
    };
    let paired = |s: u32| partners[s as usize].is_some();
    let pieces = pieces(&land.reach.neighbors, paired, |a, b| {
        agree(a, b) == Some(true)
    });
    let mut piece = vec![None; partners.len()];
    for (k, samples) in pieces.iter().enumerate() {
        samples.iter().for_each(|&s| piece[s as usize] = Some(k));
    }
    let largest = (0..pieces.len()).max_by_key(|&k| pieces[k].len());
    let mut meets = vec![false; pieces.len()];
    for a in 0..partners.len() as u32 {
        for &b in &land.reach.neighbors[a as usize] {
            let (Some(p), Some(q)) = (piece[a as usize], piece[b as usize]) else {
                continue;
            };
            if p != q && agree(a, b) == Some(false) {
                meets[p] = true;
                meets[q] = true;
            }
        }
    }
    let dropped = |p: usize| meets[p] && Some(p) != largest;
    let mut any = false;
    for (partner, piece) in partners.iter_mut().zip(&piece) {
        if piece.is_some_and(dropped) {
            *partner = None;
            any = true;
        }
    }
    any
}
