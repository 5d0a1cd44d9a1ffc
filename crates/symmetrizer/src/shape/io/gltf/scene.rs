//! The nodes: their places in the world, and the ones that the default scene shows.

use nalgebra::{Matrix3, Matrix4, Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

use super::json::{DAMAGED, as_whole, element, list, numbers, whole};
use crate::error::{Error, Result};

/// The nodes of a file.
pub(super) struct Scene {
    /// The place of each node: world from its own coordinates.
    pub worlds: Vec<Matrix4<f64>>,
    /// The nodes of the default scene, parents before their children.
    pub shown: Vec<usize>,
}

impl Scene {
    /// The nodes in `json`.
    pub fn new(json: &Value) -> Result<Self> {
        let children = children(json)?;
        let roots = roots(&children)?;
        let mut worlds = vec![Matrix4::identity(); children.len()];
        let mut reached = 0;
        let mut stack = roots.clone();
        let mut parents = vec![None; children.len()];
        while let Some(node) = stack.pop() {
            reached += 1;
            let own = local(&list(json, "nodes")[node], node)?;
            let parent: Option<usize> = parents[node];
            worlds[node] = parent.map_or(own, |p| worlds[p] * own);
            children[node].iter().for_each(|&c| parents[c] = Some(node));
            stack.extend(&children[node]);
        }
        if reached < children.len() {
            let what = "some nodes are below themselves in the scene";
            return Err(Error::input(what, DAMAGED));
        }
        let shown = shown(json, &children, &roots)?;
        Ok(Self { worlds, shown })
    }
}

/// The nodes below each node.
fn children(json: &Value) -> Result<Vec<Vec<usize>>> {
    let nodes = list(json, "nodes");
    let named = |(i, node)| indices(node, "children", nodes.len(), &format!("node {i}"));
    nodes.iter().enumerate().map(named).collect()
}

/// The array `key` of indices below `count`.
fn indices(object: &Value, key: &str, count: usize, place: &str) -> Result<Vec<usize>> {
    let index = |value: &Value| {
        let index = as_whole(value).filter(|&i| i < count);
        index.ok_or_else(|| {
            let shown: String = value.to_string().chars().take(40).collect();
            let what = format!("'{key}' of {place} names node {shown}, but there are only {count}");
            Error::input(what, DAMAGED)
        })
    };
    list(object, key).iter().map(index).collect()
}

/// The nodes that are below no other; every other node must be below one only.
fn roots(children: &[Vec<usize>]) -> Result<Vec<usize>> {
    let mut below = vec![None; children.len()];
    for (parent, children) in children.iter().enumerate() {
        for &child in children {
            if let Some(other) = below[child].replace(parent) {
                let what = format!("node {child} is below both node {other} and node {parent}");
                return Err(Error::input(what, DAMAGED));
            }
        }
    }
    Ok((0..children.len())
        .filter(|&n| below[n].is_none())
        .collect())
}

fn shown(json: &Value, children: &[Vec<usize>], roots: &[usize]) -> Result<Vec<usize>> {
    let mut first = match list(json, "scenes") {
        [] => roots.to_vec(),
        _ => {
            let scene = whole(json, "scene", "the file")?.unwrap_or(0);
            let object = element(json, "scenes", scene, "the file")?;
            indices(object, "nodes", children.len(), &format!("scene {scene}"))?
        }
    };
    first.reverse();
    let mut seen = vec![false; children.len()];
    let mut order = Vec::new();
    while let Some(node) = first.pop() {
        if !std::mem::replace(&mut seen[node], true) {
            order.push(node);
            first.extend(children[node].iter().rev());
        }
    }
    Ok(order)
}

/// The place of a node in its parent.
fn local(node: &Value, index: usize) -> Result<Matrix4<f64>> {
    let place = format!("node {index}");
    if let Some(columns) = numbers::<16>(node, "matrix", &place)? {
        return Ok(affine(&columns));
    }
    let [x, y, z, w] = numbers(node, "rotation", &place)?.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale: [f64; 3] = numbers(node, "scale", &place)?.unwrap_or([1.0; 3]);
    let translation: [f64; 3] = numbers(node, "translation", &place)?.unwrap_or([0.0; 3]);
    let rotation = Quaternion::new(w, x, y, z);
    let rotation = if (x, y, z) == (0.0, 0.0, 0.0) || rotation.norm_squared() == 0.0 {
        Matrix3::identity()
    } else {
        *UnitQuaternion::from_quaternion(rotation)
            .to_rotation_matrix()
            .matrix()
    };
    let linear = rotation * Matrix3::from_diagonal(&Vector3::from(scale));
    let mut matrix = linear.to_homogeneous();
    matrix
        .fixed_view_mut::<3, 1>(0, 3)
        .copy_from_slice(&translation);
    Ok(matrix)
}

/// A matrix of 16 numbers, column after column; what its last row says is not used.
pub(super) fn affine(columns: &[f64; 16]) -> Matrix4<f64> {
    let mut matrix = Matrix4::from_column_slice(columns);
    matrix.set_row(3, &nalgebra::RowVector4::new(0.0, 0.0, 0.0, 1.0));
    matrix
}
