//! A symmetry of a surface: an isometry, the part of the surface it holds for, its pairs.

use crate::geom::Point;
use crate::sample::Samples;
use crate::shape::SurfacePoint;
use crate::transform::{Class, Isometry, Plane};

/// A sample and its symmetric partner on the surface.
#[derive(Debug, Clone, Copy)]
pub struct PatchPair {
    /// Index of the sample.
    pub sample: u32,
    /// The partner of the sample: the surface point closest to its image.
    pub partner: SurfacePoint,
    /// Distance of the partner from the image, fraction of L.
    pub residual: f64,
}

/// A verified symmetry of a part of a surface.
#[derive(Debug, Clone)]
pub struct Symmetry {
    /// Stable name within a job.
    pub id: u32,
    /// The cloud it was found in.
    pub class: Class,
    /// The isometry that carries the patch onto its image, working coordinates.
    pub q_from_p: Isometry,
    /// Kernel density of the votes it was found by.
    pub height: f64,
    /// The pairs, one for each sample of the patch, by sample. A mirror's patch is both of its sides.
    pub pairs: Vec<PatchPair>,
    /// The samples of the image, increasing; a mirror's are those of the patch.
    pub image: Vec<u32>,
    /// Patch and image as a share of the surface's area.
    pub area_fraction: f64,
    /// rms residual over the pairs, fraction of L.
    pub rms: f64,
    /// The median, over the pairs, of the share of all samples that look more like a sample than its
    /// partner does: 0 where partners are unique, 0.5 where they are any two places.
    pub confusion: f64,
    /// Whether it stands by itself, or only because it follows from others.
    pub is_evident: bool,
    /// Whether it is in the group of the whole surface.
    pub is_of_whole: bool,
    /// What speaks against it, 0 for nothing: how evenly the residuals fill the tolerance, how little
    /// alike partners look, for a mirror how high its cluster would be by chance.
    pub doubt: f64,
}

impl Symmetry {
    /// Which of `count` samples belong to the patch or to the image.
    pub fn ground(&self, count: usize) -> Vec<bool> {
        let mut member = self.membership(count);
        for &s in &self.image {
            member[s as usize] = true;
        }
        member
    }

    /// This symmetry as one that is none after all.
    pub fn refuse(self, reason: String, samples: &Samples) -> Box<Refusal> {
        let first = self.pairs.first().map(|p| &samples.list[p.sample as usize]);
        Box::new(Refusal {
            class: self.class,
            q_from_p: self.q_from_p,
            height: self.height,
            reason,
            near: first.map_or(Point::origin(), |s| s.position),
        })
    }

    /// The mirror plane; of what is none, the plane of the nearest mirror.
    pub fn plane(&self) -> Plane {
        self.q_from_p.nearest_mirror(&Point::origin()).canonical()
    }

    /// Whether less than half of the image lies in the patch: the copy is another part of the surface.
    pub fn leaves_its_place(&self) -> bool {
        let patch = |i: &&u32| self.pairs.binary_search_by_key(*i, |p| p.sample).is_ok();
        2 * self.image.iter().filter(patch).count() < self.image.len()
    }

    /// Which of `count` samples belong to the patch.
    pub fn membership(&self, count: usize) -> Vec<bool> {
        let mut member = vec![false; count];
        for pair in &self.pairs {
            member[pair.sample as usize] = true;
        }
        member
    }

    /// The symmetry cost of the pairs (section 3): the mean over the patch of the squared smallest
    /// displacement |d_p|^2 that makes it symmetric, L^2.
    pub fn cost(&self) -> f64 {
        self.rms * self.rms / 4.0
    }
}

/// Why a cluster did not become a symmetry.
#[derive(Debug, Clone)]
pub struct Refusal {
    /// The cloud of the cluster.
    pub class: Class,
    /// The cluster's isometry.
    pub q_from_p: Isometry,
    /// The cluster's height.
    pub height: f64,
    /// The reason, for people.
    pub reason: String,
    /// A point near the votes, for pictures.
    pub near: Point,
}
