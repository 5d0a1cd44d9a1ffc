//! Parameters of the optimization.

use crate::error::{Error, Result};

/// How far, how fast and in what order symmetry is enhanced (section 4.2).
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OptimizeParams {
    /// Time step dt. 0.3, ours; the paper took 0.1. Constraint weights go with 1/dt, so the result
    /// does not depend on it (decision 0004).
    pub step: f64,
    /// Steps between two pairings. 5, paper section 4.2.
    pub redetect_every: usize,
    /// Steps that contract each cluster before merging. 5, ours: merging and the last contraction
    /// go on with it.
    pub contract_steps: usize,
    /// Steps of one merge at the most. 40, ours.
    pub merge_steps: usize,
    /// Two clusters are merged when their mirrors, or smallest rotations, are this close, rms displacement over both
    /// supports, fraction of L. 0.01, ours.
    pub merged_distance: f64,
    /// Largest angle in degrees between mirrors, or axes, that are merged. 65, ours (the bunny's
    /// are 55 apart).
    pub merge_angle: f64,
    /// Clusters lower than this share of the highest are left alone. 0.12, ours: a bunny of 12,000
    /// triangles has its head at .19.
    pub min_height: f64,
    /// Steps of the last contraction under the final mirror. 25, ours.
    pub final_steps: usize,
    /// Rounds of the finish at full resolution at the most; 0 for none. 16, ours.
    pub finish_rounds: usize,
    /// Smoothing lengths of the first and of the last rounds of the finish, fractions of L: detail
    /// below them keeps its own form. 0.04 and 0.002, ours.
    pub finish_lengths: [f64; 2],
    /// The finish stops at this mean asymmetry, fraction of L, if it is also a twelfth of the input's;
    /// going on would rub out detail. 0.0007, ours: the bunny then has 0.07 % of D.
    pub finish_asymmetry: f64,
    /// Rounds in which orbits are drawn to their means at full resolution at the most. 24, ours.
    pub orbit_rounds: usize,
    /// Ids of the symmetries that are made exact, with the groups they belong to; all by default.
    pub only: Option<Vec<u32>>,
    /// How many goals (groups, rows, sets of copies, single symmetries) are made exact, those of most of the surface
    /// first; all by default.
    pub max_symmetries: Option<usize>,
    /// Stop when the deformation energy (about the mean square strain) exceeds this; none by
    /// default.
    pub max_deformation: Option<f64>,
}

impl Default for OptimizeParams {
    fn default() -> Self {
        Self {
            step: 0.3,
            redetect_every: 5,
            contract_steps: 5,
            merge_steps: 40,
            merged_distance: 0.01,
            merge_angle: 65.0,
            min_height: 0.12,
            final_steps: 25,
            finish_rounds: 16,
            finish_lengths: [0.04, 0.002],
            finish_asymmetry: 0.0007,
            orbit_rounds: 24,
            only: None,
            max_symmetries: None,
            max_deformation: None,
        }
    }
}

impl OptimizeParams {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::Params`] with the first value out of its range.
    pub fn check(&self) -> Result<()> {
        let within = |name: &str, value: f64, low: f64, high: f64| {
            if value >= low && value <= high {
                Ok(())
            } else {
                Err(Error::params(
                    format!("optimize.{name}"),
                    format!("{value} is not in {low}..={high}"),
                ))
            }
        };
        within("step", self.step, 1e-3, 1.0)?;
        within("merged_distance", self.merged_distance, 1e-5, 1.0)?;
        within("merge_angle", self.merge_angle, 0.0, 90.0)?;
        within("min_height", self.min_height, 0.0, 1.0)?;
        within("finish_lengths", self.finish_lengths[0], 0.0, 1.0)?;
        within("finish_lengths", self.finish_lengths[1], 0.0, 1.0)?;
        within("finish_asymmetry", self.finish_asymmetry, 0.0, 1.0)?;
        within(
            "max_deformation",
            self.max_deformation.unwrap_or(0.0),
            0.0,
            f64::MAX,
        )?;
        if self.redetect_every == 0 {
            return Err(Error::params(
                "optimize.redetect_every",
                "must be at least 1",
            ));
        }
        Ok(())
    }
}
