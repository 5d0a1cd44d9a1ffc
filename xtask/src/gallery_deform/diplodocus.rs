//! The neck of `diplodocus` is straightened.

use symmetrizer::Result;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::picture::View;
use symmetrizer::shape::{Surface, io};

use super::center_line::CenterLine;
use super::exhibit::{Exhibit, Role, surface};
use super::geodesic::distances;
use super::motion::Motion;
use crate::data;

/// Head and neck are above this share of the height; the snout is what reaches out furthest along x there.
const HIGH: f64 = 0.75;
/// The way over the surface from the snout to where the head ends, and to where the neck does; fractions of L.
const NECK: [f64; 2] = [0.12, 0.42];
/// The thickness of the slices whose middles are the neck's centre line, fraction of L.
const SLICE: f64 = 0.02;
/// As many slices at the neck's foot tell where a straight neck points, and at its head how the head sits.
const FOOT: usize = 6;
const NAPE: usize = 2;

/// The neck straightened by moving the head.
///
/// # Errors
/// Test data that is missing or damaged.
pub fn neck() -> Result<Exhibit> {
    let file = data::root()?.join("3d/diplodocus.off");
    let surface = surface(&io::read(&file)?.mesh)?;
    let way = distances(&surface, snout(&surface));
    let line = CenterLine::new(&way, NECK[0], NECK[1], SLICE);
    let role = |d: &f64| match *d {
        d if d < NECK[0] => Role::Moved,
        d if d < NECK[1] => Role::Free,
        _ => Role::Held,
    };
    Ok(Exhibit {
        name: "neck",
        title: "The neck of `diplodocus`, straightened",
        handles: "Distances are measured over the surface from the snout. Up to 0.12 L is the head, which is moved; \
                  from 0.42 L on all is held. The middles of slices between are the neck's centre line. The head is \
                  set to where it sits on a neck of the same length that goes on straight as it starts at its foot, \
                  and turned as the nape turns.",
        roles: way.iter().map(role).collect(),
        motion: straightening(&line.points(&surface, &surface.positions)),
        view: View::new(Vector::new(0.35, -0.15, -1.0), Vector::y()),
        close: View::new(Vector::new(0.15, -0.1, -1.0), Vector::y()),
        look: "The nape, where nearly all of the bend was.",
        line: Some(line),
        surface,
    })
}

fn snout(surface: &Surface) -> u32 {
    let heights = surface.positions.iter().map(|p| p.y);
    let low = heights.clone().fold(f64::INFINITY, f64::min);
    let high = heights.fold(f64::NEG_INFINITY, f64::max);
    let up = low + HIGH * (high - low);
    let all = (0..).zip(&surface.positions);
    let high = all.filter(|(_, p)| p.y > up);
    high.max_by(|a, b| a.1.x.total_cmp(&b.1.x))
        .map_or(0, |(v, _)| v)
}

/// The head's motion that makes the centre line, from head to foot, a straight one of the same length.
fn straightening(line: &[Point]) -> Motion {
    let (head, foot) = (line[0], line[line.len() - 1]);
    let length: f64 = line.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let up = (line[line.len() - 1 - FOOT] - foot).normalize();
    let nape = (head - line[NAPE]).normalize();
    let turn = nalgebra::Rotation3::rotation_between(&nape, &up);
    Motion {
        pivot: head,
        turn: turn.map_or_else(Vector::zeros, |r| r.scaled_axis()),
        shift: foot + up * length - head,
    }
}
