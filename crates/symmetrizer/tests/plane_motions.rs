//! Motions of the plane: rows, glides and copies of shapes that are made here, found among others and made exact.
#![allow(clippy::print_stdout)]

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use symmetrizer::Context;
use symmetrizer::detect::{DetectParams, Detection, detect_in_plane};
use symmetrizer::drawing::{Format, Reading, decode};
use symmetrizer::geom::{Ambient, Point, Vector, exp_rotation};
use symmetrizer::optimize::Step;
use symmetrizer::optimize::orbit::Orbit;
use symmetrizer::shape::wall::Wall;
use symmetrizer::transform::{Class, Correspondence, Isometry, optimal::optimal_rigid};
use symmetrizer::{Drawing, Outcome, Params, symmetrize_drawing};

/// A roundish shape that has no symmetry, another for each seed.
fn blob(seed: u64) -> Vec<Point> {
    let mut rng = Pcg64::seed_from_u64(seed);
    let waves: Vec<[f64; 3]> = (2..7)
        .map(|m| {
            let m = f64::from(m);
            let size = 0.35 / m * rng.random_range(0.5..1.0);
            [m, size, rng.random_range(0.0..TAU)]
        })
        .collect();
    let place = |k: i32| {
        let a = f64::from(k) / 90.0 * TAU;
        let wave = |&[m, size, phase]: &[f64; 3]| size * (m * a + phase).cos();
        let r = 1.0 + waves.iter().map(wave).sum::<f64>();
        Point::new(r * a.cos(), r * a.sin(), 0.0)
    };
    (0..90).map(place).collect()
}

/// A motion of the plane; a mirror image of the shape first where `mirrored`.
fn motion(angle: f64, shift: [f64; 2], mirrored: bool) -> Isometry {
    let mut linear = exp_rotation(&(Vector::z() * angle));
    if mirrored {
        linear.set_column(0, &-linear.column(0));
    }
    Isometry {
        linear,
        translation: Vector::new(shift[0], shift[1], 0.0),
    }
}

/// A ring, moved; its shape stays to the left.
fn moved(ring: &[Point], t: &Isometry) -> Vec<Point> {
    let mut ring: Vec<Point> = ring.iter().map(|x| t.apply(x)).collect();
    if t.is_improper() {
        ring.reverse();
    }
    ring
}

/// All rings turned, scaled and moved together, each point off by `noise` at random.
fn placed(rings: &[Vec<Point>], angle: f64, scale: f64, noise: f64) -> Vec<Vec<Point>> {
    let mut rng = Pcg64::seed_from_u64(7);
    let turn = motion(angle, [40.0, -3.0], false);
    let mut place = |x: &Point| {
        let mut off = || noise * rng.random_range(-1.7..1.7);
        let x = turn.apply(&(x + Vector::new(off(), off(), 0.0)));
        Point::from(x.coords * scale)
    };
    let mut ring = |r: &Vec<Point>| r.iter().map(&mut place).collect();
    rings.iter().map(&mut ring).collect()
}

fn found(rings: &[Vec<Point>]) -> Detection {
    let wall = Wall::new(rings).expect("a wall");
    let params = DetectParams::default();
    detect_in_plane(&wall, &params, &mut Context::new(0)).expect("a detection")
}

fn row(count: u32) -> Vec<Vec<Point>> {
    let copy = |k: u32| motion(0.0, [2.9 * f64::from(k), 0.4 * f64::from(k)], false);
    (0..count).map(|k| moved(&blob(3), &copy(k))).collect()
}

/// Each copy on the other side of a line than the one before.
fn glide_row(count: u32) -> Vec<Vec<Point>> {
    let copy = |k: u32| {
        let x = 2.4 * f64::from(k);
        match k % 2 {
            0 => motion(0.0, [x, 1.6], false),
            _ => motion(std::f64::consts::PI, [x, -1.6], true),
        }
    };
    (0..count).map(|k| moved(&blob(3), &copy(k))).collect()
}

/// The motions of five copies in free positions, two of them mirrored.
fn free() -> [Isometry; 5] {
    [
        motion(0.3, [0.0, 0.0], false),
        motion(2.1, [4.0, 1.0], false),
        motion(1.0, [1.0, 4.0], true),
        motion(4.0, [5.0, 5.0], false),
        motion(5.2, [8.0, 2.0], true),
    ]
}

/// These copies among three other shapes.
fn copies_among_others() -> Vec<Vec<Point>> {
    let others = [(17, [9.0, 6.0]), (18, [-3.0, 3.0]), (19, [-3.0, -2.0])];
    let others = others.map(|(seed, at)| moved(&blob(seed), &motion(0.0, at, false)));
    let copies = free().map(|t| moved(&blob(3), &t));
    copies.into_iter().chain(others).collect()
}

/// One ring: a comb of six hooked teeth on a back that has no symmetry.
fn comb() -> Vec<Vec<Point>> {
    let tooth = [
        [0.0, 0.0],
        [0.1, 0.8],
        [0.35, 1.6],
        [0.9, 2.0],
        [1.0, 1.8],
        [0.65, 1.4],
        [0.55, 0.7],
        [0.6, 0.0],
    ];
    let teeth = (0..6).flat_map(|k| tooth.map(|[x, y]| [x + 1.4 * f64::from(k), y]));
    let back = [
        [8.4, 0.0],
        [9.0, -0.5],
        [8.6, -1.2],
        [-0.5, -1.6],
        [-0.8, -0.4],
    ];
    let mut ring: Vec<Point> = teeth
        .chain(back)
        .map(|[x, y]| Point::new(x, y, 0.0))
        .collect();
    ring.reverse();
    vec![ring]
}

/// One ring: a stem with five leaves to either side in turns.
fn stem() -> Vec<Vec<Point>> {
    let leaf = [
        [0.0, 0.15],
        [0.2, 0.9],
        [0.7, 1.7],
        [1.3, 2.1],
        [1.2, 1.4],
        [0.9, 0.7],
        [0.55, 0.15],
    ];
    let leaves = |start: f64, side: f64| {
        let all = (0..5).flat_map(|k| leaf.map(|[x, y]| (x + start + 2.0 * f64::from(k), y)));
        all.map(move |(x, y)| Point::new(x, side * y, 0.0))
            .collect::<Vec<_>>()
    };
    let mut ring = leaves(0.0, 1.0);
    ring.push(Point::new(11.2, 0.0, 0.0));
    ring.extend(leaves(1.0, -1.0).into_iter().rev());
    ring.push(Point::new(-0.6, 0.0, 0.0));
    ring.reverse();
    vec![ring]
}

#[test]
fn rows_glides_and_copies_are_found_however_a_drawing_lies() {
    for (name, rings, group) in [
        ("row", row(6), "row 6"),
        ("glide row", glide_row(6), "glide row 6"),
        ("copies", copies_among_others(), "5 copies"),
        ("comb", comb(), "row 6"),
        ("stem", stem(), "glide row"),
    ] {
        for (angle, scale, noise) in [(0.0, 1.0, 0.0), (0.7, 130.0, 0.0), (4.0, 0.01, 0.006)] {
            let found = found(&placed(&rings, angle, scale, noise));
            let named = |g: &symmetrizer::detect::Group| g.name.starts_with(group);
            let names: Vec<&String> = found.groups.iter().map(|g| &g.name).collect();
            assert!(
                found.groups.iter().any(named),
                "{name} at {angle}: {names:?}"
            );
            for s in found.symmetries.iter().filter(|s| s.class != Class::Mirror) {
                let out_of_plane = (s.q_from_p.linear[(2, 2)] - 1.0).abs();
                assert!(out_of_plane < 1e-9, "{name}: {}", s.q_from_p.linear);
                assert!(s.q_from_p.translation.z.abs() < 1e-9, "{name}");
            }
        }
    }
}

#[test]
fn shapes_that_are_not_alike_have_no_motions() {
    for start in [20, 40, 60] {
        let place = |k: u64| [3.0 * (k % 4) as f64, 3.0 * (k / 4) as f64];
        let rings: Vec<Vec<Point>> = (0..8)
            .map(|k| moved(&blob(start + k), &motion(0.0, place(k), false)))
            .collect();
        let found = found(&rings);
        let motions = found.symmetries.iter().filter(|s| s.class != Class::Mirror);
        let areas: Vec<f64> = motions.map(|s| s.area_fraction).collect();
        assert!(areas.is_empty(), "{start}: {areas:?}");
        assert!(found.groups.is_empty(), "{start}");
    }
}

/// A drawing of polygons, as an SVG file has them.
fn drawing(rings: &[Vec<Point>]) -> Drawing {
    let path = |ring: &Vec<Point>| {
        let points: Vec<String> = ring.iter().map(|x| format!("{},{}", x.x, -x.y)).collect();
        format!("M{}Z", points.join(" L"))
    };
    let paths: Vec<String> = rings.iter().map(path).collect();
    let svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-20 -20 60 60"><path d="{}"/></svg>"#,
        paths.join(" ")
    );
    decode(svg.into_bytes(), Format::Svg, &Reading::default()).expect("a drawing")
}

/// The place of a closed ring that is nearest to a point.
fn nearest(x: &Point, ring: &[Point]) -> Point {
    let next = ring.iter().cycle().skip(1);
    let on_edge = |(a, b): (&Point, &Point)| {
        let way = b - a;
        let t = (x - a).dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE);
        a + way * t.clamp(0.0, 1.0)
    };
    let away = |y: &Point| (y - x).norm();
    let places = ring.iter().zip(next).map(on_edge);
    places
        .min_by(|a, b| away(a).total_cmp(&away(b)))
        .expect("a ring")
}

/// The rms distance between the ring `from`, carried by about `t` to where it is nearest to the ring `to`, and that.
fn apart(from: &[Point], to: &[Point], t: &Isometry) -> f64 {
    let mut carried: Vec<Point> = from.iter().map(|x| t.apply(x)).collect();
    let mut rms = f64::INFINITY;
    for _ in 0..30 {
        let pair = |x: &Point| Correspondence {
            p: *x,
            q: nearest(x, to),
            weight: 1.0,
        };
        let pairs: Vec<Correspondence> = carried.iter().map(pair).collect();
        let squares = pairs.iter().map(|c| (c.p - c.q).norm_squared());
        rms = (squares.sum::<f64>() / pairs.len() as f64).sqrt();
        let fit = optimal_rigid(&pairs, None, Ambient::Plane).expect("a fit");
        carried = carried.iter().map(|x| fit.isometry.apply(x)).collect();
    }
    rms
}

/// The ring of a drawing whose middle is nearest to where a motion carries the origin.
fn ring_at<'a>(drawing: &'a Drawing, t: &Isometry) -> &'a [Point] {
    let away = |ring: &[Point]| {
        let middle = ring.iter().map(|x| x.coords).sum::<Vector>() / ring.len() as f64;
        (middle - t.translation).norm()
    };
    let rings = drawing.outline().rings.iter().map(|r| &r.points[..]);
    rings
        .min_by(|a, b| away(a).total_cmp(&away(b)))
        .expect("a ring")
}

/// The largest distance between the first and another of the copies that `motions` made, and the mean distance of all from the
/// shape that they were before noise.
fn figures(drawing: &Drawing, motions: &[Isometry]) -> [f64; 2] {
    let first = ring_at(drawing, &motions[0]);
    let back = motions[0].inverse();
    let others = motions.iter().skip(1);
    let between = others.map(|t| apart(first, ring_at(drawing, t), &t.after(&back)));
    let clean = blob(3);
    let from_clean = motions
        .iter()
        .map(|t| apart(&clean, ring_at(drawing, t), t));
    let mean = from_clean.sum::<f64>() / motions.len() as f64;
    [between.fold(0.0, f64::max), mean]
}

#[test]
fn copies_in_rows_and_anywhere_become_alike_and_stay_where_they_are() {
    let shift = |k: u32| motion(0.0, [2.9 * f64::from(k), 0.4 * f64::from(k)], false);
    for (name, rings, motions) in [
        ("row 6", row(6), (0..6).map(shift).collect::<Vec<_>>()),
        ("5 copies", copies_among_others(), free().to_vec()),
    ] {
        let place = motion(0.4, [40.0, -3.0], false);
        let motions: Vec<Isometry> = motions.iter().map(|t| place.after(t)).collect();
        let noisy = drawing(&placed(&rings, 0.4, 1.0, 0.012));
        let before = figures(&noisy, &motions);
        let made = symmetrize_drawing(&noisy, &Params::default(), &mut Context::new(0));
        let made = made.expect("a run");
        assert_eq!(made.job.outcome, Outcome::Converged, "{name}");
        let orbits = |s: &Step| matches!(s, Step::Orbits { .. });
        assert!(made.job.report.steps.iter().any(orbits), "{name}");
        let kind = |orbit: &Orbit| matches!(orbit, Orbit::Regular(_) | Orbit::Free(_));
        let goals = &made.job.goals;
        assert!(
            goals.iter().any(|g| g.name == name && kind(&g.orbit)),
            "{name}"
        );
        let after = figures(&made.drawing, &motions);
        println!("{name}: copies apart, and from clean: {before:.5?} -> {after:.5?}");
        assert!(
            after[0] < before[0] / 8.0,
            "{name}: {before:?} -> {after:?}"
        );
        assert!(
            after[1] < 0.85 * before[1],
            "{name}: {before:?} -> {after:?}"
        );
        for t in &motions {
            let [was, is] = [&noisy, &made.drawing].map(|d| ring_at(d, t));
            let moved = was.iter().map(|x| (nearest(x, is) - x).norm());
            let farthest = moved.fold(0.0, f64::max);
            assert!(farthest < 0.1, "{name}: moved by {farthest}");
        }
        assert!(
            made.exact().is_err(),
            "rows and copies are not written exactly"
        );
    }
}
