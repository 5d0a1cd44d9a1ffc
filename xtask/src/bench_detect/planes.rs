//! Scores of lists of planes in the manner of the SHREC'23 track: MAP, MAPr and PHC.

use serde::Serialize;
use symmetrizer::geom::{Point, Vector};

/// A plane by a point, with how sure its finder is.
#[derive(Debug, Clone, Copy)]
pub struct Guess {
    /// Normal, of any length.
    pub normal: Vector,
    /// A point on it.
    pub point: Point,
    /// Guesses are visited by falling confidence.
    pub confidence: f64,
}

/// A true plane.
#[derive(Debug, Clone, Copy)]
pub struct TruePlane {
    /// Unit normal.
    pub normal: Vector,
    /// A point on it.
    pub point: Point,
}

/// How near a guess must come.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    /// 1 - |cos| of the angle between the normals.
    pub angle: f64,
    /// Distance of the guess's point from the true plane, fraction of D.
    pub distance: f64,
}

/// The scores of a shape, or their means.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Scores {
    /// Mean precision at the hits.
    pub map: f64,
    /// The same divided by the number of true planes: planes that are missed count.
    pub map_recall: f64,
    /// Whether the first guess hits.
    pub phc: f64,
}

impl Limits {
    /// Limits of `degrees` and `distance` (fraction of D).
    pub fn new(degrees: f64, distance: f64) -> Self {
        Self {
            angle: 1.0 - degrees.to_radians().cos(),
            distance,
        }
    }
}

impl Scores {
    /// The scores of `guesses` at a shape of diagonal `d`. Each guess, by falling confidence, claims
    /// the nearest true plane within `limits` that is still free.
    pub fn of(guesses: &[Guess], truth: &[TruePlane], d: f64, limits: Limits) -> Self {
        let mut sorted = guesses.to_vec();
        sorted.sort_by(|a, b| b.confidence.total_cmp(&a.confidence));
        let mut free: Vec<&TruePlane> = truth.iter().collect();
        let mut hits = 0;
        let mut precisions = Vec::new();
        for (visited, guess) in (1..).zip(&sorted) {
            if let Some(k) = claim(guess, &free, d, limits) {
                free.remove(k);
                hits += 1;
                precisions.push(f64::from(hits) / f64::from(visited));
            }
        }
        // Not `sum`, which makes -0 of nothing.
        let sum = precisions.iter().fold(0.0, |sum, p| sum + p);
        Self {
            map: sum / precisions.len().max(1) as f64,
            map_recall: sum / truth.len().max(1) as f64,
            phc: f64::from(u8::from(precisions.first() == Some(&1.0))),
        }
    }

    /// The mean scores of several shapes; none of none.
    pub fn mean(scores: &[Self]) -> Option<Self> {
        let n = scores.len() as f64;
        let mean = |of: fn(&Self) -> f64| scores.iter().map(of).sum::<f64>() / n;
        (!scores.is_empty()).then(|| Self {
            map: mean(|s| s.map),
            map_recall: mean(|s| s.map_recall),
            phc: mean(|s| s.phc),
        })
    }
}

/// The free plane that `guess` claims.
fn claim(guess: &Guess, free: &[&TruePlane], d: f64, limits: Limits) -> Option<usize> {
    let normal = guess.normal.normalize();
    let cost = |plane: &TruePlane| {
        let angle = 1.0 - normal.dot(&plane.normal).abs();
        let distance = plane.normal.dot(&(guess.point - plane.point)).abs() / d;
        (angle <= limits.angle && distance <= limits.distance).then_some(angle + distance)
    };
    let near = (0..).zip(free).filter_map(|(k, p)| Some((cost(p)?, k)));
    near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, k)| k)
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: TruePlane = TruePlane {
        normal: Vector::new(1.0, 0.0, 0.0),
        point: Point::new(0.0, 0.0, 0.0),
    };
    const Y: TruePlane = TruePlane {
        normal: Vector::new(0.0, 1.0, 0.0),
        point: Point::new(0.0, 0.0, 0.0),
    };

    fn guess(degrees: f64, shift: f64, confidence: f64) -> Guess {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Guess {
            normal: Vector::new(cos, sin, 0.0) * 7.0,
            point: Point::new(shift, 0.0, 0.0),
            confidence,
        }
    }

    fn scores(guesses: &[Guess]) -> [f64; 3] {
        let s = Scores::of(guesses, &[X, Y], 10.0, Limits::new(5.0, 0.02));
        [s.map, s.map_recall, s.phc]
    }

    #[test]
    fn nothing_scores_nothing() {
        assert_eq!(scores(&[]), [0.0; 3]);
        assert_eq!(scores(&[guess(45.0, 0.0, 1.0)]), [0.0; 3]);
    }

    #[test]
    fn a_missed_plane_counts_in_mapr_only() {
        assert_eq!(scores(&[guess(0.0, 0.0, 1.0)]), [1.0, 0.5, 1.0]);
        // Either side of the limits: 5 degrees, 0.2 units.
        assert_eq!(scores(&[guess(184.9, 0.19, 1.0)]), [1.0, 0.5, 1.0]);
        assert_eq!(scores(&[guess(5.1, 0.0, 1.0)]), [0.0; 3]);
        assert_eq!(scores(&[guess(0.0, 0.21, 1.0)]), [0.0; 3]);
    }

    #[test]
    fn order_is_that_of_confidence() {
        // Miss, hit, miss, hit: precisions 1/2 and 2/4.
        let guesses = [
            guess(0.0, 0.0, 0.8),
            guess(45.0, 0.0, 0.9),
            guess(90.0, 0.0, 0.6),
            guess(30.0, 0.0, 0.7),
        ];
        assert_eq!(scores(&guesses), [0.5, 0.5, 0.0]);
        // Hit, miss, hit: precisions 1 and 2/3.
        let guesses = [
            guess(0.0, 0.0, 0.9),
            guess(45.0, 0.0, 0.8),
            guess(90.0, 0.0, 0.7),
        ];
        let [map, map_recall, phc] = scores(&guesses);
        assert!((map - 5.0 / 6.0).abs() < 1e-15 && (map_recall - 5.0 / 6.0).abs() < 1e-15);
        assert_eq!(phc, 1.0);
    }

    #[test]
    fn a_true_plane_is_claimed_once_and_the_nearest_first() {
        // The second guess finds its plane taken: hit, miss.
        assert_eq!(
            scores(&[guess(0.0, 0.0, 0.9), guess(1.0, 0.0, 0.8)]),
            [1.0, 0.5, 1.0]
        );
        // Two true planes 4 degrees apart; a guess at 3 takes the one at 4, which leaves that at 0.
        let near = TruePlane {
            normal: guess(4.0, 0.0, 0.0).normal / 7.0,
            ..X
        };
        let guesses = [guess(3.0, 0.0, 0.9), guess(-4.0, 0.0, 0.8)];
        let s = Scores::of(&guesses, &[X, near], 10.0, Limits::new(5.0, 0.02));
        assert_eq!([s.map, s.map_recall, s.phc], [1.0; 3]);
    }

    #[test]
    fn means_are_over_shapes() {
        let one = Scores {
            map: 1.0,
            map_recall: 0.5,
            phc: 1.0,
        };
        let mean = Scores::mean(&[one, Scores::default()]).unwrap();
        assert_eq!([mean.map, mean.map_recall, mean.phc], [0.5, 0.25, 0.5]);
        assert_eq!(Scores::mean(&[]), None);
    }
}
