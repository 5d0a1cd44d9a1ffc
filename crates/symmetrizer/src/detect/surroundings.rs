//! What symmetries are looked for on, and what any of them must stand up to.

use crate::cluster::{Cluster, density_of};
use crate::context::Context;
use crate::detect::{Cloud, DetectParams};
use crate::pair::{Pair, shuffled_mirrors};
use crate::patch::{Ground, Refusal, Symmetry};
use crate::sample::samples::Describer;
use crate::slip::Continuous;
use crate::transform::TransformSpace;

/// What symmetries are looked for on.
pub struct Surroundings<'a> {
    /// The surface and its samples.
    pub ground: &'a Ground<'a>,
    /// Transformation space of the surface.
    pub space: &'a TransformSpace,
    /// Makes samples of other places.
    pub describer: &'a Describer<'a>,
    /// Parts that slide along themselves.
    pub continuous: &'a [Continuous],
    /// How far the images of samples lie from the surface under any mirror, fraction of L (decision 0035).
    pub any_mirror: f64,
    /// The parameters.
    pub params: &'a DetectParams,
}

/// A part has an isometry by sliding when it comes to this of itself, rms fraction of L.
const IMPLIED: f64 = 0.03;

/// An isometry that sliding parts imply must hold for this share of what lies elsewhere, as a mug's
/// mirror does for its handle,
const MIN_ELSEWHERE: f64 = 0.5;
/// and this must be so much of the whole surface.
const MIN_LEFT: f64 = 0.03;

/// A mirror that misses by this share of what any mirror does is in as much doubt as one that misses by the tolerance; ours.
pub const SHARE_OF_ANY: f64 = 0.4;

/// Shuffles of the votes that chance is estimated from.
pub const SHUFFLES: usize = 4;

impl Surroundings<'_> {
    /// Refuses a symmetry of which too little is left when parts that have it by sliding along
    /// themselves are not counted: a vase has all planes through its axis, which is one symmetry.
    pub fn more_than_sliding(&self, s: Symmetry) -> std::result::Result<Symmetry, Box<Refusal>> {
        self.more_than(self.continuous, s)
    }

    /// The same of the parts `sliding`.
    pub fn more_than(
        &self,
        sliding: &[Continuous],
        s: Symmetry,
    ) -> std::result::Result<Symmetry, Box<Refusal>> {
        let samples = self.ground.samples;
        let mut elsewhere = vec![true; samples.list.len()];
        let implied = sliding
            .iter()
            .filter(|c| c.implies(&s.q_from_p, samples, IMPLIED));
        for part in implied {
            part.samples
                .iter()
                .for_each(|&i| elsewhere[i as usize] = false);
        }
        let rest = elsewhere.iter().filter(|e| **e).count();
        if rest == elsewhere.len() {
            return Ok(s);
        }
        let own = s.ground(samples.list.len());
        let left = own
            .iter()
            .zip(&elsewhere)
            .filter(|(o, e)| **o && **e)
            .count();
        let holds = left as f64 >= MIN_ELSEWHERE * rest as f64
            && left as f64 >= MIN_LEFT * elsewhere.len() as f64;
        if holds {
            Ok(s)
        } else {
            Err(s.refuse("implied by a continuous symmetry".to_owned(), samples))
        }
    }

    /// Adds to a mirror's doubt what it misses by in units of what any mirror does, where these are finer than the tolerance.
    pub fn weigh_against_any(&self, symmetry: Symmetry) -> Symmetry {
        let tolerance = self.params.patch.tolerance;
        let finer = tolerance.min(SHARE_OF_ANY * self.any_mirror);
        let finer = finer.max(f64::MIN_POSITIVE);
        let doubt = symmetry.doubt + symmetry.rms / finer - symmetry.rms / tolerance;
        Symmetry { doubt, ..symmetry }
    }

    /// Adds to a mirror's doubt how high its cluster would be by chance: the height that the same votes
    /// have there, in the same kernel of radius `h`, when their second places are shuffled.
    pub fn weigh_against_chance(
        &self,
        symmetry: Symmetry,
        cluster: &Cluster,
        cloud: &Cloud,
        h: f64,
        ctx: &Context<'_>,
    ) -> Symmetry {
        let mut rng = ctx.rng("chance");
        let weighed: Vec<Pair> = cloud
            .pairs
            .iter()
            .zip(cloud.votes.weights())
            .filter(|(_, w)| **w > 0.0)
            .map(|(v, _)| *v)
            .collect();
        let chance: f64 = (0..SHUFFLES)
            .map(|_| {
                let other =
                    shuffled_mirrors(&weighed, self.ground.samples, &self.params.pair, &mut rng);
                let share = weighed.len() as f64 / other.len().max(1) as f64;
                share * density_of(&other, self.space, &cluster.mode, h)
            })
            .sum::<f64>()
            / SHUFFLES as f64;
        let chance = chance / cluster.height;
        let doubt = symmetry.doubt + chance;
        Symmetry { doubt, ..symmetry }
    }
}

/// Refuses what holds clearly worse than a symmetry found already does on the same ground: where an
/// exact symmetry is known, approximate ones are its echo.
pub fn as_good(
    s: Symmetry,
    found: &[Symmetry],
    ground: &Ground<'_>,
) -> std::result::Result<Symmetry, Box<Refusal>> {
    let count = ground.samples.list.len();
    let own = s.ground(count);
    let size = own.iter().filter(|m| **m).count();
    let echo = found.iter().find(|k| {
        let other = k.ground(count);
        let shared = own.iter().zip(&other).filter(|(a, b)| **a && **b).count();
        2 * shared > size && s.rms > WORSE * k.rms + SLACK
    });
    match echo {
        None => Ok(s),
        Some(k) => {
            let reason = format!(
                "holds worse than another on the same ground (rms {:.2} % of L, the other {:.2} %)",
                100.0 * s.rms,
                100.0 * k.rms
            );
            Err(s.refuse(reason, ground.samples))
        }
    }
}

/// Clearly worse is an rms residual this many times another's,
const WORSE: f64 = 1.7;
/// and by this much, fraction of L.
const SLACK: f64 = 5e-4;

/// Whether two symmetries are one: T and its inverse are.
pub fn is_same(a: &Symmetry, b: &Symmetry, space: &TransformSpace, near: f64) -> bool {
    let (s, t) = (&a.q_from_p, &b.q_from_p);
    space.distance(s, t) < near || space.distance(s, &t.inverse()) < near
}
