//! Which values are the shape's.

use super::grey::Grey;
use crate::error::{Error, Result};

/// Grey values that are told apart.
const BINS: usize = 256;

/// A picture whose values differ by no more than this is of one colour.
const EVEN: f32 = 1.5 / 255.0;

/// What a picture says of its edges.
#[derive(Clone, Copy)]
pub(super) struct Edges {
    /// How far it should be blurred, pixels.
    pub blur: f64,
    /// How exactly it tells where they are, pixels.
    pub grain: f64,
}

/// Edges that are smooth already. The outline of a disc is found to within 0.1.
const SOFT: Edges = Edges {
    blur: 0.7,
    grain: 0.2,
};

/// Bare steps, which are half a pixel from any line; curves that use all of that cut corners.
const STEPS: Edges = Edges {
    blur: 1.0,
    grain: 0.25,
};

/// Share of values between the two classes, below which edges are bare steps.
const BETWEEN: f64 = 0.002;

/// Where the shape is.
pub(super) struct Split {
    /// Values beyond this are the shape's.
    pub threshold: f32,
    /// Whether the shape has the larger values.
    pub lighter: bool,
    /// The share of the values' variance that lies between the classes, 0 to 1.
    pub separation: f64,
    /// The medians of both classes.
    medians: [f32; 2],
}

/// Tells the shape from its surroundings, which are what most of the border is.
///
/// The automatic threshold is the middle between the medians of the two classes of Otsu (1979): in
/// a picture with smoothed edges that is where half a pixel is covered.
///
/// # Errors
/// [`Error::Params`] for a threshold outside 0..1, [`Error::Input`] where all lies on one side of it.
pub(super) fn split(grey: &Grey, given: Option<f64>) -> Result<Split> {
    if let Some(t) = given.filter(|t| !(*t > 0.0 && *t < 1.0)) {
        return Err(Error::params(
            "threshold",
            format!("{t} is not between 0 and 1"),
        ));
    }
    let low = grey.values.iter().copied().fold(f32::INFINITY, f32::min);
    let high = grey
        .values
        .iter()
        .copied()
        .fold(f32::NEG_INFINITY, f32::max);
    if high - low <= EVEN {
        let (w, h) = (grey.width, grey.height);
        let what = format!("the picture ({w} x {h} pixels) has one colour only");
        return Err(Error::input(
            what,
            "it must show a shape before a plain background",
        ));
    }
    let histogram = histogram(grey, low, high);
    let (cut, separation) = otsu(&histogram);
    let value = |bin: usize| low + (high - low) * bin as f32 / BINS as f32;
    let medians = [
        value(0) + (high - low) * median(&histogram[..cut]) as f32 / BINS as f32,
        value(cut) + (high - low) * median(&histogram[cut..]) as f32 / BINS as f32,
    ];
    let threshold = given.map_or((medians[0] + medians[1]) / 2.0, |t| t as f32);
    if !(low < threshold && threshold < high) {
        let what = format!("all pixels lie on one side of the threshold {threshold:.3}");
        let hint = format!("the picture's values go from {low:.3} to {high:.3}");
        return Err(Error::input(what, hint));
    }
    let (mut above, mut all) = (0, 0);
    for v in grey.border() {
        all += 1;
        above += usize::from(v > threshold);
    }
    Ok(Split {
        threshold,
        lighter: grey.opacity || 2 * above < all,
        separation,
        medians,
    })
}

impl Split {
    /// Whether the picture's edges are smooth.
    pub fn edges(&self, grey: &Grey) -> Edges {
        let [dark, light] = self.medians;
        let margin = 0.1 * (light - dark);
        let between = |v: &&f32| **v > dark + margin && **v < light - margin;
        let count = grey.values.iter().filter(between).count();
        if count as f64 > BETWEEN * grey.values.len() as f64 {
            SOFT
        } else {
            STEPS
        }
    }
}

fn histogram(grey: &Grey, low: f32, high: f32) -> [u64; BINS] {
    let mut counts = [0; BINS];
    for v in &grey.values {
        let bin = ((v - low) / (high - low) * BINS as f32) as usize;
        counts[bin.min(BINS - 1)] += 1;
    }
    counts
}

/// The first bin of the upper class, so that the variance between the classes is greatest, and its
/// share of the whole variance. Of equal ones the middle.
fn otsu(counts: &[u64; BINS]) -> (usize, f64) {
    let total: f64 = counts.iter().sum::<u64>() as f64;
    let moment = |k: i32| -> f64 {
        let terms = counts
            .iter()
            .enumerate()
            .map(|(i, &c)| (i as f64).powi(k) * c as f64);
        terms.sum::<f64>() / total
    };
    let (mean, variance) = (moment(1), moment(2) - moment(1).powi(2));
    let (mut best, mut from, mut to) = (-1.0, 1, 1);
    let (mut weight, mut sum) = (0.0, 0.0);
    for (i, &c) in counts.iter().enumerate().take(BINS - 1) {
        weight += c as f64 / total;
        sum += i as f64 * c as f64 / total;
        let spread = (mean * weight - sum).powi(2) / (weight * (1.0 - weight));
        if spread > best * (1.0 + 1e-12) {
            (best, from, to) = (spread, i + 1, i + 1);
        } else if spread >= best * (1.0 - 1e-12) {
            to = i + 1;
        }
    }
    (usize::midpoint(from, to), (best / variance).min(1.0))
}

/// The bin in which half of the counts are reached, with the part of it.
fn median(counts: &[u64]) -> f64 {
    let half = counts.iter().sum::<u64>() as f64 / 2.0;
    let mut sum = 0.0;
    for (i, &c) in counts.iter().enumerate() {
        if sum + c as f64 >= half && c > 0 {
            return i as f64 + 0.5;
        }
        sum += c as f64;
    }
    0.0
}
