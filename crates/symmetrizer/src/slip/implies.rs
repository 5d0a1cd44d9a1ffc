//! Isometries that a slide implies: those that say no more of a part than that it slides.

use crate::geom::{Point, Vector};
use crate::sample::Samples;
use crate::slip::{Continuous, Slip};
use crate::transform::Isometry;

impl Continuous {
    /// Whether `t` maps the part to itself for no other reason than its sliding: it keeps the axis, the
    /// middle or the plane where it is, but for a shift along itself where the part slides so. What it
    /// is moved by, rms over the part's samples, is at most `tolerance`, fraction of L.
    ///
    /// So a surface of revolution implies turns about its axis and mirrors that contain it; a cylinder
    /// shifts along the axis, mirrors across it and half-turns about lines that meet it at right
    /// angles besides; an extrusion shifts along its direction and mirrors across it; a helix its own
    /// screws; a plane all that keeps its side.
    pub fn implies(&self, t: &Isometry, samples: &Samples, tolerance: f64) -> bool {
        let moved = |i: &u32| {
            samples
                .list
                .get(*i as usize)
                .map_or(0.0, |s| self.moved(t, &s.position))
        };
        let sum: f64 = self.samples.iter().map(|i| moved(i).powi(2)).sum();
        let rms = (sum / self.samples.len().max(1) as f64).sqrt();
        rms <= tolerance && self.keeps_side(t)
    }

    /// How far `t` moves what the slide must find in place, as seen from `x`.
    fn moved(&self, t: &Isometry, x: &Point) -> f64 {
        let axis = self.axis.unwrap_or_default();
        let across = |v: Vector| v - axis * axis.dot(&v);
        let foot = self.point + axis * axis.dot(&(x - self.point));
        match self.slip {
            Slip::Revolution => (t.apply(&foot) - foot).norm(),
            Slip::Cylinder => across(t.apply(&foot) - self.point).norm(),
            Slip::Sphere => (t.apply(&self.point) - self.point).norm(),
            Slip::Extrusion => across(t.apply(x) - x).norm(),
            Slip::Plane => axis.dot(&(t.apply(x) - x)).abs(),
            Slip::Helix => (t.apply(x) - self.screwed(t, x)).norm(),
        }
    }

    /// Whether a plane's normal still points its way.
    fn keeps_side(&self, t: &Isometry) -> bool {
        let axis = self.axis.unwrap_or_default();
        self.slip != Slip::Plane || t.rotate(&axis).dot(&axis) > 0.0
    }

    /// `x` under the helix's own screw that shifts along the axis as `t` does.
    fn screwed(&self, t: &Isometry, x: &Point) -> Point {
        let axis = self.axis.unwrap_or_default();
        let shift = axis.dot(&(t.apply(&self.point) - self.point));
        let angle = shift / self.pitch;
        let turn = crate::geom::exp_rotation(&(axis * angle));
        self.point + turn * (x - self.point) + axis * shift
    }
}
