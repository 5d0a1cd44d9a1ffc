//! Checks on a surface that tell places apart: a hue for how far along, dark and light squares.

use crate::picture::color::ColorMap;

/// The colour of what has no place, sRGB.
pub const NOWHERE: [u8; 3] = [168, 168, 170];
/// The share of the colour map that is used: its ends are nearly black.
const SHARE: [f64; 2] = [0.08, 0.9];
/// White in the light squares, black in the dark ones.
const LIGHT: f64 = 0.62;
const DARK: f64 = 0.12;
/// Vertices that are less sure of their place than this have none.
const SURE: f64 = 0.5;

/// A pattern for a surface. It is drawn for each pixel from places that are linear over the triangles, so
/// that its edges are sharp on coarse meshes too.
#[derive(Debug, Clone, Copy)]
pub struct Checks<'a> {
    /// For each vertex how far along it is, 0 to 1, how far across in the same unit, and how sure that is,
    /// 0 to 1.
    pub places: &'a [[f64; 3]],
    /// Side of a square in that unit.
    pub side: f64,
}

impl Checks<'_> {
    /// The place of a vertex; a missing one is nowhere.
    pub(super) fn place(&self, vertex: usize) -> [f64; 3] {
        self.places.get(vertex).copied().unwrap_or_default()
    }

    /// The sRGB colour of a place, 0 to 1 each.
    pub(super) fn color(&self, [along, across, sure]: &[f64; 3]) -> [f64; 3] {
        // Written so that what is not a number is nowhere.
        let known = *sure >= SURE && along.is_finite() && across.is_finite();
        if !known {
            return NOWHERE.map(|c| f64::from(c) / 255.0);
        }
        let odd = [along, across]
            .map(|x| (x / self.side).floor())
            .iter()
            .sum::<f64>()
            .rem_euclid(2.0);
        let (toward, share) = if odd < 1.0 { (1.0, LIGHT) } else { (0.0, DARK) };
        hue(*along).map(|c| f64::from(c) / 255.0 * (1.0 - share) + toward * share)
    }
}

/// The sRGB colour of how far along a place is, 0 to 1.
pub fn hue(along: f64) -> [u8; 3] {
    let [low, high] = SHARE;
    ColorMap::Turbo.at(low + (high - low) * along.clamp(0.0, 1.0))
}
