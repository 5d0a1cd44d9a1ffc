//! The bar's two exhibits: one end is held, the other is moved.

use std::f64::consts::FRAC_PI_2;

use symmetrizer::Result;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::picture::View;
use symmetrizer::shape::Surface;

use super::bar::bar;
use super::exhibit::{Exhibit, Role, surface};
use super::motion::Motion;

/// The length of each handle, as a share of the bar's.
const HANDLE: f64 = 1.0 / 8.0;

/// The bar bent by 90 degrees.
///
/// # Errors
/// None that a right program meets.
pub fn bend() -> Result<Exhibit> {
    let bar = Bar::new()?;
    // The middle line becomes a quarter of a circle and keeps its length.
    let free = bar.end - bar.start;
    let radius = free / FRAC_PI_2;
    let pivot = Point::new(bar.end, 0.0, 0.0);
    let motion = Motion {
        pivot,
        turn: Vector::z() * FRAC_PI_2,
        shift: Vector::new(radius - free, radius, 0.0),
    };
    let view = View::new(Vector::new(-0.25, -0.3, -1.0), Vector::y());
    Ok(Exhibit {
        name: "bend",
        title: "A bar, bent by 90°",
        handles: "An eighth of the bar is held at one end; an eighth at the other end is turned by 90° and set to \
                  where it would be if the middle line were a quarter of a circle of the same length.",
        close: View::new(Vector::new(-1.0, 0.8, -0.6), Vector::y()),
        look: "The inside of the bend: a surface that resists stretching but hardly bending buckles there, and the \
               section caves in.",
        ..bar.exhibit(motion, view)
    })
}

/// The bar twisted by 90 degrees.
///
/// # Errors
/// None that a right program meets.
pub fn twist() -> Result<Exhibit> {
    let bar = Bar::new()?;
    let motion = Motion {
        pivot: Point::origin(),
        turn: Vector::x() * FRAC_PI_2,
        shift: Vector::zeros(),
    };
    let view = View::new(Vector::new(-0.35, -0.45, -1.0), Vector::y());
    Ok(Exhibit {
        name: "twist",
        title: "A bar, twisted by 90°",
        handles: "An eighth of the bar is held at one end; an eighth at the other end is turned by 90° about the \
                  bar's axis.",
        close: View::new(Vector::new(-1.0, -0.35, -0.5), Vector::y()),
        look: "The section half-way: a surface that hardly resists bending narrows there like the paper of a sweet.",
        ..bar.exhibit(motion, view)
    })
}

/// The bar along x about the origin.
struct Bar {
    surface: Surface,
    /// Where the free part starts and ends.
    start: f64,
    end: f64,
}

impl Bar {
    fn new() -> Result<Self> {
        let surface = surface(&bar())?;
        let along = surface.positions.iter().map(|p| p.x);
        let low = along.clone().fold(f64::INFINITY, f64::min);
        let high = along.fold(f64::NEG_INFINITY, f64::max);
        let handle = HANDLE * (high - low);
        Ok(Self {
            surface,
            start: low + handle,
            end: high - handle,
        })
    }

    fn exhibit(self, motion: Motion, view: View) -> Exhibit {
        let role = |p: &Point| match p.x {
            x if x <= self.start => Role::Held,
            x if x >= self.end => Role::Moved,
            _ => Role::Free,
        };
        Exhibit {
            name: "",
            title: "",
            handles: "",
            look: "",
            roles: self.surface.positions.iter().map(role).collect(),
            surface: self.surface,
            motion,
            view,
            close: view,
            line: None,
        }
    }
}
