//! The creature's body as a distance field. It stands on z = 0 and looks along x; its plane of
//! symmetry at rest is y = 0. Lengths are in units of about its own height / 2.
//!
//! Left and right parts are described once, for the left (y > 0), and are joined with each other
//! before they are joined with the rest: a smooth union of three parts depends on their order, and
//! any other order would make the two sides differ.

use super::field::{Solid, carve, cone, ellipsoid, join, leaf, mirrored, ramp};
use crate::geom::{Matrix3, Point, Vector, exp_rotation};

/// Parts in the order of joining, each with the size of its fillet.
type Parts = Vec<(Solid, f64)>;

/// The axis about which the head turns passes through this point.
const NECK: [f64; 3] = [0.58, 0.0, 0.95];
/// The neck twists between these heights; above, the head turns as a whole.
const TWIST: [f64; 2] = [0.86, 1.16];
/// Root of the left ear.
const EAR: [f64; 3] = [0.66, 0.17, 1.58];

/// How the body is posed.
pub(super) struct Pose {
    /// Head turn to the left, radians.
    pub turn: f64,
    /// How strongly the left ear and the right forefoot differ from the other side: 0 or 1.
    pub uneven: f64,
}

/// The body in a pose.
pub(super) struct Anatomy {
    pose: Pose,
    axis: Vector,
    trunk: Parts,
    foreleg: Parts,
    hindleg: Parts,
    head: Parts,
    eye: Parts,
    horn: Parts,
    nostril: Solid,
    ear: Solid,
    ear_hollow: Solid,
}

/// The corners of a box around the body in any pose.
pub(super) const BOUNDS: [[f64; 3]; 2] = [[-1.3, -0.85, -0.05], [1.32, 0.95, 2.1]];

impl Anatomy {
    pub fn new(pose: Pose) -> Self {
        let up = [-0.12, 0.42, 0.9];
        let facing = [0.9, 0.55, 0.0];
        Self {
            pose,
            // Nearly upright: the nose stays level while the head turns.
            axis: Vector::new(0.1, 0.0, 1.0).normalize(),
            trunk: trunk(),
            foreleg: foreleg(),
            hindleg: hindleg(),
            head: head(),
            eye: vec![(ellipsoid([0.945, 0.175, 1.44], [0.075, 0.06, 0.082]), 0.02)],
            horn: vec![(
                cone([0.83, 0.085, 1.59], 0.055, [0.79, 0.105, 1.8], 0.034),
                0.05,
            )],
            nostril: ellipsoid([1.275, 0.055, 1.3], [0.03, 0.022, 0.026]),
            ear: leaf([0.625, 0.3, 1.77], up, facing, [0.29, 0.13, 0.072]),
            ear_hollow: leaf([0.69, 0.33, 1.78], up, facing, [0.2, 0.07, 0.055]),
        }
    }

    /// The signed distance of `p` from the skin, of first order near it.
    pub fn distance(&self, p: &Point) -> f64 {
        let body = union(&self.trunk, p);
        let hind = both(p, 0.05, |q, _| union(&self.hindleg, q));
        let fore = both(p, 0.05, |q, left| self.fore(q, left));
        let body = join(join(body, hind, 0.12), fore, 0.12);
        join(body, self.head(&self.unturned(p)), 0.16)
    }

    /// Where `p` was before the head turned.
    fn unturned(&self, p: &Point) -> Point {
        let angle = self.pose.turn * ramp(p.z, TWIST[0], TWIST[1]);
        if angle == 0.0 {
            return *p;
        }
        let center = Point::from(NECK);
        center + exp_rotation(&(self.axis * -angle)) * (p - center)
    }

    fn fore(&self, p: &Point, left: bool) -> f64 {
        let mut q = *p;
        if !left {
            q.x -= 0.13 * self.pose.uneven * ramp(p.z, 0.55, 0.05);
        }
        union(&self.foreleg, &q)
    }

    fn head(&self, p: &Point) -> f64 {
        let skull = union(&self.head, p);
        let eyes = both(p, 0.02, |q, _| union(&self.eye, q));
        let horns = both(p, 0.02, |q, _| union(&self.horn, q));
        let ears = both(p, 0.02, |q, left| self.ear(q, left));
        let nostrils = both(p, 0.02, |q, _| self.nostril.distance(q));
        let head = join(join(skull, ears, 0.07), horns, 0.05);
        carve(join(head, eyes, 0.02), nostrils, 0.03)
    }

    fn ear(&self, p: &Point, left: bool) -> f64 {
        let q = if left { self.unbent(p) } else { *p };
        carve(self.ear.distance(&q), self.ear_hollow.distance(&q), 0.03)
    }

    /// Where `p` was before the left ear bent outwards.
    fn unbent(&self, p: &Point) -> Point {
        let angle = 0.5 * self.pose.uneven * ramp(p.z, 1.62, 1.9);
        if angle == 0.0 {
            return *p;
        }
        let root = Point::from(EAR);
        root + rotation_about_x(angle) * (p - root)
    }
}

fn rotation_about_x(angle: f64) -> Matrix3 {
    exp_rotation(&(Vector::x() * angle))
}

/// The join of a left part with its mirror image; `part` learns which of the two it is.
fn both(p: &Point, blend: f64, part: impl Fn(&Point, bool) -> f64) -> f64 {
    join(part(p, true), part(&mirrored(p), false), blend)
}

fn union(parts: &Parts, p: &Point) -> f64 {
    parts
        .iter()
        .fold(f64::INFINITY, |distance, (solid, blend)| {
            match distance.is_finite() {
                true => join(distance, solid.distance(p), *blend),
                false => solid.distance(p),
            }
        })
}

/// Rump, chest, belly and tail.
fn trunk() -> Parts {
    let mut parts = vec![
        (ellipsoid([-0.44, 0.0, 0.68], [0.36, 0.28, 0.3]), 0.1),
        (ellipsoid([0.27, 0.0, 0.71], [0.36, 0.3, 0.33]), 0.3),
        (cone([-0.35, 0.0, 0.67], 0.27, [0.2, 0.0, 0.69], 0.285), 0.2),
    ];
    parts.extend(tail());
    parts
}

/// The tail curls up along an arc in the middle plane and ends in a tuft.
fn tail() -> Parts {
    const LINKS: usize = 9;
    let share = |k: usize| k as f64 / LINKS as f64;
    let joint = |k: usize| {
        let (angle, across) = (2.2 * share(k), 0.42 - 0.08 * share(k));
        [-0.7 - across * angle.sin(), 0.0, 1.2 - across * angle.cos()]
    };
    let radius = |k: usize| 0.085 - 0.03 * share(k);
    // Links share their end balls, so that a large fillet would only make knots.
    let link = |k| (cone(joint(k), radius(k), joint(k + 1), radius(k + 1)), 0.01);
    let mut parts: Parts = (0..LINKS).map(link).collect();
    parts[0].1 = 0.15;
    parts.push((
        cone([-0.96, 0.0, 1.43], 0.085, [-0.79, 0.0, 1.55], 0.03),
        0.06,
    ));
    parts
}

fn foreleg() -> Parts {
    vec![
        (cone([0.36, 0.2, 0.6], 0.17, [0.37, 0.22, 0.33], 0.1), 0.08),
        (cone([0.37, 0.22, 0.33], 0.1, [0.37, 0.22, 0.1], 0.08), 0.06),
        (ellipsoid([0.405, 0.22, 0.06], [0.135, 0.1, 0.065]), 0.05),
    ]
}

fn hindleg() -> Parts {
    vec![
        (ellipsoid([-0.48, 0.19, 0.56], [0.23, 0.15, 0.27]), 0.08),
        (
            cone([-0.45, 0.22, 0.42], 0.13, [-0.6, 0.22, 0.26], 0.085),
            0.08,
        ),
        (
            cone([-0.6, 0.22, 0.26], 0.085, [-0.56, 0.22, 0.08], 0.075),
            0.06,
        ),
        (ellipsoid([-0.51, 0.22, 0.06], [0.14, 0.1, 0.065]), 0.05),
    ]
}

/// Neck, skull, cheeks and snout.
fn head() -> Parts {
    vec![
        (cone([0.4, 0.0, 0.8], 0.23, [0.66, 0.0, 1.22], 0.17), 0.1),
        (ellipsoid([0.76, 0.0, 1.41], [0.29, 0.26, 0.25]), 0.12),
        (cone([0.9, 0.0, 1.33], 0.17, [1.14, 0.0, 1.24], 0.125), 0.14),
        (ellipsoid([1.23, 0.0, 1.31], [0.06, 0.075, 0.05]), 0.05),
    ]
}
