//! Settling a twist on the samples that slide along it, whatever the others do.

use crate::slip::ground::Ground;
use crate::slip::twist::Twist;

/// Scale, radians, at which settling begins; ours: a neighbourhood's twist errs this much elsewhere.
const WIDEST: f64 = 0.15;
/// Rounds until the scale has come down to 1.5 tolerances, and rounds there; ours.
const COOLING: i32 = 7;
const SETTLED: i32 = 4;

/// The weight 1 / (1 + a^2 / s^2)^2 of the angle `a` at the scale `s` (Geman and McClure 1985).
pub fn weight(a: f64, s: f64) -> f64 {
    (1.0 + (a / s).powi(2)).powi(-2)
}

/// The twist near `start` along which most samples `alive` slide: reweighted least squares of angles, the
/// scale falling.
pub fn settle(ground: &Ground, alive: &[u32], start: Twist) -> Option<Twist> {
    let narrow = 1.5 * ground.tolerance;
    let wide = WIDEST.max(narrow);
    let mut twist = start;
    for round in 0..COOLING + SETTLED {
        let cooled = f64::from(round.min(COOLING)) / f64::from(COOLING);
        let scale = wide * (narrow / wide).powf(cooled);
        twist = step(ground, alive, &twist, scale)?;
    }
    Some(twist)
}

/// One round: weights of the present angles, squared speeds divided out.
fn step(ground: &Ground, alive: &[u32], twist: &Twist, scale: f64) -> Option<Twist> {
    let blur = 0.25 * (ground.spacing * twist.omega.norm()).powi(2);
    let weighted = alive.iter().map(|&i| {
        let speed = twist.velocity(&ground.positions[i as usize]).norm_squared() + blur;
        (i, weight(ground.angle(twist, i), scale) / speed.max(1e-30))
    });
    Some(ground.weighted(weighted).twists()?[0])
}
