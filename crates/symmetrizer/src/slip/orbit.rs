//! How far parts go round their axis: planes that merely lie across it, helices that hardly turn.

use std::f64::consts::TAU;

use crate::geom::{PointIndex, any_orthogonal};
use crate::slip::classify::Kind;
use crate::slip::ground::Ground;
use crate::slip::part::Part;

/// Places looked at on a sample's circle about the axis; ours.
const PLACES: usize = 16;
/// Share of them that the part must reach where it lies flat across the axis; ours.
const REACHED: f64 = 0.7;
/// Smallest share of the part that does not lie flat, and so tells where the axis is; ours.
const FIRM: f64 = 0.1;

/// The part without what lies flat across the axis and does not go round; `None` where nearly nothing
/// else is left, as on a plate with a hole.
pub fn round(ground: &Ground, part: &Part, kind: &Kind) -> Option<Part> {
    let axis = kind.axis?;
    let flat = |i: u32| {
        let n = &ground.normals[i as usize];
        n.cross(&axis).norm() < 2.0 * ground.gate()
    };
    let places: Vec<[f64; 3]> = part
        .samples
        .iter()
        .map(|&i| ground.positions[i as usize].coords.into())
        .collect();
    let index = PointIndex::new(&places);
    let reach = (1.5 * ground.spacing).powi(2);
    let e1 = any_orthogonal(&axis);
    let e2 = axis.cross(&e1);
    let goes_round = |i: u32| {
        let arm = ground.positions[i as usize] - kind.point;
        let foot = kind.point + axis * arm.dot(&axis);
        let radius = arm.cross(&axis).norm();
        let reached = (0..PLACES).filter(|&k| {
            let (sin, cos) = (TAU * k as f64 / PLACES as f64).sin_cos();
            let place = foot + radius * (cos * e1 + sin * e2);
            let nearest = index.nearest(&place.coords.into());
            nearest.is_some_and(|(_, d2)| d2 < reach)
        });
        reached.count() as f64 >= REACHED * PLACES as f64
    };
    let kept = part.retained(|i| !flat(i) || goes_round(i));
    let firm = kept.samples.iter().filter(|&&i| !flat(i)).count();
    (firm as f64 >= FIRM * kept.samples.len() as f64).then_some(kept)
}

/// Directions about the axis told apart; ours.
const SECTORS: usize = 16;
/// Fewest of them in which a surface of revolution lies; ours: what is gently curved turns about some
/// axis far away.
pub const ARC: usize = 3;
/// Fewest of them in which a helix lies; ours: by pitch and axis a screw fits more by chance.
pub const WINDING: usize = 12;

/// The number of directions, of 16, in which the part lies from its axis.
pub fn sectors(ground: &Ground, part: &Part, kind: &Kind) -> usize {
    let axis = kind.axis.unwrap_or_default();
    let e1 = any_orthogonal(&axis);
    let e2 = axis.cross(&e1);
    let mut seen = [false; SECTORS];
    for &i in &part.samples {
        let arm = ground.positions[i as usize] - kind.point;
        let turns = arm.dot(&e2).atan2(arm.dot(&e1)).rem_euclid(TAU) / TAU;
        seen[(turns * SECTORS as f64) as usize % SECTORS] = true;
    }
    seen.iter().filter(|s| **s).count()
}
