//! Bends of the straight gecko, whose back runs along y: legs go along as they are, with the place of the back at
//! which they set on.

use symmetrizer::geom::Point;

/// How the back bends.
#[derive(Debug, Clone, Copy)]
pub enum Bend {
    /// Evenly over trunk and tail, by so many degrees.
    One(f64),
    /// The trunk to one side, the tail to the other.
    Two(f64),
}

/// A leg: beyond `x` to either side, between two heights, it goes with the height `at`.
struct Leg {
    x: f64,
    heights: [f64; 2],
    at: f64,
}

const LEGS: [Leg; 2] = [
    Leg {
        x: 0.06,
        heights: [0.12, 0.9],
        at: 0.2,
    },
    Leg {
        x: 0.06,
        heights: [-0.9, -0.08],
        at: -0.16,
    },
];

/// The heights over which the back bends, from the shoulders down, and where an S turns.
const FROM: f64 = 0.12;
const TURNS: f64 = -0.3;
const TO: f64 = -0.75;
/// Steps of the integration along the back.
const STEPS: usize = 2000;

/// The outline with its back bent.
pub fn bent(rest: &[Point], bend: Bend) -> Vec<Point> {
    let leg = |x: &Point| {
        LEGS.iter()
            .find(|leg| x.x.abs() > leg.x && (leg.heights[0]..=leg.heights[1]).contains(&x.y))
    };
    rest.iter()
        .map(|x| {
            let at = leg(x).map_or(x.y, |leg| leg.at);
            let ([px, py], angle) = back(at, bend);
            let (sin, cos) = angle.sin_cos();
            let (dx, dy) = (x.x, x.y - at);
            Point::new(px + cos * dx - sin * dy, py + sin * dx + cos * dy, 0.0)
        })
        .collect()
}

/// Where the height `y` of the back goes, and how it turns there, radians.
fn back(y: f64, bend: Bend) -> ([f64; 2], f64) {
    let curvature = |y: f64| -> f64 {
        let between = |low: f64, high: f64| (low..=high).contains(&y);
        match bend {
            Bend::One(degrees) if between(TO, FROM) => degrees.to_radians() / (FROM - TO),
            Bend::Two(degrees) if between(TURNS, FROM) => degrees.to_radians() / (FROM - TURNS),
            Bend::Two(degrees) if between(TO, TURNS) => -degrees.to_radians() / (TURNS - TO),
            _ => 0.0,
        }
    };
    let (mut place, mut angle) = ([0.0, FROM], 0.0);
    let step = (y - FROM) / STEPS as f64;
    for k in 0..STEPS {
        let here = FROM + (k as f64 + 0.5) * step;
        let turned = angle + curvature(here) * step.abs() / 2.0;
        place[0] -= turned.sin() * step;
        place[1] += turned.cos() * step;
        angle += curvature(here) * step.abs();
    }
    (place, angle)
}
