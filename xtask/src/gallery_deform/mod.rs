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
mod motion;
mod ours;
mod peer;
mod picture;
mod result;

use std::path::PathBuf;

use symmetrizer::Result;
use symmetrizer::deform::Model;

use crate::{Answer, terminal};
use exhibit::{Exhibit, Role};
use figures::Figures;

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
    /// Only exhibits with this in their name
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Half heights
    #[arg(long, value_delimiter = ',', default_value = "0.02")]
    half_height: Vec<f64>,
}

/// Makes the page.
///
/// # Errors
/// Test data that is missing or damaged; those of deformation; a peer that fails.
pub fn run(args: &Args) -> Result<Answer> {
    let exhibits: [fn() -> Result<Exhibit>; 4] =
        [bars::bend, bars::twist, armadillo::arm, diplodocus::neck];
    for exhibit in exhibits {
        let exhibit = exhibit()?;
        if args.only.as_ref().is_some_and(|o| !exhibit.name.contains(o)) {
            continue;
        }
        terminal::note(&format!(
            "{} {} triangles, {} held, {} moved, {} free {:?}",
            exhibit.name,
            exhibit.surface.triangles.len(),
            exhibit.count(Role::Held),
            exhibit.count(Role::Moved),
            exhibit.count(Role::Free),
            exhibit.motion,
        ));
        let mut all = Vec::new();
        for (&h, model) in args.half_height.iter().flat_map(|h| [(h, Model::Primo), (h, Model::Arap)]) {
            all.push(ours::deformed(&exhibit, model, h)?);
            terminal::note(&format!("{:?} {:?} {:?} {:?}", Figures::new(&exhibit, all.last().unwrap()), all.last().unwrap().method, all.last().unwrap().steps, all.last().unwrap().seconds));
        }
        for program in &args.peer {
            for d in peer::deformed(program, &exhibit)? {
                terminal::note(&format!("{:?} {:?} {:?} {:?}", Figures::new(&exhibit, &d), d.method, d.steps, d.seconds));
                all.push(d);
            }
        }
        let mut panels = vec![picture::Panel { caption: "at rest", positions: &exhibit.surface.positions }];
        panels.extend(all.iter().map(|d| picture::Panel { caption: &d.method, positions: &d.positions }));
        let _ = std::fs::create_dir_all(&args.out);
        std::fs::write(args.out.join(exhibit.name).with_extension("png"), picture::picture(&exhibit, &panels).to_png()?).unwrap();
    }
    Ok(Answer::Done)
}
