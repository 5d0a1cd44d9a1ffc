//! How well drawings are made symmetric: those whose rest is known, bends of our own, and real ones.

mod bend;
mod figures;

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Deserialize;
use symmetrizer::deform::{Deformer, Igarashi, Pull};
use symmetrizer::drawing::{Reading, decode, read, write};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::wall::Wall;
use symmetrizer::straighten::When;
use symmetrizer::{Context, Drawing, Drawn, Error, Params, Result, symmetrize_drawing};

use crate::tables::{Table, number};
use crate::{Answer, data, terminal};
use bend::{Bend, bent};
use figures::{Figures, similar};

/// Measure what becomes of drawings
#[derive(clap::Args)]
pub struct Args {
    /// Drawings with this in their name only
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Where to write the results
    #[arg(long, value_name = "FOLDER")]
    write: Option<PathBuf>,
    /// Seed of all randomness
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Samples of each outline
    #[arg(long, value_name = "N", default_value_t = Params::default().sample.outline)]
    samples: usize,
    /// Drawings whose rest is known only
    #[arg(long)]
    known: bool,
    /// Undo uncertain bends, too
    #[arg(long)]
    accept_uncertain: bool,
}

/// Drawings of truth/ whose rest is known.
const KNOWN: [&str; 6] = [
    "gecko_straight",
    "gecko_bent",
    "gecko_sbend_walk",
    "beetle11_sym_bent",
    "face1_sym_bent",
    "butterfly11_sym_bent",
];

/// Bends of the straight gecko, degrees: one along the back, or two against each other.
const BENDS: [(&str, Bend); 6] = [
    ("gecko bent by 60", Bend::One(60.0)),
    ("gecko bent by 95", Bend::One(95.0)),
    ("gecko bent by 120", Bend::One(120.0)),
    ("gecko bent by 150", Bend::One(150.0)),
    ("gecko S-bent by 60", Bend::Two(60.0)),
    ("gecko S-bent by 90", Bend::Two(90.0)),
];

/// Pulls and repetitions of the interactive step.
const HANDLES: usize = 6;
const STEPS: usize = 30;

#[derive(Deserialize)]
struct Truth {
    rings: Vec<TruthRing>,
}

#[derive(Deserialize)]
struct TruthRing {
    rest: Vec<[f64; 2]>,
}

/// Runs the benchmark.
///
/// # Errors
/// Test data that is missing or damaged; those of the library.
pub fn run(args: &Args) -> Result<Answer> {
    let chosen = |name: &str| args.only.as_ref().is_none_or(|o| name.contains(o.as_str()));
    let mut table = Table::new(Figures::HEADS);
    for name in KNOWN.into_iter().filter(|name| chosen(name)) {
        let path = data::root()?.join("truth").join(format!("{name}.svg"));
        table.row(one(name, &read(&path, &Reading::default())?, &rest(name)?, args)?.cells(name));
    }
    for (name, bend) in BENDS.into_iter().filter(|(name, _)| chosen(name)) {
        let rest = rest("gecko_straight")?;
        let drawing = of_ring(&bent(&rest, bend))?;
        table.row(one(&name.replace(' ', "_"), &drawing, &rest, args)?.cells(name));
    }
    let real = if args.known { Vec::new() } else { real()? };
    for path in real {
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if !chosen(&name) {
            continue;
        }
        match read(&path, &Reading::default()) {
            Ok(drawing) => table.row(one(&name, &drawing, &[], args)?.cells(&name)),
            Err(error) => terminal::note(&error.to_string()),
        }
    }
    terminal::answer(&table.to_string());
    if chosen("gecko_bent") {
        terminal::answer(&interactive()?);
    }
    Ok(Answer::Done)
}

/// The real drawings, in order: tracings rather than their bitmaps.
fn real() -> Result<Vec<PathBuf>> {
    let folder = data::root()?.join("2d");
    let entries = std::fs::read_dir(&folder).map_err(|e| Error::io(&folder, e))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "svg"));
    paths.sort();
    Ok(paths)
}

/// The corners of a drawing at rest, in the order of its file.
fn rest(name: &str) -> Result<Vec<Point>> {
    let path = data::root()?
        .join("truth")
        .join(format!("{name}.truth.json"));
    let truth: Truth = data::json(&path)?;
    let corners = truth.rings.iter().flat_map(|r| &r.rest);
    Ok(corners.map(|[x, y]| Point::new(*x, *y, 0.0)).collect())
}

/// A drawing of one ring of corners.
fn of_ring(ring: &[Point]) -> Result<Drawing> {
    let corners: Vec<String> = ring
        .iter()
        .map(|x| format!("{},{}", 500.0 * x.x, -500.0 * x.y))
        .collect();
    let corners = corners.join(" ");
    let text = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-500 -500 1000 1000'><polygon points='{corners}'/></svg>"
    );
    decode(
        text.into_bytes(),
        symmetrizer::drawing::Format::Svg,
        &Reading::default(),
    )
}

fn one(name: &str, drawing: &Drawing, rest: &[Point], args: &Args) -> Result<Figures> {
    let mut params = Params::default();
    params.sample.outline = args.samples;
    if args.accept_uncertain {
        params.straighten.when = When::Uncertain;
    }
    let clock = Instant::now();
    let done = symmetrize_drawing(drawing, &params, &mut Context::new(args.seed))?;
    let seconds = clock.elapsed().as_secs_f64();
    if let Some(folder) = &args.write {
        std::fs::create_dir_all(folder).map_err(|e| Error::io(folder, e))?;
        let stem = Path::new(name).file_stem().unwrap_or_default();
        for format in ["svg", "png"] {
            write(&done.drawing, &folder.join(stem).with_extension(format))?;
        }
    }
    Ok(Figures {
        rms: [drawing, &done.drawing].map(|d| similar(&corners(d, rest.len()), rest)),
        seconds,
        report: report(done),
    })
}

fn report(done: Drawn) -> symmetrizer::Report {
    done.job.report
}

/// Where the corners of the file's path are, by their number on it.
fn corners(drawing: &Drawing, count: usize) -> Vec<Option<Point>> {
    let mut places = vec![None; count];
    for ring in &drawing.outline().rings {
        for (x, source) in ring.points.iter().zip(&ring.sources) {
            let Some(source) = source.filter(|s| s.t == 0.0) else {
                continue;
            };
            if let Some(place) = places.get_mut(source.segment as usize) {
                *place = Some(*x);
            }
        }
    }
    places
}

/// The time of a step of deformation: six handles on the gecko's outline, the pulls other ones each time.
fn interactive() -> Result<String> {
    let path = data::root()?.join("truth/gecko_bent.svg");
    let drawing = read(&path, &Reading::default())?;
    let rings: Vec<Vec<Point>> = drawing
        .outline()
        .rings
        .iter()
        .map(|r| r.points.clone())
        .collect();
    let wall = Wall::new(&rings)?;
    let mut body = Igarashi::new(wall.clone())?;
    let mut ctx = Context::new(0);
    let mut times = Vec::new();
    for step in 0..STEPS {
        let pull = |k: usize| {
            let at = wall.at(0, wall.length(0) * k as f64 / HANDLES as f64);
            let way = 0.02 * f64::sin((k + step) as f64);
            Pull {
                at,
                target: wall.surface.point(&at) + Vector::new(way, way, 0.0),
                weight: 0.01,
            }
        };
        let pulls: Vec<Pull> = (0..HANDLES).map(pull).collect();
        let clock = Instant::now();
        body.deform(&pulls, &mut ctx)?;
        times.push(clock.elapsed().as_secs_f64() * 1e3);
    }
    let first = times[0];
    times.sort_by(f64::total_cmp);
    Ok(format!(
        "a step of six handles on the gecko ({} triangles): {} ms, median of {STEPS}; the first, which factorises, {} ms; the worst {} ms\n",
        body.sheet().surface.triangles.len(),
        number(Some(times[STEPS / 2]), 1),
        number(Some(first), 1),
        number(Some(times[STEPS - 1]), 1),
    ))
}
