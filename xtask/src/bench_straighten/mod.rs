//! How well bent shapes are straightened whose rest is known.

mod bends;
mod time;

use std::time::Instant;

use serde::Deserialize;
use symmetrizer::detect::detect;
use symmetrizer::field::grow::Land;
use symmetrizer::field::{Mirrors, Reach, SymmetryField, candidates};
use symmetrizer::geom::{Matrix3, Point, Vector, nearest_orthogonal};
use symmetrizer::sample::Samples;
use symmetrizer::shape::working::Working;
use symmetrizer::shape::{ClosestPoint, io};
use symmetrizer::straighten::{Bend, straighten};
use symmetrizer::{Context, Mesh, Params, Result};

use crate::tables::{Table, number};
use crate::{Answer, data, terminal};

/// Measure straightening on shapes whose rest is known
#[derive(clap::Args)]
pub struct Args {
    /// Shapes with this in their name only
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Shapes that are bent here, instead of those of the test data
    #[arg(long)]
    bends: bool,
    /// Where to write the straightened shapes
    #[arg(long, value_name = "FOLDER")]
    write: Option<std::path::PathBuf>,
}

const SHAPES: [&str; 7] = [
    "cow_bend45",
    "cow_sbend_noise",
    "homer_twist40",
    "spot_headturn30",
    "human_rest_arm_spine",
    "cheburashka_headturn_ear",
    "spot_exact",
];

#[derive(Deserialize)]
struct Truth {
    file: String,
    rest: Option<Vec<[f64; 3]>>,
    partner: Option<Vec<[f64; 3]>>,
}

/// Runs the benchmark.
///
/// # Errors
/// Test data that is missing or damaged; those of the stages.
pub fn run(args: &Args) -> Result<Answer> {
    if args.bends {
        terminal::answer(&bends::table(args.only.as_ref())?.to_string());
        return Ok(Answer::Done);
    }
    let mut table = Table::new([
        "shape",
        "score",
        "bend",
        "cover",
        "right to 1 %",
        "2 %",
        "rms before",
        "after",
        "detect s",
        "look s",
        "straighten s",
    ]);
    for name in SHAPES {
        if args
            .only
            .as_ref()
            .is_some_and(|o| !name.contains(o.as_str()))
        {
            continue;
        }
        table.row(one(name, args)?);
    }
    terminal::answer(&table.to_string());
    if args.only.is_none() {
        terminal::answer(&time::table()?.to_string());
    }
    Ok(Answer::Done)
}

/// What is found on a mesh.
struct Looked {
    working: Working,
    samples: Samples,
    bend: Option<Bend>,
    field: SymmetryField,
    /// Of the straightened working surface.
    straight: Vec<Point>,
    /// Of detection, looking for the bend and straightening.
    seconds: [f64; 3],
}

impl Looked {
    /// Straightened, for each vertex of the file.
    fn positions(&self) -> Vec<Point> {
        let vertices = self.working.vertex_of_document.iter();
        let at = |v: &Option<u32>| v.map_or(Point::origin(), |v| self.straight[v as usize]);
        vertices.map(at).collect()
    }
}

fn look(mesh: &Mesh) -> Result<Looked> {
    let working = Working::new(mesh)?;
    let mut ctx = Context::new(0);
    let mut clock = Instant::now();
    let mut lap = || {
        let s = clock.elapsed().as_secs_f64();
        clock = Instant::now();
        s
    };
    let params = Params::default().detect().mirrors_only();
    let found = detect(&working.surface, &params, &mut ctx)?;
    let detected = lap();
    let closest = ClosestPoint::new(&working.surface);
    let reach = Reach::new(&found.samples, 0.12);
    let land = Land::new(&working.surface, &closest, &found.samples, &reach);
    let mirrors = Mirrors::from(&found);
    let bend = Bend::find(&land, &mirrors, &mut ctx)?;
    let looked = lap();
    let (field, straight) = match &bend {
        Some(bend) => (bend.settled.clone(), straighten(&land, bend)?.positions),
        None => (
            candidates(&land, &mirrors, &ctx)?.swap_remove(0),
            working.surface.positions.clone(),
        ),
    };
    let seconds = [detected, looked, lap()];
    drop(land);
    Ok(Looked {
        samples: found.samples,
        working,
        bend,
        field,
        straight,
        seconds,
    })
}

fn one(name: &str, args: &Args) -> Result<[String; 11]> {
    let folder = data::root()?.join("truth");
    let truth: Truth = data::json(&folder.join(format!("{name}.truth.json")))?;
    let mut document = io::read(&folder.join(&truth.file))?;
    let looked = look(&document.mesh)?;
    let right = truth
        .partner
        .map(|partner| right(&partner, &looked.working, &looked.samples, &looked.field));
    let rest: Option<Vec<Point>> = truth
        .rest
        .map(|r| r.iter().map(|x| Point::from(*x)).collect());
    let rms = |x: &[Point]| rest.as_ref().map(|rest| similar(x, rest));
    let before = rms(&document.mesh.positions);
    let moved = looked.positions();
    let after = rms(&moved);
    if let Some(folder) = &args.write {
        document.mesh.positions = moved;
        std::fs::create_dir_all(folder).map_err(|e| symmetrizer::Error::io(folder, e))?;
        io::write(&document, &folder.join(&truth.file))?;
    }
    let [detected, sought, straightened] = looked.seconds.map(|s| number(Some(s), 2));
    let bend = looked.bend.as_ref();
    Ok([
        name.into(),
        number(bend.map(|b| b.trust.score()), 2),
        number(bend.map(|b| b.degrees), 0),
        number(Some(looked.field.cover()), 3),
        number(right.map(|r| r[0]), 3),
        number(right.map(|r| r[1]), 3),
        number(before, 3),
        number(after, 3),
        detected,
        sought,
        straightened,
    ])
}

/// The share of all samples whose partner lies within 1 and 2 % of D of the true one.
fn right(
    partner: &[[f64; 3]],
    working: &Working,
    samples: &Samples,
    field: &SymmetryField,
) -> [f64; 2] {
    let to = &working.normalization;
    let truth: Vec<Point> = partner
        .iter()
        .map(|x| to.to_working(&Point::from(*x)))
        .collect();
    let s = &working.surface;
    let low = s
        .positions
        .iter()
        .fold(s.positions[0], |a, b| Point::from(a.coords.inf(&b.coords)));
    let high = s
        .positions
        .iter()
        .fold(s.positions[0], |a, b| Point::from(a.coords.sup(&b.coords)));
    let d = (high - low).norm();
    let missed: Vec<f64> = samples
        .list
        .iter()
        .zip(&field.partners)
        .map(|(sample, partner)| {
            let corners = s.triangles[sample.at.face as usize];
            let at = |v: u32| truth[working.document_of_vertex[v as usize] as usize].coords;
            let wanted = corners
                .iter()
                .zip(sample.at.bary)
                .map(|(&v, b)| at(v) * b)
                .sum::<Vector>();
            partner.map_or(f64::INFINITY, |p| (p.position.coords - wanted).norm() / d)
        })
        .collect();
    [0.01, 0.02]
        .map(|near| missed.iter().filter(|m| **m <= near).count() as f64 / missed.len() as f64)
}

/// rms distance to `rest` after the best similarity, % of its diagonal; mirrored allowed.
fn similar(x: &[Point], rest: &[Point]) -> f64 {
    [false, true]
        .map(|mirrored| aligned(x, rest, mirrored))
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

fn aligned(x: &[Point], rest: &[Point], mirrored: bool) -> f64 {
    let n = x.len() as f64;
    let mean = |p: &[Point]| p.iter().map(|p| p.coords).sum::<Vector>() / n;
    let (mx, mr) = (mean(x), mean(rest));
    let pairs = || {
        x.iter()
            .zip(rest)
            .map(|(p, q)| (p.coords - mx, q.coords - mr))
    };
    let h: Matrix3 = pairs().map(|(p, q)| q * p.transpose()).sum();
    let r = nearest_orthogonal(&h, mirrored);
    let scale = h.dot(&r) / pairs().map(|(p, _)| p.norm_squared()).sum::<f64>();
    let missed: f64 = pairs()
        .map(|(p, q)| (scale * (r * p) - q).norm_squared())
        .sum();
    let low = rest
        .iter()
        .fold(rest[0], |a, b| Point::from(a.coords.inf(&b.coords)));
    let high = rest
        .iter()
        .fold(rest[0], |a, b| Point::from(a.coords.sup(&b.coords)));
    100.0 * (missed / n).sqrt() / (high - low).norm()
}
