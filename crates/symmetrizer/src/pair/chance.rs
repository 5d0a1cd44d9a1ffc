//! Votes by chance: the same places, paired at random.

use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use crate::pair::mirror::mirror_of;
use crate::pair::{Pair, PairParams};
use crate::sample::Samples;
use crate::transform::Isometry;

/// The mirror votes of `pairs` with their second places shuffled: of those, the pairs that pass the
/// tests that votes pass, as many as there are, each with the first one's weight.
pub fn shuffled_mirrors(
    pairs: &[Pair],
    samples: &Samples,
    params: &PairParams,
    rng: &mut Pcg64,
) -> Vec<Pair> {
    let mut others: Vec<u32> = pairs.iter().map(|v| v.q).collect();
    others.shuffle(rng);
    let list = &samples.list;
    pairs
        .iter()
        .zip(others)
        .filter_map(|(v, q)| {
            let plane = mirror_of(&list[v.p as usize], &list[q as usize], params)?;
            Some(Pair {
                q,
                q_from_p: Isometry::mirror(&plane),
                ..*v
            })
        })
        .collect()
}
