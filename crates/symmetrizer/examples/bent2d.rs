use std::time::Instant;
use symmetrizer::Context;
use symmetrizer::detect::{DetectParams, detect_in_plane};
use symmetrizer::drawing::{Reading, read};
use symmetrizer::field::Reach;
use symmetrizer::field::grow::Land;
use symmetrizer::geom::Point;
use symmetrizer::shape::ClosestPoint;
use symmetrizer::shape::wall::Wall;
use symmetrizer::straighten::{Bend, straighten};

fn main() {
    for path in std::env::args().skip(1) {
        if let Err(e) = one(&path) {
            println!("{path}: {e}");
        }
    }
}
fn one(path: &str) -> symmetrizer::Result<()> {
    let count: usize = std::env::var("COUNT")
        .ok()
        .map_or(600, |c| c.parse().unwrap());
    let t = Instant::now();
    let drawing = read(std::path::Path::new(path), &Reading::default())?;
    let rings: Vec<Vec<Point>> = drawing
        .outline()
        .rings
        .iter()
        .map(|r| r.points.clone())
        .collect();
    let wall = Wall::new(&rings)?;
    let t1 = t.elapsed().as_secs_f64();
    let mut params = DetectParams::default().mirrors_only();
    params.sample.outline = count;
    let mut ctx = Context::new(0);
    let found = detect_in_plane(&wall, &params, &mut ctx)?;
    if std::env::var("REF").is_ok() {
        println!(
            "votes {} symmetries {:?}",
            found.clouds[0].pairs.len(),
            found
                .symmetries
                .iter()
                .map(|s| (s.height, s.area_fraction, s.rms))
                .collect::<Vec<_>>()
        );
        for r in found.refused.iter().take(12) {
            println!("  {r:?}");
        }
    }
    let t2 = t.elapsed().as_secs_f64();
    let closest = ClosestPoint::new(&wall.surface);
    let samples = &found.samples;
    let reach = Reach::inside(&wall, samples, 0.12)?;
    let land = Land::new(&wall.surface, &closest, samples, &reach).with_wall(Some(&wall));
    let mirrors: Vec<_> = found.symmetries.iter().map(|s| s.q_from_p).collect();
    let best = found.symmetries.first().map_or(0.0, |s| s.area_fraction);
    let Some(bend) = Bend::find(&land, &mirrors, &mut ctx)? else {
        println!(
            "{path}: {} edges {} samples, {} mirrors (first {best:.2}), no bend",
            wall.edges(),
            samples.list.len(),
            mirrors.len()
        );
        return Ok(());
    };
    let t3 = t.elapsed().as_secs_f64();
    if std::env::var("TURNS").is_ok() {
        for (k, t) in bend.turns.iter().enumerate().step_by(6) {
            let x = samples.list[k].position;
            let q = bend.field.partners[k];
            let m = bend.field.maps[k].map(|m| {
                (m.linear[(0, 1)] + m.linear[(1, 0)])
                    .atan2(m.linear[(0, 0)] - m.linear[(1, 1)])
                    .to_degrees()
            });
            println!(
                "{k} ({:.3} {:.3}) turn {:.2} map {:?} partner {:?}",
                x.x,
                x.y,
                t[(1, 0)].atan2(t[(0, 0)]).to_degrees(),
                m,
                q.map(|q| (q.sample, q.residual))
            );
        }
    }
    let straight = straighten(&land, &bend)?;
    let t4 = t.elapsed().as_secs_f64();
    // rms
    let mut text = String::new();
    if let Ok(truth) = std::fs::read_to_string(path.replace(".svg", ".truth.json")) {
        let v: serde_json::Value = serde_json::from_str(&truth).unwrap();
        let mut rest: Vec<Point> = vec![];
        for r in v["rings"].as_array().unwrap() {
            for p in r["rest"].as_array().unwrap() {
                rest.push(Point::new(
                    p[0].as_f64().unwrap(),
                    p[1].as_f64().unwrap(),
                    0.0,
                ));
            }
        }
        let offsets: Vec<usize> = v["rings"]
            .as_array()
            .unwrap()
            .iter()
            .scan(0, |s, r| {
                let o = *s;
                *s += r["rest"].as_array().unwrap().len();
                Some(o)
            })
            .collect();
        let _ = offsets;
        let (mut a, mut b0, mut b1) = (vec![], vec![], vec![]);
        for ring in &drawing.outline().rings {
            for (p, s) in ring.points.iter().zip(&ring.sources) {
                let Some(s) = s else { continue };
                let w = wall.normalization.to_working(p);
                let hit = closest.nearest(&w, 1.0).unwrap();
                let now = wall
                    .surface
                    .with_positions(straight.positions.clone())
                    .point(&hit.at);
                if (s.segment as usize) < rest.len() {
                    a.push(rest[s.segment as usize]);
                    b0.push(w);
                    b1.push(now);
                }
            }
            break;
        }
        // pairs: partner truth in file coordinates, per polygon point
        let svgp: Vec<(usize, Point)> = drawing
            .outline()
            .rings
            .iter()
            .flat_map(|r| {
                r.points.iter().zip(&r.sources).filter_map(|(p, s)| {
                    s.map(|s| (s.segment as usize, wall.normalization.to_working(p)))
                })
            })
            .collect();
        let mut partner = vec![];
        for r in v["rings"].as_array().unwrap() {
            for p in r["partner"].as_array().unwrap() {
                partner.push(Point::new(
                    p[0].as_f64().unwrap_or(f64::NAN),
                    -p[1].as_f64().unwrap_or(f64::NAN),
                    0.0,
                ));
            }
        }
        let d = drawing.outline().diagonal() / wall.normalization.scale;
        let mut errs: Vec<f64> = vec![];
        for (s, q) in samples.list.iter().zip(&bend.settled.partners) {
            // nearest polygon point
            let (k, x) = svgp
                .iter()
                .min_by(|a, b| {
                    (a.1 - s.position)
                        .norm()
                        .total_cmp(&(b.1 - s.position).norm())
                })
                .unwrap();
            if (x - s.position).norm() > 0.003 || *k >= partner.len() {
                continue;
            }
            let want = wall.normalization.to_working(&partner[*k]);
            errs.push(q.map_or(9.0, |q| (q.position - want).norm() / d));
        }
        errs.sort_by(f64::total_cmp);
        let share = |t: f64| errs.iter().filter(|e| **e < t).count() as f64 / errs.len() as f64;
        println!(
            "pairs median {:.5} <.5% {:.3} <1% {:.3} <2% {:.3}",
            errs[errs.len() / 2],
            share(0.005),
            share(0.01),
            share(0.02)
        );
        {
            // overlay
            let n = a.len() as f64;
            let ca = a
                .iter()
                .map(|p| p.coords)
                .sum::<symmetrizer::geom::Vector>()
                / n;
            let cb = b1
                .iter()
                .map(|p| p.coords)
                .sum::<symmetrizer::geom::Vector>()
                / n;
            let mut best = (f64::INFINITY, vec![]);
            for flip in [1.0, -1.0] {
                let (mut re, mut im, mut bb) = (0.0, 0.0, 0.0);
                for (p, q) in a.iter().zip(&b1) {
                    let (p, q) = (p - ca, q - cb);
                    let qy = flip * q.y;
                    re += p.x * q.x + p.y * qy;
                    im += p.y * q.x - p.x * qy;
                    bb += q.x * q.x + qy * qy;
                }
                let (c, s) = (re / bb, im / bb);
                let pts: Vec<Point> = b1
                    .iter()
                    .map(|q| {
                        let q = q - cb;
                        let qy = flip * q.y;
                        Point::new(c * q.x - s * qy, s * q.x + c * qy, 0.0) + ca
                    })
                    .collect();
                let e: f64 = pts
                    .iter()
                    .zip(&a)
                    .map(|(x, y)| (x - y).norm_squared())
                    .sum();
                if e < best.0 {
                    best = (e, pts);
                }
            }
            let poly = |pts: &[Point], color: &str| {
                format!(
                    "<polygon points='{}' fill='none' stroke='{color}' stroke-width='.002'/>",
                    pts.iter()
                        .map(|p| format!("{:.4},{:.4}", p.x, p.y))
                        .collect::<Vec<_>>()
                        .join(" ")
                )
            };
            let lo = a.iter().fold(a[0], |m, p| m.inf(p));
            let hi = a.iter().fold(a[0], |m, p| m.sup(p));
            let svg = format!(
                "<svg xmlns='http://www.w3.org/2000/svg' viewBox='{} {} {} {}'><rect x='-5' y='-5' width='10' height='10' fill='white'/>{}{}</svg>",
                lo.x - 0.05,
                lo.y - 0.05,
                hi.x - lo.x + 0.1,
                hi.y - lo.y + 0.1,
                poly(&a, "red"),
                poly(&best.1, "black")
            );
            std::fs::write(
                format!(
                    "/tmp/b2d/over_{}.svg",
                    std::path::Path::new(path)
                        .file_stem()
                        .unwrap()
                        .to_string_lossy()
                ),
                svg,
            )
            .unwrap();
        }
        text = format!(
            "rms {:.4} -> {:.4} % of D ({} points)",
            rms(&a, &b0),
            rms(&a, &b1),
            a.len()
        );
    }
    println!(
        "{path}: {} edges {} samples, {} mirrors (first {best:.2}); {:?} score {:.2} trusted {:.2} gap {:.2} relief {:.2} unfit {:.3} rival {:.2} bend {:.0}; {text}; times read {t1:.2} detect {:.2} bend {:.2} straighten {:.2}",
        wall.edges(),
        samples.list.len(),
        mirrors.len(),
        bend.trust.verdict(),
        bend.trust.score(),
        bend.trust.share,
        bend.trust.gap,
        bend.trust.relief,
        bend.trust.unfit,
        bend.trust.rival.unwrap_or(9.0),
        bend.degrees,
        t2 - t1,
        t3 - t2,
        t4 - t3
    );
    let mut svg = String::from(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-0.6 -0.6 2.4 1.2'><rect x='-1' y='-1' width='4' height='3' fill='white'/>",
    );
    for (k, pos) in [&wall.surface.positions, &straight.positions]
        .iter()
        .enumerate()
    {
        for r in &wall.rings {
            let pts: Vec<String> = r
                .clone()
                .map(|e| format!("{:.4},{:.4}", pos[2 * e].x + 1.2 * k as f64, -pos[2 * e].y))
                .collect();
            svg += &format!(
                "<polygon points='{}' fill='none' stroke='black' stroke-width='.002'/>",
                pts.join(" ")
            );
        }
    }
    for (s, q) in samples.list.iter().zip(&bend.field.partners).step_by(8) {
        if let Some(q) = q {
            svg += &format!(
                "<line x1='{:.4}' y1='{:.4}' x2='{:.4}' y2='{:.4}' stroke='red' stroke-width='.001'/>",
                s.position.x, -s.position.y, q.position.x, -q.position.y
            );
        }
    }
    svg += "</svg>";
    let name = std::path::Path::new(path)
        .file_stem()
        .unwrap()
        .to_string_lossy()
        .into_owned();
    std::fs::write(format!("/tmp/b2d/{name}.svg"), svg).unwrap();
    Ok(())
}
/// after best similarity (2D, no flip), % of the diagonal of a
fn rms(a: &[Point], b: &[Point]) -> f64 {
    let n = a.len() as f64;
    let ca = a
        .iter()
        .map(|p| p.coords)
        .sum::<symmetrizer::geom::Vector>()
        / n;
    let cb = b
        .iter()
        .map(|p| p.coords)
        .sum::<symmetrizer::geom::Vector>()
        / n;
    let best = [1.0, -1.0].map(|flip| {
        let (mut re, mut im, mut bb) = (0.0, 0.0, 0.0);
        for (p, q) in a.iter().zip(b) {
            let (p, q) = (p - ca, q - cb);
            let qy = flip * q.y;
            re += p.x * q.x + p.y * qy;
            im += p.y * q.x - p.x * qy;
            bb += q.x * q.x + qy * qy;
        }
        let (c, s) = (re / bb, im / bb);
        let e: f64 = a
            .iter()
            .zip(b)
            .map(|(p, q)| {
                let (p, q) = (p - ca, q - cb);
                let qy = flip * q.y;
                let (x, y) = (c * q.x - s * qy, s * q.x + c * qy);
                (p.x - x).powi(2) + (p.y - y).powi(2)
            })
            .sum();
        (e / n).sqrt()
    });
    let lo = a.iter().fold(a[0], |m, p| m.inf(p));
    let hi = a.iter().fold(a[0], |m, p| m.sup(p));
    100.0 * best[0].min(best[1]) / (hi - lo).norm()
}
