//! What counts as the region: shapes, transforms, fill rules, uses, clips.

use std::f64::consts::PI;

use symmetrizer::drawing::Format;

use crate::shared::{decoded, elements, page, text, warnings};

#[track_caller]
fn area(content: &str, expected: f64) {
    let found = elements(content).outline().area();
    let off = (found - expected).abs() / expected;
    assert!(off < 4e-4, "{found} and not {expected}: {content}");
}

#[test]
fn basic_shapes_have_their_area() {
    area("<rect x='1' y='2' width='30' height='20'/>", 600.0);
    area(
        "<rect width='30' height='20' rx='5'/>",
        600.0 - (4.0 - PI) * 25.0,
    );
    area("<circle cx='50' cy='50' r='20'/>", PI * 400.0);
    area("<ellipse cx='50' cy='50' rx='20' ry='10'/>", PI * 200.0);
    area("<polygon points='0,0 10,0 10,10'/>", 50.0);
    area("<polyline points='0 0 10 0 10 10 0 10'/>", 100.0);
    area("<rect width='50%' height='10%'/>", 500.0);
    area("<rect width='1in' height='10'/>", 960.0);
}

#[test]
fn all_commands_of_paths_are_understood() {
    area("<path d='M10 10h20v20h-20z'/>", 400.0);
    area(
        "<path d='m10 10 20 0 0 20 -20 0z m30 0 h10 v10 h-10'/>",
        500.0,
    );
    // Two halves of a circle, as arcs and as the flags without spaces that writers love.
    area(
        "<path d='M30 50A20 20 0 1 1 70 50A20 20 0 1 1 30 50'/>",
        PI * 400.0,
    );
    area(
        "<path d='M30 50a20 20 0 1140 0 20 20 0 11-40 0'/>",
        PI * 400.0,
    );
    // A parabola over a chord: two thirds of the box.
    area("<path d='M0 0Q30 60 60 0'/>", 1200.0);
    area("<path d='M0 0Q15 30 30 0T60 0z'/>", 600.0);
    area("<path d='M0 0C0 40 60 40 60 0S0 -40 0 0'/>", 2880.0);
}

#[test]
fn fill_rules_decide_about_what_crosses_itself() {
    let star = "M50 0L79 90L2 35H98L21 90Z";
    let even = elements(&format!("<path fill-rule='evenodd' d='{star}'/>"));
    let all = elements(&format!("<path d='{star}'/>"));
    assert_eq!(even.outline().rings.len(), 5);
    assert_eq!(all.outline().rings.len(), 1);
    assert!(all.outline().area() > even.outline().area());
    // Crossings belong to no path, corners do.
    let known = |d: &symmetrizer::drawing::Drawing| {
        let sources = d.outline().rings.iter().flat_map(|r| &r.sources);
        sources.flatten().count()
    };
    assert_eq!(known(&all), 5);
    let hole = "M0 0H40V40H0ZM10 10H30V30H10Z";
    area(
        &format!("<path style='fill-rule:evenodd' d='{hole}'/>"),
        1200.0,
    );
    area(&format!("<path d='{hole}'/>"), 1600.0);
    let ring = elements("<path d='M0 0H40V40H0ZM10 10V30H30V10Z'/>");
    let areas: Vec<f64> = ring.outline().rings.iter().map(|r| r.area()).collect();
    assert_eq!(areas.len(), 2);
    assert!(areas.contains(&1600.0) && areas.contains(&-400.0));
}

#[test]
fn overlapping_shapes_are_one_region() {
    let two =
        elements("<rect width='40' height='40'/><rect x='20' y='20' width='40' height='40'/>");
    assert_eq!(two.outline().rings.len(), 1);
    assert!((two.outline().area() / 2800.0 - 1.0).abs() < 1e-8);
    let touching = elements("<rect width='40' height='40'/><rect x='40' width='40' height='40'/>");
    assert_eq!(touching.outline().rings.len(), 1);
}

#[test]
fn places_come_from_transforms_groups_and_views() {
    let at = |content: &str| {
        let (low, high) = elements(content).outline().bounds();
        [low.x, low.y, high.x, high.y].map(|v| (v * 1e6).round() / 1e6)
    };
    let unit = "<rect width='10' height='10'/>";
    assert_eq!(at(unit), [0.0, -10.0, 10.0, 0.0]);
    let moved = format!("<g transform='translate(5 7)'><g transform='scale(2)'>{unit}</g></g>");
    assert_eq!(at(&moved), [5.0, -27.0, 25.0, -7.0]);
    assert_eq!(
        at("<rect style='transform:rotate(90deg)' width='10' height='10'/>"),
        [-10.0, -10.0, 0.0, 0.0]
    );
    let nested =
        format!("<svg x='10' y='10' width='40' height='20' viewBox='0 0 10 10'>{unit}</svg>");
    assert_eq!(at(&nested), [20.0, -30.0, 40.0, -10.0]);
    let used = "<defs><rect id='a' width='10' height='10'/></defs><use href='#a' x='3' transform='scale(2)'/>";
    assert_eq!(at(used), [6.0, -20.0, 26.0, 0.0]);
    let symbol = "<symbol id='s' viewBox='0 0 1 1'><rect width='1' height='1'/></symbol>\
                  <use xlink:href='#s' xmlns:xlink='http://www.w3.org/1999/xlink' x='5' width='20' height='20'/>";
    assert_eq!(at(symbol), [5.0, -20.0, 25.0, 0.0]);
}

#[test]
fn what_is_not_seen_is_not_part_of_the_shape() {
    let shown = "<rect width='10' height='10'/>";
    for hidden in [
        "<rect width='50' height='50' display='none'/>",
        "<rect width='50' height='50' style='visibility:hidden'/>",
        "<g opacity='0'><rect width='50' height='50'/></g>",
        "<rect width='50' height='50' fill='none'/>",
        "<rect width='50' height='50' fill='none' stroke='red'/>",
        "<defs><rect width='50' height='50'/></defs>",
        "<style>.no{fill:none}</style><rect class='no' width='50' height='50'/>",
        "<clipPath id='c'><rect width='50' height='50'/></clipPath>",
        "<pattern id='p'><rect width='50' height='50'/></pattern>",
        "<switch><rect requiredExtensions='x' width='50' height='50'/></switch>",
    ] {
        area(&format!("{hidden}{shown}"), 100.0);
    }
}

#[test]
fn clip_paths_cut() {
    let clip = "<clipPath id='c'><circle cx='20' cy='20' r='10'/></clipPath>";
    area(
        &format!("{clip}<rect clip-path='url(#c)' width='80' height='80'/>"),
        PI * 100.0,
    );
    area(
        &format!("{clip}<g clip-path='url(#c)'><rect width='20' height='80'/></g>"),
        PI * 50.0,
    );
}

#[test]
fn a_frame_behind_everything_is_background() {
    let drawing =
        elements("<rect width='100' height='100' fill='#fff'/><circle cx='50' cy='50' r='20'/>");
    assert!((drawing.outline().area() / (PI * 400.0) - 1.0).abs() < 2e-4);
    assert!(warnings(&drawing).contains("background"));
    // Alone it is the shape.
    assert_eq!(
        elements("<rect width='100' height='100'/>")
            .outline()
            .area(),
        1e4
    );
}

#[test]
fn closed_lines_count_where_nothing_is_filled() {
    let drawing = elements(
        "<g fill='none' stroke='black'><path d='M0 0H10V10H0Z'/><path d='M0 0L90 90'/></g>",
    );
    assert_eq!(drawing.outline().area(), 100.0);
    assert!(warnings(&drawing).contains("nothing is filled"));
}

#[test]
fn percentages_entities_and_missing_namespaces_are_no_hindrance() {
    let svg = "<!DOCTYPE svg [<!ENTITY ns \"http://www.w3.org/2000/svg\"><!ENTITY w '30'>]>\
               <svg xmlns='&ns;' viewBox='0 0 100 100'><rect width='&w;' height='10'/></svg>";
    assert_eq!(text(svg).outline().area(), 300.0);
    assert_eq!(
        text("<svg><rect width='5' height='5'/></svg>")
            .outline()
            .area(),
        25.0
    );
    let bom = format!("\u{feff}{}", page("<rect width='5' height='5'/>"));
    assert_eq!(text(&bom).outline().area(), 25.0);
}

/// Places that are easily got wrong, where another implementation has the word.
#[test]
fn the_renderer_agrees_about_places() {
    for content in [
        "<svg x='10' y='20' width='60' height='30' viewBox='0 0 10 10' preserveAspectRatio='xMaxYMin meet'>\
         <circle cx='5' cy='5' r='4'/></svg>",
        "<svg width='60' height='30' viewBox='0 0 10 10' preserveAspectRatio='none'><circle cx='5' cy='5' r='4'/></svg>",
        "<symbol id='s' viewBox='0 0 20 10'><ellipse cx='10' cy='5' rx='9' ry='4'/></symbol>\
         <use href='#s' x='10' y='10' width='40' height='60'/><use href='#s' transform='rotate(45) scale(.5)' x='60' width='50' height='20'/>",
        "<g id='a'><rect x='1' y='1' width='8' height='3'/></g><g transform='skewX(20)'><use href='#a' y='10'/><use href='#a' y='20' transform='rotate(10)'/></g>",
        "<g transform='matrix(-1 .2 .3 1 60 5)'><path transform='rotate(30 20 20)' d='m5 5q10-10 20 0t20 0v20a5 9 30 01-10 5z'/></g>",
        "<style>.a{fill:none} g .b{fill:black} #c{display:none} rect.d:first-child{fill-rule:evenodd}</style>\
         <rect class='a' width='9' height='9'/><g class='a'><rect class='b' x='20' width='9' height='9'/></g><rect id='c' width='50' height='50'/>",
        "<path fill-rule='evenodd' d='M10 10h50v50h-50zM20 20h30v30h-30zM30 30h10v10h-10z'/>",
        "<clipPath id='k' transform='translate(5 5)'><rect width='20' height='20'/><circle cx='40' cy='30' r='9'/></clipPath>\
         <g transform='rotate(10)'><g clip-path='url(#k)'><rect width='90' height='35'/></g></g>",
        "<clipPath id='k'><path clip-rule='evenodd' d='M0 0h50v50h-50zM10 10h30v30h-30z'/></clipPath><rect clip-path='url(#k)' width='45' height='90'/>",
        "<defs><g id='x'><rect width='10' height='10' fill='inherit'/></g></defs><use href='#x' fill='none'/><use href='#x' x='30' y='30'/>",
        "<switch><g systemLanguage='en'><rect width='10' height='10'/></g><rect width='50' height='50'/></switch>",
        "<path d='M10 10L60 10 60 60zM70 70h10v10'/><path d='M5 80l10 0 0 10zl-3 0 0 4z'/>",
    ] {
        let drawing = elements(content);
        let mut png = Vec::new();
        drawing.encode(Format::Png, &mut png).unwrap();
        let seen = decoded(&png, Format::Png);
        let scale = 10.24_f64.powi(2);
        let (ours, theirs) = (drawing.outline().area() * scale, seen.outline().area());
        assert!(
            (ours / theirs - 1.0).abs() < 5e-3,
            "{ours} and {theirs}: {content}"
        );
    }
}
