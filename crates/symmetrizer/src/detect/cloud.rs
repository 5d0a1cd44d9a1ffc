//! The votes of one class, and what has been worked out about them: a second look asks the same again.

use crate::cluster::{Cluster, ClusterParams, Votes};
use crate::geom::Ambient;
use crate::pair::Pair;
use crate::patch::{Candidate, Ground, PatchParams, Settled, settled};
use crate::transform::{Class, Isometry, TransformSpace};

/// The votes of one class.
pub struct Cloud {
    /// The class.
    pub class: Class,
    /// The votes' pairs.
    pub pairs: Vec<Pair>,
    /// The votes, those explained by a symmetry with weight 0.
    pub votes: Votes,
    /// How modes came to rest, as far as they were grown one after the other.
    rested: Vec<Rested>,
    /// The modes of votes that counted differently.
    listed: Vec<Listed>,
}

/// A mode that has come to rest on the surface, or not.
#[derive(Debug, Clone)]
struct Rested {
    /// Where it started from.
    start: Isometry,
    seeds: Vec<u32>,
    /// Where it came to rest, or why it did not.
    rest: Result<Settled, String>,
}

/// The modes of the votes with given weights.
#[derive(Clone)]
struct Listed {
    weights: Vec<f64>,
    kernel: ClusterParams,
    modes: Vec<Cluster>,
}

impl Cloud {
    /// Of `pairs` in the `ambient` space, none of them explained.
    pub(super) fn new(
        class: Class,
        pairs: Vec<Pair>,
        (space, ambient): (&TransformSpace, Ambient),
    ) -> Self {
        Self {
            class,
            votes: Votes::new(&pairs, space, class.freedom(ambient)),
            pairs,
            rested: Vec::new(),
            listed: Vec::new(),
        }
    }

    /// The same with nothing explained.
    pub(super) fn anew(&self) -> Self {
        Self {
            class: self.class,
            votes: self.votes.anew(&self.pairs),
            pairs: self.pairs.clone(),
            rested: self.rested.clone(),
            listed: self.listed.clone(),
        }
    }

    /// The modes of the votes that are not explained: they are worked out once.
    pub(super) fn clusters(&mut self, kernel: &ClusterParams) -> Vec<Cluster> {
        let weights = self.votes.weights();
        let mut known = self.listed.iter();
        if let Some(known) = known.find(|k| k.weights == weights && k.kernel == *kernel) {
            return known.modes.clone();
        }
        let modes = self.votes.clusters(kernel);
        self.listed.push(Listed {
            weights: weights.to_vec(),
            kernel: kernel.clone(),
            modes: modes.clone(),
        });
        modes
    }

    /// Where a `candidate` among its modes comes to rest on `ground`: that is worked out once.
    pub(super) fn rest(
        &mut self,
        ground: &Ground<'_>,
        candidate: &Candidate,
        params: &PatchParams,
    ) -> Result<Settled, String> {
        let mut known = self.rested.iter();
        if let Some(known) = known.find(|k| k.start == candidate.t && k.seeds == candidate.seeds) {
            return known.rest.clone();
        }
        let rest = settled(ground, candidate, params);
        self.rested.push(Rested {
            start: candidate.t,
            seeds: candidate.seeds.clone(),
            rest: rest.clone(),
        });
        rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, Vector};
    use crate::transform::Plane;

    /// Modes that are known are those that would be found, also once votes are explained and once they all count again.
    #[test]
    fn known_modes_are_the_modes() {
        let corners =
            (0..8).map(|k| Point::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)));
        let space = TransformSpace::new(corners.map(|x| (x, 1.0)));
        let pairs: Vec<Pair> = (0..40)
            .map(|k| {
                let normal = if k < 25 { Vector::x() } else { Vector::y() };
                let place = Point::new(0.5, 0.5, 0.5) + normal * (0.001 * f64::from(k));
                Pair {
                    p: k,
                    q: k + 40,
                    q_from_p: Isometry::mirror(&Plane::through(&place, normal)),
                    weight: 1.0,
                }
            })
            .collect();
        let kernel = ClusterParams::default();
        let mut cloud = Cloud::new(Class::Mirror, pairs, (&space, Ambient::Space));
        let heights = |cloud: &mut Cloud| {
            let known = cloud.clusters(&kernel);
            let found = cloud.votes.clusters(&kernel);
            let heights = |all: &[Cluster]| all.iter().map(|c| c.height).collect::<Vec<_>>();
            assert_eq!(heights(&known), heights(&found));
            heights(&known)
        };
        let all = heights(&mut cloud);
        cloud.votes.explain_away(|i| i < 25);
        let some = heights(&mut cloud);
        assert_eq!((all.len(), some.len()), (2, 1));
        assert_eq!(heights(&mut cloud), some);
        assert_eq!(heights(&mut cloud.anew()), all);
    }
}
