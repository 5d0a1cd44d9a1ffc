//! Shapes of the plane: the mirror lines of outlines that are known to have them.
#![allow(clippy::print_stdout)]
mod common;

use common::model;
use symmetrizer::Context;
use symmetrizer::Drawn;
use symmetrizer::deform::{Deformer, Igarashi, Pull, Stiffness};
use symmetrizer::detect::{DetectParams, Detection, detect_in_plane};
use symmetrizer::drawing::{Format, Reading, decode, read};
use symmetrizer::field::trust::Verdict;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::optimize::Step;
use symmetrizer::shape::wall::Wall;
use symmetrizer::straighten::When;
use symmetrizer::transform::{Isometry, Plane, displacements};
use symmetrizer::{Drawing, Outcome, Params, symmetrize_drawing, symmetrize_drawing_with};

/// The outline of a drawing, turned, scaled and moved, as a wall.
fn wall(name: &str, angle: f64, scale: f64) -> Option<Wall> {
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

fn found(wall: &Wall) -> Detection {
    let params = DetectParams::default();
    detect_in_plane(wall, &params, &mut Context::new(0)).expect("a detection")
}

/// The lines that hold for nearly all of an outline, and their largest rms, fraction of L.
fn whole(found: &Detection) -> (usize, f64) {
    let mirrors = found.symmetries.iter().filter(|s| s.q_from_p.is_improper());
    let all = mirrors.filter(|s| s.area_fraction > 0.9);
    all.fold((0, 0.0), |(n, rms), s| (n + 1, f64::max(rms, s.rms)))
}

#[test]
fn drawings_have_the_lines_that_they_have() {
    // Of many lines some are told by fewer votes than the others leave over; the group has them all.
    for (name, lines, group) in [
        ("truth/gecko_straight.svg", 1..=1, ""),
        ("2d/snowflake_fa.svg", 3..=6, "D6"),
        ("2d/fan_fa.svg", 0..=0, "C4"),
        ("2d/cog_gi.svg", 4..=8, "D8"),
    ] {
        for (angle, scale) in [(0.0, 1.0), (0.7, 13.0), (2.0, 0.01)] {
            let Some(wall) = wall(name, angle, scale) else {
                return;
            };
            let found = found(&wall);
            let mirrors = found.symmetries.iter().filter(|s| s.q_from_p.is_improper());
            for s in mirrors {
                let normal = s.plane().normal;
                assert!(normal.z.abs() < 1e-6, "{name}: {normal}");
            }
            let (count, rms) = whole(&found);
            println!("{name} turned by {angle}: {count} lines, rms {rms:.5} L");
            assert!(lines.contains(&count), "{name}: {count} lines");
            // Copies of toes and the like have no axis.
            let mut turns = found.groups.iter().filter(|g| g.axis.is_some());
            let named = turns.next().map_or("", |g| g.name.as_str());
            assert_eq!(named, group, "{name}");
            assert!(rms < 0.0015, "{name}: {rms}");
        }
    }
}

#[derive(serde::Deserialize)]
struct Truth {
    placement: Placement,
}

/// Of the rest shape, whose line is x = 0, in the file: y = matrix x + offset, y downwards.
#[derive(serde::Deserialize)]
struct Placement {
    matrix: [[f64; 2]; 2],
    offset: [f64; 2],
}

#[test]
fn the_straight_gecko_has_its_line_where_it_is_known_to_be() {
    let Some(path) = model("truth/gecko_straight.truth.json") else {
        return;
    };
    let text = std::fs::read_to_string(path).expect("a file");
    let Truth { placement } = serde_json::from_str(&text).expect("a truth");
    let wall = wall("truth/gecko_straight.svg", 0.0, 1.0).expect("a wall");
    let found = found(&wall);
    let plane = found.symmetries[0].plane();
    let known = Vector::new(placement.matrix[0][0], -placement.matrix[1][0], 0.0).normalize();
    let angle = plane.normal.cross(&known).norm().asin().to_degrees();
    let on = Point::new(placement.offset[0] + 7.0, -placement.offset[1] - 3.0, 0.0);
    let on = wall.normalization.to_working(&on);
    let away = (plane.normal.dot(&on.coords) - plane.offset).abs();
    println!("{angle:.4} degrees, {away:.6} L");
    assert!(angle < 0.1, "{angle} degrees");
    assert!(away < 0.001, "{away} L");
}

fn drawing(name: &str) -> Option<Drawing> {
    Some(read(&model(name)?, &Reading::default()).expect("a drawing"))
}

fn symmetrized(drawing: &Drawing) -> Drawn {
    symmetrize_drawing(drawing, &Params::default(), &mut Context::new(0)).expect("a run")
}

/// The corners of a file's path, where they are, by their number.
fn corners(drawing: &Drawing, count: usize) -> Vec<Option<Point>> {
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
struct Rests {
    rings: Vec<Rest>,
}

#[derive(serde::Deserialize)]
struct Rest {
    rest: Vec<[f64; 2]>,
}

fn rest(name: &str) -> Vec<Point> {
    let path = model(&format!("truth/{name}.truth.json")).expect("a truth");
    let text = std::fs::read_to_string(path).expect("a file");
    let truth: Rests = serde_json::from_str(&text).expect("a truth");
    let all = truth.rings.iter().flat_map(|r| &r.rest);
    all.map(|[x, y]| Point::new(*x, *y, 0.0)).collect()
}

/// rms distance from the rest after the best similarity, mirrored or not, % of D.
fn missed(drawing: &Drawing, rest: &[Point]) -> f64 {
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

#[test]
fn bent_drawings_come_out_straight_and_symmetric() {
    for (name, most) in [
        ("gecko_straight", 0.05),
        ("gecko_bent", 0.25),
        ("gecko_sbend_walk", 0.4),
        ("beetle11_sym_bent", 0.45),
        ("face1_sym_bent", 0.45),
        ("butterfly11_sym_bent", 2.4),
    ] {
        let Some(drawing) = drawing(&format!("truth/{name}.svg")) else {
            return;
        };
        let rest = rest(name);
        let done = symmetrized(&drawing);
        let result = done.job.report.result.as_ref().expect("a result");
        let rms = missed(&done.drawing, &rest);
        println!(
            "{name}: rms to the rest {rms:.3} % of D, asymmetry {:.3} %, {} crossings, area {:.3}",
            result.asymmetry.mean, result.distortion.new_crossings, result.distortion.area_ratio
        );
        assert!(rms <= most, "{name}: {rms}");
        assert!(result.asymmetry.mean <= 0.15, "{name}");
        assert_eq!(result.distortion.new_crossings, 0, "{name}");
        assert_eq!(crossings(&done.drawing), 0, "{name}");
        assert!((result.distortion.area_ratio - 1.0).abs() < 0.03, "{name}");
        assert!(result.distortion.inverted_faces <= 4, "{name}");
    }
}

/// The number of pairs of edges of a drawing's outline that cross and have no end in common.
fn crossings(drawing: &Drawing) -> usize {
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

#[test]
fn no_outline_comes_to_cross_itself() {
    for (name, asked) in [
        ("2d/gecko_gi.svg", false),
        ("2d/bat_fold.traced.svg", false),
        ("2d/maple_leaf_gi.svg", false),
        ("2d/gecko_photo.traced.svg", true),
        ("2d/turtle_tilt.traced.svg", true),
    ] {
        let Some(drawing) = drawing(name) else {
            return;
        };
        let mut params = Params::default();
        if asked {
            params.straighten.when = When::Uncertain;
        }
        let done = symmetrize_drawing(&drawing, &params, &mut Context::new(0)).expect("a run");
        let result = done.job.report.result.as_ref().expect("a result");
        let (was, now) = (crossings(&drawing), crossings(&done.drawing));
        println!(
            "{name}: asymmetry {:.3} %, {was} and {now} crossings",
            result.asymmetry.mean
        );
        assert_eq!(result.distortion.new_crossings, 0, "{name}");
        assert!(now <= was, "{name}: {now}");
        assert!(result.asymmetry.mean < 0.15, "{name}");
    }
}

#[test]
fn what_would_cross_itself_is_left_or_flagged() {
    let Some(drawing) = drawing("2d/oak_leaf_gi.svg") else {
        return;
    };
    let done = symmetrized(&drawing);
    assert_eq!(done.job.outcome, Outcome::NoSymmetry);
    let mut params = Params::default();
    params.straighten.when = When::Uncertain;
    let mut ctx = Context::new(0);
    let done = symmetrize_drawing(&drawing, &params, &mut ctx).expect("a run");
    let result = done.job.report.result.as_ref().expect("a result");
    let said = ctx
        .warnings()
        .iter()
        .any(|w| w.0.contains("crosses itself"));
    assert_eq!(said, result.distortion.new_crossings > 0);
}

/// A gear of so many teeth, each of them a little different, around a hole that has no symmetry.
fn gear(teeth: u32) -> String {
    let points = teeth * 40;
    let rim = (0..points).map(|k| {
        let angle = f64::from(k) / f64::from(points) * std::f64::consts::TAU;
        let wave = (f64::from(teeth) * angle).cos();
        let uneven = 0.25 * (3.0 * angle + 1.0).sin() * (7.0 * angle).cos();
        let r = 100.0 + 6.0 * wave + uneven;
        format!("{:.4},{:.4}", r * angle.cos(), r * angle.sin())
    });
    let rim: Vec<String> = rim.collect();
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg'><path fill-rule='evenodd' d='M{}Z \
         M-50,-50 L-20,-50 L-20,30 L45,40 L40,60 L-50,55 Z'/></svg>",
        rim.join(" L")
    )
}

#[test]
fn a_ring_turns_by_itself() {
    for teeth in [17, 33] {
        let drawing = decode(gear(teeth).into_bytes(), Format::Svg, &Reading::default());
        let drawing = drawing.expect("a drawing");
        let done = symmetrized(&drawing);
        let [Step::Orbits { goals, .. }] = done.job.report.steps.as_slice() else {
            panic!("{:?}", done.job.report.steps);
        };
        let [goal] = goals.as_slice() else {
            panic!("{goals:?}");
        };
        println!("{}: {:?}", goal.name, goal.residual);
        assert_eq!(goal.name, format!("D{teeth}"));
        assert!(goal.residual[1] <= 2e-4 && goal.residual[1] < 0.2 * goal.residual[0]);
        let hole = |d: &Drawing| {
            let holes = d.outline().rings.iter().filter(|r| r.area() < 0.0);
            holes.flat_map(|r| r.points.clone()).collect::<Vec<_>>()
        };
        let (was, now) = (hole(&drawing), hole(&done.drawing));
        assert_eq!(was.len(), now.len());
        let moved = was.iter().zip(&now).map(|(a, b)| (b - a).norm());
        assert!(moved.fold(0.0, f64::max) < 1e-9);
        assert!(done.exact().is_err(), "of a part there is no exact drawing");
    }
}

#[test]
fn the_rim_of_a_gear_around_a_letter_turns() {
    let Some(drawing) = drawing("2d/rust_si.svg") else {
        return;
    };
    let done = symmetrized(&drawing);
    let [Step::Orbits { goals, .. }] = done.job.report.steps.as_slice() else {
        panic!("{:?}", done.job.report.steps);
    };
    assert_eq!(goals[0].name, "D32");
    assert!(goals[0].residual[1] <= 2e-4, "{:?}", goals[0].residual);
}

#[test]
fn stiff_places_keep_their_form() {
    // An ellipse with a bump on its right side: soft on the one side, stiff on the other.
    let point = |k: u32| {
        let angle = f64::from(k) / 400.0 * std::f64::consts::TAU;
        let bump = 12.0 * (-((angle - 0.4) / 0.12).powi(2)).exp();
        let (sin, cos) = angle.sin_cos();
        Point::new(
            (60.0 + bump) * cos,
            (100.0 + bump) * sin + 9.0 * (2.0 * angle).cos(),
            0.0,
        )
    };
    let ring: Vec<String> = (0..400)
        .map(point)
        .map(|x| format!("[{},{}]", x.x, x.y))
        .collect();
    let text = format!("{{\"rings\": [[{}]]}}", ring.join(","));
    let drawing = decode(text.into_bytes(), Format::Json, &Reading::default()).expect("rings");
    let moved = |stiffness: &Stiffness| {
        let (params, mut ctx) = (Params::default(), Context::new(0));
        let done = symmetrize_drawing_with(&drawing, stiffness, &params, &mut ctx).expect("a run");
        done.drawing
    };
    let even = moved(&Stiffness::Uniform(1.0)).outline().clone();
    let plain = symmetrized(&drawing).drawing;
    assert_eq!(even, *plain.outline(), "1 is the usual");
    let places = |left, right| Stiffness::Places(vec![([-60.0, 0.0], left), ([60.0, 0.0], right)]);
    let all = |k: f64| Stiffness::Vertices(vec![k; 400]);
    assert_eq!(*moved(&places(1.0, 1.0)).outline(), even);
    assert_eq!(*moved(&all(1.0)).outline(), even);
    let uneven = moved(&places(0.05, 20.0));
    assert_ne!(*uneven.outline(), even);
    for bad in [
        Stiffness::Vertices(vec![1.0; 3]),
        Stiffness::Polygons(vec![1.0]),
        Stiffness::Paths(vec![1.0]),
        places(0.0, 1.0),
        Stiffness::Uniform(f64::NAN),
    ] {
        let (params, mut ctx) = (Params::default(), Context::new(0));
        let refused = symmetrize_drawing_with(&drawing, &bad, &params, &mut ctx);
        assert!(refused.is_err(), "{bad:?}");
    }
}

#[test]
fn an_outline_in_thousands_of_parts_comes_to_an_end() {
    let part = |k: u32| {
        let (x, y) = (f64::from(k % 60) * 10.0, f64::from(k / 60) * 11.0);
        let size = 3.0 + f64::from(k * k % 7);
        format!("M{x} {y}l{size} 0l-{size} {size}z")
    };
    let parts: String = (0..3000).map(part).collect();
    let text = format!("<svg xmlns='http://www.w3.org/2000/svg'><path d='{parts}'/></svg>");
    let drawing = decode(text.into_bytes(), Format::Svg, &Reading::default()).expect("a drawing");
    let done = symmetrized(&drawing);
    let wall = done.job.before.wall.expect("a wall");
    assert!(wall.rings.len() <= 500, "{}", wall.rings.len());
}

/// A strip with spines of several lengths to both sides, about the line x = 0.
fn comb() -> Vec<Point> {
    let spines = [
        (0.1, 0.09),
        (0.22, 0.04),
        (0.4, 0.12),
        (0.55, 0.06),
        (0.8, 0.03),
    ];
    let side = (0..=400).map(|k| {
        let y = f64::from(k) / 400.0;
        let spine = |&(at, long): &(f64, f64)| long * (-((y - at) / 0.012).powi(2)).exp();
        let ends = (y * (1.0 - y)).sqrt().min(0.25) / 0.25;
        Point::new(0.05 * ends + spines.iter().map(spine).sum::<f64>(), y, 0.0)
    });
    let right: Vec<Point> = side.collect();
    let left = right[1..400].iter().rev();
    let left: Vec<Point> = left.map(|x| Point::new(-x.x, x.y, 0.0)).collect();
    [right, left].concat()
}

#[test]
fn more_than_half_a_turn_is_undone() {
    let rest = comb();
    let turn = 250.0_f64.to_radians();
    let bent = rest.iter().map(|x| {
        let (sin, cos) = (turn * x.y).sin_cos();
        format!(
            "{},{}",
            500.0 * ((1.0 - cos) / turn + x.x * cos),
            500.0 * (sin / turn - x.x * sin)
        )
    });
    let points = bent.collect::<Vec<_>>().join(" ");
    let text =
        format!("<svg xmlns='http://www.w3.org/2000/svg'><polygon points='{points}'/></svg>");
    let drawing = decode(text.into_bytes(), Format::Svg, &Reading::default()).expect("a drawing");
    let done = symmetrized(&drawing);
    let bend = done.job.report.bend.as_ref().expect("a bend");
    let rms = missed(&done.drawing, &rest);
    println!(
        "score {:.2}, rival {:?}, rms {rms:.3} % of D",
        bend.score, bend.rival
    );
    assert_eq!(bend.verdict, Verdict::Accept);
    assert!(rms < 0.8, "{rms}");
}

#[test]
fn what_has_no_line_is_left() {
    for name in [
        "2d/hand_fa.svg",
        "2d/sea_snake.traced.svg",
        "2d/spring.traced.svg",
        "2d/lizard_curl.traced.svg",
    ] {
        let Some(drawing) = drawing(name) else {
            return;
        };
        let done = symmetrized(&drawing);
        let bend = done
            .job
            .report
            .bend
            .as_ref()
            .expect("a bend that was looked at");
        println!(
            "{name}: score {:.2}, rival {:.2}",
            bend.score,
            bend.rival.unwrap_or(1.0)
        );
        assert_ne!(bend.verdict, Verdict::Accept, "{name}");
        // The fingers of the drawn hand are copies of each other, and exact ones.
        if name == "2d/hand_fa.svg" {
            let orbits = |s: &Step| matches!(s, Step::Orbits { .. });
            assert!(done.job.report.steps.iter().all(orbits), "{name}");
            let result = done.job.report.result.as_ref();
            let moved = result.map_or(0.0, |r| r.distortion.rms);
            assert!(moved < 0.01, "{name}: moved by {moved} % of D");
            continue;
        }
        assert_eq!(done.job.outcome, Outcome::NoSymmetry, "{name}");
        assert_eq!(done.drawing.svg(), drawing.svg(), "{name}");
    }
}

#[test]
fn turns_are_found_and_made_exact() {
    for (name, group, lines) in [("2d/fan_fa.svg", "C4", 0), ("2d/snowflake_fa.svg", "D6", 1)] {
        let Some(drawing) = drawing(name) else {
            return;
        };
        let done = symmetrized(&drawing);
        let [Step::Orbits { goals, .. }] = done.job.report.steps.as_slice() else {
            panic!("{name}: {:?}", done.job.report.steps);
        };
        let [goal] = goals.as_slice() else {
            panic!("{name}: {goals:?}");
        };
        assert_eq!(goal.name, group, "{name}");
        assert!(goal.residual[1] <= 2e-4, "{name}: {:?}", goal.residual);
        let all = done.job.before.symmetries().iter();
        let mirrors = all.filter(|s| s.q_from_p.is_improper()).count();
        assert!((mirrors > 0) == (lines > 0), "{name}: {mirrors} lines");
        let exact = done.exact().expect(name);
        own_copies(&exact, if lines > 0 { 6 } else { 4 }, lines > 0, name);
        assert_eq!(
            exact.outline().rings.len(),
            drawing.outline().rings.len(),
            "{name}"
        );
        let lost = (exact.outline().area() / drawing.outline().area() - 1.0).abs();
        assert!(lost < 0.01, "{name}: {lost}");
    }
}

/// Every point of a drawing is there again after the smallest of `turns` turns about the origin and, where it has
/// lines, mirrored: to the bit in quarter turns, else to the last digit written.
fn own_copies(drawing: &Drawing, turns: u32, mirrored: bool, name: &str) {
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

#[test]
fn exact_outlines_are_their_own_mirror_images() {
    let Some(drawing) = drawing("truth/gecko_bent.svg") else {
        return;
    };
    let exact = symmetrized(&drawing).exact().expect("a line");
    assert_eq!(exact.outline().rings.len(), 1);
    let mut places: Vec<[f64; 2]> = exact.outline().points().map(|p| [p.x, p.y]).collect();
    places.sort_by(|a, b| {
        a[0].abs()
            .total_cmp(&b[0].abs())
            .then(a[1].total_cmp(&b[1]))
    });
    // Flattened curves: the same points on both sides but for the last bits.
    let mut alone = 0;
    for p in &places {
        let near = |q: &&[f64; 2]| (q[0] + p[0]).abs() < 1e-9 && (q[1] - p[1]).abs() < 1e-9;
        alone += usize::from(!places.iter().any(|q| near(&q)));
    }
    assert_eq!(alone, 0, "of {}", places.len());
    let lost = (exact.outline().area() / drawing.outline().area() - 1.0).abs();
    assert!(lost < 0.03, "{lost}");
}

#[test]
fn the_same_bytes_come_with_any_number_of_threads() {
    let Some(drawing) = drawing("truth/beetle11_sym_bent.svg") else {
        return;
    };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
            .install(|| symmetrized(&drawing).drawing.svg())
    };
    assert_eq!(with(1), with(3));
}

/// Figure 6: two points of transformation space are pulled to their centroid, and the shape follows.
#[test]
fn two_points_of_transformation_space_meet() {
    let Some(wall) = wall("truth/gecko_bent.svg", 0.0, 1.0) else {
        return;
    };
    let mut body = Igarashi::new(wall.clone()).expect("an inside");
    let mut ctx = Context::new(0);
    // Two pairs of places that lie opposite each other across two lines.
    let length = wall.length(0);
    let at = |share: f64| wall.at(0, share * length);
    let pairs = [[at(0.10), at(0.62)], [at(0.30), at(0.52)]];
    let line =
        |x: &[Point]| Plane::through(&nalgebra::center(&x[0], &x[1]), (x[0] - x[1]).normalize());
    let ends = |body: &Igarashi| pairs.map(|pair| body.places(&pair));
    let lines = |body: &Igarashi| ends(body).map(|x| line(&x));
    let apart = |[a, b]: [Plane; 2]| a.normal.cross(&b.normal).norm().asin().to_degrees();
    let before = apart(lines(&body));
    for _ in 0..40 {
        let [a, b] = lines(&body);
        let normal = a.normal + b.normal * a.normal.dot(&b.normal).signum();
        let offset = a.offset + b.offset * a.normal.dot(&b.normal).signum();
        let common = Plane {
            normal: normal.normalize(),
            offset: offset / normal.norm(),
        };
        let mirror = Isometry::mirror(&common);
        let pulls: Vec<Pull> = pairs
            .iter()
            .zip(ends(&body))
            .flat_map(|(pair, x)| {
                let (d_p, d_q) = displacements(&x[0], &x[1], &mirror);
                let pull = |k: usize, d: Vector| Pull {
                    at: pair[k],
                    target: x[k] + d,
                    weight: 100.0,
                };
                [pull(0, d_p), pull(1, d_q)]
            })
            .collect();
        body.deform(&pulls, &mut ctx).expect("a step");
    }
    let after = apart(lines(&body));
    println!(
        "the lines are {before:.2} degrees apart, then {after:.3}; energy {:.5}",
        body.energy()
    );
    assert!(before > 5.0 && after < 0.05 * before, "{before} {after}");
    let inside = body.sheet().surface.with_positions(body.inside().to_vec());
    assert!(inside.face_normals.iter().all(|n| n.z > 0.0));
    assert!((inside.area() / body.sheet().surface.area() - 1.0).abs() < 0.05);
}

#[test]
fn the_plane_moves_as_one_with_three_points_of_it() {
    let Some(wall) = wall("truth/gecko_straight.svg", 0.3, 1.0) else {
        return;
    };
    let mut body = Igarashi::new(wall.clone()).expect("an inside");
    let turn = nalgebra::Rotation3::from_axis_angle(&Vector::z_axis(), 2.5);
    let shift = Vector::new(0.3, -0.8, 0.0);
    let pulls: Vec<Pull> = (0..3)
        .map(|k| {
            let at = wall.at(0, f64::from(k) * wall.length(0) / 3.0);
            Pull {
                at,
                target: turn * wall.surface.point(&at) + shift,
                weight: 1.0,
            }
        })
        .collect();
    body.deform(&pulls, &mut Context::new(0)).expect("a step");
    let rest = &body.sheet().surface.positions;
    let off = rest
        .iter()
        .zip(body.inside())
        .map(|(x, y)| (turn * x + shift - y).norm());
    let off = off.fold(0.0, f64::max);
    assert!(off < 1e-4, "{off}");
    assert!(body.energy() < 1e-8, "{}", body.energy());
}

#[test]
fn a_prescribed_rotation_is_where_a_deformation_begins() {
    let Some(wall) = wall("truth/gecko_straight.svg", 0.3, 1.0) else {
        return;
    };
    let mut body = Igarashi::new(wall).expect("an inside");
    let count = body.sheet().surface.triangles.len();
    body.start_from(&vec![0.7; count]).expect("rotations");
    assert!(body.energy() < 1e-9, "{}", body.energy());
    assert!(body.start_from(&[0.0]).is_err());
    assert!(body.set_stiffness_inside(&vec![0.0; count]).is_err());
}

#[test]
fn a_pose_is_kept_on_request() {
    let Some(drawing) = drawing("truth/gecko_bent.svg") else {
        return;
    };
    let mut params = Params::default();
    params.straighten.share = 0.0;
    let done = symmetrize_drawing(&drawing, &params, &mut Context::new(0)).expect("a run");
    let report = &done.job.report;
    let kept = report.bend.as_ref().and_then(|b| b.kept.as_ref());
    let kept = kept.expect("a pose that was kept");
    println!("across {:.4} % of D, line {:.3} %", kept.across, kept.line);
    assert!(kept.across <= 0.1 && kept.line <= 0.3);
    let result = report.result.as_ref().expect("a result");
    assert!(result.distortion.rms < 2.0, "{}", result.distortion.rms);
    // Stopped early, a run keeps what it reached.
    let mut params = Params::default();
    params.optimize.max_deformation = Some(5e-4);
    let done = symmetrize_drawing(&drawing, &params, &mut Context::new(0)).expect("a run");
    assert!(done.job.report.result.is_some());
}
