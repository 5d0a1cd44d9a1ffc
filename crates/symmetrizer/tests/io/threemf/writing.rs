//! Packages written back, and new ones.

use std::io::Cursor;

use symmetrizer::shape::document::{Kept, Layer, NO_ROW, On, Role, Values};
use symmetrizer::shape::io::{self, Format};
use symmetrizer::shape::{Document, Mesh};
use zip::ZipArchive;

use super::*;

#[test]
fn an_unchanged_document_is_the_same_file() {
    let bytes = package(&object(7, ""), "<item objectid=\"7\"/>");
    assert_eq!(written(&read(&bytes)), bytes);
}

#[test]
fn only_moved_coordinates_get_new_text() {
    let text = model(&object(7, ""), "<item objectid=\"7\"/>");
    let parts = [
        ("a.txt", "some text"),
        ("_rels/.rels", START),
        ("3D/Start.model", text.as_str()),
        ("Thumb.png", "picture"),
    ];
    let mut document = read(&packed(&parts));
    document.mesh.positions[1].y = 0.1 + 0.2;
    document.mesh.positions[3].z = -0.0;
    let bytes = comes_back(&document);
    assert_eq!(read(&bytes).mesh, document.mesh);
    let expected = text
        .replace("+0.0", "0.30000000000000004")
        .replace("1.00", "-0");
    assert_eq!(part(&bytes, "3D/Start.model"), expected);
    let names: Vec<String> = {
        let archive = ZipArchive::new(Cursor::new(&bytes)).unwrap();
        archive
            .file_names()
            .map(|n| n.unwrap().into_owned())
            .collect()
    };
    assert_eq!(names, parts.map(|(name, _)| name));
    assert_eq!(part(&bytes, "a.txt"), "some text");
    assert_eq!(written(&document), bytes);
}

#[test]
fn moved_vertices_go_back_through_the_transform() {
    let build = "<item objectid=\"7\" transform=\"0.3 0.4 0 -0.4 0.3 0 0.1 0 2 100 -20 7\"/>";
    let bytes = package(&object(7, ""), build);
    let mut document = read(&bytes);
    document.mesh.positions[2] += symmetrizer::geom::Vector::new(0.25, 0.5, -3.0);
    let again = comes_back(&document);
    let text = part(&again, "3D/start.model");
    assert!(text.contains("x=\"0.10\" y='0'"), "{text}");
    assert!(text.contains("z = \"0e0\" x=\"1\" y=\"+0.0\" />"), "{text}");
}

#[test]
fn copies_that_differ_become_objects() {
    let resources = object(
        7,
        "name=\"part\" p:UUID=\"01234567-89ab-cdef-0123-456789abcdef\"",
    );
    let build = "<item objectid=\"7\"/><item objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 1 9 0 0\"/>\
                 <item objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 1 0 9 0\" printable=\"0\"/>";
    let mut document = read(&package(&resources, build));
    document.mesh.positions[5].z = 0.75;
    let text = part(&comes_back(&document), "3D/start.model");
    assert!(text.contains("<item objectid=\"8\" transform=\"1 0 0 0 1 0 0 0 1 9 0 0\"/>"));
    assert!(text.contains("<item objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 1 0 9 0\" printable"));
    assert!(text.contains("<object id=\"8\" name=\"part\" p:UUID=\"00000008-0000-cdef-0123"));
    // The same move at all places stays one object.
    let mut together = read(&package(&resources, build));
    for v in [1, 5, 9] {
        together.mesh.positions[v].z = 0.75;
    }
    let text = part(&comes_back(&together), "3D/start.model");
    assert!(!text.contains("<object id=\"8\""), "{text}");
}

#[test]
fn compositions_that_differ_become_flat() {
    let resources = object(7, "")
        + "<object id=\"2147483647\" name=\"pair\"><components><component objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/>\
           <component objectid=\"7\"/></components></object>\
           <object id=\"11\"><components><component objectid=\"2147483647\"/>\
           <component objectid=\"2147483647\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 5\"/></components></object>";
    let build =
        "<item objectid=\"11\" transform=\"1 0 0 0 1 0 0 0 1 0 0 9\"/><item objectid=\"11\"/>";
    let mut document = read(&package(&resources, build));
    assert_eq!(document.mesh.positions.len(), 32);
    document.mesh.positions[6].z += 0.5;
    document.mesh.positions[31].x += 0.25;
    let bytes = comes_back(&document);
    let text = part(&bytes, "3D/start.model");
    assert_eq!(text.matches("<object ").count(), 15, "{text}");
    // And again, from what was written.
    let mut again = read(&bytes);
    again.mesh.positions[0].x += 0.125;
    comes_back(&again);
}

#[test]
fn transforms_without_a_way_back() {
    let build =
        "<item objectid=\"7\" transform=\"1 0 0 0 1 0 0 0 0 0 0 0\"/><item objectid=\"7\"/>";
    let mut document = read(&package(&object(7, ""), build));
    document.mesh.positions[0].z = 0.5;
    comes_back(&document);
    document.mesh.positions[6].z = 0.25;
    comes_back(&document);
}

#[test]
fn parts_beside_the_first() {
    let other = model(&object(1, "p:UUID=\"x\""), "");
    let composed = "<object id=\"1\" p:UUID=\"01234567-89ab-cdef-0123-456789abcdef\"><components>\
                    <component p:path=\"/3D/Objects/b.model\" objectid=\"1\"/>\
                    <component p:path=\"/3D/Objects/b.model\" objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/>\
                    </components></object>";
    let build = "<item objectid=\"1\"/><item objectid=\"1\" p:path=\"/3D/Objects/b.model\" transform=\"1 0 0 0 1 0 0 0 1 0 5 0\"/>";
    let start = model(composed, build);
    let parts = [
        ("_rels/.rels", START),
        ("3D/start.model", start.as_str()),
        ("3D/Objects/b.model", other.as_str()),
    ];
    let mut document = read(&packed(&parts));
    assert_eq!(document.mesh.positions.len(), 12);
    document.mesh.positions[0].z = 0.5;
    document.mesh.positions[8].z = 0.5;
    let bytes = comes_back(&document);
    assert_eq!(
        part(&bytes, "3D/Objects/b.model")
            .matches("<object ")
            .count(),
        2
    );
    document.mesh.positions[4].z = 0.125;
    comes_back(&document);
    // Resources may all be elsewhere.
    for empty in ["<resources />", ""] {
        let start = start.replace(&format!("<resources>{composed}</resources>"), empty);
        let start = start.replace("<item objectid=\"1\"/>", "");
        let parts = [parts[0], ("3D/start.model", start.as_str()), parts[2]];
        let mut document = read(&packed(&parts));
        assert_eq!(document.mesh.positions.len(), 4);
        document.mesh.positions[0].z = 0.5;
        comes_back(&document);
        let start = start.replace("0 0 1 0 5 0", "0 0 0 0 0 0");
        let parts = [parts[0], ("3D/start.model", start.as_str()), parts[2]];
        let mut document = read(&packed(&parts));
        document.mesh.positions[0].z = 0.5;
        comes_back(&document);
    }
}

#[test]
fn another_mesh_makes_a_new_package() {
    let mut document = read(&package(&object(7, ""), "<item objectid=\"7\"/>"));
    document.layers.clear();
    document.mesh = pyramid();
    let lost = io::losses(&document, Format::ThreeMf);
    assert_eq!(
        lost,
        [
            "the unit, inch",
            "1 metadata element",
            "1 face of more than three corners, cut into triangles"
        ]
    );
    let again = read(&written(&document));
    assert_eq!(again.mesh.positions, pyramid().positions);
    assert_eq!(again.mesh.polygons.len(), 6);
}

fn layer(role: Role, names: &[&str], of: &[u32]) -> Layer {
    Layer {
        name: String::new(),
        on: On::Face,
        role,
        values: Values::Names {
            names: names.iter().map(|&n| n.to_owned()).collect(),
            of: of.to_vec(),
        },
    }
}

#[test]
fn new_packages_have_objects_and_materials() {
    let mut positions = vec![
        [0.1 + 0.2, 0.0, -0.0],
        [1e300, 0.0, 0.0],
        [0.0, 1e-300, 0.0],
    ];
    positions.extend([
        [7.0, 7.0, 7.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
    ]);
    let document = Document {
        mesh: mesh(
            &positions,
            &[&[0, 1, 2], &[2, 1, 0], &[4, 5, 6], &[6, 5, 4]],
        ),
        layers: vec![
            layer(
                Role::Object,
                &["first \"<&>'", "tab\tand\nline \u{e9}"],
                &[0, 0, 1, 1],
            ),
            layer(Role::Material, &["oak", "ash"], &[1, 0, NO_ROW, 1]),
        ],
        kept: Kept::Nothing,
    };
    let mut again = read(&written(&document));
    again.kept = Kept::Nothing;
    assert_eq!(again, document);
    assert!(io::losses(&document, Format::ThreeMf).is_empty());
    assert_eq!(written(&document), written(&document));
}

#[test]
fn new_packages_say_what_they_lose() {
    let mut document = Document::from(pyramid());
    document.layers = vec![layer(Role::Object, &["a", "b"], &[0, 1, 0, NO_ROW, 1])];
    document.layers.push(Layer {
        name: String::new(),
        on: On::Vertex,
        role: Role::Other,
        values: Values::Lists {
            starts: vec![0; 7],
            numbers: symmetrizer::shape::document::Numbers::F64(Vec::new()),
        },
    });
    let lost = io::losses(&document, Format::ThreeMf);
    assert_eq!(lost.len(), 3, "{lost:?}");
    assert_eq!(lost[2], "the seams of objects: 7 vertices doubled");
    let again = read(&written(&document));
    assert_eq!(again.mesh.positions.len(), 13);
    assert_eq!(again.mesh.polygons.len(), 6);
}

#[test]
fn points_and_empty_documents() {
    for mesh in [Mesh::default(), mesh(&[[1.0, 2.0, f64::NAN]], &[])] {
        let again = read(&written(&mesh.clone().into())).mesh;
        assert_eq!(format!("{again:?}"), format!("{mesh:?}"));
    }
}
