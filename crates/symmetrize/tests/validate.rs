//! `symmetrize validate`.

mod common;

use common::{Desk, data, keys, refused, stderr, stdout};

/// A square with a loose vertex, cut in two, one half of it there twice.
const SQUARE: &str = "OFF\n5 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 5 5\n3 0 1 2\n3 0 2 3\n3 2 3 0\n";

/// The keys of an object in the order of the alphabet.
fn sorted(object: &serde_json::Value) -> String {
    let mut keys = keys(object);
    keys.sort_unstable();
    keys.join(" ")
}

#[test]
fn everything_is_told_in_words() {
    let desk = Desk::new();
    desk.write("square.off", SQUARE);
    let done = desk
        .symmetrize(&["validate", "square.off"])
        .assert()
        .success();
    let expected = "\
square.off: 5 vertices, 3 faces, which make 2 triangles to work with
box 1.000 x 1.000 x 0, diagonal D = 1.414, centre 0.7071 from the origin

mended    1 duplicate face                      face 2
          The corners are those of an earlier face, in the same order.
          A run works with the first of equal triangles only; the file keeps all.
note      1 border                              edge 0-1
          4 edges have a face on one side only: the rim of an open surface, or holes in it; the
          longest border has 4.
          A run closes no hole and makes none.
note      1 loose vertex                        vertex 4
          No face uses such a vertex.
          A run leaves loose vertices where they are.
fine      1 connected part, single precision

a run works on this file
";
    let text = stdout(&done);
    assert_eq!(text, expected, "\n{text}");
}

#[test]
fn a_report_has_all_figures() {
    let desk = Desk::new();
    desk.write("square.off", SQUARE);
    let args = ["validate", "square.off", "--report", "r.json", "--quiet"];
    let done = desk.symmetrize(&args).assert().success();
    assert_eq!(stdout(&done), "");
    let report = desk.json("r.json");
    let expected =
        "faces file findings run schema seed size triangles version vertices warnings works";
    assert_eq!(sorted(&report), expected);
    assert_eq!(
        (&report["schema"], &report["works"]),
        (&1.into(), &true.into())
    );
    let twice = &report["findings"][0];
    assert_eq!(sorted(twice), "action at count first kind of severity what");
    assert_eq!(
        (&twice["kind"], &twice["severity"]),
        (&"duplicate".into(), &"mended".into())
    );
    assert_eq!(
        (&twice["count"], &twice["first"]),
        (&1.into(), &[2].as_slice().into())
    );
    let border = &report["findings"][1];
    assert_eq!(border["first"], serde_json::json!([[0, 1]]));
    assert_eq!(border["at"], "edges");
}

#[test]
fn what_a_run_refuses_is_told_and_exits_with_1() {
    let desk = Desk::new();
    desk.write("points.off", "OFF\n1 0 0\n0 0 0\n");
    desk.write(
        "bad.off",
        "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 7\n2 0 1\n",
    );
    let verdict = |file: &str| {
        let told = desk.symmetrize(&["validate", file]).assert().code(1);
        stdout(&told).lines().last().unwrap_or_default().to_owned()
    };
    assert_eq!(verdict("points.off"), "a run refuses this file: no faces");
    assert_eq!(
        verdict("bad.off"),
        "a run refuses this file: 1 face with missing vertices; 1 face of too few corners"
    );
    // A run says so too.
    for file in ["points.off", "bad.off"] {
        let run = desk.symmetrize(&["measure", file]).assert().code(2);
        assert!(stderr(&run).starts_with("error: "));
    }
}

#[test]
fn what_cannot_be_read_exits_with_2() {
    let desk = Desk::new();
    desk.write("cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
    refused(desk.symmetrize(&["validate", "cut.off"]), "the file ends");
    refused(desk.symmetrize(&["validate", "none.off"]), "none.off");
    refused(
        desk.symmetrize(&["validate", "leaf.svg"]),
        "leaf.svg is a drawing, and validate looks at meshes",
    );
}

#[test]
fn a_sound_shape_has_nothing_but_fine() {
    let desk = Desk::new();
    desk.scalene();
    let text = stdout(
        &desk
            .symmetrize(&["validate", "scalene.off"])
            .assert()
            .success(),
    );
    let fine = "fine      closed surface, 1 connected part, single precision";
    assert_eq!(text.lines().nth(3), Some(fine), "{text}");
}

#[test]
fn the_bunny_has_five_holes() {
    let Some(bunny) = data("3d/bunny.obj") else {
        return;
    };
    let desk = Desk::new();
    let text = stdout(&desk.symmetrize(&["validate", &bunny]).assert().success());
    assert!(
        text.contains("5 borders") && text.contains("223 edges have"),
        "{text}"
    );
}
