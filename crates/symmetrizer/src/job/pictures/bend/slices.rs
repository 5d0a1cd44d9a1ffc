//! Slices of a shape along its spine, and the piece of a mirror that each has in a pose.

use crate::geom::{Matrix3, Point, Vector, nearest_orthogonal, sorted_eigen};
use crate::job::pictures::bend::Chart;
use crate::picture::Tile;
use crate::picture::checks::hue;
use crate::sample::Samples;
use crate::shape::{Surface, SurfacePoint};
use crate::straighten::Bend;
use crate::transform::Plane;

/// Slices along the spine.
const SLICES: usize = 9;
/// A slice with fewer pairs is left out.
const LEAST: usize = 5;
/// How much of its slice a mirror is long.
const FILLED: f64 = 0.84;
/// How far a mirror reaches beyond the shape, fraction of L.
const BEYOND: f64 = 0.06;
/// How often the spine is smoothed: where legs begin, the middles of pairs sink.
const SMOOTH: usize = 4;

/// The slices of a shape.
pub struct Slices {
    slices: Vec<Slice>,
    /// Along and across the spine of the straight shape.
    axes: [Vector; 2],
}

struct Slice {
    /// How far along the spine its ends are from the middle of its pairs, fractions of L.
    ends: [f64; 2],
    /// Its samples with a partner, and where that is.
    pairs: Vec<[SurfacePoint; 2]>,
    /// All its samples.
    all: Vec<SurfacePoint>,
    /// Their places on the straight shape, those of pairs one after the other.
    straight: Vec<Point>,
    /// How far across the spine it is from the middle of its pairs, fraction of L.
    sunk: f64,
    /// The mean normal of its local mirrors on the input.
    normal: Vector,
    color: [u8; 3],
}

impl Slices {
    /// Of the surface made `straight`.
    pub fn new(bend: &Bend, samples: &Samples, straight: &Surface, chart: &Chart) -> Self {
        let paired = bend.field.partners.iter().zip(&chart.of_samples);
        let paired = paired.filter(|(q, _)| q.is_some()).map(|(_, along)| *along);
        let (low, high) = paired.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
            (l.min(x), h.max(x))
        });
        let at = |k: usize| low + (high - low) * k as f64 / SLICES as f64;
        let slice = |k: usize| Slice::new([at(k), at(k + 1)], bend, samples, straight, chart);
        let mut slices: Vec<Slice> = (0..SLICES).filter_map(slice).collect();
        even(&mut slices, &chart.across);
        Self {
            slices,
            axes: [chart.along, chart.across],
        }
    }

    /// The mirrors of the slices where the shape lies as `surface` does, and the middles of their pairs.
    pub fn tiles(&self, surface: &Surface, mirrors: Mirrors) -> (Vec<Tile>, Vec<Point>) {
        let slices = self.slices.iter();
        slices.map(|s| s.tile(surface, &self.axes, mirrors)).unzip()
    }
}

/// Where the mirrors of slices lie.
#[derive(Debug, Clone, Copy)]
pub enum Mirrors {
    /// As those of the field, on the input.
    OfField,
    /// As those of the straight shape, turned with their pairs.
    WithPairs,
    /// In the one mirror of a symmetric shape.
    In(Plane),
}

impl Slice {
    fn new(
        [low, high]: [f64; 2],
        bend: &Bend,
        samples: &Samples,
        straight: &Surface,
        chart: &Chart,
    ) -> Option<Self> {
        let within = |s: &usize| (low..=high).contains(&chart.of_samples[*s]);
        let all: Vec<usize> = (0..samples.list.len()).filter(within).collect();
        let partner = |&s: &usize| Some((s, bend.field.partners[s]?));
        let paired: Vec<_> = all.iter().filter_map(partner).collect();
        if paired.len() < LEAST {
            return None;
        }
        let mean = paired
            .iter()
            .map(|(s, _)| chart.of_samples[*s])
            .sum::<f64>()
            / paired.len() as f64;
        let pairs: Vec<_> = paired
            .iter()
            .map(|(s, q)| [samples.list[*s].at, q.at])
            .collect();
        let normals = paired.iter().filter_map(|(s, _)| {
            let map = bend.field.maps[*s].as_ref()?;
            Some(map.nearest_mirror(&samples.list[*s].position).normal)
        });
        let tensor: Matrix3 = normals.map(|n| n * n.transpose()).sum();
        Some(Self {
            ends: [low, high].map(|end| FILLED * (end - mean) * chart.length),
            straight: pairs
                .iter()
                .flatten()
                .map(|at| straight.point(at))
                .collect(),
            pairs,
            all: all.iter().map(|&s| samples.list[s].at).collect(),
            normal: sorted_eigen(&tensor).1.column(2).into_owned(),
            sunk: 0.0,
            color: hue((low + high) / 2.0),
        })
    }

    fn tile(&self, surface: &Surface, axes: &[Vector; 2], mirrors: Mirrors) -> (Tile, Point) {
        let places: Vec<Point> = self
            .pairs
            .iter()
            .flatten()
            .map(|at| surface.point(at))
            .collect();
        let mut middle = mean(&places);
        let turn = turned(&self.straight, &places);
        let [mut along, mut across] = axes.map(|axis| turn * axis);
        let normal = match mirrors {
            Mirrors::WithPairs => None,
            Mirrors::OfField => Some(self.normal),
            Mirrors::In(plane) => {
                middle -= plane.normal * (plane.normal.dot(&middle.coords) - plane.offset);
                Some(plane.normal)
            }
        };
        if let Some(normal) = normal {
            along = (along - normal * normal.dot(&along)).normalize();
            let upright = normal.cross(&along);
            across = upright * upright.dot(&across).signum();
        }
        let heights = self
            .all
            .iter()
            .map(|at| across.dot(&(surface.point(at) - middle)));
        let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(l, h), x| (l.min(x), h.max(x)));
        let (low, high) = (low - BEYOND, high + BEYOND);
        let [from, to] = self.ends.map(|end| middle + along * end);
        let corners = [
            from + across * low,
            to + across * low,
            to + across * high,
            from + across * high,
        ];
        let color = self.color;
        (Tile { corners, color }, middle + across * self.sunk)
    }
}

/// Makes the spine run evenly in the mirror.
fn even(slices: &mut [Slice], across: &Vector) {
    let heights = slices.iter().map(|s| across.dot(&mean(&s.straight).coords));
    let heights: Vec<f64> = heights.collect();
    let mut smooth = heights.clone();
    for _ in 0..SMOOTH {
        let was = smooth.clone();
        let at = |k: usize| was[k.min(was.len() - 1)];
        for (k, h) in smooth.iter_mut().enumerate() {
            *h = (at(k.saturating_sub(1)) + 2.0 * at(k) + at(k + 1)) / 4.0;
        }
    }
    for ((slice, smooth), height) in slices.iter_mut().zip(&smooth).zip(&heights) {
        slice.sunk = smooth - height;
    }
}

/// The rotation that takes the points `x` nearest to `y`, after a shift.
fn turned(x: &[Point], y: &[Point]) -> Matrix3 {
    let (from, to) = (mean(x), mean(y));
    let pairs = x.iter().zip(y);
    let moment: Matrix3 = pairs.map(|(x, y)| (y - to) * (x - from).transpose()).sum();
    nearest_orthogonal(&moment, false)
}

fn mean(points: &[Point]) -> Point {
    let sum: Vector = points.iter().map(|p| p.coords).sum();
    Point::from(sum / points.len().max(1) as f64)
}
