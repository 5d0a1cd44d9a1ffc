//! How fast the deformers are, beside a peer on the same work: a bend of the bunny's upper part, held at
//! scattered vertices, at three resolutions.

pub mod clock;
mod peer;
mod work;

use std::path::PathBuf;

use symmetrizer::deform::{DeformParams, Model, deformer, relax, relax::total};
use symmetrizer::shape::io;
use symmetrizer::{Context, Mesh, Result};

use crate::bench_detect::time::divided;
use crate::tables::{Table, number};
use crate::{Answer, data, terminal};
use clock::Clock;
use work::Work;

/// Measure deformation on the bunny
#[derive(clap::Args)]
pub struct Args {
    /// Runs of which the median counts
    #[arg(long, value_name = "N", default_value_t = 5)]
    runs: usize,
    /// A program that is called as `PROGRAM deform MESH.off CONSTRAINTS.txt METHOD RUNS ""` and prints its times as
    /// lines of JSON with task, tool and cpu_min (seconds)
    #[arg(long, value_name = "PROGRAM")]
    peer: Option<PathBuf>,
    /// Measure growth to 1,100,000 triangles instead
    #[arg(long)]
    growth: bool,
    /// Where to write meshes and constraints, for other peers
    #[arg(long, value_name = "FOLDER")]
    write: Option<PathBuf>,
}

/// Resolutions, in triangles, with the number of vertices that are held; 0 is the bunny as it is.
const WORKS: [(usize, usize); 3] = [(0, 2000), (25_000, 2000), (5_000, 400)];
/// How near to the converged total counts as there.
const NEAR: f64 = 0.01;

/// Columns of the table.
const HEADS: [&str; 7] = [
    "triangles",
    "deformer",
    "set-up s",
    "steps",
    "to 1 % s",
    "both s",
    "CPU s",
];

/// Runs the benchmark.
///
/// # Errors
/// Test data that is missing or damaged; those of deformation.
pub fn run(args: &Args) -> Result<Answer> {
    let bunny = data::root()?.join("3d/bunny.obj");
    let mesh = io::read(&bunny)?.mesh;
    if args.growth {
        return growth(mesh, args.runs);
    }
    let mut table = Table::new(HEADS);
    for (triangles, held) in WORKS {
        let work = Work::new(&mesh, triangles, held)?;
        for model in [Model::Primo, Model::Arap] {
            table.row(ours(&work, model, args.runs)?);
        }
        if let Some(folder) = &args.write {
            work.write(folder)?;
        }
        if let Some(program) = &args.peer {
            for row in peer::rows(program, &work, args.runs)? {
                table.row(row);
            }
        }
    }
    terminal::answer(&table.to_string());
    Ok(Answer::Done)
}

/// The same on ever finer copies of the bunny, 2,000 vertices held, PriMo on at most 100,000 prisms.
fn growth(mut mesh: Mesh, runs: usize) -> Result<Answer> {
    let mut table = Table::new(HEADS);
    for (triangles, divide) in [(10_000, false), (0, false), (0, true), (0, true)] {
        if divide {
            mesh = divided(&mesh);
        }
        let work = Work::new(&mesh, triangles, 2000)?;
        for model in [Model::Primo, Model::Arap] {
            table.row(ours(&work, model, runs)?);
        }
    }
    terminal::answer(&table.to_string());
    Ok(Answer::Done)
}

/// Medians of set-up and of the steps until the total is within 1 % of what it converges to.
fn ours(work: &Work, model: Model, runs: usize) -> Result<[String; 7]> {
    let params = DeformParams {
        model,
        control_faces: 100_000,
        ..DeformParams::default()
    };
    let mut ctx = Context::new(0);
    let mut settled = deformer(&work.surface, &params)?;
    let goal = relax(settled.as_mut(), &work.pulls, 1e-7, &mut ctx)?.total * (1.0 + NEAR);
    let mut times = Vec::new();
    let mut steps = 0;
    for _ in 0..runs {
        let clock = Clock::start();
        let mut deformer = deformer(&work.surface, &params)?;
        let set_up = clock.wall();
        steps = 0;
        loop {
            let energy = deformer.deform(&work.pulls, &mut ctx)?.energy;
            steps += 1;
            if total(deformer.as_ref(), &work.pulls, energy) <= goal {
                break;
            }
        }
        times.push([set_up, clock.wall(), clock.cpu()]);
    }
    times.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let [set_up, both, cpu] = times[times.len() / 2];
    let seconds = |s| number(Some(s), 3);
    Ok([
        work.surface.triangles.len().to_string(),
        format!("{model:?}"),
        seconds(set_up),
        steps.to_string(),
        seconds(both - set_up),
        seconds(both),
        seconds(cpu),
    ])
}
