//! The inside of an outline as flat triangles: what is deformed where the stages see a wall.
//!
//! Constrained Delaunay, refined until no angle is small, then relaxed in the spirit of Alliez et al. 2005:
//! inner vertices move to the mean of the circumcentres around them, weighted by area over the squared size
//! that triangles are to have there, and the triangulation is made anew.

use std::collections::{BTreeMap, VecDeque};

use spade::handles::{FixedFaceHandle, InnerTag, PossiblyOuterTag};
use spade::{
    AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation,
};

use crate::error::{Error, Result};
use crate::geom::{Point, PointIndex, Vector};
use crate::shape::surface::{Surface, SurfacePoint};
use crate::shape::wall::Wall;

/// Least angle that refinement asks for, degrees.
const ANGLE: f64 = 28.0;
/// Longest side of a triangle, fraction of L.
const LONGEST: f64 = 0.04;
/// Triangles beside the outline are as long as its edges; with the distance from it they grow by this share.
const GROWTH: f64 = 0.5;
/// Rounds of relaxation.
const ROUNDS: usize = 4;
/// Vertices that refinement adds at the most, for each of the outline.
const ADDED: usize = 10;

type Delaunay = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The inside of a wall.
#[derive(Debug, Clone)]
pub struct Sheet {
    /// Its triangles, counter-clockwise at z = 0, working coordinates.
    pub surface: Surface,
    /// The vertex at the start of each edge of the wall.
    pub corners: Vec<u32>,
    /// For each edge of the wall the triangle on it, and which of its corners the edge's ends are.
    sides: Vec<(u32, [usize; 2])>,
}

impl Sheet {
    /// Fills `wall`.
    ///
    /// # Errors
    /// [`Error::Input`] where its rings enclose nothing.
    pub fn new(wall: &Wall) -> Result<Self> {
        let outline = Edges::of(wall);
        let mut delaunay = outline.delaunay(&outline.places)?;
        let parameters = RefinementParameters::<f64>::new()
            .with_angle_limit(AngleLimit::from_deg(ANGLE))
            .with_max_allowed_area(LONGEST * LONGEST * 3.0_f64.sqrt() / 4.0)
            .with_max_additional_vertices(ADDED * outline.places.len())
            .keep_constraint_edges()
            .exclude_outer_faces(true);
        delaunay.refine(parameters);
        let mut places: Vec<Point2<f64>> = delaunay.vertices().map(|v| v.position()).collect();
        let mut triangles = inside(&delaunay);
        drop_unused(&mut places, &mut triangles, outline.places.len());
        let size = Size::along(wall);
        for _ in 0..ROUNDS {
            relax(&mut places, &triangles, outline.places.len(), &size);
            triangles = inside(&outline.delaunay(&places)?);
        }
        outline.filled(&places, triangles)
    }

    /// The point of the sheet that a point of the wall is.
    pub fn at(&self, on_wall: &SurfacePoint) -> SurfacePoint {
        let (edge, t) = Wall::on_edge(on_wall);
        let (face, [a, b]) = self.sides[edge];
        let mut bary = [0.0; 3];
        bary[a] += 1.0 - t;
        bary[b] += t;
        SurfacePoint { face, bary }
    }

    /// Where the wall's vertices are when those of the sheet are at `positions`.
    pub fn wall(&self, wall: &Wall, positions: &[Point]) -> Vec<Point> {
        let rest = wall.surface.positions.chunks_exact(2);
        rest.zip(&self.corners)
            .flat_map(|(pair, &v)| {
                let x = positions[v as usize];
                [0, 1].map(|k| Point::new(x.x, x.y, pair[k].z))
            })
            .collect()
    }

    /// For each triangle what the nearest edge of the wall has.
    pub fn nearest_on<T>(&self, wall: &Wall, of_edge: impl Fn(usize) -> T) -> Vec<T> {
        let starts: Vec<[f64; 3]> = (0..wall.edges())
            .map(|e| wall.start(e).coords.into())
            .collect();
        let index = PointIndex::new(&starts);
        let nearest = |f: u32| {
            let [a, b, c] = self.surface.corners(f);
            let middle = (a.coords + b.coords + c.coords) / 3.0;
            of_edge(index.nearest(&middle.into()).map_or(0, |(e, _)| e as usize))
        };
        (0..self.surface.triangles.len() as u32)
            .map(nearest)
            .collect()
    }
}

/// The outline as the triangulation has it: places that differ, and the edges between them.
struct Edges {
    places: Vec<Point2<f64>>,
    /// The place of each edge's start, and of its end.
    ends: Vec<[usize; 2]>,
}

impl Edges {
    fn of(wall: &Wall) -> Self {
        let mut known = BTreeMap::new();
        let mut places = Vec::new();
        // Rings may touch: one vertex for both.
        let corners: Vec<usize> = (0..wall.edges())
            .map(|e| {
                let x = wall.start(e);
                let key = [x.x, x.y].map(|c| (c + 0.0).to_bits());
                *known.entry(key).or_insert_with(|| {
                    places.push(Point2::new(x.x, x.y));
                    places.len() - 1
                })
            })
            .collect();
        let ends = (0..wall.edges()).map(|e| [corners[e], corners[wall.next(e)]]);
        Self {
            ends: ends.collect(),
            places,
        }
    }

    /// The triangulation of `places`, the first of which are the outline's.
    fn delaunay(&self, places: &[Point2<f64>]) -> Result<Delaunay> {
        let mut edges: Vec<[usize; 2]> =
            self.ends.iter().copied().filter(|[a, b]| a != b).collect();
        edges.iter_mut().for_each(|e| e.sort_unstable());
        edges.sort_unstable();
        edges.dedup();
        // Edges that rounding has made to cross are left out.
        Delaunay::try_bulk_load_cdt(places.to_vec(), edges, |_| ()).map_err(|e| {
            let what = format!("the outline could not be filled: {e}");
            Error::input(what, "coordinates may be too large or no numbers")
        })
    }

    /// The sheet of `triangles` over `places`.
    fn filled(&self, places: &[Point2<f64>], triangles: Vec<[u32; 3]>) -> Result<Sheet> {
        if triangles.is_empty() {
            return Err(Error::input(
                "the outline encloses nothing",
                "it needs an area: close its paths, or give strokes a width",
            ));
        }
        let mut on: BTreeMap<[u32; 2], (u32, [usize; 2])> = BTreeMap::new();
        let mut any: BTreeMap<u32, (u32, usize)> = BTreeMap::new();
        for (f, corners) in (0..).zip(&triangles) {
            for k in 0..3 {
                let next = (k + 1) % 3;
                on.insert([corners[k], corners[next]], (f, [k, next]));
                any.entry(corners[k]).or_insert((f, k));
            }
        }
        let side = |&[a, b]: &[usize; 2]| {
            let [a, b] = [a, b].map(|v| v as u32);
            let flipped = || on.get(&[b, a]).map(|&(f, [x, y])| (f, [y, x]));
            let found = on.get(&[a, b]).copied().or_else(flipped);
            // An edge that was left out stands for its first end.
            found.or_else(|| any.get(&a).map(|&(f, k)| (f, [k, k])))
        };
        let sides = self
            .ends
            .iter()
            .map(|ends| side(ends).unwrap_or((0, [0, 0])));
        let positions = places.iter().map(|p| Point::new(p.x, p.y, 0.0)).collect();
        Ok(Sheet {
            sides: sides.collect(),
            corners: self.ends.iter().map(|e| e[0] as u32).collect(),
            surface: Surface::new(positions, triangles.into()),
        })
    }
}

/// The inside of closed rings as a triangulation of their points alone, numbered over all rings.
///
/// # Errors
/// [`Error::Input`] for coordinates that are too large or no numbers.
pub fn between(rings: &[Vec<Point>]) -> Result<Surface> {
    let mut ends = Vec::new();
    for ring in rings {
        let (first, count) = (ends.len(), ring.len());
        ends.extend((0..count).map(|k| [first + k, first + (k + 1) % count]));
    }
    let positions: Vec<Point> = rings.iter().flatten().copied().collect();
    let places = positions.iter().map(|x| Point2::new(x.x, x.y)).collect();
    let edges = Edges { places, ends };
    let delaunay = edges.delaunay(&edges.places)?;
    // Two samples at one place, where rings touch, would shift the numbers.
    let triangles = match delaunay.num_vertices() == positions.len() {
        true => inside(&delaunay),
        false => Vec::new(),
    };
    Ok(Surface::new(positions, triangles.into()))
}

/// The triangles inside: those behind an odd number of edges of the outline, counted from without.
fn inside(delaunay: &Delaunay) -> Vec<[u32; 3]> {
    let mut parity: Vec<Option<bool>> = vec![None; delaunay.num_all_faces()];
    let outer = delaunay.outer_face().fix();
    parity[outer.index()] = Some(false);
    let mut queue: VecDeque<FixedFaceHandle<PossiblyOuterTag>> = VecDeque::from([outer]);
    // The outer face is surrounded by the hull.
    let mut hull: Vec<_> = delaunay.convex_hull().map(|e| e.fix()).collect();
    while let Some(face) = queue.pop_front() {
        let was = parity[face.index()].unwrap_or_default();
        let inner = delaunay.face(face).as_inner();
        let edges = match inner {
            Some(inner) => inner.adjacent_edges().map(|e| e.fix()).to_vec(),
            None => std::mem::take(&mut hull),
        };
        for edge in edges {
            let edge = delaunay.directed_edge(edge);
            // Hull edges are those of the outer face, triangles' their own.
            let over = if edge.face().fix() == face {
                edge.rev()
            } else {
                edge
            };
            let next = over.face().fix();
            if parity[next.index()].is_none() {
                parity[next.index()] = Some(was != edge.is_constraint_edge());
                queue.push_back(next);
            }
        }
    }
    let kept = delaunay.inner_faces().filter(|f| {
        let face: FixedFaceHandle<InnerTag> = f.fix();
        parity[face.index()] == Some(true)
    });
    let corners = kept.map(|f| f.vertices().map(|v| v.fix().index() as u32));
    let mut triangles: Vec<[u32; 3]> = corners.collect();
    triangles.sort_unstable();
    triangles
}

/// Drops places beyond the first `kept` that no triangle has.
fn drop_unused(places: &mut Vec<Point2<f64>>, triangles: &mut [[u32; 3]], kept: usize) {
    let mut used = vec![false; places.len()];
    used[..kept].fill(true);
    triangles
        .iter()
        .flatten()
        .for_each(|&v| used[v as usize] = true);
    let mut number = vec![0; places.len()];
    let mut count = 0;
    for (v, used) in used.iter().enumerate() {
        number[v] = count;
        count += u32::from(*used);
    }
    let mut flags = used.iter();
    places.retain(|_| *flags.next().unwrap_or(&true));
    triangles
        .iter_mut()
        .flatten()
        .for_each(|v| *v = number[*v as usize]);
}

/// How long triangles are to be.
struct Size {
    outline: PointIndex<3>,
    lengths: Vec<f64>,
}

impl Size {
    fn along(wall: &Wall) -> Self {
        let places: Vec<[f64; 3]> = (0..wall.edges())
            .map(|e| wall.start(e).coords.into())
            .collect();
        Self {
            outline: PointIndex::new(&places),
            lengths: (0..wall.edges())
                .map(|e| (wall.start(wall.next(e)) - wall.start(e)).norm())
                .collect(),
        }
    }

    /// At a place, fraction of L.
    fn at(&self, x: f64, y: f64) -> f64 {
        let nearest = self.outline.nearest(&[x, y, 0.0]);
        let (e, squared) = nearest.unwrap_or((0, 0.0));
        (self.lengths[e as usize] + GROWTH * squared.sqrt()).min(LONGEST)
    }
}

/// Moves the places beyond the first `fixed` to the weighted means of the circumcentres around them.
fn relax(places: &mut [Point2<f64>], triangles: &[[u32; 3]], fixed: usize, size: &Size) {
    let at = |v: u32| Point::new(places[v as usize].x, places[v as usize].y, 0.0);
    let mut sums = vec![(Vector::zeros(), 0.0); places.len()];
    for corners in triangles {
        let [a, b, c] = corners.map(at);
        let middle = Point::from((a.coords + b.coords + c.coords) / 3.0);
        let area = (b - a).cross(&(c - a)).z / 2.0;
        // The circumcentre of an obtuse triangle lies outside: its middle stands for it.
        let center = circumcentre(&a, &b, &c).unwrap_or(middle);
        let mass = area / size.at(middle.x, middle.y).powi(2);
        for &v in corners {
            let sum = &mut sums[v as usize];
            sum.0 += mass * center.coords;
            sum.1 += mass;
        }
    }
    for (place, (sum, mass)) in places.iter_mut().zip(sums).skip(fixed) {
        if mass > 0.0 {
            *place = Point2::new(sum.x / mass, sum.y / mass);
        }
    }
}

/// The circumcentre of a counter-clockwise triangle; `None` where it lies outside.
fn circumcentre(a: &Point, b: &Point, c: &Point) -> Option<Point> {
    let (u, v, w) = (b - a, c - a, c - b);
    if u.dot(&v) < 0.0 || u.dot(&w) > 0.0 || v.dot(&w) < 0.0 {
        return None;
    }
    let doubled = 2.0 * u.cross(&v).z;
    let (p, q) = (u.norm_squared(), v.norm_squared());
    let center = a + Vector::new(v.y * p - u.y * q, u.x * q - v.x * p, 0.0) / doubled;
    center.iter().all(|c| c.is_finite()).then_some(center)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square with a square hole.
    fn framed() -> Wall {
        let square =
            |r: f64| [[-r, -r], [r, -r], [r, r], [-r, r]].map(|[x, y]| Point::new(x, y, 0.0));
        let mut hole = square(1.0).to_vec();
        hole.reverse();
        Wall::new(&[square(3.0).to_vec(), hole]).expect("a wall")
    }

    #[test]
    fn a_frame_is_filled_but_for_its_hole() {
        let wall = framed();
        let sheet = Sheet::new(&wall).expect("a sheet");
        let area = 32.0 / wall.normalization.scale.powi(2);
        assert!((sheet.surface.area() - area).abs() < 1e-9 * area);
        assert!(sheet.surface.face_normals.iter().all(|n| n.z > 0.5));
        let least = (0..sheet.surface.triangles.len() as u32).map(|f| {
            let x = sheet.surface.corners(f);
            let angle = |k: usize| {
                let (u, v) = (x[(k + 1) % 3] - x[k], x[(k + 2) % 3] - x[k]);
                u.angle(&v).to_degrees()
            };
            (0..3).map(angle).fold(f64::INFINITY, f64::min)
        });
        let least = least.fold(f64::INFINITY, f64::min);
        assert!(least > 20.0, "{least} degrees");
    }

    #[test]
    fn points_of_the_wall_are_points_of_the_sheet() {
        let wall = framed();
        let sheet = Sheet::new(&wall).expect("a sheet");
        for ring in 0..2 {
            for k in 0..50 {
                let at = wall.at(ring, 0.037 * f64::from(k));
                let (x, y) = (wall.surface.point(&at), sheet.surface.point(&sheet.at(&at)));
                assert!((x - y).norm() < 1e-9, "{x} {y}");
            }
        }
        let same = sheet.wall(&wall, &sheet.surface.positions);
        assert_eq!(same, wall.surface.positions);
    }
}
