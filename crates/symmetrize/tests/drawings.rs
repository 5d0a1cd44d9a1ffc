//! Drawings on the command line.

mod common;

use common::{Desk, data, number, stderr, stdout};

/// A bent leaf with a stalk: an ellipse along a parabola, and a line beside it.
fn leaf() -> String {
    let at = |k: u32| {
        let angle = f64::from(k) / 240.0 * std::f64::consts::TAU;
        let (along, across) = (200.0 * angle.cos(), angle.sin());
        let notched = 60.0 + 14.0 * (9.0 * angle).cos() + 20.0 * (2.0 * angle + 0.7).sin().abs();
        let bow = along * along / 500.0;
        format!("{:.3},{:.3}", along, across * notched + bow)
    };
    let points: Vec<String> = (0..240).map(at).collect();
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-300 -300 600 600'>\n\
         <!-- kept -->\n<polygon id='leaf' fill='#2a7' points='{}'/>\n\
         <rect id='frame' x='-290' y='-290' width='580' height='580' fill='none' stroke='#000'/>\n</svg>\n",
        points.join(" ")
    )
}

#[test]
fn an_svg_file_keeps_what_it_is() {
    let Some(gecko) = data("truth/gecko_bent.svg") else {
        return;
    };
    let desk = Desk::new();
    let mut run = desk.symmetrize(&["run"]);
    run.arg(&gecko);
    let done = run
        .args(["-o", "out.svg", "--report", "r.json", "--picture", "p.png"])
        .assert()
        .success();
    assert_eq!(stderr(&done), "");
    for part in ["straightened: a bend of 9", "outcome      converged"] {
        assert!(stdout(&done).contains(part), "{}", stdout(&done));
    }
    let report = desk.json("r.json");
    assert!(number(&report, "/input/asymmetry/mean") > 1.0);
    assert!(number(&report, "/result/asymmetry/mean") < 0.15);
    assert!(number(&report, "/bend/rival") < 0.5);
    let text = String::from_utf8(desk.bytes("out.svg")).expect("text");
    let before = std::fs::read_to_string(&gecko).expect("a file");
    assert!(
        text.len() < 3 * before.len(),
        "{} of {}",
        text.len(),
        before.len()
    );
    for verb in ["measure", "detect"] {
        desk.symmetrize(&[verb, "out.svg"]).assert().success();
    }
    let args = ["plot", "out.svg", "-o", "plot.png"];
    desk.symmetrize(&args).assert().success();
    let args = ["render", "out.svg", "-o", "view.png", "--plane"];
    desk.symmetrize(&args).assert().success();
}

#[test]
fn frames_and_comments_stay() {
    let desk = Desk::new();
    desk.write("leaf.svg", &leaf());
    let args = ["run", "leaf.svg", "-o", "out.svg", "--accept-uncertain"];
    let done = desk.symmetrize(&args).assert();
    // Whatever came of the leaf, a drawing that is written has its frame where it was.
    let args = ["run", "leaf.svg", "-o", "out.svg", "--write-unchanged"];
    if !desk.files().contains(&"out.svg".to_owned()) {
        desk.symmetrize(&args).assert().code(1);
    }
    let text = String::from_utf8(desk.bytes("out.svg")).expect("text");
    for part in ["<!-- kept -->", "width='580'", "fill='#2a7'"] {
        assert!(text.contains(part), "{part}: {text}\n{}", stdout(&done));
    }
}

#[test]
fn formats_of_drawings_are_told_from_those_of_shapes() {
    let desk = Desk::new();
    desk.write("leaf.svg", &leaf());
    for (args, part) in [
        (
            vec!["run", "leaf.svg", "-o", "out.ply"],
            "out.ply: no drawing",
        ),
        (vec!["run", "model:creature", "-o", "out.svg"], "out.svg"),
        (
            vec!["run", "model:creature", "-o", "out.ply", "--exact"],
            "--exact",
        ),
        (
            vec!["measure", "model:creature", "--threshold", "0.5"],
            "--threshold",
        ),
        (
            vec!["measure", "leaf.svg", "--against", "leaf.svg"],
            "--against",
        ),
    ] {
        let done = desk.symmetrize(&args).assert().code(2);
        assert!(stderr(&done).contains(part), "{args:?}: {}", stderr(&done));
        assert_eq!(desk.files(), ["leaf.svg"], "{args:?}");
    }
    for out in ["leaf.json", "leaf.png"] {
        desk.symmetrize(&["convert", "leaf.svg", out])
            .assert()
            .success();
    }
    desk.symmetrize(&["convert", "leaf.png", "traced.svg"])
        .assert()
        .success();
    desk.symmetrize(&["measure", "traced.svg"])
        .assert()
        .success();
}

#[test]
fn bad_drawings_are_refused_with_what_is_wrong() {
    let desk = Desk::new();
    for (name, text, part) in [
        ("empty.svg", "", "empty"),
        (
            "none.svg",
            "<svg xmlns='http://www.w3.org/2000/svg'/>",
            "none.svg",
        ),
        ("text.svg", "no markup", "text.svg"),
        (
            "rings.json",
            "{\"rings\": [[[0, 0], [1, 0]]]}",
            "rings.json",
        ),
        (
            "huge.svg",
            "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0L1e300 0L0 1e300Z'/></svg>",
            "coordinates",
        ),
        (
            "bomb.svg",
            "<!DOCTYPE svg [<!ENTITY a 'aa'><!ENTITY b '&a;&a;'>]>\
             <svg xmlns='http://www.w3.org/2000/svg'><text>&b;</text><path d='M0 0h9v9z'/></svg>",
            "entity",
        ),
        (
            "file.svg",
            "<!DOCTYPE svg [<!ENTITY x SYSTEM 'file:///etc/hostname'>]>\
             <svg xmlns='http://www.w3.org/2000/svg'><text>&x;</text><path d='M0 0h9v9z'/></svg>",
            "entity",
        ),
    ] {
        desk.write(name, text);
        let done = desk
            .symmetrize(&["run", name, "-o", "out.svg"])
            .assert()
            .code(2);
        assert!(stderr(&done).contains(part), "{}", stderr(&done));
        assert!(!desk.files().contains(&"out.svg".to_owned()));
    }
}

#[test]
fn drawings_are_as_stiff_as_their_files_say() {
    let desk = Desk::new();
    desk.write("leaf.svg", &leaf());
    desk.write("path.json", "{\"per\": \"path\", \"values\": [0.5]}");
    let places = "{\"per\": \"place\", \"places\": [[-100, 0], [100, 40]], \"values\": [0.1, 10]}";
    desk.write("place.json", places);
    let run = |stiffness: &str| {
        let args = ["run", "leaf.svg", "-o", "out.svg", "--stiffness", stiffness];
        let mut run = desk.symmetrize(&args);
        run.args([
            "--accept-uncertain",
            "--write-unchanged",
            "--report",
            "r.json",
        ]);
        // Whatever came of the leaf, the report says how stiff it was.
        let done = run.assert();
        assert!(!stderr(&done).contains("error"), "{}", stderr(&done));
        desk.json("r.json")
    };
    for (stiffness, least, most) in [
        ("2", 2.0, 2.0),
        ("path.json", 0.5, 0.5),
        ("place.json", 0.1, 10.0),
    ] {
        let report = run(stiffness);
        assert!(
            (number(&report, "/stiffness/min") - least).abs() < 1e-12,
            "{stiffness}"
        );
        assert!(
            (number(&report, "/stiffness/max") - most).abs() < 1e-12,
            "{stiffness}"
        );
    }
    desk.write("vertex.json", "{\"per\": \"vertex\", \"values\": [1, 2]}");
    desk.write("none.json", "{\"per\": \"place\", \"values\": [1]}");
    desk.write("few.json", "{\"per\": \"path\", \"values\": []}");
    for (stiffness, part) in [
        ("vertex.json", "per path or place"),
        ("none.json", "each place has a value"),
        ("few.json", "has 0 values"),
        ("-1", "positive"),
    ] {
        let flag = format!("--stiffness={stiffness}");
        let args = ["run", "leaf.svg", "-o", "no.svg", &flag];
        let done = desk.symmetrize(&args).assert().code(2);
        assert!(
            stderr(&done).contains(part),
            "{stiffness}: {}",
            stderr(&done)
        );
    }
    // What is for drawings is refused for meshes.
    let args = [
        "run",
        "model:creature",
        "-o",
        "no.ply",
        "--stiffness",
        "place.json",
    ];
    let done = desk.symmetrize(&args).assert().code(2);
    assert!(stderr(&done).contains("for drawings"), "{}", stderr(&done));
}

#[test]
fn nothing_outside_a_drawing_is_opened() {
    let desk = Desk::new();
    desk.write(
        "secret.svg",
        "<svg xmlns='http://www.w3.org/2000/svg'><path id='a' d='M0 0h900v900z'/></svg>",
    );
    desk.write(
        "in.svg",
        "<svg xmlns='http://www.w3.org/2000/svg'><use href='secret.svg#a'/><image href='secret.svg' \
         width='500' height='500'/><path d='M0 0h60v50l-30 20l-30 -20z'/></svg>",
    );
    desk.symmetrize(&["convert", "in.svg", "out.json"])
        .assert()
        .success();
    let text = String::from_utf8(desk.bytes("out.json")).expect("text");
    assert!(!text.contains("900"), "{text}");
}
