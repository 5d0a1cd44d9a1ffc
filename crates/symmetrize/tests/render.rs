//! `symmetrize render`.

mod common;

use common::{Desk, png_size, stderr};

#[test]
fn the_views_asked_for_are_side_by_side() {
    let desk = Desk::new();
    let args = ["render", "model:creature", "-o", "sheet.png"];
    let mut render = desk.symmetrize(&args);
    let views = ["--views", "front,side,back", "--size", "200x240"];
    render.args(views).args(["--asymmetry", "--plane"]);
    render.assert().success();
    let [width, height] = png_size(&desk.bytes("sheet.png"));
    assert!((600..700).contains(&width), "{width}");
    assert!((240..480).contains(&height), "{height}");
    assert_eq!(desk.files(), ["sheet.png"]);
}

#[test]
fn unknown_views_and_sizes_are_refused() {
    let desk = Desk::new();
    for (flag, value, part) in [
        ("--views", "nose", "three-quarter"),
        ("--size", "0x10", "from 16 to 4096"),
    ] {
        let args = ["render", "model:creature", "-o", "s.png", flag, value];
        let failed = desk.symmetrize(&args).assert().code(2);
        assert!(stderr(&failed).contains(part), "{}", stderr(&failed));
    }
    assert!(desk.files().is_empty());
}
