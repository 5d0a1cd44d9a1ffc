//! What the finish aims at: for each vertex its partner under the mirror and the way to it.

use rayon::prelude::*;

use crate::geom::{Point, Vector};
use crate::optimize::balance::Copy;
use crate::optimize::contact::curved;
use crate::optimize::rounds::Changed;
use crate::shape::{ClosestPoint, Hit, Surface, SurfacePoint};
use crate::transform::{Ambient, Correspondence, Isometry, Plane, displacements, optimal_mirror};

/// Closest points that draw a vertex lie within this distance, fraction of L.
const REACH: f64 = 0.05;

/// Where every vertex should go, and how asymmetric the surface is.
pub(super) struct Aim {
    /// Displacement along the normal (equation 1).
    pub targets: Vec<Vector>,
    /// Confidence in each, 0 for none.
    pub confidence: Vec<f64>,
    /// The partner of each, where it has one.
    pub copies: Vec<Vec<Copy>>,
    /// The mirror refitted to the pairs.
    pub plane: Plane,
    /// Area-weighted mean distance of the mirrored vertices from the surface, over what may be changed.
    pub asymmetry: f64,
    /// The face that each mirrored vertex is closest to, where that was asked.
    faces: Vec<Option<u32>>,
}

/// The surface under a mirror.
struct Mirrored<'a> {
    surface: &'a Surface,
    closest: &'a ClosestPoint,
    mirror: Isometry,
    /// A face at each vertex.
    at: Vec<Option<u32>>,
}

/// The mirror image of a vertex beside the surface.
#[derive(Default)]
struct Image {
    /// The face that it is closest to.
    face: Option<u32>,
    /// Its distance from the surface, fraction of L.
    distance: f64,
    /// Its partner there, where the contact means something.
    partner: Option<Partner>,
}

/// A vertex's partner.
struct Partner {
    at: SurfacePoint,
    point: Point,
    confidence: f64,
}

impl Aim {
    /// Of `surface` under `plane`, `closest` its closest points; found sooner, and the same, where there is an aim of the same
    /// triangles shortly `before`.
    pub fn at(
        surface: &Surface,
        plane: Plane,
        closest: &ClosestPoint,
        changed: &Changed,
        before: Option<&Self>,
    ) -> Self {
        let region = changed.region.as_deref();
        let mirrored = Mirrored {
            surface,
            closest,
            mirror: Isometry::mirror(&plane),
            at: surface.faces_at_vertices(),
        };
        let found: Vec<Image> = (0..surface.positions.len())
            .into_par_iter()
            .map(|v| {
                let may = region.map_or(1.0, |region| region[v]);
                // What may not be changed has no weight in anything below.
                if may == 0.0 {
                    return Image::default();
                }
                let mut image = mirrored.image(v, before.and_then(|before| before.faces[v]));
                if let Some(partner) = &mut image.partner {
                    partner.confidence *= may;
                }
                image
            })
            .collect();
        let area = |v: usize| surface.vertex_areas[v] * region.map_or(1.0, |region| region[v]);
        let total: f64 = (0..found.len()).map(area).sum();
        let weighted = (found.iter().enumerate()).map(|(v, image)| image.distance * area(v));
        let asymmetry = weighted.sum::<f64>() / total.max(f64::MIN_POSITIVE);
        let plane = refit(surface, &found, changed.ambient).unwrap_or(plane);
        let mirror = Isometry::mirror(&plane);
        let mut targets = vec![Vector::zeros(); found.len()];
        let mut confidence = vec![0.0; found.len()];
        let mut copies = vec![Vec::new(); found.len()];
        for (v, image) in found.iter().enumerate() {
            if let Some(q) = &image.partner {
                let n = surface.vertex_normals[v];
                let (d_p, _) = displacements(&surface.positions[v], &q.point, &mirror);
                targets[v] = n * n.dot(&d_p);
                confidence[v] = q.confidence;
                copies[v].push((q.at, 1.0));
            }
        }
        Self {
            targets,
            confidence,
            copies,
            plane,
            asymmetry,
            faces: found.iter().map(|image| image.face).collect(),
        }
    }
}

/// Appendix A over all vertices and their partners.
fn refit(surface: &Surface, found: &[Image], ambient: Ambient) -> Option<Plane> {
    let pairs: Vec<Correspondence> = found
        .iter()
        .enumerate()
        .filter_map(|(v, image)| {
            image.partner.as_ref().map(|q| Correspondence {
                p: surface.positions[v],
                q: q.point,
                weight: q.confidence * surface.vertex_areas[v],
            })
        })
        .collect();
    optimal_mirror(&pairs, ambient).map(|fit| fit.plane)
}

impl Mirrored<'_> {
    /// Of vertex `v`, likely near the face `guess`.
    fn image(&self, v: usize, guess: Option<u32>) -> Image {
        let (surface, closest) = (self.surface, self.closest);
        let x = self.mirror.apply(&surface.positions[v]);
        let normal = self.mirror.rotate(&surface.vertex_normals[v]);
        let nearest = closest.nearest_from(&x, f64::INFINITY, guess);
        let facing = |hit: &Hit| surface.face_normals[hit.at.face as usize].dot(&normal);
        let hit = match nearest {
            Some(hit) if facing(&hit) >= MIN_COS => Some(hit),
            _ => closest.nearest_facing(&x, &normal, MIN_COS, REACH),
        };
        let partner = hit.filter(|hit| hit.distance < REACH).and_then(|hit| {
            let away = x - hit.point;
            // Sideways contact means the image lies beyond a boundary or a fold.
            if away.dot(&normal).abs() < 0.5 * hit.distance && hit.distance > 1e-3 {
                return None;
            }
            let near = 1.0 - (hit.distance / REACH).powi(2);
            Some(Partner {
                at: hit.at,
                point: curved(surface, &hit),
                confidence: facing(&hit).powi(2) * near * near * self.mutual(v, &hit),
            })
        });
        Image {
            face: nearest.map(|hit| hit.at.face),
            distance: nearest.map_or(0.0, |hit| hit.distance),
            partner,
        }
    }

    /// 1 where the partner's own closest point is vertex `v` again, 0 where it is elsewhere: a finger that
    /// is drawn to its neighbour's image is not drawn back.
    fn mutual(&self, v: usize, hit: &Hit) -> f64 {
        let x = &self.surface.positions[v];
        let image = self.mirror.apply(&hit.point);
        let normal = self.mirror.rotate(&self.surface.normal(&hit.at));
        let back = (self.closest).nearest_facing_from(&image, &normal, MIN_COS, REACH, self.at[v]);
        back.map_or(0.0, |back| {
            let missed = (back.point - x).norm() / (hit.distance + 0.01);
            let s = (1.0 - missed).clamp(0.0, 1.0);
            1.0 - (1.0 - s).powi(4)
        })
    }
}

/// Partners face the mirrored normal at least this well.
const MIN_COS: f64 = 0.2;
