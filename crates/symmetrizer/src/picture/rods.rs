//! Straight lines in space: thin tubes among the triangles, for axes and arrows.

use crate::geom::{Point, Vector, any_orthogonal};
use crate::picture::camera::unit;

/// Sides of a tube.
const SIDES: usize = 12;
/// How much wider than its tube an arrow's head is, and how long in widths of the head.
const HEAD: [f64; 2] = [2.6, 2.4];

/// A line from one point to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rod {
    /// Where it begins.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// Half its width, model units.
    pub radius: f64,
    /// Whether it ends in a head.
    pub arrow: bool,
    /// sRGB.
    pub color: [u8; 3],
}

impl Rod {
    /// Its triangles, three corners after one another; none for a line without length.
    pub(super) fn corners(&self) -> Vec<Point> {
        let along = self.to - self.from;
        let Some(axis) = unit(along) else {
            return Vec::new();
        };
        let across = any_orthogonal(&axis) * self.radius;
        let head = match self.arrow {
            true => (HEAD[0] * HEAD[1] * self.radius).min(along.norm()),
            false => 0.0,
        };
        let neck = self.to - axis * head;
        let profile = [
            (self.from, 0.0),
            (self.from, 1.0),
            (neck, 1.0),
            (neck, if self.arrow { HEAD[0] } else { 1.0 }),
            (self.to, 0.0),
        ];
        let mut corners = Vec::new();
        for side in 0..SIDES {
            let [a, b] = [side, side + 1].map(|k| spoke(&axis, &across, k));
            for ends in profile.windows(2) {
                let [(p, r), (q, s)] = [ends[0], ends[1]];
                corners.extend([p + a * r, p + b * r, q + b * s]);
                corners.extend([p + a * r, q + b * s, q + a * s]);
            }
        }
        corners
    }
}

/// The `k`-th of the directions across the axis, as long as the tube is wide.
fn spoke(axis: &Vector, across: &Vector, k: usize) -> Vector {
    let angle = std::f64::consts::TAU * (k % SIDES) as f64 / SIDES as f64;
    across * angle.cos() + axis.cross(across) * angle.sin()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rod_is_closed_and_as_long_as_it_says() {
        let rod = Rod {
            from: Point::new(1.0, 0.0, 0.0),
            to: Point::new(1.0, 0.0, 5.0),
            radius: 0.1,
            arrow: true,
            color: [0; 3],
        };
        let corners = rod.corners();
        // The signed volumes to the origin add up to that of a closed surface: a tube and a cone.
        let volume: f64 = corners
            .chunks_exact(3)
            .map(|t| t[0].coords.cross(&t[1].coords).dot(&t[2].coords) / 6.0)
            .sum();
        let polygon = 0.5 * SIDES as f64 * (std::f64::consts::TAU / SIDES as f64).sin();
        let head = HEAD[0] * HEAD[1] * 0.1;
        let wanted = polygon * 0.01 * (5.0 - head) + polygon * (HEAD[0] * 0.1).powi(2) * head / 3.0;
        assert!((volume - wanted).abs() < 1e-9, "{volume} and {wanted}");
        assert!(
            Rod {
                to: rod.from,
                ..rod
            }
            .corners()
            .is_empty()
        );
    }
}
