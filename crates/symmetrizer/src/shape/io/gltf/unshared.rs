//! Meshes that several nodes use: where these now differ, each gets a mesh of its own.

use std::collections::BTreeMap;

use serde_json::json;

use super::container::{Contents, File};
use super::json::{append, as_whole, list, object_mut};
use super::patch::{Patch, patches};
use super::read::Shape;
use super::replace::{Replacing, Uses};
use crate::error::Result;
use crate::shape::document::Document;

/// `file`, which was read as `shape`, with the changes of `document`.
pub(super) fn changed(document: &Document, file: &File, shape: &Shape) -> Result<Contents> {
    let mut of_mesh: BTreeMap<usize, Vec<(usize, Vec<Patch>)>> = BTreeMap::new();
    for block in &shape.blocks {
        let nodes = of_mesh.entry(block.mesh).or_default();
        if nodes.last().is_none_or(|(node, _)| *node != block.node) {
            nodes.push((block.node, Vec::new()));
        }
        let changes = patches(document, file, shape, block)?;
        if let Some((_, patches)) = nodes.last_mut() {
            patches.extend(changes);
        }
    }
    let uses = Uses::new(file, shape)?;
    let mut replacing = Replacing::new(file, &uses);
    let users = users(file);
    for (mesh, nodes) in of_mesh {
        let users = users.get(&mesh).copied().unwrap_or(0);
        change(&mut replacing, shape, mesh, nodes, users)?;
    }
    Ok(replacing.finish())
}

/// How many nodes use each mesh, shown or not.
fn users(file: &File) -> BTreeMap<usize, usize> {
    let mut users = BTreeMap::new();
    for node in list(&file.contents.json, "nodes") {
        if let Some(mesh) = node.get("mesh").and_then(as_whole) {
            *users.entry(mesh).or_default() += 1;
        }
    }
    users
}

/// Changes a mesh that `users` nodes use, of which `nodes` are shown.
fn change(
    replacing: &mut Replacing,
    shape: &Shape,
    mesh: usize,
    nodes: Vec<(usize, Vec<Patch>)>,
    users: usize,
) -> Result<()> {
    let parts = &shape.parts[&mesh];
    let alike = nodes.windows(2).all(|w| w[0].1 == w[1].1);
    if alike && nodes.len() == users {
        let patches = nodes.into_iter().next().map(|(_, p)| p);
        let mut patches = patches.into_iter().flatten();
        return patches.try_for_each(|p| replacing.apply(mesh, parts, &p, true));
    }
    // The mesh itself stays as it is, with what its nodes still use of it.
    for (node, patches) in nodes {
        if patches.is_empty() {
            continue;
        }
        let root = &mut replacing.writer.json;
        let copy = list(root, "meshes")[mesh].clone();
        let copy = append(root, "meshes", copy);
        if let Some(node) = object_mut(root, &[&"nodes", &node]) {
            node.insert("mesh".into(), json!(copy));
        }
        for patch in &patches {
            replacing.apply(copy, parts, patch, false)?;
        }
    }
    Ok(())
}
