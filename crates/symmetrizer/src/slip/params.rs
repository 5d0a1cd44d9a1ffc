//! When a part of a surface counts as sliding along itself.

/// How slides are looked for.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SlipParams {
    /// Largest rms angle between a slide and the surface, radians, on a surface without noise. 0.009, ours:
    /// half of what a sphere stretched by 3 % has.
    pub tolerance: f64,
    /// Smallest share of the surface's area. 0.1, ours.
    pub min_area: f64,
}

impl Default for SlipParams {
    fn default() -> Self {
        Self {
            tolerance: 0.009,
            min_area: 0.1,
        }
    }
}
