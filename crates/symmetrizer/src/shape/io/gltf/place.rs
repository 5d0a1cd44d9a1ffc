//! From the coordinates of a mesh to the world and back, vertex by vertex.

use std::rc::Rc;

use nalgebra::{Matrix3, Matrix4};

use crate::geom::{Point, Vector};

/// Where the vertices of a block are.
pub(super) enum Place {
    /// All where a node is.
    Fixed(Frame),
    /// Each between the joints of a skeleton.
    Skinned(Skinned),
}

/// Vertices between the joints of a skeleton.
pub(super) struct Skinned {
    /// World from mesh coordinates, of a vertex that follows one joint only.
    pub joints: Rc<Vec<Matrix4<f64>>>,
    /// Joints and weights, four of each per vertex, set after set; every joint is in `joints`.
    pub sets: Vec<(Vec<f64>, Vec<f64>)>,
}

impl Place {
    /// The place of vertex `v`.
    pub fn frame(&self, v: usize) -> Frame {
        match self {
            Self::Fixed(frame) => *frame,
            Self::Skinned(skinned) => skinned.frame(v),
        }
    }

    /// Whether outsides become insides, so that the corners of faces must be turned round.
    pub fn mirrors(&self) -> bool {
        matches!(self, Self::Fixed(frame) if frame.linear.determinant() < 0.0)
    }
}

impl Skinned {
    fn frame(&self, v: usize) -> Frame {
        let mut sum = Matrix4::zeros();
        let mut total = 0.0;
        for (joints, weights) in &self.sets {
            for k in v * 4..v * 4 + 4 {
                if weights[k] != 0.0 {
                    sum += self.joints[joints[k] as usize] * weights[k];
                    total += weights[k];
                }
            }
        }
        // Weights should add up to one. A vertex without any follows its first joint.
        let first = || {
            self.sets
                .first()
                .map(|(joints, _)| self.joints[joints[v * 4] as usize])
        };
        let matrix = match total {
            0.0 => first().unwrap_or_else(Matrix4::identity),
            1.0 => sum,
            total => sum / total,
        };
        Frame::new(&matrix)
    }
}

/// An affine map from mesh to world coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    linear: Matrix3<f64>,
    offset: Vector,
}

/// What a direction is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Direction {
    /// Of unit length, across the surface.
    Normal,
    /// Of unit length, along the surface; a fourth number is the sign of the third axis.
    Tangent,
    /// A difference of positions.
    Move,
    /// A difference of normals.
    NormalChange,
    /// A difference of tangents.
    TangentChange,
}

impl Direction {
    /// `row` with length one where a direction of this kind has that; nearly so is left as it is.
    pub fn of_unit_length(self, row: [f64; 4]) -> [f64; 4] {
        let [x, y, z, sign] = row;
        let v = Vector::new(x, y, z);
        if !matches!(self, Self::Normal | Self::Tangent) || (v.norm() - 1.0).abs() <= NEARLY {
            return row;
        }
        let v = unit(v);
        [v.x, v.y, v.z, sign]
    }
}

/// How far rounding to single precision takes a length from one, with room to spare.
const NEARLY: f64 = 1e-6;

impl Frame {
    /// The map that a matrix with the last row 0 0 0 1 stands for.
    pub fn new(matrix: &Matrix4<f64>) -> Self {
        Self {
            linear: matrix.fixed_view::<3, 3>(0, 0).into(),
            offset: matrix.fixed_view::<3, 1>(0, 3).into(),
        }
    }

    fn turns(&self) -> bool {
        self.linear != Matrix3::identity()
    }

    /// A position in the world.
    pub fn position(&self, p: Point) -> Point {
        // Zero times an infinite coordinate would spoil the others.
        let turned = if self.turns() { self.linear * p } else { p };
        if self.offset == Vector::zeros() {
            turned
        } else {
            turned + self.offset
        }
    }

    /// The mesh coordinates of `world`, where `rest` is at `self.position(rest)`.
    pub fn position_back(&self, world: Point, rest: Point) -> Point {
        if !self.turns() {
            return world - self.offset;
        }
        let moved = world - self.position(rest);
        let known = moved.iter().chain(rest.iter()).all(|c| c.is_finite());
        match self.inverse() {
            Some(inverse) if known => rest + inverse * moved,
            Some(inverse) => Point::from(inverse * (world.coords - self.offset)),
            None if known => rest + self.best_inverse() * moved,
            None => rest,
        }
    }

    /// A direction in the world.
    pub fn direction(&self, what: Direction, row: [f64; 4]) -> [f64; 4] {
        self.directed(what, row, false)
    }

    /// The direction in mesh coordinates whose direction in the world is `row`.
    pub fn direction_back(&self, what: Direction, row: [f64; 4]) -> [f64; 4] {
        self.directed(what, row, true)
    }

    fn directed(&self, what: Direction, row: [f64; 4], back: bool) -> [f64; 4] {
        let [x, y, z, sign] = row;
        let Some(inverse) = self.inverse().filter(|_| self.turns()) else {
            return row;
        };
        let determinant = self.linear.determinant();
        // Changes of unit vectors keep their size where the whole mesh is scaled.
        let scale = determinant.abs().cbrt();
        let matrix = match (what, back) {
            (Direction::Normal | Direction::NormalChange, false) => inverse.transpose() * scale,
            (Direction::Normal | Direction::NormalChange, true) => self.linear.transpose() / scale,
            (Direction::Tangent | Direction::TangentChange, false) => self.linear / scale,
            (Direction::Tangent | Direction::TangentChange, true) => inverse * scale,
            (Direction::Move, false) => self.linear,
            (Direction::Move, true) => inverse,
        };
        let mut turned = matrix * Vector::new(x, y, z);
        let mut sign = sign;
        if matches!(what, Direction::Normal | Direction::Tangent) {
            turned = unit(turned);
        }
        if what == Direction::Tangent && determinant < 0.0 {
            sign = -sign;
        }
        [turned.x, turned.y, turned.z, sign]
    }

    /// `None` where the map flattens the mesh.
    fn inverse(&self) -> Option<Matrix3<f64>> {
        let size = self.linear.norm();
        let determinant = self.linear.determinant().abs();
        let flat = 1e-12 * size * size * size;
        (determinant.is_finite() && determinant > flat)
            .then(|| self.linear.try_inverse())
            .flatten()
    }

    /// What comes nearest to an inverse: moves only what the map does not flatten.
    fn best_inverse(&self) -> Matrix3<f64> {
        let transposed = self.linear.transpose();
        let damping = Matrix3::from_diagonal_element(1e-12 * self.linear.norm_squared());
        let inverse = (transposed * self.linear + damping).try_inverse();
        let best = inverse.map(|i| i * transposed);
        best.filter(|b| b.iter().all(|c| c.is_finite()))
            .unwrap_or_else(Matrix3::zeros)
    }
}

/// With length one, where it has a length.
pub(super) fn unit(v: Vector) -> Vector {
    let length = v.norm();
    if length > 0.0 && length.is_finite() {
        v / length
    } else {
        v
    }
}
