//! `symmetrize params`: the parameters as a file to start from.

use clap::Args;
use symmetrizer::Result;

use crate::Answer;
use crate::options::{Desk, Tuning};

/// Print all parameters as TOML, for --params
#[derive(Args)]
pub struct ParamsArgs {
    #[command(flatten)]
    tuning: Tuning,
}

/// The verb.
pub fn params(args: &ParamsArgs, desk: &Desk) -> Result<Answer> {
    desk.say(&args.tuning.resolve()?.to_toml());
    Ok(Answer::Yes)
}
