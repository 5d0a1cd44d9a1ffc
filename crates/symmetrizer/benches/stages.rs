//! Every stage on the Stanford bunny (69,451 triangles), and whole runs beside the table of the paper.
//!
//! `cargo bench --workspace --bench stages`; the last lines compare. The models are not in the repository: see
//! `SYMMETRIZER_DATA` in CONTRIBUTING.md.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion};
use symmetrizer::apply::measure::asymmetry;
use symmetrizer::cluster::Votes;
use symmetrizer::deform::DeformParams;
use symmetrizer::deform::{Deformer, Primo};
use symmetrizer::detect::{DetectParams, Detection, detect};
use symmetrizer::optimize::moving::{Moving, guided_couples};
use symmetrizer::optimize::params::OptimizeParams;
use symmetrizer::optimize::schedule::{Settings, optimize};
use symmetrizer::pair::mirror_pairs;
use symmetrizer::patch::{Candidate, Ground, grow_patch};
use symmetrizer::sample::sample;
use symmetrizer::sample::samples::Describer;
use symmetrizer::shape::working::Working;
use symmetrizer::shape::{ClosestPoint, Mesh, Surface, io};
use symmetrizer::transform::Class;
use symmetrizer::{CancelToken, Context, Event, Params, symmetrize};

#[path = "../tests/common/mod.rs"]
mod common;

/// A row of the paper's table (section 5): triangles, and seconds of detection, contraction and merging, on a dual-core
/// of 2007.
struct Row {
    model: &'static str,
    file: &'static str,
    triangles: usize,
    paper: [Option<f64>; 3],
}

const PAPER: [Row; 4] = [
    Row {
        model: "bunny",
        file: "3d/bunny.obj",
        triangles: 70_550,
        paper: [Some(8.43), Some(7.38), Some(10.63)],
    },
    Row {
        model: "dragon",
        file: "3d/dragon.ply",
        triangles: 64_378,
        paper: [Some(36.03), Some(22.57), Some(34.66)],
    },
    Row {
        model: "face",
        file: "3d/face_igea.ply",
        triangles: 34_889,
        paper: [Some(4.48), Some(3.58), None],
    },
    Row {
        model: "design",
        file: "truth/design_six.obj",
        triangles: 3_380,
        paper: [Some(4.12), Some(2.56), None],
    },
];

/// Stages of ours that do the work of merging, bends among it, and those of detection; all else but measuring is
/// contraction.
const MERGING: [&str; 3] = ["merge", "bend", "straighten"];
const DETECTION: [&str; 11] = [
    "detect", "sample", "slip", "probe", "pair", "cluster", "patch", "again", "complete", "round",
    "whole",
];
/// What only tells how far it got: measuring, and the symmetries of the result.
const CHECKING: [&str; 3] = ["measure", "measure again", "detect again"];

fn main() {
    let Some(path) = common::data("3d/bunny.obj") else {
        eprintln!("NOTHING MEASURED: the bunny is missing");
        return;
    };
    let mut c = Criterion::default()
        .sample_size(10)
        .measurement_time(Duration::from_secs(3))
        .configure_from_args();
    let bunny = Bunny::new(&path);
    reading(&mut c, &path);
    detection(&mut c, &bunny);
    deformation(&mut c, &bunny);
    c.final_summary();
    compare();
}

/// What the later stages start from.
struct Bunny {
    surface: Surface,
    diagonal: f64,
    found: Detection,
    detect: DetectParams,
    deform: DeformParams,
    optimize: OptimizeParams,
}

impl Bunny {
    fn new(path: &Path) -> Self {
        let (working, diagonal) = common::working(&common::load(path));
        let surface = working.surface;
        let params = DetectParams::default().mirrors_only();
        Self {
            found: detect(&surface, &params, &mut Context::new(7)).expect("detection"),
            surface,
            diagonal,
            detect: params,
            deform: DeformParams::default(),
            optimize: OptimizeParams::default(),
        }
    }

    fn settings(&self) -> Settings<'_> {
        Settings {
            wall: None,
            region: None,
            part: false,
            stiffness: None,
            detect: &self.detect,
            deform: &self.deform,
            optimize: &self.optimize,
        }
    }
}

/// Measures `work` under the stage's name.
fn stage<T>(c: &mut Criterion, name: &str, mut work: impl FnMut() -> T) {
    c.bench_with_input(BenchmarkId::new("bunny", name), &(), |b, ()| {
        b.iter(|| black_box(work()));
    });
}

fn reading(c: &mut Criterion, path: &Path) {
    stage(c, "read OBJ", || io::read(path).expect("the bunny"));
    let mesh = common::load(path);
    stage(c, "working surface", || Working::new(&mesh));
}

fn detection(c: &mut Criterion, b: &Bunny) {
    let new = || Context::new(7);
    stage(c, "sample", || {
        sample(
            &Describer::new(&b.surface, 1.0),
            &b.detect.sample,
            &mut new(),
        )
    });
    stage(c, "pair", || {
        mirror_pairs(&b.found.samples, None, &b.detect.pair, &mut new())
    });
    stage(c, "cluster", || {
        Votes::new(&b.found.clouds[0].pairs, &b.found.space, 3).clusters(&b.detect.cluster)
    });
    let clusters =
        Votes::new(&b.found.clouds[0].pairs, &b.found.space, 3).clusters(&b.detect.cluster);
    let closest = ClosestPoint::new(&b.surface);
    let describer = Describer::new(&b.surface, 1.0);
    let ground = Ground {
        surface: &b.surface,
        closest: &closest,
        samples: &b.found.samples,
    };
    stage(c, "patch of the highest cluster", || {
        let pairs = &b.found.clouds[0].pairs;
        let (space, patch) = (&b.found.space, &b.detect.patch);
        let (samples, mirror) = (&b.found.samples, Class::Mirror);
        let candidate = Candidate::of_cluster(samples, pairs, &clusters[0], mirror, space);
        grow_patch(&ground, &describer, &candidate, patch)
    });
    stage(c, "detect mirrors", || {
        detect(&b.surface, &b.detect, &mut new())
    });
    stage(c, "detect all kinds", || {
        detect(&b.surface, &DetectParams::default(), &mut new())
    });
}

fn deformation(c: &mut Criterion, b: &Bunny) {
    stage(c, "prepare PriMo", || Primo::new(&b.surface, &b.deform));
    let mut deformer = Primo::new(&b.surface, &b.deform).expect("prisms");
    let rest = deformer.state();
    let mut moving = Moving {
        deformer: &mut deformer,
        samples: b.found.samples.clone(),
        length: b.deform.length,
        step: b.optimize.step,
        closest: ClosestPoint::new(&b.surface),
    };
    let patch = &b.detect.patch;
    let plane = b.found.symmetries[0].plane();
    let snapshot = moving.snapshot();
    let couples = guided_couples(&snapshot, &plane, patch.tolerance, patch.min_cos, |_| true);
    stage(c, "one contraction step", || {
        moving.deformer.restore(&rest);
        moving.contract_step(&couples, &mut Context::new(7))
    });
    stage(c, "optimize, all of it", || {
        optimize(&b.surface, &b.found, b.settings(), &mut Context::new(7))
    });
    stage(c, "measure", || {
        asymmetry(&b.surface, b.diagonal, &[], &Context::new(7))
    });
}

/// Own seconds of each stage of one whole run, from the events that a caller hears, and of what it does between them.
fn timed_run(mesh: &Mesh) -> Vec<(String, f64)> {
    let all = Instant::now();
    let mut open: Vec<(String, Instant, f64)> = Vec::new();
    let mut done = Vec::new();
    let sink = |event: Event<'_>| match event {
        Event::Begin(name) => open.push((name.to_string(), Instant::now(), 0.0)),
        Event::Progress(_) => {}
        Event::End(_) => {
            let (name, start, within) = open.pop().expect("a stage ends after it began");
            let seconds = start.elapsed().as_secs_f64();
            let checking = open.iter().find(|o| CHECKING.contains(&o.0.as_str()));
            let counted = checking.map_or(name, |outer| outer.0.clone());
            done.push((counted, seconds - within));
            // What a stage runs inside another one counts once.
            if let Some(outer) = open.last_mut() {
                outer.2 += seconds;
            }
        }
    };
    let mut ctx = Context::with_sink(7, CancelToken::default(), sink);
    symmetrize(mesh, &Params::default(), &mut ctx).expect("a run");
    drop(ctx);
    let counted: f64 = done.iter().map(|(_, seconds)| seconds).sum();
    done.push(("between".into(), all.elapsed().as_secs_f64() - counted));
    done
}

fn compare() {
    println!(
        "\n{:<8} {:>9} {:>24} {:>24} {:>24} {:>9}",
        "seconds", "triangles", "detection", "contraction", "merging", "checking"
    );
    for row in PAPER {
        let Some(path) = common::data(row.file) else {
            continue;
        };
        let mesh = common::load(&path);
        let run = timed_run(&mesh);
        let of = |names: &[&str]| {
            let stages = run
                .iter()
                .filter(|(stage, _)| names.contains(&stage.as_str()));
            stages.map(|(_, seconds)| seconds).sum::<f64>()
        };
        let all: f64 = run.iter().map(|(_, seconds)| seconds).sum();
        let (detection, merging) = (of(&DETECTION), of(&MERGING));
        let checking = of(&CHECKING);
        let ours = [detection, all - detection - merging - checking, merging];
        let cells = ours.iter().zip(row.paper).map(|(here, paper)| match paper {
            Some(paper) => format!("{here:>7.2} (2007: {paper:>6.2})"),
            None => format!("{here:>7.2} (2007:      -)"),
        });
        let cells: Vec<String> = cells.collect();
        println!(
            "{:<8} {:>9} {} {checking:>9.2}",
            row.model,
            row.triangles,
            cells.join("   ")
        );
    }
    println!(
        "(contraction includes the finish and what is done between stages, merging the undoing of bends; checking: measuring, \
         and the symmetries of the result)"
    );
}
