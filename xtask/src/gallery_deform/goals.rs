//! What was to be reached, and whether it was.

use super::figures::Figures;
use super::result::Deformed;

/// Edges may be stretched by so much more than the peer's, as a factor.
const STRETCH: f64 = 1.05;
/// Correlations that differ by less are the same: half of the last decimal that the page shows, less than what
/// the peer's own two ways of running make of one variant (0.00008 on the bent bar).
const SAME: f64 = 5e-5;

/// A method's result with its figures.
pub struct Entry {
    /// The result.
    pub deformed: Deformed,
    /// Its figures.
    pub figures: Figures,
}

/// The peer's results that ours are put beside: of those without inverted or newly crossing faces the one that
/// keeps the curvature best, and the one that stretches edges least.
pub struct Best<'a> {
    /// The highest correlation.
    pub truest: &'a Entry,
    /// The least stretch.
    pub tightest: &'a Entry,
}

impl<'a> Best<'a> {
    /// The best of the peer's `entries`; none where no peer's result is intact.
    pub fn of(entries: &'a [Entry]) -> Option<Self> {
        let intact = || {
            entries
                .iter()
                .filter(|e| e.deformed.peer && e.figures.intact())
        };
        let correlation = |e: &Entry| e.figures.correlation.unwrap_or(f64::NEG_INFINITY);
        Some(Self {
            truest: intact().max_by(|a, b| correlation(a).total_cmp(&correlation(b)))?,
            tightest: intact().min_by(|a, b| a.figures.stretch.total_cmp(&b.figures.stretch))?,
        })
    }
}

/// Our figures beside those of one of the peer's results.
pub struct Comparison {
    /// Our stretch over the peer's.
    pub stretch: f64,
    /// Our correlation less the peer's.
    pub correlation: f64,
    /// Whether both are good enough and ours is intact.
    pub met: bool,
}

impl Comparison {
    /// Compares `ours` with `peer`.
    pub fn new(ours: &Figures, peer: &Figures) -> Self {
        let stretch = ours.stretch / peer.stretch;
        let correlation = ours.correlation.unwrap_or(0.0) - peer.correlation.unwrap_or(0.0);
        Self {
            stretch,
            correlation,
            met: ours.intact() && stretch <= STRETCH && correlation >= -SAME,
        }
    }
}
