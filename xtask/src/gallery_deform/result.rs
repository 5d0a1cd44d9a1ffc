//! What a method made of an exhibit.

use symmetrizer::geom::Point;

/// A deformed exhibit.
pub struct Deformed {
    /// What did it.
    pub method: String,
    /// Its vertices, working coordinates.
    pub positions: Vec<Point>,
    /// Steps or iterations taken.
    pub steps: usize,
    /// Seconds, set-up included.
    pub seconds: f64,
    /// Whether a peer did it.
    pub peer: bool,
}
