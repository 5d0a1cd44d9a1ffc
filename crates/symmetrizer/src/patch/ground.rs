//! The surface under an isometry: which samples it carries onto the surface, and where to.

use rayon::prelude::*;

use crate::geom::{Point, PointIndex};
use crate::patch::refine::Contact;
use crate::patch::symmetry::PatchPair;
use crate::sample::Samples;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::Isometry;

/// The surface that patches are grown on.
pub struct Ground<'a> {
    /// The surface.
    pub surface: &'a Surface,
    /// Its closest points.
    pub closest: &'a ClosestPoint,
    /// Its samples.
    pub samples: &'a Samples,
}

/// For each sample the closest facing surface point to its image under `t`, where it is near enough.
pub fn touch(
    ground: &Ground<'_>,
    t: &Isometry,
    tolerance: f64,
    min_cos: f64,
) -> Vec<Option<PatchPair>> {
    (0..ground.samples.list.len() as u32)
        .into_par_iter()
        .map(|s| touch_one(ground, t, s, tolerance, min_cos, None))
        .collect()
}

/// The same of one sample, likely near the face `guess`.
pub fn touch_one(
    ground: &Ground<'_>,
    t: &Isometry,
    sample: u32,
    tolerance: f64,
    min_cos: f64,
    guess: Option<u32>,
) -> Option<PatchPair> {
    let s = &ground.samples.list[sample as usize];
    let (image, normal) = (t.apply(&s.position), t.rotate(&s.normal));
    let hit = ground
        .closest
        .nearest_facing_from(&image, &normal, min_cos, tolerance, guess)?;
    Some(PatchPair {
        sample,
        partner: hit.at,
        residual: hit.distance,
    })
}

/// The pairs of a patch as contacts of weight 1.
pub fn contacts(ground: &Ground<'_>, grown: &[PatchPair]) -> Vec<Contact> {
    grown
        .iter()
        .map(|pair| Contact {
            x: ground.samples.list[pair.sample as usize].position,
            y: ground.surface.point(&pair.partner),
            normal: ground.surface.normal(&pair.partner),
            weight: 1.0,
        })
        .collect()
}

/// The samples that lie in the image of a patch: those next to a partner and facing its way.
pub fn image(ground: &Ground<'_>, grown: &[PatchPair]) -> Vec<u32> {
    let partners: Vec<Point> = grown
        .iter()
        .map(|p| ground.surface.point(&p.partner))
        .collect();
    let places: Vec<[f64; 3]> = partners.iter().map(|p| p.coords.into()).collect();
    let index = PointIndex::new(&places);
    let list = &ground.samples.list;
    // Partners lie as densely as samples do: none is further from one than the spacing.
    (0..list.len() as u32)
        .into_par_iter()
        .filter(|&i| {
            let s = &list[i as usize];
            index
                .within(&s.position.coords.into(), ground.samples.spacing)
                .into_iter()
                .any(|k| {
                    ground
                        .surface
                        .normal(&grown[k as usize].partner)
                        .dot(&s.normal)
                        > 0.25
                })
        })
        .collect()
}
