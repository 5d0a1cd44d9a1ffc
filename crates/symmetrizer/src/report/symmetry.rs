//! A symmetry as the report has it: in the coordinates and indices of the document.

use serde::Serialize;

use crate::apply::measure::PlaneReport;
use crate::job::Detected;
use crate::patch::Symmetry;
use crate::report::faces::FaceSamples;
use crate::report::place::{Matrix, Place};
use crate::shape::SurfacePoint;
use crate::shape::working::Working;
use crate::transform::{Class, Elements, Kind, Plane};

/// A symmetry in document coordinates. What a kind does not have is left out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SymmetryReport {
    /// Its id, kept from the input to the result.
    pub id: u32,
    /// What kind of isometry it is.
    pub kind: Kind,
    /// Rows of the 4x4 matrix that carries the patch onto its image, acting on columns; exactly of its
    /// kind.
    pub matrix: Matrix,
    /// The plane n.x = offset of a mirror or glide, largest component of n positive, offset in document
    /// units.
    #[serde(flatten)]
    pub plane: Option<PlaneReport>,
    /// The unit axis of a rotation, screw or rotoreflection, largest component positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// The point of the axis nearest to the patch's centroid, or the point that an inversion or
    /// rotoreflection fixes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point: Option<[f64; 3]>,
    /// The turn about the axis, degrees in (-180, 180].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub angle_deg: Option<f64>,
    /// The least n such that the angle is a multiple of 360 / n degrees, where that is no chance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<u32>,
    /// The translation, or the shift of a screw along its axis or of a glide along its plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shift: Option<[f64; 3]>,
    /// The name of the group it belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub group: Option<String>,
    /// Whether it is one of a continuous family.
    pub continuous: bool,
    /// Kernel density of its votes.
    pub height: f64,
    /// rms distance of moved samples from the surface, fraction of L.
    pub rms: f64,
    /// Patch and image as a share of the surface's area.
    pub area_fraction: f64,
    /// Triangles of the patch, of a mirror on the side n.x < offset, numbered after fan triangulation.
    pub patch_faces: Vec<u32>,
    /// Triangles of its image.
    pub image_faces: Vec<u32>,
    /// Vertices of the patch with their partners in the image, the nearest ones to the samples.
    pub pairs: Vec<[u32; 2]>,
}

/// All symmetries that were `found`.
pub fn all(found: &Detected, faces: &FaceSamples) -> Vec<SymmetryReport> {
    let symmetries = &found.detection.symmetries;
    symmetries.iter().map(|s| report(s, found, faces)).collect()
}

fn report(symmetry: &Symmetry, found: &Detected, faces: &FaceSamples) -> SymmetryReport {
    let place = Place(&found.working);
    let elements = found.elements(symmetry);
    let has = |kinds: &[Kind]| kinds.contains(&elements.kind);
    let turns = has(&[Kind::Rotation, Kind::Screw, Kind::Rotoreflection]);
    let fixes = turns || has(&[Kind::Inversion]);
    let shifts = has(&[Kind::Translation, Kind::Screw, Kind::Glide]);
    let [patch, image] = faces.patch(symmetry, found.detection.samples.list.len());
    SymmetryReport {
        id: symmetry.id,
        kind: elements.kind,
        matrix: place.matrix(&elements.isometry()),
        plane: plane(&elements).map(|p| PlaneReport::new(&p, &found.working.normalization)),
        axis: elements.axis.filter(|_| turns).map(Into::into),
        point: fixes.then(|| place.point(&elements.point)),
        angle_deg: turns.then(|| elements.angle.to_degrees()),
        order: elements.order.filter(|_| turns),
        shift: shifts.then(|| place.shift(&elements.shift)),
        group: found.group_of(symmetry.id).map(|g| g.name.clone()),
        continuous: false,
        height: symmetry.height,
        rms: symmetry.rms,
        area_fraction: symmetry.area_fraction,
        patch_faces: place.faces(patch),
        image_faces: place.faces(image),
        pairs: pairs(symmetry, found),
    }
}

/// The plane of a mirror or glide.
fn plane(elements: &Elements) -> Option<Plane> {
    let across = matches!(elements.kind, Kind::Mirror | Kind::Glide);
    let normal = elements.axis.filter(|_| across)?;
    Some(Plane::through(&elements.point, normal))
}

/// The document vertices next to each pair's ends, that of the patch's side first.
fn pairs(symmetry: &Symmetry, found: &Detected) -> Vec<[u32; 2]> {
    let samples = &found.detection.samples.list;
    let documents = &found.working.document_of_vertex;
    let vertex = |at: &SurfacePoint| documents[nearest_corner(&found.working, at) as usize];
    // The patch of a mirror is both of its sides.
    let plane = (symmetry.class == Class::Mirror).then(|| symmetry.plane());
    let from_above = |x| plane.is_some_and(|p| p.signed_distance(&x) >= 0.0);
    let mut pairs: Vec<[u32; 2]> = symmetry
        .pairs
        .iter()
        .map(|pair| {
            let sample = &samples[pair.sample as usize];
            let (i, j) = (vertex(&sample.at), vertex(&pair.partner));
            match from_above(sample.position) {
                true => [j, i],
                false => [i, j],
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
