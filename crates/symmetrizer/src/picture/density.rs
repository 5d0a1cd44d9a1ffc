//! The density plot of transformation space (section 5): votes as a heat map, clusters as rings.

use image::{Rgba, RgbaImage};

use crate::error::Result;
use crate::picture::canvas::{Anchor, Canvas, GREY, PALE, Text};
use crate::picture::color::{ColorMap, categorical};
use crate::picture::ticks::labelled_ticks;

/// Cells of the density grid each way; the picture is interpolated from it.
const GRID: usize = 320;
/// The share of the highest density that gets half the colour range is about 1 / sqrt of this: weak
/// clusters stay visible beside strong ones.
const CONTRAST: f64 = 150.0;

/// A range of the plot's coordinates: `[low, high]` of the first and second axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// First axis, fractions of L.
    pub x: [f64; 2],
    /// Second axis, fractions of L.
    pub y: [f64; 2],
}

impl Extent {
    /// A square around all finite points with `margin` on each side; a unit square without points.
    pub fn around<'a>(points: impl IntoIterator<Item = &'a [f64; 2]>, margin: f64) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for p in points
            .into_iter()
            .filter(|p| p.iter().all(|c| c.is_finite()))
        {
            for i in 0..2 {
                low[i] = low[i].min(p[i]);
                high[i] = high[i].max(p[i]);
            }
        }
        if low[0] > high[0] {
            (low, high) = ([-0.5; 2], [0.5; 2]);
        }
        let half = (high[0] - low[0]).max(high[1] - low[1]) / 2.0 + margin.max(0.0);
        let half = if half.is_normal() { half } else { 0.5 };
        let side = |i: usize| {
            let middle = low[i] / 2.0 + high[i] / 2.0;
            [middle - half, middle + half]
        };
        Self {
            x: side(0),
            y: side(1),
        }
    }

    /// Position in the plot, 0..=1 from the left and from the top.
    fn place(&self, p: &[f64; 2]) -> [f64; 2] {
        [
            (p[0] - self.x[0]) / (self.x[1] - self.x[0]),
            1.0 - (p[1] - self.y[0]) / (self.y[1] - self.y[0]),
        ]
    }
}

/// What an axis shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis<'a> {
    /// What its numbers are.
    pub caption: &'a str,
    /// How many of their units one unit of the plot's coordinates is.
    pub unit: f64,
}

impl Default for Axis<'_> {
    fn default() -> Self {
        Self {
            caption: "displacement, fraction of L",
            unit: 1.0,
        }
    }
}

/// A cluster in the plot.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotMode {
    /// Where it is, fractions of L.
    pub position: [f64; 2],
    /// What it is called.
    pub label: String,
    /// Its height; larger ones get larger rings and labels.
    pub height: f64,
    /// Which colour of [`categorical`] it has.
    pub color: usize,
}

/// Votes and clusters in the two main axes of transformation space.
#[derive(Debug, Clone, Copy, Default)]
pub struct DensityPlot<'a> {
    /// Coordinates of the votes, fractions of L; what is not finite is left out.
    pub points: &'a [[f64; 2]],
    /// Weight of each vote; a missing one is 1.
    pub weights: &'a [f64],
    /// The clusters.
    pub modes: &'a [PlotMode],
    /// The clusters' bandwidth, fraction of L; votes are spread with half of it as sigma.
    pub bandwidth: f64,
    /// Fixed axes, to compare plots; around the votes and clusters if absent.
    pub axes: Option<Extent>,
    /// What the axes show.
    pub shown: [Axis<'a>; 2],
    /// A line above the plot; none if empty.
    pub title: &'a str,
}

impl DensityPlot<'_> {
    /// The axes: those given, or a square around the votes and clusters.
    pub fn extent(&self) -> Extent {
        let modes = self.modes.iter().map(|m| &m.position);
        let usable = |e: &Extent| [e.x, e.y].iter().all(|[l, h]| (h - l).is_normal() && h > l);
        self.axes.filter(usable).unwrap_or_else(|| {
            Extent::around(self.points.iter().chain(modes), 1.5 * self.sigma() + 1e-3)
        })
    }

    fn sigma(&self) -> f64 {
        let sigma = self.bandwidth / 2.0;
        if sigma.is_finite() {
            sigma.max(0.0)
        } else {
            0.0
        }
    }

    /// Draws the plot into the square of `side` pixels with its top left corner at (x, y), axes
    /// and title included.
    pub fn draw(&self, canvas: &mut Canvas, x: u32, y: u32, side: u32) {
        let extent = self.extent();
        let [left, below] = [54, 46];
        let above = if self.title.is_empty() { 4 } else { 28 };
        let size = side.saturating_sub(left.max(above + below) + 4).max(16);
        let (x, y) = (x + left, y + above);
        canvas.image(x, y, self.heat(&extent, size));
        let frame = [x, y, size].map(f64::from);
        axes(canvas, &extent, &self.shown, frame);
        self.draw_modes(canvas, &extent, frame);
        let title = Text::new(self.title, frame[0], frame[1] - 10.0, 15.0);
        canvas.text(title.within(frame[2]));
    }

    /// The plot alone on a page of `side` pixels each way.
    pub fn canvas(&self, side: u32) -> Canvas {
        let mut canvas = Canvas::new(side, side);
        self.draw(&mut canvas, 0, 0, side);
        canvas
    }

    /// The plot alone as an SVG document.
    ///
    /// # Errors
    /// As [`Canvas::to_svg`].
    pub fn to_svg(&self, side: u32) -> Result<String> {
        self.canvas(side).to_svg()
    }

    /// The plot alone as a PNG file.
    ///
    /// # Errors
    /// As [`Canvas::to_png`].
    pub fn to_png(&self, side: u32) -> Result<Vec<u8>> {
        self.canvas(side).to_png()
    }

    /// The heat map, `size` pixels each way.
    fn heat(&self, extent: &Extent, size: u32) -> RgbaImage {
        let grid = self.density(extent);
        let peak = grid.iter().copied().fold(0.0, f64::max);
        let scale = GRID as f64 / f64::from(size);
        RgbaImage::from_fn(size, size, |x, y| {
            let [gx, gy] = [x, y].map(|p| (f64::from(p) + 0.5) * scale - 0.5);
            let share = interpolate(&grid, gx, gy) / peak;
            let share = if share.is_finite() { share } else { 0.0 };
            let t = (1.0 + CONTRAST * share).ln() / (1.0 + CONTRAST).ln();
            let [r, g, b] = ColorMap::Magma.at(t);
            Rgba([r, g, b, 255])
        })
    }

    /// The density on the grid, row by row from the top left: votes dropped into cells, then
    /// blurred along both axes, which is a Gaussian splat of each at a cost without their number.
    fn density(&self, extent: &Extent) -> Vec<f64> {
        let mut grid = vec![0.0; GRID * GRID];
        for (i, p) in self.points.iter().enumerate() {
            let weight = self.weights.get(i).copied().unwrap_or(1.0);
            let [x, y] = extent.place(p).map(|c| c * GRID as f64 - 0.5);
            if weight.is_finite() && weight > 0.0 {
                drop_into(&mut grid, x, y, weight);
            }
        }
        let cell = (extent.x[1] - extent.x[0]) / GRID as f64;
        // A vote is never smaller than a cell, or it would vanish from the picture.
        let kernel = gaussian((self.sigma() / cell).clamp(0.8, GRID as f64 / 4.0));
        transposed(&blurred(&transposed(&blurred(&grid, &kernel)), &kernel))
    }

    fn draw_modes(&self, canvas: &mut Canvas, extent: &Extent, [x, y, size]: [f64; 3]) {
        let highest = self.modes.iter().map(|m| m.height).fold(0.0, f64::max);
        let mut order: Vec<&PlotMode> = self.modes.iter().collect();
        order.sort_by(|a, b| b.height.total_cmp(&a.height));
        let rings: Vec<Ring<'_>> = order
            .into_iter()
            .filter_map(|m| Ring::new(m, highest, extent.place(&m.position), [x, y, size]))
            .collect();
        for ring in &rings {
            canvas.circle(ring.center, ring.radius, 3.5, [255; 3]);
            canvas.circle(ring.center, ring.radius, 2.0, categorical(ring.mode.color));
        }
        let mut taken: Vec<[f64; 4]> = rings.iter().map(Ring::around).collect();
        for ring in &rings {
            canvas.text(beside(ring, [x, y, size], &mut taken));
        }
    }
}

/// A cluster's mark in the plot, pixels.
struct Ring<'a> {
    mode: &'a PlotMode,
    center: [f64; 2],
    radius: f64,
    text_size: f64,
}

impl<'a> Ring<'a> {
    /// The mark of `mode` at `place` in a plot; `None` outside of it.
    fn new(
        mode: &'a PlotMode,
        highest: f64,
        place: [f64; 2],
        [x, y, size]: [f64; 3],
    ) -> Option<Self> {
        let share = (mode.height / highest).clamp(0.0, 1.0);
        let share = if share.is_finite() { share.sqrt() } else { 0.0 };
        let inside = place.iter().all(|c| (0.0..=1.0).contains(c));
        inside.then_some(Self {
            mode,
            center: [x + size * place[0], y + size * place[1]],
            radius: 5.0 + 7.0 * share,
            text_size: 10.5 + 5.0 * share,
        })
    }

    /// Left, top, right, bottom.
    fn around(&self) -> [f64; 4] {
        let ([x, y], r) = (self.center, self.radius);
        [x - r, y - r, x + r, y + r]
    }
}

/// A ring's label, on the first side that is inside the plot and free of others.
fn beside(ring: &Ring<'_>, [x, y, size]: [f64; 3], taken: &mut Vec<[f64; 4]>) -> Text {
    let text = Text {
        color: [255; 3],
        halo: Some([30, 20, 50]),
        ..Text::new(ring.mode.label.clone(), 0.0, 0.0, ring.text_size).bold()
    };
    let [cx, cy] = ring.center;
    let (width, gap) = (text.width(), ring.radius + 5.0);
    let places = [
        [cx + gap, cy + 0.35 * text.size],
        [cx - gap - width, cy + 0.35 * text.size],
        [cx - width / 2.0, cy - gap],
        [cx - width / 2.0, cy + gap + 0.75 * text.size],
    ];
    let rect = |p: [f64; 2]| [p[0], p[1] - text.size, p[0] + width, p[1] + 0.3 * text.size];
    let inside = |r: [f64; 4]| r[0] >= x && r[1] >= y && r[2] <= x + size && r[3] <= y + size;
    let clear = |r: [f64; 4]| {
        let apart = |t: &[f64; 4]| r[0] > t[2] || r[2] < t[0] || r[1] > t[3] || r[3] < t[1];
        taken.iter().all(apart)
    };
    let free = places
        .into_iter()
        .find(|p| inside(rect(*p)) && clear(rect(*p)));
    let fallback = places.into_iter().find(|p| inside(rect(*p)));
    let at = free.or(fallback).unwrap_or(places[0]);
    taken.push(rect(at));
    Text {
        x: at[0],
        y: at[1],
        ..text
    }
}

fn axes(canvas: &mut Canvas, extent: &Extent, shown: &[Axis<'_>; 2], [x, y, size]: [f64; 3]) {
    let ticks = |range: [f64; 2], axis: &Axis<'_>| {
        let unit = axis.unit;
        let all = labelled_ticks(unit * range[0], unit * range[1], 4).into_iter();
        all.map(move |(value, label)| (value / unit, label))
    };
    canvas.frame([x, y, size, size], PALE);
    let small = |label: String, x: f64, y: f64| Text::new(label, x, y, 12.0).colored(GREY);
    for (value, label) in ticks(extent.x, &shown[0]) {
        let at = x + size * extent.place(&[value, 0.0])[0];
        canvas.line([at, y + size], [at, y + size + 4.0], 1.0, GREY);
        canvas.text(small(label, at, y + size + 17.0).anchored(Anchor::Middle));
    }
    for (value, label) in ticks(extent.y, &shown[1]) {
        let at = y + size * extent.place(&[0.0, value])[1];
        canvas.line([x - 4.0, at], [x, at], 1.0, GREY);
        canvas.text(small(label, x - 7.0, at + 4.0).anchored(Anchor::End));
    }
    let across = small(shown[0].caption.into(), x + size / 2.0, y + size + 36.0);
    canvas.text(across.anchored(Anchor::Middle).within(size));
    let up = small(shown[1].caption.into(), x - 42.0, y + size / 2.0);
    canvas.text(up.anchored(Anchor::Middle).upwards().within(size));
}

/// Shares a weight among the four cells around a position in cells.
fn drop_into(grid: &mut [f64], x: f64, y: f64, weight: f64) {
    let inside = |c: f64| (-1.0..GRID as f64).contains(&c);
    if !(inside(x) && inside(y)) {
        return;
    }
    let (x0, y0) = (x.floor(), y.floor());
    for (cy, wy) in [(y0, 1.0 - (y - y0)), (y0 + 1.0, y - y0)] {
        for (cx, wx) in [(x0, 1.0 - (x - x0)), (x0 + 1.0, x - x0)] {
            if (0.0..GRID as f64).contains(&cx) && (0.0..GRID as f64).contains(&cy) {
                grid[cy as usize * GRID + cx as usize] += weight * wx * wy;
            }
        }
    }
}

/// Half of a Gaussian with `sigma` in cells, from its middle to three sigmas; its whole sums to 1.
fn gaussian(sigma: f64) -> Vec<f64> {
    let reach = (3.0 * sigma).ceil() as usize;
    let value = |i: usize| (-0.5 * (i as f64 / sigma).powi(2)).exp();
    let half: Vec<f64> = (0..=reach).map(value).collect();
    let sum = 2.0 * half.iter().sum::<f64>() - half[0];
    half.iter().map(|v| v / sum).collect()
}

/// The grid with each row blurred.
fn blurred(grid: &[f64], kernel: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; grid.len()];
    for (from, to) in grid.chunks(GRID).zip(out.chunks_mut(GRID)) {
        for (i, &weight) in from.iter().enumerate().filter(|(_, w)| **w > 0.0) {
            let first = (i + 1).saturating_sub(kernel.len());
            let end = (i + kernel.len()).min(GRID);
            for (j, cell) in to.iter_mut().enumerate().take(end).skip(first) {
                *cell += weight * kernel[i.abs_diff(j)];
            }
        }
    }
    out
}

fn transposed(grid: &[f64]) -> Vec<f64> {
    let cell = |i: usize| grid[(i % GRID) * GRID + i / GRID];
    (0..grid.len()).map(cell).collect()
}

/// The grid's value at a position in cells, bilinear, constant beyond the border.
fn interpolate(grid: &[f64], x: f64, y: f64) -> f64 {
    let last = (GRID - 1) as f64;
    let (x, y) = (x.clamp(0.0, last), y.clamp(0.0, last));
    let (x0, y0) = (x.floor(), y.floor());
    let at = |x: f64, y: f64| grid[y.min(last) as usize * GRID + x.min(last) as usize];
    let row = |y: f64| at(x0, y) * (1.0 - (x - x0)) + at(x0 + 1.0, y) * (x - x0);
    row(y0) * (1.0 - (y - y0)) + row(y0 + 1.0) * (y - y0)
}
