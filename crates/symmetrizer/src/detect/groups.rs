//! Symmetries that belong together.

use crate::geom::{Point, Vector};
use crate::group::Pattern;
use crate::transform::Isometry;

/// A group of symmetries, a row or grid of copies, or copies of one element anywhere.
#[derive(Debug, Clone)]
pub struct Group {
    /// Schoenflies symbol of a point group ("C5", "D2h"), "row 5", "grid 3x4", "6 copies".
    pub name: String,
    /// The number of copies that the patches of an orbit are.
    pub order: usize,
    /// Unit direction of the main axis, where there is one.
    pub axis: Option<Vector>,
    /// The fixed point, or a point of the row, working coordinates.
    pub point: Point,
    /// The step from one copy to the next of a row.
    pub step: Option<Isometry>,
    /// How the copies of a row or grid follow each other.
    pub pattern: Option<Pattern>,
    /// All elements of the exact group, or the motions from the first copy to each.
    pub elements: Vec<Isometry>,
    /// Ids of the symmetries that belong to it.
    pub symmetries: Vec<u32>,
    /// The samples of each copy, where copies are apart from one another.
    pub orbit: Vec<Vec<u32>>,
}
