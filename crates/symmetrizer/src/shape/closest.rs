//! Closest points on a surface: parry's bounding-volume hierarchy behind our own types.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector as GlamVector;
use parry3d_f64::query::{PointQuery, PointQueryWithLocation};
use parry3d_f64::shape::{TriMesh, TrianglePointLocation};

use crate::geom::{Point, Vector};
use crate::shape::surface::{Surface, SurfacePoint};

/// The answer to a closest-point query.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The closest point as a surface point.
    pub at: SurfacePoint,
    /// Its position.
    pub point: Point,
    /// Its distance from the query.
    pub distance: f64,
}

/// Finds closest points on a fixed state of a surface.
#[derive(Clone)]
pub struct ClosestPoint {
    tree: TriMesh,
    face_normals: Vec<Vector>,
}

impl ClosestPoint {
    /// Builds the hierarchy over the triangles of `surface` as it is now.
    pub fn new(surface: &Surface) -> Self {
        let vertices = surface.positions.iter().map(to_glam).collect();
        let tree = TriMesh::new(vertices, surface.triangles.to_vec())
            .expect("a working surface has triangles with valid indices");
        Self {
            tree,
            face_normals: surface.face_normals.clone(),
        }
    }

    /// Goes over to another state of the same triangles. The hierarchy keeps its shape and only its boxes
    /// are made anew: a tenth of the work, and as good as long as neighbours stay neighbours.
    pub fn follow(&mut self, surface: &Surface) {
        let to = surface.positions.iter().map(to_glam);
        self.tree
            .update_vertices(|vertices| vertices.iter_mut().zip(to).for_each(|(v, x)| *v = x));
        self.face_normals.clone_from(&surface.face_normals);
    }

    /// The closest point within `max_distance`, on any face.
    pub fn nearest(&self, query: &Point, max_distance: f64) -> Option<Hit> {
        self.nearest_from(query, max_distance, None)
    }

    /// The same, found sooner where the answer is near the face `guess`.
    pub fn nearest_from(
        &self,
        query: &Point,
        max_distance: f64,
        guess: Option<u32>,
    ) -> Option<Hit> {
        let within = guess.map_or(max_distance, |face| self.at_most(face, query, max_distance));
        self.search(query, within, |_| true)
    }

    /// The closest point within `max_distance` among faces whose normal makes an angle with
    /// `normal` of cosine at least `min_cos`: never the far side of a thin ear.
    pub fn nearest_facing(
        &self,
        query: &Point,
        normal: &Vector,
        min_cos: f64,
        max_distance: f64,
    ) -> Option<Hit> {
        self.nearest_facing_from(query, normal, min_cos, max_distance, None)
    }

    /// The same, found sooner where the answer is near the face `guess`.
    pub fn nearest_facing_from(
        &self,
        query: &Point,
        normal: &Vector,
        min_cos: f64,
        max_distance: f64,
        guess: Option<u32>,
    ) -> Option<Hit> {
        let faces = |face: u32| self.face_normals[face as usize].dot(normal) >= min_cos;
        let guess = guess.filter(|&face| faces(face));
        let within = guess.map_or(max_distance, |face| self.at_most(face, query, max_distance));
        self.search(query, within, faces)
    }

    /// How far the closest point is at the most where `face` may be hit.
    fn at_most(&self, face: u32, query: &Point, max_distance: f64) -> f64 {
        let q = to_glam(query);
        let there = self.tree.triangle(face).project_local_point(q, false);
        // A little more, in working units, so that of faces at one distance the same one is found as without a guess.
        let distance = (there.point - q).length() * (1.0 + 1e-9) + ROUNDING;
        distance.min(max_distance)
    }

    fn search(
        &self,
        query: &Point,
        max_distance: f64,
        accepts: impl Fn(u32) -> bool,
    ) -> Option<Hit> {
        let q = to_glam(query);
        // Squares compare as lengths do, and roots are most of what a box costs.
        let (face, (square, (point, location))) = self.tree.bvh().find_best(
            max_distance * max_distance,
            |node, _| square_distance(&node.aabb(), q),
            |face, best| {
                if !accepts(face) {
                    return None;
                }
                let triangle = self.tree.triangle(face);
                let normal = to_glam(&Point::from(self.face_normals[face as usize]));
                let height = (q - triangle.a).dot(normal);
                if height * height >= best {
                    return None;
                }
                let (projection, location) =
                    triangle.project_local_point_and_get_location(q, false);
                let cost = (projection.point - q).length_squared();
                Some((cost, (projection.point, location)))
            },
        )?;
        Some(Hit {
            at: SurfacePoint {
                face,
                bary: barycentric(&location),
            },
            point: Point::new(point.x, point.y, point.z),
            distance: square.sqrt(),
        })
    }
}

/// Distances below this are nothing, fraction of L.
const ROUNDING: f64 = 1e-12;

/// The squared distance of a point from a box, 0 inside.
fn square_distance(bounds: &Aabb, x: GlamVector) -> f64 {
    let outside = (bounds.mins - x).max(x - bounds.maxs);
    outside.max(GlamVector::ZERO).length_squared()
}

fn barycentric(location: &TrianglePointLocation) -> [f64; 3] {
    match location {
        TrianglePointLocation::OnVertex(i) => {
            let mut b = [0.0; 3];
            b[*i as usize] = 1.0;
            b
        }
        other => other.barycentric_coordinates().unwrap_or([1.0, 0.0, 0.0]),
    }
}

fn to_glam(p: &Point) -> GlamVector {
    GlamVector::new(p.x, p.y, p.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::models::Creature;
    use crate::shape::working::Working;

    /// With a guess, good or bad, the answer is that without one, to the last bit.
    #[test]
    fn a_guess_changes_nothing() {
        let surface = Working::new(&Creature::default().mesh())
            .expect("usable")
            .surface;
        let closest = ClosestPoint::new(&surface);
        let faces = surface.triangles.len() as u32;
        let mut found = 0;
        for k in 0..600_u32 {
            let face = k * (faces / 600);
            let normal = surface.face_normals[face as usize];
            let [a, b, c] = surface.corners(face);
            let centre = Point::from((a.coords + b.coords + c.coords) / 3.0);
            // On the surface, at a corner, and off it.
            for x in [centre, a, centre + 0.01 * normal] {
                let alone = closest.nearest_facing(&x, &normal, 0.75, 0.02);
                let any = closest.nearest(&x, f64::INFINITY);
                found += u32::from(alone.is_some());
                for guess in [face, (face + 1) % faces, (face + faces / 2) % faces] {
                    let guessed = closest.nearest_facing_from(&x, &normal, 0.75, 0.02, Some(guess));
                    assert_eq!(alone, guessed);
                    assert_eq!(any, closest.nearest_from(&x, f64::INFINITY, Some(guess)));
                }
            }
        }
        assert!(found > 1700, "{found}");
    }
}
