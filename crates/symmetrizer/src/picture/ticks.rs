//! Round numbers for axes and legends.

/// Multiples of 1, 2 or 5 times a power of ten within `low..=high`, about `count` of them; empty
/// where the range is empty or not finite.
pub fn ticks(low: f64, high: f64, count: usize) -> Vec<f64> {
    let step = step(low, high, count);
    let usable = step.is_normal() && (low / step).abs() < 1e15 && (high / step).abs() < 1e15;
    if !usable {
        return Vec::new();
    }
    // The slack keeps an end that is itself a round number.
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|i| i as f64 * step).collect()
}

/// The ticks of a range with their labels, all with the same number of decimals.
pub fn labelled_ticks(low: f64, high: f64, count: usize) -> Vec<(f64, String)> {
    let values = ticks(low, high, count);
    let step = step(low, high, count);
    let decimals = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
    let label = |v: f64| {
        let plain = v.abs().max(step) < 1e6 && step >= 1e-6;
        // Adding 0.0 turns -0.0 into 0.0.
        let v = v + 0.0;
        let text = if plain {
            format!("{v:.decimals$}")
        } else {
            format!("{v:.1e}")
        };
        text.replace('-', "\u{2212}")
    };
    values.into_iter().map(|v| (v, label(v))).collect()
}

/// The step that gives about `count` ticks; not finite where there is none.
fn step(low: f64, high: f64, count: usize) -> f64 {
    let raw = (high - low) / count.max(1) as f64;
    if !(raw.is_finite() && raw > 0.0) {
        return f64::NAN;
    }
    let power = 10_f64.powf(raw.log10().floor());
    let factor = match raw / power {
        r if r <= 1.0 + 1e-9 => 1.0,
        r if r <= 2.0 + 1e-9 => 2.0,
        r if r <= 5.0 + 1e-9 => 5.0,
        _ => 10.0,
    };
    factor * power
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, count: usize) -> Vec<String> {
        let ticks = labelled_ticks(low, high, count);
        ticks.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(
            labels(0.0, 2.5, 5),
            ["0.0", "0.5", "1.0", "1.5", "2.0", "2.5"]
        );
        assert_eq!(labels(-0.13, 0.27, 4), ["\u{2212}0.1", "0.0", "0.1", "0.2"]);
        assert_eq!(labels(0.0, 0.3, 3), ["0.0", "0.1", "0.2", "0.3"]);
        assert_eq!(labels(0.0, 40.0, 4), ["0", "10", "20", "30", "40"]);
    }

    #[test]
    fn an_odd_range_has_no_ticks_and_no_panic() {
        for (low, high) in [
            (1.0, 1.0),
            (2.0, 1.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
            (-f64::MAX, f64::MAX),
            (1e300, 1e300 * (1.0 + 1e-15)),
        ] {
            assert!(labelled_ticks(low, high, 5).len() < 20);
        }
        assert!(labelled_ticks(0.0, 1e-300, 5).len() < 20);
        assert!(labelled_ticks(0.0, 5e-324, 5).len() < 20);
        assert!(labelled_ticks(0.0, 1e300, 5).len() < 20);
    }
}
