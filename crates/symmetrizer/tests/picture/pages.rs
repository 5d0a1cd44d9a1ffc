//! Pages: SVG that parses, PNG that decodes, text that is escaped, plots of odd votes.

use image::RgbaImage;
use resvg::usvg;
use symmetrizer::geom::Vector;
use symmetrizer::picture::canvas::Text;
use symmetrizer::picture::{
    Angle, Canvas, Cell, Checks, DensityPlot, Exhibit, Extent, Gallery, Panel, PlotMode,
    ReportPicture, Rod, Row, Rows, ScalarField, Scene, Sheet, Tile, View, categorical,
    render_sheet,
};
use symmetrizer::transform::isometry::Plane;

use crate::models::{Model, sphere};

fn decode(png: &[u8]) -> RgbaImage {
    image::load_from_memory(png).unwrap().to_rgba8()
}

fn parse(svg: &str) -> usvg::Tree {
    usvg::Tree::from_str(svg, &usvg::Options::default()).unwrap()
}

fn images(group: &usvg::Group) -> usize {
    let count = |node: &usvg::Node| match node {
        usvg::Node::Image(_) => 1,
        usvg::Node::Group(g) => images(g),
        _ => 0,
    };
    group.children().iter().map(count).sum()
}

fn mode(position: [f64; 2], height: f64, color: usize) -> PlotMode {
    PlotMode {
        position,
        label: format!("<{color}>"),
        height,
        color,
    }
}

/// The brightest place of a plot of `side` pixels.
fn brightest(plot: &DensityPlot<'_>, side: u32) -> [u32; 2] {
    let image = decode(&plot.to_png(side).unwrap());
    // The page around the plot is white; magma's brightest is pale yellow.
    let plotted = |p: &[u8; 4]| p[2] < 200;
    let brightness = |p: &[u8; 4]| u32::from(p[0]) + u32::from(p[1]) + u32::from(p[2]);
    let bright = image.enumerate_pixels().filter(|(_, _, p)| plotted(&p.0));
    let best = bright.max_by_key(|(_, _, p)| brightness(&p.0)).unwrap();
    [best.0, best.1]
}

#[test]
fn every_text_becomes_valid_svg() {
    for text in [
        "<&>\"'",
        "</text></svg>",
        "a\u{0}b\u{1}\u{fffe}\n\t\u{202e}",
        "",
        "兔 🐇 e\u{301}",
    ] {
        let mut canvas = Canvas::new(200, 50);
        canvas.text(Text::new(text, 5.0, 20.0, 12.0));
        parse(&canvas.to_svg().unwrap());
        decode(&canvas.to_png().unwrap());
    }
}

#[test]
fn a_text_fits_its_width() {
    let long = "a very long line of words ".repeat(20);
    let text = Text::new(long, 0.0, 0.0, 20.0).within(300.0);
    assert!(text.width() <= 300.0 && text.content.ends_with('…'));
    let short = Text::new("short", 0.0, 0.0, 20.0);
    assert_eq!(short.clone().within(300.0), short);
}

#[test]
fn text_is_drawn_with_the_font_of_the_library() {
    let mut canvas = Canvas::new(200, 50);
    let empty = canvas.to_image().unwrap();
    canvas.text(Text::new("mean 2.03 % → 0.08 %", 5.0, 30.0, 14.0));
    let drawn = canvas.to_image().unwrap();
    let differ = empty.pixels().zip(drawn.pixels()).filter(|(a, b)| a != b);
    assert!(differ.count() > 300);
}

#[test]
fn a_picture_is_on_the_page_as_it_is() {
    let mut canvas = Canvas::new(30, 30);
    let picture = RgbaImage::from_fn(10, 10, |x, y| image::Rgba([x as u8, y as u8, 77, 255]));
    canvas.image(5, 7, picture.clone());
    let page = canvas.to_image().unwrap();
    let part = image::imageops::crop_imm(&page, 5, 7, 10, 10).to_image();
    assert_eq!(part, picture);
    assert_eq!(images(parse(&canvas.to_svg().unwrap()).root()), 1);
}

#[test]
fn the_heat_map_peaks_where_the_votes_are() {
    let axes = Extent {
        x: [-1.0, 1.0],
        y: [-1.0, 1.0],
    };
    let votes = [[0.5, 0.5], [0.5, 0.5], [-0.5, -0.5]];
    let plot = |weights| DensityPlot {
        points: &votes,
        weights,
        bandwidth: 0.1,
        axes: Some(axes),
        ..DensityPlot::default()
    };
    // Up is up: the upper right quarter holds the heavier votes.
    let [x, y] = brightest(&plot(&[]), 300);
    assert!(x > 200 && y < 100, "{x} {y}");
    let [x, y] = brightest(&plot(&[1.0, 1.0, 9.0]), 300);
    assert!(x < 150 && y > 150, "{x} {y}");
}

#[test]
fn odd_votes_are_plotted_without_panic() {
    let nan = f64::NAN;
    let odd = [
        [nan, 0.0],
        [0.0, f64::INFINITY],
        [1e300, -1e300],
        [f64::MAX, f64::MIN],
    ];
    let modes = [
        mode([nan, 0.0], nan, 3),
        mode([0.0, 0.0], -1.0, usize::MAX),
        mode([0.0, 0.0], 0.0, 1),
    ];
    let flat = Extent {
        x: [0.0, 0.0],
        y: [nan, 1.0],
    };
    for points in [&[][..], &odd[..], &odd[..2], &[[0.0; 2]; 3][..]] {
        for bandwidth in [0.1, 0.0, -1.0, nan, 1e300] {
            let plot = DensityPlot {
                shown: Default::default(),
                points,
                weights: &[nan, -1.0],
                modes: &modes,
                bandwidth,
                axes: (bandwidth > 0.05).then_some(flat),
                title: "odd",
            };
            let svg = plot.to_svg(120).unwrap();
            // The base64 text of a picture may contain any letters.
            let mut lines = svg.lines().filter(|l| !l.starts_with("<image"));
            assert!(lines.all(|l| !l.contains("NaN") && !l.contains("\"inf")));
            parse(&svg);
            decode(&plot.to_png(1).unwrap());
        }
    }
}

fn report<'a>(
    before: &'a Model,
    after: &'a Model,
    scalar: &'a [f64],
    planes: &'a [(Plane, [u8; 3])],
    density: Option<DensityPlot<'a>>,
) -> ReportPicture<'a> {
    ReportPicture {
        title: "egg & <spoon>",
        subtitle: "mean asymmetry 2 % → 0 %",
        before: Panel {
            positions: &before.positions,
            scalar,
            planes,
            density,
        },
        after: Panel {
            positions: &after.positions,
            ..Panel::default()
        },
        triangles: &before.triangles,
        scale_max: None,
        scale_label: "asymmetry, % of D",
    }
}

#[test]
fn a_report_is_a_page_with_every_panel() {
    let before = sphere(12);
    let after = before.map(|p| symmetrizer::geom::Point::new(p.x, 1.5 * p.y, p.z));
    let scalar: Vec<f64> = before.positions.iter().map(|p| p.x + 1.0).collect();
    let planes = [(
        Plane {
            normal: Vector::x(),
            offset: 0.0,
        },
        categorical(0),
    )];
    let plot = DensityPlot::default();
    let page = report(&before, &after, &scalar, &planes, Some(plot));
    let tree = parse(&page.to_svg().unwrap());
    assert_eq!(images(tree.root()), 9);
    let image = decode(&page.to_png().unwrap());
    assert_eq!(image.width(), 1800);
    let empty = Model {
        positions: Vec::new(),
        triangles: before.triangles.clone(),
    };
    decode(
        &report(&empty, &after, &[f64::NAN], &[], None)
            .to_png()
            .unwrap(),
    );
    decode(&ReportPicture::default().to_png().unwrap());
}

#[test]
fn one_thread_and_two_make_the_same_page() {
    let model = sphere(10);
    let scalar: Vec<f64> = model.positions.iter().map(|p| p.y).collect();
    let votes = [[0.1, 0.2], [0.3, -0.1]];
    let plot = DensityPlot {
        points: &votes,
        bandwidth: 0.05,
        ..DensityPlot::default()
    };
    let make = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            report(&model, &model, &scalar, &[], Some(plot))
                .to_png()
                .unwrap()
        })
    };
    assert_eq!(make(1), make(2));
}

#[test]
fn a_sheet_has_one_picture_for_each_angle() {
    let model = sphere(10);
    let values: Vec<f64> = model.positions.iter().map(|p| p.y).collect();
    for count in 0..=Angle::ALL.len() {
        let sheet = Sheet {
            title: "ball",
            positions: &model.positions,
            triangles: &model.triangles,
            scalar: Some(ScalarField {
                values: &values,
                max: Some(1.0),
                label: "height",
            }),
            planes: &[],
            upright: None,
            angles: &Angle::ALL[..count],
            size: [60, 50],
        };
        let canvas = render_sheet(&sheet);
        assert_eq!(images(parse(&canvas.to_svg().unwrap()).root()), count);
    }
}

/// A panel whose part is the triangles of a ball beyond `side` along z.
fn cap(model: &Model, side: f64) -> Exhibit {
    let beyond = |t: &[u32; 3]| {
        t.iter()
            .all(|&v| side * model.positions[v as usize].z > 0.3)
    };
    let faces = (0..).zip(&model.triangles).filter(|(_, t)| beyond(t));
    Exhibit {
        caption: "part".into(),
        parts: vec![(faces.map(|(f, _)| f).collect(), [255, 0, 0])],
        rods: vec![Rod {
            from: symmetrizer::geom::Point::new(0.0, -1.5, 0.0),
            to: symmetrizer::geom::Point::new(0.0, 1.5, 0.0),
            radius: 0.02,
            arrow: true,
            color: [0, 0, 120],
        }],
        ..Exhibit::empty()
    }
}

#[test]
fn a_gallery_looks_at_each_part_from_its_side() {
    let model = sphere(24);
    let exhibits = [
        cap(&model, 1.0),
        cap(&model, -1.0),
        cap(&model, 1.0),
        cap(&model, -1.0),
    ];
    let gallery = Gallery {
        title: "gallery",
        positions: &model.positions,
        triangles: &model.triangles,
        upright: None,
        exhibits: &exhibits,
        size: [200, 200],
    };
    let page = gallery.canvas();
    let svg = page.to_svg().unwrap();
    assert_eq!(images(parse(&svg).root()), 4);
    assert!(svg.contains("gallery") && svg.matches(">part<").count() == 4);
    assert_eq!(svg, gallery.canvas().to_svg().unwrap());
    let picture = decode(&page.to_png().unwrap());
    // Three in a row, the fourth below the first.
    let red_in = |column: u32, row: u32| {
        let [x0, y0] = [32 + column * 200, 68 + row * 248 + 48];
        let pixels = (0..200 * 200).map(|i| picture.get_pixel(x0 + i % 200, y0 + i / 200).0);
        let red = |p: &[u8; 4]| p[0] > 90 && p[1] < 60 && p[2] < 60;
        pixels.filter(red).count()
    };
    for (column, row) in [(0, 0), (1, 0), (2, 0), (0, 1)] {
        let red = red_in(column, row);
        assert!(red > 4000, "{red} pixels of the part at {column}, {row}");
    }
    assert_eq!(red_in(0, 0), red_in(2, 0));
}

/// A page of one row: `scene` from ahead, with a line.
fn row(scene: Scene<'_>, line: &[symmetrizer::geom::Point]) -> Canvas {
    let cell = Cell {
        caption: "from ahead".into(),
        scene,
        view: View::new(-Vector::z(), Vector::y()),
        line,
    };
    let row = Row {
        name: "pairs".into(),
        note: vec![
            ("of a ball".into(), None),
            ("blue".into(), Some([0, 0, 255])),
        ],
        cells: vec![cell.clone(), cell],
    };
    let page = Rows {
        title: "Bend".into(),
        lines: vec!["none".into()],
        rows: vec![row],
    };
    page.canvas()
}

#[test]
fn rows_have_their_pictures_below_another_page() {
    let ball = sphere(3);
    let scene = Scene {
        positions: &ball.positions,
        triangles: &ball.triangles,
        ..Scene::default()
    };
    let page = row(scene, &ball.positions[..3]);
    let (below, above) = (page.height(), Canvas::new(300, 70));
    let both = above.above(page);
    assert_eq!([both.width(), both.height()], [1800, 70 + below]);
    let svg = both.to_svg().unwrap();
    assert_eq!(images(parse(&svg).root()), 2);
    for words in ["Bend", "pairs", "of a ball", "from ahead"] {
        assert!(svg.contains(words), "{words}");
    }
    assert_eq!(row(Scene::default(), &[]).width(), 1800, "nothing to see");
}

#[test]
fn checks_differ_from_square_to_square_and_are_grey_where_nothing_is_known() {
    let ball = sphere(4);
    let colors = |places: &dyn Fn(f64, f64) -> [f64; 3]| {
        let places: Vec<[f64; 3]> = ball.positions.iter().map(|p| places(p.x, p.y)).collect();
        let scene = Scene {
            positions: &ball.positions,
            triangles: &ball.triangles,
            checks: Some(Checks {
                places: &places,
                side: 0.5,
            }),
            ..Scene::default()
        };
        let image = decode(&row(scene, &[]).to_png().unwrap());
        // The middle of the first picture, and a little to its sides.
        let [x, y] = [316, image.height() / 2 + 40];
        [-20, 20].map(|way: i32| image.get_pixel(x.saturating_add_signed(way), y).0)
    };
    let [left, right] = colors(&|x, _| [x / 2.0 + 0.5, 0.1, 1.0]);
    let [l, r] = [left, right].map(|c| c[..3].iter().map(|c| i32::from(*c)).sum::<i32>());
    assert!((l - r).abs() > 100, "{left:?} and {right:?}");
    for place in [[0.5, 0.1, 0.2], [f64::NAN, 0.1, 1.0]] {
        for c in colors(&|_, _| place) {
            let even = c[0].abs_diff(c[1]) < 12 && c[1].abs_diff(c[2]) < 12;
            assert!(even, "{c:?}");
        }
    }
}

#[test]
fn a_tile_is_seen_where_it_is_and_nowhere_else() {
    let ball = sphere(4);
    let at = |x: f64, y: f64| symmetrizer::geom::Point::new(x, y, 0.0);
    let tile = Tile {
        corners: [at(1.2, -0.5), at(1.6, -0.5), at(1.6, 0.5), at(1.2, 0.5)],
        color: [0, 0, 255],
    };
    let scene = Scene {
        positions: &ball.positions,
        triangles: &ball.triangles,
        tiles: &[tile],
        ..Scene::default()
    };
    let image = decode(&row(scene, &[]).to_png().unwrap());
    let blue = |p: &image::Rgba<u8>| p.0[2] > p.0[0].saturating_add(30) && p.0[2] > 200;
    let page = image.enumerate_pixels().filter(|(_, y, _)| *y > 165);
    let right: Vec<u32> = page
        .filter(|(x, _, p)| *x < 600 && blue(p))
        .map(|(x, _, _)| x)
        .collect();
    assert!(right.len() > 1000, "{}", right.len());
    assert!(right.iter().all(|x| *x > 400), "beside the ball only");
}
