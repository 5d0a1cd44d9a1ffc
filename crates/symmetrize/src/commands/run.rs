//! `symmetrize run`: the whole paper.

use std::path::{Path, PathBuf};

use clap::Args;
use symmetrizer::deform::Stiffness;
use symmetrizer::job::pictures;
use symmetrizer::shape::{Document, io};
use symmetrizer::{
    Context, Drawn, Error, Outcome, Params, Result, Symmetrized, Warning, symmetrize_drawing_with,
    symmetrize_with, unbend, unbend_drawing,
};

use crate::Answer;
use crate::files::{PictureFile, ReportFile, ShapeFile, check_distinct, commit};
use crate::input::{self, Bitmaps, Input, Subject};
use crate::options::{Bends, Desk, Sought, Tuning};
use crate::summary;

/// Make a shape symmetric
///
/// Finds the symmetries of the whole shape and of its parts, then deforms the shape, as little as
/// possible, until they are exact: one mirror for all of it, straight or about a bent axis; groups, rows,
/// repeated elements and surfaces of revolution; symmetries of parts where they hold. The result has the
/// input's vertices and faces in the same order.
#[derive(Args)]
pub struct RunArgs {
    #[arg(help = input::HELP)]
    input: Input,
    /// Write the symmetric shape here; the extension says how (obj, ply, off, stl, gltf, glb, 3mf; a drawing
    /// as svg, json or png)
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
    /// Write everything in figures here, as JSON
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Draw the shape before and after here (png, svg)
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// Stop when the deformation energy, about the mean square strain, exceeds this; the shape is
    /// written as it is then
    #[arg(long, value_name = "ENERGY")]
    max_deformation: Option<f64>,
    /// How stiff the shape is, 1 as usual: soft regions take up the deformation, stiff ones move as one
    /// piece. One number for all of it, or a file: a PLY with the property `stiffness` per vertex or
    /// face, or JSON {"per": "vertex", "values": [..]} (or "face"; of an SVG file "path", in the order of
    /// painting); of any drawing {"per": "place", "places": [[x, y], ..], "values": [..]}, in its file's
    /// coordinates, everywhere the value of the nearest place
    #[arg(long, value_name = "NUMBER|FILE")]
    stiffness: Option<String>,
    #[command(flatten)]
    sought: Sought,
    /// Make only these symmetries exact, with the groups they belong to: ids as `detect` lists them
    #[arg(long, value_name = "IDS", value_delimiter = ',')]
    only: Vec<u32>,
    /// Make no more than so many symmetries (groups, rows, sets of copies, single ones) exact, those of most
    /// of the surface first
    #[arg(long, value_name = "N")]
    max_symmetries: Option<usize>,
    #[command(flatten)]
    bends: Bends,
    /// Where no symmetry is found, write the input unchanged
    #[arg(long)]
    write_unchanged: bool,
    /// Write the input here too, say a generated one
    #[arg(long, value_name = "FILE")]
    write_input: Option<PathBuf>,
    /// Of a drawing, write the outline alone, the line of symmetry upright and both sides the same to the last
    /// digit
    #[arg(long)]
    exact: bool,
    #[command(flatten)]
    bitmaps: Bitmaps,
    #[command(flatten)]
    tuning: Tuning,
}

/// The files of a run.
struct Files {
    output: ShapeFile,
    input: Option<ShapeFile>,
    report: Option<ReportFile>,
    picture: Option<PictureFile>,
}

/// The verb.
pub fn run(args: &RunArgs, desk: &Desk) -> Result<Answer> {
    let stiffness = args.stiffness()?;
    carry_out(args, desk, |input, params, ctx| match input {
        Subject::Shape(document) => {
            let job = symmetrize_with(&document.mesh, &stiffness, params, ctx)?;
            Ok(Done::shape(document, job))
        }
        Subject::Drawing(drawing) => {
            let drawn = symmetrize_drawing_with(drawing, &stiffness, params, ctx)?;
            Done::drawing(drawn, args.exact)
        }
    })
}

/// The verb `straighten`.
pub fn straighten(args: &RunArgs, desk: &Desk) -> Result<Answer> {
    if args.stiffness.is_some() {
        let what = "a bend is undone by rotations; stiffness has no say in it";
        return Err(Error::params("--stiffness", what));
    }
    carry_out(args, desk, |input, params, ctx| match input {
        Subject::Shape(document) => {
            let job = unbend(&document.mesh, params, ctx)?;
            Ok(Done::shape(document, job))
        }
        Subject::Drawing(drawing) => {
            Done::drawing(unbend_drawing(drawing, params, ctx)?, args.exact)
        }
    })
}

/// What a run came to.
struct Done {
    result: Subject,
    job: Symmetrized,
}

impl Done {
    fn shape(input: &Document, job: Symmetrized) -> Self {
        Self {
            result: Subject::Shape(job.document(input)),
            job,
        }
    }

    /// With the `exact` outline instead of the file's own paths, where that is wanted.
    fn drawing(mut drawn: Drawn, exact: bool) -> Result<Self> {
        if exact && drawn.job.after.is_some() {
            drawn.drawing = drawn.exact()?;
        }
        Ok(Self {
            result: Subject::Drawing(drawn.drawing),
            job: drawn.job,
        })
    }
}

/// Reads, does the `work`, writes.
fn carry_out(
    args: &RunArgs,
    desk: &Desk,
    work: impl FnOnce(&Subject, &Params, &mut Context<'_>) -> Result<Done>,
) -> Result<Answer> {
    let params = args.params()?;
    let files = Files::reserve(args)?;
    let mut ctx = desk.context();
    let input = args.input.subject(&args.bitmaps, &mut ctx)?;
    if args.exact && matches!(input, Subject::Shape(_)) {
        let what = "is for drawings; of a mesh every vertex keeps its place in the file's order";
        return Err(Error::params("--exact", what));
    }
    for file in std::iter::once(&files.output).chain(&files.input) {
        file.check(&input)?;
    }
    let done = work(&input, &params, &mut ctx).map_err(|e| args.input.blame(e))?;
    let Done { result, mut job } = done;
    job.report.input.shape.file = Some(args.input.name());
    if let (Some(report), Some(text)) = (&mut job.report.stiffness, &args.stiffness) {
        report.file = text.parse::<f64>().is_err().then(|| text.clone());
    }
    let found = job.outcome != Outcome::NoSymmetry;
    let shape = found || args.write_unchanged;
    let subjects = (&input, shape.then_some(&result));
    files.write(subjects, &mut job, args, (&mut ctx, desk))?;
    desk.say(&summary::run(&job.report, args.picture.as_deref()));
    desk.say(&args.written(shape, is_drawn(shape, &job)));
    Ok(if found { Answer::Yes } else { Answer::No })
}

/// Whether there is something to draw: the `shape` that is written, or a bend that a person should see.
fn is_drawn(shape: bool, job: &Symmetrized) -> bool {
    shape || job.bend.is_some()
}

impl RunArgs {
    fn params(&self) -> Result<Params> {
        let mut params = self.tuning.resolve()?;
        self.sought.narrow(&mut params)?;
        self.bends.set(&mut params)?;
        if !self.only.is_empty() {
            params.optimize.only = Some(self.only.clone());
        }
        if let Some(count) = self.max_symmetries {
            params.set("optimize.max_symmetries", &count.to_string())?;
        }
        if let Some(energy) = self.max_deformation {
            params.set("optimize.max_deformation", &energy.to_string())?;
        }
        Ok(params)
    }

    fn stiffness(&self) -> Result<Stiffness> {
        let Some(text) = &self.stiffness else {
            return Ok(Stiffness::default());
        };
        if let Ok(k) = text.parse() {
            return Ok(Stiffness::Uniform(k));
        }
        let path = Path::new(text);
        if path
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("json"))
        {
            let json = std::fs::read_to_string(path).map_err(|e| Error::io(path, e))?;
            return Stiffness::from_json(&json).map_err(|e| e.in_file(text));
        }
        Stiffness::of_document(&io::read(path)?).ok_or_else(|| {
            let what = "no vertex or face has the property `stiffness`";
            Error::input(what, "give a number, JSON, or a PLY that has it").in_file(text)
        })
    }

    /// The line that says where everything is.
    fn written(&self, shape: bool, drawn: bool) -> String {
        let mut paths: Vec<&Path> = Vec::new();
        paths.extend(shape.then_some(self.output.as_path()));
        paths.extend(self.write_input.as_deref());
        paths.extend(self.report.as_deref());
        paths.extend(self.picture.as_deref().filter(|_| drawn));
        let names: Vec<String> = paths.iter().map(|p| p.display().to_string()).collect();
        if names.is_empty() {
            return "wrote        nothing\n".into();
        }
        format!("wrote        {}\n", names.join(", "))
    }
}

impl Files {
    /// Reserves all files, before any work.
    fn reserve(args: &RunArgs) -> Result<Self> {
        let others = [&args.write_input, &args.report, &args.picture];
        let others: Vec<&Path> = others.into_iter().flatten().map(PathBuf::as_path).collect();
        check_distinct(args.input.path(), &[&args.output], &others)?;
        let input = args.write_input.as_deref().map(ShapeFile::reserve);
        Ok(Self {
            output: ShapeFile::reserve(&args.output)?,
            input: input.transpose()?,
            report: args
                .report
                .as_deref()
                .map(ReportFile::reserve)
                .transpose()?,
            picture: args
                .picture
                .as_deref()
                .map(PictureFile::reserve)
                .transpose()?,
        })
    }

    /// Writes what the job came to: the input, and the result where there is one.
    fn write(
        self,
        (input, result): (&Subject, Option<&Subject>),
        job: &mut Symmetrized,
        args: &RunArgs,
        (ctx, desk): (&mut Context<'_>, &Desk),
    ) -> Result<()> {
        let mut complete = Vec::new();
        ctx.stage("write", |_| {
            if let Some(result) = result {
                let warnings = self.output.warnings(result).into_iter();
                job.report.warnings.extend(warnings.map(Warning));
                complete.push(self.output.write(result)?);
            }
            if let Some(file) = self.input {
                complete.push(file.write(input)?);
            }
            Ok(())
        })?;
        if let Some(file) = self.picture.filter(|_| is_drawn(result.is_some(), job)) {
            complete.push(ctx.stage("picture", |_| {
                file.write(&pictures::before_after(job, &args.input.title())?)
            })?);
        }
        if let Some(file) = self.report {
            job.report.run = Some(desk.progress.report());
            complete.push(file.write(&job.report)?);
        }
        ctx.check()?;
        commit(complete)
    }
}
