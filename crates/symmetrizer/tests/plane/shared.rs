//! What these tests share: outlines of drawings, and how they are looked at.

use crate::common::model;
use symmetrizer::detect::{DetectParams, Detection, detect_in_plane};
use symmetrizer::drawing::{Reading, read};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::wall::Wall;
use symmetrizer::{Context, Drawing, Drawn, Params, symmetrize_drawing};

/// The outline of a drawing, turned, scaled and moved, as a wall.
pub fn wall(name: &str, angle: f64, scale: f64) -> Option<Wall> {
    let drawing = read(&model(name)?, &Reading::default()).expect("a drawing");
    let (sin, cos) = angle.sin_cos();
    let place = |x: &Point| {
        Point::new(
            scale * (cos * x.x - sin * x.y) + 7.0,
            scale * (sin * x.x + cos * x.y) - 3.0,
            0.0,
        )
    };
    let rings = drawing.outline().rings.iter();
    let rings: Vec<Vec<Point>> = rings
        .map(|r| r.points.iter().map(place).collect())
        .collect();
    Some(Wall::new(&rings).expect("a wall"))
}

pub fn found(wall: &Wall) -> Detection {
    let params = DetectParams::default();
    detect_in_plane(wall, &params, &mut Context::new(0)).expect("a detection")
}

/// The lines that hold for nearly all of an outline, and their largest rms, fraction of L.
pub fn whole(found: &Detection) -> (usize, f64) {
    let mirrors = found.symmetries.iter().filter(|s| s.q_from_p.is_improper());
    let all = mirrors.filter(|s| s.area_fraction > 0.9);
    all.fold((0, 0.0), |(n, rms), s| (n + 1, f64::max(rms, s.rms)))
}

#[derive(serde::Deserialize)]
pub struct Truth {
    pub placement: Placement,
}

/// Of the rest shape, whose line is x = 0, in the file: y = matrix x + offset, y downwards.
#[derive(serde::Deserialize)]
pub struct Placement {
    pub matrix: [[f64; 2]; 2],
    pub offset: [f64; 2],
}

pub fn drawing(name: &str) -> Option<Drawing> {
    Some(read(&model(name)?, &Reading::default()).expect("a drawing"))
}

pub fn symmetrized(drawing: &Drawing) -> Drawn {
    symmetrize_drawing(drawing, &Params::default(), &mut Context::new(0)).expect("a run")
}

/// The corners of a file's path, where they are, by their number.
pub fn corners(drawing: &Drawing, count: usize) -> Vec<Option<Point>> {
    let mut places = vec![None; count];
    for ring in &drawing.outline().rings {
        for (x, source) in ring.points.iter().zip(&ring.sources) {
            let at = source.filter(|s| s.t == 0.0).map(|s| s.segment as usize);
            if let Some(place) = at.and_then(|at| places.get_mut(at)) {
                *place = Some(*x);
            }
        }
    }
    places
}

#[derive(serde::Deserialize)]
pub struct Rests {
    rings: Vec<Rest>,
}

#[derive(serde::Deserialize)]
pub struct Rest {
    rest: Vec<[f64; 2]>,
}

pub fn rest(name: &str) -> Vec<Point> {
    let path = model(&format!("truth/{name}.truth.json")).expect("a truth");
    let text = std::fs::read_to_string(path).expect("a file");
    let truth: Rests = serde_json::from_str(&text).expect("a truth");
    let all = truth.rings.iter().flat_map(|r| &r.rest);
    all.map(|[x, y]| Point::new(*x, *y, 0.0)).collect()
}

/// rms distance from the rest after the best similarity, mirrored or not, % of D.
pub fn missed(drawing: &Drawing, rest: &[Point]) -> f64 {
    let pairs: Vec<(Point, Point)> = corners(drawing, rest.len())
        .into_iter()
        .zip(rest)
        .filter_map(|(x, y)| Some((x?, *y)))
        .collect();
    assert!(pairs.len() > rest.len() / 2, "{} corners", pairs.len());
    let n = pairs.len() as f64;
    let mean = |of: fn(&(Point, Point)) -> Point| -> Vector {
        pairs.iter().map(|p| of(p).coords).sum::<Vector>() / n
    };
    let (p, q) = (mean(|p| p.0), mean(|p| p.1));
    let after = |flip: f64| {
        let centred: Vec<(Vector, Vector)> = pairs
            .iter()
            .map(|(x, y)| {
                let x = x.coords - p;
                (Vector::new(flip * x.x, x.y, 0.0), y.coords - q)
            })
            .collect();
        let size: f64 = centred.iter().map(|(x, _)| x.norm_squared()).sum();
        let c: f64 = centred.iter().map(|(x, y)| x.dot(y)).sum::<f64>() / size;
        let s: f64 = centred
            .iter()
            .map(|(x, y)| x.x * y.y - x.y * y.x)
            .sum::<f64>()
            / size;
        let squares = centred.iter().map(|(x, y)| {
            (Vector::new(c * x.x - s * x.y, s * x.x + c * x.y, 0.0) - y).norm_squared()
        });
        (squares.sum::<f64>() / n).sqrt()
    };
    let low = rest.iter().fold(rest[0], |m, x| m.inf(x));
    let high = rest.iter().fold(rest[0], |m, x| m.sup(x));
    100.0 * after(1.0).min(after(-1.0)) / (high - low).norm()
}

/// The number of pairs of edges of a drawing's outline that cross and have no end in common.
pub fn crossings(drawing: &Drawing) -> usize {
    let rings = &drawing.outline().rings;
    let edges: Vec<(&Point, &Point)> = rings.iter().flat_map(|r| r.edges()).collect();
    let side = |a: &Point, b: &Point, x: &Point| (b - a).cross(&(x - a)).z;
    let boxes = |(a, b): (&Point, &Point)| (a.inf(b), a.sup(b));
    let cross = |(a, b): (&Point, &Point), (c, d): (&Point, &Point)| {
        let ((low, high), (from, to)) = (boxes((a, b)), boxes((c, d)));
        let apart = low.x > to.x || from.x > high.x || low.y > to.y || from.y > high.y;
        let joined = a == c || a == d || b == c || b == d;
        !apart
            && !joined
            && side(a, b, c) * side(a, b, d) < 0.0
            && side(c, d, a) * side(c, d, b) < 0.0
    };
    let of = |(k, e): (usize, &(&Point, &Point))| {
        edges[k + 1..].iter().filter(|f| cross(*e, **f)).count()
    };
    edges.iter().enumerate().map(of).sum()
}

/// Every point of a drawing is there again after the smallest of `turns` turns about the origin and, where it has
/// lines, mirrored: to the bit in quarter turns, else to the last digit written.
pub fn own_copies(drawing: &Drawing, turns: u32, mirrored: bool, name: &str) {
    let places: Vec<Point> = drawing.outline().points().copied().collect();
    let diagonal = drawing.outline().diagonal();
    let (sin, cos) = (std::f64::consts::TAU / f64::from(turns)).sin_cos();
    let near = |x: f64, y: f64, within: f64| {
        let away = places.iter().map(|q| (q.x - x).hypot(q.y - y));
        away.fold(f64::INFINITY, f64::min) <= within * diagonal
    };
    let digits = if turns == 4 { 1e-12 } else { 2e-5 };
    for p in &places {
        let turned = [cos * p.x - sin * p.y, sin * p.x + cos * p.y];
        assert!(near(turned[0], turned[1], digits), "{name}: {p}");
        assert!(!mirrored || near(-p.x, p.y, digits), "{name}: {p}");
    }
}
