//! A state of a shape and the symmetries found in it.

use crate::apply::measure::{Asymmetry, asymmetry, asymmetry_of_outline};
use crate::context::Context;
use crate::detect::{DetectParams, Detection, Group, detect, detect_in_plane};
use crate::error::Result;
use crate::job::kinds;
use crate::optimize::outcome::mirrors;
use crate::patch::Symmetry;
use crate::shape::wall::Wall;
use crate::shape::working::Working;
use crate::transform::{Elements, Plane};

/// A state of a shape and the symmetries found in it.
pub struct Detected {
    /// The shape to work on.
    pub working: Working,
    /// The wall that it is, in the plane.
    pub wall: Option<Wall>,
    /// The bounding-box diagonal D, fraction of L.
    pub diagonal: f64,
    /// What was found.
    pub detection: Detection,
}

/// Symmetries of less than this share of the surface come by chance on any.
const TELLING: f64 = 0.1;
/// Other samples of a surface at the most, and the share of it that a mirror holds for which is found in them: parts of a heap of
/// bones have some.
const OTHERS: u64 = 2;
const MOST: f64 = 0.35;

impl Detected {
    /// [`Self::find`] of a shape of space. Where nothing is found but a mirror that is in doubt, up to twice more with other samples of
    /// the same surface: whether it stays in doubt hangs on where they lie (decision 0013).
    pub(super) fn sought(
        working: Working,
        diagonal: f64,
        params: &DetectParams,
        ctx: &mut Context<'_>,
    ) -> Result<Self> {
        let first = Self::find((working, None), diagonal, params, ctx)?;
        if !first.is_in_doubt() {
            return Ok(first);
        }
        for turn in 1..=OTHERS {
            let working = first.working.clone();
            let again = ctx.drawn_anew(turn, |ctx| {
                Self::find((working, None), diagonal, params, ctx)
            })?;
            if mirrors(&again.detection).any(|s| s.area_fraction >= MOST) {
                return Ok(again);
            }
        }
        Ok(first)
    }

    /// Whether a mirror is in doubt and nothing else tells of the shape.
    fn is_in_doubt(&self) -> bool {
        let found = &self.detection;
        let small = |s: &Symmetry| s.area_fraction < TELLING;
        !found.doubtful.is_empty()
            && found.groups.is_empty()
            && found.continuous.is_empty()
            && found.symmetries.iter().all(small)
    }

    /// The symmetries that are wanted of a shape of space or, with its wall, of the plane, with that `diagonal` in the file's units.
    pub(super) fn find(
        (working, wall): (Working, Option<Wall>),
        diagonal: f64,
        params: &DetectParams,
        ctx: &mut Context<'_>,
    ) -> Result<Self> {
        let mut detection = match &wall {
            Some(wall) => detect_in_plane(wall, params, ctx)?,
            None => detect(&working.surface, params, ctx)?,
        };
        kinds::keep_wanted(&mut detection, &params.wanted);
        Ok(Self {
            diagonal: diagonal / working.normalization.scale,
            detection,
            working,
            wall,
        })
    }

    /// The symmetries, the highest first.
    pub fn symmetries(&self) -> &[Symmetry] {
        &self.detection.symmetries
    }

    /// The kind and the elements of one of its symmetries, working coordinates.
    pub fn elements(&self, symmetry: &Symmetry) -> Elements {
        kinds::elements(symmetry, &self.detection.samples)
    }

    /// The group that a symmetry belongs to, the first of several.
    pub fn group_of(&self, id: u32) -> Option<&Group> {
        let mut groups = self.detection.groups.iter();
        groups.find(|g| g.symmetries.contains(&id))
    }

    /// How far this state is from symmetric; its symmetries' planes and `known` ones are tried
    /// besides those that the measure looks for itself.
    ///
    /// # Errors
    /// As [`asymmetry()`].
    pub fn asymmetry(&self, known: &[Plane], ctx: &Context<'_>) -> Result<Asymmetry> {
        let mut planes = known.to_vec();
        planes.extend(mirrors(&self.detection).map(Symmetry::plane));
        match &self.wall {
            Some(wall) => asymmetry_of_outline(wall, self.diagonal, &planes, ctx),
            None => asymmetry(&self.working.surface, self.diagonal, &planes, ctx),
        }
    }
}
