//! What detection found, as its report has it (`report::DetectReport` in JSON), in the coordinates
//! of the file. What the report does not have is taken to be not there.

use serde::Deserialize;
use serde_json::Value;
use symmetrizer::geom::{Point, Vector};

use super::place::{Axis, Motion, Placement, Plane};

/// What was found in a shape.
#[derive(Debug, Default)]
pub struct Found {
    /// Single symmetries.
    pub symmetries: Vec<Symmetry>,
    /// Groups of them.
    pub groups: Vec<Group>,
    /// Continuous ones.
    pub continuous: Vec<Continuous>,
}

/// A symmetry of the shape or of parts of it.
#[derive(Debug)]
pub struct Symmetry {
    /// `mirror`, `rotation`, `translation`, `screw`, `glide`, `rotoreflection`, `inversion`.
    pub kind: String,
    /// From the patch to its image.
    pub motion: Motion,
    /// The plane of a mirror.
    pub plane: Option<Plane>,
    /// The axis of a rotation.
    pub axis: Option<Axis>,
    /// The order of a rotation.
    pub order: Option<u32>,
    /// rms distance of the moved samples from the surface, fraction of L.
    pub rms: f64,
    /// Patch and image as a share of the surface's area.
    pub area_fraction: f64,
    /// Triangles of the patch.
    pub patch_faces: Vec<u32>,
    /// Triangles of the image.
    pub image_faces: Vec<u32>,
}

/// A group of symmetries.
#[derive(Debug)]
pub struct Group {
    /// Its name, `C5`, `D2h`, `row 5`.
    pub name: String,
    /// Its axis.
    pub axis: Option<Axis>,
    /// The step of a row.
    pub step: Option<Vector>,
    /// Triangles of each copy.
    pub orbit: Vec<Vec<u32>>,
}

/// A continuous symmetry.
#[derive(Debug)]
pub struct Continuous {
    /// `revolution`, `extrusion`, `sphere`.
    pub kind: String,
    /// Its axis.
    pub axis: Option<Axis>,
}

#[derive(Deserialize)]
struct Raw {
    #[serde(default)]
    symmetries: Vec<RawSymmetry>,
    #[serde(default)]
    groups: Vec<RawGroup>,
    #[serde(default)]
    continuous: Vec<RawContinuous>,
}

#[derive(Deserialize)]
struct RawSymmetry {
    kind: String,
    matrix: [[f64; 4]; 4],
    normal: Option<[f64; 3]>,
    offset: Option<f64>,
    axis: Option<[f64; 3]>,
    point: Option<[f64; 3]>,
    order: Option<u32>,
    rms: f64,
    area_fraction: f64,
    #[serde(default)]
    patch_faces: Vec<u32>,
    #[serde(default)]
    image_faces: Vec<u32>,
}

#[derive(Deserialize)]
struct RawGroup {
    name: String,
    axis: Option<[f64; 3]>,
    point: Option<[f64; 3]>,
    step_vector: Option<[f64; 3]>,
    #[serde(default)]
    orbit: Vec<Vec<u32>>,
}

#[derive(Deserialize)]
struct RawContinuous {
    kind: String,
    axis: Option<[f64; 3]>,
    point: Option<[f64; 3]>,
}

impl Found {
    /// What a report on a shape placed by `place` says.
    ///
    /// # Errors
    /// Where the report is not of the form that is known here.
    pub fn read(report: &Value, place: &Placement) -> Result<Self, String> {
        let raw = Raw::deserialize(&report["input"]).map_err(|e| format!("the report: {e}"))?;
        let continuous = raw.continuous.into_iter().map(|c| Continuous {
            axis: axis(c.axis, c.point, place),
            kind: c.kind,
        });
        Ok(Self {
            symmetries: raw
                .symmetries
                .into_iter()
                .map(|s| symmetry(s, place))
                .collect(),
            groups: raw.groups.into_iter().map(|g| group(g, place)).collect(),
            continuous: continuous.collect(),
        })
    }

    /// The planes of the mirrors.
    pub fn planes(&self) -> impl Iterator<Item = &Plane> {
        self.symmetries.iter().filter_map(|s| s.plane.as_ref())
    }

    /// The kinds of all that was found, each with its number.
    pub fn kinds(&self) -> String {
        let single = self.symmetries.iter().map(|s| s.kind.clone());
        let groups = self.groups.iter().map(|g| format!("group {}", g.name));
        let continuous = self.continuous.iter().map(|c| c.kind.clone());
        let mut counts: Vec<(String, usize)> = Vec::new();
        for kind in single.chain(groups).chain(continuous) {
            match counts.iter_mut().find(|(k, _)| *k == kind) {
                Some((_, n)) => *n += 1,
                None => counts.push((kind, 1)),
            }
        }
        let words: Vec<String> = counts.iter().map(|(k, n)| format!("{n} {k}")).collect();
        words.join(", ")
    }
}

fn symmetry(raw: RawSymmetry, place: &Placement) -> Symmetry {
    let plane = match (raw.kind.as_str(), raw.normal, raw.offset) {
        ("mirror", Some(normal), Some(offset)) => Some(place.plane_back(Plane {
            normal: normal.into(),
            offset,
        })),
        _ => None,
    };
    Symmetry {
        plane,
        motion: place.motion_back(&Motion::from_rows(&raw.matrix)),
        axis: axis(raw.axis, raw.point, place),
        order: raw.order,
        rms: raw.rms,
        area_fraction: raw.area_fraction,
        patch_faces: raw.patch_faces,
        image_faces: raw.image_faces,
        kind: raw.kind,
    }
}

fn group(raw: RawGroup, place: &Placement) -> Group {
    Group {
        name: raw.name,
        axis: axis(raw.axis, raw.point, place),
        step: raw.step_vector.map(|s| place.step_back(s.into())),
        orbit: raw.orbit,
    }
}

fn axis(axis: Option<[f64; 3]>, point: Option<[f64; 3]>, place: &Placement) -> Option<Axis> {
    Some(Axis {
        direction: place.direction_back(Vector::from(axis?)),
        point: place.point_back(Point::from(point?)),
    })
}

#[cfg(test)]
mod tests {
    use symmetrizer::Mesh;
    use symmetrizer::geom::exp_rotation;

    use super::*;

    /// A report as it is written about a shape that was placed: a rotation, its group, a revolution.
    #[test]
    fn a_report_is_brought_back_to_the_file() {
        let truth = Axis {
            direction: Vector::new(2.0, -1.0, 2.0) / 3.0,
            point: Point::new(0.5, 0.1, -0.4),
        };
        let place = Placement::random("shape", 1, 2.0);
        let x = Point::new(-0.2, 0.9, 0.3);
        let ends = vec![truth.point, truth.point + truth.direction, x];
        let placed = place
            .mesh(&Mesh::from_triangles(ends, Vec::new()))
            .positions;
        let along = placed[1] - placed[0];
        let [axis, point]: [[f64; 3]; 2] = [along.normalize().into(), placed[0].coords.into()];
        let angle = 72_f64.to_radians();
        let turn = exp_rotation(&(along.normalize() * angle));
        let shift = placed[0].coords - turn * placed[0].coords;
        let row = |r: usize| [turn[(r, 0)], turn[(r, 1)], turn[(r, 2)], shift[r]];
        let matrix = [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]];
        let report = serde_json::json!({ "input": {
            "symmetries": [{
                "id": 0, "kind": "rotation", "matrix": matrix, "axis": axis, "point": point,
                "angle_deg": 72.0, "order": 5, "rms": 0.001, "area_fraction": 0.9,
                "patch_faces": [0, 1], "image_faces": [2],
            }],
            "groups": [{
                "name": "C5", "order": 5, "axis": axis, "point": point, "step_vector": along.as_slice(),
                "symmetries": [0], "orbit": [[0, 1], [2]],
            }],
            "continuous": [{ "kind": "revolution", "axis": axis, "point": point }],
        }});
        let found = Found::read(&report, &place).unwrap();
        assert_eq!(found.kinds(), "1 rotation, 1 group C5, 1 revolution");
        let axes = [
            found.symmetries[0].axis,
            found.groups[0].axis,
            found.continuous[0].axis,
        ];
        for axis in axes.map(Option::unwrap) {
            assert!(axis.angle(&truth) < 1e-6 && axis.distance(&truth.point) < 1e-9);
        }
        assert!((found.groups[0].step.unwrap() - truth.direction).norm() < 1e-9);
        assert_eq!(found.groups[0].orbit, [vec![0, 1], vec![2]]);
        let wanted = truth.point + exp_rotation(&(truth.direction * angle)) * (x - truth.point);
        assert!((found.symmetries[0].motion.apply(&x) - wanted).norm() < 1e-9);
        assert_eq!(found.symmetries[0].order, Some(5));
    }

    #[test]
    fn a_report_of_another_form_is_an_error() {
        let place = Placement::random("shape", 1, 2.0);
        let report = serde_json::json!({ "input": { "symmetries": [{ "kind": "mirror" }] } });
        assert!(Found::read(&report, &place).unwrap_err().contains("matrix"));
        assert!(Found::read(&serde_json::json!({}), &place).is_err());
    }
}
