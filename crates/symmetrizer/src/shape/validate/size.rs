//! Where a shape is, how large it is and how many digits its coordinates have.

use serde::Serialize;

use super::finding::{Finding, Tally};
use super::kind::Kind;
use crate::geom::{Point, Vector};
use crate::shape::mesh::{Mesh, is_finite};

/// Diagonals from the origin beyond which single precision leaves few digits to the shape.
const FAR: f64 = 1e4;
/// Diagonals that are called usual, model units.
const USUAL: std::ops::RangeInclusive<f64> = 1e-6..=1e6;

/// Place and size of a shape, of the finite vertices that faces use, or of all finite ones where
/// there are no faces. Model units.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Size {
    /// The least coordinates.
    pub low: [f64; 3],
    /// The greatest coordinates.
    pub high: [f64; 3],
    /// The bounding-box diagonal D.
    pub diagonal: f64,
    /// The distance of the box's centre from the origin.
    pub offset: f64,
    /// Whether all coordinates have the digits of single precision: they are such numbers, or
    /// decimals of at most seven digits.
    pub single_precision: bool,
}

impl Size {
    /// The size of `mesh`, of which faces use the vertices marked in `used`; none where no vertex
    /// has a place.
    pub fn of(mesh: &Mesh, used: &[bool]) -> Option<Self> {
        let all = mesh.polygons.is_empty();
        let positions = || {
            let marked = mesh.positions.iter().zip(used);
            let counted = marked.filter(move |(_, used)| all || **used);
            counted.map(|(p, _)| p).filter(|p| is_finite(p))
        };
        positions().next()?;
        let (mut low, mut high) = (
            Vector::repeat(f64::INFINITY),
            Vector::repeat(-f64::INFINITY),
        );
        for p in positions() {
            low = low.inf(&p.coords);
            high = high.sup(&p.coords);
        }
        Some(Self {
            low: low.into(),
            high: high.into(),
            diagonal: (high - low).norm(),
            offset: (0.5 * low + 0.5 * high).norm(),
            single_precision: positions().all(|p| p.iter().all(|&c| is_single(c))),
        })
    }

    /// The centre of the box.
    pub fn center(&self) -> Point {
        let [low, high] = [self.low, self.high].map(Vector::from);
        Point::from(0.5 * low + 0.5 * high)
    }

    /// The findings on place, size and digits; `count` vertices are meant.
    pub(super) fn findings(&self, count: usize) -> Vec<Finding> {
        let mut found = Vec::new();
        let diagonals = self.offset / self.diagonal;
        if self.diagonal > 0.0 && diagonals > FAR {
            found.push(self.far_away(diagonals, count));
        }
        if self.diagonal > 0.0 && !USUAL.contains(&self.diagonal) {
            let what = format!("The bounding-box diagonal is {:.3e} units.", self.diagonal);
            found.push(Finding::new(Kind::ExtremeSize, Tally::of(count)).adding(&what));
        }
        if self.single_precision {
            found.push(Finding::new(Kind::SinglePrecision, Tally::of(count)));
        }
        found
    }

    fn far_away(&self, diagonals: f64, count: usize) -> Finding {
        let finding = Finding::new(Kind::FarAway, Tally::of(count));
        let away =
            format!("The shape stands {diagonals:.1e} times its own size away from the origin");
        if self.single_precision {
            return finding.adding(&format!(
                "{away}, in coordinates of single precision: most of their digits say where it \
                 stands and few are left for its form, which comes out in steps."
            ));
        }
        Finding {
            action: Kind::ExtremeSize.action().to_owned(),
            ..finding
        }
        .adding(&format!(
            "{away}, in coordinates with digits enough for that."
        ))
    }
}

/// Whether `c` is a number of single precision or a decimal of at most seven digits.
fn is_single(c: f64) -> bool {
    f64::from(c as f32) == c || format!("{c:.6e}").parse() == Ok(c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_tell_the_precision() {
        assert!(
            [0.0, -0.5, 0.1, 1234.567, f64::from(0.1_f32)]
                .into_iter()
                .all(is_single)
        );
        assert!(!is_single(0.123_456_78));
        assert!(!is_single(1.0 / 3.0));
    }
}
