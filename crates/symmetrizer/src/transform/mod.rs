//! Isometries, the space they form, and the closed forms of section 3 and appendix A.

pub mod axis;
pub mod class;
pub mod displacement;
pub mod isometry;
pub mod kind;
pub mod optimal;
pub mod space;

pub use axis::{Axis, Jointed};
pub use class::Class;
pub use displacement::displacements;
pub use isometry::{Isometry, Plane};
pub use kind::{Elements, Kind, same_symmetry};
pub use optimal::{Ambient, Correspondence, MirrorFit, optimal_mirror};
pub use space::TransformSpace;
