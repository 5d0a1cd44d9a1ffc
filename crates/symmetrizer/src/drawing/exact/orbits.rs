//! Drawings that are their own copies under all turns about a point, and mirrored where there are lines through it.
//!
//! Of each ring the shortest stretch whose copies make up all of it is drawn with curves and rounded to the digits
//! that are written; the rest are its images. Quarter turns and lines at half a right angle move digits about; images
//! under other turns are rounded once more.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use kurbo::{CubicBez, Point as Flat, Vec2};

use super::{ACROSS, PRECISION, REACH, TOLERANCE, closed, round, text};
use crate::drawing::outline::Outline;
use crate::drawing::path::{Path, Subpath, write};
use crate::drawing::trace::Tracer;
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};

/// Points of a ring that are asked which ring their images lie on.
const ASKED: usize = 24;

/// A group of turns about a point of the plane, drawing coordinates.
#[derive(Debug, Clone)]
pub struct Turns {
    /// The number of turns, the whole one counted: 2 at least.
    pub order: usize,
    /// The fixed point.
    pub center: Point,
    /// Unit normal of a line through it that the group mirrors about, where it has lines.
    pub mirror: Option<Vector>,
}

/// The text of an SVG file with `outline` made exactly symmetric under `group`, whose centre is its origin and one of
/// whose lines stands upright.
///
/// # Errors
/// [`Error::Input`] where a ring does not meet its own lines as its images would.
pub fn svg(outline: &Outline, group: &Turns) -> Result<String> {
    let normal = group.mirror.unwrap_or(Vector::x());
    let placed = |x: &Point| {
        let way = x - group.center;
        Flat::new(normal.dot(&way), normal.x * way.y - normal.y * way.x)
    };
    let rings: Vec<Vec<Flat>> = outline
        .rings
        .iter()
        .map(|ring| ring.points.iter().map(placed).collect())
        .collect();
    let diagonal = outline.diagonal();
    let decimals = write::decimals(PRECISION * diagonal);
    let tracer = Tracer {
        tolerance: TOLERANCE * diagonal,
        reach: REACH * diagonal,
    };
    let elements = Element::all(group.order, group.mirror.is_some());
    let mut known = vec![false; rings.len()];
    let mut subpaths = Vec::new();
    for first in 0..rings.len() {
        if known[first] {
            continue;
        }
        let images: Vec<usize> = elements.iter().map(|g| image(&rings, first, g)).collect();
        let own = elements.iter().zip(&images).filter(|(_, r)| **r == first);
        let own: Vec<Element> = own.map(|(g, _)| *g).collect();
        let ring = Ring {
            points: &rings[first],
            own: &own,
        };
        let pieces = ring.pieces(&tracer, decimals)?;
        for (g, &at) in elements.iter().zip(&images) {
            if !std::mem::replace(&mut known[at], true) {
                subpaths.push(drawn(&pieces, g, decimals));
            }
        }
    }
    Ok(text(&Path { subpaths }, decimals, diagonal))
}

/// An element of the group: mirrored about the upright line or not, then turned by `turns` of `order`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Element {
    turns: usize,
    order: usize,
    is_mirrored: bool,
}

impl Element {
    /// All of a group, the one that leaves all in place first.
    fn all(order: usize, has_lines: bool) -> Vec<Self> {
        let element = |is_mirrored| {
            move |turns| Self {
                turns,
                order,
                is_mirrored,
            }
        };
        let mut all: Vec<Self> = (0..order).map(element(false)).collect();
        if has_lines {
            all.extend((0..order).map(element(true)));
        }
        all
    }

    /// First `other`, then this.
    fn after(&self, other: &Self) -> Self {
        let turns = if self.is_mirrored {
            self.order - other.turns
        } else {
            other.turns
        };
        Self {
            turns: (self.turns + turns) % self.order,
            order: self.order,
            is_mirrored: self.is_mirrored != other.is_mirrored,
        }
    }

    fn apply(&self, p: Flat) -> Flat {
        let (cos, sin) = turn(self.turns, self.order);
        let x = if self.is_mirrored { -p.x } else { p.x };
        Flat::new(cos * x - sin * p.y, sin * x + cos * p.y)
    }

    /// The direction of the line that an element mirrors about: upright, turned by half of its turn.
    fn line(&self) -> Vec2 {
        let (cos, sin) = turn(self.turns, 2 * self.order);
        Vec2::new(-sin, cos)
    }
}

/// Cosine and sine of `part` of `whole` full turns: opposite, mirrored and swapped where the angles are, to the last
/// bit.
fn turn(part: usize, whole: usize) -> (f64, f64) {
    let (quarters, rest) = (4 * part / whole, 4 * part % whole);
    let angle = |rest: usize| FRAC_PI_2 * rest as f64 / whole as f64;
    let (cos, sin) = match (2 * rest).cmp(&whole) {
        std::cmp::Ordering::Less => (angle(rest).cos(), angle(rest).sin()),
        std::cmp::Ordering::Equal => (FRAC_1_SQRT_2, FRAC_1_SQRT_2),
        std::cmp::Ordering::Greater => (angle(whole - rest).sin(), angle(whole - rest).cos()),
    };
    match quarters % 4 {
        0 => (cos, sin),
        1 => (-sin, cos),
        2 => (-cos, -sin),
        _ => (sin, -cos),
    }
}

/// The ring that most of the images of a ring's points lie on.
fn image(rings: &[Vec<Flat>], ring: usize, g: &Element) -> usize {
    let points = &rings[ring];
    let step = (points.len() / ASKED).max(1);
    let mut votes = vec![0; rings.len()];
    for p in points.iter().step_by(step) {
        let x = g.apply(*p);
        let away = rings.iter().map(|r| nearest(r, x).1);
        let best = away.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((r, _)) = best {
            votes[r] += 1;
        }
    }
    // The first of several.
    let most = votes.iter().copied().enumerate().rev();
    most.max_by_key(|v| v.1).map_or(ring, |v| v.0)
}

/// The place of a ring nearest to a point, as an edge and a share of it, and its squared distance.
fn nearest(ring: &[Flat], x: Flat) -> (f64, f64) {
    let place = |k: usize| {
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        let way = b - a;
        let t = ((x - a).dot(way) / way.hypot2().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        (k as f64 + t, (a + way * t - x).hypot2())
    };
    let all = (0..ring.len()).map(place);
    all.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
}

/// A ring and the elements that take it to itself.
struct Ring<'a> {
    points: &'a [Flat],
    own: &'a [Element],
}

/// A stretch of curves, and the elements whose images of it follow each other round a ring, every second run through
/// the other way where it is mirrored.
struct Pieces {
    curves: Vec<CubicBez>,
    images: Vec<Element>,
    /// What mirrors about the lines that its ends lie on, where they do.
    ends: Option<[Element; 2]>,
}

impl Ring<'_> {
    fn pieces(&self, tracer: &Tracer, decimals: u32) -> Result<Pieces> {
        let turns = self.own.iter().filter(|g| !g.is_mirrored).count();
        let lines: Vec<Element> = self.own.iter().filter(|g| g.is_mirrored).copied().collect();
        let mut pieces = match (turns, lines.as_slice()) {
            (1, []) => Pieces {
                curves: tracer.ring(self.points.to_vec()),
                images: vec![self.own[0]],
                ends: None,
            },
            (_, []) => self.turned(tracer, turns)?,
            _ => self.mirrored(tracer, &lines)?,
        };
        for c in &mut pieces.curves {
            let [a, b, d, e] = [c.p0, c.p1, c.p2, c.p3].map(|p| round(p, decimals));
            *c = CubicBez::new(a, b, d, e);
        }
        Ok(pieces)
    }

    /// The stretch from a place to where the smallest of its own turns takes it.
    fn turned(&self, tracer: &Tracer, count: usize) -> Result<Pieces> {
        let area: f64 = self.edges().map(|(a, b)| a.x * b.y - b.x * a.y).sum();
        let order = self.own[0].order;
        let step = order / count;
        let turns = if area < 0.0 { order - step } else { step };
        let g = Element {
            turns,
            ..self.own[0]
        };
        let first = self.points[0];
        let (end, _) = nearest(self.points, g.apply(first));
        let mut stretch = self.between(0.0, end);
        stretch.pop();
        stretch.push(g.apply(first));
        if stretch.len() < 3 {
            return Err(unfit());
        }
        let mut curves = tracer.chain(&stretch);
        smooth(&mut curves, &g);
        Ok(Pieces {
            curves,
            images: powers(&g, count),
            ends: None,
        })
    }

    /// The stretch from one of its own lines to the next.
    fn mirrored(&self, tracer: &Tracer, lines: &[Element]) -> Result<Pieces> {
        let mut met: Vec<(f64, Element)> = Vec::new();
        for g in lines {
            let places = self.crossings(&g.line());
            met.extend(places.into_iter().map(|at| (at, *g)));
        }
        met.sort_by(|a, b| a.0.total_cmp(&b.0));
        if met.len() != 2 * lines.len() {
            return Err(unfit());
        }
        let [(from, m), (to, l)] = [met[0], met[1]];
        let mut stretch = self.between(from, to);
        let count = stretch.len();
        if count < 3 {
            return Err(unfit());
        }
        for (k, line) in [(0, m.line()), (count - 1, l.line())] {
            stretch[k] = (line * stretch[k].to_vec2().dot(line)).to_point();
        }
        let mut curves = tracer.chain(&stretch);
        across(&mut curves, [m.line(), l.line()]);
        let images = powers(&l.after(&m), lines.len());
        let both = images.iter().flat_map(|g| [*g, g.after(&l)]);
        Ok(Pieces {
            curves,
            images: both.collect(),
            ends: Some([m, l]),
        })
    }

    fn edges(&self) -> impl Iterator<Item = (Flat, Flat)> + '_ {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().copied().zip(next.copied())
    }

    /// Where it crosses a line through the centre, as edges and shares of them.
    fn crossings(&self, line: &Vec2) -> Vec<f64> {
        let side = |p: Flat| line.cross(p.to_vec2());
        let crossing = |(k, (a, b)): (usize, (Flat, Flat))| {
            let (from, to) = (side(a), side(b));
            ((from < 0.0) != (to < 0.0)).then(|| k as f64 + from / (from - to))
        };
        self.edges().enumerate().filter_map(crossing).collect()
    }

    /// The points from one place to another further on.
    fn between(&self, from: f64, to: f64) -> Vec<Flat> {
        let count = self.points.len();
        let at = |place: f64| {
            let k = (place.floor() as usize).min(count - 1);
            self.points[k].lerp(self.points[(k + 1) % count], place - k as f64)
        };
        let mut points = vec![at(from)];
        let inner = from.floor() as usize + 1..=to.ceil() as usize - 1;
        points.extend(inner.map(|k| self.points[k % count]));
        points.push(at(to));
        points.dedup_by(|a, b| a.distance(*b) < 1e-12);
        points
    }
}

/// The first `count` powers of an element, the nought one first.
fn powers(g: &Element, count: usize) -> Vec<Element> {
    let one = Element {
        turns: 0,
        is_mirrored: false,
        ..*g
    };
    std::iter::successors(Some(one), |power| Some(g.after(power)))
        .take(count)
        .collect()
}

/// Lets a stretch go on into its image under `g` without a corner where it nearly does.
fn smooth(curves: &mut [CubicBez], g: &Element) {
    let origin = g.apply(Flat::ZERO);
    let Some((first, last)) = curves.first().zip(curves.last()) else {
        return;
    };
    let (start, end) = (first.p1 - first.p0, last.p3 - last.p2);
    let start_there = g.apply(start.to_point()) - origin;
    if start_there.dot(end) < ACROSS * start_there.hypot() * end.hypot() || end.hypot() == 0.0 {
        return;
    }
    let mean = start_there.normalize() + end.normalize();
    let back = Element {
        turns: (g.order - g.turns) % g.order,
        ..*g
    };
    let mean = mean.normalize();
    let mean_here = back.apply(mean.to_point()).to_vec2();
    let count = curves.len();
    curves[0].p1 = curves[0].p0 + mean_here * start.hypot();
    curves[count - 1].p2 = curves[count - 1].p3 - mean * end.hypot();
}

/// Lets the ends cross their lines at right angles where they nearly do.
fn across(curves: &mut [CubicBez], lines: [Vec2; 2]) {
    let upright = |end: Flat, handle: Flat, line: Vec2| {
        let way = handle - end;
        let off = way - line * way.dot(line);
        if off.hypot() > ACROSS * way.hypot() {
            end + off
        } else {
            handle
        }
    };
    if let Some(c) = curves.first_mut() {
        c.p1 = upright(c.p0, c.p1, lines[0]);
    }
    if let Some(c) = curves.last_mut() {
        c.p2 = upright(c.p3, c.p2, lines[1]);
    }
}

/// The closed path of pieces under an element.
fn drawn(pieces: &Pieces, g: &Element, decimals: u32) -> Subpath {
    let image = |of: &Element| {
        let g = g.after(of);
        let place = |p: Flat| round(g.apply(p), decimals);
        let moved = pieces
            .curves
            .iter()
            .map(|c| CubicBez::new(place(c.p0), place(c.p1), place(c.p2), place(c.p3)));
        let mut moved: Vec<CubicBez> = moved.collect();
        if let (Some([m, l]), [first, .., last]) = (pieces.ends, pieces.curves.as_slice()) {
            // Two elements take an end to the same place, rounded apart: between them it is nobody's more.
            let between = |p: Flat, line: Element| {
                round(g.apply(p).midpoint(g.after(&line).apply(p)), decimals)
            };
            let count = moved.len();
            moved[0].p0 = between(first.p0, m);
            moved[count - 1].p3 = between(last.p3, l);
        }
        if of.is_mirrored {
            moved.reverse();
            for c in &mut moved {
                *c = CubicBez::new(c.p3, c.p2, c.p1, c.p0);
            }
        }
        moved
    };
    let curves: Vec<CubicBez> = pieces.images.iter().flat_map(image).collect();
    closed(&curves)
}

fn unfit() -> Error {
    Error::input(
        "a ring of the outline meets the lines of its symmetry as its images would not",
        "write it without --exact",
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::outline::Ring as Line;
    use crate::drawing::{Format, Reading, decode};

    /// A wavy ring with `waves` about (3, 1), leaning where it has no lines, and a hole beside the centre for each.
    fn flower(waves: u32, leans: bool) -> Outline {
        let about = |x: f64, y: f64| Point::new(3.0 + x, 1.0 + y, 0.0);
        let ring = (0..400).map(|k| {
            let angle = f64::from(k) / 400.0 * std::f64::consts::TAU;
            let lean = if leans {
                0.4 * (f64::from(waves) * angle).cos()
            } else {
                0.0
            };
            let r = 2.0 + 0.4 * (f64::from(waves) * (angle + lean)).sin();
            about(r * angle.cos(), r * angle.sin())
        });
        let mut rings = vec![Line::new(ring.collect())];
        for k in 0..waves {
            let angle = (f64::from(k) + 0.25) / f64::from(waves) * std::f64::consts::TAU;
            let hole = (0..60).map(|j| {
                let a = -f64::from(j) / 60.0 * std::f64::consts::TAU;
                about(angle.cos() + 0.1 * a.cos(), angle.sin() + 0.1 * a.sin())
            });
            rings.push(Line::new(hole.collect()));
        }
        Outline { rings }
    }

    /// How far the points of a file's outline, moved, lie from its points at the most.
    fn missed(text: &str, moved: impl Fn(Flat) -> Flat) -> f64 {
        let drawing = decode(text.as_bytes().to_vec(), Format::Svg, &Reading::default());
        let drawing = drawing.expect("a drawing");
        let points = drawing.outline().points();
        let all: Vec<Flat> = points.map(|p| Flat::new(p.x, p.y)).collect();
        let away = |p: &Flat| {
            let ways = all.iter().map(|q| moved(*p).distance(*q));
            ways.fold(f64::INFINITY, f64::min)
        };
        all.iter().map(away).fold(0.0, f64::max)
    }

    #[test]
    fn quarter_turns_move_digits_about() {
        for (leans, mirror) in [(true, None), (false, Some(Vector::x()))] {
            let outline = flower(4, leans);
            // The waves' lines lie at an eighth of a turn over four.
            let normal = |v: Vector| {
                let (sin, cos) = (std::f64::consts::FRAC_PI_8).sin_cos();
                Vector::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, 0.0)
            };
            let group = Turns {
                order: 4,
                center: Point::new(3.0, 1.0, 0.0),
                mirror: mirror.map(normal),
            };
            let text = svg(&outline, &group).expect("a file");
            // Points of flattened curves: the same but for the last bits.
            assert!(missed(&text, |p| Flat::new(-p.y, p.x)) < 1e-12, "{text}");
            if mirror.is_some() {
                assert!(missed(&text, |p| Flat::new(-p.x, p.y)) < 1e-12, "{text}");
            }
            let read = decode(text.into_bytes(), Format::Svg, &Reading::default());
            let read = read.expect("a drawing");
            assert_eq!(read.outline().rings.len(), 5);
            let lost = read.outline().area() / outline.area() - 1.0;
            assert!(lost.abs() < 2e-3, "{lost}");
        }
    }

    #[test]
    fn other_turns_agree_to_the_last_digit() {
        let outline = flower(6, true);
        let group = Turns {
            order: 6,
            center: Point::new(3.0, 1.0, 0.0),
            mirror: None,
        };
        let text = svg(&outline, &group).expect("a file");
        let (cos, sin) = turn(1, 6);
        let turned = |p: Flat| Flat::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
        let away = missed(&text, turned);
        assert!(away < 2e-4, "{away}");
    }

    #[test]
    fn turns_are_opposite_to_the_bit() {
        for whole in 1..40 {
            for part in 0..whole {
                let ((c, s), (d, t)) = (turn(part, whole), turn((whole - part) % whole, whole));
                assert!(c == d && s == -t, "{part}/{whole}");
                let angle = std::f64::consts::TAU * part as f64 / whole as f64;
                assert!((c - angle.cos()).abs() < 1e-12 && (s - angle.sin()).abs() < 1e-12);
            }
        }
    }
}
