//! The pictures of docs/gallery/drawings.md: real drawings before and after, and the gecko of figure 2.

use std::path::PathBuf;

use symmetrizer::drawing::{Reading, read};
use symmetrizer::job::pictures::before_after;
use symmetrizer::picture::Canvas;
use symmetrizer::picture::canvas::{GREY, INK, Text};
use symmetrizer::straighten::When;
use symmetrizer::{Context, Drawing, Drawn, Error, Outcome, Params, Result, symmetrize_drawing};

use crate::tables::{Table, number};
use crate::{Answer, data, terminal};

/// Draw the gallery of drawings
#[derive(clap::Args)]
pub struct Args {
    /// Where to write the pictures
    #[arg(long, value_name = "FOLDER", default_value = "docs/gallery")]
    write: PathBuf,
}

/// Real drawings, and those whose bend is undone on request.
const DRAWINGS: [(&str, bool); 14] = [
    ("gecko_gi", false),
    ("lizard_boitel", false),
    ("dragonfly_gi", false),
    ("butterfly_rot.traced", false),
    ("beetle_walk.traced", false),
    ("bat_fold.traced", false),
    ("oak_leaf_gi", true),
    ("gecko_photo.traced", true),
    ("lizard_curl.traced", false),
    ("lizard_lean.traced", false),
    ("lizard_s.traced", false),
    ("lizard_up.traced", false),
    ("sea_turtle_gi", false),
    ("turtle_tilt.traced", true),
];

/// Side of a drawing, pixels, room above a pair, and pairs in a row.
const SIDE: f64 = 230.0;
const HEAD: f64 = 26.0;
const ROW: usize = 2;
const MARGIN: f64 = 10.0;
const INSIDE: [u8; 3] = [228, 231, 236];

/// Draws the pictures and prints the table.
///
/// # Errors
/// Test data that is missing; those of the library.
pub fn run(args: &Args) -> Result<Answer> {
    let rows = DRAWINGS.len().div_ceil(ROW);
    let pair = 2.0 * SIDE + 2.0 * MARGIN;
    let size = [ROW as f64 * pair, rows as f64 * (SIDE + HEAD)];
    let mut page = Canvas::new(size[0] as u32, size[1] as u32);
    let mut table = Table::new([
        "drawing",
        "verdict",
        "asymmetry",
        "after",
        "energy",
        "crossings",
    ]);
    for (k, (name, asked)) in DRAWINGS.into_iter().enumerate() {
        let path = data::root()?.join("2d").join(format!("{name}.svg"));
        let drawing = read(&path, &Reading::default())?;
        let done = symmetrized(&drawing, asked)?;
        let corner = [(k % ROW) as f64 * pair, (k / ROW) as f64 * (SIDE + HEAD)];
        let short = name.trim_end_matches(".traced");
        page.text(Text::new(short, corner[0] + MARGIN, corner[1] + 18.0, 14.0).colored(GREY));
        let scale = scale(&drawing).min(scale(&done.drawing));
        draw(&mut page, &drawing, [corner[0], corner[1] + HEAD], scale);
        if done.job.outcome == Outcome::NoSymmetry {
            let at = [corner[0] + 1.5 * SIDE - 40.0, corner[1] + HEAD + SIDE / 2.0];
            page.text(Text::new("left as it is", at[0], at[1], 14.0).colored(GREY));
        } else {
            draw(
                &mut page,
                &done.drawing,
                [corner[0] + SIDE, corner[1] + HEAD],
                scale,
            );
        }
        table.row(figures(short, &done, asked));
    }
    write(args, "drawings.png", &page)?;
    let path = data::root()?.join("truth/gecko_bent.svg");
    let done = symmetrized(&read(&path, &Reading::default())?, false)?;
    write(
        args,
        "gecko.png",
        &before_after(&done.job, "gecko_bent.svg")?,
    )?;
    terminal::answer(&table.to_string());
    Ok(Answer::Done)
}

fn write(args: &Args, name: &str, page: &Canvas) -> Result<()> {
    let path = args.write.join(name);
    std::fs::write(&path, page.to_png()?).map_err(|e| Error::io(&path, e))
}

fn symmetrized(drawing: &Drawing, asked: bool) -> Result<Drawn> {
    let mut params = Params::default();
    if asked {
        params.straighten.when = When::Uncertain;
    }
    symmetrize_drawing(drawing, &params, &mut Context::new(0))
}

fn figures(name: &str, done: &Drawn, asked: bool) -> [String; 6] {
    let report = &done.job.report;
    let result = report.result.as_ref();
    let bend = report
        .bend
        .as_ref()
        .map(|b| format!("{:?}", b.verdict).to_lowercase());
    let how = if asked { ", asked for" } else { "" };
    let before = report.input.shape.asymmetry.as_ref();
    [
        name.into(),
        bend.unwrap_or_else(|| "mirror".into()) + how,
        number(before.map(|a| a.mean), 2),
        number(result.map(|r| r.asymmetry.mean), 3),
        number(result.map(|r| r.energy), 4),
        number(result.map(|r| r.distortion.new_crossings as f64), 0),
    ]
}

/// Pixels for each unit of a drawing.
fn scale(drawing: &Drawing) -> f64 {
    let (low, high) = drawing.outline().bounds();
    let size = (high.x - low.x).max(high.y - low.y);
    (SIDE - 2.0 * MARGIN) / size.max(f64::MIN_POSITIVE)
}

fn draw(page: &mut Canvas, drawing: &Drawing, corner: [f64; 2], scale: f64) {
    let (low, high) = drawing.outline().bounds();
    let middle = [(low.x + high.x) / 2.0, (low.y + high.y) / 2.0];
    let rings: Vec<Vec<[f64; 2]>> = drawing
        .outline()
        .rings
        .iter()
        .map(|ring| {
            let all = ring.points.iter().chain(ring.points.first());
            let place = |x: &symmetrizer::geom::Point| {
                [
                    corner[0] + SIDE / 2.0 + scale * (x.x - middle[0]),
                    corner[1] + SIDE / 2.0 - scale * (x.y - middle[1]),
                ]
            };
            all.map(place).collect()
        })
        .collect();
    page.area(rings.clone(), INSIDE);
    rings.into_iter().for_each(|ring| page.path(ring, 1.0, INK));
}
