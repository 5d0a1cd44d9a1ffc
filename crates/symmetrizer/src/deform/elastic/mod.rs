//! Rigid elements with springs between them, whatever the elements are: prisms over faces (PriMo) or
//! vertices with a rotation each (as rigid as possible).

pub mod binding;
pub mod body;
pub mod elements;
pub mod motion;
pub mod sites;

pub use binding::Binding;
pub use body::Body;
pub use elements::{Blocks, Elements, Spring};
pub use motion::Motion;
pub use sites::Sites;
