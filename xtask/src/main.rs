//! What developers of this repository run: `cargo xtask VERB`. Each verb is a module.

mod bench_deform;
mod bench_detect;
mod bench_plane;
mod bench_straighten;
mod constraints;
mod data;
mod gallery_deform;
mod gallery_plane;
mod tables;
mod terminal;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Benchmarks on real models
#[derive(Parser)]
#[command(name = "cargo xtask", max_term_width = 100, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    BenchDeform(bench_deform::Args),
    BenchDetect(bench_detect::Args),
    BenchPlane(bench_plane::Args),
    BenchStraighten(bench_straighten::Args),
    GalleryDeform(gallery_deform::Args),
    GalleryPlane(gallery_plane::Args),
}

const EXIT_CODES: &str =
    "Exit codes: 0 done; 1 a goal is missed (with --check); 2 bad arguments, or no test data.";

/// How a verb ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// Done.
    Done,
    /// Done, but a goal that was to be checked is missed.
    Missed,
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    let answer = match &cli.verb {
        Verb::BenchDeform(args) => bench_deform::run(args),
        Verb::BenchDetect(args) => bench_detect::run(args),
        Verb::BenchPlane(args) => bench_plane::run(args),
        Verb::BenchStraighten(args) => bench_straighten::run(args),
        Verb::GalleryDeform(args) => gallery_deform::run(args),
        Verb::GalleryPlane(args) => gallery_plane::run(args),
    };
    match answer {
        Ok(Answer::Done) => ExitCode::SUCCESS,
        Ok(Answer::Missed) => ExitCode::from(1),
        Err(error) => {
            terminal::note(&format!("error: {error}"));
            ExitCode::from(2)
        }
    }
}
