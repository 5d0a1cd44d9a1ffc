//! Bends of drawings are undone, or kept.

use crate::shared::{crossings, drawing, missed, rest, symmetrized};
use symmetrizer::deform::Stiffness;
use symmetrizer::drawing::{Format, Reading, decode};
use symmetrizer::field::trust::Verdict;
use symmetrizer::geom::Point;
use symmetrizer::straighten::When;
use symmetrizer::{Context, Params, symmetrize_drawing, symmetrize_drawing_with};

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

/// Each wing of the butterfly is symmetric by itself, and more so than it is like the other; the antennae lean to one side.
#[test]
fn wings_are_paired_as_one_line_says() {
    let Some(drawing) = drawing("2d/butterfly_gi.svg") else {
        return;
    };
    let done = symmetrized(&drawing);
    let (bend, result) = (&done.job.report.bend, &done.job.report.result);
    let bend = bend.as_ref().expect("the antennae's");
    assert_eq!(bend.verdict, Verdict::Accept);
    assert!(bend.degrees < 45.0, "{}", bend.degrees);
    let result = result.as_ref().expect("a result");
    assert!(result.asymmetry.mean < 0.05, "{}", result.asymmetry.mean);
    assert_eq!(crossings(&done.drawing), 0);
    assert!(result.distortion.rms < 2.0, "{}", result.distortion.rms);
}

/// The ring of a drop of so many units' length and half width, its tip beside the middle.
fn wing([length, width]: [f64; 2], degrees: f64, tip: [f64; 2]) -> String {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let point = |k: u32| {
        let t = f64::from(k) / 120.0 * std::f64::consts::TAU;
        let x = length * (1.0 + t.cos()) / 2.0;
        let y = width * t.sin() * (0.6 + 0.4 * t.cos());
        format!(
            "[{},{}]",
            tip[0] + cos * x - sin * y,
            tip[1] + sin * x + cos * y
        )
    };
    let points: Vec<String> = (0..120).map(point).collect();
    format!("[{}]", points.join(","))
}

/// Four wings without a body, each symmetric by itself, one of the larger two turned by six degrees. The longest ring is one of two: paired
/// with itself, it would turn the wings about each other.
#[test]
fn wings_without_a_body_keep_their_places() {
    let [upper, lower] = [[200.0, 45.0], [130.0, 35.0]];
    let rings = [
        wing(upper, 40.0, [8.0, 10.0]),
        wing(upper, 134.0, [-8.0, 10.0]),
        wing(lower, -50.0, [8.0, -10.0]),
        wing(lower, 230.0, [-8.0, -10.0]),
    ];
    let text = format!("{{\"rings\": [{}]}}", rings.join(","));
    let drawing = decode(text.into_bytes(), Format::Json, &Reading::default()).expect("rings");
    let done = symmetrized(&drawing);
    match &done.job.report.result {
        Some(result) => {
            assert!(result.asymmetry.mean < 0.05, "{}", result.asymmetry.mean);
            assert!(result.distortion.rms < 1.0, "{}", result.distortion.rms);
        }
        None => assert_eq!(done.drawing.outline(), drawing.outline()),
    }
}

/// Under the line of its wings alone the antennae would be torn apart.
#[test]
fn a_drawing_that_would_come_out_worse_is_left() {
    let Some(drawing) = drawing("2d/butterfly_gi.svg") else {
        return;
    };
    let mut params = Params::default();
    params.straighten.when = When::Never;
    let done = symmetrize_drawing(&drawing, &params, &mut Context::new(0)).expect("a run");
    if let Some(result) = &done.job.report.result {
        let was = done.job.report.input.shape.mean_asymmetry();
        assert!(result.asymmetry.mean < 0.6 * was);
    } else {
        assert_eq!(done.drawing.outline(), drawing.outline());
        let warned = done
            .job
            .report
            .warnings
            .iter()
            .any(|w| w.0.contains("left as it is"));
        assert!(warned, "{:?}", done.job.report.warnings);
    }
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
