//! Finders of planes that know nothing: what any detection must beat.

use rand::Rng;
use symmetrizer::geom::{Matrix3, Point, Vector, sorted_eigen};

use super::place::normal_deviate;
use super::planes::Guess;

/// The planes through the centroid across the principal axes of the points, all alike sure. The
/// shortest axis comes first: of all orders that one scores best on the clouds.
pub fn principal(points: &[Point]) -> Vec<Guess> {
    let centroid = centroid(points);
    let spread = |p: &Point| (p - centroid) * (p - centroid).transpose();
    let (_, axes) = sorted_eigen(&points.iter().map(spread).sum::<Matrix3>());
    let planes = [0, 1, 2].map(|k| Guess {
        normal: axes.column(k).into(),
        point: centroid,
        confidence: 1.0,
    });
    planes.into()
}

/// A plane through the centroid of any direction.
pub fn random(points: &[Point], rng: &mut impl Rng) -> Vec<Guess> {
    let normal = Vector::from_fn(|_, _| normal_deviate(rng));
    vec![Guess {
        normal,
        point: centroid(points),
        confidence: 1.0,
    }]
}

/// The mean of the points.
pub fn centroid(points: &[Point]) -> Point {
    let sum: Vector = points.iter().map(|p| p.coords).sum();
    Point::from(sum / points.len().max(1) as f64)
}
