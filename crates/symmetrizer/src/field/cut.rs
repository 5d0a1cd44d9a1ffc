//! Cuts where neighbouring local mirrors disagree: a false cluster has seeded there.

use crate::field::Partner;
use crate::field::grow::Land;
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
    let (piece, sizes) = pieces(land, partners, &agree);
    let largest = (0..sizes.len()).max_by_key(|&k| sizes[k]);
    let mut meets = vec![false; sizes.len()];
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

/// The connected piece of each paired sample, edges across which maps disagree left out, and their sizes.
fn pieces(
    land: &Land<'_>,
    partners: &[Option<Partner>],
    agree: &impl Fn(u32, u32) -> Option<bool>,
) -> (Vec<Option<usize>>, Vec<usize>) {
    let mut piece: Vec<Option<usize>> = vec![None; partners.len()];
    let mut sizes = Vec::new();
    for start in 0..partners.len() as u32 {
        if partners[start as usize].is_none() || piece[start as usize].is_some() {
            continue;
        }
        let id = sizes.len();
        let mut list = vec![start];
        piece[start as usize] = Some(id);
        let mut at = 0;
        while at < list.len() {
            let a = list[at];
            for &b in &land.reach.neighbors[a as usize] {
                let free = partners[b as usize].is_some() && piece[b as usize].is_none();
                if free && agree(a, b) == Some(true) {
                    piece[b as usize] = Some(id);
                    list.push(b);
                }
            }
            at += 1;
        }
        sizes.push(list.len());
    }
    (piece, sizes)
}
