//! Clusters of votes in transformation space (sections 2 and 5): mean shift, height, density.

pub mod density;
pub mod mean_shift;

pub use density::Projection;
pub use mean_shift::{Cluster, ClusterParams, Votes, density_of};
