//! Where the things stand in a model's text that a change of the shape replaces.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::model::Element;
use super::tag::{Place, Tag};
use super::xml::{Elements, Step, Text, local};
use crate::error::Result;

/// The places in a text.
pub(super) struct Sites {
    /// The objects by id.
    pub objects: BTreeMap<u32, ObjectSite>,
    /// The build items.
    pub items: Vec<ItemSite>,
    /// Where the resources end.
    pub resources: Resources,
    /// The prefix of the format's own elements, with its colon.
    pub prefix: String,
    /// All numbers that resources have as their ids.
    pub ids: BTreeSet<u32>,
}

/// The places of an object.
#[derive(Default)]
pub(super) struct ObjectSite {
    /// From its start tag through its end tag.
    pub whole: Range<usize>,
    /// The value of its id.
    pub id: Range<usize>,
    /// The value of its UUID in the production extension, if it has one.
    pub uuid: Option<Range<usize>>,
    /// The values of `x`, `y` and `z` of each vertex, where they were asked for.
    pub vertices: Vec<[Range<usize>; 3]>,
    /// What a composition that takes its place should say as well.
    pub carried: String,
}

/// The places of a build item.
pub(super) struct ItemSite {
    /// The object's id.
    pub object: Range<usize>,
    /// The whole attribute with the path, if there is one.
    pub path: Option<Range<usize>>,
    /// The whole attribute with the transform, if there is one.
    pub transform: Option<Range<usize>>,
}

/// Where further objects can go.
pub(super) enum Resources {
    /// There are no resources; they belong before this byte.
    Missing(usize),
    /// Within `<resources/>`, which ends here.
    Empty(usize),
    /// Before this byte.
    Before(usize),
}

impl Sites {
    /// The places in `text`; vertices of the objects in `with_vertices` only.
    pub fn find(text: Text<'_>, with_vertices: &BTreeSet<u32>) -> Result<Self> {
        let mut sites = Self {
            objects: BTreeMap::new(),
            items: Vec::new(),
            resources: Resources::Missing(0),
            prefix: String::new(),
            ids: BTreeSet::new(),
        };
        let mut object = None;
        let mut elements = Elements::new(text);
        while let Some(step) = elements.next_step()? {
            match step {
                Step::Open(tag) => {
                    let element = Element::of(&elements);
                    sites.tag(&tag, element, &mut object, with_vertices)?;
                }
                Step::Close {
                    name: "resources",
                    tag,
                    end,
                    ..
                } if elements.depth() == 1 => {
                    let empty = tag == end;
                    let ends = if empty {
                        Resources::Empty(end)
                    } else {
                        Resources::Before(tag)
                    };
                    sites.resources = ends;
                }
                Step::Close { start, end, .. } if elements.depth() == 2 => {
                    let site = object.take().and_then(|id| sites.objects.get_mut(&id));
                    site.into_iter().for_each(|site| site.whole = start..end);
                }
                Step::Close { .. } => {}
            }
        }
        Ok(sites)
    }

    fn tag(
        &mut self,
        tag: &Tag<'_>,
        element: Element,
        object: &mut Option<u32>,
        with_vertices: &BTreeSet<u32>,
    ) -> Result<()> {
        match element {
            Element::Object | Element::Materials | Element::Besides => {
                self.ids.extend(tag.optional_index("id").unwrap_or(None));
                if element == Element::Object {
                    let id = tag.index("id")?;
                    *object = Some(id);
                    self.objects.insert(id, object_site(tag)?);
                }
            }
            Element::Vertex => {
                let id = object.filter(|id| with_vertices.contains(id));
                if let Some(site) = id.and_then(|id| self.objects.get_mut(&id)) {
                    let [x, y, z] = ["x", "y", "z"].map(|name| value(tag, name));
                    site.vertices.push([x?, y?, z?]);
                }
            }
            Element::Item => self.items.push(item_site(tag)?),
            Element::Model => tag.prefix().clone_into(&mut self.prefix),
            Element::Build => {
                if let Resources::Missing(at) = &mut self.resources {
                    *at = tag.start;
                }
            }
            _ => {}
        }
        Ok(())
    }
}

fn object_site(tag: &Tag<'_>) -> Result<ObjectSite> {
    let kept = |key: &str| matches!(key, "name" | "type" | "partnumber");
    Ok(ObjectSite {
        id: value(tag, "id")?,
        uuid: extended(tag, "UUID")?.map(|p| p.value),
        carried: tag.copied(kept)?,
        ..ObjectSite::default()
    })
}

fn item_site(tag: &Tag<'_>) -> Result<ItemSite> {
    Ok(ItemSite {
        object: value(tag, "objectid")?,
        path: extended(tag, "path")?.map(|p| p.whole),
        transform: tag.place(|key| key == "transform")?.map(|p| p.whole),
    })
}

fn value(tag: &Tag<'_>, name: &str) -> Result<Range<usize>> {
    tag.must_place(name).map(|p| p.value)
}

fn extended(tag: &Tag<'_>, name: &str) -> Result<Option<Place>> {
    tag.place(|key| key.contains(':') && local(key) == name)
}
