//! `symmetrize plot`.

mod common;

use common::{Desk, FAST, png_size, refused, stdout};

#[test]
fn the_density_is_drawn_as_png_and_as_svg() {
    let desk = Desk::new();
    for file in ["d.png", "d.svg"] {
        let args = [
            "plot",
            "model:creature-at-rest",
            "--classes",
            "mirror",
            "-o",
        ];
        let mut plot = desk.symmetrize(&[&args[..], &[file]].concat());
        let done = plot.args(FAST).assert().success();
        assert!(stdout(&done).contains("votes"), "{}", stdout(&done));
    }
    assert_eq!(png_size(&desk.bytes("d.png")), [900, 944]);
    let svg = String::from_utf8(desk.bytes("d.svg")).unwrap();
    assert!(svg.contains("<svg") && svg.contains("model:creature-at-rest"));
}

#[test]
fn a_shape_without_symmetry_has_a_density_too() {
    let desk = Desk::new();
    desk.scalene();
    desk.symmetrize(&["plot", "scalene.off", "-o", "d.png"])
        .assert()
        .success();
    png_size(&desk.bytes("d.png"));
}

#[test]
fn other_pictures_are_refused() {
    let desk = Desk::new();
    let plot = desk.symmetrize(&["plot", "model:creature", "-o", "d.pdf"]);
    refused(plot, ".png or .svg");
    assert!(desk.files().is_empty());
}

#[test]
fn each_class_has_a_plot_and_threads_change_nothing() {
    let desk = Desk::new();
    for threads in ["1", "2"] {
        let file = format!("{threads}.svg");
        let mut plot = desk.symmetrize(&["plot", "model:creature", "-o", &file]);
        plot.args(["--threads", threads])
            .args(FAST)
            .assert()
            .success();
    }
    assert_eq!(desk.bytes("1.svg"), desk.bytes("2.svg"));
    let svg = String::from_utf8(desk.bytes("1.svg")).unwrap();
    for class in [
        "mirrors: ",
        "rotations, translations, screws: ",
        "glides, rotoreflections",
    ] {
        assert!(svg.contains(class), "{class}");
    }
    assert_eq!(svg.matches("<image ").count(), 3);
    assert!(svg.contains("displacement, fraction of L"));
}
