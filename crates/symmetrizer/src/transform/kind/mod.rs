//! What kind of isometry a given one is, and its elements: axis, angle, plane, shift.
//!
//! No measured isometry is exactly a rotation or a mirror. It counts as the simplest kind of its
//! handedness that has a member within a tolerance, both measured as rms displacement over a
//! support (`TransformSpace`); the kinds are those of the isometries of space (International
//! Tables for Crystallography, volume A).

mod elements;
mod nearest;
#[cfg(test)]
mod tests;

pub use elements::{Elements, turn_of};

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::transform::isometry::Isometry;
use crate::transform::space::TransformSpace;

/// The kinds of isometry, simple ones first within each handedness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Nothing moves.
    Identity,
    /// All points move by one vector.
    Translation,
    /// About an axis; half-turns are among them.
    Rotation,
    /// A rotation and a translation along its axis.
    Screw,
    /// In a plane.
    Mirror,
    /// Through a point.
    Inversion,
    /// A mirror and a translation along its plane.
    Glide,
    /// A rotation and the mirror across its axis.
    Rotoreflection,
}

impl Kind {
    /// All kinds, in the order of the enum.
    pub const ALL: [Self; 8] = [
        Self::Identity,
        Self::Translation,
        Self::Rotation,
        Self::Screw,
        Self::Mirror,
        Self::Inversion,
        Self::Glide,
        Self::Rotoreflection,
    ];

    /// The name in reports and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Identity => "identity",
            Self::Translation => "translation",
            Self::Rotation => "rotation",
            Self::Screw => "screw",
            Self::Mirror => "mirror",
            Self::Inversion => "inversion",
            Self::Glide => "glide",
            Self::Rotoreflection => "rotoreflection",
        }
    }

    /// Whether isometries of this kind turn left hands into right hands.
    pub fn is_improper(self) -> bool {
        self >= Self::Mirror
    }
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

impl std::str::FromStr for Kind {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        let found = Self::ALL.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            Error::params("kind", format!("\"{name}\" is none of {names}"))
        })
    }
}

impl Isometry {
    /// The nearest member of the simplest kind of this handedness that has one within
    /// `tolerance`, with that kind. Both in the space's unit. A rotation within `tolerance` of a
    /// half-turn becomes one.
    pub fn snapped(&self, space: &TransformSpace, tolerance: f64) -> (Kind, Self) {
        let near = |t: &Self| space.distance(self, t) <= tolerance;
        if self.is_improper() {
            for kind in [Kind::Mirror, Kind::Inversion, Kind::Glide] {
                if let Some(t) = self.nearest(kind, space).filter(near) {
                    return (kind, t);
                }
            }
            return (Kind::Rotoreflection, *self);
        }
        for kind in [Kind::Identity, Kind::Translation] {
            if let Some(t) = self.nearest(kind, space).filter(near) {
                return (kind, t);
            }
        }
        let turned = [
            self.nearest_half_turn(space),
            self.nearest(Kind::Rotation, space),
        ];
        match turned.into_iter().flatten().find(near) {
            Some(t) => (Kind::Rotation, t),
            None => (Kind::Screw, *self),
        }
    }

    /// The kind of this isometry to `tolerance`, and the elements of the nearest member of it.
    pub fn elements(&self, space: &TransformSpace, tolerance: f64) -> Elements {
        let (kind, t) = self.snapped(space, tolerance);
        Elements::read(kind, &t, space, tolerance)
    }

    /// This isometry or its inverse, whichever turns positively about its axis or, where it does
    /// not turn, shifts along a positive largest component: one of the two names their symmetry.
    pub fn canonical(&self, space: &TransformSpace, tolerance: f64) -> Self {
        let e = self.elements(space, tolerance);
        let shift = e.shift[e.shift.iamax()];
        let turns = e.order.is_none_or(|order| order > 2) && e.angle != 0.0;
        let backwards = if turns { e.angle < 0.0 } else { shift < 0.0 };
        if backwards { self.inverse() } else { *self }
    }
}

/// Whether two isometries are the same symmetry to `tolerance`: a shape that has T has its
/// inverse.
pub fn same_symmetry(a: &Isometry, b: &Isometry, space: &TransformSpace, tolerance: f64) -> bool {
    space.distance(a, b) <= tolerance || space.distance(a, &b.inverse()) <= tolerance
}
