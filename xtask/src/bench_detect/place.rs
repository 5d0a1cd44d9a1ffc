//! Where a shape is put before detection sees it, and the way back to the coordinates of its file.

use nalgebra::{Quaternion, UnitQuaternion};
use rand::{Rng, RngExt};
use symmetrizer::geom::{Matrix3, Point, Vector};
use symmetrizer::shape::Surface;
use symmetrizer::{Context, Mesh};

/// Shifts reach this far along each axis, in units of the bounding-box diagonal D.
const SHIFT: f64 = 3.0;

/// Scales lie between 10^-3 and 10^3.
const DECADES: f64 = 3.0;

/// The similarity x -> scale R x + shift.
#[derive(Debug, Clone, Copy)]
pub struct Placement {
    rotation: Matrix3,
    scale: f64,
    shift: Vector,
}

/// An isometry x -> linear x + translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// Orthogonal.
    pub linear: Matrix3,
    /// Units of the coordinates it acts on.
    pub translation: Vector,
}

/// The plane n.x = offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal n.
    pub normal: Vector,
    /// Offset along the normal.
    pub offset: f64,
}

/// A straight line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Unit direction.
    pub direction: Vector,
    /// A point on it.
    pub point: Point,
}

impl Placement {
    /// The placement of the shape `name` of diagonal `d` for a seed: any rotation, a shift of several
    /// D, a scale.
    pub fn random(name: &str, seed: u64, d: f64) -> Self {
        let mut rng = Context::new(seed).rng(&format!("place {name}"));
        let [w, i, j, k] = [(); 4].map(|()| normal_deviate(&mut rng));
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
        let scale = 10_f64.powf(rng.random_range(-DECADES..DECADES));
        let shift = Vector::from_fn(|_, _| rng.random_range(-SHIFT..SHIFT) * d * scale);
        Self {
            rotation: rotation.to_rotation_matrix().into_inner(),
            scale,
            shift,
        }
    }

    /// `mesh`, placed.
    pub fn mesh(&self, mesh: &Mesh) -> Mesh {
        let mut placed = mesh.clone();
        for p in &mut placed.positions {
            *p = Point::from(self.rotation * p.coords * self.scale + self.shift);
        }
        placed
    }

    /// A point in the coordinates of the file.
    pub fn point_back(&self, p: Point) -> Point {
        Point::from(self.rotation.tr_mul(&(p.coords - self.shift)) / self.scale)
    }

    /// A unit direction in the coordinates of the file.
    pub fn direction_back(&self, v: Vector) -> Vector {
        self.rotation.tr_mul(&v).normalize()
    }

    /// A step in the coordinates of the file.
    pub fn step_back(&self, v: Vector) -> Vector {
        self.rotation.tr_mul(&v) / self.scale
    }

    /// A plane in the coordinates of the file.
    pub fn plane_back(&self, plane: Plane) -> Plane {
        Plane {
            normal: self.direction_back(plane.normal),
            offset: (plane.offset - plane.normal.dot(&self.shift)) / self.scale,
        }
    }

    /// An isometry in the coordinates of the file: placed, moved, and placed back.
    pub fn motion_back(&self, motion: &Motion) -> Motion {
        let moved = motion.linear * self.shift + motion.translation - self.shift;
        Motion {
            linear: self.rotation.tr_mul(&motion.linear) * self.rotation,
            translation: self.step_back(moved),
        }
    }
}

impl Motion {
    /// The isometry in the rows of a homogeneous matrix.
    pub fn from_rows(rows: &[[f64; 4]; 4]) -> Self {
        Self {
            linear: Matrix3::from_fn(|r, c| rows[r][c]),
            translation: Vector::from_fn(|r, _| rows[r][3]),
        }
    }

    /// The image of a point.
    pub fn apply(&self, x: &Point) -> Point {
        Point::from(self.linear * x.coords + self.translation)
    }

    /// The way back; the linear part is taken to be orthogonal.
    pub fn inverse(&self) -> Self {
        let linear = self.linear.transpose();
        Self {
            linear,
            translation: -(linear * self.translation),
        }
    }

    /// Whether it turns left hands into right hands.
    pub fn is_improper(&self) -> bool {
        self.linear.determinant() < 0.0
    }
}

impl Plane {
    /// The angle to `other` in degrees, 0..=90.
    pub fn angle(&self, other: &Self) -> f64 {
        angle(&self.normal, &other.normal)
    }

    /// The distance of a point.
    pub fn distance(&self, x: &Point) -> f64 {
        (self.normal.dot(&x.coords) - self.offset).abs()
    }
}

impl Axis {
    /// The angle to `other` in degrees, 0..=90.
    pub fn angle(&self, other: &Self) -> f64 {
        angle(&self.direction, &other.direction)
    }

    /// The distance of a point.
    pub fn distance(&self, x: &Point) -> f64 {
        (x - self.point).cross(&self.direction).norm()
    }
}

/// The angle between two lines of directions `a` and `b`, degrees.
fn angle(a: &Vector, b: &Vector) -> f64 {
    a.cross(b).norm().atan2(a.dot(b).abs()).to_degrees()
}

/// `mesh` with its vertices moved along their normals by normal deviates of `sigma` (file units).
pub fn noisy(mesh: &Mesh, sigma: f64, rng: &mut impl Rng) -> Mesh {
    let triangles: Vec<[u32; 3]> = mesh.triangles().map(|(t, _)| t).collect();
    let surface = Surface::new(mesh.positions.clone(), triangles.into());
    let mut moved = mesh.clone();
    for (p, normal) in moved.positions.iter_mut().zip(&surface.vertex_normals) {
        *p += normal * (sigma * normal_deviate(rng));
    }
    moved
}

/// The bounding-box diagonal D of a mesh, or of points without faces, file units.
pub fn diagonal(mesh: &Mesh) -> f64 {
    if !mesh.polygons.is_empty() {
        return mesh.diagonal();
    }
    let first = mesh.positions.first().copied().unwrap_or_default();
    let grow = |(low, high): (Point, Point), p: &Point| (low.inf(p), high.sup(p));
    let (low, high) = mesh.positions.iter().fold((first, first), grow);
    (high - low).norm()
}

/// A standard normal deviate (Box and Muller).
pub fn normal_deviate(rng: &mut impl Rng) -> f64 {
    let (u, v): (f64, f64) = (rng.random(), rng.random());
    (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_back_undoes_the_placement() {
        let place = Placement::random("shape", 3, 2.0);
        let x = Point::new(0.3, -1.2, 0.7);
        let mesh = Mesh::from_triangles(vec![x], Vec::new());
        let placed = place.mesh(&mesh).positions[0];
        assert!((place.point_back(placed) - x).norm() < 1e-12);
        let plane = Plane {
            normal: Vector::new(2.0, 1.0, -2.0) / 3.0,
            offset: 0.4,
        };
        // The plane in placed coordinates, by its definition.
        let normal = place.rotation * plane.normal;
        let offset = plane.offset * place.scale + normal.dot(&place.shift);
        let back = place.plane_back(Plane { normal, offset });
        assert!((back.normal - plane.normal).norm() < 1e-12);
        assert!((back.offset - plane.offset).abs() < 1e-12);
        // Its mirror, as a matrix in placed coordinates, moves points of the file as it should.
        let mirror = Motion {
            linear: Matrix3::identity() - 2.0 * normal * normal.transpose(),
            translation: 2.0 * offset * normal,
        };
        let image = place.motion_back(&mirror).apply(&x);
        let wanted = x - 2.0 * (plane.normal.dot(&x.coords) - plane.offset) * plane.normal;
        assert!((image - wanted).norm() < 1e-11);
    }

    #[test]
    fn errors_of_planes_and_axes() {
        let tilted = Vector::new(0.0, 10_f64.to_radians().sin(), 10_f64.to_radians().cos());
        let plane = |normal, offset| Plane { normal, offset };
        assert!((plane(Vector::z(), 0.0).angle(&plane(-tilted, 1.0)) - 10.0).abs() < 1e-12);
        assert_eq!(
            plane(Vector::z(), 1.0).distance(&Point::new(5.0, 5.0, 3.0)),
            2.0
        );
        let axis = Axis {
            direction: Vector::z(),
            point: Point::new(1.0, 0.0, 9.0),
        };
        assert_eq!(axis.distance(&Point::new(4.0, 4.0, 0.0)), 5.0);
    }
}
