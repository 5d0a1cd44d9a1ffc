//! A picture as one number for each pixel.

use image::DynamicImage;

/// Opacity below this is see-through.
const OPAQUE: f64 = 0.5;

/// A picture is a cut-out if at least this share of it is see-through.
const CUT: f64 = 1e-3;

/// Values from 0 to 1, row by row from the top.
pub(super) struct Grey {
    pub width: usize,
    pub height: usize,
    pub values: Vec<f32>,
    /// Whether the values are opacities: what is opaque is the shape, whatever its colour.
    pub opacity: bool,
}

/// Opacity where parts of the picture are see-through, else luminance.
pub(super) fn of(picture: &DynamicImage) -> Grey {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    if picture.color().has_alpha() {
        let alpha = picture.to_luma_alpha16();
        let values: Vec<f32> = alpha.pixels().map(|p| unit(p.0[1])).collect();
        let clear = values.iter().filter(|v| f64::from(**v) < OPAQUE).count();
        if clear as f64 > CUT * values.len() as f64 && clear < values.len() {
            return Grey {
                width,
                height,
                values,
                opacity: true,
            };
        }
    }
    let values = picture.to_luma16().pixels().map(|p| unit(p.0[0])).collect();
    Grey {
        width,
        height,
        values,
        opacity: false,
    }
}

fn unit(value: u16) -> f32 {
    f32::from(value) / f32::from(u16::MAX)
}

impl Grey {
    /// Values on the picture's edge.
    pub fn border(&self) -> impl Iterator<Item = f32> {
        let (w, h) = (self.width, self.height);
        let rows = (0..w).flat_map(move |x| [x, (h - 1) * w + x]);
        let columns = (0..h).flat_map(move |y| [y * w, y * w + w - 1]);
        rows.chain(columns).map(|i| self.values[i])
    }

    /// The values blurred with a normal distribution of deviation `sigma`, pixels. Beyond its edge
    /// the picture goes on as it is there.
    pub fn blurred(&self, sigma: f64) -> Self {
        let reach = (3.0 * sigma).ceil() as i64;
        let bell = |i: i64| (-0.5 * (i as f64 / sigma).powi(2)).exp() as f32;
        let kernel: Vec<f32> = (-reach..=reach).map(bell).collect();
        let sum: f32 = kernel.iter().sum();
        let (w, h) = (self.width as i64, self.height as i64);
        let pass = |values: &[f32], dx: i64, dy: i64| -> Vec<f32> {
            let mut out = Vec::with_capacity(values.len());
            for y in 0..h {
                for x in 0..w {
                    let at = |i: i64| {
                        let (x, y) = (x + i * dx, y + i * dy);
                        values[(y.clamp(0, h - 1) * w + x.clamp(0, w - 1)) as usize]
                    };
                    let terms = kernel.iter().zip(-reach..=reach).map(|(k, i)| k * at(i));
                    out.push(terms.sum::<f32>() / sum);
                }
            }
            out
        };
        let values = pass(&pass(&self.values, 1, 0), 0, 1);
        Self { values, ..*self }
    }
}
