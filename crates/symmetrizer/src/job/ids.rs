//! Names that last: a symmetry found again keeps its id.

use crate::job::Detected;
use crate::patch::Symmetry;
use crate::report::faces::FaceSamples;

/// A symmetry is the one of before whose patch it covers to at least this share; ours.
const MIN_OVERLAP: f64 = 0.5;

/// Gives each symmetry of `after` the id of the one of `before` with which its patch has the most
/// area in common, the highest first, and new ids to the rest. Both states have the same triangles.
pub fn carry(before: (&Detected, &FaceSamples), after: (&mut Detected, &FaceSamples)) {
    let (before, faces_before) = before;
    let (after, faces_after) = after;
    let areas = &before.working.surface.face_areas;
    let mut earlier: Vec<(u32, Vec<bool>)> = before
        .symmetries()
        .iter()
        .map(|s| (s.id, covered(before, faces_before, s)))
        .collect();
    let mut next = earlier.iter().map(|(id, _)| id + 1).max().unwrap_or(0);
    let ids: Vec<u32> = after
        .symmetries()
        .iter()
        .map(|s| {
            let mine = covered(after, faces_after, s);
            let id = take_largest(&mut earlier, &mine, areas);
            id.unwrap_or_else(|| {
                next += 1;
                next - 1
            })
        })
        .collect();
    for (s, id) in after.detection.symmetries.iter_mut().zip(ids) {
        s.id = id;
    }
}

/// Which working triangles a symmetry holds for.
fn covered(found: &Detected, faces: &FaceSamples, symmetry: &Symmetry) -> Vec<bool> {
    let mut covered = vec![false; found.working.surface.triangles.len()];
    let count = found.detection.samples.list.len();
    for f in faces.patch(symmetry, count).into_iter().flatten() {
        covered[f as usize] = true;
    }
    covered
}

/// Takes out of `earlier` the one with the most area in common with `mine`, if that is enough.
fn take_largest(earlier: &mut Vec<(u32, Vec<bool>)>, mine: &[bool], areas: &[f64]) -> Option<u32> {
    let area = |of: &dyn Fn(usize) -> bool| -> f64 {
        (0..areas.len()).filter(|&f| of(f)).map(|f| areas[f]).sum()
    };
    let (k, _) = earlier
        .iter()
        .enumerate()
        .filter_map(|(k, (_, theirs))| {
            let common = area(&|f| theirs[f] && mine[f]);
            let enough = MIN_OVERLAP * area(&|f| theirs[f]);
            (common > 0.0 && common >= enough).then_some((k, common))
        })
        .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))?;
    Some(earlier.remove(k).0)
}
