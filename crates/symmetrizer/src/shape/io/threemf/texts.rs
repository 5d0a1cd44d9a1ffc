//! The changed texts of the model parts.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::parts::Part;
use super::placed::Build;
use super::sites::{ObjectSite, Resources, Sites};
use super::xml::quoted;
use crate::geom::Point;

const PRODUCTION: &str = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";

/// Ids end here, so that they fit in a signed number.
const LAST_ID: u32 = i32::MAX as u32;

/// What has become of an object at one of its places.
#[derive(PartialEq)]
pub(super) struct Variant {
    /// The vertices that have moved, each with its new place.
    pub moved: Vec<(usize, Point)>,
    /// Whether that place is in the document's coordinates and not in the object's.
    pub placed: bool,
}

/// The object that a block has now.
pub(super) struct Given {
    id: u32,
    /// Whether it is in the document's coordinates.
    placed: bool,
    /// Whether that is another object than before, or at another place.
    new: bool,
}

/// The texts of all parts with what is replaced in them.
pub(super) struct Texts<'a> {
    build: &'a Build,
    sites: Vec<Sites>,
    edits: Vec<Edits>,
}

/// Pieces of a text and what takes their place.
type Edits = Vec<(Range<usize>, String)>;

impl<'a> Texts<'a> {
    /// The texts of `build`, whose places are `sites`, with nothing replaced.
    pub fn new(build: &'a Build, sites: Vec<Sites>) -> Self {
        Self {
            build,
            edits: sites.iter().map(|_| Vec::new()).collect(),
            sites,
        }
    }

    /// Gives every block an object with its shape: the first shape of an object takes its place,
    /// each further one is a new object behind it.
    pub fn objects(&mut self, shapes: &[Variant]) -> Vec<Given> {
        let mut known: BTreeMap<(usize, u32), Vec<(&Variant, u32)>> = BTreeMap::new();
        let mut given = Vec::with_capacity(shapes.len());
        for (block, shape) in self.build.blocks.iter().zip(shapes) {
            let variants = known.entry((block.part, block.object)).or_default();
            let id = match variants.iter().find(|(variant, _)| *variant == shape) {
                Some((_, id)) => *id,
                None => {
                    let first = variants.is_empty();
                    let id = self.written((block.part, block.object), shape, first);
                    variants.push((shape, id));
                    id
                }
            };
            given.push(Given {
                id,
                placed: shape.placed,
                new: shape.placed || id != block.object,
            });
        }
        given
    }

    /// Writes a shape of an object; returns the id it has.
    fn written(&mut self, (part, object): (usize, u32), shape: &Variant, first: bool) -> u32 {
        let id = if first {
            object
        } else {
            free_id(&mut self.sites[part].ids)
        };
        let Some(site) = self.sites[part].objects.get(&object) else {
            return id;
        };
        let Part { text, model, .. } = &self.build.parts[part];
        let moved = moved(site, &model.objects[&object].positions, shape);
        if first {
            self.edits[part].extend(moved);
            return id;
        }
        let mut edits = moved;
        edits.push((site.id.clone(), id.to_string()));
        if let Some(place) = &site.uuid {
            edits.push((place.clone(), uuid(&text[place.clone()], id, 0)));
        }
        let end = site.whole.end;
        let copy = replaced(text, site.whole.clone(), edits);
        self.edits[part].push((end..end, copy));
        id
    }

    /// Leads the build items to the objects that their blocks have now.
    pub fn items(&mut self, given: &[Given]) {
        let mut of_item: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (b, block) in self.build.blocks.iter().enumerate() {
            if let Some(item) = block.item {
                of_item.entry(item).or_default().push(b);
            }
        }
        let mut compositions = String::new();
        for (item, blocks) in of_item {
            if !blocks.iter().any(|&b| given[b].new) {
                continue;
            }
            let single = matches!(blocks[..], [b] if self.build.blocks[b].direct);
            let id = if single && !given[blocks[0]].placed {
                given[blocks[0]].id
            } else {
                let site = &self.sites[0].items[item];
                let attributes = site.path.iter().chain(&site.transform);
                self.edits[0].extend(attributes.map(|a| (a.clone(), String::new())));
                self.composition(item, &blocks, given, &mut compositions)
            };
            let object = self.sites[0].items[item].object.clone();
            self.edits[0].push((object, id.to_string()));
        }
        self.add_objects(compositions);
    }

    /// A flat composition in place of what a build item names; returns its id.
    fn composition(
        &mut self,
        item: usize,
        blocks: &[usize],
        given: &[Given],
        objects: &mut String,
    ) -> u32 {
        let build = self.build;
        let from = &build.parts[0].model.items[item];
        let from = (from.part, from.object);
        let named = build.parts[from.0].model.objects.get(&from.1);
        let name = named.and_then(|o| o.name.as_ref());
        let mut components = String::new();
        for (k, &b) in blocks.iter().enumerate() {
            let id = free_id(&mut self.sites[0].ids);
            let block = &build.blocks[b];
            let component = self.component(from, (id, k), b, &given[b]);
            match &block.name {
                // It lies in a composition of its own that keeps the name.
                Some(inner) if Some(inner) != name => {
                    let carried = format!(" name=\"{}\"", quoted(inner));
                    *objects += &self.composed(from, id, &carried, &component);
                    let prefix = &self.sites[0].prefix;
                    let universal = self.universal(from, id, 1);
                    components += &format!("<{prefix}component objectid=\"{id}\"{universal}/>");
                }
                _ => components += &component,
            }
        }
        let id = free_id(&mut self.sites[0].ids);
        let site = self.sites[from.0].objects.get(&from.1);
        let carried = site.map_or("", |s| &s.carried);
        *objects += &self.composed(from, id, carried, &components);
        id
    }

    /// The component of a flat composition that shows block `b`.
    fn component(
        &self,
        from: (usize, u32),
        (id, k): (u32, usize),
        b: usize,
        given: &Given,
    ) -> String {
        let block = &self.build.blocks[b];
        let prefix = &self.sites[0].prefix;
        let mut text = format!("<{prefix}component objectid=\"{}\"", given.id);
        if block.part != 0 {
            let path = quoted(&self.build.parts[block.part].name);
            text += &format!(" p:path=\"/{path}\"");
        }
        if let Some(transform) = block.transform.as_ref().filter(|_| !given.placed) {
            text += &format!(" transform=\"{}\"", transform.text());
        }
        text + &self.universal(from, id, k + 2) + "/>"
    }

    /// An object of components.
    fn composed(&self, from: (usize, u32), id: u32, carried: &str, components: &str) -> String {
        let prefix = &self.sites[0].prefix;
        let universal = self.universal(from, id, 0);
        let extended = components.contains(" p:") || !universal.is_empty();
        let space = format!(" xmlns:p=\"{PRODUCTION}\"");
        let space = if extended { &space } else { "" };
        format!(
            "<{prefix}object id=\"{id}\"{carried}{space}{universal}>\
             <{prefix}components>{components}</{prefix}components></{prefix}object>"
        )
    }

    /// The UUID attribute of a new element, where the object that it stems from has one.
    fn universal(&self, (part, object): (usize, u32), id: u32, k: usize) -> String {
        let site = self.sites[part].objects.get(&object);
        let base = site.and_then(|s| s.uuid.clone());
        let base = base.map(|place| &self.build.parts[part].text[place]);
        base.map_or(String::new(), |b| format!(" p:UUID=\"{}\"", uuid(b, id, k)))
    }

    fn add_objects(&mut self, objects: String) {
        if objects.is_empty() {
            return;
        }
        let prefix = &self.sites[0].prefix;
        let edit = match self.sites[0].resources {
            Resources::Before(at) => (at..at, objects),
            // Its `/>` becomes the two tags.
            Resources::Empty(end) => (end - 2..end, format!(">{objects}</{prefix}resources>")),
            Resources::Missing(at) => {
                let whole = format!("<{prefix}resources>{objects}</{prefix}resources>");
                (at..at, whole)
            }
        };
        self.edits[0].push(edit);
    }

    /// The new texts of the entries that change.
    pub fn finish(self) -> BTreeMap<usize, String> {
        let parts = self.build.parts.iter().zip(self.edits);
        let changed = parts.filter(|(_, edits)| !edits.is_empty());
        let text = |(part, edits): (&Part, Edits)| {
            (part.entry, replaced(&part.text, 0..part.text.len(), edits))
        };
        changed.map(text).collect()
    }
}

/// The coordinates of an object that a shape changes.
fn moved(site: &ObjectSite, before: &[Point], shape: &Variant) -> Edits {
    let mut edits = Vec::new();
    for (v, after) in &shape.moved {
        let (Some(places), Some(before)) = (site.vertices.get(*v), before.get(*v)) else {
            continue;
        };
        for (place, (before, after)) in places.iter().zip(before.iter().zip(after.iter())) {
            if before.to_bits() != after.to_bits() {
                edits.push((place.clone(), after.to_string()));
            }
        }
    }
    edits
}

/// A piece of a text with smaller pieces replaced.
fn replaced(text: &str, piece: Range<usize>, mut edits: Edits) -> String {
    edits.sort_by_key(|(range, _)| (range.start, range.end));
    let mut out = String::with_capacity(piece.len());
    let mut at = piece.start;
    for (range, new) in edits {
        if let Some(kept) = text.get(at..range.start) {
            out += kept;
            out += &new;
            at = range.end;
        }
    }
    out + text.get(at..piece.end).unwrap_or_default()
}

/// An id that is not in use yet, above all others where there is room.
fn free_id(used: &mut BTreeSet<u32>) -> u32 {
    let above = used.last().map_or(1, |last| last.saturating_add(1));
    let id = if above <= LAST_ID {
        above
    } else {
        lowest_gap(used)
    };
    used.insert(id);
    id
}

fn lowest_gap(used: &BTreeSet<u32>) -> u32 {
    let taken = used.iter().skip_while(|&&id| id == 0).zip(1..);
    let before = taken.take_while(|(used, id)| *used == id).count();
    before as u32 + 1
}

/// A UUID made from that of another object, always the same for the same file.
fn uuid(base: &str, id: u32, k: usize) -> String {
    let whole = base.len() == 36 && base.is_ascii();
    let base = if whole {
        base
    } else {
        "00000000-0000-4000-8000-000000000000"
    };
    format!("{id:08x}-{:04x}{}", k & 0xffff, &base[13..])
}
