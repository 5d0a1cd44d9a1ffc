//! A page of panels of one shape, in each of which some parts of it are coloured.

use crate::geom::Point;
use crate::picture::camera::{Camera, View};
use crate::picture::canvas::{Canvas, GREY, Text};
use crate::picture::render::{Background, Scene, render};
use crate::picture::rods::Rod;
use crate::picture::sheet::{MARGIN, matching_cameras, shown};
use crate::picture::stance::{Angle, Stance};
use crate::picture::visible::Sights;
use crate::transform::isometry::Plane;

/// Panels side by side at the most.
const COLUMNS: usize = 3;
/// Space for the two lines above a panel, pixels.
const CAPTION: u32 = 48;
/// Side of the small picture in which the visible parts are counted, pixels.
const GLANCE: u32 = 120;
/// Width of the lines that shine through the shape, and length of an arrow's barbs, pixels.
const THIN: f64 = 1.8;
const BARB: f64 = 11.0;
/// The colour of what is not in a part, sRGB.
const REST: [u8; 3] = [205, 202, 198];

/// One panel.
#[derive(Debug, Clone)]
pub struct Exhibit {
    /// What is shown, in bold above it.
    pub caption: String,
    /// A smaller line below that.
    pub note: String,
    /// Triangles with their sRGB colour; later parts cover earlier ones.
    pub parts: Vec<(Vec<u32>, [u8; 3])>,
    /// Mirror planes with their colours.
    pub planes: Vec<(Plane, [u8; 3])>,
    /// Axes and arrows; where the shape hides them they shine through as thin lines.
    pub rods: Vec<Rod>,
}

impl Exhibit {
    /// A panel of the plain shape.
    pub fn empty() -> Self {
        Self {
            caption: String::new(),
            note: String::new(),
            parts: Vec::new(),
            planes: Vec::new(),
            rods: Vec::new(),
        }
    }
}

/// The page.
#[derive(Debug, Clone, Copy)]
pub struct Gallery<'a> {
    /// A line above the panels; none if empty.
    pub title: &'a str,
    /// Vertex positions, model units.
    pub positions: &'a [Point],
    /// Vertex indices of each triangle.
    pub triangles: &'a [[u32; 3]],
    /// The plane that tells how the shape stands.
    pub upright: Option<Plane>,
    /// The panels.
    pub exhibits: &'a [Exhibit],
    /// Width and height of the view in a panel, pixels.
    pub size: [u32; 2],
}

impl Gallery<'_> {
    /// The page, panels in rows.
    pub fn canvas(&self) -> Canvas {
        let [width, height] = self.size;
        let columns = self.exhibits.len().clamp(1, COLUMNS) as u32;
        let rows = self.exhibits.len().div_ceil(COLUMNS) as u32;
        let top = MARGIN + if self.title.is_empty() { 0 } else { 36 };
        let page_width = 2 * MARGIN + columns * width;
        let mut canvas = Canvas::new(page_width, top + rows * (height + CAPTION) + MARGIN);
        let title = Text::new(
            self.title,
            f64::from(MARGIN),
            f64::from(MARGIN) + 16.0,
            20.0,
        );
        canvas.text(title.bold().within(f64::from(page_width - 2 * MARGIN)));
        let stance = Stance::about(self.upright.as_ref(), self.positions);
        let views = views(&stance);
        for (k, exhibit) in self.exhibits.iter().enumerate() {
            let [column, row] = [k % COLUMNS, k / COLUMNS].map(|c| c as u32);
            let at = [MARGIN + column * width, top + row * (height + CAPTION)];
            self.draw(exhibit, &views, &mut canvas, at);
        }
        canvas
    }

    fn draw(
        &self,
        exhibit: &Exhibit,
        views: &[(View, f64)],
        canvas: &mut Canvas,
        [x, y]: [u32; 2],
    ) {
        let part = self.part_of_faces(exhibit);
        let mut seen = shown(self.positions, self.triangles, &exhibit.planes);
        seen.extend(exhibit.rods.iter().flat_map(|r| [r.from, r.to]));
        let view = self.best(views, &part, exhibit.parts.len());
        let camera = matching_cameras(&[view], &seen, self.size)[0];
        canvas.image(x, y + CAPTION, self.picture(exhibit, &part, &camera));
        let [left, top] = [x, y].map(f64::from);
        let corner = [left, top + f64::from(CAPTION)];
        for rod in &exhibit.rods {
            shine(rod, &camera, corner, canvas);
        }
        let width = f64::from(self.size[0]) - 12.0;
        let caption = Text::new(exhibit.caption.clone(), left, top + 18.0, 16.0);
        canvas.text(caption.bold().within(width));
        let note = Text::new(exhibit.note.clone(), left, top + 37.0, 13.0);
        canvas.text(note.colored(GREY).within(width));
    }

    /// The shape with its parts in their colours, and the rods.
    fn picture(
        &self,
        exhibit: &Exhibit,
        part: &[Option<usize>],
        camera: &Camera,
    ) -> image::RgbaImage {
        let unit = |c: [u8; 3]| c.map(|c| f32::from(c) / 255.0);
        let mut corners = Vec::new();
        let mut colors = Vec::new();
        // Corners of their own, so that a part ends with its triangles; normals are by place.
        for (t, part) in self.triangles.iter().zip(part) {
            let color = part.map_or(REST, |p| exhibit.parts[p].1);
            let points = t.map(|v| self.positions.get(v as usize).copied());
            if let [Some(a), Some(b), Some(c)] = points {
                corners.extend([a, b, c]);
                colors.extend([unit(color); 3]);
            }
        }
        for rod in &exhibit.rods {
            corners.extend(rod.corners());
            colors.resize(corners.len(), unit(rod.color));
        }
        let count = corners.len() as u32 / 3;
        let triangles: Vec<[u32; 3]> = (0..count).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
        let scene = Scene {
            positions: &corners,
            triangles: &triangles,
            colors: Some(&colors),
            planes: &exhibit.planes,
            ..Scene::default()
        };
        render(&scene, camera, Background::White)
    }

    /// The part that each triangle is in, the last of several.
    fn part_of_faces(&self, exhibit: &Exhibit) -> Vec<Option<usize>> {
        let mut part = vec![None; self.triangles.len()];
        for (p, (faces, _)) in exhibit.parts.iter().enumerate() {
            for &f in faces {
                if let Some(slot) = part.get_mut(f as usize) {
                    *slot = Some(p);
                }
            }
        }
        part
    }

    /// The view in which most of all parts is seen: the sum of the square roots of what is seen of
    /// each, times the view's own worth, is largest, so that no part is hidden for the sake of
    /// another. Of equals the first.
    fn best(&self, views: &[(View, f64)], part: &[Option<usize>], parts: usize) -> View {
        let directions: Vec<View> = views.iter().map(|v| v.0).collect();
        let cameras = matching_cameras(&directions, self.positions, [GLANCE; 2]);
        let score = |camera: &Camera| -> f64 {
            let projected: Vec<_> = self.positions.iter().map(|p| camera.project(p)).collect();
            let sights = Sights::new(GLANCE as usize, GLANCE as usize, &projected, self.triangles);
            let mut seen = vec![0.0_f64; parts];
            for sight in sights.samples.iter().filter(|s| s.hits()) {
                if let Some(p) = part[sight.face as usize] {
                    seen[p] += 1.0;
                }
            }
            seen.into_iter().map(f64::sqrt).sum()
        };
        let mut best = (directions[0], f64::NEG_INFINITY);
        for ((view, worth), camera) in views.iter().zip(&cameras) {
            let score = worth * score(camera);
            if score > best.1 * (1.0 + 1e-9) {
                best = (*view, score);
            }
        }
        best.0
    }
}

/// A rod as a thin line, where the shape hides it too.
fn shine(rod: &Rod, camera: &Camera, [left, top]: [f64; 2], canvas: &mut Canvas) {
    let place = |p: &Point| {
        let at = camera.project(p);
        [left + at.x, top + at.y]
    };
    let (from, to) = (place(&rod.from), place(&rod.to));
    canvas.line(from, to, THIN, rod.color);
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    if rod.arrow && length > 1.0 {
        let [dx, dy] = along.map(|c| BARB * c / length);
        for [x, y] in [
            [-dx - 0.5 * dy, -dy + 0.5 * dx],
            [-dx + 0.5 * dy, -dy - 0.5 * dx],
        ] {
            canvas.line([to[0] + x, to[1] + y], to, THIN, rod.color);
        }
    }
}

/// The views to choose from, each with what it is worth: between the sides and above first, because
/// they look natural and show most of a shape; those straight along an axis show no depth, those from
/// below what nobody sees.
fn views(stance: &Stance) -> Vec<(View, f64)> {
    let right = stance.up.cross(&stance.front);
    let from = |x: f64, y: f64, z: f64| {
        let eye = right * x + stance.up * y + stance.front * z;
        View::new(-eye, stance.up)
    };
    let mut views = vec![
        (stance.view(Angle::ThreeQuarter), 1.0),
        (from(-0.8, 0.42, 1.0), 1.0),
    ];
    views.extend([
        (from(0.8, 0.42, -1.0), 0.97),
        (from(-0.8, 0.42, -1.0), 0.97),
    ]);
    views.extend([(from(0.6, 1.4, 0.8), 0.97), (from(0.6, -1.0, 0.8), 0.75)]);
    let straight = [Angle::Front, Angle::Side, Angle::Back, Angle::Top];
    views.extend(straight.map(|a| (stance.view(a), 0.8)));
    views
}
