//! `symmetrize detect`.

mod common;

use common::{Desk, FAST, number, png_size, stderr, stdout};

#[test]
fn the_creature_has_a_body_and_a_turned_head() {
    let desk = Desk::new();
    let args = ["detect", "model:creature", "--report", "r.json"];
    let mut detect = desk.symmetrize(&args);
    let done = detect.args(["--picture", "p.png"]).args(FAST);
    let done = done.assert().success();
    assert_eq!(desk.files(), ["p.png", "r.json"]);
    assert_eq!(stderr(&done), "");
    assert!(stdout(&done).contains("  0  mirror"), "{}", stdout(&done));
    png_size(&desk.bytes("p.png"));
    let report = desk.json("r.json");
    assert!(report.get("result").is_none() && report.get("steps").is_none());
    // The body's mirror is y = 0, the head's is turned by 35 degrees about an upright axis.
    assert!(number(&report, "/input/symmetries/0/normal/1") > 0.99);
    let head = number(&report, "/input/symmetries/1/normal/1");
    assert!((head - 35.0_f64.to_radians().cos()).abs() < 0.05, "{head}");
    let reason = report["input"]["refused"][0]["reason"].as_str().unwrap();
    assert!(!reason.is_empty());
}

#[test]
fn no_symmetry_is_exit_1() {
    let desk = Desk::new();
    desk.scalene();
    let mut detect = desk.symmetrize(&["detect", "scalene.off", "--report", "r.json"]);
    let done = detect.assert().code(1);
    assert!(stdout(&done).contains("no symmetry found"));
    let report = desk.json("r.json");
    assert_eq!(report["input"]["symmetries"], serde_json::json!([]));
}
