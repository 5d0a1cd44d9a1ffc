//! The nearest isometry of a kind, in the rms displacement over a support.
//!
//! The support's six probes and their images are pairs, and appendix A finds the isometry of each
//! kind that carries them best; so the nearest member is the closed form of its kind. The rotation
//! without pitch has none and is found by a step of Gauss and Newton.

use crate::geom::{Matrix3, Vector, exp_rotation};
use crate::transform::isometry::Isometry;
use crate::transform::kind::{Kind, turn_of};
use crate::transform::optimal::{
    Ambient, Correspondence, optimal_glide, optimal_half_turn, optimal_improper, optimal_inversion,
    optimal_mirror, optimal_rigid, optimal_translation,
};
use crate::transform::space::TransformSpace;

impl Isometry {
    /// The isometry of `kind` nearest to this one in `space`, exact up to second order in the
    /// distance for rotations and in closed form for the rest. `None` where the support has no
    /// extent that would tell one from another.
    pub fn nearest(&self, kind: Kind, space: &TransformSpace) -> Option<Self> {
        let pairs = self.pairs(space);
        let ambient = Ambient::Space;
        match kind {
            Kind::Identity => Some(Self::identity()),
            Kind::Translation => optimal_translation(&pairs).map(|f| f.isometry),
            Kind::Rotation => self.nearest_rotation(space),
            Kind::Screw if !self.is_improper() => Some(*self),
            Kind::Screw => optimal_rigid(&pairs, None, ambient).map(|f| f.isometry),
            Kind::Mirror => optimal_mirror(&pairs, ambient).map(|f| Self::mirror(&f.plane)),
            Kind::Inversion => optimal_inversion(&pairs).map(|f| f.isometry),
            Kind::Glide => optimal_glide(&pairs, ambient).map(|f| f.isometry),
            Kind::Rotoreflection if self.is_improper() => Some(*self),
            Kind::Rotoreflection => optimal_improper(&pairs, None, ambient).map(|f| f.isometry),
        }
    }

    /// The nearest rotation by pi.
    pub(super) fn nearest_half_turn(&self, space: &TransformSpace) -> Option<Self> {
        optimal_half_turn(&self.pairs(space), Ambient::Space).map(|f| f.isometry)
    }

    fn pairs(&self, space: &TransformSpace) -> [Correspondence; 6] {
        space.probes().map(|p| Correspondence {
            p,
            q: self.apply(&p),
            weight: 1.0 / 6.0,
        })
    }

    /// The nearer of two rotations: this one without its pitch, and one whose axis is tilted so
    /// that the pitch vanishes, which is nearer where the axis is far from the support.
    fn nearest_rotation(&self, space: &TransformSpace) -> Option<Self> {
        let rigid = self.nearest(Kind::Screw, space)?;
        let plain = without_pitch(&rigid, space);
        let tilted = tilt(&rigid, space).map(|t| without_pitch(&t, space));
        let nearer = tilted.filter(|t| space.distance(self, t) < space.distance(self, &plain));
        Some(nearer.unwrap_or(plain))
    }
}

/// `t` with the motion along its axis taken out.
fn without_pitch(t: &Isometry, space: &TransformSpace) -> Isometry {
    let (axis, _) = turn_of(&t.linear);
    let moved = t.apply(&space.centre()) - space.centre();
    Isometry {
        translation: t.translation - axis * axis.dot(&moved),
        ..*t
    }
}

/// `t` turned by the omega about the image of the centroid that minimises, to second order,
/// omega^T S omega + (h + g . omega)^2: S the stiffness of the moved support against turning, h
/// the pitch, g its derivative, from that of the axis: (omega x a + cot(angle / 2) omega_across) / 2.
fn tilt(t: &Isometry, space: &TransformSpace) -> Option<Isometry> {
    let (axis, angle) = turn_of(&t.linear);
    let centre = space.centre();
    let image = t.apply(&centre);
    let moved = image - centre;
    let cot = (angle / 2.0).cos() / (angle / 2.0).sin();
    let across: Vector = moved - axis * axis.dot(&moved);
    let g = (axis.cross(&moved) + across * cot) / 2.0;
    let c: Matrix3 = space
        .probes()
        .iter()
        .map(|x| t.linear * (x - centre))
        .map(|y| y * y.transpose() / 6.0)
        .sum();
    let stiffness = Matrix3::identity() * c.trace() - c;
    let soft = stiffness.try_inverse()? * g;
    let omega = -soft * (axis.dot(&moved) / (1.0 + g.dot(&soft)));
    let turn = exp_rotation(&omega);
    omega.iter().all(|x| x.is_finite()).then(|| Isometry {
        linear: turn * t.linear,
        translation: turn * (t.translation - image.coords) + image.coords,
    })
}
