//! Names that last: a symmetry found again keeps its id.

use crate::geom::PointIndex;
use crate::patch::symmetry::Symmetry;
use crate::sample::Samples;
use crate::shape::Surface;

/// A symmetry is the one of before whose patch it covers to at least this share; ours.
const MIN_OVERLAP: f64 = 0.5;

/// Gives each of the symmetries `after` the id of the one `before` with which its patch has the most
/// in common, the first first, and ids from `next` on to the rest; returns the next free id. Both were found on states of one surface,
/// whose rest state places the samples of both.
pub fn carry_ids(
    rest: &Surface,
    before: (&Samples, &[Symmetry]),
    after: (&Samples, &mut [Symmetry]),
    mut next: u32,
) -> u32 {
    let (samples, symmetries) = before;
    let (samples_after, symmetries_after) = after;
    let places: Vec<[f64; 3]> = samples_after
        .list
        .iter()
        .map(|s| rest.point(&s.at).coords.into())
        .collect();
    let index = PointIndex::new(&places);
    // For each earlier sample the later one that stands for the same place.
    let successor: Vec<Option<u32>> = samples
        .list
        .iter()
        .map(|s| {
            index
                .nearest(&rest.point(&s.at).coords.into())
                .map(|(j, _)| j)
        })
        .collect();
    let mut earlier: Vec<&Symmetry> = symmetries.iter().collect();
    for s in symmetries_after {
        let member = s.membership(samples_after.list.len());
        s.id = match take_largest(&mut earlier, &successor, &member) {
            Some(id) => id,
            None => {
                next += 1;
                next - 1
            }
        };
    }
    next
}

/// Takes out of `earlier` the one with the most samples in `member`, if they are enough of its own.
fn take_largest(
    earlier: &mut Vec<&Symmetry>,
    successor: &[Option<u32>],
    member: &[bool],
) -> Option<u32> {
    let common = |s: &Symmetry| {
        let inside = s
            .pairs
            .iter()
            .filter(|pair| successor[pair.sample as usize].is_some_and(|j| member[j as usize]));
        inside.count()
    };
    let (k, _) = earlier
        .iter()
        .enumerate()
        .map(|(k, s)| (k, common(s)))
        .filter(|&(k, n)| n > 0 && n as f64 >= MIN_OVERLAP * earlier[k].pairs.len() as f64)
        .max_by(|a, b| a.1.cmp(&b.1).then(b.0.cmp(&a.0)))?;
    Some(earlier.remove(k).id)
}
