//! `f` and the state that faces stand under.

use super::super::text::at_line;
use super::corners::{self, NO_VERTEX};
use crate::error::Result;
use crate::shape::document::{NO_ROW, NameList, Role, Values};
use crate::shape::mesh::Polygons;

/// The names that faces stand under, in the order in which they are written.
const ROLES: [Role; 4] = [Role::Object, Role::Group, Role::Material, Role::Smoothing];

/// The faces, the rows of their corners, their names.
#[derive(Default)]
pub(super) struct Faces {
    polygons: Polygons,
    corners: Vec<u32>,
    texture_rows: Vec<u32>,
    normal_rows: Vec<u32>,
    /// The names of the faces so far, and of those to come.
    names: [(NameList, Option<String>); 4],
    /// The first corner that is no index, and the highest vertex named, each with its line: a face
    /// may stand before its vertices, so the range is known at the end only.
    bad: Option<(usize, String)>,
    highest: Option<(u32, usize)>,
}

impl Faces {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.polygons.is_empty()
    }

    /// The name of the faces to come.
    pub fn name(&mut self, role: Role, name: &str) {
        if let Some(k) = ROLES.iter().position(|r| *r == role) {
            self.names[k].1 = (!name.is_empty()).then(|| name.to_owned());
        }
    }

    pub fn read<'a>(
        &mut self,
        words: impl Iterator<Item = &'a [u8]>,
        counts: [usize; 3],
        line: usize,
    ) -> Result<()> {
        self.corners.clear();
        for word in words {
            let ([vertex, texture, normal], is_index) = corners::corner(word, counts);
            if !is_index {
                self.bad
                    .get_or_insert_with(|| (line, corners::bad(word, counts[0])));
            } else if self.highest.is_none_or(|(highest, _)| vertex > highest) {
                self.highest = Some((vertex, line));
            }
            self.corners.push(vertex);
            self.texture_rows.push(texture);
            self.normal_rows.push(normal);
        }
        if self.corners.is_empty() {
            return Err(at_line(line, "a face without corners", "remove the line"));
        }
        if self.corners.len() < 3 && self.bad.is_none() {
            let what = format!("a face with {} corners; it needs three", self.corners.len());
            self.bad = Some((line, what));
        }
        self.polygons.push(&self.corners);
        for (names, now) in &mut self.names {
            names.push(now.as_deref());
        }
        Ok(())
    }

    /// The line and kind of the first fault that keeps faces from being faces of `count` vertices.
    pub fn fault(&self, count: usize) -> Option<(usize, String)> {
        let beyond = self.highest.filter(|(v, _)| *v as usize >= count);
        let beyond = beyond.map(|(v, line)| {
            let named = u64::from(v) + 1;
            let what = format!(
                "the face names vertex {named}, but there are only {count} (counted from 1)"
            );
            (line, what)
        });
        self.bad.clone().or(beyond)
    }

    /// The polygons, the rows of their corners in the pools of `vt` and `vn`, the names.
    pub fn finish(
        mut self,
        [_, textures, normals]: [usize; 3],
    ) -> (Polygons, [Vec<u32>; 2], Vec<(Role, Values)>) {
        keep_known(&mut self.texture_rows, textures);
        keep_known(&mut self.normal_rows, normals);
        let names = ROLES.into_iter().zip(self.names);
        let names = names.filter_map(|(role, (names, _))| Some((role, names.finish()?)));
        (
            self.polygons,
            [self.texture_rows, self.normal_rows],
            names.collect(),
        )
    }
}

/// A reference to a row that the file does not have is no reference.
fn keep_known(rows: &mut [u32], count: usize) {
    for row in rows.iter_mut().filter(|r| **r as usize >= count) {
        *row = NO_ROW;
    }
}

const _: () = assert!(NO_VERTEX == NO_ROW);
