//! The plane that a picture of transformation space shows.

use nalgebra::{SMatrix, SVector};

use crate::cluster::mean_shift::leading_axes;
use crate::transform::space::Phi;

/// Two axes of transformation space: those along which a set of votes spreads most. The same as
/// classical multidimensional scaling of the votes' displacement distances; keep one
/// projection for pictures that are to be compared.
#[derive(Debug, Clone)]
pub struct Projection {
    origin: Phi,
    axes: SMatrix<f64, 2, 12>,
}

impl Projection {
    /// The principal plane of `votes`.
    pub fn new(votes: &[Phi]) -> Self {
        Self {
            origin: votes.iter().sum::<Phi>() / votes.len().max(1) as f64,
            axes: leading_axes(votes),
        }
    }

    /// Coordinates in the plane, fractions of L.
    pub fn project(&self, x: &Phi) -> [f64; 2] {
        let y: SVector<f64, 2> = self.axes * (x - self.origin);
        y.into()
    }
}
