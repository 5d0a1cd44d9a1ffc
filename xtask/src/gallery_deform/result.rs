//! What a method made of an exhibit.

use symmetrizer::geom::Point;

/// A deformed exhibit.
pub struct Deformed {
    /// What did it.
    pub method: String,
    /// Its vertices, working coordinates.
    pub positions: Vec<Point>,
    /// Steps taken, if known.
    pub steps: Option<usize>,
    /// Seconds, set-up included.
    pub seconds: f64,
}
