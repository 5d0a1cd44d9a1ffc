//! The command `symmetrize`: makes shapes symmetric. Each verb is a file in `commands/`.

mod commands;
mod files;
mod input;
mod options;
mod progress;
mod summary;
mod terminal;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use symmetrizer::{CancelToken, Error, Result};

use crate::options::{Common, Desk};

/// Finds the approximate symmetries of a 3D shape and deforms it until they are exact
#[derive(Parser)]
#[command(version, max_term_width = 100, after_help = EXIT_CODES)]
struct Cli {
    #[command(flatten)]
    common: Common,
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    Run(commands::run::RunArgs),
    /// Undo a bend or a twist, and nothing else
    ///
    /// Finds mirrors that vary along the shape, judges whether they are there, and turns the shape, place by
    /// place, until they are one. What is asymmetric besides stays so.
    Straighten(commands::run::RunArgs),
    Detect(commands::detect::DetectArgs),
    Plot(commands::plot::PlotArgs),
    Measure(commands::measure::MeasureArgs),
    Validate(commands::validate::ValidateArgs),
    Render(commands::render::RenderArgs),
    Convert(commands::convert::ConvertArgs),
    Params(commands::params::ParamsArgs),
}

const EXIT_CODES: &str = "Exit codes: 0 done; 1 no symmetry found, or a file that a run refuses; 2 bad input, parameters or \
paths; 3 numerical failure; 130 cancelled. Output files appear whole or not at all.";

/// The answer to the question of a verb.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// Done.
    Yes,
    /// There is no symmetry, or a run would refuse the file.
    No,
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    match answer(&cli) {
        Ok(Answer::Yes) => ExitCode::SUCCESS,
        Ok(Answer::No) => ExitCode::from(1),
        Err(error) => {
            terminal::error(&error);
            ExitCode::from(code(&error))
        }
    }
}

fn answer(cli: &Cli) -> Result<Answer> {
    let desk = Desk::new(&cli.common, cancel_on_signal()?)?;
    match &cli.verb {
        Verb::Run(args) => commands::run::run(args, &desk),
        Verb::Straighten(args) => commands::run::straighten(args, &desk),
        Verb::Detect(args) => commands::detect::detect(args, &desk),
        Verb::Plot(args) => commands::plot::plot(args, &desk),
        Verb::Measure(args) => commands::measure::measure(args, &desk),
        Verb::Validate(args) => commands::validate::validate(args, &desk),
        Verb::Render(args) => commands::render::render(args, &desk),
        Verb::Convert(args) => commands::convert::convert(args, &desk),
        Verb::Params(args) => commands::params::params(args),
    }
}

/// A token that Ctrl-C sets, as does a polite request to terminate: the work then stops at its
/// next step and every reserved file is taken back on the way out.
fn cancel_on_signal() -> Result<CancelToken> {
    let cancel = CancelToken::default();
    let token = cancel.clone();
    ctrlc::set_handler(move || token.cancel())
        .map_err(|e| Error::Unsupported(format!("cannot listen for Ctrl-C: {e}")))?;
    Ok(cancel)
}

fn code(error: &Error) -> u8 {
    match error {
        Error::Numerical { .. } => 3,
        Error::Cancelled => 130,
        _ => 2,
    }
}
