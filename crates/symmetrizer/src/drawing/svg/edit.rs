//! The text of a document with some of its elements changed. Every other byte stays.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::ops::Range;

use kurbo::Vec2;
use roxmltree::{Document, Node};

use super::scene::{Scene, Spot, by_id, referenced};
use super::{shapes, units};
use crate::drawing::path::write;
use crate::error::{Error, Result};

/// What changes in which elements.
pub(super) type Edits = BTreeMap<Spot, Vec<Edit>>;

/// What changes in an element.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Edit {
    /// Its path data; basic shapes become paths.
    Data(String),
    /// An attribute, changed or added.
    Attribute(&'static str, String),
}

/// Attributes by which drawing programs would make their own path again.
const REMADE: [&str; 5] = [
    "sodipodi:type",
    "sodipodi:nodetypes",
    "inkscape:original-d",
    "inkscape:path-effect",
    "inkscape:connector-curvature",
];

/// Bytes of all copies that uses become.
const COPIED: usize = 256 << 20;

/// Of a shift, which is written as exactly as numbers come.
const DECIMALS: u32 = 9;

/// The whole text, edited.
///
/// # Errors
/// [`Error::Unsupported`] where it would become far too large.
pub(super) fn edited(
    text: &str,
    tree: &Document<'_>,
    edits: &Edits,
    scene: &Scene,
) -> Result<String> {
    if edits.is_empty() {
        return Ok(text.to_owned());
    }
    let editor = Editor {
        text,
        edits,
        shifts: &scene.shifts,
        by_id: by_id(tree),
        copied: Cell::new(0),
    };
    let mut splices = Vec::new();
    editor.gather(tree.root(), &[], false, &mut splices);
    if editor.copied.get() > COPIED {
        let what = "its uses, each with a copy of its own, would make too large a file";
        return Err(Error::Unsupported(what.into()));
    }
    Ok(spliced(text, 0..text.len(), splices))
}

/// A piece of text in place of another.
type Splice = (Range<usize>, String);

struct Editor<'a, 'input> {
    text: &'a str,
    edits: &'a Edits,
    shifts: &'a BTreeMap<u32, Vec2>,
    by_id: BTreeMap<&'a str, Node<'a, 'input>>,
    /// Bytes of copies so far.
    copied: Cell<usize>,
}

impl Editor<'_, '_> {
    /// The changes inside an element as it is drawn through `chain`. Copies lose their ids, which
    /// may be given once only.
    fn gather(&self, top: Node<'_, '_>, chain: &[u32], copy: bool, splices: &mut Vec<Splice>) {
        let mut open = vec![top];
        while let Some(element) = open.pop() {
            if element.is_element() {
                let spot = Spot {
                    chain: chain.to_vec(),
                    node: element.id().get(),
                };
                if self.is_unfolded(&spot) {
                    splices.push((element.range(), self.unfolded(element, chain, copy)));
                    continue;
                }
                if copy {
                    splices.extend(attribute(element, "id").map(|r| (r, String::new())));
                }
                for edit in self.edits.get(&spot).into_iter().flatten() {
                    self.change(element, edit, splices);
                }
            }
            open.extend(element.children().filter(Node::is_element));
        }
    }

    /// Whether something that is drawn through this `use` changes.
    fn is_unfolded(&self, spot: &Spot) -> bool {
        let mut chain = spot.chain.clone();
        chain.push(spot.node);
        let first = Spot {
            chain: chain.clone(),
            node: 0,
        };
        let next = self.edits.range(first..).next();
        next.is_some_and(|(s, _)| s.chain.starts_with(&chain))
    }

    /// A `use` as a group with a copy of its own.
    fn unfolded(&self, element: Node<'_, '_>, chain: &[u32], copy: bool) -> String {
        let target = referenced(element)
            .and_then(|id| self.by_id.get(id))
            .copied();
        let Some(target) = target else {
            return self.text[element.range()].to_owned();
        };
        let mut chain = chain.to_vec();
        chain.push(element.id().get());
        let name = qualified(self.text, element);
        let prefix = name.strip_suffix("use").unwrap_or("");
        let (mut attributes, mut transform) = (String::new(), String::new());
        for a in element.attributes() {
            match a.name() {
                "href" | "x" | "y" | "width" | "height" => {}
                "transform" if units::transform(a.value()).is_some() => {
                    transform = a.value().to_owned() + " ";
                }
                "transform" => {}
                "id" if copy => {}
                _ => attributes += &format!(" {}", &self.text[a.range()]),
            }
        }
        let shift = self.shifts.get(&element.id().get()).copied();
        let number = |v: f64| write::number(v, DECIMALS);
        let Vec2 { x, y } = shift.unwrap_or_default();
        transform += &format!("translate({} {})", number(x), number(y));
        let inner = self.copied(target, element, &chain, prefix);
        format!("<{prefix}g{attributes} transform=\"{transform}\">{inner}</{prefix}g>")
    }

    /// A copy of what a `use` shows, with its changes.
    fn copied(
        &self,
        target: Node<'_, '_>,
        used: Node<'_, '_>,
        chain: &[u32],
        prefix: &str,
    ) -> String {
        let range = target.range();
        self.copied.set(self.copied.get() + range.len());
        if self.copied.get() > COPIED {
            return String::new();
        }
        let mut splices = Vec::new();
        self.gather(target, chain, true, &mut splices);
        let tag = target.tag_name().name();
        if matches!(tag, "symbol" | "svg") {
            for name in ["width", "height"] {
                let given = used
                    .attribute(name)
                    .filter(|v| !v.contains(['"', '&', '<']));
                if let Some(value) = given {
                    splices.extend(attribute(target, name).map(|r| (r, String::new())));
                    let after = range.start + 1 + qualified(self.text, target).len();
                    splices.push((after..after, format!(" {name}=\"{value}\"")));
                }
            }
        }
        if tag == "symbol" {
            rename(self.text, target, &format!("{prefix}svg"), &mut splices);
        }
        spliced(self.text, range, splices)
    }

    fn change(&self, element: Node<'_, '_>, edit: &Edit, splices: &mut Vec<Splice>) {
        match edit {
            Edit::Attribute(name, value) => self.set(element, name, value, splices),
            Edit::Data(data) => {
                let tag = element.tag_name().name();
                if tag != "path" {
                    let name = qualified(self.text, element);
                    let prefix = name.strip_suffix(tag).unwrap_or("");
                    rename(self.text, element, &format!("{prefix}path"), splices);
                    for name in shapes::geometry(tag) {
                        splices.extend(attribute(element, name).map(|r| (r, String::new())));
                    }
                }
                for a in element.attributes() {
                    if REMADE.iter().any(|n| self.text[a.range()].starts_with(n)) {
                        splices.push((with_space(self.text, a.range()), String::new()));
                    }
                }
                self.set(element, "d", data, splices);
            }
        }
    }

    fn set(&self, element: Node<'_, '_>, name: &str, value: &str, splices: &mut Vec<Splice>) {
        let plain = |a: &roxmltree::Attribute<'_, '_>| a.name() == name && a.namespace().is_none();
        if let Some(old) = element.attributes().find(plain) {
            splices.push((old.range_value(), value.to_owned()));
            return;
        }
        let after = element.range().start + 1 + qualified(self.text, element).len();
        splices.push((after..after, format!(" {name}=\"{value}\"")));
    }
}

/// The range of an attribute without namespace, the space before it included.
fn attribute(element: Node<'_, '_>, name: &str) -> Option<Range<usize>> {
    let plain = |a: &roxmltree::Attribute<'_, '_>| a.name() == name && a.namespace().is_none();
    let found = element.attributes().find(plain)?;
    Some(with_space(element.document().input_text(), found.range()))
}

fn with_space(text: &str, range: Range<usize>) -> Range<usize> {
    text[..range.start].trim_end().len()..range.end
}

/// The name of an element with its prefix.
fn qualified<'a>(text: &'a str, element: Node<'_, '_>) -> &'a str {
    let inside = &text[element.range().start + 1..element.range().end];
    let end = inside.find(|c: char| c.is_whitespace() || matches!(c, '/' | '>'));
    &inside[..end.unwrap_or(inside.len())]
}

fn rename(text: &str, element: Node<'_, '_>, name: &str, splices: &mut Vec<Splice>) {
    let range = element.range();
    let old = qualified(text, element).len();
    splices.push((range.start + 1..range.start + 1 + old, name.to_owned()));
    let all = &text[range.clone()];
    if !all.ends_with("/>")
        && let Some(end) = all.rfind("</")
    {
        let start = range.start + end + 2;
        splices.push((start..start + old, name.to_owned()));
    }
}

/// A part of the text with its splices. Of two that overlap the first counts.
fn spliced(text: &str, range: Range<usize>, mut splices: Vec<Splice>) -> String {
    splices.sort_by_key(|(r, _)| (r.start, r.end));
    let mut out = String::with_capacity(range.len());
    let mut at = range.start;
    for (part, new) in splices {
        if part.start < at || part.end > range.end {
            continue;
        }
        out.push_str(&text[at..part.start]);
        out.push_str(&new);
        at = part.end;
    }
    out.push_str(&text[at..range.end]);
    out
}
