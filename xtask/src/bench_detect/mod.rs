//! Detection measured on shapes whose symmetries are known, from its report alone.
//!
//! Each shape is detected with several seeds, each time turned, shifted and scaled another way; what
//! is found is brought back to the coordinates of the file and compared with the truth.

mod clouds;
mod compare;
mod control;
mod copies;
mod found;
mod groups;
mod mirrors;
mod place;
mod planes;
mod repeats;
pub mod time;
mod trial;
mod trivial;
mod truth;
mod truth_file;
mod verify;

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use symmetrizer::{Error, Params, Result};

use crate::tables::Section;
use crate::{Answer, data, terminal};
use trial::Trials;

/// Measure detection on shapes with known symmetries
#[derive(clap::Args)]
pub struct Args {
    /// Seeds to try each shape with, each in another place
    #[arg(long, default_value_t = 5, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    seeds: u64,
    /// Only the shapes and clouds with this in their name
    #[arg(
        long,
        default_value = "",
        value_name = "NAME",
        hide_default_value = true
    )]
    only: String,
    /// Noise along the normals in the section on noise, fraction of the diagonal; 0 leaves it out
    #[arg(long, default_value_t = 0.01, value_name = "X", value_parser = noise)]
    noise: f64,
    /// Set one parameter, say pair.tolerance=0.1; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Write all figures as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Exit with 1 when a goal is missed
    #[arg(long)]
    check: bool,
    /// Measure time on the bunny instead
    #[arg(long)]
    time: bool,
}

/// Measures, and prints tables.
///
/// # Errors
/// Test data that is missing or damaged, parameters, a file that cannot be written.
pub fn run(args: &Args) -> Result<Answer> {
    let params = params(&args.set)?;
    let root = data::root()?;
    let sections = match args.time {
        true => times(&root, &params)?,
        false => quality(&root.join("truth"), args, params)?,
    };
    if let Some(path) = &args.json {
        write(path, &sections)?;
    }
    let verdicts = sections.iter().flat_map(|s| &s.verdicts);
    let missed = verdicts.filter(|v| !v.met).count();
    Ok(match args.check && missed > 0 {
        true => Answer::Missed,
        false => Answer::Done,
    })
}

/// The section on time, printed.
fn times(root: &Path, params: &Params) -> Result<Vec<Section>> {
    let section = time::section(&root.join("3d/bunny.obj"), params)?;
    terminal::answer(&section.to_string());
    Ok(vec![section])
}

/// All sections for which there are shapes, printed as they are done.
fn quality(folder: &Path, args: &Args, params: Params) -> Result<Vec<Section>> {
    let shapes = truth::read_all(folder, &args.only)?;
    let clouds = clouds::read_all(&folder.join("shrec_style"), &args.only)?;
    if shapes.is_empty() && clouds.is_empty() {
        let what = format!("no shape with {:?} in its name", args.only);
        return Err(Error::input(what, "leave --only away to try all"));
    }
    let trials = Trials {
        params,
        seeds: args.seeds,
    };
    let noisy = || mirrors::section(&shapes, &trials, args.noise);
    let steps: [&dyn Fn() -> Option<Section>; 6] = [
        &|| mirrors::section(&shapes, &trials, 0.0),
        &|| (args.noise > 0.0).then(noisy).flatten(),
        &|| control::section(&shapes, &trials),
        &|| groups::section(&shapes, &trials),
        &|| repeats::section(&shapes, &trials),
        &|| clouds::section(&clouds, &trials),
    ];
    let mut sections = Vec::new();
    for step in steps {
        if let Some(section) = step() {
            terminal::answer(&section.to_string());
            sections.push(section);
        }
    }
    terminal::answer(&goals(&sections));
    Ok(sections)
}

/// All verdicts in one list.
fn goals(sections: &[Section]) -> String {
    let with_title = |s: &'_ Section| -> Vec<String> {
        let lines = s.verdicts.iter().map(|v| format!("  {v}  [{}]", s.title));
        lines.collect()
    };
    let lines: Vec<String> = sections.iter().flat_map(with_title).collect();
    let met = sections.iter().flat_map(|s| &s.verdicts).filter(|v| v.met);
    let head = format!("== goals: {} of {} met", met.count(), lines.len());
    format!("{head}\n{}", lines.join("\n"))
}

fn write(path: &Path, sections: &[Section]) -> Result<()> {
    let all: Vec<Value> = sections
        .iter()
        .map(|s| json!({ "title": s.title, "verdicts": s.verdicts, "figures": s.figures }))
        .collect();
    let text = symmetrizer::report::to_json(&all)?;
    std::fs::write(path, text).map_err(|e| Error::io(path, e))
}

/// The default parameters with the settings of the command line.
fn params(settings: &[String]) -> Result<Params> {
    let mut params = Params::default();
    for setting in settings {
        let what = "no value; write NAME=VALUE, say pair.tolerance=0.1";
        let (name, value) = setting
            .split_once('=')
            .ok_or_else(|| Error::params(setting, what))?;
        params.set(name.trim(), value.trim())?;
    }
    Ok(params)
}

/// A level of noise.
fn noise(text: &str) -> std::result::Result<f64, String> {
    let level: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    match (0.0..=0.1).contains(&level) {
        true => Ok(level),
        false => Err("0..=0.1 is wanted".into()),
    }
}
