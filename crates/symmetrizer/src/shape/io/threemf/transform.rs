//! The matrices of build items and components.

use super::tag::Tag;
use super::xml::shown;
use crate::error::Result;
use crate::geom::{Matrix3, Point, Vector};

/// How far the inverse may miss, as a share of the numbers that it is made of.
const MISS: f64 = 1e-12;

/// x -> linear x + shift.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Transform {
    linear: Matrix3,
    shift: Vector,
}

impl Transform {
    /// The `transform` attribute of a tag: the rows of a matrix that is multiplied from the right,
    /// the last row being the shift. `None` for the identity and without the attribute.
    pub fn of(tag: &Tag<'_>) -> Result<Option<Self>> {
        let Some(text) = tag.value("transform")? else {
            return Ok(None);
        };
        let numbers: Option<Vec<f64>> = text
            .split_ascii_whitespace()
            .map(|w| w.parse().ok())
            .collect();
        match numbers {
            Some(n) if n.len() == 12 => Ok(Self::from_rows(&n)),
            _ => Err(tag.error(
                format!("transform=\"{}\"", shown(&text)),
                "a transform is twelve numbers",
            )),
        }
    }

    fn from_rows(n: &[f64]) -> Option<Self> {
        let linear = Matrix3::from_column_slice(&n[..9]);
        let shift = Vector::new(n[9], n[10], n[11]);
        let moves = linear != Matrix3::identity() || shift != Vector::zeros();
        moves.then_some(Self { linear, shift })
    }

    /// `inner` followed by `outer`.
    pub fn chain(outer: Option<&Self>, inner: Option<&Self>) -> Option<Self> {
        match (outer, inner) {
            (Some(o), Some(i)) => Some(Self {
                linear: o.linear * i.linear,
                shift: o.linear * i.shift + o.shift,
            }),
            (one, other) => one.or(other).cloned(),
        }
    }

    /// Where a point goes.
    pub fn apply(&self, p: &Point) -> Point {
        Point::from(self.linear * p.coords + self.shift)
    }

    /// Whether it mirrors, so that the triangles must be turned around.
    pub fn mirrors(&self) -> bool {
        self.linear.determinant() < 0.0
    }

    /// The way back, if there is one.
    pub fn inverse(&self) -> Option<Inverse<'_>> {
        let linear = self.linear.try_inverse()?;
        Some(Inverse { of: self, linear })
    }

    /// The value of a `transform` attribute.
    pub fn text(&self) -> String {
        let rows = self.linear.iter().chain(self.shift.iter());
        let words: Vec<String> = rows.map(f64::to_string).collect();
        words.join(" ")
    }
}

/// The way back through a transform.
pub(super) struct Inverse<'a> {
    of: &'a Transform,
    linear: Matrix3,
}

impl Inverse<'_> {
    /// The point that goes to `p`; `None` where rounding does not let one be found.
    pub fn apply(&self, p: &Point) -> Option<Point> {
        let mut from = self.linear * (p.coords - self.of.shift);
        // A second step takes out the rounding of the inverse.
        from += self.linear * (p - self.of.apply(&Point::from(from)));
        let sizes = self.of.linear.abs() * from.abs() + self.of.shift.abs();
        let miss = (p - self.of.apply(&Point::from(from))).norm();
        (miss <= MISS * sizes.norm()).then_some(Point::from(from))
    }
}
