//! `symmetrize detect`.

mod common;

use common::{Desk, FAST, number, png_size, refused, stderr, stdout};

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

#[test]
fn a_cloud_is_detected_on_and_drawn() {
    let desk = Desk::new();
    // Points on an ellipsoid with a bump: the mirror is y = 0.
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let point = |i: u32| {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / 2000.0;
        let (sin, cos) = (golden * f64::from(i)).sin_cos();
        let r = (1.0 - z * z).sqrt();
        let bump = 1.0 + 0.5 * (-6.0 * ((r * cos - 0.6).powi(2) + (z - 0.6).powi(2))).exp();
        format!("{} {} {}\n", 1.5 * bump * r * cos, 0.7 * r * sin, bump * z)
    };
    desk.write("cloud.txt", &(0..2000).map(point).collect::<String>());
    let args = ["detect", "cloud.txt", "--report", "r.json"];
    let mut detect = desk.symmetrize(&args);
    let done = detect.args(["--picture", "p.png"]).assert().success();
    assert!(
        stdout(&done).contains("2,000 points, "),
        "{}",
        stdout(&done)
    );
    png_size(&desk.bytes("p.png"));
    let report = desk.json("r.json");
    assert!(number(&report, "/input/symmetries/0/normal/1").abs() > 0.999);
    assert_eq!(
        report["input"]["symmetries"][0]["patch_faces"],
        serde_json::json!([])
    );
    assert_eq!(report["input"]["faces"], 0);
    let mut plot = desk.symmetrize(&["plot", "cloud.txt", "-o", "q.png"]);
    plot.assert().success();
    for verb in [
        &["run", "cloud.txt", "-o", "o.ply"][..],
        &["measure", "cloud.txt"],
    ] {
        refused(desk.symmetrize(verb), "point cloud can be detected only");
    }
}
