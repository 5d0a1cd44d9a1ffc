//! Light on matte clay.
//!
//! Every light lies in the vertical plane through the picture's middle, or comes in a left and
//! right pair: a symmetric shape seen along its mirror plane gives a symmetric picture, and any
//! difference between the halves is the shape's own.

use crate::geom::Vector;
use crate::picture::visible::Sights;

/// Directions around a sample in which occluders are looked for; a multiple of 4, so that the
/// pattern is its own mirror image.
const DIRECTIONS: usize = 12;
/// Distances at which they are looked for, as shares of the reach.
const RINGS: [f64; 4] = [0.12, 0.3, 0.6, 1.0];
/// How dark full occlusion makes the clay.
const OCCLUSION: f64 = 1.35;

/// Linear tints of the main light, slightly warm, and of all others, slightly cool.
const SUN: [f64; 3] = [1.03, 1.0, 0.95];
const SKY: [f64; 3] = [0.96, 1.0, 1.06];

/// Linear RGB of clay with the linear colour `albedo` and the unit `normal` (right, up, towards
/// the eye), of whose surroundings the share `open` in 0..=1 is free.
pub(super) fn shade(normal: &Vector, albedo: [f64; 3], open: f64) -> [f64; 3] {
    let toward = |x: f64, y: f64, z: f64| normal.dot(&Vector::new(x, y, z).normalize());
    // Wrapped, so that the light softens into the shadow side as from a large lamp.
    let key = ((toward(0.0, 0.72, 0.7) + 0.25) / 1.25).max(0.0);
    let fill = toward(0.0, -0.25, 1.0).max(0.0);
    let sky = 0.5 + 0.5 * normal.y;
    let sides = toward(1.0, 0.1, -0.15).max(toward(-1.0, 0.1, -0.15));
    let rim = sides.max(0.0).powi(3);
    let soft = open * open;
    let sun = 0.8 * key * (0.35 + 0.65 * open);
    let rest = 0.16 * fill * open + 0.2 * sky * soft + 0.18 * rim * soft + 0.02;
    let shine = 0.05 * toward(0.0, 0.45, 0.9).max(0.0).powi(24) * open;
    std::array::from_fn(|i| soften(albedo[i] * (sun * SUN[i] + rest * SKY[i]) + shine))
}

/// Where occluders of a sample are looked for: whole samples to the right and down.
pub(super) struct Surroundings {
    reach: f64,
    offsets: Vec<(f64, f64)>,
}

impl Surroundings {
    /// The surroundings within `reach` samples.
    pub fn new(reach: f64) -> Self {
        let mut offsets = Vec::new();
        for ring in RINGS {
            for k in 0..DIRECTIONS {
                let angle = std::f64::consts::TAU * (k as f64 + 0.5) / DIRECTIONS as f64;
                let (dy, dx) = angle.sin_cos();
                offsets.push(((reach * ring * dx).round(), (reach * ring * dy).round()));
            }
        }
        Self { reach, offsets }
    }

    /// The share of the surroundings of a sample that is free of other surface, estimated from the
    /// depths around it.
    pub fn openness(&self, sights: &Sights, x: usize, y: usize, normal: &Vector) -> f64 {
        let here = sights.at(x, y).depth();
        let mut blocked = 0.0;
        for &(dx, dy) in &self.offsets {
            let (px, py) = (x as f64 + dx, y as f64 + dy);
            if px < 0.0 || py < 0.0 || px >= sights.width as f64 || py >= sights.height as f64 {
                continue;
            }
            let other = sights.at(px as usize, py as usize);
            if other.hits() {
                // Right, up, towards the eye.
                let offset = Vector::new(dx, -dy, here - other.depth());
                blocked += block(&offset, normal, self.reach);
            }
        }
        let share = blocked / self.offsets.len() as f64;
        (1.0 - OCCLUSION * share).clamp(0.0, 1.0)
    }
}

/// How much the surface at `offset` blocks, in 0..=1: what is far away in depth does not.
fn block(offset: &Vector, normal: &Vector, reach: f64) -> f64 {
    let distance = offset.norm();
    let cosine = normal.dot(offset) / distance.max(1.0);
    let near = 1.0 / (1.0 + (distance / reach).powi(2) * 0.5);
    let fade = (1.0 - (offset.z.abs() / (3.0 * reach))).clamp(0.0, 1.0);
    (cosine - 0.1).max(0.0) / 0.9 * near * fade * 1.6
}

/// Bends what is too bright below white, so that pale colours keep their shading.
fn soften(c: f64) -> f64 {
    const KNEE: f64 = 0.6;
    if c <= KNEE {
        c
    } else {
        KNEE + (1.0 - KNEE) * ((c - KNEE) / (1.0 - KNEE)).tanh()
    }
}

/// sRGB in 0..=1 to linear.
pub(super) fn to_linear(s: f64) -> f64 {
    if s <= 0.04045 {
        s / 12.92
    } else {
        ((s + 0.055) / 1.055).powf(2.4)
    }
}

/// Linear to sRGB in 0..=1; what is not finite becomes 0.
pub(super) fn to_srgb(l: f64) -> f64 {
    let l = if l.is_finite() {
        l.clamp(0.0, 1.0)
    } else {
        0.0
    };
    if l <= 0.003_130_8 {
        12.92 * l
    } else {
        1.055 * l.powf(1.0 / 2.4) - 0.055
    }
}
