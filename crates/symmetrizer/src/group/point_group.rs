//! The finite group of the isometries that fix a point.

use crate::geom::{Matrix3, Point, Vector};
use crate::group::closure::{Closed, Pool};
use crate::group::exact::Table;
use crate::group::fixed::common_fixed_point;
use crate::group::name::{Name, principal_axis};
use crate::group::{Verify, Within};
use crate::transform::Isometry;

/// A finite group of isometries that fix a point.
#[derive(Debug, Clone)]
pub struct PointGroup {
    /// Its name after Schoenflies.
    pub name: Name,
    /// The fixed point; where a line or a plane is fixed, its point nearest to the centroid of
    /// the support.
    pub centre: Point,
    /// The unit axis of highest order, or the normal of the only mirror, largest component
    /// positive; the groups of the tetrahedron, octahedron and icosahedron, C1 and Ci have none.
    pub axis: Option<Vector>,
    /// The elements, exact: they fix the centre and their products are among them to 1e-12. The
    /// identity is the first.
    pub elements: Vec<Isometry>,
    /// The elements as they hold on the shape.
    pub measured: Vec<Isometry>,
    /// Which element is the product of which two.
    pub table: Table,
}

/// The largest group found that `generators` and their verified products form about a common
/// fixed point.
///
/// The generators are offered to `verify` like the products. Each in turn is the first of a group,
/// to which the others are added in order as long as all products hold: what leads to a product
/// that is refused, or to more than 120 elements, is left out. `None` where the generators fix no
/// point together (see [`fixed_together`](super::fixed_together)); without generators the group
/// is C1.
pub fn point_group(
    generators: &[Isometry],
    within: Within<'_>,
    verify: &mut Verify<'_>,
) -> Option<PointGroup> {
    let centre = common_fixed_point(generators, within)?;
    let mut pool = Pool::new(within, verify);
    let mut asked: Vec<usize> = generators.iter().filter_map(|t| pool.ask(t)).collect();
    let mut seen = std::collections::BTreeSet::new();
    asked.retain(|&i| i != 0 && seen.insert(i));
    let mut best = pool.close(&[])?;
    for &seed in &asked {
        if let Some(found) = grown(seed, &asked, &mut pool)
            && found.members.len() > best.members.len()
        {
            best = found;
        }
        if asked.iter().all(|i| best.members.contains(i)) {
            break;
        }
    }
    finished(best, &pool, centre, within)
}

/// The group of `seed` with all of `others` that can be added.
fn grown(seed: usize, others: &[usize], pool: &mut Pool<'_, '_>) -> Option<Closed> {
    let mut chosen = vec![seed];
    let mut best = pool.close(&chosen)?;
    for &other in others {
        if best.members.contains(&other) {
            continue;
        }
        chosen.push(other);
        match pool.close(&chosen) {
            Some(larger) => best = larger,
            None => {
                chosen.pop();
            }
        }
    }
    Some(best)
}

/// The group with its exact elements and its name.
fn finished(
    closed: Closed,
    pool: &Pool<'_, '_>,
    centre: Point,
    within: Within<'_>,
) -> Option<PointGroup> {
    let measured = pool.measured(&closed.members);
    let centre = common_fixed_point(&measured, within).unwrap_or(centre);
    let about_centre = |linear: Matrix3| Isometry {
        linear,
        translation: centre.coords - linear * centre.coords,
    };
    let elements: Vec<Isometry> = closed.turns.into_iter().map(about_centre).collect();
    Some(PointGroup {
        name: Name::of(&elements, &closed.table)?,
        centre,
        axis: principal_axis(&elements, &closed.table),
        elements,
        measured,
        table: closed.table,
    })
}
