//! Some of the motions along which a part slides: each round others, so that no finite group is preferred.

use crate::geom::{Vector, exp_rotation};
use crate::slip::{Continuous, Slip};
use crate::transform::Isometry;

/// Motions of a round.
const COUNT: usize = 12;
/// Shifts reach this far at the most, as a share of the part's extent: beyond it little is left to compare.
const REACH: f64 = 0.7;
/// The golden ratio's fractional part, and the two numbers that do the same in two dimensions: their multiples
/// modulo 1 fill the interval, or the square, evenly (M. Roberts, quasirandom sequences).
const GOLDEN: f64 = 0.618_033_988_749_895;
const PLASTIC: [f64; 2] = [0.754_877_666_246_693, 0.569_840_290_998_053];

/// The motions of a `round` of a part that slides and reaches over `extent` (fraction of L) along its axis.
pub fn slides(slide: &Continuous, extent: f64, round: usize) -> Vec<Isometry> {
    let first = (round * COUNT) as f64;
    (0..COUNT)
        .map(|k| motion(slide, extent, first + k as f64 + 1.0))
        .collect()
}

fn motion(slide: &Continuous, extent: f64, k: f64) -> Isometry {
    let axis = slide.axis.unwrap_or_else(Vector::z);
    let angle = std::f64::consts::TAU * (k * GOLDEN).fract();
    let [a, b] = PLASTIC.map(|x| (k * x).fract());
    let shift = |share: f64| REACH * extent * (2.0 * share - 1.0);
    match slide.slip {
        Slip::Revolution => turned(slide, &axis, angle, 0.0),
        Slip::Extrusion => turned(slide, &axis, 0.0, shift((k * GOLDEN).fract())),
        Slip::Helix => {
            let along = shift((k * GOLDEN).fract());
            turned(slide, &axis, along / slide.pitch, along)
        }
        Slip::Cylinder => turned(slide, &axis, std::f64::consts::TAU * a, shift(b)),
        Slip::Sphere => turned(slide, &direction(a, b), angle, 0.0),
        Slip::Plane => turned(slide, &axis, angle, 0.0),
    }
}

/// The turn by `angle` about the line along `axis` through the slide's point, and the shift along it.
fn turned(slide: &Continuous, axis: &Vector, angle: f64, along: f64) -> Isometry {
    let linear = exp_rotation(&(axis * angle));
    let centre = slide.point.coords;
    Isometry {
        linear,
        translation: centre - linear * centre + axis * along,
    }
}

/// The direction at two even coordinates of the sphere (Archimedes: its area goes with the height).
fn direction(a: f64, b: f64) -> Vector {
    let z = 2.0 * a - 1.0;
    let (sin, cos) = (std::f64::consts::TAU * b).sin_cos();
    let radius = (1.0 - z * z).max(0.0).sqrt();
    Vector::new(radius * cos, radius * sin, z)
}
