//! The region that a scene fills.

use kurbo::{Affine, Rect, Shape};

use super::scene::{Piece, Role, Scene};
use crate::drawing::outline::Outline;
use crate::drawing::path::{Path, flatten};
use crate::drawing::region::{Contours, FARTHEST, Regions, Rule};
use crate::error::{Error, Result};

/// Of the diagonal: how far the polygons of the outline lie from the curves at most.
const FLATNESS: f64 = 2e-5;

/// Of the drawing's diagonal: its distance from the origin, beyond which too few digits are left.
const REMOTE: f64 = 1e6;

/// Points of all outlines, those of a clip path each time it cuts.
const POINTS: usize = 4_000_000;

/// Diagonals of the drawing, how far out clip paths are followed.
const CLIP: f64 = 500.0;

/// A frame this near to the window's edges, as a fraction of it, is its background.
const FRAME: f64 = 0.01;

/// The outline of what is filled; what is not, if nothing is filled but strokes are closed.
///
/// # Errors
/// [`Error::Input`] where nothing has an inside, or coordinates are out of range.
pub(super) fn outline(scene: &mut Scene) -> Result<Outline> {
    mark_background(scene);
    let bounds = bounds(scene.pieces.iter())?;
    let filled = |p: &Piece| match p.role {
        Role::Filled(rule) => Some(rule),
        _ => None,
    };
    let outline = region(scene, bounds, &filled)?;
    if !outline.is_empty() {
        return Ok(outline);
    }
    let closed = |p: &Piece| {
        let closed = p
            .path
            .subpaths
            .iter()
            .any(|s| s.closed || s.end() == s.start);
        (p.role == Role::Stroked && closed).then_some(Rule::NonZero)
    };
    let outline = region(scene, bounds, &closed)?;
    if outline.is_empty() {
        return Err(Error::input(
            "the drawing fills no region",
            "close its lines, or give its shapes a fill",
        ));
    }
    let text = "nothing is filled; the insides of closed lines count as the shape";
    scene.warnings.push(text.to_owned());
    Ok(outline)
}

/// The box around all paths, clip paths left out.
fn bounds<'a>(pieces: impl Iterator<Item = &'a Piece>) -> Result<Rect> {
    let mut all: Option<Rect> = None;
    for piece in pieces {
        let bounds = box_of(&piece.path, piece.place);
        let far = bounds.map(|b| {
            [b.x0, b.y0, b.x1, b.y1]
                .iter()
                .fold(0.0, |m: f64, c| m.max(c.abs()))
        });
        if far.is_some_and(|far| far.is_nan() || far >= FARTHEST) {
            let what = format!("a path has coordinates of {FARTHEST:e} or more");
            return Err(Error::input(what, "scale the drawing down"));
        }
        if !matches!(piece.role, Role::Clip(_)) {
            all = match (all, bounds) {
                (Some(a), Some(b)) => Some(a.union(b)),
                (a, b) => a.or(b),
            };
        }
    }
    let Some(all) = all else {
        let what = "the drawing has no paths";
        return Err(Error::input(
            what,
            "only paths and basic shapes can be deformed",
        ));
    };
    let (size, far) = (
        all.width().hypot(all.height()),
        all.center().to_vec2().hypot(),
    );
    if size == 0.0 || far > REMOTE * size {
        let what = format!("all paths lie within {size:.1e} of each other");
        return Err(Error::input(what, "is this the right file?"));
    }
    Ok(all)
}

/// The box around ends and handles; `None` of nothing.
pub(super) fn box_of(path: &Path, place: Affine) -> Option<Rect> {
    let mut points = path.control_points().map(|p| place * p);
    let first = points.next()?;
    let around = Rect::from_points(first, first);
    // A comparison with something that is no number would lose it.
    points
        .try_fold(around, |r, p| p.is_finite().then(|| r.union_pt(p)))
        .or(Some(Rect::new(f64::NEG_INFINITY, 0.0, f64::INFINITY, 0.0)))
}

/// The grid, and how exactly polygons follow curves on it.
struct Ground {
    regions: Regions,
    tolerance: f64,
    room: Rect,
}

impl Ground {
    fn new(scene: &Scene, bounds: Rect) -> Self {
        let diagonal = bounds.width().hypot(bounds.height());
        // Clip paths may be far larger than what they cut; beyond this they are cut themselves.
        let most = bounds.inflate(CLIP * diagonal, CLIP * diagonal);
        let clips = scene
            .pieces
            .iter()
            .filter(|p| matches!(p.role, Role::Clip(_)));
        let boxes = clips.filter_map(|p| box_of(&p.path, p.place));
        let room = boxes.fold(bounds, |a, b| a.union(b)).intersect(most);
        Self {
            regions: Regions::new(room.origin(), room.origin() + room.size().to_vec2()),
            tolerance: FLATNESS * diagonal,
            room,
        }
    }

    fn fill(&mut self, number: usize, piece: &Piece, rule: Rule) -> Result<Contours> {
        let mut loops = flatten::loops(&piece.path.transformed(piece.place), self.tolerance);
        let room = self.room;
        for p in loops.iter_mut().flat_map(|l| &mut l.points) {
            *p = kurbo::Point::new(p.x.clamp(room.x0, room.x1), p.y.clamp(room.y0, room.y1));
        }
        self.regions.fill(number as u32, &loops, rule)
    }

    /// What a clip path lets through.
    fn cut(&mut self, scene: &Scene, clip: usize) -> Result<Contours> {
        let mut all = Contours::new();
        for number in scene.clips[clip].pieces.clone() {
            let piece = &scene.pieces[number];
            if let Role::Clip(rule) = piece.role {
                all.append(&mut self.fill(number, piece, rule)?);
            }
        }
        Ok(all)
    }
}

fn region(scene: &Scene, bounds: Rect, rule: &dyn Fn(&Piece) -> Option<Rule>) -> Result<Outline> {
    let mut ground = Ground::new(scene, bounds);
    let mut clips: Vec<Option<Contours>> = vec![None; scene.clips.len()];
    let mut all = Contours::new();
    let mut points = 0;
    for (number, piece) in scene.pieces.iter().enumerate() {
        let Some(rule) = rule(piece) else { continue };
        let mut filled = ground.fill(number, piece, rule)?;
        for &clip in piece.clips.iter().filter(|&&c| scene.clips[c].cuts) {
            if clips[clip].is_none() {
                clips[clip] = Some(ground.cut(scene, clip)?);
            }
            if let Some(cut) = &clips[clip] {
                points += cut.iter().map(Vec::len).sum::<usize>();
                filled = Regions::common(&filled, cut)?;
            }
        }
        points += filled.iter().map(Vec::len).sum::<usize>();
        if points > POINTS {
            let what = format!("the outlines and what cuts them have more than {POINTS} points");
            return Err(Error::input(what, "simplify the drawing"));
        }
        all.append(&mut filled);
    }
    ground.regions.united(&all)
}

/// Tells the frame behind everything from the shape: the first thing painted, a rectangle that
/// holds all the others and fills the window.
pub(super) fn mark_background(scene: &mut Scene) {
    let filled = |p: &&Piece| matches!(p.role, Role::Filled(_));
    let boxes: Vec<Rect> = scene
        .pieces
        .iter()
        .filter(filled)
        .filter_map(|p| box_of(&p.path, p.place))
        .collect();
    let Some((frame, others)) = boxes.split_first().filter(|(_, others)| !others.is_empty()) else {
        return;
    };
    let holds = others.iter().all(|b| frame.contains_rect(*b));
    let fills = scene.shown.is_none_or(|window| {
        let common = frame.intersect(window);
        common.area() >= (1.0 - FRAME) * window.area()
    });
    let first = scene
        .pieces
        .iter()
        .position(|p| matches!(p.role, Role::Filled(_)));
    let Some(first) = first.filter(|_| holds && fills) else {
        return;
    };
    let piece = &mut scene.pieces[first];
    if is_rectangle(&piece.path, piece.place, frame) {
        piece.role = Role::Background;
        let text = "a rectangle behind everything counts as background and stays";
        scene.warnings.push(text.to_owned());
    }
}

/// Whether a path fills its own box.
fn is_rectangle(path: &Path, place: Affine, around: &Rect) -> bool {
    let [subpath] = path.subpaths.as_slice() else {
        return false;
    };
    let mut outline = kurbo::BezPath::new();
    outline.move_to(place * subpath.start);
    for s in &subpath.segments {
        outline.push((place * *s).as_path_el());
    }
    outline.close_path();
    outline.area().abs() >= 0.999 * around.area() && outline.area().abs() > 0.0
}
