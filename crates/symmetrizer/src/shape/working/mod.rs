//! The working surface: triangles in normalised coordinates, with the map back to the document.
//!
//! Every stage runs here. The area centroid is the origin and the rotation-invariant scale
//! L = 4 x area-weighted rms radius is 1, so that all lengths inside are fractions of L and nothing
//! depends on the units, the place or the bounding box of the file. The surface is also clean: what
//! the document holds twice, inside out or not at all is put right here, and only here.

mod faces;
mod normalization;
mod orient;
mod weld;

use crate::error::Result;
use crate::geom::{Point, Vector};
use crate::shape::cloud::{CORNERS, Discs};
use crate::shape::mesh::Mesh;
use crate::shape::surface::Surface;
use crate::shape::wall::Wall;

use faces::usable;
use normalization::normalize;
use orient::orient;
use weld::{drop_unused, weld};

pub use faces::Mended;
pub use normalization::Normalization;

/// A surface to work on and its relation to the document it came from.
#[derive(Debug, Clone)]
pub struct Working {
    /// The rest surface: vertices in equal places welded; unused ones left out, as are faces that are
    /// degenerate, there already, or without a finite position; faces of a connected part run the same
    /// way round.
    pub surface: Surface,
    /// The similarity to document coordinates.
    pub normalization: Normalization,
    /// The working vertex of each document vertex; `None` for vertices that no face here uses.
    pub vertex_of_document: Vec<Option<u32>>,
    /// The document vertex that each working vertex stands for, the first of several.
    pub document_of_vertex: Vec<u32>,
    /// The document's polygon of each working triangle; none in a cloud.
    pub polygon_of_face: Vec<u32>,
    /// The index among [`Mesh::triangles`] of each working triangle; none in a cloud.
    pub document_face: Vec<u32>,
    /// What differs from the document.
    pub mended: Mended,
    /// Where the document is a cloud, how exactly its points tell the surface.
    pub cloud: Option<CloudScale>,
}

/// How exactly the points of a cloud tell the surface, fractions of L.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CloudScale {
    /// Standard deviation of the points' distance from the surface.
    pub noise: f64,
    /// Side of the square that a point stands for, median.
    pub spacing: f64,
}

impl Working {
    /// The working surface of a document mesh.
    ///
    /// # Errors
    /// [`crate::Error::Input`] where [`Mesh::check`] fails or the surface has no area.
    pub fn new(mesh: &Mesh) -> Result<Self> {
        mesh.check()?;
        let mut mended = Mended::default();
        let (mut vertex_of_document, mut welded) = weld(mesh);
        let faces = usable(mesh, &vertex_of_document, &mut mended);
        let mut triangles: Vec<[u32; 3]> = faces.iter().map(|f| f.corners).collect();
        drop_unused(&mut vertex_of_document, &mut welded, &mut triangles);
        mended.turned = orient(&welded, &mut triangles);
        let normalization = normalize(&welded, &triangles)?;
        let positions = welded.iter().map(|p| normalization.to_working(p)).collect();
        Ok(Self {
            document_of_vertex: first_documents(&vertex_of_document, welded.len()),
            surface: Surface::new(positions, triangles.into()),
            normalization,
            vertex_of_document,
            polygon_of_face: faces.iter().map(|f| f.polygon).collect(),
            document_face: faces.iter().map(|f| f.index).collect(),
            mended,
            cloud: None,
        })
    }

    /// The working surface of a document without faces, discs at its points ([`Discs`]); `normals` are
    /// those of the document, one for each vertex. The corners of a disc are working vertices; a
    /// document vertex has the first corner of the disc that stands for it. No working triangle has a
    /// polygon.
    ///
    /// # Errors
    /// [`crate::Error::Input`] as for [`Discs::new`].
    pub fn of_cloud(mesh: &Mesh, normals: Option<&[Vector]>) -> Result<Self> {
        let discs = Discs::new(&mesh.positions, normals)?;
        let (corners, triangles) = discs.triangles();
        let normalization = normalize(&corners, &triangles)?;
        let positions = corners
            .iter()
            .map(|p| normalization.to_working(p))
            .collect();
        let first_corner = |disc: Option<u32>| disc.map(|d| d * CORNERS as u32);
        let vertex_of_document = discs.disc_of_document.into_iter().map(first_corner);
        Ok(Self {
            surface: Surface::new(positions, triangles.into()),
            normalization,
            vertex_of_document: vertex_of_document.collect(),
            polygon_of_face: Vec::new(),
            document_face: Vec::new(),
            mended: Mended::default(),
            cloud: Some(CloudScale {
                noise: discs.noise / normalization.scale,
                spacing: discs.spacing / normalization.scale,
            }),
            document_of_vertex: each_corner(&discs.document),
        })
    }

    /// The wall over an outline as a working surface; its document has a vertex for each edge of the outline, where
    /// it starts, and no faces.
    pub fn of_wall(wall: &Wall) -> Self {
        let edges = wall.edges() as u32;
        let doubled = |e: u32| [e, e];
        Self {
            surface: wall.surface.clone(),
            normalization: wall.normalization,
            vertex_of_document: (0..edges).map(|e| Some(2 * e)).collect(),
            document_of_vertex: (0..edges).flat_map(doubled).collect(),
            polygon_of_face: (0..edges).flat_map(doubled).collect(),
            document_face: (0..edges).flat_map(doubled).collect(),
            mended: Mended::default(),
            cloud: None,
        }
    }

    /// The document with its vertices moved as the working vertices were; a vertex that did not
    /// move, or that no face uses, keeps its coordinates to the last bit.
    pub fn moved_document(&self, mesh: &Mesh, positions: &[Point]) -> Mesh {
        let mut moved = mesh.clone();
        for (p, &v) in moved.positions.iter_mut().zip(&self.vertex_of_document) {
            if let Some(v) = v {
                let moved = positions[v as usize] - self.surface.positions[v as usize];
                // Adding zero would turn -0 into 0.
                if moved != Vector::zeros() {
                    *p += moved * self.normalization.scale;
                }
            }
        }
        moved
    }
}

/// For each of `count` working vertices the first document vertex it stands for.
fn first_documents(vertex_of_document: &[Option<u32>], count: usize) -> Vec<u32> {
    let mut first = vec![u32::MAX; count];
    for (document, vertex) in (0..).zip(vertex_of_document) {
        if let Some(v) = vertex {
            let slot = &mut first[*v as usize];
            *slot = document.min(*slot);
        }
    }
    first
}

/// The document vertex of each disc, once for each of its corners.
fn each_corner(document: &[u32]) -> Vec<u32> {
    document.iter().flat_map(|&d| [d; CORNERS]).collect()
}
