//! The deformation model's parameters.

use crate::error::{Error, Result};

/// Which deformation model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Model {
    /// Rigid prisms with elastic joints (Botsch et al. 2006): the most beautiful.
    Primo,
    /// As rigid as possible with smooth rotations (Levi & Gotsman 2015): the fastest.
    Arap,
}

/// The deformation model's parameters.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DeformParams {
    /// `primo` or `arap`.
    pub model: Model,
    /// Stiffness length l, fraction of L: asymmetry on larger scales follows, smaller is kept by
    /// the shell. 0.05, docs/definitions.md.
    pub length: f64,
    /// Half height of the prisms, fraction of L: bending stiffness grows with its square. 0.02,
    /// ours (.005 gave spikes).
    pub half_height: f64,
    /// Faces of the control mesh that carries the surface; a surface of no more than half as many again
    /// is its own. 4000, ours.
    pub control_faces: usize,
}

impl Default for DeformParams {
    fn default() -> Self {
        Self {
            model: Model::Primo,
            length: 0.05,
            half_height: 0.02,
            control_faces: 4000,
        }
    }
}

impl DeformParams {
    /// # Errors
    /// [`Error::Params`] for lengths that are not positive and too few faces.
    pub fn check(&self) -> Result<()> {
        for (name, value) in [
            ("deform.length", self.length),
            ("deform.half_height", self.half_height),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::params(name, "must be positive"));
            }
        }
        if self.control_faces < 100 {
            return Err(Error::params(
                "deform.control_faces",
                "at least 100 are needed",
            ));
        }
        Ok(())
    }
}
