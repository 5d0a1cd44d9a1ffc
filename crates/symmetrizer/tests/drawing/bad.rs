//! Files that cannot be used: each has a message that says what is wrong, soon.

use std::fmt::Write;
use std::time::{Duration, Instant};

use symmetrizer::drawing::{self, Format, Reading};

use crate::common;
use crate::shared::{elements, failure, page, warnings};

#[track_caller]
fn fails(svg: &str, part: &str) {
    let started = Instant::now();
    let message = failure(svg.as_bytes(), Format::Svg);
    assert!(message.contains(part), "{message:?} does not say {part:?}");
    assert!(started.elapsed() < Duration::from_secs(20), "{message}");
}

#[test]
fn what_is_no_drawing_is_named() {
    fails("", "the file is empty");
    fails("hello", "XML");
    fails("<svg", "XML");
    fails("<svg xmlns='http://www.w3.org/2000/svg'><g></svg>", "XML");
    fails("<html><body/></html>", "its root is <html>");
    fails("<svg xmlns='http://other'/>", "its root is <svg>");
    fails("\u{1f}\u{8b}", "XML");
    assert!(failure(&[0x1f, 0x8b, 8], Format::Svg).contains("SVGZ"));
    assert!(failure(&[0xff, 0xfe, b'<', 0], Format::Svg).contains("UTF-16"));
    assert!(failure(b"<svg \xff/>", Format::Svg).contains("byte 5 is not UTF-8"));
    fails(&"x".repeat(65 << 20), "more than 64");
}

#[test]
fn drawings_without_a_region_are_refused() {
    for content in [
        "",
        "<g/>",
        "<path d=''/>",
        "<path/>",
        "<text>a</text>",
        "<rect width='0' height='5'/>",
    ] {
        fails(&page(content), "no paths");
    }
    for content in [
        "<path d='M0 0L10 10'/>",
        "<path fill='none' stroke='black' d='M0 0L10 10L20 0'/>",
        "<line x1='0' y1='0' x2='9' y2='9' stroke='red'/>",
        "<path fill='none' d='M0 0H10V10Z'/>",
        "<path d='M0 0L10 10L0 0Z'/>",
    ] {
        fails(&page(content), "fills no region");
    }
}

#[test]
fn coordinates_out_of_range_are_refused() {
    fails(
        &page("<path d='M0 0H1e30V1e30Z'/>"),
        "coordinates of 1e9 or more",
    );
    fails(
        &page("<path d='M0 0H1e300V1e308Z'/>"),
        "coordinates of 1e9 or more",
    );
    fails(
        &page("<g transform='scale(1e200)'><path transform='scale(1e200)' d='M0 0H1V1Z'/></g>"),
        "coordinates",
    );
    fails(&page("<path d='M1e8 1e8h1e-3v1e-3z'/>"), "within");
    fails(&page("<path d='M5 5L5 5Z'/>"), "within");
    fails(
        &page("<path transform='scale(0)' d='M5 5h1v1z'/>"),
        "within",
    );
}

#[test]
fn damaged_path_data_counts_up_to_the_damage() {
    let drawing = elements("<path id='p' d='M0 0H10V10H0Z M 20 20 L 30 x'/>");
    assert_eq!(drawing.outline().area(), 100.0);
    assert!(
        warnings(&drawing).contains("<path id=\"p\"> in line 1"),
        "{}",
        warnings(&drawing)
    );
    fails(&page("<path d='L 5 5'/>"), "no paths");
}

#[test]
fn open_and_crossing_paths_follow_the_fill_rule() {
    assert_eq!(elements("<path d='M0 0H10V10'/>").outline().area(), 50.0);
    let bow = elements("<path d='M0 0L10 10V0L0 10Z'/>");
    assert_eq!(bow.outline().rings.len(), 2);
    assert_eq!(bow.outline().area(), 50.0);
}

#[test]
fn bombs_do_not_go_off() {
    let laughs =
        "<!DOCTYPE svg [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;'>]><svg><title>&b;</title></svg>";
    fails(laughs, "an entity of its DOCTYPE");
    let quadratic = format!(
        "<!DOCTYPE svg [<!ENTITY a '{}'>]><svg><title>{}</title></svg>",
        "x".repeat(100_000),
        "&a;".repeat(10_000)
    );
    fails(&quadratic, "references to entities");
    let elements = "<!DOCTYPE svg [<!ENTITY a '<path d=\"M0 0H1V1Z\"/>'>]><svg>&a;</svg>";
    fails(elements, "an entity of its DOCTYPE");
    fails(&page(&"<g>".repeat(300)), "XML");
    let deep = "<g>".repeat(100_000) + &"</g>".repeat(100_000);
    fails(&page(&deep), "nested more than 256 deep");
    let many = "<g/>".repeat(1_100_000);
    fails(&page(&many), "XML: nodes limit reached");
}

#[test]
fn uses_of_uses_are_counted() {
    let mut content = String::from("<g id='u0'><rect width='5' height='5'/></g>");
    for i in 1..30 {
        let below = i - 1;
        write!(
            content,
            "<g id='u{i}'><use href='#u{below}'/><use href='#u{below}'/></g>"
        )
        .unwrap();
    }
    fails(&page(&content), "elements are drawn, counting every use");
    // Rings of uses end where they began.
    let ring = "<g id='a'><rect width='5' height='5'/><use href='#b'/></g><g id='b'><use href='#a'/></g><use id='c' href='#c'/>";
    assert_eq!(elements(ring).outline().area(), 25.0);
    let clips = "<clipPath id='c' clip-path='url(#c)'><rect clip-path='url(#c)' width='5' height='5'/></clipPath>\
                 <rect clip-path='url(#c)' width='9' height='9'/>";
    assert_eq!(elements(clips).outline().area(), 25.0);
    let gradients = "<linearGradient id='g' href='#g'/><rect fill='url(#g)' width='5' height='5'/>";
    let drawing = elements(gradients);
    drawing
        .deformed(&|p| p + symmetrizer::geom::Vector::x())
        .unwrap();
}

#[test]
fn scribbles_are_refused_before_they_take_hours() {
    let mut data = String::from("M0 0");
    let mut seed = 1_u64;
    for _ in 0..60_000 {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        write!(data, "L{} {}", (seed >> 40) % 1000, (seed >> 50) % 1000).unwrap();
    }
    fails(
        &page(&format!("<path d='{data}'/>")),
        "cross each other too often",
    );
}

#[test]
fn style_sheets_have_limits() {
    let rules: String =
        (0..20_000).fold(String::new(), |all, i| all + &format!(".c{i}{{fill:red}}"));
    let content = format!(
        "<style>{rules}</style>{}",
        "<rect width='1' height='1'/>".repeat(5000)
    );
    fails(&page(&content), "style rules");
}

#[test]
fn nothing_outside_the_file_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let other = folder.path().join("other.svg");
    std::fs::write(&other, page("<rect id='a' width='50' height='50'/>")).unwrap();
    let href = other.display();
    let content = format!(
        "<rect width='5' height='5'/><use href='{href}#a'/><image href='{href}' width='9' height='9'/>\
         <style>@import url({href});</style>"
    );
    let path = folder.path().join("mine.svg");
    std::fs::write(&path, page(&content)).unwrap();
    let drawing = drawing::read(&path, &Reading::default()).unwrap();
    assert_eq!(drawing.outline().area(), 25.0);
    let mut png = Vec::new();
    drawing.encode(Format::Png, &mut png).unwrap();
    let external = format!("<!DOCTYPE svg [<!ENTITY x SYSTEM '{href}'>]><svg>&x;</svg>");
    fails(&external, "XML");
}

#[test]
fn bad_rings_are_named() {
    for (json, part) in [
        ("{", "JSON"),
        ("[]", "JSON"),
        (
            "{\"rings\": [[[0,0],[1,1]]]}",
            "ring 0 (counted from 0) has 2 points",
        ),
        ("{\"rings\": [[[0,0],[1,1],[2,2]]]}", "without any area"),
        ("{\"rings\": []}", "without any area"),
        (
            "{\"rings\": [[[0,0],[1e300,1],[2,2]]]}",
            "coordinates of 1e9 or more",
        ),
        ("{\"rings\": [[[0,0,0],[1,1,1],[2,2,2]]]}", "JSON"),
        ("{\"rings\": [[[0,0],[1,null],[2,2]]]}", "JSON"),
    ] {
        let message = failure(json.as_bytes(), Format::Json);
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}

#[test]
fn damaged_pictures_are_named() {
    assert!(failure(b"\x89PNG\r\n\x1a\n", Format::Png).contains("the picture cannot be read"));
    assert!(failure(b"nothing", Format::Jpeg).contains("the picture cannot be read"));
    // A header that promises 60,000 x 60,000 pixels.
    let mut huge = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\xea\x60\0\0\xea\x60\x08\0\0\0\0".to_vec();
    huge.extend([0; 4]);
    let message = failure(&huge, Format::Png);
    assert!(message.contains("picture"), "{message}");
}

/// Whatever is done to a good file, it is read or refused.
#[test]
fn damaged_copies_of_real_drawings_are_read_or_refused() {
    let files = [
        "2d/hand_print_right.svg",
        "2d/gecko_gi.svg",
        "2d/sea_snake.png",
        "2d/woody_flat_mesh.obj",
    ];
    for name in files {
        let Some(path) = common::data(name) else {
            return;
        };
        let format = Format::of_path(&path).unwrap();
        let good = std::fs::read(&path).unwrap();
        for i in 0..200_usize {
            let mut bytes = good.clone();
            let at = i * 7919 % bytes.len();
            match i % 4 {
                0 => bytes.truncate(at),
                1 => bytes[at] = bytes[at].wrapping_add(1 + i as u8),
                2 => drop(bytes.drain(at..(at + 1 + i % 40).min(good.len()))),
                _ => bytes[at] = b"<>\"-.eM/"[i / 4 % 8],
            }
            if let Ok(drawing) = drawing::decode(bytes, format, &Reading::default()) {
                let bent =
                    drawing.deformed(&|p| symmetrizer::geom::Point::new(p.x + 0.1 * p.y, p.y, 0.0));
                assert!(bent.unwrap().outline().area() > 0.0, "{name} {i}");
            }
        }
    }
}

#[test]
fn scribbles_just_below_the_limit_take_seconds() {
    let mut data = String::from("M0 0");
    let mut seed = 1_u64;
    for _ in 0..2800 {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        write!(data, "L{} {}", (seed >> 40) % 1000, (seed >> 50) % 1000).unwrap();
    }
    let started = Instant::now();
    let drawing = elements(&format!("<path d='{data}'/>"));
    assert!(drawing.outline().area() > 0.0);
    assert!(
        started.elapsed() < Duration::from_secs(30),
        "{:?}",
        started.elapsed()
    );
}
