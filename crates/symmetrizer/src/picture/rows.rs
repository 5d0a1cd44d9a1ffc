//! A page of rows of pictures, each row under a name and a note.

use crate::geom::Point;
use crate::picture::camera::{Camera, View};
use crate::picture::canvas::{Canvas, GREY, INK, Text};
use crate::picture::render::{Background, Scene, render};
use crate::picture::sheet::{MARGIN, caption};

/// Width of the page, pixels: that of a report.
const WIDTH: u32 = 1800;
/// Pictures side by side.
const COLUMNS: u32 = 3;
/// Space between them, and below a row, pixels.
const GAP: u32 = 18;
const BELOW: u32 = 26;
/// Height of the page's title, of each of its lines, and of the lines above a row, pixels.
const TITLE: u32 = 46;
const LINE: u32 = 24;
const HEAD: u32 = 58;
/// Height of a picture, beside its width: no less and no more.
const TALL: [f64; 2] = [0.45, 0.8];
/// Width of a line through a shape, radius of its knots, pixels.
const STROKE: f64 = 1.5;
const KNOT: f64 = 2.6;

/// A page.
#[derive(Debug, Clone, Default)]
pub struct Rows<'a> {
    /// A line above all, in bold.
    pub title: String,
    /// Lines below it.
    pub lines: Vec<String>,
    /// The rows.
    pub rows: Vec<Row<'a>>,
}

/// Pictures side by side at the same scale.
#[derive(Debug, Clone, Default)]
pub struct Row<'a> {
    /// What they show, in bold.
    pub name: String,
    /// Words beside the name, each with its sRGB colour; none is grey.
    pub note: Vec<(String, Option<[u8; 3]>)>,
    /// The pictures, at most three.
    pub cells: Vec<Cell<'a>>,
}

/// One picture.
#[derive(Debug, Clone)]
pub struct Cell<'a> {
    /// A small line above it.
    pub caption: String,
    /// What is drawn.
    pub scene: Scene<'a>,
    /// From where it is seen.
    pub view: View,
    /// A line through the shape, model units, that shines through where the shape hides it.
    pub line: &'a [Point],
}

impl Rows<'_> {
    /// The page.
    pub fn canvas(&self) -> Canvas {
        let placed: Vec<Placed> = self.rows.iter().map(Placed::new).collect();
        let top = MARGIN + TITLE + LINE * self.lines.len() as u32;
        let heights = placed.iter().map(|p| HEAD + p.size[1] + BELOW);
        let mut canvas = Canvas::new(WIDTH, top + heights.sum::<u32>() + MARGIN);
        self.head(&mut canvas);
        let mut y = top;
        for (row, placed) in self.rows.iter().zip(&placed) {
            row.draw(&mut canvas, placed, y);
            y += HEAD + placed.size[1] + BELOW;
        }
        canvas
    }

    fn head(&self, canvas: &mut Canvas) {
        let [x, y] = [MARGIN, MARGIN].map(f64::from);
        let width = f64::from(WIDTH - 2 * MARGIN);
        canvas.text(
            Text::new(self.title.as_str(), x, y + 20.0, 24.0)
                .bold()
                .within(width),
        );
        for (k, line) in self.lines.iter().enumerate() {
            let y = y + f64::from(TITLE) + f64::from(LINE) * k as f64;
            canvas.text(
                Text::new(line.as_str(), x, y, 16.0)
                    .colored(GREY)
                    .within(width),
            );
        }
    }
}

impl Row<'_> {
    fn draw(&self, canvas: &mut Canvas, placed: &Placed, y: u32) {
        let mut x = f64::from(MARGIN);
        let base = f64::from(y) + 18.0;
        let name = Text::new(self.name.as_str(), x, base, 18.0).bold();
        x += name.width() + 16.0;
        canvas.text(name);
        for (words, color) in &self.note {
            let text = Text::new(words.as_str(), x, base, 15.0);
            let text = match color {
                Some(color) => text.colored(*color).bold(),
                None => text.colored(GREY),
            };
            let text = text.within(f64::from(WIDTH - MARGIN) - x);
            x += text.width() + 14.0;
            canvas.text(text);
        }
        for (k, (cell, camera)) in self.cells.iter().zip(&placed.cameras).enumerate() {
            let x = MARGIN + k as u32 * (placed.size[0] + GAP);
            caption(canvas, &cell.caption, [x, y + 34], placed.size[0]);
            let picture = render(&cell.scene, camera, Background::White);
            canvas.image(x, y + HEAD, picture);
            cell.draw_line(canvas, camera, [x, y + HEAD].map(f64::from));
        }
    }
}

impl Cell<'_> {
    fn draw_line(&self, canvas: &mut Canvas, camera: &Camera, [left, top]: [f64; 2]) {
        let place = |p: &Point| {
            let at = camera.project(p);
            [left + at.x, top + at.y]
        };
        for ends in self.line.windows(2) {
            canvas.line(place(&ends[0]), place(&ends[1]), STROKE, INK);
        }
        for p in self.line {
            canvas.circle(place(p), KNOT, STROKE, INK);
        }
    }

    /// What must be seen.
    fn points(&self) -> impl Iterator<Item = &Point> {
        let tiles = self.scene.tiles.iter().flat_map(|t| &t.corners);
        self.scene.positions.iter().chain(tiles)
    }
}

/// The pictures of a row on the page.
struct Placed {
    /// Width and height of each, pixels.
    size: [u32; 2],
    /// Of the same scale, each about the middle of its own shape.
    cameras: Vec<Camera>,
}

impl Placed {
    fn new(row: &Row<'_>) -> Self {
        let origin = Point::origin();
        let boxes: Vec<_> = row
            .cells
            .iter()
            .map(|c| c.view.bounds(c.points(), &origin).unwrap_or_default())
            .collect();
        let half = boxes
            .iter()
            .fold([0.0_f64; 2], |h, (_, b)| [h[0].max(b.x), h[1].max(b.y)]);
        let width = (WIDTH - 2 * MARGIN - (COLUMNS - 1) * GAP) / COLUMNS;
        let tall = half[1] / half[0];
        let tall = if tall.is_nan() {
            TALL[0]
        } else {
            tall.clamp(TALL[0], TALL[1])
        };
        let size = [width, (f64::from(width) * tall) as u32];
        let cameras = row.cells.iter().zip(&boxes).map(|(cell, (center, _))| {
            let view = cell.view;
            let center =
                origin + view.right() * center.x + view.up * center.y + view.direction * center.z;
            Camera::showing(view, center, half, size[0], size[1])
        });
        Self {
            size,
            cameras: cameras.collect(),
        }
    }
}
