//! What is measured, the same for every method.

use symmetrizer::apply::measure::distortion;

use super::center_line::CenterLine;
use super::exhibit::Exhibit;
use super::result::Deformed;
use crate::constraints::Target;

/// Figures of one deformed exhibit.
#[derive(Debug, Clone)]
pub struct Figures {
    /// Faces turned over against the surface around them.
    pub inverted: usize,
    /// Faces that cross another and did not before.
    pub crossing: usize,
    /// 99th percentile over the edges of |ln(l' / l)|.
    pub stretch: f64,
    /// Correlation of the smoothed mean curvatures before and after.
    pub correlation: Option<f64>,
    /// The largest distance of a handle's vertex from its target, percent of the bounding box's diagonal.
    pub residual: f64,
    /// How far the centre line is from its chord, percent of the chord.
    pub sag: Option<f64>,
}

impl Figures {
    /// Measures `deformed`.
    pub fn new(exhibit: &Exhibit, deformed: &Deformed) -> Self {
        let after = exhibit.surface.with_positions(deformed.positions.clone());
        let diagonal = exhibit.diagonal();
        let d = distortion(&exhibit.surface, &after, diagonal);
        let missed = |(v, x): &Target| (after.positions[*v as usize] - x).norm();
        let residual = exhibit.targets().iter().map(missed).fold(0.0, f64::max);
        let sag = |line: &CenterLine| 100.0 * line.sag(&exhibit.surface, &after.positions);
        Self {
            inverted: d.inverted_faces,
            crossing: d.new_crossings,
            stretch: d.edge_stretch_p99,
            correlation: d.curvature_correlation,
            residual: 100.0 * residual / diagonal,
            sag: exhibit.line.as_ref().map(sag),
        }
    }

    /// Whether no face is inverted or newly crosses another.
    pub fn intact(&self) -> bool {
        self.inverted == 0 && self.crossing == 0
    }
}
