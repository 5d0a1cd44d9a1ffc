//! The panels of an exhibit: at rest with its handles in colour, and what each method made of it.

use std::ops::RangeInclusive;

use symmetrizer::geom::Point;
use symmetrizer::picture::canvas::{Anchor, Text};
use symmetrizer::picture::{Background, Camera, Canvas, Scene, View, render};
use symmetrizer::shape::Surface;
use symmetrizer::shape::crossings::{crossing_faces, new_crossings};

use super::exhibit::{Exhibit, Role};

/// Width and height of a panel, and the space above a row for what the panels show, pixels.
const PANEL: [u32; 2] = [230, 220];
const CAPTION: u32 = 24;
/// White between panels, pixels.
const GAP: u32 = 4;
/// The size of a caption, pixels.
const FONT: f64 = 12.0;
/// Clay, and the colours of what is held, of what is moved and of faces that cross others.
const CLAY: [f32; 3] = [0.86, 0.82, 0.775];
const HELD: [f32; 3] = [0.55, 0.66, 0.80];
const MOVED: [f32; 3] = [0.93, 0.62, 0.32];
const CROSSING: [f32; 3] = [0.85, 0.10, 0.10];
/// How far a close-up reaches beyond the free vertices, as a share of their extent.
const AROUND: f64 = 1.05;

/// A state of the exhibit with its caption.
pub struct Panel<'a> {
    /// What is written above it.
    pub caption: &'a str,
    /// Vertex positions.
    pub positions: &'a [Point],
}

/// A row of panels that show the whole, and one close up.
pub fn picture(exhibit: &Exhibit, panels: &[Panel<'_>]) -> Canvas {
    let [width, height] = PANEL;
    let row = CAPTION + height + GAP;
    let mut canvas = Canvas::new((width + GAP) * panels.len() as u32, row + height);
    let free = |v: &usize| exhibit.roles[*v] == Role::Free;
    let all: Vec<usize> = (0..exhibit.roles.len()).collect();
    let near: Vec<usize> = all.iter().copied().filter(free).collect();
    let whole = camera(exhibit.view, panels, &all, 1.0);
    let close = camera(exhibit.close, panels, &near, AROUND);
    for (k, panel) in (0..).zip(panels) {
        let left = k * (width + GAP);
        let middle = f64::from(left) + 0.5 * f64::from(width);
        let caption = Text::new(panel.caption, middle, FONT + 4.0, FONT);
        canvas.text(caption.anchored(Anchor::Middle).within(f64::from(width)));
        let after = exhibit.surface.with_positions(panel.positions.to_vec());
        let painted = painted(exhibit, &after, k == 0);
        for (camera, y) in [(&whole, CAPTION), (&close, row)] {
            canvas.image(left, y, painted.seen(camera));
        }
    }
    canvas
}

/// A camera that sees these vertices in every panel at the same place and scale.
fn camera(view: View, panels: &[Panel<'_>], vertices: &[usize], around: f64) -> Camera {
    let seen = || {
        let of = |p: &Panel<'_>| vertices.iter().map(|&v| p.positions[v]).collect::<Vec<_>>();
        panels.iter().flat_map(of)
    };
    let across = extent(seen().map(|p| view.right().dot(&p.coords)));
    let upwards = extent(seen().map(|p| view.up.dot(&p.coords)));
    let middle = |r: &RangeInclusive<f64>| 0.5 * (r.start() + r.end());
    let half = |r: &RangeInclusive<f64>| 0.5 * around * (r.end() - r.start());
    let center = Point::from(view.right() * middle(&across) + view.up * middle(&upwards));
    Camera::showing(
        view,
        center,
        [half(&across), half(&upwards)],
        PANEL[0],
        PANEL[1],
    )
}

fn extent(values: impl Iterator<Item = f64>) -> RangeInclusive<f64> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(v), high.max(v))
    });
    low..=high
}

/// A surface whose triangles have corners of their own, so that a colour ends with its triangle.
struct Painted {
    corners: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    colors: Vec<[f32; 3]>,
}

impl Painted {
    fn seen(&self, camera: &Camera) -> image::RgbaImage {
        let scene = Scene {
            positions: &self.corners,
            triangles: &self.triangles,
            colors: Some(&self.colors),
            ..Scene::default()
        };
        render(&scene, camera, Background::White)
    }
}

/// `after` with faces in red that cross others newly; at rest with its handles in colour.
fn painted(exhibit: &Exhibit, after: &Surface, rest: bool) -> Painted {
    let crossing = new_crossings(&crossing_faces(&exhibit.surface), &crossing_faces(after));
    let role = |t: &[u32; 3]| match t.map(|v| exhibit.roles[v as usize]) {
        [Role::Held, Role::Held, Role::Held] => HELD,
        [Role::Moved, Role::Moved, Role::Moved] => MOVED,
        _ => CLAY,
    };
    let color = |(f, t): (u32, &[u32; 3])| match crossing.binary_search(&f) {
        Ok(_) => CROSSING,
        Err(_) if rest => role(t),
        Err(_) => CLAY,
    };
    let count = after.triangles.len() as u32;
    Painted {
        corners: (0..count).flat_map(|f| after.corners(f)).collect(),
        triangles: (0..count).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect(),
        colors: (0..)
            .zip(after.triangles.iter())
            .flat_map(|f| [color(f); 3])
            .collect(),
    }
}
