//! New values for an accessor: in its place where only one attribute uses its bytes, otherwise in
//! a new accessor.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::{Value, json};

use super::accessor::Accessor;
use super::attribute::Attribute;
use super::columns::set_bounds;
use super::container::{Contents, File};
use super::json::{as_whole, list, members, object_mut};
use super::parts::{Part, Parts};
use super::patch::Patch;
use super::read::Shape;
use super::span::{Span, view_range};
use super::writer::{Target, Writer, bytes_of};
use crate::error::Result;
use crate::shape::document::Kind;

/// In a view with more accessors than this, no two are compared.
const MOST_IN_A_VIEW: usize = 4096;

/// Who uses the data of a file.
pub(super) struct Uses {
    /// How many attributes use each accessor.
    of_accessor: Vec<usize>,
    /// Whether nothing but accessors uses the bytes of each view.
    plain_view: Vec<bool>,
    /// The accessors of each view.
    of_view: BTreeMap<usize, Vec<usize>>,
}

impl Uses {
    /// The uses in `file`, of which `shape` was read.
    pub fn new(file: &File, shape: &Shape) -> Result<Self> {
        let json = &file.contents.json;
        let accessors = list(json, "accessors");
        let mut uses = Self {
            of_accessor: vec![0; accessors.len()],
            plain_view: apart(file)?,
            of_view: BTreeMap::new(),
        };
        uses.count_attributes(json, shape);
        uses.count_others(json);
        for (i, accessor) in accessors.iter().enumerate() {
            if let Some(view) = accessor.get("bufferView").and_then(as_whole) {
                uses.of_view.entry(view).or_default().push(i);
            }
            for part in ["/sparse/indices", "/sparse/values"] {
                uses.other_view(accessor.pointer(part));
            }
        }
        list(json, "images")
            .iter()
            .for_each(|image| uses.other_view(Some(image)));
        Ok(uses)
    }

    fn accessor(&mut self, index: Option<&Value>) {
        let count = index
            .and_then(as_whole)
            .and_then(|i| self.of_accessor.get_mut(i));
        count.into_iter().for_each(|count| *count += 1);
    }

    fn other_view(&mut self, user: Option<&Value>) {
        let view = user.and_then(|u| u.get("bufferView")).and_then(as_whole);
        let plain = view.and_then(|v| self.plain_view.get_mut(v));
        plain.into_iter().for_each(|plain| *plain = false);
    }

    fn count_attributes(&mut self, json: &Value, shape: &Shape) {
        for (m, mesh) in list(json, "meshes").iter().enumerate() {
            if let Some(parts) = shape.parts.get(&m) {
                for (_, accessor) in parts.parts.iter().flat_map(|p| &p.attributes) {
                    self.accessor(Some(&json!(accessor)));
                }
                continue;
            }
            for primitive in list(mesh, "primitives") {
                members(primitive, "attributes").for_each(|(_, i)| self.accessor(Some(i)));
                let targets = list(primitive, "targets").iter();
                let targets = targets.filter_map(Value::as_object).flatten();
                targets.for_each(|(_, i)| self.accessor(Some(i)));
            }
        }
    }

    fn count_others(&mut self, json: &Value) {
        let primitives = list(json, "meshes")
            .iter()
            .flat_map(|m| list(m, "primitives"));
        primitives.for_each(|p| self.accessor(p.get("indices")));
        let skins = list(json, "skins").iter();
        skins.for_each(|s| self.accessor(s.get("inverseBindMatrices")));
        let samplers = list(json, "animations")
            .iter()
            .flat_map(|a| list(a, "samplers"));
        for sampler in samplers {
            self.accessor(sampler.get("input"));
            self.accessor(sampler.get("output"));
        }
    }

    /// Where the elements of an accessor can be changed without changing anything else.
    fn own_place(&self, file: &File, accessor: &Accessor) -> Option<Span> {
        let span = accessor.dense?;
        let own = accessor.kind == Kind::F32
            && accessor.sparse.is_none()
            && self.of_accessor[accessor.index] == 1
            && self.plain_view[span.view];
        let others = self
            .of_view
            .get(&span.view)
            .filter(|o| own && o.len() <= MOST_IN_A_VIEW)?;
        let mut others = others.iter().filter(|&&i| i != accessor.index);
        let meets = |&i: &usize| match Accessor::new(file, i, "a view") {
            Ok(other) => other
                .dense
                .is_none_or(|o| meet(span, accessor.count, o, other.count)),
            Err(_) => true,
        };
        (!others.any(meets)).then_some(span)
    }
}

/// For each view, whether its bytes are in no other view.
fn apart(file: &File) -> Result<Vec<bool>> {
    let count = list(&file.contents.json, "bufferViews").len();
    let mut ranges = Vec::new();
    for view in 0..count {
        // A damaged view is one that nothing shown uses.
        if let Ok((buffer, bytes, _)) = view_range(file, view, "the file") {
            ranges.push((buffer, bytes.start, bytes.end, view));
        }
    }
    ranges.sort_unstable();
    let mut apart = vec![true; count];
    let mut furthest: Option<(usize, usize, usize)> = None;
    for (buffer, start, end, view) in ranges {
        match furthest {
            Some((b, e, before)) if b == buffer && start < e => {
                apart[view] = false;
                apart[before] = false;
                if end > e {
                    furthest = Some((buffer, end, view));
                }
            }
            _ => furthest = Some((buffer, end, view)),
        }
    }
    Ok(apart)
}

/// Whether elements of two accessors of one view share bytes.
fn meet(a: Span, a_count: usize, b: Span, b_count: usize) -> bool {
    let end = |s: Span, count: usize| match count {
        0 => s.start,
        n => s.start + (n - 1) * s.stride + s.size,
    };
    if end(a, a_count) <= b.start || end(b, b_count) <= a.start {
        return false;
    }
    let interleaved = || {
        let shift = (b.start % a.stride + a.stride - a.start % a.stride) % a.stride;
        shift >= a.size && shift + b.size <= a.stride
    };
    a.stride != b.stride || !interleaved()
}

/// A file whose values are being replaced.
pub(super) struct Replacing<'a> {
    file: &'a File,
    uses: &'a Uses,
    pub writer: Writer,
}

impl<'a> Replacing<'a> {
    /// A copy of `file`.
    pub fn new(file: &'a File, uses: &'a Uses) -> Self {
        let writer = Writer {
            json: file.contents.json.clone(),
            buffers: file.contents.buffers.clone(),
        };
        Self { file, uses, writer }
    }

    /// Gives mesh `mesh` the values of a patch; only where `in_place` may it change accessors.
    pub fn apply(
        &mut self,
        mesh: usize,
        parts: &Parts,
        patch: &Patch,
        in_place: bool,
    ) -> Result<()> {
        let accessor = Accessor::new(self.file, patch.accessor, "a mesh")?;
        let width = accessor.width;
        let mut numbers: Vec<f32> = accessor
            .floats(self.file)?
            .iter()
            .map(|&n| n as f32)
            .collect();
        for (v, row) in &patch.rows {
            numbers[v * width..(v + 1) * width].copy_from_slice(&row[..width]);
        }
        let own = self
            .uses
            .own_place(self.file, &accessor)
            .filter(|_| in_place);
        if let Some(span) = own {
            self.overwrite(span, width, patch);
            self.update_bounds(&accessor, patch, &numbers);
        } else {
            let new = self.append(&accessor, patch, &numbers);
            self.repoint(mesh, &parts.parts[patch.part], &patch.attribute, new);
        }
        Ok(())
    }

    fn overwrite(&mut self, span: Span, width: usize, patch: &Patch) {
        let buffer = Arc::make_mut(&mut self.writer.buffers[span.buffer]);
        for (v, row) in &patch.rows {
            let start = span.start + v * span.stride;
            let bytes = bytes_of(&row[..width]);
            buffer[start..start + span.size].copy_from_slice(&bytes);
        }
    }

    fn update_bounds(&mut self, accessor: &Accessor, patch: &Patch, numbers: &[f32]) {
        let path: [&dyn ToString; 2] = [&"accessors", &accessor.index];
        let Some(members) = object_mut(&mut self.writer.json, &path) else {
            return;
        };
        let bounded = members.contains_key("min") || members.contains_key("max");
        if bounded || patch.attribute.is_position() {
            set_bounds(members, numbers, accessor.width);
        }
    }

    /// A new accessor, otherwise like the old one.
    fn append(&mut self, old: &Accessor, patch: &Patch, numbers: &[f32]) -> usize {
        let bytes = bytes_of(numbers);
        let view = self.writer.view(&bytes, Target::Vertices(None));
        let json = list(&self.file.contents.json, "accessors");
        let mut members = json[old.index].as_object().cloned().unwrap_or_default();
        for key in ["sparse", "byteOffset", "normalized"] {
            members.shift_remove(key);
        }
        members.insert("bufferView".into(), json!(view));
        members.insert("componentType".into(), json!(5126));
        let bounded = members.contains_key("min") || members.contains_key("max");
        if bounded
            || matches!(&patch.attribute, Attribute::Base(n) | Attribute::Target(_, n) if n == "POSITION")
        {
            set_bounds(&mut members, numbers, old.width);
        }
        self.writer.accessor(members)
    }

    fn repoint(&mut self, mesh: usize, part: &Part, attribute: &Attribute, to: usize) {
        for primitive in &part.primitives {
            let root = &mut self.writer.json;
            let (holder, name) = match attribute {
                Attribute::Base(name) => (
                    object_mut(
                        root,
                        &[&"meshes", &mesh, &"primitives", primitive, &"attributes"],
                    ),
                    name,
                ),
                Attribute::Target(k, name) => (
                    object_mut(
                        root,
                        &[&"meshes", &mesh, &"primitives", primitive, &"targets", k],
                    ),
                    name,
                ),
            };
            if let Some(holder) = holder.filter(|h| h.contains_key(name)) {
                holder.insert(name.clone(), json!(to));
            }
        }
    }

    /// The file with the new values.
    pub fn finish(self) -> Contents {
        self.writer.finish()
    }
}
