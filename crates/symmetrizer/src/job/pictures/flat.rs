//! Pictures of drawings: outlines with their lines and their mirror images, transformation space as angle and
//! distance of the line (figure 2), the pairs and the spine, the mesh inside.

use crate::deform::Igarashi;
use crate::error::Result;
use crate::geom::{Point, Vector};
use crate::job::pictures::plots::plot_title;
use crate::job::pictures::{color, hue};
use crate::job::{Detected, Measured, Symmetrized};
use crate::patch::Symmetry;
use crate::picture::canvas::{GREY, INK, Text};
use crate::picture::{Axis, Canvas, DensityPlot, Extent, PlotMode, checks};
use crate::shape::SurfacePoint;
use crate::shape::wall::Wall;
use crate::straighten::Bend;
use crate::transform::{Isometry, Plane};

/// Side of a panel, the room for the page's title and for a panel's own, pixels.
const SIDE: u32 = 460;
const HEAD: u32 = 64;
const CAPTION: f64 = 24.0;
/// Room around a shape in its panel, pixels.
const MARGIN: f64 = 14.0;
/// Lines drawn at the most.
const LINES: usize = 3;
/// Of all pairs one in so many is drawn.
const PAIRS: usize = 5;
/// Inside of shapes, light grey.
const INSIDE: [u8; 3] = [228, 231, 236];
/// The mirror image that is laid over a shape.
const IMAGE: [u8; 3] = [220, 60, 60];
/// How far a vote is spread in plots, in units of what clustering takes.
const SHARPNESS: f64 = 0.5;
/// Half of the range of distances in plots, fraction of L: as wide as the angles, by how far images move.
const FARTHEST: f64 = std::f64::consts::FRAC_PI_8;

/// The run of a drawing: input above result, each with transformation space.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub(super) fn before_after(
    job: &Symmetrized,
    title: &str,
    figures: &str,
) -> Result<Option<Canvas>> {
    let Some(wall) = &job.before.wall else {
        return Ok(None);
    };
    let rows = if job.after.is_some() { 2 } else { 1 };
    let mut page = Canvas::new(3 * SIDE, HEAD + rows * SIDE);
    let width = f64::from(page.width()) - 32.0;
    page.text(Text::new(title, 16.0, 28.0, 20.0).bold().within(width));
    page.text(
        Text::new(figures, 16.0, 52.0, 14.0)
            .colored(GREY)
            .within(width),
    );
    let bandwidth = job.report.head.params.cluster.bandwidth;
    let frame = Frame::around(wall);
    let place = |column: u32, row: u32| [column * SIDE, HEAD + row * SIDE];

    let mut panel = Panel::new(
        &mut page,
        place(0, 0),
        frame,
        "input, its lines and mirror image",
    );
    panel.state(&job.before, wall, Some(job.planes[0]));
    density(&job.before, bandwidth).draw(&mut page, place(1, 0), "before");
    let body = Igarashi::new(wall.clone())?;
    let mut panel = Panel::new(&mut page, place(2, 0), frame, "");
    match &job.bend {
        Some(bent) => panel.field(&job.before, wall, &bent.bend),
        None => panel.mesh(
            &body.sheet().surface.triangles,
            &body.sheet().surface.positions,
        ),
    }
    if let Some((after, moved)) = job.after.as_ref().and_then(|a| Some((a, a.wall.as_ref()?))) {
        let frame = Frame::around(moved).as_large_as(&frame);
        let mut panel = Panel::new(&mut page, place(0, 1), frame, "result and its mirror image");
        panel.state(after, moved, Some(job.planes[1]));
        density(after, bandwidth).draw(&mut page, place(1, 1), "after");
        let inside = body.filled(&after.working.surface.positions)?;
        let mut panel = Panel::new(&mut page, place(2, 1), frame, "");
        panel.mesh(&body.sheet().surface.triangles, &inside);
    }
    Ok(Some(page))
}

/// A drawing with the lines that were found.
pub(super) fn found(found: &Detected, title: &str) -> Option<Canvas> {
    let wall = found.wall.as_ref()?;
    let mut page = Canvas::new(2 * SIDE, HEAD + SIDE);
    page.text(
        Text::new(title, 16.0, 28.0, 20.0)
            .bold()
            .within(f64::from(2 * SIDE) - 32.0),
    );
    let first = found.symmetries().first().map(Symmetry::plane);
    let mut panel = Panel::new(&mut page, [0, HEAD], Frame::around(wall), "");
    panel.state(found, wall, first);
    density(found, crate::cluster::ClusterParams::default().bandwidth).draw(
        &mut page,
        [SIDE, HEAD],
        "",
    );
    Some(page)
}

/// A drawing with the line that was measured.
pub(super) fn measured(measured: &Measured, title: &str, line: bool) -> Option<Canvas> {
    let wall = measured.wall.as_ref()?;
    let mut page = Canvas::new(SIDE, HEAD + SIDE);
    page.text(
        Text::new(title, 16.0, 28.0, 20.0)
            .bold()
            .within(f64::from(SIDE) - 32.0),
    );
    let mut panel = Panel::new(&mut page, [0, HEAD], Frame::around(wall), "");
    panel.outline(wall);
    if line {
        panel.image(wall, &measured.asymmetry.plane);
        panel.line(&measured.asymmetry.plane, INK, 1.5);
    }
    Some(page)
}

/// The plot of transformation space alone.
pub(super) fn plotted(found: &Detected, bandwidth: f64, title: &str) -> Option<Canvas> {
    found.wall.as_ref()?;
    let side = 2 * SIDE;
    let mut page = Canvas::new(side, HEAD + side);
    page.text(
        Text::new(title, 16.0, 28.0, 20.0)
            .bold()
            .within(f64::from(side) - 32.0),
    );
    let votes = density(found, bandwidth);
    let title = plot_title(found, 0);
    votes.plot(&title).draw(&mut page, 0, HEAD, side);
    Some(page)
}

/// What is seen of the plane: its middle, working coordinates, and pixels for each L.
#[derive(Clone, Copy)]
struct Frame {
    middle: Point,
    scale: f64,
}

impl Frame {
    fn around(wall: &Wall) -> Self {
        let x = &wall.surface.positions;
        let low = x.iter().fold(x[0], |m, x| m.inf(x));
        let high = x.iter().fold(x[0], |m, x| m.sup(x));
        let room = f64::from(SIDE) - 2.0 * MARGIN - CAPTION;
        let size = (high.x - low.x).max(high.y - low.y);
        Self {
            middle: nalgebra::center(&low, &high),
            scale: room / size.max(f64::MIN_POSITIVE),
        }
    }

    /// The same middle, nothing larger than in the other.
    fn as_large_as(self, other: &Self) -> Self {
        Self {
            scale: self.scale.min(other.scale),
            ..self
        }
    }
}

/// A square of the page with a piece of the plane in it.
struct Panel<'a> {
    page: &'a mut Canvas,
    corner: [f64; 2],
    frame: Frame,
}

impl<'a> Panel<'a> {
    fn new(page: &'a mut Canvas, corner: [u32; 2], frame: Frame, caption: &str) -> Self {
        let corner = corner.map(f64::from);
        let mut panel = Self {
            page,
            corner,
            frame,
        };
        panel.caption(caption);
        panel
    }

    fn caption(&mut self, caption: &str) {
        let [x, y] = self.corner;
        let text = Text::new(caption, x + MARGIN, y + 16.0, 14.0).colored(GREY);
        self.page.text(text.within(f64::from(SIDE) - 2.0 * MARGIN));
    }

    fn at(&self, x: &Point) -> [f64; 2] {
        let way = (x - self.frame.middle) * self.frame.scale;
        let half = f64::from(SIDE) / 2.0;
        [
            self.corner[0] + half + way.x,
            self.corner[1] + half + CAPTION / 2.0 - way.y,
        ]
    }

    fn rings(&self, wall: &Wall, place: impl Fn(Point) -> Point) -> Vec<Vec<[f64; 2]>> {
        let ring = |edges: &std::ops::Range<usize>| {
            let mut points: Vec<[f64; 2]> = edges
                .clone()
                .map(|e| self.at(&place(wall.start(e))))
                .collect();
            points.extend(points.first().copied());
            points
        };
        wall.rings.iter().map(ring).collect()
    }

    fn outline(&mut self, wall: &Wall) {
        let rings = self.rings(wall, |x| x);
        self.page.area(rings.clone(), INSIDE);
        for ring in rings {
            self.page.path(ring, 1.2, INK);
        }
    }

    /// The mirror image, over the shape.
    fn image(&mut self, wall: &Wall, plane: &Plane) {
        let mirror = Isometry::mirror(plane);
        for ring in self.rings(wall, |x| mirror.apply(&x)) {
            self.page.path(ring, 1.0, IMAGE);
        }
    }

    /// A line across the shape.
    fn line(&mut self, plane: &Plane, color: [u8; 3], width: f64) {
        let (n, middle) = (plane.normal, self.frame.middle);
        let foot = middle - plane.signed_distance(&middle) * n;
        let half = (f64::from(SIDE) / 2.0 - MARGIN) / self.frame.scale;
        let way = Vector::new(-n.y, n.x, 0.0) * half;
        let ends = [foot - way, foot + way].map(|x| self.at(&x));
        self.page.line(ends[0], ends[1], width, color);
    }

    /// The shape with what its symmetries hold for, and its image under `plane`.
    fn state(&mut self, found: &Detected, wall: &Wall, plane: Option<Plane>) {
        self.outline(wall);
        if let Some(plane) = plane {
            self.image(wall, &plane);
        }
        for s in found.symmetries().iter().take(LINES).rev() {
            for pair in &s.pairs {
                let x = found.detection.samples.list[pair.sample as usize].position;
                self.page.circle(self.at(&x), 1.5, 1.5, color(s.id));
            }
            self.line(&s.plane(), color(s.id), 1.5);
        }
    }

    /// The pairs of a field in matching colours, and the middles between them.
    fn field(&mut self, found: &Detected, wall: &Wall, bend: &Bend) {
        self.caption("pairs and spine");
        self.outline(wall);
        let list = &found.detection.samples.list;
        let along = Along::of(wall);
        for (k, (s, partner)) in list.iter().zip(&bend.settled.partners).enumerate() {
            let Some(q) = partner else { continue };
            let color = checks::hue(along.share(wall, &s.at, &q.at));
            let ends = [self.at(&s.position), self.at(&q.position)];
            if k % PAIRS == 0 {
                self.page.line(ends[0], ends[1], 0.7, color);
            }
            let middle = [0, 1].map(|i| (ends[0][i] + ends[1][i]) / 2.0);
            self.page.circle(middle, 0.8, 1.2, color);
        }
    }

    fn mesh(&mut self, triangles: &[[u32; 3]], positions: &[Point]) {
        self.caption("the mesh inside");
        for corners in triangles {
            let [a, b, c] = corners.map(|v| self.at(&positions[v as usize]));
            self.page.path(vec![a, b, c, a], 0.4, PALE_BLUE);
        }
    }
}

/// Edges of meshes.
const PALE_BLUE: [u8; 3] = [90, 120, 170];

/// How far along an outline places are.
struct Along {
    starts: Vec<f64>,
    total: f64,
}

impl Along {
    fn of(wall: &Wall) -> Self {
        let mut starts = Vec::new();
        let mut total = 0.0;
        for ring in 0..wall.rings.len() {
            starts.push(total);
            total += wall.length(ring);
        }
        Self { starts, total }
    }

    /// 0 to 1, the same for two partners.
    fn share(&self, wall: &Wall, p: &SurfacePoint, q: &SurfacePoint) -> f64 {
        let share = |at: &SurfacePoint| {
            let (ring, along) = wall.along(at);
            (self.starts[ring] + along) / self.total
        };
        share(p).min(share(q))
    }
}

/// Votes as lines: half their angle in radians, and twice their distance from the centre, so that images move alike
/// along both.
struct Votes {
    points: Vec<[f64; 2]>,
    weights: Vec<f64>,
    modes: Vec<PlotMode>,
    bandwidth: f64,
}

/// The place of a line in the plot; its angle is the same again after half a turn, with the other sign of the
/// distance.
fn line_at(plane: &Plane) -> [f64; 2] {
    let angle = plane.normal.y.atan2(plane.normal.x);
    let turned = angle.rem_euclid(std::f64::consts::PI);
    let sign = if (turned - angle).abs() < 1e-9 || (turned - angle).abs() > 6.0 {
        1.0
    } else {
        -1.0
    };
    [turned / 2.0, 2.0 * sign * plane.offset]
}

/// The place again where it lies beside the other border.
fn wrapped([x, y]: [f64; 2]) -> [[f64; 2]; 2] {
    let whole = std::f64::consts::FRAC_PI_2;
    let other = if x < whole / 2.0 {
        x + whole
    } else {
        x - whole
    };
    [[x, y], [other, -y]]
}

fn density(found: &Detected, bandwidth: f64) -> Votes {
    let Some(cloud) = found.detection.clouds.first() else {
        return Votes {
            points: Vec::new(),
            weights: Vec::new(),
            modes: Vec::new(),
            bandwidth,
        };
    };
    // Every vote is its own mirror, wherever it was cast.
    let origin = Point::origin();
    let place = |t: &Isometry| line_at(&t.nearest_mirror(&origin));
    let votes = cloud.pairs.iter();
    let mark = |s: &Symmetry| PlotMode {
        position: line_at(&s.plane()),
        label: s.id.to_string(),
        height: s.height,
        color: hue(s.id),
    };
    Votes {
        points: votes
            .clone()
            .flat_map(|v| wrapped(place(&v.q_from_p)))
            .collect(),
        weights: votes.flat_map(|v| [v.weight; 2]).collect(),
        modes: found.symmetries().iter().map(mark).collect(),
        bandwidth,
    }
}

impl Votes {
    fn plot<'a>(&'a self, title: &'a str) -> DensityPlot<'a> {
        DensityPlot {
            points: &self.points,
            weights: &self.weights,
            modes: &self.modes,
            bandwidth: SHARPNESS * self.bandwidth,
            axes: Some(Extent {
                x: [0.0, std::f64::consts::FRAC_PI_2],
                y: [-2.0 * FARTHEST, 2.0 * FARTHEST],
            }),
            shown: [
                Axis {
                    caption: "angle of the line's normal, degrees",
                    unit: 360.0 / std::f64::consts::PI,
                },
                Axis {
                    caption: "distance from the centre, fraction of L",
                    unit: 0.5,
                },
            ],
            title,
        }
    }

    fn draw(&self, page: &mut Canvas, [x, y]: [u32; 2], title: &str) {
        self.plot(title).draw(page, x, y, SIDE);
    }
}
