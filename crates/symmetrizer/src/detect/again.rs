//! A second round of pairing: a part that has a copy may have more of them. Its probes are paired
//! again, with more partners than in the first round, where they were lost among all others.

use crate::context::Context;
use crate::detect::Cloud;
use crate::detect::search::{Again, motions};
use crate::detect::surroundings::Surroundings;
use crate::error::Result;
use crate::pair::Likes;
use crate::patch::Symmetry;
use crate::transform::Class;

/// Adds to `symmetries` the further copies of parts that have one.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub fn again(
    surroundings: &Surroundings<'_>,
    likes: &Likes<'_>,
    symmetries: &mut Vec<Symmetry>,
    ctx: &mut Context<'_>,
) -> Result<()> {
    let part = Repeated::of(symmetries, surroundings.ground.samples.list.len());
    let probes = likes.probes;
    let inside = |k: &u32| part.member[probes[*k as usize].place as usize];
    let mut asking: Vec<u32> = (0..probes.len() as u32).filter(inside).collect();
    if asking.is_empty() {
        return Ok(());
    }
    let stride = asking.len().div_ceil(ASKING);
    asking = asking.into_iter().step_by(stride).collect();
    let own: Vec<u32> = (0..)
        .zip(&part.member)
        .filter(|(_, m)| **m)
        .map(|(i, _)| i)
        .collect();
    let round = Again {
        modes: MODES,
        ground: &surroundings.ground.samples.around(&own, RINGS),
    };
    let params = surroundings.params;
    for class in params.wanted.classes() {
        if class == Class::Mirror {
            continue;
        }
        let pairs = likes.guided(&asking, class, surroundings.space, &params.pair);
        let within = (surroundings.space, surroundings.ground.samples.ambient);
        let cloud = Cloud::new(class, pairs, within);
        let clusters = cloud.votes.clusters(&params.cluster);
        let found = motions(
            surroundings,
            &clusters,
            &cloud,
            symmetries,
            Some(&round),
            ctx,
        )?;
        symmetries.extend(found.symmetries.into_iter().filter(|s| part.has(s)));
    }
    Ok(())
}

/// The ground that motions carry to another place, and its copies.
struct Repeated {
    /// Whether a sample belongs to it.
    member: Vec<bool>,
    /// The largest rms residual of its copies, fraction of L.
    rms: f64,
}

impl Repeated {
    fn of(symmetries: &[Symmetry], count: usize) -> Self {
        let copies = symmetries.iter().filter(|s| s.leaves_its_place());
        let mut part = Self {
            member: vec![false; count],
            rms: 0.0,
        };
        for s in copies {
            part.rms = part.rms.max(s.rms);
            for (m, own) in part.member.iter_mut().zip(s.ground(count)) {
                *m |= own;
            }
        }
        part
    }

    /// Whether `s` is one more of the copies: it leads elsewhere and holds as they do.
    fn has(&self, s: &Symmetry) -> bool {
        s.leaves_its_place() && s.rms <= AS_WELL * self.rms
    }
}

/// Probes that are paired again at the most.
const ASKING: usize = 250;
/// How many neighbours further than the copies known so far a further copy may reach.
const RINGS: u32 = 2;
/// Modes grown at the most.
const MODES: usize = 60;
/// A further copy may hold worse than the others by this factor.
const AS_WELL: f64 = 1.5;
