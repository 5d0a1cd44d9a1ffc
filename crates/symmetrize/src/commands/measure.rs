//! `symmetrize measure`: how symmetric a shape is, and how far from its original.

use std::path::PathBuf;

use clap::Args;
use symmetrizer::Result;
use symmetrizer::report::MeasureReport;

use crate::Answer;
use crate::files::{ReportFile, check_distinct, commit};
use crate::input::{self, Bitmaps, Input};
use crate::options::Desk;
use crate::summary;

/// Measure how far a shape is from symmetric
///
/// Asymmetry is the distance of the mirrored surface from the surface, over 20,000 samples and the
/// plane that minimises its mean, in percent of the bounding-box diagonal D.
#[derive(Args)]
pub struct MeasureArgs {
    #[arg(help = input::HELP)]
    input: Input,
    /// Also measure the distortion from this shape, which has the same vertices and faces
    #[arg(long, value_name = "ORIGINAL")]
    against: Option<Input>,
    #[command(flatten)]
    bitmaps: Bitmaps,
    /// Write everything in figures here, as JSON
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

/// The verb.
pub fn measure(args: &MeasureArgs, desk: &Desk) -> Result<Answer> {
    let path = args.report.as_deref();
    for input in std::iter::once(&args.input).chain(&args.against) {
        check_distinct(input.path(), &[], path.as_slice())?;
    }
    let file = path.map(ReportFile::reserve).transpose()?;
    let mut ctx = desk.context();
    let input = args.input.subject(&args.bitmaps, &mut ctx)?;
    let original = args.against.as_ref();
    let original = original.map(|i| i.subject(&args.bitmaps, &mut ctx));
    let original = original.transpose()?;
    let measured = input.measure(original.as_ref(), &mut ctx);
    let (mesh, measured) = measured.map_err(|e| args.input.blame(e))?;
    let mut report = MeasureReport::new(&mesh, &measured, &ctx);
    report.input.file = Some(args.input.name());
    report.against = args.against.as_ref().map(Input::name);
    if let Some(file) = file {
        report.run = Some(desk.progress.report());
        commit([file.write(&report)?])?;
    }
    desk.say(&text(&report));
    Ok(Answer::Yes)
}

fn text(report: &MeasureReport) -> String {
    let mut text = summary::shape(&report.input) + "\n";
    if let Some(a) = &report.input.asymmetry {
        text += &summary::asymmetry(&[("", Some(a))]);
        text += &format!("plane        {}\n", summary::plane(&a.plane));
        for near in &a.also_near {
            let plane = summary::plane(&near.plane);
            text += &format!("nearly as good {plane}, mean {:.3}\n", near.mean);
        }
    }
    if let Some(d) = &report.distortion {
        text += &summary::distortion(d);
    }
    text
}
