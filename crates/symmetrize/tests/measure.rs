//! `symmetrize measure`.

mod common;

use common::{Desk, data, number, refused, stdout};

#[test]
fn the_resting_creature_is_symmetric_but_for_its_triangles() {
    let desk = Desk::new();
    let args = ["measure", "model:creature-at-rest", "--report", "r.json"];
    let done = desk.symmetrize(&args).assert().success();
    assert!(stdout(&done).contains("asymmetry, % of D"));
    let report = desk.json("r.json");
    assert!(number(&report, "/input/asymmetry/mean") < 0.02);
    assert!(number(&report, "/input/asymmetry/normal/1") > 0.999);
    assert_eq!(report["input"]["validate"]["components"], 1);
    assert!(report.get("distortion").is_none());
}

#[test]
fn a_shape_is_compared_with_its_original() {
    let desk = Desk::new();
    desk.scalene();
    let moved = String::from_utf8(desk.bytes("scalene.off")).unwrap();
    desk.write("moved.off", &moved.replace("0.2 0.5 3.1", "0.2 0.5 3.5"));
    let measure = |against: &str| {
        let args = ["measure", "scalene.off", "--against", against];
        let mut measure = desk.symmetrize(&args);
        measure.args(["--report", "r.json"]).assert().success();
        let report = desk.json("r.json");
        assert_eq!(report["against"], against);
        number(&report, "/distortion/rms_unaligned")
    };
    assert_eq!(measure("scalene.off"), 0.0);
    assert!(measure("moved.off") > 1.0);
}

#[test]
fn a_stranger_is_no_original() {
    let desk = Desk::new();
    desk.scalene();
    let args = ["measure", "scalene.off", "--against", "model:creature"];
    refused(desk.symmetrize(&args), "same vertices and faces");
}

#[test]
fn the_bunny_is_measured_as_ever() {
    let Some(bunny) = data("3d/bunny.obj") else {
        return;
    };
    let desk = Desk::new();
    let args = ["measure", &bunny, "--report", "r.json"];
    desk.symmetrize(&args).assert().success();
    let mean = number(&desk.json("r.json"), "/input/asymmetry/mean");
    assert!((mean - 2.05).abs() < 0.05, "{mean}");
}
