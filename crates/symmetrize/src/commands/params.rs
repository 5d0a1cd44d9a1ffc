//! `symmetrize params`: the parameters as a file to start from.

use clap::Args;
use symmetrizer::Result;

use crate::Answer;
use crate::options::Tuning;
use crate::terminal;

/// Print all parameters with their ranges as TOML, for --params
#[derive(Args)]
pub struct ParamsArgs {
    #[command(flatten)]
    tuning: Tuning,
}

/// The verb.
pub fn params(args: &ParamsArgs) -> Result<Answer> {
    terminal::answer(&args.tuning.resolve()?.to_toml());
    Ok(Answer::Yes)
}
