//! The samples that stand for a surface in every later stage.

use std::sync::OnceLock;

use rayon::prelude::*;

use crate::context::Context;
use crate::error::{Error, Result};
use crate::geom::{Ambient, Point, PointIndex, Vector, any_orthogonal};
use crate::sample::blue_noise::blue_noise;
use crate::sample::crisp::Corners;
use crate::sample::relief::{Frame, Harmonics, Relief};
use crate::sample::signature::{Signature, base_radius, describe, normal};
use crate::sample::{outline, profile};
use crate::shape::ClosestPoint;
use crate::shape::curvature::Cloud;
use crate::shape::surface::{Surface, SurfacePoint};
use crate::shape::wall::Wall;

/// How the surface is sampled.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SampleParams {
    /// Samples wanted; 100 at least. 2000, ours: 800 were too few and 4000 no better on the models.
    pub count: usize,
    /// Samples wanted on an outline of the plane; 100 at least. 600, ours: the paper's gecko has 577, and more
    /// were no better.
    pub outline: usize,
}

impl Default for SampleParams {
    fn default() -> Self {
        Self {
            count: 2000,
            outline: 600,
        }
    }
}

/// A sample: a point that is tied to the surface and rides on it.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// Where on the surface.
    pub at: SurfacePoint,
    /// Position on the surface as sampled.
    pub position: Point,
    /// Unit normal of the surface as sampled.
    pub normal: Vector,
    /// Unit normal that keeps creases, where `normal` is a mean across them.
    pub crisp: Vector,
    /// Curvatures at three radii.
    pub signature: Signature,
    /// Direction of the larger curvature, where it is defined.
    pub e1: Option<Vector>,
    /// The frame in which `relief` is given: the normal of the middle curvature fit and any tangent.
    pub frame: Frame,
    /// Heights around the sample at three radii.
    pub relief: Relief,
}

/// Blue-noise samples with their neighbours.
#[derive(Debug, Clone)]
pub struct Samples {
    /// The samples.
    pub list: Vec<Sample>,
    /// Smallest distance between samples, fraction of L.
    pub spacing: f64,
    /// Area that one sample stands for, L^2.
    pub area: f64,
    /// Radius r0 of the smallest curvature fit, fraction of L.
    pub radius: f64,
    /// Where the shape lives.
    pub ambient: Ambient,
    /// For each sample the samples next to it on the surface.
    pub neighbors: Vec<Vec<u32>>,
}

impl Samples {
    /// The same with each at the nearest place of another copy of the surface.
    pub fn placed_on(&self, closest: &ClosestPoint) -> Self {
        let placed = |s: &Sample| {
            let hit = closest.nearest_facing(&s.position, &s.normal, 0.0, f64::INFINITY);
            hit.map_or(*s, |hit| Sample { at: hit.at, ..*s })
        };
        Self {
            list: self.list.par_iter().map(placed).collect(),
            neighbors: self.neighbors.clone(),
            ..*self
        }
    }

    /// Which samples are among `seeds` or at most `rings` neighbours away from them.
    pub fn around(&self, seeds: &[u32], rings: u32) -> Vec<bool> {
        let mut member = vec![false; self.list.len()];
        let mut front = seeds.to_vec();
        for _ in 0..=rings {
            front.iter().for_each(|&s| member[s as usize] = true);
            let next = front.iter().flat_map(|&s| &self.neighbors[s as usize]);
            front = next.copied().filter(|&n| !member[n as usize]).collect();
        }
        member
    }
}

/// What samples are fitted to.
struct Fitted {
    cloud: Cloud,
    corners: Corners,
    harmonics: Harmonics,
}

/// Makes samples of surface points.
pub struct Describer<'a> {
    /// The surface.
    pub surface: &'a Surface,
    /// What samples are fitted to, made when the first is asked for.
    fitted: OnceLock<Fitted>,
    /// The wall that the surface is, where it is one.
    wall: Option<&'a Wall>,
    /// Radius of the smallest curvature fit, fraction of L.
    r0: f64,
}

impl<'a> Describer<'a> {
    /// For points of `surface`, the smallest fit that of [`base_radius`] times `widening`.
    pub fn new(surface: &'a Surface, widening: f64) -> Self {
        let r0 = widening * base_radius(surface);
        Self {
            surface,
            fitted: OnceLock::new(),
            wall: None,
            r0,
        }
    }

    /// For points of an outline.
    pub fn of_outline(wall: &'a Wall) -> Self {
        Self {
            wall: Some(wall),
            ..Self::new(&wall.surface, 1.0)
        }
    }

    /// Radius of the smallest curvature fit, fraction of L.
    pub fn radius(&self) -> f64 {
        self.r0
    }

    /// The sample at a surface point.
    pub fn sample(&self, at: &SurfacePoint) -> Sample {
        if let Some(wall) = self.wall {
            return self.on_outline(wall, at);
        }
        let Fitted {
            cloud,
            corners,
            harmonics,
        } = self.fitted();
        let (signature, e1, n) = describe(self.surface, cloud, at, self.r0);
        let frame = Frame {
            n,
            e1: any_orthogonal(&n),
        };
        let position = self.surface.point(at);
        Sample {
            at: *at,
            position,
            normal: self.surface.normal(at),
            crisp: corners.normal(self.surface, at),
            signature,
            e1,
            frame,
            relief: harmonics.relief(cloud, &position, &frame, self.r0),
        }
    }

    /// The frame and the relief of the sample at a surface point, for which less is fitted.
    pub fn relief(&self, at: &SurfacePoint) -> (Frame, Relief) {
        if let Some(wall) = self.wall {
            let sample = self.on_outline(wall, at);
            return (sample.frame, sample.relief);
        }
        let Fitted {
            cloud, harmonics, ..
        } = self.fitted();
        let x = self.surface.point(at);
        let n = normal(self.surface, cloud, at, self.r0);
        let frame = Frame {
            n,
            e1: any_orthogonal(&n),
        };
        (frame, harmonics.relief(cloud, &x, &frame, self.r0))
    }

    fn fitted(&self) -> &Fitted {
        self.fitted.get_or_init(|| Fitted {
            cloud: Cloud::new(self.surface, self.r0 / 4.0),
            corners: Corners::new(self.surface),
            harmonics: Harmonics::new(),
        })
    }

    /// The sample at a point of an outline.
    fn on_outline(&self, wall: &Wall, at: &SurfacePoint) -> Sample {
        let (ring, along) = wall.along(at);
        let normal = self.surface.normal(at);
        let frame = profile::frame(wall, ring, along, 2.0 * self.r0);
        let frame = frame.unwrap_or_else(|| Frame {
            n: normal,
            e1: Vector::z().cross(&normal),
        });
        Sample {
            at: *at,
            position: self.surface.point(at),
            normal,
            crisp: self.surface.face_normals[at.face as usize],
            signature: outline::signature(wall, ring, along, self.r0),
            e1: None,
            frame,
            relief: profile::profile(wall, ring, along, &frame, self.r0),
        }
    }
}

/// Samples the surface of `describer` (section 2): blue noise, signatures, neighbour graph.
///
/// # Errors
/// [`Error::Params`] for fewer than 100 samples; [`Error::Cancelled`].
pub fn sample(
    describer: &Describer<'_>,
    params: &SampleParams,
    ctx: &mut Context<'_>,
) -> Result<Samples> {
    let surface = describer.surface;
    if params.count < 100 {
        return Err(Error::params("sample.count", "at least 100 are needed"));
    }
    let (points, spacing) = blue_noise(surface, params.count, &mut ctx.rng("sample"));
    ctx.progress(0.2)?;
    let list: Vec<Sample> = points.par_iter().map(|at| describer.sample(at)).collect();
    ctx.progress(0.9)?;
    let neighbors = neighbors(&list, 2.1 * spacing);
    Ok(Samples {
        area: surface.area() / list.len().max(1) as f64,
        list,
        spacing,
        radius: describer.r0,
        ambient: Ambient::Space,
        neighbors,
    })
}

/// Samples within `radius` whose normals agree within 75 degrees: next to each other on the
/// surface, not across a thin sheet.
fn neighbors(list: &[Sample], radius: f64) -> Vec<Vec<u32>> {
    let places: Vec<[f64; 3]> = list.iter().map(|s| s.position.coords.into()).collect();
    let index = PointIndex::new(&places);
    list.par_iter()
        .enumerate()
        .map(|(i, s)| {
            let mut near = index.within(&places[i], radius);
            near.retain(|&j| j as usize != i && list[j as usize].normal.dot(&s.normal) > 0.25);
            near
        })
        .collect()
}
