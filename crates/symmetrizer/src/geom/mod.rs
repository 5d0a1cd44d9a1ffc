//! Points, vectors and matrices in f64, and small linear algebra that several floors share.

pub mod nearest;
mod orthogonal;

pub use nearest::PointIndex;
pub use orthogonal::nearest_orthogonal;

/// A point of space; 2D shapes live at z = 0.
pub type Point = nalgebra::Point3<f64>;
/// A vector of space.
pub type Vector = nalgebra::Vector3<f64>;
/// A 3x3 matrix.
pub type Matrix3 = nalgebra::Matrix3<f64>;

/// Where the shapes live. In the plane the z axis is kept: a 3x3 solve on planar pairs would find
/// the useless mirror z -> -z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ambient {
    /// z = 0.
    Plane,
    /// All of space.
    Space,
}

/// The cross-product matrix: `skew(a) * b == a x b`.
pub fn skew(a: &Vector) -> Matrix3 {
    a.cross_matrix()
}

/// Eigenvalues in increasing algebraic order with their unit eigenvectors as columns.
pub fn sorted_eigen(m: &Matrix3) -> (Vector, Matrix3) {
    let e = m.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| e.eigenvalues[a].total_cmp(&e.eigenvalues[b]));
    let values = Vector::from_fn(|i, _| e.eigenvalues[order[i]]);
    let vectors = Matrix3::from_fn(|r, c| e.eigenvectors[(r, order[c])]);
    (values, vectors)
}

/// Any unit vector orthogonal to the unit vector `n`.
pub fn any_orthogonal(n: &Vector) -> Vector {
    let axis = if n.x.abs() < 0.6 {
        Vector::x()
    } else {
        Vector::y()
    };
    n.cross(&axis).normalize()
}

/// `count` unit vectors spread evenly over the sphere (Fibonacci's spiral).
pub fn directions(count: usize) -> impl Iterator<Item = Vector> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        Vector::new(r * cos, r * sin, z)
    })
}

/// The rotation `exp([omega])` about the axis omega by |omega| radians (Rodrigues).
pub fn exp_rotation(omega: &Vector) -> Matrix3 {
    nalgebra::Rotation3::new(*omega).into_inner()
}

/// The median, the upper of two; `None` of nothing. Changes the order of `values`.
pub fn median(values: &mut [f64]) -> Option<f64> {
    let middle = values.len() / 2;
    (!values.is_empty()).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
}
