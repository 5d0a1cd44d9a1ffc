//! How stiff a drawing is, place by place, as its user says it.

use crate::deform::Stiffness;
use crate::deform::stiffness::{PROPERTY, counted};
use crate::drawing::{Drawing, Source};
use crate::error::{Error, Result};
use crate::geom::{Point, PointIndex};
use crate::shape::Mesh;
use crate::shape::wall::Wall;

/// The `stiffness` of each face of the `wall` over a drawing's outline; `None` where it is 1 everywhere. The inside is
/// as stiff as the outline next to it.
///
/// # Errors
/// [`Error::Params`] for what the drawing has not, a wrong count, and values that are not positive and finite.
pub fn per_face(stiffness: &Stiffness, drawing: &Drawing, wall: &Wall) -> Result<Option<Vec<f64>>> {
    stiffness.check_values()?;
    let (places, values) = match stiffness {
        Stiffness::Uniform(1.0) => return Ok(None),
        Stiffness::Uniform(k) => return Ok(Some(vec![*k; wall.surface.triangles.len()])),
        Stiffness::Vertices(k) => of_vertices(k, drawing)?,
        Stiffness::Polygons(k) => of_polygons(k, drawing)?,
        Stiffness::Paths(k) => of_paths(k, drawing)?,
        Stiffness::Places(k) => of_places(k, drawing),
    };
    let places: Vec<[f64; 3]> = places.iter().map(|x| x.coords.into()).collect();
    let index = PointIndex::new(&places);
    let of_edge = |e: usize| {
        let middle = nalgebra::center(&wall.start(e), &wall.start(wall.next(e)));
        let middle = wall.normalization.to_document(&middle);
        let nearest = index.nearest(&[middle.x, middle.y, 0.0]);
        nearest.map_or(1.0, |(k, _)| values[k as usize])
    };
    let doubled = (0..wall.edges()).flat_map(|e| [of_edge(e); 2]);
    Ok(Some(doubled.collect()))
}

/// Places and their values.
type Field = (Vec<Point>, Vec<f64>);

/// Of the vertices of a flat mesh, or of the points of a file of rings.
fn of_vertices(values: &[f64], drawing: &Drawing) -> Result<Field> {
    if let Some(vertices) = drawing.vertices() {
        counted(values.len(), vertices.len(), "vertices")?;
        return Ok((vertices, values.to_vec()));
    }
    if drawing.has_paths() || drawing.is_upside_down() {
        let what =
            "is per vertex, which is for meshes and rings; a drawing takes it per path or place";
        return Err(Error::params(PROPERTY, what));
    }
    let own = sources(drawing).filter(|(_, s)| s.t == 0.0);
    let own: Vec<(Point, usize)> = own.map(|(x, s)| (x, s.segment as usize)).collect();
    let count = own.iter().map(|(_, k)| k + 1).max().unwrap_or_default();
    counted(values.len(), count, "points")?;
    Ok(own.into_iter().map(|(x, k)| (x, values[k])).unzip())
}

/// Of the faces of a flat mesh: a vertex has the mean of those around it.
fn of_polygons(values: &[f64], drawing: &Drawing) -> Result<Field> {
    let (Some(document), Some(vertices)) = (drawing.document(), drawing.vertices()) else {
        let what = "is per face, and the drawing has none; it takes it per path or place";
        return Err(Error::params(PROPERTY, what));
    };
    let mesh: &Mesh = &document.mesh;
    counted(values.len(), mesh.polygons.len(), "faces")?;
    let mut sums = vec![(0.0, 0); vertices.len()];
    for (polygon, k) in mesh.polygons.iter().zip(values) {
        for &v in polygon {
            sums[v as usize].0 += k;
            sums[v as usize].1 += 1;
        }
    }
    let used = vertices.into_iter().zip(sums).filter(|(_, s)| s.1 > 0);
    Ok(used.map(|(x, (sum, n))| (x, sum / f64::from(n))).unzip())
}

/// Of the paths of an SVG file.
fn of_paths(values: &[f64], drawing: &Drawing) -> Result<Field> {
    if !drawing.has_paths() {
        let what = "is per path, and the file has none; it takes it per place";
        return Err(Error::params(PROPERTY, what));
    }
    let own: Vec<(Point, usize)> = sources(drawing)
        .map(|(x, s)| (x, s.path as usize))
        .collect();
    // Paths that nothing is seen of have none of the outline.
    let most = own.iter().map(|(_, k)| k + 1).max().unwrap_or_default();
    if values.len() < most {
        counted(values.len(), most, "paths")?;
    }
    Ok(own.into_iter().map(|(x, k)| (x, values[k])).unzip())
}

/// At places of the file.
fn of_places(places: &[([f64; 2], f64)], drawing: &Drawing) -> Field {
    let up = if drawing.is_upside_down() { -1.0 } else { 1.0 };
    let place = |(x, k): &([f64; 2], f64)| (Point::new(x[0], up * x[1], 0.0), *k);
    places.iter().map(place).unzip()
}

/// The points of the outline that lie on a path, with where.
fn sources(drawing: &Drawing) -> impl Iterator<Item = (Point, Source)> {
    let rings = drawing.outline().rings.iter();
    let all = rings.flat_map(|r| r.points.iter().zip(&r.sources));
    all.filter_map(|(x, source)| Some((*x, (*source)?)))
}
