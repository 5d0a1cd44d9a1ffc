//! Outlines that would cross themselves.

use crate::shared::{crossings, drawing, symmetrized};
use symmetrizer::drawing::{Format, Reading, decode};
use symmetrizer::straighten::When;
use symmetrizer::{Context, Outcome, Params, symmetrize_drawing};

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
