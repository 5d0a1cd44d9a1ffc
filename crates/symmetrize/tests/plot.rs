//! `symmetrize plot`.

mod common;

use common::{Desk, FAST, png_size, refused, stdout};

#[test]
fn the_density_is_drawn_as_png_and_as_svg() {
    let desk = Desk::new();
    for file in ["d.png", "d.svg"] {
        let mut plot = desk.symmetrize(&["plot", "model:creature-at-rest", "-o", file]);
        let done = plot.args(FAST).assert().success();
        assert!(stdout(&done).contains("votes"), "{}", stdout(&done));
    }
    assert_eq!(png_size(&desk.bytes("d.png")), [900, 900]);
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
