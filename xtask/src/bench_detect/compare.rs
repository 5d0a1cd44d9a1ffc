//! Finds against true mirrors: how near the nearest comes, and what each find is.

use serde::Serialize;

use super::found::{Found, Symmetry};
use super::place::{Axis, Plane};
use super::truth::Cluster;
use super::verify::Verifier;

/// A find nearer than this to a rigid mirror is it: degrees, fraction of D.
pub const RIGID: [f64; 2] = [1.0, 0.005];

/// The same for a mirror of parts that bend.
pub const LOOSE: [f64; 2] = [5.0, 0.02];

/// How near the nearest find comes to a true mirror.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Nearest {
    /// Angle between the planes, degrees; none where no mirror was found at all.
    pub angle: Option<f64>,
    /// Distance of the truth's point from the plane found, % of D.
    pub offset: Option<f64>,
    /// Whether that is near enough.
    pub recalled: bool,
}

/// How near an axis comes to the true one.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct AxisError {
    /// Degrees.
    pub angle: f64,
    /// Distance of the truth's point from the axis, % of D.
    pub offset: f64,
}

/// What a find is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Standing {
    /// A true mirror.
    True,
    /// No true mirror, but it holds.
    Verified,
    /// Neither.
    False,
}

/// A find.
#[derive(Debug, Clone, Serialize)]
pub struct Find {
    /// What kind of isometry it is said to be.
    pub kind: String,
    /// What it is.
    pub standing: Standing,
    /// Share of the area, as reported.
    pub area_fraction: f64,
    /// rms residual, fraction of D, where it was looked at.
    pub residual: Option<f64>,
}

/// How near the finds come to a true mirror: the nearest one counted in units of the limits.
pub fn nearest(found: &Found, truth: &Cluster, d: f64, limits: [f64; 2]) -> Nearest {
    let errors = found.planes().map(|plane| errors(plane, truth, d));
    let far = |[angle, offset]: &[f64; 2]| angle / limits[0] + offset / limits[1];
    let best = errors.min_by(|a, b| far(a).total_cmp(&far(b)));
    Nearest {
        angle: best.map(|e| e[0]),
        offset: best.map(|e| 100.0 * e[1]),
        recalled: best.is_some_and(|e| within(e, limits)),
    }
}

/// What a find is, where `rigid` and other mirrors are true.
pub fn find(
    symmetry: &Symmetry,
    d: f64,
    [rigid, loose]: [&[Cluster]; 2],
    verifier: &Verifier<'_>,
) -> Find {
    let near = |truth: &[Cluster], limits: [f64; 2]| {
        let plane = symmetry.plane.as_ref();
        plane.is_some_and(|p| truth.iter().any(|c| within(errors(p, c, d), limits)))
    };
    let is_true = near(rigid, RIGID) || near(loose, LOOSE);
    let check = match is_true {
        true => None,
        false => verifier.check(symmetry),
    };
    let standing = match check {
        _ if is_true => Standing::True,
        Some(check) if check.holds() => Standing::Verified,
        _ => Standing::False,
    };
    Find {
        kind: symmetry.kind.clone(),
        standing,
        area_fraction: symmetry.area_fraction,
        residual: check.map(|c| c.residual),
    }
}

/// Angle in degrees and offset over D between a plane and a true mirror.
fn errors(plane: &Plane, truth: &Cluster, d: f64) -> [f64; 2] {
    [plane.angle(&truth.plane), plane.distance(&truth.point) / d]
}

fn within(errors: [f64; 2], limits: [f64; 2]) -> bool {
    errors[0] <= limits[0] && errors[1] <= limits[1]
}

/// The number of finds of a standing.
pub fn count<'a>(finds: impl IntoIterator<Item = &'a Find>, standing: Standing) -> usize {
    let same = |f: &&Find| f.standing == standing;
    finds.into_iter().filter(same).count()
}

/// The error of the axis that comes nearest to the true one in direction.
pub fn best_axis(axes: impl Iterator<Item = Axis>, truth: &Axis, d: f64) -> Option<AxisError> {
    let errors = axes.map(|axis| AxisError {
        angle: axis.angle(truth),
        offset: 100.0 * axis.distance(&truth.point) / d,
    });
    errors.min_by(|a, b| a.angle.total_cmp(&b.angle))
}

#[cfg(test)]
mod tests {
    use symmetrizer::Mesh;
    use symmetrizer::geom::{Matrix3, Point, Vector};

    use super::super::place::Motion;
    use super::super::truth::{Shape, Truth};
    use super::*;

    /// A box of 1 x 2 x 3 about the origin.
    fn cuboid() -> Shape {
        let corner = |k: u32| {
            let side = |bit: u32, size: f64| {
                if k >> bit & 1 == 1 {
                    0.5 * size
                } else {
                    -0.5 * size
                }
            };
            Point::new(side(0, 1.0), side(1, 2.0), side(2, 3.0))
        };
        let faces = [
            [0, 2, 3],
            [0, 3, 1],
            [4, 5, 7],
            [4, 7, 6],
            [0, 1, 5],
            [0, 5, 4],
            [2, 6, 7],
            [2, 7, 3],
            [0, 4, 6],
            [0, 6, 2],
            [1, 3, 7],
            [1, 7, 5],
        ];
        let mesh = Mesh::from_triangles((0..8).map(corner).collect(), faces.into());
        Shape {
            name: "cuboid".into(),
            diagonal: mesh.diagonal(),
            mesh,
            truth: Truth::None,
        }
    }

    fn mirror(normal: Vector, offset: f64) -> Symmetry {
        Symmetry {
            kind: "mirror".into(),
            motion: Motion {
                linear: Matrix3::identity() - 2.0 * normal * normal.transpose(),
                translation: 2.0 * offset * normal,
            },
            plane: Some(Plane { normal, offset }),
            axis: None,
            order: None,
            rms: 0.0,
            area_fraction: 1.0,
            patch_faces: (0..12).collect(),
            image_faces: Vec::new(),
        }
    }

    #[test]
    fn finds_are_true_or_verified_or_neither() {
        let shape = cuboid();
        let d = shape.diagonal;
        let verifier = Verifier::new(&shape);
        let truth = Cluster {
            plane: mirror(Vector::x(), 0.0).plane.unwrap(),
            point: Point::origin(),
            fraction: 1.0,
            rms: 0.0,
        };
        let standing = |s: &Symmetry| find(s, d, [&[truth], &[]], &verifier).standing;
        assert_eq!(standing(&mirror(Vector::x(), 0.004 * d)), Standing::True);
        assert_eq!(standing(&mirror(Vector::x(), 0.006 * d)), Standing::False);
        assert_eq!(standing(&mirror(Vector::y(), 0.0)), Standing::Verified);
        assert_eq!(
            standing(&mirror(Vector::new(0.6, 0.8, 0.0), 0.0)),
            Standing::False
        );
        let nothing = Symmetry {
            kind: "rotation".into(),
            plane: None,
            motion: Motion {
                linear: Matrix3::identity(),
                translation: Vector::zeros(),
            },
            ..mirror(Vector::x(), 0.0)
        };
        assert_eq!(standing(&nothing), Standing::False);
        let no_patch = Symmetry {
            patch_faces: Vec::new(),
            ..mirror(Vector::y(), 0.0)
        };
        assert_eq!(standing(&no_patch), Standing::False);
    }

    #[test]
    fn the_nearest_find_counts() {
        let truth = Cluster {
            plane: mirror(Vector::x(), 0.0).plane.unwrap(),
            point: Point::origin(),
            fraction: 1.0,
            rms: 0.0,
        };
        let tilt = 0.5_f64.to_radians();
        let tilted = Vector::new(tilt.cos(), tilt.sin(), 0.0);
        let mut found = Found::default();
        assert!(nearest(&found, &truth, 2.0, RIGID).angle.is_none());
        found.symmetries = vec![mirror(Vector::y(), 0.0), mirror(tilted, 0.004)];
        let near = nearest(&found, &truth, 2.0, RIGID);
        assert!((near.angle.unwrap() - 0.5).abs() < 1e-12);
        assert!((near.offset.unwrap() - 0.2).abs() < 1e-12);
        assert!(near.recalled);
    }
}
