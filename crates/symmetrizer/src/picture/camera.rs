//! The orthographic camera: no perspective, so that the two halves of a symmetric shape are drawn
//! at the same size.

use crate::geom::{Point, Vector, any_orthogonal};

/// The largest width or height of a rendered picture, pixels; larger requests are cut to it.
pub const MAX_PIXELS: u32 = 4096;

/// The share of a picture's shorter side that the shape fills.
const FILL: f64 = 0.94;

/// Where a camera looks and which way is up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Unit vector from the eye into the scene.
    pub direction: Vector,
    /// Unit vector, orthogonal to `direction`, that points up in the picture.
    pub up: Vector,
}

impl View {
    /// The view along `direction` with `up` made orthogonal to it; vectors of any length. Where
    /// they are zero, parallel or not finite, a usable view is chosen instead.
    pub fn new(direction: Vector, up: Vector) -> Self {
        let direction = unit(direction).unwrap_or_else(|| -Vector::z());
        let up = unit(up)
            .map(|u| u - direction * direction.dot(&u))
            .filter(|u| u.norm() > 1e-6)
            .and_then(unit)
            .unwrap_or_else(|| any_orthogonal(&direction));
        Self { direction, up }
    }

    /// The unit vector that points right in the picture.
    pub fn right(&self) -> Vector {
        self.direction.cross(&self.up)
    }

    /// Right, up and depth coordinates of a vector.
    pub fn components(&self, v: &Vector) -> Vector {
        Vector::new(self.right().dot(v), self.up.dot(v), self.direction.dot(v))
    }

    /// The box around `points` in right, up and depth coordinates relative to `origin`: its
    /// centre and half sizes, or `None` where no point is finite.
    pub(super) fn bounds<'a>(
        &self,
        points: impl Iterator<Item = &'a Point>,
        origin: &Point,
    ) -> Option<(Vector, Vector)> {
        let mut low = Vector::repeat(f64::INFINITY);
        let mut high = Vector::repeat(f64::NEG_INFINITY);
        for p in points {
            let x = self.components(&(p - origin));
            if x.iter().all(|c| c.is_finite()) {
                low = low.inf(&x);
                high = high.sup(&x);
            }
        }
        (low.x <= high.x).then(|| ((low + high) / 2.0, (high - low) / 2.0))
    }
}

/// A view with its centre, scale and picture size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    view: View,
    right: Vector,
    center: Point,
    pixels_per_unit: f64,
    width: u32,
    height: u32,
}

impl Camera {
    /// The camera that shows the sphere of `radius` about `center` whole in a picture of `width` x
    /// `height` pixels (each cut to 1..=[`MAX_PIXELS`]).
    pub fn fit(view: View, center: Point, radius: f64, width: u32, height: u32) -> Self {
        Self::showing(view, center, [radius; 2], width, height)
    }

    /// The camera that shows the rectangle with half sides `half` (right, up; model units) about
    /// `center` whole.
    pub fn showing(view: View, center: Point, half: [f64; 2], width: u32, height: u32) -> Self {
        let (width, height) = (width.clamp(1, MAX_PIXELS), height.clamp(1, MAX_PIXELS));
        let scale = |pixels: u32, half: f64| FILL * 0.5 * f64::from(pixels) / half;
        let pixels_per_unit = scale(width, half[0]).min(scale(height, half[1]));
        Self {
            view,
            right: view.right(),
            center,
            // A shape without size is a dot in the middle at any scale.
            pixels_per_unit: if pixels_per_unit.is_normal() {
                pixels_per_unit
            } else {
                1.0
            },
            width,
            height,
        }
    }

    /// The same camera with `factor` times as many pixels each way.
    pub(super) fn finer(&self, factor: u32) -> Self {
        Self {
            pixels_per_unit: self.pixels_per_unit * f64::from(factor),
            width: self.width * factor,
            height: self.height * factor,
            ..*self
        }
    }

    /// The view.
    pub fn view(&self) -> View {
        self.view
    }

    /// Picture width, pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Picture height, pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Pixels per model unit.
    pub fn pixels_per_unit(&self) -> f64 {
        self.pixels_per_unit
    }

    /// Where a point appears: pixels from the left, pixels from the top, and depth away from the
    /// eye, in pixels too.
    pub fn project(&self, p: &Point) -> Vector {
        let v = (p - self.center) * self.pixels_per_unit;
        Vector::new(
            0.5 * f64::from(self.width) + self.right.dot(&v),
            0.5 * f64::from(self.height) - self.view.up.dot(&v),
            self.view.direction.dot(&v),
        )
    }

    /// A direction in the camera's own axes: right, up, towards the eye.
    pub fn turn(&self, v: &Vector) -> Vector {
        Vector::new(
            self.right.dot(v),
            self.view.up.dot(v),
            -self.view.direction.dot(v),
        )
    }
}

/// The unit vector along `v`, or `None` where it has no direction.
pub(super) fn unit(v: Vector) -> Option<Vector> {
    // Dividing by the largest component first keeps tiny and huge vectors from under- or overflow.
    let v = v / v.amax();
    let n = v.norm();
    (n.is_finite() && n > 0.0).then(|| v / n)
}
