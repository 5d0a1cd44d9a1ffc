//! Large deformations of four shapes by handles, beside a peer on the same handles: a page with pictures and
//! numbers.

mod armadillo;
mod bar;
mod bars;
mod center_line;
mod diplodocus;
mod exhibit;
mod figures;
mod geodesic;
mod goals;
mod motion;
mod ours;
mod page;
mod peer;
mod picture;
mod result;

use std::path::{Path, PathBuf};

use symmetrizer::{Error, Result};

use crate::{Answer, terminal};
use exhibit::Exhibit;
use figures::Figures;
use goals::{Best, Entry};
use picture::{Panel, picture};

/// The page's file, beside its pictures.
const PAGE: &str = "deformation.md";
/// What is shown, in the page's order.
const EXHIBITS: [fn() -> Result<Exhibit>; 4] =
    [bars::bend, bars::twist, armadillo::arm, diplodocus::neck];

/// Write the page of deformations by handles
#[derive(clap::Args)]
pub struct Args {
    /// A program that is called as `PROGRAM deform MESH.off CONSTRAINTS.txt METHOD 1 OUT.txt`, writes positions and
    /// prints its times as lines of JSON with tool and wall_min (seconds); may be given several times
    #[arg(long, value_name = "PROGRAM")]
    peer: Vec<PathBuf>,
    /// Where the page and its pictures go
    #[arg(long, value_name = "FOLDER", default_value = "docs/gallery")]
    out: PathBuf,
    /// Exhibits with this in their name only
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
}

/// Makes the page.
///
/// # Errors
/// Test data that is missing or damaged; those of deformation; a peer that fails; [`Error::Io`].
pub fn run(args: &Args) -> Result<Answer> {
    std::fs::create_dir_all(&args.out).map_err(|e| Error::io(&args.out, e))?;
    let mut sections = Vec::new();
    for exhibit in EXHIBITS {
        let exhibit = exhibit()?;
        let only = args.only.as_deref().unwrap_or_default();
        if exhibit.name.contains(only) {
            sections.push(section(&exhibit, args)?);
        }
    }
    write(&args.out.join(PAGE), page::page(&sections).as_bytes())?;
    Ok(Answer::Done)
}

/// Deforms an exhibit in every way, writes its picture, and says what came of it.
fn section(exhibit: &Exhibit, args: &Args) -> Result<String> {
    terminal::note(exhibit.title);
    let entries = entries(exhibit, &args.peer)?;
    let canvas = picture(exhibit, &panels(exhibit, &entries));
    write(
        &args.out.join(exhibit.name).with_extension("png"),
        &canvas.to_png()?,
    )?;
    let section = page::section(exhibit, &entries);
    terminal::answer(&section);
    Ok(section)
}

fn entries(exhibit: &Exhibit, peers: &[PathBuf]) -> Result<Vec<Entry>> {
    let mut all = Vec::new();
    for model in ours::MODELS {
        for half_height in ours::HALF_HEIGHTS {
            all.push(ours::deformed(exhibit, model, half_height)?);
        }
    }
    for program in peers {
        all.extend(peer::deformed(program, exhibit)?);
    }
    let entry = |deformed| Entry {
        figures: Figures::new(exhibit, &deformed),
        deformed,
    };
    Ok(all.into_iter().map(entry).collect())
}

/// At rest, ours, of the peer's results the truest and, intact or not, the one that stretches least.
fn panels<'a>(exhibit: &'a Exhibit, entries: &'a [Entry]) -> Vec<Panel<'a>> {
    let panel = |e: &'a Entry| Panel {
        caption: &e.deformed.method,
        positions: &e.deformed.positions,
    };
    let mut panels = vec![Panel {
        caption: "at rest",
        positions: &exhibit.surface.positions,
    }];
    panels.extend(entries.iter().filter(|e| !e.deformed.peer).map(panel));
    let truest = Best::of(entries).map(|best| best.truest);
    let tightest = entries.iter().filter(|e| e.deformed.peer);
    let tightest = tightest.min_by(|a, b| a.figures.stretch.total_cmp(&b.figures.stretch));
    panels.extend(truest.into_iter().chain(tightest).map(panel));
    panels
}

fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    std::fs::write(path, bytes).map_err(|e| Error::io(path, e))
}
