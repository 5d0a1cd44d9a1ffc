//! Files that are made from other documents.

use crate::shared::{document, faces, mesh, pyramid};
use symmetrizer::shape::document::{Kept, NO_ROW, Numbers, On, Role, Values};
use symmetrizer::shape::io::{self, Format};
use symmetrizer::shape::{Document, mesh::Mesh};

use super::*;

#[test]
fn fresh_files_hold_every_layer() {
    for format in [Format::Glb, Format::Gltf] {
        let rich = rich();
        assert_eq!(io::losses(&rich, format), Vec::<String>::new());
        let read = document(written(&rich, format), format);
        assert_eq!(read.mesh, rich.mesh);
        for layer in &rich.layers {
            assert!(
                read.layers.contains(layer),
                "{:?} {:?}",
                layer.role,
                read.layers
            );
        }
        assert_eq!(read.layers.len(), rich.layers.len());
    }
}

#[test]
fn both_forms_keep_the_same() {
    let glb = document(written(&rich(), Format::Glb), Format::Glb);
    let text = document(written(&glb, Format::Gltf), Format::Gltf);
    assert_eq!(glb, text);
    assert_eq!(written(&glb, Format::Glb), written(&text, Format::Glb));
}

#[test]
fn polygons_are_cut_and_points_stay() {
    let document = Document::from(pyramid());
    let lost = io::losses(&document, Format::Glb);
    assert!(
        lost[0].contains("1 face of more than three corners"),
        "{lost:?}"
    );
    let read = self::document(written(&document, Format::Glb), Format::Glb);
    let expected: Vec<[u32; 3]> = document.mesh.triangles().map(|t| t.0).collect();
    assert_eq!(faces(&read.mesh), expected);
    assert_eq!(read.mesh.positions.len(), 6);
    let cloud = Document::from(mesh(&[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], &[]));
    let read = self::document(written(&cloud, Format::Glb), Format::Glb);
    assert_eq!(read.mesh, cloud.mesh);
    assert_eq!(json_of(&read)["meshes"][0]["primitives"][0]["mode"], 0);
    let nothing = Document::default();
    let read = self::document(written(&nothing, Format::Gltf), Format::Gltf);
    assert_eq!(read.mesh, Mesh::default());
}

#[test]
fn vertices_are_split_where_their_corners_differ() {
    let square = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let pool = Values::Pool {
        width: 2,
        numbers: Numbers::F64(vec![0.0, 0.0, 0.5, 0.0, 0.5, 0.5, 0.0, 0.0]),
        // Row 3 equals row 0; vertex 2 has rows 2 and 1.
        rows: vec![0, 1, 2, 3, 1, NO_ROW],
    };
    let document = Document {
        mesh: mesh(&square, &[&[0, 1, 2], &[0, 2, 3]]),
        layers: vec![layer(On::Corner, Role::TexCoord(0), "", pool)],
        kept: Kept::Nothing,
    };
    let lost = io::losses(&document, Format::Glb);
    assert!(
        lost.iter().any(|l| l.starts_with("1 shared vertex")),
        "{lost:?}"
    );
    let read = self::document(written(&document, Format::Glb), Format::Glb);
    assert_eq!(read.mesh.positions.len(), 5);
    assert_eq!(read.mesh.positions[2], read.mesh.positions[3]);
    assert_eq!(faces(&read.mesh), [[0, 1, 3], [0, 2, 4]]);
    let coordinates = &read.layer(On::Vertex, Role::TexCoord(0)).unwrap().values;
    let at = |v: usize| [coordinates.get(v, 0), coordinates.get(v, 1)].map(Option::unwrap);
    assert_eq!([at(2), at(3), at(4)], [[0.5, 0.0], [0.5, 0.5], [0.0, 0.0]]);
}

#[test]
fn objects_that_mix_are_said_to_be_lost() {
    let mut rich = rich();
    rich.mesh = mesh(&[[0.0; 3]; 6], &[&[0, 1, 4], &[5, 2, 3]]);
    let lost = io::losses(&rich, Format::Glb);
    assert_eq!(lost, ["object names (per face)"]);
    let read = document(written(&rich, Format::Glb), Format::Glb);
    assert_eq!(read.mesh, rich.mesh);
}
