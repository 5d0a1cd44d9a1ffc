//! A small horned animal with its head turned: the shape that a newcomer sees first.

use super::anatomy::{Anatomy, BOUNDS, Pose};
use super::mesher;
use crate::shape::mesh::Mesh;

/// A four-legged animal with neck, snout, ears, horns and tail, about two units long and high.
///
/// As a solid and at rest (`head_turn_deg` 0, `uneven` false) it is its own mirror image in the
/// plane y = 0; its triangles never are. By default its head looks to the left and a few small
/// things differ between the sides, which is what symmetrization has to find and undo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Creature {
    /// Turn of the head on the neck to the left, degrees about a nearly upright axis; the default
    /// is 35. It is limited to -60..=60: the neck would fold beyond.
    pub head_turn_deg: f64,
    /// Whether the left ear is bent and the right forefoot stands forward; so by default.
    pub uneven: bool,
    /// Grid cells over the length of the body, 80..=300: the number of triangles grows with its
    /// square. The default 94 gives about 25,000.
    pub resolution: u32,
}

impl Default for Creature {
    fn default() -> Self {
        Self {
            head_turn_deg: 35.0,
            uneven: true,
            resolution: 94,
        }
    }
}

impl Creature {
    /// The animal at rest: mirror-symmetric as a solid.
    pub fn at_rest() -> Self {
        Self {
            head_turn_deg: 0.0,
            uneven: false,
            ..Self::default()
        }
    }

    /// The closed triangle mesh; z is up, the body looks along x. Numbers outside their limits
    /// are replaced by the nearest limit, a turn that is not a number by 0.
    pub fn mesh(&self) -> Mesh {
        let turn = if self.head_turn_deg.is_nan() {
            0.0
        } else {
            self.head_turn_deg
        };
        let anatomy = Anatomy::new(Pose {
            turn: turn.clamp(-60.0, 60.0).to_radians(),
            uneven: if self.uneven { 1.0 } else { 0.0 },
        });
        let length = BOUNDS[1][0] - BOUNDS[0][0];
        let cell = length / f64::from(self.resolution.clamp(80, 300));
        mesher::mesh(|p| anatomy.distance(p), BOUNDS, cell)
    }
}
