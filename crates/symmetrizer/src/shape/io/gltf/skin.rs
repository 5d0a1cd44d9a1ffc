//! Skins: the joints that vertices follow at the file's rest pose.

use std::collections::BTreeMap;
use std::rc::Rc;

use nalgebra::Matrix4;

use super::accessor::Accessor;
use super::attribute::Attribute;
use super::container::File;
use super::json::{DAMAGED, as_whole, element, list, whole};
use super::layers::of_vertices;
use super::parts::Part;
use super::place::{Place, Skinned};
use super::scene::affine;
use crate::error::{Error, Result};
use crate::shape::document::{Numbers, Role};

/// For each skin read so far and each of its joints: world from mesh coordinates.
#[derive(Default)]
pub(super) struct Skins(BTreeMap<usize, Rc<Vec<Matrix4<f64>>>>);

impl Skins {
    /// Where the `count` vertices of a part are at a node; `None` where the node has no skin or the
    /// vertices no joints. `worlds` are the places of all nodes.
    pub fn place(
        &mut self,
        file: &File,
        worlds: &[Matrix4<f64>],
        node: usize,
        part: &Part,
        count: usize,
    ) -> Result<Option<Place>> {
        let object = &list(&file.contents.json, "nodes")[node];
        let Some(skin) = whole(object, "skin", &format!("node {node}"))? else {
            return Ok(None);
        };
        let joints = self.joints(file, worlds, skin, node)?;
        let place = format!("the mesh of node {node}");
        let mut sets = Vec::new();
        for n in 0.. {
            let of = |set: &str| part.accessor(&Attribute::Base(format!("{set}_{n}")));
            let (Some(names), Some(weights)) = (of("JOINTS"), of("WEIGHTS")) else {
                break;
            };
            let names = of_vertices(file, names, count, Role::Joints(n), &place)?;
            let weights = of_vertices(file, weights, count, Role::Weights(n), &place)?;
            let names = checked(names.numbers(file)?, joints.len(), skin, &place)?;
            sets.push((names, weights.floats(file)?));
        }
        let follows = !sets.is_empty();
        Ok(follows.then_some(Place::Skinned(Skinned { joints, sets })))
    }

    fn joints(
        &mut self,
        file: &File,
        worlds: &[Matrix4<f64>],
        skin: usize,
        node: usize,
    ) -> Result<Rc<Vec<Matrix4<f64>>>> {
        if let Some(joints) = self.0.get(&skin) {
            return Ok(Rc::clone(joints));
        }
        let object = element(&file.contents.json, "skins", skin, &format!("node {node}"))?;
        let place = format!("skin {skin}");
        let nodes = list(object, "joints");
        file.charge(16 * nodes.len())?;
        let inverse = match whole(object, "inverseBindMatrices", &place)? {
            Some(accessor) => bind_matrices(file, accessor, nodes.len(), &place)?,
            None => vec![Matrix4::identity(); nodes.len()],
        };
        let mut joints = Vec::new();
        for (joint, inverse) in nodes.iter().zip(inverse) {
            let world = as_whole(joint).and_then(|j| worlds.get(j));
            let world = world.ok_or_else(|| {
                let what = format!("joint {} of {place} names no node", joints.len());
                Error::input(what, DAMAGED)
            })?;
            joints.push(world * inverse);
        }
        let joints = Rc::new(joints);
        self.0.insert(skin, Rc::clone(&joints));
        Ok(joints)
    }
}

fn bind_matrices(
    file: &File,
    accessor: usize,
    count: usize,
    place: &str,
) -> Result<Vec<Matrix4<f64>>> {
    let accessor = Accessor::new(file, accessor, place)?;
    if accessor.width != 16 || accessor.count < count {
        let what = format!("{place} has {count} joints, but not as many bind matrices");
        return Err(Error::input(what, DAMAGED));
    }
    let numbers = accessor.floats(file)?;
    let matrices = numbers.as_chunks::<16>().0.iter();
    Ok(matrices.take(count).map(affine).collect())
}

/// Joints, all of which the skin has.
fn checked(joints: Numbers, count: usize, skin: usize, place: &str) -> Result<Vec<f64>> {
    match joints.iter().position(|j| !(j >= 0.0 && j < count as f64)) {
        None => Ok(joints.iter().collect()),
        Some(i) => Err(Error::input(
            format!(
                "vertex {} of {place} follows joint {}, but skin {skin} has only {count}",
                i / 4,
                joints.get(i)
            ),
            DAMAGED,
        )),
    }
}
