//! The shape in motion: the deformer, and the samples that ride on it.

use crate::context::Context;
use crate::deform::{Deformed, Deformer, Pull};
use crate::error::Result;
use crate::geom::{Point, Vector};
use crate::patch::ground::{Ground, touch};
use crate::sample::Samples;
use crate::shape::{ClosestPoint, Surface, SurfacePoint};
use crate::transform::{
    Ambient, Correspondence, Isometry, MirrorFit, Plane, displacements, optimal_mirror,
};

/// Two surface points that a symmetry exchanges, with the weight of their say.
#[derive(Debug, Clone, Copy)]
pub struct Couple {
    /// The sample it began with.
    pub sample: u32,
    /// One end.
    pub p: SurfacePoint,
    /// The other end.
    pub q: SurfacePoint,
    /// Between 0 and 1.
    pub weight: f64,
}

/// A deforming shape with its samples.
pub struct Moving<'a> {
    /// The deformation.
    pub deformer: &'a mut dyn Deformer,
    /// The samples; they ride along, so only their place on the surface counts here.
    pub samples: Samples,
    /// Stiffness length l, fraction of L.
    pub length: f64,
    /// Time step dt.
    pub step: f64,
    /// Closest points of the rest surface; those of later states follow it.
    pub closest: ClosestPoint,
}

/// The surface as it is now, ready for closest-point queries.
pub struct Snapshot {
    /// The surface.
    pub surface: Surface,
    /// Its closest points.
    pub closest: ClosestPoint,
    /// The samples where they are now; their signatures are those at rest.
    pub samples: Samples,
}

impl Snapshot {
    /// The ground for growing patches.
    pub fn ground(&self) -> Ground<'_> {
        Ground {
            surface: &self.surface,
            closest: &self.closest,
            samples: &self.samples,
        }
    }
}

impl Moving<'_> {
    /// The present surface and samples.
    pub fn snapshot(&self) -> Snapshot {
        let surface = self
            .deformer
            .rest()
            .with_positions(self.deformer.positions());
        let mut samples = self.samples.clone();
        for s in &mut samples.list {
            s.position = surface.point(&s.at);
            s.normal = surface.normal(&s.at);
        }
        let mut closest = self.closest.clone();
        closest.follow(&surface);
        Snapshot {
            closest,
            surface,
            samples,
        }
    }

    /// Present positions of both ends of each couple.
    pub fn ends(&self, couples: &[Couple]) -> Vec<(Point, Point)> {
        let at: Vec<SurfacePoint> = couples.iter().flat_map(|c| [c.p, c.q]).collect();
        let places = self.deformer.places(&at);
        places.chunks_exact(2).map(|x| (x[0], x[1])).collect()
    }

    /// One step of the deformer: every couple pulled by `displace(p, q)`, the displacements of
    /// its two ends for a full step.
    ///
    /// A sample of area A_s pulls with A_s / l^2, shared by its two ends, over dt: the result then
    /// depends neither on dt nor on the number of samples (decision 0004).
    ///
    /// # Errors
    /// As [`Deformer::deform`].
    pub fn pull(
        &mut self,
        couples: &[Couple],
        ends: &[(Point, Point)],
        displace: impl Fn(usize, &Point, &Point) -> (Vector, Vector),
        ctx: &mut Context<'_>,
    ) -> Result<Deformed> {
        let unit = self.samples.area / (2.0 * self.length * self.length * self.step);
        let pulls: Vec<Pull> = couples
            .iter()
            .zip(ends)
            .enumerate()
            .flat_map(|(i, (c, (p, q)))| {
                let (d_p, d_q) = displace(i, p, q);
                let pull = |at, x: &Point, d: Vector| Pull {
                    at,
                    target: x + d * self.step,
                    weight: unit * c.weight,
                };
                [pull(c.p, p, d_p), pull(c.q, q, d_q)]
            })
            .collect();
        self.deformer.deform(&pulls, ctx)
    }

    /// One contraction step (section 4.2): the couples' optimal mirror and equation 1.
    ///
    /// # Errors
    /// As [`Deformer::deform`].
    pub fn contract_step(
        &mut self,
        couples: &[Couple],
        ctx: &mut Context<'_>,
    ) -> Result<Option<(MirrorFit, Deformed)>> {
        let ends = self.ends(couples);
        let Some(fit) = fit_mirror(couples, &ends, self.samples.ambient) else {
            return Ok(None);
        };
        let mirror = Isometry::mirror(&fit.plane);
        let deformed = self.pull(couples, &ends, |_, p, q| displacements(p, q, &mirror), ctx)?;
        Ok(Some((fit, deformed)))
    }
}

/// Appendix A over couples at their present ends.
pub fn fit_mirror(
    couples: &[Couple],
    ends: &[(Point, Point)],
    ambient: Ambient,
) -> Option<MirrorFit> {
    let pairs: Vec<Correspondence> = couples
        .iter()
        .zip(ends)
        .map(|(c, (p, q))| Correspondence {
            p: *p,
            q: *q,
            weight: c.weight,
        })
        .collect();
    optimal_mirror(&pairs, ambient)
}

/// Couples by closest points under `plane`: each sample for which `wanted` holds with the facing
/// surface point nearest to its mirror image, weights fading to 0 at `tolerance`.
///
/// Contacts beside a boundary, where the nearest point lies sideways rather than along the normal,
/// say nothing and are left out.
pub fn guided_couples(
    snapshot: &Snapshot,
    plane: &Plane,
    tolerance: f64,
    min_cos: f64,
    wanted: impl Fn(u32) -> bool,
) -> Vec<Couple> {
    let mirror = Isometry::mirror(plane);
    touch(&snapshot.ground(), &mirror, tolerance, min_cos)
        .into_iter()
        .flatten()
        .filter(|pair| wanted(pair.sample))
        .filter_map(|pair| {
            let s = &snapshot.samples.list[pair.sample as usize];
            let image = mirror.apply(&s.position);
            let between = snapshot.surface.point(&pair.partner) - image;
            let along = between.dot(&snapshot.surface.normal(&pair.partner)).abs();
            if along < 0.5 * pair.residual && pair.residual > 0.1 * tolerance {
                return None;
            }
            Some(Couple {
                sample: pair.sample,
                p: s.at,
                q: pair.partner,
                weight: (1.0 - (pair.residual / tolerance).powi(2)).powi(2),
            })
        })
        .collect()
}
