//! `symmetrize render`: views of a shape on one sheet.

use std::path::PathBuf;

use clap::Args;
use symmetrizer::Result;
use symmetrizer::job::pictures::{Shown, VIEW_SIZE, measured_views};
use symmetrizer::picture::Angle;

use crate::Answer;
use crate::files::{PictureFile, check_distinct, commit};
use crate::input::{self, Bitmaps, Input};
use crate::options::Desk;

/// Draw views of a shape side by side
///
/// The shape stands as its mirror plane says: front is where the plane is seen edge-on.
#[derive(Args)]
pub struct RenderArgs {
    #[arg(help = input::HELP)]
    input: Input,
    /// Write the sheet here (png, svg)
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
    /// Views from left to right: front, three-quarter, side, back, top
    #[arg(long, value_name = "VIEWS", value_delimiter = ',', value_parser = angle, default_values = ["front", "three-quarter", "side"])]
    views: Vec<Angle>,
    /// Width and height of one view in pixels, say 640x480
    #[arg(long, value_name = "SIZE", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Colour the shape by its asymmetry
    #[arg(long)]
    asymmetry: bool,
    /// Draw the mirror plane
    #[arg(long)]
    plane: bool,
    /// A line above the views [default: the input's name; empty for none]
    #[arg(long)]
    title: Option<String>,
    #[command(flatten)]
    bitmaps: Bitmaps,
}

/// The verb.
pub fn render(args: &RenderArgs, desk: &Desk) -> Result<Answer> {
    check_distinct(args.input.path(), &[], &[&args.output])?;
    let file = PictureFile::reserve(&args.output)?;
    let mut ctx = desk.context();
    let input = args.input.subject(&args.bitmaps, &mut ctx)?;
    let measured = input.measure(None, &mut ctx);
    let (_, measured) = measured.map_err(|e| args.input.blame(e))?;
    let title = args.title.clone().unwrap_or_else(|| args.input.title());
    let shown = Shown {
        title: &title,
        angles: &args.views,
        size: args.size.unwrap_or(VIEW_SIZE),
        asymmetry: args.asymmetry,
        plane: args.plane,
    };
    let draw = || file.write(&measured_views(&measured, &shown));
    let complete = ctx.stage("picture", |_| draw())?;
    ctx.check()?;
    commit([complete])?;
    desk.say(&format!("wrote {}\n", args.output.display()));
    Ok(Answer::Yes)
}

fn angle(name: &str) -> std::result::Result<Angle, String> {
    let known = Angle::ALL.into_iter().find(|a| a.name() == name);
    known.ok_or_else(|| format!("the views are {}", Angle::ALL.map(Angle::name).join(", ")))
}

/// `640x480`, or one number for a square; 16 to 4096 each way.
fn size(text: &str) -> std::result::Result<[u32; 2], String> {
    let (width, height) = text.split_once('x').unwrap_or((text, text));
    let side = |s: &str| s.parse().ok().filter(|n| (16..=4096).contains(n));
    match (side(width), side(height)) {
        (Some(w), Some(h)) => Ok([w, h]),
        _ => Err("write WIDTHxHEIGHT, each from 16 to 4096".into()),
    }
}
