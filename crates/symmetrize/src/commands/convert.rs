//! `symmetrize convert`: a shape in another format.

use std::path::PathBuf;

use clap::Args;
use symmetrizer::Result;

use crate::Answer;
use crate::files::{ShapeFile, check_distinct, commit};
use crate::input::{self, Bitmaps, Input, Subject, is_drawing};
use crate::options::Desk;

/// Write a shape in another format
///
/// Vertices and faces keep their order, and everything that the new format can hold comes along:
/// texture coordinates, colours, groups, materials, weights. What it cannot hold is listed.
#[derive(Args)]
pub struct ConvertArgs {
    #[arg(help = input::HELP)]
    input: Input,
    /// Write the shape here; the extension says how (obj, ply, off, stl, gltf, glb, 3mf, xyz; of a
    /// drawing svg, json, png)
    output: PathBuf,
    #[command(flatten)]
    bitmaps: Bitmaps,
}

/// The verb.
pub fn convert(args: &ConvertArgs, desk: &Desk) -> Result<Answer> {
    check_distinct(args.input.path(), &[&args.output], &[])?;
    let file = ShapeFile::reserve(&args.output)?;
    let mut ctx = desk.context();
    let drawn = args.input.path().is_some_and(is_drawing) || is_drawing(&args.output);
    let subject = match drawn {
        true => args.input.subject(&args.bitmaps, &mut ctx)?,
        false => Subject::Shape(args.input.read(&mut ctx)?),
    };
    file.check(&subject)?;
    let warnings = file.warnings(&subject);
    let complete = ctx.stage("write", |_| file.write(&subject))?;
    ctx.check()?;
    commit([complete])?;
    desk.say(&format!("wrote   {}\n", args.output.display()));
    for warning in warnings {
        desk.say(&format!("warning {warning}\n"));
    }
    Ok(Answer::Yes)
}
