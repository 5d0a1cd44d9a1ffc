//! Rings with fewer points (Douglas and Peucker 1973).

use crate::geom::Point;

/// Which points of a closed ring stay, so that none lies further than `tolerance` from what is left: in order, two of a
/// ring that is no wider.
pub(super) fn kept(ring: &[Point], tolerance: f64) -> Vec<Point> {
    let count = ring.len();
    if count < 3 {
        return ring.to_vec();
    }
    // Opened at its first point and at the one furthest from it, which stay.
    let away = |k: &usize| (ring[*k] - ring[0]).norm_squared();
    let far = (0..count).max_by(|a, b| away(a).total_cmp(&away(b)));
    let far = far.unwrap_or_default().max(1);
    let at = |k: usize| ring[k % count];
    let mut stays = vec![false; count];
    let mut open = vec![[0, far], [far, count]];
    while let Some([a, b]) = open.pop() {
        stays[a % count] = true;
        stays[b % count] = true;
        let off = |k: &usize| distance(&at(*k), &at(a), &at(b));
        let worst = (a + 1..b).max_by(|i, j| off(i).total_cmp(&off(j)));
        if let Some(k) = worst.filter(|k| off(k) > tolerance) {
            open.extend([[a, k], [k, b]]);
        }
    }
    let points = ring.iter().zip(stays);
    points
        .filter(|(_, stays)| *stays)
        .map(|(x, _)| *x)
        .collect()
}

/// Of a point from a segment.
fn distance(x: &Point, a: &Point, b: &Point) -> f64 {
    let (way, from) = (b - a, x - a);
    let t = from.dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE);
    (from - way * t.clamp(0.0, 1.0)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_of_many_points_has_four_corners() {
        let side = |k: u32| f64::from(k % 100) / 100.0;
        let place = |k: u32| match k / 100 {
            0 => Point::new(side(k), 0.0, 0.0),
            1 => Point::new(1.0, side(k), 0.0),
            2 => Point::new(1.0 - side(k), 1.0, 0.0),
            _ => Point::new(0.0, 1.0 - side(k), 0.0),
        };
        let ring: Vec<Point> = (0..400).map(place).collect();
        assert_eq!(kept(&ring, 1e-9).len(), 4);
        assert_eq!(kept(&ring, 0.0).len(), 4);
        let corners = [ring[0], ring[100], ring[200]];
        assert_eq!(kept(&corners, 0.7).len(), 3);
        assert_eq!(kept(&corners, 0.8).len(), 2);
    }
}
