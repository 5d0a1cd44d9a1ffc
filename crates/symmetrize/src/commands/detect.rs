//! `symmetrize detect`: the symmetries of a shape, nothing moved.

use std::path::PathBuf;

use clap::Args;
use symmetrizer::Result;
use symmetrizer::job::pictures;
use symmetrizer::report::DetectReport;

use crate::Answer;
use crate::files::{PictureFile, ReportFile, check_distinct, commit};
use crate::input::{self, Bitmaps, Input};
use crate::options::{Desk, Sought, Tuning};
use crate::summary;

/// List the symmetries of a shape and of its parts
///
/// Mirrors, rotations, translations, screws, glides, rotoreflections and inversions, groups of them, and
/// parts that slide along themselves. Nothing is moved.
#[derive(Args)]
pub struct DetectArgs {
    #[arg(help = input::HELP)]
    input: Input,
    /// Write the symmetries with their faces and pairs here, as JSON
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Draw what was found here, patch and image of each in one colour (png, svg)
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    #[command(flatten)]
    bitmaps: Bitmaps,
    #[command(flatten)]
    sought: Sought,
    #[command(flatten)]
    tuning: Tuning,
}

/// The verb.
pub fn detect(args: &DetectArgs, desk: &Desk) -> Result<Answer> {
    let mut params = args.tuning.resolve()?;
    args.sought.narrow(&mut params)?;
    let (report, picture) = (args.report.as_deref(), args.picture.as_deref());
    let paths: Vec<_> = report.into_iter().chain(picture).collect();
    check_distinct(args.input.path(), &[], &paths)?;
    let report_file = report.map(ReportFile::reserve).transpose()?;
    let picture_file = picture.map(PictureFile::reserve).transpose()?;
    let mut ctx = desk.context();
    let input = args.input.subject(&args.bitmaps, &mut ctx)?;
    let found = input.detect(&params, &mut ctx);
    let (mesh, found) = found.map_err(|e| args.input.blame(e))?;
    let mut complete = Vec::new();
    if let Some(file) = picture_file {
        let draw = || file.write(&pictures::symmetries(&found, &args.input.title()));
        complete.push(ctx.stage("picture", |_| draw())?);
    }
    let mut report = DetectReport::new(&mesh, &found, &params, &ctx);
    report.input.shape.file = Some(args.input.name());
    if let Some(file) = report_file {
        report.run = Some(desk.progress.report());
        complete.push(file.write(&report)?);
    }
    ctx.check()?;
    commit(complete)?;
    desk.say(&summary::shape(&report.input.shape));
    desk.say("\n");
    desk.say(&summary::symmetries(&report.input, true));
    let none = found.symmetries().is_empty() && found.detection.continuous.is_empty();
    Ok(if none { Answer::No } else { Answer::Yes })
}
