//! Parameters of straightening.

use serde::{Deserialize, Serialize};

/// When bends are undone.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// Never.
    Never,
    /// Where the symmetry under the bend is accepted.
    #[default]
    Accepted,
    /// Where it is uncertain, too.
    Uncertain,
}

/// Whether and how far bends are undone.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StraightenParams {
    /// Never, where accepted, or where uncertain, too.
    pub when: When,
    /// Share of the bend that is removed, 0 (the pose is kept) to 1. 1, ours.
    pub share: f64,
    /// Bends of less degrees are left to contraction and merging. 8, ours.
    pub min_bend: f64,
}

impl Default for StraightenParams {
    fn default() -> Self {
        Self {
            when: When::default(),
            share: 1.0,
            min_bend: 8.0,
        }
    }
}
