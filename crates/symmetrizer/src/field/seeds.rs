//! Where fields begin: what detection's mirrors hold for.

use crate::field::Partner;
use crate::field::grow::Land;
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
    for piece in pieces(land, &best) {
        if piece.len() < LEAST {
            piece.iter().for_each(|&s| best[s as usize] = None);
        }
    }
    best.into_iter().map(|b| b.map(|(_, q)| q)).collect()
}

/// Connected samples under the same mirror.
fn pieces(land: &Land<'_>, best: &[Option<(usize, Partner)>]) -> Vec<Vec<u32>> {
    let mut seen = vec![false; best.len()];
    let mut pieces = Vec::new();
    for start in 0..best.len() {
        let Some((mirror, _)) = best[start].filter(|_| !seen[start]) else {
            continue;
        };
        seen[start] = true;
        let mut piece = vec![start as u32];
        let mut at = 0;
        while at < piece.len() {
            for &n in &land.reach.neighbors[piece[at] as usize] {
                let same = best[n as usize].is_some_and(|(m, _)| m == mirror);
                if same && !seen[n as usize] {
                    seen[n as usize] = true;
                    piece.push(n);
                }
            }
            at += 1;
        }
        pieces.push(piece);
    }
    pieces
}
