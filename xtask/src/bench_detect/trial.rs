//! One shape, detected in one place with one seed, and the same for all seeds.

use std::time::Instant;

use symmetrizer::report::DetectReport;
use symmetrizer::{Context, Mesh, Params, detect_in};

use super::found::Found;
use super::place::{Placement, diagonal, noisy};
use crate::terminal;

/// How the shapes are tried.
pub struct Trials {
    /// Parameters of detection.
    pub params: Params,
    /// Seeds 0, 1, ... of detection and placement.
    pub seeds: u64,
}

/// What was found with one seed.
pub struct Trial {
    /// The seed.
    pub seed: u64,
    /// What was found, in the coordinates of the file; nothing where detection failed.
    pub found: Found,
    /// Why detection failed.
    pub error: Option<String>,
}

impl Trials {
    /// Detects in `mesh` once for each seed, each time in another place, with `noise` along the
    /// normals (fraction of D) added.
    pub fn run(&self, name: &str, mesh: &Mesh, noise: f64) -> Vec<Trial> {
        let start = Instant::now();
        let trials: Vec<Trial> = (0..self.seeds)
            .map(|seed| self.one(name, mesh, noise, seed))
            .collect();
        let finds: usize = trials.iter().map(|t| t.found.symmetries.len()).sum();
        let errors = trials.iter().filter(|t| t.error.is_some()).count();
        terminal::note(&format!(
            "{name:<32} noise {:>3} %  {} seeds  {finds:>4} finds  {errors} errors  {:.1} s",
            100.0 * noise,
            self.seeds,
            start.elapsed().as_secs_f64()
        ));
        trials
    }

    fn one(&self, name: &str, mesh: &Mesh, noise: f64, seed: u64) -> Trial {
        let d = diagonal(mesh);
        let place = Placement::random(name, seed, d);
        let placed = if noise > 0.0 {
            let mut rng = Context::new(seed).rng(&format!("noise {name}"));
            place.mesh(&noisy(mesh, noise * d, &mut rng))
        } else {
            place.mesh(mesh)
        };
        let (found, error) = match self.detect(&placed, &place, seed) {
            Ok(found) => (found, None),
            Err(error) => (Found::default(), Some(error)),
        };
        Trial { seed, found, error }
    }

    /// What the report of detection says; nothing else of its result is looked at.
    fn detect(&self, placed: &Mesh, place: &Placement, seed: u64) -> Result<Found, String> {
        let mut ctx = Context::new(seed);
        let found = detect_in(placed, &self.params, &mut ctx).map_err(|e| e.to_string())?;
        let report = DetectReport::new(placed, &found, &self.params, &ctx);
        let report = serde_json::to_value(report).map_err(|e| e.to_string())?;
        Found::read(&report, place)
    }
}
