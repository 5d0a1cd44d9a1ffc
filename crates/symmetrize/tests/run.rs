//! `symmetrize run`.

mod common;

use std::time::{Duration, Instant};

use common::{Desk, FAST, data, keys, number, png_size, refused, stderr, stdout};

#[test]
fn the_creature_looks_ahead_and_every_file_appears() {
    let desk = Desk::new();
    let mut run = desk.symmetrize(&["run", "model:creature", "-o", "out.ply"]);
    run.args(["--write-input", "in.ply", "--report", "r.json"]);
    let done = run
        .args(["--picture", "p.png"])
        .args(FAST)
        .assert()
        .success();
    assert_eq!(desk.files(), ["in.ply", "out.ply", "p.png", "r.json"]);
    assert_eq!(stderr(&done), "", "no bars where there is no terminal");
    for part in [
        "straightened: a bend of",
        "symmetric about its bent axis",
        "outcome      converged",
        "wrote        out.ply",
    ] {
        assert!(stdout(&done).contains(part), "{}", stdout(&done));
    }
    assert_eq!(desk.bytes("in.ply").len(), desk.bytes("out.ply").len());
    let [width, height] = png_size(&desk.bytes("p.png"));
    assert_eq!(width, 1800);
    assert!(
        height > 2500,
        "{height}: the bend is drawn below both states"
    );
    let report = desk.json("r.json");
    assert!(number(&report, "/input/asymmetry/mean") > 1.0);
    assert!(number(&report, "/result/asymmetry/mean") < 0.1);
    check_keys(&report);
}

#[track_caller]
fn check_keys(report: &serde_json::Value) {
    let has = |value: &serde_json::Value, expected: &str| {
        for key in expected.split(' ') {
            assert!(
                value.get(key).is_some(),
                "{key} is not in {:?}",
                keys(value)
            );
        }
    };
    has(
        report,
        "schema version seed params outcome warnings input result steps run",
    );
    has(
        &report["input"],
        "file vertices faces diagonal scale validate asymmetry symmetries refused",
    );
    has(&report["result"], "asymmetry distortion energy symmetries");
    has(
        &report["input"]["symmetries"][0],
        "id kind matrix normal offset continuous height rms area_fraction patch_faces image_faces pairs",
    );
    has(&report["run"], "timings threads peak_memory");
    assert_eq!(report["schema"], 1);
    assert_eq!(report["outcome"], "converged");
    assert_eq!(report["input"]["file"], "model:creature");
    assert_eq!(report["params"]["sample"]["count"], 800);
    assert_eq!(report["result"]["symmetries"][0]["id"], 0);
    assert_eq!(report["steps"][0]["step"], "straighten");
    has(
        &report["bend"],
        "verdict score trusted likeness relief degrees removed",
    );
}

#[test]
fn one_and_two_threads_write_the_same_bytes() {
    let desk = Desk::new();
    let shape = data("truth/spot_headturn30.obj");
    let shape = shape.as_deref().unwrap_or("model:creature");
    for threads in ["1", "2"] {
        let [mesh, report] = ["obj", "json"].map(|e| format!("{threads}.{e}"));
        let mut run = desk.symmetrize(&["run", shape, "-o", &mesh, "--report", &report]);
        run.args(["--threads", threads, "--seed", "7", "--quiet"]);
        run.args(FAST).assert().success().stdout("").stderr("");
    }
    assert_eq!(desk.bytes("1.obj"), desk.bytes("2.obj"));
    assert_eq!(desk.json_but_run("1.json"), desk.json_but_run("2.json"));
    assert_eq!(desk.json("1.json")["seed"], 7);
    assert_eq!(desk.json("1.json")["run"]["threads"], 1);
}

#[test]
fn real_models_come_out_symmetric() {
    let cases = [
        (
            "truth/spot_headturn30.obj",
            "--straighten=1",
            0.12,
            "straightened",
        ),
        (
            "truth/spot_headturn30.obj",
            "--no-straighten",
            0.12,
            "merged",
        ),
        ("3d/cheburashka.obj", "--no-straighten", 0.1, "contracted 0"),
    ];
    for (file, flag, limit, part) in cases {
        let Some(path) = data(file) else { return };
        let desk = Desk::new();
        let mut run = desk.symmetrize(&["run", &path, "-o", "out.obj", "--report", "r.json"]);
        let done = run.arg(flag).args(FAST).assert().success();
        let mean = number(&desk.json("r.json"), "/result/asymmetry/mean");
        assert!(mean < limit, "{file}: {mean} % of D");
        assert!(stdout(&done).contains(part), "{}", stdout(&done));
    }
}

#[test]
fn a_pose_may_be_kept_and_a_bend_undone_by_itself() {
    let desk = Desk::new();
    let mut run = desk.symmetrize(&["run", "model:creature", "-o", "kept.ply", "--keep-pose"]);
    let done = run
        .args(["--report", "r.json"])
        .args(FAST)
        .assert()
        .success();
    assert!(
        stdout(&done).contains("degrees kept: partners"),
        "{}",
        stdout(&done)
    );
    let report = desk.json("r.json");
    assert!(number(&report, "/bend/kept/across") < 0.1);
    assert!(number(&report, "/bend/kept/line") < 0.5);
    assert_eq!(number(&report, "/bend/removed"), 0.0);

    let mut only = desk.symmetrize(&["straighten", "model:creature", "-o", "straight.ply"]);
    let done = only.args(FAST).assert().success();
    assert!(stdout(&done).contains("straightened: a bend of"));
    assert!(!stdout(&done).contains("finished"));
    let mut none = desk.symmetrize(&["straighten", "model:creature-at-rest", "-o", "none.ply"]);
    none.args(FAST).assert().code(1);
    assert_eq!(desk.files(), ["kept.ply", "r.json", "straight.ply"]);
    let both = [
        "run",
        "model:creature",
        "-o",
        "a.ply",
        "--keep-pose",
        "--straighten=0.5",
    ];
    desk.symmetrize(&both).assert().code(2);
}

#[test]
fn without_symmetry_there_is_a_report_and_no_shape() {
    let blob = data("truth/control_asymmetric_blob.ply");
    for shape in [Some("scalene.off"), blob.as_deref()].into_iter().flatten() {
        let desk = Desk::new();
        desk.scalene();
        let args = ["run", shape, "-o", "out.ply", "--report", "r.json"];
        let mut run = desk.symmetrize(&args);
        let done = run.args(["--picture", "p.png"]).assert().code(1);
        assert!(stdout(&done).contains("no symmetry found"));
        assert_eq!(desk.files(), ["r.json", "scalene.off"]);
        let report = desk.json("r.json");
        assert_eq!(report["outcome"], "no_symmetry");
        assert!(report["result"].is_null());
    }
}

#[test]
fn an_unchanged_shape_may_be_wanted_and_may_replace_its_input() {
    let desk = Desk::new();
    desk.scalene();
    let before = symmetrizer::shape::io::read(&desk.path("scalene.off")).unwrap();
    let args = ["run", "scalene.off", "-o", "scalene.off"];
    let mut run = desk.symmetrize(&args);
    run.arg("--write-unchanged").assert().code(1);
    let after = symmetrizer::shape::io::read(&desk.path("scalene.off")).unwrap();
    assert_eq!(before, after);
    assert_eq!(desk.files(), ["scalene.off"]);
}

#[test]
fn an_energy_limit_is_an_outcome() {
    let desk = Desk::new();
    let args = [
        "run",
        "model:creature",
        "-o",
        "out.ply",
        "--report",
        "r.json",
    ];
    let mut run = desk.symmetrize(&args);
    let done = run.args(["--max-deformation", "1e-5"]).args(FAST);
    let done = done.assert().success();
    assert!(stdout(&done).contains("energy limit reached"));
    assert_eq!(desk.files(), ["out.ply", "r.json"]);
    let report = desk.json("r.json");
    assert_eq!(report["outcome"], "energy_limit");
    assert_eq!(report["params"]["optimize"]["max_deformation"], 1e-5);
}

#[test]
fn bad_paths_are_refused_before_the_work() {
    let desk = Desk::new();
    desk.scalene();
    let begun = Instant::now();
    let refuse = |args: &[&str], part: &str| {
        refused(desk.symmetrize(&[&["run"], args].concat()), part);
    };
    let creature = "model:creature";
    refuse(&[creature, "-o", "none/out.ply"], "no directory none");
    refuse(&[creature, "-o", "out.fbx"], ".obj, .ply, .off, .stl");
    refuse(&[creature, "-o", "."], "");
    refuse(&["none.obj", "-o", "out.ply"], "none.obj");
    refuse(&["model:cow", "-o", "out.ply"], "model:creature");
    let with = |flag: &str, path: &str, part: &str| {
        refuse(&["scalene.off", "-o", "out.ply", flag, path], part);
    };
    with("--report", "none/r.json", "no directory none");
    with("--picture", "p.jpg", ".png or .svg");
    with("--report", "out.ply", "cannot be the same file");
    with("--report", "./scalene.off", "would replace the input");
    assert!(begun.elapsed() < Duration::from_secs(5));
    assert_eq!(desk.files(), ["scalene.off"]);
}

#[test]
fn stiffness_is_a_number_or_a_file() {
    let desk = Desk::new();
    let run = |stiffness: &str, out: &str| {
        let mut run = desk.symmetrize(&["run", "in.ply", "-o", out, "--stiffness", stiffness]);
        run.args(FAST).assert().success();
        desk.bytes(out)
    };
    let mut first = desk.symmetrize(&["run", "model:creature", "-o", "a.ply"]);
    first
        .args(["--write-input", "in.ply"])
        .args(FAST)
        .assert()
        .success();
    assert_eq!(run("1", "b.ply"), desk.bytes("a.ply"), "1 is the usual");
    assert_ne!(run("20", "c.ply"), desk.bytes("a.ply"));
    desk.write("bad.json", "{\"per\": \"edge\", \"values\": [1]}");
    desk.write("few.json", "{\"per\": \"vertex\", \"values\": [1, 2]}");
    for (stiffness, part) in [
        ("0", "positive"),
        ("none.json", "none.json"),
        ("bad.json", "\"per\""),
        ("few.json", "has 2 values"),
        ("in.ply", "property `stiffness`"),
    ] {
        let args = ["run", "in.ply", "-o", "out.ply", "--stiffness", stiffness];
        refused(desk.symmetrize(&args), part);
    }
}

#[test]
fn bad_parameters_are_refused() {
    let desk = Desk::new();
    desk.scalene();
    let refuse = |flags: &[&str], part: &str| {
        let args = [&["run", "scalene.off", "-o", "out.ply"], flags].concat();
        refused(desk.symmetrize(&args), part);
    };
    refuse(&["--set", "optimize.stepp=1"], "optimize.step");
    refuse(&["--set", "optimize.step"], "NAME=VALUE");
    refuse(&["--set", "optimize.step=fast"], "expected f64");
    refuse(&["--set", "optimize.step=2"], "out of range: 0.001..=1");
    refuse(&["--max-deformation=-1"], "optimize.max_deformation");
    refuse(&["--params", "none.toml"], "none.toml");
    desk.write("p.toml", "[optimize]\nstep = \n");
    refuse(&["--params", "p.toml"], "p.toml: line 2");
    desk.write("p.toml", "[optimize]\nstride = 0.1\n");
    refuse(&["--params", "p.toml"], "optimize.stride");
    assert_eq!(desk.files(), ["p.toml", "scalene.off"]);
}

#[test]
fn damaged_files_are_refused() {
    let desk = Desk::new();
    desk.write("empty.obj", "");
    desk.write("cloud.obj", "v 0 0 0\nv 1 0 0\n");
    desk.write("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    for (file, part) in [
        ("empty.obj", "empty.obj: "),
        ("cloud.obj", "no faces"),
        ("range.obj", "line 4"),
    ] {
        refused(desk.symmetrize(&["run", file, "-o", "out.ply"]), part);
    }
    assert_eq!(desk.files(), ["cloud.obj", "empty.obj", "range.obj"]);
}

/// How many files of `folder`, with or without a name, a process holds open.
#[cfg(target_os = "linux")]
fn open_files(process: u32, folder: &std::path::Path) -> usize {
    let Ok(descriptors) = std::fs::read_dir(format!("/proc/{process}/fd")) else {
        return 0;
    };
    let folder = folder.canonicalize().unwrap();
    let targets = descriptors
        .flatten()
        .filter_map(|d| d.path().read_link().ok());
    targets.filter(|t| t.starts_with(&folder)).count()
}

#[cfg(target_os = "linux")]
#[test]
fn a_killed_run_leaves_the_old_file_and_nothing_else() {
    use std::process::Command;
    let desk = Desk::new();
    desk.write("out.ply", "what was there before");
    let mut run = Command::new(env!("CARGO_BIN_EXE_symmetrize"));
    run.args([
        "run",
        "model:creature",
        "-o",
        "out.ply",
        "--report",
        "r.json",
        "-q",
    ]);
    let mut child = run.current_dir(desk.path("")).spawn().unwrap();
    while open_files(child.id(), &desk.path("")) < 2 {
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(desk.files(), ["out.ply"]);
    assert_eq!(desk.bytes("out.ply"), b"what was there before");
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_leaves_nothing_behind() {
    use std::process::{Command, Stdio};
    let desk = Desk::new();
    let mut run = Command::new(env!("CARGO_BIN_EXE_symmetrize"));
    run.args(["run", "model:creature", "-o", "out.ply"]);
    run.args(["--report", "r.json", "--picture", "p.png"]);
    run.current_dir(desk.path("")).stderr(Stdio::piped());
    let child = run.spawn().unwrap();
    // Not before its files are reserved: then it is listening, and has work for seconds.
    while open_files(child.id(), &desk.path("")) < 3 {
        std::thread::sleep(Duration::from_millis(20));
    }
    // They have no names before the end: nothing is left even where nobody can clean up.
    assert!(desk.files().is_empty(), "{:?}", desk.files());
    let begun = Instant::now();
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &id])
            .status()
            .unwrap()
            .success()
    );
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(
        String::from_utf8_lossy(&output.stderr),
        "error: cancelled\n"
    );
    assert!(begun.elapsed() < Duration::from_secs(20));
    assert!(desk.files().is_empty(), "{:?}", desk.files());
}
