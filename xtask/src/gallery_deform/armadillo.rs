//! The armadillo raises an arm.

use std::f64::consts::FRAC_PI_4;

use symmetrizer::Result;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::picture::View;
use symmetrizer::shape::{Surface, io};

use super::exhibit::{Exhibit, Role, surface};
use super::motion::Motion;
use crate::data;

/// The arm reaches out beyond this x, above this y (the foot is below); fractions of L. The model
/// stands along y and looks along z.
const ARM: [f64; 2] = [0.12, 0.02];
/// The shoulder joint is the middle of the arm's slice from there on, this thick.
const SLICE: f64 = 0.02;
/// What is nearer to the shoulder joint is free. The upper arm is 0.1 thick.
const FREE: f64 = 0.1;

/// The arm raised by 45 degrees.
///
/// # Errors
/// Test data that is missing or damaged.
pub fn arm() -> Result<Exhibit> {
    let file = data::root()?.join("3d/armadillo.ply");
    let surface = surface(&io::read(&file)?.mesh)?;
    let is_arm = |p: &Point| p.x > ARM[0] && p.y > ARM[1];
    let middle = |inside: &dyn Fn(&Point) -> bool| {
        middle(&surface, inside).ok_or_else(|| data::damaged(&file, "there is no arm"))
    };
    let shoulder = middle(&|p| is_arm(p) && p.x < ARM[0] + SLICE)?;
    let hand = middle(&|p| is_arm(p) && (p - shoulder).norm() > 2.0 * FREE)?;
    let role = |p: &Point| match is_arm(p) {
        _ if (p - shoulder).norm() < FREE => Role::Free,
        true => Role::Moved,
        false => Role::Held,
    };
    // The arm rises in the upright plane that it points along.
    let axis = (hand - shoulder).cross(&Vector::y()).normalize();
    Ok(Exhibit {
        name: "arm",
        title: "The armadillo's arm, raised by 45°",
        handles: "The shoulder joint is the middle of the slice where the arm leaves the trunk. Whatever is within \
                  0.1 L of it is free; the arm beyond turns by 45° about the level axis through the joint across \
                  the arm; all the rest is held.",
        roles: surface.positions.iter().map(role).collect(),
        surface,
        motion: Motion {
            pivot: shoulder,
            turn: axis * FRAC_PI_4,
            shift: Vector::zeros(),
        },
        view: View::new(Vector::new(-0.5, -0.25, -1.0), Vector::y()),
        close: View::new(Vector::new(-0.9, 0.1, -0.6), Vector::y()),
        look: "The folds of skin above and below the shoulder, which should neither be ironed out nor pinched.",
        line: None,
    })
}

/// The mean of the vertices inside, by area.
fn middle(surface: &Surface, inside: &dyn Fn(&Point) -> bool) -> Option<Point> {
    let vertices = surface.positions.iter().zip(&surface.vertex_areas);
    let inside = vertices.filter(|(p, _)| inside(p));
    let (sum, area) = inside.fold((Vector::zeros(), 0.0), |(sum, area), (p, a)| {
        (sum + p.coords * *a, area + a)
    });
    (area > 0.0).then(|| Point::from(sum / area))
}
