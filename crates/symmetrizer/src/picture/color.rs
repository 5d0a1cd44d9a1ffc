//! Colours for numbers and for things: perceptual maps, scales with a range, a palette.

use std::fmt;

/// A perceptually ordered colour map over 0..=1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColorMap {
    /// Cream through orange to dark red; cream looks like plain clay. For asymmetry.
    Heat,
    /// Black through purple and orange to pale yellow. For densities.
    Magma,
    /// Dark blue through green to yellow.
    Viridis,
    /// Blue through green and yellow to red. For places: its lightness is in no order.
    Turbo,
}

impl ColorMap {
    /// The sRGB colour at `t`, which is cut to 0..=1; grey where it is not a number.
    pub fn at(self, t: f64) -> [u8; 3] {
        if t.is_nan() {
            return [128; 3];
        }
        let (gradient, end) = match self {
            // The last bit is so dark that it hides the shading.
            Self::Heat => (colorous::ORANGE_RED, 0.94),
            Self::Magma => (colorous::MAGMA, 1.0),
            Self::Viridis => (colorous::VIRIDIS, 1.0),
            Self::Turbo => (colorous::TURBO, 1.0),
        };
        gradient
            .eval_continuous(t.clamp(0.0, 1.0) * end)
            .into_array()
    }
}

/// A colour map over a range of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorScale {
    /// The map.
    pub map: ColorMap,
    /// The number at the map's start.
    pub low: f64,
    /// The number at its end.
    pub high: f64,
}

impl ColorScale {
    /// The colour of a number, sRGB bytes.
    pub fn color(&self, value: f64) -> [u8; 3] {
        let t = (value - self.low) / (self.high - self.low);
        // A range without length shows everything at or below it as its start.
        let same = self.high <= self.low && value <= self.low;
        self.map.at(if same { 0.0 } else { t })
    }

    /// The colours of the numbers of the vertices, as [`crate::picture::Scene`] takes them.
    pub fn colors(&self, values: &[f64]) -> Vec<[f32; 3]> {
        let unit = |c: u8| f32::from(c) / 255.0;
        values.iter().map(|v| self.color(*v).map(unit)).collect()
    }
}

/// The `index`-th colour for clusters and planes: saturated, repeats after 10, and starts far from
/// [`ColorMap::Heat`].
pub fn categorical(index: usize) -> [u8; 3] {
    // Blue, green, purple, cyan, pink, olive, brown, orange, red, grey.
    const ORDER: [usize; 10] = [0, 2, 4, 9, 6, 8, 5, 1, 3, 7];
    colorous::CATEGORY10[ORDER[index % ORDER.len()]].into_array()
}

/// Writes a colour as `#rrggbb`.
pub(super) struct Hex(pub [u8; 3]);

impl fmt::Display for Hex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(c: [u8; 3]) -> f64 {
        0.2126 * f64::from(c[0]) + 0.7152 * f64::from(c[1]) + 0.0722 * f64::from(c[2])
    }

    #[test]
    fn lightness_runs_one_way() {
        for (map, sign) in [
            (ColorMap::Heat, -1.0),
            (ColorMap::Magma, 1.0),
            (ColorMap::Viridis, 1.0),
        ] {
            let light: Vec<f64> = (0..=20)
                .map(|i| sign * luminance(map.at(f64::from(i) / 20.0)))
                .collect();
            assert!(light.windows(2).all(|w| w[1] > w[0]), "{map:?}: {light:?}");
        }
    }

    #[test]
    fn odd_numbers_have_colours() {
        let scale = |low, high| ColorScale {
            map: ColorMap::Heat,
            low,
            high,
        };
        assert_eq!(scale(0.0, 1.0).color(f64::NAN), [128; 3]);
        assert_eq!(scale(0.0, 1.0).color(1e300), ColorMap::Heat.at(1.0));
        assert_eq!(scale(0.0, 0.0).color(0.0), ColorMap::Heat.at(0.0));
        assert_eq!(scale(0.0, 0.0).color(1.0), ColorMap::Heat.at(1.0));
    }
}
