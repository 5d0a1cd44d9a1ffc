//! When an isometry holds for a part of the surface.

use crate::transform::Class;

/// When an isometry holds for a part of the surface.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PatchParams {
    /// Largest distance of a sample's image from the surface, fraction of L. 0.02, ours.
    pub tolerance: f64,
    /// Largest distance of a sample's image from the surface for other isometries than mirrors, fraction
    /// of L. 0.008, ours: six degrees of freedom fit more by chance.
    pub copy_tolerance: f64,
    /// Smallest cosine between carried and found normal. 0.75, ours (41 degrees).
    pub min_cos: f64,
    /// Where a patch ends, within the tolerance: at residuals this many times those of the quarter that
    /// holds best, times 1.5. 6, ours.
    pub end: f64,
    /// `end` for other isometries than mirrors. 6, ours.
    pub copy_end: f64,
    /// Smallest share of the surface's area for a mirror. 0.08, ours.
    pub min_area: f64,
    /// Smallest share of the surface's area that a copy and its image have together. 0.03, ours.
    pub min_copy: f64,
    /// Largest confusion of a mirror's pairs, see [`Symmetry::confusion`](crate::patch::Symmetry::confusion). 0.18, ours.
    pub max_confusion: f64,
    /// Largest doubt about a mirror: the rms residual in units of the tolerance (a surface that merely
    /// passes by fills the tolerance evenly: .58), of roundish shapes in finer ones (decision 0035), twice the confusion, and the share of its height
    /// that comes by chance. 0.8, ours, decision 0013: true mirrors of the models reach .77, false ones
    /// start at .88.
    pub max_doubt: f64,
    /// Largest rms residual of a motion, in units of what its patch was grown to: exact copies with even
    /// noise have .33. 0.385, ours.
    pub max_filled: f64,
    /// Largest rms residual where the patch of a motion ends, in the same units. 0.43, ours: copies end
    /// with .37, what passes by with .45.
    pub max_rim: f64,
    /// Largest share of a motion's height that its votes reach when their second places are shuffled. 0.03,
    /// ours.
    pub max_chance: f64,
    /// Largest median gap between the reliefs of a motion's partners. 0.6, ours.
    pub max_unlikeness: f64,
    /// `min_copy` in the plane, as a share of the outline's length. 0.12, ours: of three degrees of freedom by chance shorter pieces of
    /// natural outlines fit each other.
    pub outline_copy: f64,
    /// `max_filled` in the plane. 0.5, ours: exact copies with noise reach .47.
    pub outline_filled: f64,
    /// `max_unlikeness` in the plane. 0.15, ours: pieces of unlike outlines that fit have .2 and more.
    pub outline_unlikeness: f64,
    /// `max_chance` in the plane. 0.3, ours: of k copies every k-th shuffled pair is right, so that ten and more have .1 to .15.
    pub outline_chance: f64,
    /// Smallest firmness with which a patch holds a rigid motion against sliding. 0.02, ours.
    pub min_firmness: f64,
    /// Smallest height of a symmetry's cluster, as a share of the highest: what fewer votes speak for
    /// is chance. 0.15, ours.
    pub min_height: f64,
}

impl Default for PatchParams {
    fn default() -> Self {
        Self {
            tolerance: 0.02,
            copy_tolerance: 0.008,
            min_cos: 0.75,
            end: 6.0,
            copy_end: 6.0,
            min_area: 0.08,
            min_copy: 0.03,
            max_confusion: 0.18,
            max_doubt: 0.8,
            max_filled: 0.385,
            max_rim: 0.43,
            max_chance: 0.03,
            max_unlikeness: 0.6,
            outline_copy: 0.12,
            outline_filled: 0.5,
            outline_unlikeness: 0.15,
            outline_chance: 0.3,
            min_firmness: 0.02,
            min_height: 0.15,
        }
    }
}

impl PatchParams {
    /// The same with what motions need in the plane.
    pub fn in_plane(&self) -> Self {
        Self {
            min_copy: self.outline_copy,
            max_filled: self.outline_filled,
            max_unlikeness: self.outline_unlikeness,
            max_chance: self.outline_chance,
            ..self.clone()
        }
    }

    /// Smallest share of the surface's area.
    pub fn least_area(&self, class: Class) -> f64 {
        match class {
            Class::Mirror => self.min_area,
            Class::Proper | Class::Improper => self.min_copy,
        }
    }

    /// Where a patch ends, in units of its spread.
    pub fn end_of(&self, class: Class) -> f64 {
        match class {
            Class::Mirror => self.end,
            Class::Proper | Class::Improper => self.copy_end,
        }
    }

    /// Largest distance of a sample's image from the surface, fraction of L.
    pub fn tolerance_of(&self, class: Class) -> f64 {
        match class {
            Class::Mirror => self.tolerance,
            Class::Proper | Class::Improper => self.copy_tolerance,
        }
    }
}
