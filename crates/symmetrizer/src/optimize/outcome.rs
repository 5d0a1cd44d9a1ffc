//! What comes of a run of the schedule.

use serde::{Deserialize, Serialize};

use crate::detect::Detection;
use crate::geom::Point;
use crate::optimize::orbit::Goal;
use crate::patch::Symmetry;
use crate::shape::Surface;
use crate::transform::{Class, Plane};

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Every step of the schedule was done.
    Converged,
    /// The deformation energy reached its limit; the shape is as it was then.
    EnergyLimit,
    /// A merge ran out of steps before its mirrors met.
    StepLimit,
    /// No symmetry was found; the shape is unchanged.
    NoSymmetry,
}

/// One step of the schedule as it was done; the same steps follow again from the same input,
/// parameters and seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "step", rename_all = "snake_case")]
pub enum Step {
    /// A bend was undone.
    Straighten {
        /// How far the local mirrors turned over the shape, degrees.
        bend: f64,
        /// Share of the samples whose partner was trusted.
        trusted: f64,
    },
    /// A share of the bend was put back.
    Bend {
        /// Degrees.
        bend: f64,
    },
    /// A cluster was contracted.
    Contract {
        /// Id of the symmetry.
        symmetry: u32,
        /// Deformation steps.
        steps: usize,
        /// Couples at the end.
        couples: usize,
        /// Mean symmetry cost before and after, L^2.
        cost: [f64; 2],
        /// Deformation energy after it.
        energy: f64,
    },
    /// Two clusters were merged.
    Merge {
        /// Ids of the symmetries.
        symmetries: [u32; 2],
        /// Deformation steps.
        steps: usize,
        /// Their distance in transformation space before and after, fraction of L.
        distance: [f64; 2],
        /// Share of the surface that the best one holds for before and after.
        coverage: [f64; 2],
        /// Deformation energy after it.
        energy: f64,
        /// False where the merge was undone because coverage did not grow enough.
        kept: bool,
    },
    /// The whole was contracted under the final mirror.
    ContractWhole {
        /// Deformation steps.
        steps: usize,
        /// Couples at the end.
        couples: usize,
        /// Mean symmetry cost before and after, L^2.
        cost: [f64; 2],
        /// Deformation energy after it.
        energy: f64,
    },
    /// The orbits of groups, rows, copies, slides and single symmetries were moved to their means, all together.
    Orbits {
        /// What became of each, those of most of the surface first.
        goals: Vec<Met>,
        /// Deformation steps.
        steps: usize,
        /// Rounds at full resolution.
        rounds: usize,
        /// rms displacement over the surface that equation 1 asks for, fraction of L.
        predicted: f64,
        /// Deformation energy after it.
        energy: f64,
    },
    /// The finish at full resolution.
    Finish {
        /// Rounds.
        rounds: usize,
        /// Mean distance of mirrored vertices from the surface before and after, fraction of L.
        asymmetry: [f64; 2],
        /// Share of the area where it was undone because the surface would have crossed itself.
        undone: f64,
    },
    /// What was tangled got the input's form back.
    Mend {
        /// Share of the area.
        share: f64,
        /// Faces that are tangled all the same.
        left: usize,
    },
}

/// What became of symmetries that were to be made exact together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Met {
    /// What they are called: the group, `row 5`, `6 copies`, `revolution`, `symmetry 3`.
    pub name: String,
    /// Their ids.
    pub symmetries: Vec<u32>,
    /// The number of copies in an orbit; none where it has any number.
    pub order: Option<usize>,
    /// Their ground as a share of the surface's area.
    pub area_fraction: f64,
    /// rms distance of the copies from the surface before and after, fraction of L.
    pub residual: [f64; 2],
    /// The share of the copies, by area, that there is a place for.
    pub held: f64,
    /// False where it was left: others, which hold for more, exclude it, or most places find no copy.
    pub kept: bool,
}

impl Met {
    /// A goal that was pursued.
    pub fn new(goal: &Goal, residual: [f64; 2], held: f64) -> Self {
        Self {
            name: goal.name.clone(),
            symmetries: goal.symmetries.clone(),
            order: goal.order(),
            area_fraction: goal.area_fraction,
            residual,
            held,
            kept: true,
        }
    }

    /// One that was left.
    pub fn left(goal: &Goal, residual: [f64; 2], held: f64) -> Self {
        Self {
            kept: false,
            ..Self::new(goal, residual, held)
        }
    }
}

/// The optimized surface and how it came about.
pub struct Optimized {
    /// Vertex positions, working coordinates.
    pub positions: Vec<Point>,
    /// The final mirror, working coordinates.
    pub plane: Option<Plane>,
    /// How the run ended.
    pub outcome: Outcome,
    /// What was done, in order.
    pub steps: Vec<Step>,
    /// Deformation energy of the prisms; the finish, which adds little, is not in it.
    pub energy: f64,
    /// The first id that no symmetry of the run had.
    pub next_id: u32,
    /// What was made exact by orbits, its motions as they are exact, working coordinates.
    pub goals: Vec<Goal>,
}

impl Optimized {
    /// What becomes of a surface on which nothing is to be done.
    pub fn unmoved(surface: &Surface, detection: &Detection, outcome: Outcome) -> Self {
        Self {
            positions: surface.positions.clone(),
            plane: mirrors(detection).next().map(Symmetry::plane),
            outcome,
            steps: Vec::new(),
            energy: 0.0,
            next_id: next_id(detection),
            goals: Vec::new(),
        }
    }
}

/// The first id that no symmetry of a detection has.
pub fn next_id(detection: &Detection) -> u32 {
    let ids = detection.symmetries.iter().map(|s| s.id + 1);
    ids.max().unwrap_or(0)
}

/// The mirrors of a detection.
pub fn mirrors(detection: &Detection) -> impl Iterator<Item = &Symmetry> {
    let all = detection.symmetries.iter();
    all.filter(|s| s.class == Class::Mirror)
}
