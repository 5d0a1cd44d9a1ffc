//! A symmetry as the report has it: in the coordinates and indices of the document.

use serde::Serialize;

use crate::apply::measure::PlaneReport;
use crate::geom::Point;
use crate::job::Detected;
use crate::patch::{Refusal, Symmetry};
use crate::report::faces::FaceSamples;
use crate::shape::SurfacePoint;
use crate::shape::working::{Normalization, Working};
use crate::transform::Isometry;

/// A symmetry in document coordinates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SymmetryReport {
    /// Its id, kept from the input to the result.
    pub id: u32,
    /// What kind of isometry it is: `mirror`.
    pub kind: &'static str,
    /// Rows of the 4x4 matrix that carries the patch onto its image, acting on columns.
    pub matrix: [[f64; 4]; 4],
    /// The mirror n.x = offset, largest component of n positive, offset in document units.
    #[serde(flatten)]
    pub plane: PlaneReport,
    /// Whether it is one of a continuous family.
    pub continuous: bool,
    /// Kernel density of its votes.
    pub height: f64,
    /// rms distance of mirrored samples from the surface, fraction of L.
    pub rms: f64,
    /// Patch and image as a share of the surface's area.
    pub area_fraction: f64,
    /// Triangles of the patch, on the side n.x < offset, numbered after fan triangulation.
    pub patch_faces: Vec<u32>,
    /// Triangles of its image.
    pub image_faces: Vec<u32>,
    /// Vertices of the patch with their partners in the image, the nearest ones to the samples.
    pub pairs: Vec<[u32; 2]>,
}

/// A cluster that is no symmetry, in document coordinates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RefusalReport {
    /// Its mirror.
    #[serde(flatten)]
    pub plane: PlaneReport,
    /// Kernel density of its votes.
    pub height: f64,
    /// Why it was refused, for people.
    pub reason: String,
}

impl RefusalReport {
    /// `refusal` in document coordinates.
    pub fn new(refusal: &Refusal, normalization: &Normalization) -> Self {
        Self {
            plane: PlaneReport::new(
                &refusal.q_from_p.nearest_mirror(&Point::origin()),
                normalization,
            ),
            height: refusal.height,
            reason: refusal.reason.clone(),
        }
    }
}

/// All symmetries that were `found`.
pub fn all(found: &Detected, faces: &FaceSamples) -> Vec<SymmetryReport> {
    let symmetries = &found.detection.symmetries;
    symmetries.iter().map(|s| report(s, found, faces)).collect()
}

fn report(symmetry: &Symmetry, found: &Detected, faces: &FaceSamples) -> SymmetryReport {
    let working = &found.working;
    let samples = &found.detection.samples.list;
    let plane = PlaneReport::new(&symmetry.plane(), &working.normalization);
    let numbered = |faces: Vec<u32>| {
        let number = |f: u32| working.document_face[f as usize];
        faces.into_iter().map(number).collect()
    };
    let [patch, image] = faces.patch(symmetry, samples.len());
    SymmetryReport {
        id: symmetry.id,
        kind: match symmetry.class {
            crate::transform::Class::Mirror => "mirror",
            crate::transform::Class::Proper => "proper",
            crate::transform::Class::Improper => "improper",
        },
        matrix: matrix(&symmetry.q_from_p, &working.normalization),
        plane,
        continuous: false,
        height: symmetry.height,
        rms: symmetry.rms,
        area_fraction: symmetry.area_fraction,
        patch_faces: numbered(patch),
        image_faces: numbered(image),
        pairs: pairs(symmetry, found),
    }
}

/// The isometry in document coordinates as rows of a homogeneous matrix.
fn matrix(t: &Isometry, normalization: &Normalization) -> [[f64; 4]; 4] {
    // x_d = c + L x_w on both sides.
    let c = normalization.center.coords;
    let translation = c - t.linear * c + t.translation * normalization.scale;
    std::array::from_fn(|r| {
        std::array::from_fn(|c| match (r, c) {
            (3, 3) => 1.0,
            (3, _) => 0.0,
            (_, 3) => translation[r],
            _ => t.linear[(r, c)],
        })
    })
}

/// The document vertices next to each pair's ends, that of the patch's side first.
fn pairs(symmetry: &Symmetry, found: &Detected) -> Vec<[u32; 2]> {
    let samples = &found.detection.samples.list;
    let documents = &found.working.document_of_vertex;
    let vertex = |at: &SurfacePoint| documents[nearest_corner(&found.working, at) as usize];
    let mut pairs: Vec<[u32; 2]> = symmetry
        .pairs
        .iter()
        .map(|pair| {
            let sample = &samples[pair.sample as usize];
            let (i, j) = (vertex(&sample.at), vertex(&pair.partner));
            if symmetry.plane().signed_distance(&sample.position) < 0.0 {
                [i, j]
            } else {
                [j, i]
            }
        })
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}

/// The corner of its triangle that is nearest to a surface point.
fn nearest_corner(working: &Working, at: &SurfacePoint) -> u32 {
    let surface = &working.surface;
    let x = surface.point(at);
    let corners = surface.triangles[at.face as usize];
    let gap = |v: u32| (surface.positions[v as usize] - x).norm_squared();
    let [a, b, c] = corners;
    let nearer = |u: u32, v: u32| if gap(v) < gap(u) { v } else { u };
    nearer(nearer(a, b), c)
}
