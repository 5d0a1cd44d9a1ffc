//! What a document draws: every path with its place, through groups, nested drawings and `use`.

use std::collections::BTreeMap;

use kurbo::{Affine, Point, Size};
use roxmltree::{Document, Node, NodeId};

use super::source::{is_svg, shown};
use super::style::{Own, Sheets, Style, link};
use super::units::{Axis, fitted, length, transform, view_box};
use super::{shapes, viewport};
use crate::drawing::path::{Path, parse};
use crate::drawing::region::Rule;
use crate::error::{Error, Result};

/// Elements drawn, counted once for each `use` through which they are.
const DRAWN: usize = 200_000;

/// Segments of all paths.
const SEGMENTS: usize = 1_000_000;

/// Elements and uses inside each other.
const DEEPEST: usize = 400;

/// An element as it is drawn: through the `use` elements of the chain, outermost first.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Spot {
    pub chain: Vec<u32>,
    pub node: u32,
}

/// What a path does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// Its inside is part of the picture.
    Filled(Rule),
    /// Only its line is.
    Stroked,
    /// It limits what others show.
    Clip(Rule),
    /// It is not seen, but moves with what is.
    Unseen,
    /// It lies behind everything and stays where it is.
    Background,
}

/// A path in its place.
pub(super) struct Piece {
    pub spot: Spot,
    /// In the coordinates of its element.
    pub path: Path,
    /// From these to the drawing's, y upwards.
    pub place: Affine,
    pub role: Role,
    /// Numbers of clip paths, all of which limit it.
    pub clips: Vec<usize>,
    /// Gradients and patterns, by number in [`Scene::paints`].
    pub paints: Vec<usize>,
}

/// An element that is moved as a whole: text, images.
pub(super) struct Whole {
    pub spot: Spot,
    /// From the coordinates around the element to the drawing's.
    pub around: Affine,
    /// The element's own.
    pub own: Affine,
    /// In the drawing.
    pub centre: Point,
    pub name: &'static str,
}

/// A clip path or mask as it was first referred to.
pub(super) struct Clip {
    /// The coordinates of what it was referred to from.
    pub place: Affine,
    /// Its paths.
    pub pieces: std::ops::Range<usize>,
    /// Whether it cuts; masks and clips in units of the bounding box are not followed.
    pub cuts: bool,
}

/// A gradient or pattern and the place of the first path that it paints.
pub(super) struct Paint {
    pub node: u32,
    pub place: Affine,
}

/// Everything a document draws.
pub(super) struct Scene {
    /// In the order of painting; those of clip paths before what they limit.
    pub pieces: Vec<Piece>,
    pub wholes: Vec<Whole>,
    pub clips: Vec<Clip>,
    pub paints: Vec<Paint>,
    /// By how much each `use` shifts what it shows, in its own coordinates.
    pub shifts: BTreeMap<u32, kurbo::Vec2>,
    pub warnings: Vec<String>,
    /// The part of the plane that the document shows, drawing coordinates, if it says so.
    pub shown: Option<kurbo::Rect>,
}

/// Where the walk is.
#[derive(Clone)]
struct Here<'a> {
    place: Affine,
    style: Style<'a>,
    view: Size,
    chain: Vec<u32>,
    clips: Vec<usize>,
    depth: usize,
    clipping: bool,
}

struct Walk<'a, 'input> {
    sheets: Sheets<'a>,
    by_id: BTreeMap<&'a str, Node<'a, 'input>>,
    scene: Scene,
    drawn: usize,
    segments: usize,
    /// Numbers of paints and clips by their node.
    paints: BTreeMap<u32, usize>,
    clips: BTreeMap<u32, usize>,
}

/// Reads what a document draws.
///
/// # Errors
/// [`Error::Input`] where it draws more than the limits allow.
pub(super) fn scene(tree: &Document<'_>) -> Result<Scene> {
    let by_id = by_id(tree);
    let root = tree.root_element();
    let window = viewport::root(root);
    let mut walk = Walk {
        sheets: Sheets::new(tree),
        by_id,
        scene: Scene {
            pieces: Vec::new(),
            wholes: Vec::new(),
            clips: Vec::new(),
            paints: Vec::new(),
            shifts: BTreeMap::new(),
            warnings: Vec::new(),
            shown: window.shown,
        },
        drawn: 0,
        segments: 0,
        paints: BTreeMap::new(),
        clips: BTreeMap::new(),
    };
    let here = Here {
        place: window.place,
        style: Style::initial(),
        view: window.view,
        chain: Vec::new(),
        clips: Vec::new(),
        depth: 0,
        clipping: false,
    };
    walk.container(root, &here, true)?;
    Ok(walk.scene)
}

impl<'a, 'input> Walk<'a, 'input> {
    /// The children of an element whose own properties count, but not its place if it is the root.
    fn container(&mut self, node: Node<'a, 'input>, here: &Here<'a>, root: bool) -> Result<()> {
        let own = self.sheets.of(node)?;
        let mut inside = self.inside(node, &own, here)?;
        if root {
            inside.place = here.place * own_transform(&own);
        }
        self.children(node, &inside)
    }

    fn children(&mut self, node: Node<'a, 'input>, here: &Here<'a>) -> Result<()> {
        for child in node.children().filter(|c| c.is_element() && is_svg(*c)) {
            self.element(child, here)?;
        }
        Ok(())
    }

    /// What holds inside an element.
    fn inside(
        &mut self,
        node: Node<'a, 'input>,
        own: &Own<'a>,
        here: &Here<'a>,
    ) -> Result<Here<'a>> {
        let mut inside = here.clone();
        inside.style = here.style.with(own);
        inside.place = here.place * own_transform(own);
        inside.depth += 1;
        if inside.depth > DEEPEST {
            let what = format!("{}: elements and uses are nested too deep", shown(node));
            return Err(Error::input(what, "ungroup the drawing"));
        }
        if !here.clipping {
            for name in ["clip-path", "mask"] {
                if let Some(clip) = self.clip(own.link(name), &inside)? {
                    inside.clips.push(clip);
                }
            }
        }
        Ok(inside)
    }

    fn element(&mut self, node: Node<'a, 'input>, here: &Here<'a>) -> Result<()> {
        self.drawn += 1;
        if self.drawn > DRAWN {
            let what = format!("more than {DRAWN} elements are drawn, counting every use");
            return Err(Error::input(what, "simplify the drawing"));
        }
        let name = node.tag_name().name();
        match name {
            "g" | "a" | "switch" | "use" | "svg" => {}
            "path" | "rect" | "circle" | "ellipse" | "line" | "polyline" | "polygon" => {}
            "text" | "image" | "foreignObject" => {}
            _ => return Ok(()),
        }
        let own = self.sheets.of(node)?;
        let inside = self.inside(node, &own, here)?;
        match name {
            "g" | "a" => self.children(node, &inside),
            "switch" => self.switch(node, &inside),
            "svg" => self.nested(node, &inside, node),
            "use" => self.used(node, &inside),
            "text" => self.whole(node, &inside, here, "text"),
            "image" => self.whole(node, &inside, here, "image"),
            "foreignObject" => self.whole(node, &inside, here, "foreign object"),
            _ => self.path(node, &inside),
        }
    }

    /// The first child that asks for nothing special.
    fn switch(&mut self, node: Node<'a, 'input>, here: &Here<'a>) -> Result<()> {
        let mut children = node.children().filter(|c| c.is_element() && is_svg(*c));
        let plain = |c: &Node<'_, '_>| !c.has_attribute("requiredExtensions");
        children
            .find(plain)
            .map_or(Ok(()), |c| self.element(c, here))
    }

    /// A drawing or symbol inside the drawing; `sized` says how large it is.
    fn nested(
        &mut self,
        node: Node<'a, 'input>,
        here: &Here<'a>,
        sized: Node<'a, 'input>,
    ) -> Result<()> {
        let placed = node.tag_name().name() == "svg";
        let size = |name, axis, all| {
            let given = length(sized, name, axis, here.view);
            let own = length(node, name, axis, here.view).filter(|_| placed);
            given.or(own).unwrap_or(all)
        };
        let at = |name, axis| {
            length(node, name, axis, here.view)
                .filter(|_| placed)
                .unwrap_or(0.0)
        };
        let size = Size::new(
            size("width", Axis::X, here.view.width),
            size("height", Axis::Y, here.view.height),
        );
        let mut inside = here.clone();
        inside.place *= Affine::translate((at("x", Axis::X), at("y", Axis::Y)));
        inside.view = size;
        if let Some(content) = view_box(node) {
            inside.place *= fitted(node, content, size);
            inside.view = content.size();
        }
        self.children(node, &inside)
    }

    fn used(&mut self, node: Node<'a, 'input>, here: &Here<'a>) -> Result<()> {
        let Some(target) = referenced(node).and_then(|id| self.by_id.get(id)).copied() else {
            return Ok(());
        };
        // A use of one of its own ancestors, or of itself, draws nothing.
        if target == node || here.chain.contains(&node.id().get()) {
            return Ok(());
        }
        let x = length(node, "x", Axis::X, here.view).unwrap_or(0.0);
        let y = length(node, "y", Axis::Y, here.view).unwrap_or(0.0);
        let mut inside = here.clone();
        inside.chain.push(node.id().get());
        inside.place *= Affine::translate((x, y));
        let shift = kurbo::Vec2::new(x, y);
        self.scene.shifts.insert(node.id().get(), shift);
        match target.tag_name().name() {
            "symbol" | "svg" => {
                let own = self.sheets.of(target)?;
                let inside = self.inside(target, &own, &inside)?;
                self.nested(target, &inside, node)
            }
            _ => self.element(target, &inside),
        }
    }

    fn whole(
        &mut self,
        node: Node<'a, 'input>,
        inside: &Here<'a>,
        here: &Here<'a>,
        name: &'static str,
    ) -> Result<()> {
        let x = |name| length(node, name, Axis::X, here.view).unwrap_or(0.0);
        let y = |name| length(node, name, Axis::Y, here.view).unwrap_or(0.0);
        // A text may give a position for each letter.
        let first = |name| {
            let list = node.attribute(name).unwrap_or("");
            svgtypes::LengthListParser::from(list)
                .find_map(|l| l.ok())
                .map_or(0.0, |l| l.number)
        };
        let centre = match name {
            "text" => Point::new(first("x"), first("y")),
            _ => Point::new(x("x") + x("width") / 2.0, y("y") + y("height") / 2.0),
        };
        self.scene.wholes.push(Whole {
            spot: spot(node, here),
            around: here.place,
            own: here.place.inverse() * inside.place,
            centre: inside.place * centre,
            name,
        });
        Ok(())
    }

    fn path(&mut self, node: Node<'a, 'input>, here: &Here<'a>) -> Result<()> {
        let Some(path) = self.geometry(node, here.view) else {
            return Ok(());
        };
        self.segments += path.segments().count();
        if self.segments > SEGMENTS {
            let what = format!("the drawing has more than {SEGMENTS} curves and lines");
            return Err(Error::input(what, "simplify it first"));
        }
        let style = &here.style;
        let role = match () {
            () if here.clipping => Role::Clip(style.clip_rule),
            () if style.is_filled() => Role::Filled(style.fill_rule),
            () if style.is_stroked() => Role::Stroked,
            () => Role::Unseen,
        };
        let paints = [style.fill, style.stroke]
            .iter()
            .filter_map(|value| self.paint(value, here))
            .collect();
        self.scene.pieces.push(Piece {
            spot: spot(node, here),
            path,
            place: here.place,
            role,
            clips: here.clips.clone(),
            paints,
        });
        Ok(())
    }

    fn geometry(&mut self, node: Node<'a, 'input>, view: Size) -> Option<Path> {
        if node.tag_name().name() != "path" {
            return shapes::path(node, view);
        }
        let parsed = parse::path(node.attribute("d")?);
        if let Some(damage) = parsed.damage {
            let text = format!("{}: {damage}; it counts up to there", shown(node));
            self.scene.warnings.push(text);
        }
        (!parsed.path.subpaths.is_empty()).then_some(parsed.path)
    }

    /// The number of the gradient or pattern in a paint.
    fn paint(&mut self, value: &str, here: &Here<'a>) -> Option<usize> {
        let node = self.by_id.get(link(value)?)?.id().get();
        let paints = &mut self.scene.paints;
        Some(*self.paints.entry(node).or_insert_with(|| {
            paints.push(Paint {
                node,
                place: here.place,
            });
            paints.len() - 1
        }))
    }

    /// The number of a clip path or mask, whose paths are read where it is referred to first.
    fn clip(&mut self, id: Option<&'a str>, here: &Here<'a>) -> Result<Option<usize>> {
        let Some(node) = id.and_then(|id| self.by_id.get(id)).copied() else {
            return Ok(None);
        };
        let number = node.id().get();
        if let Some(&known) = self.clips.get(&number) {
            let clip = &mut self.scene.clips[known];
            if clip.place != here.place && clip.cuts {
                clip.cuts = false;
                self.scene.warnings.push(format!(
                    "{} is used in several places; it is not cut away, and moves as in the first",
                    shown(node)
                ));
            }
            return Ok(Some(known));
        }
        let is_clip = node.tag_name().name() == "clipPath";
        let unit = if is_clip {
            "clipPathUnits"
        } else {
            "maskContentUnits"
        };
        if node.attribute(unit) == Some("objectBoundingBox") {
            let text = format!(
                "{} is in units of a bounding box; it stays as it is",
                shown(node)
            );
            self.scene.warnings.push(text);
            return Ok(None);
        }
        if !is_clip {
            let text = format!("what {} hides counts as seen", shown(node));
            self.scene.warnings.push(text);
        }
        let own = self.sheets.of(node)?;
        let mut inside = here.clone();
        inside.clips.clear();
        inside.chain.clear();
        inside.clipping = true;
        inside.style = Style::initial().with(&own);
        inside.place = here.place * own_transform(&own);
        inside.depth += 1;
        let first = self.scene.pieces.len();
        self.children(node, &inside)?;
        self.clips.insert(number, self.scene.clips.len());
        self.scene.clips.push(Clip {
            place: here.place,
            pieces: first..self.scene.pieces.len(),
            cuts: is_clip,
        });
        Ok(Some(self.scene.clips.len() - 1))
    }
}

fn own_transform(own: &Own<'_>) -> Affine {
    let given = own.get("transform").filter(|v| *v != "none");
    given.and_then(transform).unwrap_or(Affine::IDENTITY)
}

fn spot(node: Node<'_, '_>, here: &Here<'_>) -> Spot {
    Spot {
        chain: here.chain.clone(),
        node: node.id().get(),
    }
}

/// The id that a `use`, gradient or pattern refers to, within the file.
pub(super) fn referenced<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    let by_name = |a: &roxmltree::Attribute<'_, '_>| a.name() == "href";
    let value = node.attributes().find(by_name)?.value();
    value.trim().strip_prefix('#')
}

/// The first element with each id.
pub(super) fn by_id<'a, 'input>(tree: &'a Document<'input>) -> BTreeMap<&'a str, Node<'a, 'input>> {
    let mut by_id = BTreeMap::new();
    for node in tree.descendants().filter(Node::is_element) {
        if let Some(id) = node.attribute("id") {
            by_id.entry(id).or_insert(node);
        }
    }
    by_id
}

/// A node by its number in a [`Spot`].
pub(super) fn node<'a, 'input>(
    tree: &'a Document<'input>,
    number: u32,
) -> Option<Node<'a, 'input>> {
    tree.get_node(NodeId::new(number))
}
