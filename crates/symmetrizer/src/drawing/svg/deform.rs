//! A document deformed: paths bent, gradients turned along, texts and images moved.

use std::collections::BTreeMap;

use kurbo::{Affine, Point, Rect, Vec2};
use roxmltree::{Document, Node};

use super::edit::{Edit, Edits};
use super::scene::{Paint, Piece, Role, Scene, Spot, Whole, by_id, node, referenced};
use super::units::{matrix, transform};
use super::{motion, silhouette, viewport};
use crate::drawing::outline::{Outline, Ring};
use crate::drawing::path::bend::Bending;
use crate::drawing::path::{Path, write};
use crate::error::{Error, Result};

/// Of the drawing's diagonal: how near curves lie to the deformed ones.
const TOLERANCE: f64 = 1e-4;

/// Of the diagonal: coordinates are written this exactly. A drawing of 512 units has three decimals.
const PRECISION: f64 = 1e-5;

/// Of the diagonal: what moves less than this has not moved.
const STILL: f64 = 1e-9;

/// Of the diagonal: half the width over which a map is differentiated. A map that is linear on
/// pieces is averaged over them.
const STEP: f64 = 1e-4;

/// Gradients that refer to each other.
const CHAIN: usize = 16;

/// Of the diagonal: how far from the region strokes and loose paths belong to it.
const BESIDE: f64 = 0.03;

type Map<'a> = &'a dyn Fn(Point) -> Point;

/// The changes of a document whose drawing, the region inside `outline`, is deformed. What lies apart from it stays:
/// as a whole the region stays where it is, too.
///
/// # Errors
/// [`Error::Numerical`] where the map leads to points that are no numbers.
pub(super) fn edits(
    tree: &Document<'_>,
    scene: &Scene,
    outline: &Outline,
    map: Map<'_>,
) -> Result<Edits> {
    let diagonal = diagonal(scene);
    let beside = Beside {
        outline,
        reach: BESIDE * diagonal,
    };
    let bending = Bending {
        map,
        tolerance: TOLERANCE * diagonal,
        step: STEP * diagonal,
    };
    let mut edits = Edits::new();
    let moving = |p: &&Piece| p.role != Role::Background;
    let mut around: Option<Rect> = None;
    for (number, piece) in scene.pieces.iter().enumerate().filter(|(_, p)| moving(p)) {
        let placed = piece.path.transformed(piece.place);
        if beside.is_apart(&placed) {
            continue;
        }
        let Some(bent) = bending.path(&placed, STILL * diagonal) else {
            continue;
        };
        if !bent.control_points().all(Point::is_finite) {
            return Err(Error::Numerical {
                stage: "drawing",
                step: number,
                what: "the deformation leads to points that are no numbers".into(),
            });
        }
        if matches!(piece.role, Role::Filled(_) | Role::Stroked) {
            let bounds = silhouette::box_of(&bent, Affine::IDENTITY);
            around = around.into_iter().chain(bounds).reduce(|a, b| a.union(b));
        }
        if let Some(back) = inverse(piece.place) {
            let decimals = decimals(piece.place, diagonal);
            let data = write::data(&bent.transformed(back), decimals);
            edits.insert(piece.spot.clone(), vec![Edit::Data(data)]);
        }
    }
    for whole in &scene.wholes {
        edits.extend(moved(whole, diagonal, map));
    }
    let mut painted: Vec<Vec<&Piece>> = vec![Vec::new(); scene.paints.len()];
    for piece in &scene.pieces {
        piece.paints.iter().for_each(|&p| painted[p].push(piece));
    }
    let named = by_id(tree);
    for (paint, pieces) in scene.paints.iter().zip(&painted) {
        let turning = Turning {
            named: &named,
            diagonal,
            map,
        };
        edits.extend(turning.edit(tree, paint, pieces));
    }
    if let Some(around) = around {
        let before = seen(scene);
        edits.extend(viewport::widened(
            tree,
            before,
            around,
            PRECISION * diagonal,
        ));
    }
    Ok(edits)
}

/// What belongs to the region.
struct Beside<'a> {
    outline: &'a Outline,
    /// Strokes at this distance still do.
    reach: f64,
}

impl Beside<'_> {
    /// Whether most of a path's points lie outside and further away, a frame around the drawing, say.
    fn is_apart(&self, path: &Path) -> bool {
        let (mut away, mut count) = (0, 0);
        for p in path.control_points() {
            count += 1;
            away += usize::from(!self.holds(p));
        }
        2 * away > count
    }

    fn holds(&self, p: Point) -> bool {
        let x = crate::geom::Point::new(p.x, p.y, 0.0);
        let near = |(a, b): (&crate::geom::Point, &crate::geom::Point)| {
            let (way, from) = (b - a, x - a);
            let t = from.dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE);
            (from - way * t.clamp(0.0, 1.0)).norm() <= self.reach
        };
        let mut edges = self.outline.rings.iter().flat_map(Ring::edges);
        self.outline.contains(&x) || edges.any(near)
    }
}

/// `None` where an element is squeezed into a line.
fn inverse(place: Affine) -> Option<Affine> {
    let back = place.inverse();
    back.is_finite().then_some(back)
}

/// How many decimals an element needs in its own coordinates.
fn decimals(place: Affine, diagonal: f64) -> u32 {
    let scale = place.determinant().abs().sqrt();
    write::decimals(PRECISION * diagonal / scale)
}

/// An element that moves as a whole: as the plane does at its centre.
fn moved(whole: &Whole, diagonal: f64, map: Map<'_>) -> Option<(Spot, Vec<Edit>)> {
    let motion = motion::rigid(map, whole.centre, STEP * diagonal)?;
    if rests(&motion, whole.centre, diagonal) {
        return None;
    }
    let own = inverse(whole.around)? * motion * whole.around * whole.own;
    let value = matrix(own, decimals(whole.around, diagonal) + 1);
    let edit = Edit::Attribute("transform", value);
    Some((whole.spot.clone(), vec![edit]))
}

fn rests(motion: &Affine, centre: Point, diagonal: f64) -> bool {
    let ends = [
        Vec2::new(diagonal, 0.0),
        Vec2::new(0.0, diagonal),
        Vec2::ZERO,
    ];
    let shift = |v: Vec2| (*motion * (centre + v)).distance(centre + v);
    ends.into_iter().map(shift).fold(0.0, f64::max) <= STILL.sqrt() * diagonal
}

/// Gradients and patterns that turn along.
struct Turning<'a> {
    named: &'a BTreeMap<&'a str, Node<'a, 'a>>,
    diagonal: f64,
    map: Map<'a>,
}

impl Turning<'_> {
    /// A gradient or pattern in user units, turned by the affine map that best fits what happens to
    /// the paths that it paints.
    fn edit(
        &self,
        tree: &Document<'_>,
        paint: &Paint,
        pieces: &[&Piece],
    ) -> Option<(Spot, Vec<Edit>)> {
        let element = node(tree, paint.node)?;
        let (units, attribute) = match element.tag_name().name() {
            "linearGradient" | "radialGradient" => ("gradientUnits", "gradientTransform"),
            "pattern" => ("patternUnits", "patternTransform"),
            _ => return None,
        };
        if self.inherited(element, units)? != "userSpaceOnUse" {
            return None;
        }
        let placed = |p: &&Piece| {
            let place = p.place;
            let points: Vec<Point> = p.path.control_points().map(|c| place * c).collect();
            points
        };
        let points: Vec<Point> = pieces.iter().flat_map(placed).collect();
        let fit = motion::affine(self.map, &points)?;
        if rests(&fit, *points.first()?, self.diagonal) {
            return None;
        }
        let before = self.inherited(element, attribute);
        let own = before.and_then(transform).unwrap_or(Affine::IDENTITY);
        let place = paint.place;
        let turned = inverse(place)? * fit * place * own;
        let value = matrix(turned, decimals(place, self.diagonal) + 1);
        let spot = Spot {
            chain: Vec::new(),
            node: paint.node,
        };
        Some((spot, vec![Edit::Attribute(attribute, value)]))
    }

    /// An attribute of a gradient or of the one it refers to; the default of the units is none.
    fn inherited<'n>(&'n self, first: Node<'n, '_>, name: &str) -> Option<&'n str> {
        let mut element = first;
        // A chain that comes back to itself ends here.
        for _ in 0..CHAIN {
            if let Some(value) = element.attribute(name) {
                return Some(value);
            }
            element = *self.named.get(referenced(element)?)?;
        }
        None
    }
}

/// The box around the paths that are seen.
fn seen(scene: &Scene) -> Rect {
    let seen = scene
        .pieces
        .iter()
        .filter(|p| matches!(p.role, Role::Filled(_) | Role::Stroked));
    let boxes = seen.filter_map(|p| silhouette::box_of(&p.path, p.place));
    boxes.reduce(|a, b| a.union(b)).unwrap_or_default()
}

/// The diagonal of all paths, drawing units.
fn diagonal(scene: &Scene) -> f64 {
    let seen = scene
        .pieces
        .iter()
        .filter(|p| !matches!(p.role, Role::Clip(_)));
    let boxes = seen.filter_map(|p| silhouette::box_of(&p.path, p.place));
    boxes
        .reduce(|a, b| a.union(b))
        .map_or(0.0, |b| b.width().hypot(b.height()))
}
