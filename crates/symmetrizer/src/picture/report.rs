//! The before/after picture of a run: the same views of both states on a common colour scale.

use crate::error::Result;
use crate::geom::Point;
use crate::picture::camera::{Camera, View};
use crate::picture::canvas::{Anchor, Canvas, GREY, Text};
use crate::picture::color::ColorScale;
use crate::picture::density::DensityPlot;
use crate::picture::render::{Background, Scene, render};
use crate::picture::sheet::{LEGEND, MARGIN, caption, heat_scale, matching_cameras, shown};
use crate::picture::stance::{Angle, Stance};
use crate::transform::isometry::Plane;

/// Width of the page, pixels.
const WIDTH: u32 = 1800;
/// Space left of the rows for their names, pixels.
const ROW_NAME: u32 = 30;
/// Space between columns, pixels.
const GAP: u32 = 14;
/// The coloured views, from left to right, before one in plain clay.
const ANGLES: [Angle; 3] = [Angle::Front, Angle::ThreeQuarter, Angle::Side];

/// One state of the shape.
#[derive(Debug, Clone, Copy, Default)]
pub struct Panel<'a> {
    /// Vertex positions, model units.
    pub positions: &'a [Point],
    /// A number for each vertex, say its asymmetry in % of D; clay where it is missing.
    pub scalar: &'a [f64],
    /// Mirror planes with their colours.
    pub planes: &'a [(Plane, [u8; 3])],
    /// The density plot of this state.
    pub density: Option<DensityPlot<'a>>,
}

/// Everything in the before/after picture; the caller supplies all words and figures.
#[derive(Debug, Clone, Copy, Default)]
pub struct ReportPicture<'a> {
    /// The first line, in bold.
    pub title: &'a str,
    /// The second line: figures.
    pub subtitle: &'a str,
    /// The input.
    pub before: Panel<'a>,
    /// The result.
    pub after: Panel<'a>,
    /// Vertex indices of each triangle, in both states.
    pub triangles: &'a [[u32; 3]],
    /// The number that gets the strongest colour; the 98th percentile of both states if absent.
    pub scale_max: Option<f64>,
    /// What the numbers are, with their unit: "asymmetry, % of D".
    pub scale_label: &'a str,
}

impl ReportPicture<'_> {
    /// The page.
    pub fn canvas(&self) -> Canvas {
        let layout = Layout::new(self);
        let mut canvas = Canvas::new(WIDTH, layout.height);
        self.head(&mut canvas, &layout);
        let scale = heat_scale(self.scale_max, [self.before.scalar, self.after.scalar]);
        let rows = [("before", &self.before), ("after", &self.after)];
        for (row, (name, panel)) in rows.into_iter().enumerate() {
            let y = layout.top + row as u32 * (layout.size[1] + GAP);
            let middle = f64::from(y) + f64::from(layout.size[1]) / 2.0;
            let text = Text::new(name, f64::from(MARGIN) + 12.0, middle, 17.0);
            canvas.text(text.anchored(Anchor::Middle).bold().upwards());
            self.views(&mut canvas, &layout, panel, &scale, y);
            self.plot(&mut canvas, &layout, panel, y);
        }
        let [x, y] = layout.legend();
        canvas.legend([x - 210.0, y, 420.0, 14.0], scale, self.scale_label);
        canvas
    }

    /// The page as the bytes of a PNG file.
    ///
    /// # Errors
    /// As [`Canvas::to_png`].
    pub fn to_png(&self) -> Result<Vec<u8>> {
        self.canvas().to_png()
    }

    /// The page as an SVG document.
    ///
    /// # Errors
    /// As [`Canvas::to_svg`].
    pub fn to_svg(&self) -> Result<String> {
        self.canvas().to_svg()
    }

    fn has_density(&self) -> bool {
        self.before.density.is_some() || self.after.density.is_some()
    }

    /// How both states stand: as the result's first mirror plane says, else the input's.
    fn stance(&self) -> Stance {
        let planes = self.after.planes.iter().chain(self.before.planes);
        Stance::about(planes.map(|p| &p.0).next(), self.after.positions)
    }

    fn head(&self, canvas: &mut Canvas, layout: &Layout) {
        let (x, width) = (f64::from(MARGIN), f64::from(WIDTH - 2 * MARGIN));
        let title = Text::new(self.title, x, f64::from(MARGIN) + 20.0, 26.0);
        canvas.text(title.bold().within(width));
        let subtitle = Text::new(self.subtitle, x, f64::from(MARGIN) + 48.0, 17.0);
        canvas.text(subtitle.colored(GREY).within(width));
        let names = ANGLES.iter().map(|a| a.name()).chain(["front, plain"]);
        for (i, name) in names.enumerate() {
            let at = [layout.column(i), layout.top - 28];
            caption(canvas, name, at, layout.size[0]);
        }
        if let Some(side) = layout.plot {
            let at = [layout.column(ANGLES.len() + 1), layout.top - 28];
            caption(canvas, "votes in transformation space", at, side);
        }
    }

    fn views(
        &self,
        canvas: &mut Canvas,
        layout: &Layout,
        panel: &Panel<'_>,
        scale: &ColorScale,
        y: u32,
    ) {
        let colors = scale.colors(panel.scalar);
        let clay = Scene {
            positions: panel.positions,
            triangles: self.triangles,
            ..Scene::default()
        };
        let colored = Scene {
            colors: Some(&colors),
            ..clay
        };
        let with_planes = Scene {
            planes: panel.planes,
            ..colored
        };
        let scenes = [&with_planes, &with_planes, &colored, &clay];
        for (i, (scene, camera)) in scenes.into_iter().zip(&layout.cameras).enumerate() {
            canvas.image(
                layout.column(i),
                y,
                render(scene, camera, Background::White),
            );
        }
    }

    fn plot(&self, canvas: &mut Canvas, layout: &Layout, panel: &Panel<'_>, y: u32) {
        let (Some(side), Some(density)) = (layout.plot, panel.density) else {
            return;
        };
        let y = y + layout.size[1].saturating_sub(side) / 2;
        density.draw(canvas, layout.column(ANGLES.len() + 1), y, side);
    }
}

/// Where everything is on the page, pixels.
struct Layout {
    /// Of one view.
    size: [u32; 2],
    /// Of the first row.
    top: u32,
    /// Side of the density plots, if there are any.
    plot: Option<u32>,
    height: u32,
    /// The same for both rows, so that the states can be compared.
    cameras: Vec<Camera>,
}

impl Layout {
    fn new(report: &ReportPicture<'_>) -> Self {
        let stance = report.stance();
        let angles = ANGLES.iter().copied().chain([Angle::Front]);
        let views: Vec<View> = angles.map(|a| stance.view(a)).collect();
        let states = [&report.before, &report.after];
        let points: Vec<Point> = states
            .iter()
            .flat_map(|p| shown(p.positions, report.triangles, p.planes))
            .collect();
        let columns = views.len() as u32 + u32::from(report.has_density());
        let width = (WIDTH - 2 * MARGIN - ROW_NAME - (columns - 1) * GAP) / columns;
        let size = [width, (f64::from(width) * tallness(&views, &points)) as u32];
        let top = MARGIN + 108;
        Self {
            size,
            top,
            // No higher than its row, or the names of its axes run into the next.
            plot: report.has_density().then_some(width.min(size[1])),
            height: top + 2 * size[1] + GAP + LEGEND + MARGIN,
            cameras: matching_cameras(&views, &points, size),
        }
    }

    /// Left side of a column.
    fn column(&self, index: usize) -> u32 {
        MARGIN + ROW_NAME + index as u32 * (self.size[0] + GAP)
    }

    /// The middle of the top side of the legend's bar, below the coloured views.
    fn legend(&self) -> [f64; 2] {
        let right = self.column(ANGLES.len()).saturating_sub(GAP);
        [
            f64::from(self.column(0) + right) / 2.0,
            f64::from(self.top + 2 * self.size[1] + GAP) + 42.0,
        ]
    }
}

/// Height over width of the views that suits the shape.
fn tallness(views: &[View], points: &[Point]) -> f64 {
    let origin = points.first().copied().unwrap_or_else(Point::origin);
    let mut half = [0.0_f64; 2];
    for view in views {
        if let Some((_, h)) = view.bounds(points.iter(), &origin) {
            half = [half[0].max(h.x), half[1].max(h.y)];
        }
    }
    let ratio = half[1] / half[0];
    if ratio.is_nan() {
        1.0
    } else {
        ratio.clamp(0.8, 1.3)
    }
}
