//! Samples of a surface and their signatures (section 2).

pub mod blue_noise;
pub mod crisp;
mod moments;
pub mod outline;
pub mod probes;
pub mod profile;
pub mod relief;
pub mod samples;
pub mod signature;
pub mod uniform;

pub use probes::{Probe, probes, probes_of_outline};
pub use relief::{Frame, Relief};
pub use samples::{Sample, SampleParams, Samples, sample};
pub use signature::Signature;
