//! Path data, the value of `d`. A library reads the commands; their meaning is settled here, because
//! its own conversion replaces arcs to a fixed tenth of a unit, which is far too much in an icon of
//! 24 units.

use kurbo::{CubicBez, Line, PathSeg, Point, QuadBez, SvgArc, Vec2};
use svgtypes::{PathParser, PathSegment as Command};

use super::{Path, Subpath, arc};

/// A path and, where its data is damaged, what is wrong after it: it counts up to there.
pub(in crate::drawing) struct Parsed {
    pub path: Path,
    pub damage: Option<String>,
}

/// The path that the value of `d` describes.
pub(in crate::drawing) fn path(data: &str) -> Parsed {
    let mut pen = Drawn::default();
    let mut damage = None;
    for command in PathParser::from(data) {
        match command {
            Ok(command) => pen.follow(&command),
            Err(e) => {
                damage = Some(e.to_string());
                break;
            }
        }
    }
    let path = pen.path();
    Parsed { path, damage }
}

/// What a smooth command reflects.
#[derive(Default, Clone, Copy, PartialEq)]
enum Handle {
    #[default]
    None,
    Cubic(Point),
    Quad(Point),
}

/// A path while it is drawn.
#[derive(Default)]
pub(in crate::drawing) struct Drawn {
    subpaths: Vec<Subpath>,
    at: Point,
    handle: Handle,
}

impl Drawn {
    pub fn path(self) -> Path {
        Path {
            subpaths: self.subpaths,
        }
    }

    pub fn at(&self) -> Point {
        self.at
    }

    fn follow(&mut self, command: &Command) {
        let origin = if command.is_abs() {
            Vec2::ZERO
        } else {
            self.at.to_vec2()
        };
        let point = |x: f64, y: f64| Point::new(x, y) + origin;
        match *command {
            Command::MoveTo { x, y, .. } => self.start(point(x, y)),
            Command::LineTo { x, y, .. } => self.line(point(x, y)),
            Command::HorizontalLineTo { x, .. } => {
                self.line(Point::new(x + origin.x, self.at.y));
            }
            Command::VerticalLineTo { y, .. } => self.line(Point::new(self.at.x, y + origin.y)),
            Command::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
                ..
            } => self.cubic(point(x1, y1), point(x2, y2), point(x, y)),
            Command::SmoothCurveTo { x2, y2, x, y, .. } => {
                let first = match self.handle {
                    Handle::Cubic(h) => self.at + (self.at - h),
                    _ => self.at,
                };
                self.cubic(first, point(x2, y2), point(x, y));
            }
            Command::Quadratic { x1, y1, x, y, .. } => self.quad(point(x1, y1), point(x, y)),
            Command::SmoothQuadratic { x, y, .. } => {
                let control = match self.handle {
                    Handle::Quad(h) => self.at + (self.at - h),
                    _ => self.at,
                };
                self.quad(control, point(x, y));
            }
            Command::EllipticalArc {
                rx,
                ry,
                x_axis_rotation,
                large_arc,
                sweep,
                x,
                y,
                ..
            } => self.arc(&SvgArc {
                from: self.at,
                to: point(x, y),
                radii: Vec2::new(rx, ry),
                x_rotation: x_axis_rotation.to_radians(),
                large_arc,
                sweep,
            }),
            Command::ClosePath { .. } => self.close(),
        }
    }

    pub fn start(&mut self, at: Point) {
        self.subpaths.push(Subpath::new(at));
        self.at = at;
        self.handle = Handle::None;
    }

    fn push(&mut self, segment: PathSeg, end: Point, handle: Handle) {
        // After a closed subpath the next begins at the same point.
        if self.subpaths.last().is_none_or(|s| s.closed) {
            self.subpaths.push(Subpath::new(self.at));
        }
        if let Some(subpath) = self.subpaths.last_mut() {
            subpath.segments.push(segment);
        }
        self.at = end;
        self.handle = handle;
    }

    pub fn line(&mut self, to: Point) {
        self.push(PathSeg::Line(Line::new(self.at, to)), to, Handle::None);
    }

    fn cubic(&mut self, a: Point, b: Point, to: Point) {
        let curve = CubicBez::new(self.at, a, b, to);
        self.push(PathSeg::Cubic(curve), to, Handle::Cubic(b));
    }

    fn quad(&mut self, control: Point, to: Point) {
        let curve = QuadBez::new(self.at, control, to);
        self.push(PathSeg::Quad(curve), to, Handle::Quad(control));
    }

    pub fn arc(&mut self, svg: &SvgArc) {
        let curves = arc::curves(svg);
        if curves.is_empty() && svg.from != svg.to {
            self.line(svg.to);
        }
        for curve in curves {
            self.push(PathSeg::Cubic(curve), curve.p3, Handle::None);
        }
    }

    pub fn close(&mut self) {
        if let Some(subpath) = self.subpaths.last_mut().filter(|s| !s.closed) {
            subpath.close();
            self.at = subpath.start;
        }
        self.handle = Handle::None;
    }
}
