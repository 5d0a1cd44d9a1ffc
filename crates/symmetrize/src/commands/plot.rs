//! `symmetrize plot`: the density of votes in transformation space.

use std::path::PathBuf;

use clap::Args;
use symmetrizer::Result;
use symmetrizer::job::pictures;

use crate::Answer;
use crate::files::{PictureFile, check_distinct, commit};
use crate::input::{self, Bitmaps, Input};
use crate::options::{Desk, Sought, Tuning};

/// Plot the votes for symmetries in transformation space
///
/// A plot for each class of isometries that is looked for shows the two main axes of its votes, in which
/// distances are displacements as fractions of the scale L. Symmetries are marked by their ids, as
/// `detect` lists them; the highest clusters that are no symmetries in grey.
#[derive(Args)]
pub struct PlotArgs {
    #[arg(help = input::HELP)]
    input: Input,
    /// Write the plot here (png, svg)
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    bitmaps: Bitmaps,
    #[command(flatten)]
    sought: Sought,
    #[command(flatten)]
    tuning: Tuning,
}

/// The verb.
pub fn plot(args: &PlotArgs, desk: &Desk) -> Result<Answer> {
    let mut params = args.tuning.resolve()?;
    args.sought.narrow(&mut params)?;
    check_distinct(args.input.path(), &[], &[&args.output])?;
    let file = PictureFile::reserve(&args.output)?;
    let mut ctx = desk.context();
    let input = args.input.subject(&args.bitmaps, &mut ctx)?;
    let found = input.detect(&params, &mut ctx);
    let (_, found) = found.map_err(|e| args.input.blame(e))?;
    let title = args.input.title();
    let complete = ctx.stage("picture", |_| {
        file.write(&pictures::density(&found, params.cluster.bandwidth, &title))
    })?;
    ctx.check()?;
    commit([complete])?;
    for cloud in 0..found.detection.clouds.len() {
        desk.say(&format!("{}\n", pictures::plot_title(&found, cloud)));
    }
    desk.say(&format!("wrote {}\n", args.output.display()));
    Ok(Answer::Yes)
}
