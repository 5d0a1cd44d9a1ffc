//! The three clouds of transformation space: votes of different classes are never clustered together.

use crate::geom::Ambient;

/// What the votes of a cloud have in common.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub enum Class {
    /// Reflections in a plane: three degrees of freedom.
    Mirror,
    /// Rotations, translations and screws: six degrees of freedom, determinant +1.
    Proper,
    /// Glides, rotoreflections and inversions: six degrees of freedom, determinant -1.
    Improper,
}

impl Class {
    /// All of them, mirrors first.
    pub const ALL: [Self; 3] = [Self::Mirror, Self::Proper, Self::Improper];

    /// What it has, in words.
    pub fn members(self) -> &'static str {
        match self {
            Self::Mirror => "mirrors",
            Self::Proper => "rotations, translations, screws",
            Self::Improper => "glides, rotoreflections, inversions",
        }
    }

    /// How many degrees of freedom its members have.
    pub fn freedom(self, ambient: Ambient) -> u32 {
        match (self, ambient) {
            (Self::Mirror, Ambient::Plane) => 2,
            (Self::Mirror, Ambient::Space) => 3,
            (_, Ambient::Plane) => 3,
            (_, Ambient::Space) => 6,
        }
    }

    /// Whether its members turn left hands into right hands.
    pub fn is_improper(self) -> bool {
        self != Self::Proper
    }
}
