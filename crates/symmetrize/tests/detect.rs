//! `symmetrize detect`.

mod common;

use common::{Desk, FAST, data, keys, number, png_size, refused, stderr, stdout};
use serde_json::Value;

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

/// The report of `detect` on a file of the test data, if it is there.
fn report(file: &str, more: &[&str]) -> Option<Value> {
    let path = data(file)?;
    let desk = Desk::new();
    let mut detect = desk.symmetrize(&["detect", &path, "--quiet", "--report", "r.json"]);
    detect.args(more).assert().success();
    Some(desk.json("r.json"))
}

fn of_kind<'a>(report: &'a Value, kind: &'a str) -> Vec<&'a Value> {
    let all = report["input"]["symmetries"].as_array().unwrap();
    all.iter().filter(|s| s["kind"] == kind).collect()
}

fn vector(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| value[i].as_f64().expect("a number"))
}

fn truth(file: &str) -> Value {
    let path = data(&format!("truth/{file}.truth.json")).expect("a truth beside the shape");
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

#[test]
fn a_chiral_shape_has_rotations_of_its_order() {
    let Some(report) = report("truth/rot5_chiral.ply", &["--classes", "rotation"]) else {
        return;
    };
    let turns = of_kind(&report, "rotation");
    let whole = turns.iter().filter(|s| number(s, "/area_fraction") > 0.9);
    let whole: Vec<&&Value> = whole.collect();
    assert!(!whole.is_empty());
    let step = 72.0;
    for s in whole {
        let angle = number(s, "/angle_deg").abs();
        let fifths = (angle / step).round();
        assert!((angle - step * fifths).abs() < 0.3, "{angle} degrees");
        assert!(fifths == 1.0 || fifths == 2.0, "{angle} degrees");
        assert_eq!(s["order"], 5);
        assert!(s.get("shift").is_none() && s.get("normal").is_none());
        check_elements(s);
    }
}

/// The matrix fixes the axis through the point, and its trace is that of the angle.
#[track_caller]
fn check_elements(s: &Value) {
    let [axis, point] = ["axis", "point"].map(|key| vector(&s[key]));
    let rows: Vec<[f64; 3]> = (0..3).map(|r| vector(&s["matrix"][r])).collect();
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let size = dot(point, point).sqrt().max(1.0);
    for r in 0..3 {
        assert!((dot(rows[r], axis) - axis[r]).abs() < 1e-9);
        let moved = dot(rows[r], point) + s["matrix"][r][3].as_f64().unwrap();
        assert!((moved - point[r]).abs() < 1e-9 * size, "{s}");
    }
    let trace = rows[0][0] + rows[1][1] + rows[2][2];
    let angle = number(s, "/angle_deg").to_radians();
    assert!((trace - 1.0 - 2.0 * angle.cos()).abs() < 1e-9);
}

#[test]
fn a_row_has_the_shift_of_its_step_in_the_units_of_the_file() {
    let Some(report) = report("truth/row5_translation.ply", &["--classes", "translation"]) else {
        return;
    };
    let truth = truth("row5_translation");
    let rest = vector(&truth["step"]);
    let step = [0, 1, 2].map(|r| {
        let row = vector(&truth["placement"][r]);
        row[0] * rest[0] + row[1] * rest[1] + row[2] * rest[2]
    });
    let diagonal = number(&report, "/input/diagonal");
    let gap = |s: &&Value| {
        let shift = vector(&s["shift"]);
        let norm = |sign: f64| {
            let d = [0, 1, 2].map(|i| shift[i] - sign * step[i]);
            d.iter().map(|c| c * c).sum::<f64>().sqrt()
        };
        norm(1.0).min(norm(-1.0))
    };
    let found = of_kind(&report, "translation");
    let nearest = found.iter().map(gap).fold(f64::INFINITY, f64::min);
    assert!(nearest < 0.002 * diagonal, "{nearest}");
    let first = found[0];
    for key in ["axis", "point", "angle_deg", "order", "normal"] {
        assert!(first.get(key).is_none(), "{key} in {:?}", keys(first));
    }
    let matrix = |r: usize, c: usize| first["matrix"][r][c].as_f64().unwrap();
    assert_eq!([matrix(0, 0), matrix(0, 1)], [1.0, 0.0]);
    assert!((matrix(0, 3) - vector(&first["shift"])[0]).abs() < 1e-9 * diagonal);
}

#[test]
fn only_the_classes_asked_for_are_found() {
    let desk = Desk::new();
    let args = ["detect", "model:creature-at-rest", "--report"];
    let mut mirrors = desk.symmetrize(&[&args[..], &["m.json", "--classes", "mirror"]].concat());
    mirrors.args(FAST).assert().success();
    let report = desk.json("m.json");
    assert_eq!(
        report["params"]["detect"]["kinds"],
        serde_json::json!(["mirror"])
    );
    assert!(!of_kind(&report, "mirror").is_empty());
    assert_eq!(
        of_kind(&report, "mirror").len(),
        report["input"]["symmetries"].as_array().unwrap().len()
    );
    let counts = report["input"]["refused_counts"].as_array().unwrap();
    assert!(counts.iter().all(|c| c["class"] == "mirror"));

    // The same with a parameter; the creature has one mirror and no glide.
    let set = ["--set", "detect.kinds=[\"glide\"]"];
    let mut glides = desk.symmetrize(&[&args[..], &["g.json"], &set].concat());
    let done = glides.args(FAST).assert();
    assert!(matches!(done.get_output().status.code(), Some(0 | 1)));
    let report = desk.json("g.json");
    assert!(of_kind(&report, "mirror").is_empty());
    assert!(of_kind(&report, "rotoreflection").is_empty());
}

#[test]
fn unknown_classes_are_refused_with_the_known_ones() {
    let desk = Desk::new();
    for classes in ["mirror,spiral", "identity", ""] {
        let args = ["detect", "model:creature", "--classes", classes];
        refused(desk.symmetrize(&args), "mirror, rotation, translation");
    }
    let set = "detect.kinds=[\"spiral\"]";
    let args = ["plot", "model:creature", "-o", "d.png", "--set", set];
    refused(desk.symmetrize(&args), "`rotation`");
    assert!(desk.files().is_empty());
}

#[test]
fn refused_motions_are_counted_and_the_highest_listed() {
    let desk = Desk::new();
    let mut detect = desk.symmetrize(&["detect", "model:creature", "--report", "r.json"]);
    let text = stdout(&detect.args(FAST).assert().success());
    let input = &desk.json("r.json")["input"];
    for class in ["mirror", "proper", "improper"] {
        let listed = input["refused"].as_array().unwrap();
        let listed = listed.iter().filter(|r| r["class"] == class).count();
        let counts = input["refused_counts"].as_array().unwrap();
        let counts = counts.iter().filter(|r| r["class"] == class);
        let all: u64 = counts.map(|c| c["count"].as_u64().unwrap()).sum();
        assert_eq!(listed as u64, all.min(12), "{class}");
        if class == "proper" && all > 0 {
            assert!(
                text.contains(&format!("{all} rotations, translations, screws")),
                "{text}"
            );
        }
    }
}
