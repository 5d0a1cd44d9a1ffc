//! From samples to faces: which part of the triangles each sample speaks for.

use rayon::prelude::*;

use crate::geom::{Point, PointIndex};
use crate::job::Detected;
use crate::patch::Symmetry;
use crate::sample::Samples;
use crate::shape::Surface;
use crate::transform::Class;

/// How far the sample of a face is looked for, in units of the samples' spacing: they leave no gap
/// wider than this.
const REACH: f64 = 2.5;

/// For each triangle of a surface the sample that speaks for it.
pub struct FaceSamples {
    nearest: Vec<Option<u32>>,
    centroids: Vec<Point>,
    areas: Vec<f64>,
}

impl FaceSamples {
    /// The samples nearest to the triangles of what was detected; of none in a cloud, the document of
    /// which has no triangles.
    pub fn of(found: &Detected) -> Self {
        if found.working.cloud.is_some() {
            return Self {
                nearest: Vec::new(),
                centroids: Vec::new(),
                areas: Vec::new(),
            };
        }
        Self::new(&found.working.surface, &found.detection.samples)
    }

    /// For each triangle of `surface` the sample nearest to its centroid whose normal faces the
    /// triangle's way; none for a triangle without area.
    pub fn new(surface: &Surface, samples: &Samples) -> Self {
        let list = &samples.list;
        let places: Vec<[f64; 3]> = list.iter().map(|s| s.position.coords.into()).collect();
        let index = PointIndex::new(&places);
        let count = surface.triangles.len() as u32;
        let centroids: Vec<Point> = (0..count).map(|f| centroid(surface, f)).collect();
        let nearest = centroids
            .par_iter()
            .zip(&surface.face_normals)
            .map(|(c, normal)| {
                let gap = |i: &u32| (list[*i as usize].position - c).norm_squared();
                index
                    .within(&c.coords.into(), REACH * samples.spacing)
                    .into_iter()
                    .filter(|&i| list[i as usize].normal.dot(normal) > 0.0)
                    .min_by(|a, b| gap(a).total_cmp(&gap(b)))
            })
            .collect();
        Self {
            nearest,
            centroids,
            areas: surface.face_areas.clone(),
        }
    }

    /// The working triangles that `symmetry` holds for: its patch and its image, of a mirror the sides
    /// n.x < offset and above; each increasing.
    pub fn patch(&self, symmetry: &Symmetry, samples: usize) -> [Vec<u32>; 2] {
        let patch = symmetry.membership(samples);
        if symmetry.class != Class::Mirror {
            return [
                self.faces(&patch).collect(),
                self.of_samples(&symmetry.image),
            ];
        }
        let plane = symmetry.plane();
        let above = |f: &u32| plane.signed_distance(&self.centroids[*f as usize]) >= 0.0;
        let (image, patch) = self.faces(&patch).partition(above);
        [patch, image]
    }

    /// The share of the triangles' area that `parts` cover together.
    pub fn area(&self, parts: &[(Vec<u32>, [u8; 3])]) -> f64 {
        let mut covered = vec![false; self.areas.len()];
        for &f in parts.iter().flat_map(|(faces, _)| faces) {
            covered[f as usize] = true;
        }
        let own = self.areas.iter().zip(&covered).filter(|(_, c)| **c);
        own.map(|(a, _)| a).sum::<f64>() / self.areas.iter().sum::<f64>().max(f64::MIN_POSITIVE)
    }

    /// The working triangles that some of the samples speak for, increasing.
    pub fn of_samples(&self, samples: &[u32]) -> Vec<u32> {
        let count = self.nearest.iter().flatten().max().map_or(0, |m| *m + 1);
        let mut member = vec![false; count as usize];
        for &s in samples {
            if let Some(slot) = member.get_mut(s as usize) {
                *slot = true;
            }
        }
        self.faces(&member).collect()
    }

    /// The triangles whose samples are members.
    fn faces(&self, member: &[bool]) -> impl Iterator<Item = u32> {
        let faces = self.nearest.iter().zip(0..);
        faces.filter_map(|(s, f)| s.is_some_and(|s| member[s as usize]).then_some(f))
    }
}

fn centroid(surface: &Surface, face: u32) -> Point {
    let [a, b, c] = surface.corners(face);
    Point::from((a.coords + b.coords + c.coords) / 3.0)
}
