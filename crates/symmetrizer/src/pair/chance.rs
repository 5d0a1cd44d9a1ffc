//! Votes by chance: the same places, paired at random.

use std::f64::consts::TAU;

use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use crate::geom::Ambient;
use crate::pair::mirror::mirror_of;
use crate::pair::rigid::motion;
use crate::pair::{Pair, PairParams};
use crate::sample::{Samples, profile};
use crate::transform::{Class, Isometry};

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

/// The votes of `pairs` for motions with their second places shuffled and any turn that there is.
pub fn shuffled_motions(
    pairs: &[Pair],
    class: Class,
    samples: &Samples,
    rng: &mut Pcg64,
) -> Vec<Pair> {
    let mut others: Vec<u32> = pairs.iter().map(|v| v.q).collect();
    others.shuffle(rng);
    let place = |s: u32, turn: f64| {
        let s = &samples.list[s as usize];
        (s.position, s.frame.turned(turn))
    };
    let mut turn = || match samples.ambient {
        Ambient::Space => rng.random_range(0.0..TAU),
        Ambient::Plane => profile::turn(class.is_improper()),
    };
    pairs
        .iter()
        .zip(others)
        .map(|(v, q)| Pair {
            q,
            q_from_p: motion(&place(v.p, 0.0), &place(q, turn()), class),
            ..*v
        })
        .collect()
}
