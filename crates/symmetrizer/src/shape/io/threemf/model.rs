//! A model part: objects with meshes and components, base materials, the build.

use std::collections::BTreeMap;

use super::tag::Tag;
use super::transform::Transform;
use super::xml::{Elements, Step, Text};
use crate::error::Result;
use crate::geom::Point;

/// What a model part says, as far as the document needs it.
#[derive(Default)]
pub(super) struct Model {
    /// The `unit` attribute.
    pub unit: Option<String>,
    /// Objects by id.
    pub objects: BTreeMap<u32, Object>,
    /// The ids of the objects as they follow each other.
    pub order: Vec<u32>,
    /// What is built; empty where the part does not say.
    pub items: Vec<Placed>,
    /// The names of base materials, by the id of their group.
    pub materials: BTreeMap<u32, Vec<String>>,
    /// How often other elements stand among resources and metadata, by name.
    pub besides: BTreeMap<String, usize>,
    /// How many materials have a colour.
    pub colors: usize,
}

/// An object: triangles, or other objects, in principle both.
#[derive(Default)]
pub(super) struct Object {
    /// The `name` attribute, if it says something.
    pub name: Option<String>,
    /// Its property group and the index in it, for triangles without their own.
    property: Property,
    /// Vertices in the object's own coordinates.
    pub positions: Vec<Point>,
    /// Triangles as they stand, whether the vertices are there or not.
    pub triangles: Vec<[u32; 3]>,
    /// A property for each triangle.
    properties: Vec<Property>,
    /// The objects it is composed of.
    pub components: Vec<Placed>,
}

/// An object at a place: a build item or a component.
pub(super) struct Placed {
    /// The path of the other model part that has the object.
    pub path: Option<String>,
    /// The number of the part that has the object, once that is known.
    pub part: usize,
    /// The object's id.
    pub object: u32,
    /// Where it goes; `None` for as it stands.
    pub transform: Option<Transform>,
}

/// A property group and the index in it.
#[derive(Clone, Copy, Default)]
struct Property {
    group: Option<u32>,
    index: Option<u32>,
}

/// The elements that the document or a change of it has to do with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Element {
    /// The root.
    Model,
    /// What holds objects and property groups.
    Resources,
    /// An object.
    Object,
    /// A vertex of an object's mesh.
    Vertex,
    /// A triangle of an object's mesh.
    Triangle,
    /// A component of an object.
    Component,
    /// A group of base materials.
    Materials,
    /// A base material.
    Material,
    /// What holds the build items.
    Build,
    /// A build item.
    Item,
    /// Metadata or a resource that the document does not hold.
    Besides,
    /// Anything else.
    Other,
}

impl Element {
    /// What the tag that was opened last is. The path decides: extensions use the same names in
    /// other places.
    pub fn of(elements: &Elements<'_>) -> Self {
        let mut names = [""; 6];
        if elements.depth() > names.len() {
            return Self::Other;
        }
        for (slot, name) in names.iter_mut().zip(elements.path()) {
            *slot = name;
        }
        match names {
            ["model", "", ..] => Self::Model,
            ["model", "metadata", "", ..] => Self::Besides,
            ["model", "resources", "", ..] => Self::Resources,
            ["model", "build", "", ..] => Self::Build,
            ["model", "build", "item", "", ..] => Self::Item,
            ["model", "resources", "object", "", ..] => Self::Object,
            ["model", "resources", "basematerials", "", ..] => Self::Materials,
            ["model", "resources", "basematerials", "base", "", ..] => Self::Material,
            ["model", "resources", _, "", ..] => Self::Besides,
            [
                "model",
                "resources",
                "object",
                "components",
                "component",
                "",
            ] => Self::Component,
            ["model", "resources", "object", "mesh", "vertices", "vertex"] => Self::Vertex,
            [
                "model",
                "resources",
                "object",
                "mesh",
                "triangles",
                "triangle",
            ] => Self::Triangle,
            _ => Self::Other,
        }
    }
}

impl Model {
    /// The model in the text of a part.
    pub fn read(text: Text<'_>) -> Result<Self> {
        let mut model = Self::default();
        let mut open = Open::default();
        let mut elements = Elements::new(text);
        while let Some(step) = elements.next_step()? {
            match step {
                Step::Open(tag) => model.tag(&mut open, &tag, Element::of(&elements))?,
                // An object is closed where only model and resources are open.
                Step::Close { .. } if elements.depth() == 2 => model.object_ends(&mut open),
                Step::Close { .. } => {}
            }
        }
        Ok(model)
    }

    fn tag(&mut self, open: &mut Open, tag: &Tag<'_>, element: Element) -> Result<()> {
        // A change of the shape reads these again, in whole.
        if matches!(element, Element::Object | Element::Item) {
            tag.check()?;
        }
        let object = &mut open.object;
        match element {
            Element::Model => self.unit = tag.value("unit")?,
            Element::Object => *open = self.object_starts(tag)?,
            Element::Vertex => {
                let [x, y, z] = [tag.number("x")?, tag.number("y")?, tag.number("z")?];
                object.positions.push(Point::new(x, y, z));
            }
            Element::Triangle => {
                let corners = [tag.index("v1")?, tag.index("v2")?, tag.index("v3")?];
                object.triangles.push(corners);
                object.properties.push(property(tag, "p1"));
            }
            Element::Component => object.components.push(placed(tag)?),
            Element::Item => self.items.push(placed(tag)?),
            Element::Materials => {
                open.group = tag.index("id")?;
                self.materials.entry(open.group).or_default();
            }
            Element::Material => {
                let name = tag.value("name")?.unwrap_or_default();
                self.colors += usize::from(tag.value("displaycolor")?.is_some());
                self.materials.entry(open.group).or_default().push(name);
            }
            Element::Besides => {
                *self.besides.entry(tag.local().to_owned()).or_default() += 1;
            }
            Element::Resources | Element::Build | Element::Other => {}
        }
        Ok(())
    }

    fn object_starts(&mut self, tag: &Tag<'_>) -> Result<Open> {
        let id = tag.index("id")?;
        if self.objects.contains_key(&id) {
            let what = format!("a second object has the id {id}");
            return Err(tag.error(what, "give each object an id of its own"));
        }
        let object = Object {
            name: tag.value("name")?.filter(|n| !n.trim().is_empty()),
            property: property(tag, "pindex"),
            ..Object::default()
        };
        Ok(Open {
            id: Some(id),
            object,
            group: 0,
        })
    }

    fn object_ends(&mut self, open: &mut Open) {
        if let Some(id) = open.id.take() {
            self.order.push(id);
            self.objects.insert(id, std::mem::take(&mut open.object));
        }
    }

    /// Everything that names an object.
    pub fn placed_mut(&mut self) -> impl Iterator<Item = &mut Placed> {
        let components = self.objects.values_mut().flat_map(|o| &mut o.components);
        components.chain(&mut self.items)
    }
}

impl Object {
    /// The property group of triangle `t` and the index in it, where it has them.
    pub fn property(&self, t: usize) -> Option<(u32, u32)> {
        let of = self.properties.get(t)?;
        let group = of.group.or(self.property.group)?;
        Some((group, of.index.or(self.property.index)?))
    }
}

/// What is being read.
#[derive(Default)]
struct Open {
    id: Option<u32>,
    object: Object,
    group: u32,
}

fn placed(tag: &Tag<'_>) -> Result<Placed> {
    Ok(Placed {
        path: tag.extended("path")?,
        part: 0,
        object: tag.index("objectid")?,
        transform: Transform::of(tag)?,
    })
}

/// A damaged property does no harm to the shape, so it is passed over.
fn property(tag: &Tag<'_>, index: &str) -> Property {
    Property {
        group: tag.optional_index("pid").unwrap_or(None),
        index: tag.optional_index(index).unwrap_or(None),
    }
}
