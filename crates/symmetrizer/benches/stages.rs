//! Every stage on the Stanford bunny (69,451 triangles), beside the figures of the paper:
//!
//! | bunny, 70,550 triangles, dual-core 2.4 GHz of 2007 | seconds |
//! |---|---|
//! | detection | 8.43 |
//! | contraction | 7.38 |
//! | merging | 10.63 |
//!
//! `cargo bench --workspace --bench stages`; the last lines compare one whole run with the table. The
//! model is not in the repository: see `SYMMETRIZER_DATA` in CONTRIBUTING.md.
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
use symmetrizer::shape::{ClosestPoint, Surface, io};
use symmetrizer::transform::Class;
use symmetrizer::{CancelToken, Context, Event};

#[path = "../tests/common/mod.rs"]
mod common;

/// The figures of 2007 with the stages of ours that do the same work.
const PAPER: [(&str, f64, &[&str]); 3] = [
    ("detection", 8.43, &["sample", "pair", "cluster", "patch"]),
    ("contraction", 7.38, &["contract", "contract whole"]),
    ("merging", 10.63, &["merge"]),
];

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
    compare(&bunny);
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
        Votes::new(&b.found.clouds[0].pairs, &b.found.space).clusters(&b.detect.cluster)
    });
    let clusters = Votes::new(&b.found.clouds[0].pairs, &b.found.space).clusters(&b.detect.cluster);
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

/// Seconds of each stage of one whole run, from the events that a caller hears.
fn timed_run(b: &Bunny) -> Vec<(String, f64)> {
    let mut open: Vec<(String, Instant, f64)> = Vec::new();
    let mut done = Vec::new();
    let sink = |event: Event<'_>| match event {
        Event::Begin(name) => open.push((name.to_string(), Instant::now(), 0.0)),
        Event::Progress(_) => {}
        Event::End(_) => {
            let (name, start, within) = open.pop().expect("a stage ends after it began");
            let seconds = start.elapsed().as_secs_f64();
            done.push((name, seconds - within));
            // What a stage runs inside another one counts once.
            if let Some(outer) = open.last_mut() {
                outer.2 += seconds;
            }
        }
    };
    let mut ctx = Context::with_sink(7, CancelToken::default(), sink);
    let found = detect(&b.surface, &b.detect, &mut ctx).expect("detection");
    optimize(&b.surface, &found, b.settings(), &mut ctx).expect("optimization");
    drop(ctx);
    done
}

fn compare(b: &Bunny) {
    let start = Instant::now();
    let run = timed_run(b);
    let total = start.elapsed().as_secs_f64();
    println!("\n{:<14} {:>8} {:>10}", "seconds", "here", "2007");
    for (name, paper, ours) in PAPER {
        let here: f64 = run
            .iter()
            .filter(|(stage, _)| ours.contains(&stage.as_str()))
            .map(|(_, seconds)| seconds)
            .sum();
        println!("{name:<14} {here:>8.2} {paper:>10.2}");
    }
    println!("{:<14} {total:>8.2} {:>10.2}", "all", 8.43 + 7.38 + 10.63);
    println!("(detection includes that after each merge; all includes preparation and finish)");
}
