//! Groups and continuous symmetries as the report has them.

use serde::Serialize;

use crate::detect::Group;
use crate::job::Detected;
use crate::optimize::orbit::{Goal, Orbit};
use crate::report::faces::FaceSamples;
use crate::report::place::{Matrix, Place};
use crate::slip::{Continuous, Slip};

/// Symmetries that belong together, in document coordinates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroupReport {
    /// Schoenflies symbol of a point group, or `row 5`, `grid 3x4`, `6 copies`.
    pub name: String,
    /// The number of elements of a point group, or of copies.
    pub order: usize,
    /// The unit main axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// The fixed point, or a point of the row.
    pub point: [f64; 3],
    /// The step from one copy of a row to the next, rows of its 4x4 matrix.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<Matrix>,
    /// By how much the step moves `point`: the translation, where the step is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step_vector: Option<[f64; 3]>,
    /// The elements of a point group, or the motions from the first copy to each.
    pub elements: Vec<Matrix>,
    /// Ids of its symmetries.
    pub symmetries: Vec<u32>,
    /// Triangles of each copy, where copies are apart.
    pub orbit: Vec<Vec<u32>>,
}

/// A part that slides along itself, in document coordinates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ContinuousReport {
    /// How it slides.
    pub kind: Slip,
    /// Unit axis, direction of an extrusion or normal of a plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// A point of the axis or plane, or the middle of a sphere.
    pub point: [f64; 3],
    /// Shift of a helix per radian.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch: Option<f64>,
    /// The part as a share of the surface's area.
    pub area_fraction: f64,
    /// rms angle between the slide and the surface, degrees.
    pub rms_deg: f64,
    /// Triangles of the part.
    pub faces: Vec<u32>,
}

/// Symmetries that were made exact together, in document coordinates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExactReport {
    /// As in the step that did it.
    pub name: String,
    /// Ids of its symmetries.
    pub symmetries: Vec<u32>,
    /// All elements of a group but the identity, or the motions from the first copy to each; products of a group's
    /// elements are elements to rounding. None for slides, which have any number.
    pub elements: Vec<Matrix>,
    /// The unit axis of a slide, and a point of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[[f64; 3]; 2]>,
}

/// The `goals` that were met on a shape that is now as `found`.
pub fn exact(found: &Detected, goals: &[Goal]) -> Vec<ExactReport> {
    let place = Place(&found.working);
    let report = |goal: &Goal| ExactReport {
        name: goal.name.clone(),
        symmetries: goal.symmetries.clone(),
        elements: goal.elements().iter().map(|t| place.matrix(t)).collect(),
        axis: match &goal.orbit {
            Orbit::Slide(slide, _) => slide
                .axis
                .map(|axis| [axis.into(), place.point(&slide.point)]),
            _ => None,
        },
    };
    goals.iter().map(report).collect()
}

/// All groups that were `found`.
pub fn groups(found: &Detected, faces: &FaceSamples) -> Vec<GroupReport> {
    let groups = found.detection.groups.iter();
    groups.map(|g| group(g, found, faces)).collect()
}

/// All continuous symmetries that were `found`.
pub fn continuous(found: &Detected, faces: &FaceSamples) -> Vec<ContinuousReport> {
    let all = found.detection.continuous.iter();
    all.map(|c| slide(c, found, faces)).collect()
}

fn group(group: &Group, found: &Detected, faces: &FaceSamples) -> GroupReport {
    let place = Place(&found.working);
    let step = group.step.as_ref();
    GroupReport {
        name: group.name.clone(),
        order: group.order,
        axis: group.axis.map(Into::into),
        point: place.point(&group.point),
        step: step.map(|t| place.matrix(t)),
        step_vector: step.map(|t| place.shift(&(t.apply(&group.point) - group.point))),
        elements: group.elements.iter().map(|t| place.matrix(t)).collect(),
        symmetries: group.symmetries.clone(),
        orbit: group
            .orbit
            .iter()
            .map(|samples| place.faces(faces.of_samples(samples)))
            .collect(),
    }
}

fn slide(slide: &Continuous, found: &Detected, faces: &FaceSamples) -> ContinuousReport {
    let place = Place(&found.working);
    let scale = found.working.normalization.scale;
    ContinuousReport {
        kind: slide.slip,
        axis: slide.axis.map(Into::into),
        point: place.point(&slide.point),
        pitch: (slide.slip == Slip::Helix).then_some(slide.pitch * scale),
        area_fraction: slide.area_fraction,
        rms_deg: slide.rms.to_degrees(),
        faces: place.faces(faces.of_samples(&slide.samples)),
    }
}
