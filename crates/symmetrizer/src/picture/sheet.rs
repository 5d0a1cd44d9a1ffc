//! A sheet of views of one shape, for the verb `render`.

use crate::geom::{Point, Vector};
use crate::picture::camera::{Camera, MAX_PIXELS, View};
use crate::picture::canvas::{Anchor, Canvas, GREY, Text};
use crate::picture::color::{ColorMap, ColorScale};
use crate::picture::planes::corners;
use crate::picture::render::{Background, Scene, render};
use crate::picture::stance::{Angle, Stance};
use crate::transform::isometry::Plane;

/// Space around the page's content, pixels.
pub(super) const MARGIN: u32 = 32;
/// Space for a legend below the pictures, pixels.
pub(super) const LEGEND: u32 = 74;

/// A number for each vertex, to be shown as a colour.
#[derive(Debug, Clone, Copy)]
pub struct ScalarField<'a> {
    /// The numbers; a missing one is drawn as clay.
    pub values: &'a [f64],
    /// The number that gets the strongest colour; the 98th percentile of the numbers if absent.
    pub max: Option<f64>,
    /// What the numbers are, with their unit: "asymmetry, % of D".
    pub label: &'a str,
}

impl ScalarField<'_> {
    /// The colour scale, from 0.
    pub fn scale(&self) -> ColorScale {
        heat_scale(self.max, [self.values])
    }
}

/// Several views of one shape.
#[derive(Debug, Clone, Copy)]
pub struct Sheet<'a> {
    /// A line above the views; none if empty.
    pub title: &'a str,
    /// Vertex positions, model units.
    pub positions: &'a [Point],
    /// Vertex indices of each triangle.
    pub triangles: &'a [[u32; 3]],
    /// Colours; clay if absent.
    pub scalar: Option<ScalarField<'a>>,
    /// Mirror planes with their colours.
    pub planes: &'a [(Plane, [u8; 3])],
    /// The plane that tells how the shape stands; the first of `planes` if absent.
    pub upright: Option<Plane>,
    /// Which views, from left to right.
    pub angles: &'a [Angle],
    /// Width and height of one view, pixels.
    pub size: [u32; 2],
}

/// The page with the views of a shape side by side.
pub fn render_sheet(sheet: &Sheet<'_>) -> Canvas {
    let [width, height] = sheet.size.map(|s| s.clamp(16, MAX_PIXELS));
    let title = if sheet.title.is_empty() { 0 } else { 40 };
    let legend = sheet.scalar.map_or(0, |_| LEGEND);
    // Beyond this many views the page would be too wide to draw.
    let angles = &sheet.angles[..sheet.angles.len().min(12)];
    let page_width = 2 * MARGIN + width * angles.len().max(1) as u32;
    let mut canvas = Canvas::new(page_width, 2 * MARGIN + title + 24 + height + legend);
    let text = Text::new(
        sheet.title,
        f64::from(MARGIN),
        f64::from(MARGIN) + 16.0,
        20.0,
    );
    canvas.text(text.bold().within(f64::from(page_width - 2 * MARGIN)));
    draw_views(&mut canvas, sheet, angles, [width, height], MARGIN + title);
    if let Some(field) = sheet.scalar {
        let bar = f64::from(page_width - 2 * MARGIN).min(360.0);
        let y = f64::from(MARGIN + title + 24 + height) + 34.0;
        let rect = [(f64::from(page_width) - bar) / 2.0, y, bar, 14.0];
        canvas.legend(rect, field.scale(), field.label);
    }
    canvas
}

fn draw_views(canvas: &mut Canvas, sheet: &Sheet<'_>, angles: &[Angle], size: [u32; 2], y: u32) {
    let plane = sheet.upright.or(sheet.planes.first().map(|p| p.0));
    let stance = Stance::about(plane.as_ref(), sheet.positions);
    let views: Vec<View> = angles.iter().map(|&a| stance.view(a)).collect();
    let shown = shown(sheet.positions, sheet.triangles, sheet.planes);
    let cameras = matching_cameras(&views, &shown, size);
    let colors = sheet.scalar.map(|f| f.scale().colors(f.values));
    let scene = Scene {
        positions: sheet.positions,
        triangles: sheet.triangles,
        colors: colors.as_deref(),
        planes: sheet.planes,
        ..Scene::default()
    };
    for (i, (camera, angle)) in cameras.iter().zip(angles).enumerate() {
        let x = MARGIN + i as u32 * size[0];
        canvas.image(x, y + 24, render(&scene, camera, Background::White));
        caption(canvas, angle.name(), [x, y], size[0]);
    }
}

/// A small line centred above a picture of `width` pixels.
pub(super) fn caption(canvas: &mut Canvas, text: &str, [x, y]: [u32; 2], width: u32) {
    let middle = f64::from(x) + f64::from(width) / 2.0;
    let text = Text::new(text, middle, f64::from(y) + 14.0, 14.0);
    let text = text.anchored(Anchor::Middle).colored(GREY);
    canvas.text(text.within(f64::from(width)));
}

/// Heat from 0 to `max`, or to the 98th percentile of the finite values.
pub(super) fn heat_scale<'a>(
    max: Option<f64>,
    values: impl IntoIterator<Item = &'a [f64]>,
) -> ColorScale {
    let given = max.filter(|m| m.is_finite() && *m > 0.0);
    ColorScale {
        map: ColorMap::Heat,
        low: 0.0,
        high: given.unwrap_or_else(|| strongest(values)),
    }
}

/// The 98th percentile of the finite values, or 1 where that is not positive: outliers must not pale
/// the rest.
pub fn strongest<'a>(values: impl IntoIterator<Item = &'a [f64]>) -> f64 {
    let mut all: Vec<f64> = values.into_iter().flatten().copied().collect();
    all.retain(|v| v.is_finite());
    all.sort_by(f64::total_cmp);
    let high = all.get((all.len() * 98 / 100).min(all.len().saturating_sub(1)));
    high.copied().filter(|h| *h > 0.0).unwrap_or(1.0)
}

/// What the camera must see: the vertices that triangles use, and the corners of the planes.
pub(super) fn shown(
    positions: &[Point],
    triangles: &[[u32; 3]],
    planes: &[(Plane, [u8; 3])],
) -> Vec<Point> {
    let mut shown = used(positions, triangles);
    let sheets: Vec<Point> = planes
        .iter()
        .filter_map(|(plane, _)| corners(plane, &shown))
        .flatten()
        .collect();
    shown.extend(sheets);
    shown
}

/// The positions that triangles use; loose vertices shall not move the camera.
fn used(positions: &[Point], triangles: &[[u32; 3]]) -> Vec<Point> {
    let mut is_used = vec![false; positions.len()];
    for &v in triangles.iter().flatten() {
        if let Some(u) = is_used.get_mut(v as usize) {
            *u = true;
        }
    }
    let used = positions.iter().zip(is_used).filter(|(_, u)| *u);
    used.map(|(p, _)| *p).collect()
}

/// Cameras that show the points in every view at the same scale, each centred.
pub(super) fn matching_cameras(views: &[View], points: &[Point], size: [u32; 2]) -> Vec<Camera> {
    let origin = points.first().copied().unwrap_or_else(Point::origin);
    let boxes: Vec<(Vector, Vector)> = views
        .iter()
        .map(|v| v.bounds(points.iter(), &origin).unwrap_or_default())
        .collect();
    let half = boxes
        .iter()
        .fold([0.0_f64; 2], |h, (_, b)| [h[0].max(b.x), h[1].max(b.y)]);
    let camera = |(view, (center, _)): (&View, &(Vector, Vector))| {
        let center = origin + view.right() * center.x + view.up * center.y;
        Camera::showing(*view, center, half, size[0], size[1])
    };
    views.iter().zip(&boxes).map(camera).collect()
}
