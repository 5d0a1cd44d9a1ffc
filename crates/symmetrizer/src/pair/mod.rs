//! Compatible pairs of samples: the votes for symmetries (section 2).

mod chance;
mod mirror;
mod rigid;

use crate::transform::Isometry;

pub use chance::{shuffled_mirrors, shuffled_motions};
pub use mirror::mirror_pairs;
pub use rigid::Likes;

/// Which samples make a pair.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PairParams {
    /// Largest signature distance of a pair, dimensionless. 0.35, ours: measured on the models.
    pub tolerance: f64,
    /// Partners that a sample keeps at the most, the most alike first. 12, ours: 5 to 50 differed
    /// little on the models.
    pub partners: usize,
    /// Smallest distance of the two points, fraction of L. 0.06, ours: the error of a vote's
    /// normal grows with its inverse.
    pub min_distance: f64,
    /// Largest |R n_p - n_q| of the normals under the pair's mirror. 0.5, ours (29 degrees).
    pub normal_tolerance: f64,
    /// Smallest signature strength max |asinh k r| of a sample that votes: flat ground looks the same
    /// everywhere. 0.05, ours.
    pub min_strength: f64,
    /// Largest rms height difference of the reliefs of a rigid pair, as a share of their own rms. 0.6,
    /// ours.
    pub max_gap: f64,
}

impl Default for PairParams {
    fn default() -> Self {
        Self {
            tolerance: 0.35,
            partners: 12,
            min_distance: 0.06,
            normal_tolerance: 0.5,
            min_strength: 0.05,
            max_gap: 0.6,
        }
    }
}

/// A pair of samples and the transformation it is evidence for.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    /// Index of one sample.
    pub p: u32,
    /// Index of its partner.
    pub q: u32,
    /// The transformation, q = T(p).
    pub q_from_p: Isometry,
    /// How much the vote counts: small for places that look like many others.
    pub weight: f64,
}
