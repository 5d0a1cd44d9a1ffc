//! Deformed documents: what changes, and all that does not.

use symmetrizer::drawing::Drawing;
use symmetrizer::geom::{Point, Vector};

use crate::shared::{apart, elements, text};

fn shifted(drawing: &Drawing, x: f64, y: f64) -> Drawing {
    drawing.deformed(&|p| p + Vector::new(x, y, 0.0)).unwrap()
}

#[track_caller]
fn has(drawing: &Drawing, part: &str) {
    let svg = drawing.svg();
    assert!(svg.contains(part), "no {part:?} in {svg}");
}

/// Written and read again it is the outline that was meant.
#[track_caller]
fn faithful(drawing: &Drawing) {
    let again = text(&drawing.svg());
    let off = apart(again.outline(), drawing.outline()) / drawing.outline().diagonal();
    assert!(off < 2e-4, "{off:.1e}: {}", drawing.svg());
}

#[test]
fn only_path_data_changes() {
    let before = "<?xml version=\"1.0\"?>\n<!-- mine -->\n<svg xmlns='http://www.w3.org/2000/svg' \
        xmlns:inkscape='http://i' viewBox='0 0 100 100'>\n  <g  inkscape:label=\"Layer &amp; 1\" \
        transform='translate(1,2)'>\n\t<path\n   style=\"fill:#123\" d='M0 0h10v10h-10z' id='p'/>\n  \
        </g>\n  <metadata>kept</metadata></svg>\n";
    let drawing = text(before);
    let moved = shifted(&drawing, 3.0, -4.0);
    assert_eq!(
        moved.svg(),
        before.replace("M0 0h10v10h-10z", "M3 4H13V14H3z")
    );
    faithful(&moved);
}

#[test]
fn lines_stay_lines_where_they_stay_straight() {
    let drawing = elements("<path d='M10 10H60L40 70Z'/>");
    let sheared = drawing
        .deformed(&|p| Point::new(p.x + 0.2 * p.y, p.y, 0.0))
        .unwrap();
    let data = data(&sheared);
    assert!(!data.contains(['c', 'C', 'q', 'Q']), "{data}");
    faithful(&sheared);
    let curved = drawing
        .deformed(&|p| Point::new(p.x + 0.004 * p.y * p.y, p.y, 0.0))
        .unwrap();
    faithful(&curved);
    // The closing line is bent, too; the level one is not.
    let data = self::data(&curved);
    assert_eq!(data.matches(['c', 'C']).count(), 2, "{data}");
    assert!(data.contains(['h', 'H']), "{data}");
}

/// The first path's data.
fn data(drawing: &Drawing) -> String {
    let svg = drawing.svg();
    let start = svg.find(" d=").unwrap() + 4;
    svg[start..].split(['"', '\'']).next().unwrap().to_owned()
}

#[test]
fn basic_shapes_become_paths_and_keep_the_rest() {
    let shapes = "<rect id='r' class=\"k\" x='1' y='1' width='10' height='10' rx='2' fill='red'/>\
        <circle cx='50' cy='50' r='20'><title>eye</title></circle>\
        <polygon stroke='blue' points='60,60 90,60 90,90'/>";
    let drawing = elements(shapes);
    let moved = shifted(&drawing, 1.0, 0.0);
    has(&moved, "id='r' class=\"k\" fill='red'/>");
    has(&moved, "><title>eye</title></path>");
    has(&moved, " stroke='blue'/>");
    for gone in [
        "<rect", "<circle", "<polygon", "points=", "rx=", "cx=", "width=",
    ] {
        assert!(!moved.svg().contains(gone), "{gone}");
    }
    faithful(&moved);
}

#[test]
fn transforms_are_kept_and_undone() {
    let drawing = elements(
        "<g transform='rotate(30) scale(2,3)'><path transform='skewX(10)' d='M5 5H20V15C15 20 10 20 5 15Z'/></g>",
    );
    let moved = shifted(&drawing, 4.0, 4.0);
    has(
        &moved,
        "<g transform='rotate(30) scale(2,3)'><path transform='skewX(10)'",
    );
    faithful(&moved);
}

#[test]
fn uses_that_come_to_differ_become_groups() {
    let drawing = elements(
        "<defs><path id='leaf' d='M0 0h10v5h-10z'/></defs><use href='#leaf' class='u' x='10' y='10'/>\
         <use href='#leaf' id='second' transform='translate(50 50) scale(2)'/>",
    );
    let bent = drawing
        .deformed(&|p| Point::new(p.x + 0.01 * p.y * p.y, p.y, 0.0))
        .unwrap();
    faithful(&bent);
    has(&bent, "<defs><path id='leaf' d='M0 0h10v5h-10z'/></defs>");
    has(
        &bent,
        "<g class='u' transform=\"translate(10 10)\"><path d='",
    );
    has(
        &bent,
        "<g id='second' transform=\"translate(50 50) scale(2) translate(0 0)\"><path d='",
    );
    assert_eq!(bent.svg().matches("id='leaf'").count(), 1);
}

#[test]
fn uses_may_be_placed_in_any_unit() {
    let drawing = elements(
        "<defs><path id='leaf' d='M0 0h10v5h-10z'/></defs><use href='#leaf' x='10%' y='1in'/>\
         <use href='#leaf' transform='nonsense(\"1' x='30'/>",
    );
    let bent = drawing
        .deformed(&|p| Point::new(p.x + 0.01 * p.y * p.y, p.y, 0.0))
        .unwrap();
    has(&bent, "<g transform=\"translate(10 96)\">");
    has(&bent, "<g transform=\"translate(30 0)\">");
    faithful(&bent);
}

#[test]
fn symbols_and_nested_uses_are_unfolded() {
    let drawing = elements(
        "<symbol id='s' viewBox='0 0 10 10'><g id='in'><rect id='q' width='10' height='10'/></g></symbol>\
         <g id='two'><use href='#s' width='20' height='20'/></g><use href='#two' x='40' y='40'/>",
    );
    let turned = drawing
        .deformed(&|p| Point::new(p.x - 0.1 * p.y, p.y + 0.1 * p.x, 0.0))
        .unwrap();
    faithful(&turned);
    assert_eq!(turned.svg().matches("<path").count(), 2, "{}", turned.svg());
    assert_eq!(turned.svg().matches("id='two'").count(), 1);
}

#[test]
fn loose_lines_hidden_parts_and_clips_ride_along() {
    let drawing = elements(
        "<clipPath id='c'><rect width='30' height='30'/></clipPath><rect clip-path='url(#c)' width='50' height='50'/>\
         <path d='M0 0L9 9' fill='none' stroke='red'/><path display='none' d='M1 1h3v3z'/>\
         <line x1='0' y1='0' x2='5' y2='5' stroke='red'/>",
    );
    let moved = shifted(&drawing, 1.0, -1.0);
    has(&moved, "<clipPath id='c'><path d=\"M1 1");
    has(&moved, "d='M1 1l9 9'");
    has(&moved, "d='M2 2H5V5z'");
    has(&moved, "<path d=\"M1 1 6 6\" stroke='red'/>");
    faithful(&moved);
}

#[test]
fn gradients_turn_along() {
    let drawing = elements(
        "<linearGradient id='base' gradientUnits='userSpaceOnUse' x1='0' y1='0' x2='9' y2='0'/>\
         <radialGradient id='box'/>\
         <rect fill='url(#base)' width='20' height='10'/><rect x='30' fill='url(#box)' width='20' height='10'/>",
    );
    let turned = drawing.deformed(&|p| Point::new(-p.y, p.x, 0.0)).unwrap();
    has(
        &turned,
        "<linearGradient gradientTransform=\"matrix(0 -1 1 0 0 0)\" id='base'",
    );
    has(&turned, "<radialGradient id='box'/>");
}

#[test]
fn texts_and_images_move_as_a_whole() {
    let drawing = elements(
        "<rect width='50' height='50'/><text x='10' y='20'>a</text>\
         <image transform='scale(2)' x='1' y='1' width='2' height='2' href='secret.png'/>",
    );
    let said = crate::shared::warnings(&drawing);
    assert!(
        said.contains("1 text:") && said.contains("1 image:"),
        "{said}"
    );
    let moved = shifted(&drawing, 5.0, -6.0);
    has(
        &moved,
        "<text transform=\"matrix(1 0 0 1 5 6)\" x='10' y='20'>a</text>",
    );
    has(&moved, "<image transform='matrix(2 0 0 2 5 6)' x='1'");
    let turned = drawing.deformed(&|p| Point::new(-p.y, p.x, 0.0)).unwrap();
    has(&turned, "<text transform=\"matrix(0 -1 1 0 0 0)\"");
    // A mirror does not turn letters over.
    let mirrored = drawing.deformed(&|p| Point::new(-p.x, p.y, 0.0)).unwrap();
    let svg = mirrored.svg();
    assert!(!svg.contains("matrix(-1 0 0 1"), "{svg}");
}

#[test]
fn what_does_not_move_keeps_its_bytes() {
    let drawing = elements("<path d='M0,0 L10,0 10,10Z'/><path d='M50,0 L60,0 60,10Z'/>");
    let half = drawing
        .deformed(&|p| if p.x > 30.0 { p + Vector::y() } else { p })
        .unwrap();
    has(&half, "<path d='M0,0 L10,0 10,10Z'/>");
    has(&half, "<path d='M50-1H60V9z'/>");
}

#[test]
fn programs_that_would_remake_the_path_are_kept_from_it() {
    let drawing = text(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:sodipodi='http://s' xmlns:inkscape='http://i'>\
         <path sodipodi:type='arc' sodipodi:nodetypes='cc' inkscape:label='x' d='M0 0h10v10z'/></svg>",
    );
    let moved = shifted(&drawing, 1.0, 0.0);
    assert!(!moved.svg().contains("sodipodi:type") && !moved.svg().contains("nodetypes"));
    has(&moved, "<path inkscape:label='x' d='M1 0H11V10z'/>");
}

#[test]
fn the_window_grows_with_what_leaves_it() {
    let drawing = text(
        "<svg xmlns='http://www.w3.org/2000/svg' width='50mm' height='50mm' viewBox='0 0 100 100'>\
         <path d='M10 10H90V90H10Z'/></svg>",
    );
    let moved = shifted(&drawing, 60.0, 0.0);
    has(&moved, "viewBox='0 0 150.8 100'");
    has(&moved, "width='75.4mm' height='50mm'");
    has(&shifted(&drawing, 5.0, 0.0), "viewBox='0 0 100 100'");
}

#[test]
fn corners_stay_corners_and_smooth_points_smooth() {
    // A drop: a corner at the top, round elsewhere.
    let drawing = elements(
        "<path d='M50 10C60 30 70 40 70 60C70 71 61 80 50 80C39 80 30 71 30 60C30 40 40 30 50 10Z'/>",
    );
    let bent = drawing
        .deformed(&|p| Point::new(p.x + 0.003 * p.y * p.y, p.y + 0.1 * p.x, 0.0))
        .unwrap();
    faithful(&bent);
    let again = text(&bent.svg());
    let ring = &again.outline().rings[0];
    let count = ring.points.len();
    let sharp = (0..count).filter(|&i| {
        let (a, b, c) = (
            ring.points[(i + count - 1) % count],
            ring.points[i],
            ring.points[(i + 1) % count],
        );
        (b - a).angle(&(c - b)) > 0.3
    });
    assert_eq!(sharp.count(), 1);
}

#[test]
fn maps_to_nowhere_are_errors() {
    let drawing = elements("<rect width='10' height='10'/>");
    for bad in [f64::NAN, f64::INFINITY] {
        let failed = drawing
            .deformed(&|p| Point::new(p.x, bad, 0.0))
            .unwrap_err();
        assert!(failed.to_string().contains("drawing"), "{failed}");
    }
}
