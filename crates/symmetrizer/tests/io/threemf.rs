//! 3MF: what is read, what is written back as it came, what is refused.

use std::io::{Cursor, Read, Write};

use symmetrizer::geom::Point;
use symmetrizer::shape::document::{Kept, Layer, NO_ROW, On, Role, Values};
use symmetrizer::shape::io::{self, Format};
use symmetrizer::shape::{Document, Mesh};
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

use crate::common;
use crate::shared::*;

const CORE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
const START: &str = r#"<Relationships xmlns="r"><Relationship Id="a" Type="http://x/thumbnail" Target="/no.png"/><Relationship Id="b" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" Target="/3D/Start.model"/></Relationships>"#;

/// A tetrahedron's triangles over any four vertices.
const TETRAHEDRON: &str = r#"<triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="2" v2="0" v3="3"/></triangles>"#;
const CORNERS: &str = r#"<vertices><vertex x="0.10" y='0' z="0"/><vertex z = "0e0" x="1" y="+0.0" /><vertex x="0" y="1" z="0"><!-- kept --></vertex><vertex x="0" y="0" z="1.00"/></vertices>"#;

fn packed(parts: &[(&str, &str)]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in parts {
        writer
            .start_file(*name, SimpleFileOptions::default())
            .unwrap();
        writer.write_all(text.as_bytes()).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

/// A package with one model.
fn package(resources: &str, build: &str) -> Vec<u8> {
    let text = model(resources, build);
    packed(&[("_rels/.rels", START), ("3D/start.model", &text)])
}

fn model(resources: &str, build: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<model xmlns=\"{CORE}\" xmlns:p=\"production\" unit=\"inch\">\n\
         <metadata name=\"Title\">A &amp; B</metadata><resources>{resources}</resources>\n\
         <build>{build}</build></model>\n"
    )
}

fn object(id: u32, attributes: &str) -> String {
    format!("<object id=\"{id}\" {attributes}><mesh>{CORNERS}{TETRAHEDRON}</mesh></object>")
}

fn read(bytes: &[u8]) -> Document {
    document(bytes.to_vec(), Format::ThreeMf)
}

fn written(document: &Document) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::encode(document, Format::ThreeMf, &mut bytes).unwrap();
    bytes
}

fn part(bytes: &[u8], name: &str) -> String {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).unwrap();
    let mut text = String::new();
    let mut file = archive.by_name(name).unwrap();
    file.read_to_string(&mut text).unwrap();
    text
}

fn refused(bytes: &[u8], parts: &[&str]) {
    let message = failure(Format::ThreeMf, bytes);
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}

/// Writes the document and reads it again; the positions agree to rounding, all else exactly.
#[track_caller]
fn comes_back(document: &Document) -> Vec<u8> {
    let bytes = written(document);
    let again = read(&bytes);
    assert_eq!(again.mesh.polygons, document.mesh.polygons);
    assert_eq!(again.layers, document.layers);
    let pairs = again.mesh.positions.iter().zip(&document.mesh.positions);
    for (v, (a, b)) in pairs.enumerate() {
        assert!(
            (a - b).norm() <= 1e-13 * (1.0 + b.coords.norm()),
            "{v}: {a} {b}"
        );
    }
    bytes
}

#[test]
fn objects_stand_where_the_build_puts_them() {
    let resources = object(7, "name=\"a &lt;b&gt;\"")
        + "<object id=\"9\"><components><component objectid=\"7\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 5\"/>\
           <component objectid=\"7\"/></components></object>";
    let build =
        "<item objectid=\"9\" transform=\"2 0 0 0 2 0 0 0 2 100 0 0\"/><item objectid=\"7\"/>";
    let read = read(&package(&resources, build));
    assert_eq!(read.mesh.positions.len(), 12);
    assert_eq!(read.mesh.polygons.len(), 12);
    // x goes to y, then up by 5, then twice as large, then 100 to the right.
    assert_eq!(read.mesh.positions[1], Point::new(100.0, 2.0, 10.0));
    assert_eq!(read.mesh.positions[5], Point::new(102.0, 0.0, 0.0));
    assert_eq!(read.mesh.positions[9], Point::new(1.0, 0.0, 0.0));
    assert_eq!(read.mesh.polygons.get(4), [4, 6, 5]);
    let names = read.layer(On::Face, Role::Object).unwrap();
    assert_eq!(names.values.name(11), Some("a <b>"));
    let Kept::ThreeMf(kept) = &read.kept else {
        panic!("nothing kept");
    };
    let counts: Vec<_> = kept.blocks.iter().map(|b| (b.object, b.vertices)).collect();
    assert_eq!(counts, [(7, 4); 3]);
}

#[test]
fn a_mirror_keeps_the_outside_outside() {
    let build = "<item objectid=\"7\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>";
    let mirrored = read(&package(&object(7, ""), build));
    assert_eq!(mirrored.mesh.polygons.get(0), [0, 1, 2]);
    assert!(mirrored.layers.is_empty());
}

#[test]
fn without_a_build_all_meshes_are_read() {
    let resources = object(7, "") + &object(3, "");
    let both = read(&package(&resources, ""));
    assert_eq!(both.mesh.positions.len(), 8);
    let Kept::ThreeMf(kept) = &both.kept else {
        panic!("nothing kept");
    };
    assert_eq!(kept.blocks[0].object, 7);
}

#[test]
fn prefixes_and_missing_relationships() {
    let text = model(&object(7, ""), "<item objectid=\"7\"/>");
    let text = text.replace("xmlns=", "xmlns:q=").replace("</", "</q:");
    let mut prefixed = String::from("\u{feff}");
    for (i, piece) in text.split('<').enumerate() {
        let plain = i == 0 || piece.starts_with(['/', '?', '!']);
        let mark = if i == 0 { "" } else { "<" };
        prefixed += &format!("{mark}{}{piece}", if plain { "" } else { "q:" });
    }
    let mut document = read(&packed(&[("other/THING.MODEL", &prefixed)]));
    assert_eq!(document.mesh.polygons.len(), 4);
    document.mesh.positions[0].x = 0.5;
    let again = part(&comes_back(&document), "other/THING.MODEL");
    assert_eq!(again, prefixed.replace("0.10", "0.5"));
}

#[test]
fn names_of_materials_are_read_and_damaged_properties_passed_over() {
    let resources = r##"<basematerials id="4"><base name="oak" displaycolor="#ff0000"/><base name="ash" displaycolor="#00ff00"/></basematerials><m:colorgroup xmlns:m="m" id="5"><m:color color="#ff0000"/></m:colorgroup>"##.to_owned()
        + &object(7, "pid=\"4\" pindex=\"1\"");
    let own = resources
        .replace("v1=\"0\" v2=\"2\"", "pid=\"4\" p1=\"0\" v1=\"0\" v2=\"2\"")
        .replace("v1=\"1\" v2=\"2\"", "pid=\"5\" p1=\"0\" v1=\"1\" v2=\"2\"")
        .replace(
            "v1=\"2\" v2=\"0\"",
            "pid=\"4\" p1=\"1000000\" v1=\"2\" v2=\"0\"",
        );
    let read = read(&package(&own, "<item objectid=\"7\"/>"));
    let layer = read.layer(On::Face, Role::Material).unwrap();
    let names = [0, 1, 2, 3].map(|f| layer.values.name(f));
    assert_eq!(names, [Some("oak"), Some("ash"), None, None]);
    let lost = io::losses(&read, Format::Off);
    for phrase in [
        "the unit, inch",
        "1 metadata element",
        "1 colorgroup element",
    ] {
        assert!(lost.iter().any(|l| l == phrase), "{lost:?}");
    }
    assert!(io::losses(&read, Format::ThreeMf).is_empty());
}

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
            "1 faces of more than three corners, cut into triangles"
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

#[test]
fn messages_say_where_and_how() {
    refused(b"not a zip", &["zip file", "export it again"]);
    refused(&packed(&[("a.txt", "a")]), &["none of the 1 parts"]);
    let with = |text: &str| packed(&[("3d.model", text)]);
    refused(
        &with("<model>\n<a>"),
        &["3d.model, line 2", "<a>", "cut off"],
    );
    refused(&with("<model>\n</wrong>"), &["3d.model, line 2"]);
    let build = "<item objectid=\"7\"/>";
    let bad = |from: &str, to: &str, parts: &[&str]| {
        let text = model(&object(7, ""), build).replacen(from, to, 1);
        refused(&with(&text), parts);
    };
    bad(
        "\"0.10\"",
        "\"0,1\"",
        &["line 3", "x=\"0,1\"", "coordinate"],
    );
    bad("x=\"0.10\"", "", &["line 3", "no attribute 'x'"]);
    bad(
        "v1=\"0\"",
        "v1=\"4\"",
        &["triangle 0 of object 7", "vertex 4", "only 4"],
    );
    bad("v1=\"0\"", "v1=\"-1\"", &["v1=\"-1\"", "whole numbers"]);
    bad("objectid=\"7\"", "objectid=\"8\"", &["object 8"]);
    bad(
        "objectid=\"7\"",
        "objectid=\"7\" transform=\"1 2\"",
        &["line 4", "twelve"],
    );
    bad(
        "objectid=\"7\"",
        "objectid=\"7\" p:path=\"/x.model\"",
        &["x.model", "not in the package"],
    );
    let itself = "<object id=\"7\"><components><component objectid=\"7\"/></components></object>";
    refused(
        &package(itself, build),
        &["object 7 is a component of itself"],
    );
    refused(
        &package(&object(7, "").repeat(2), build),
        &["second object", "id 7"],
    );
}

#[test]
fn bombs_are_refused() {
    let zeros = " ".repeat(40 << 20);
    let text = model(&zeros, "");
    refused(&packed(&[("3d.model", &text)]), &["3d.model", "256 times"]);
    // Ten objects, each ten times the one before.
    let mut resources = object(1, "");
    for id in 2..12 {
        let component = format!("<component objectid=\"{}\"/>", id - 1);
        let ten = component.repeat(10);
        resources += &format!("<object id=\"{id}\"><components>{ten}</components></object>");
    }
    refused(
        &package(&resources, "<item objectid=\"11\"/>"),
        &["too large for a file of this size"],
    );
    let chain = (2..60).map(|id| {
        let of = id - 1;
        format!(
            "<object id=\"{id}\"><components><component objectid=\"{of}\"/></components></object>"
        )
    });
    let chain = object(1, "") + &chain.collect::<String>();
    refused(
        &package(&chain, "<item objectid=\"59\"/>"),
        &["nested in more than 32"],
    );
}

#[test]
fn files_of_the_collection() {
    let (Some(formats), Some(dirty)) = (common::data("formats"), common::data("dirty")) else {
        return;
    };
    let spot = io::read(&formats.join("spot.3mf")).unwrap();
    let reference = io::read(&formats.join("spot.obj")).unwrap().mesh;
    assert_eq!(spot.mesh.polygons, reference.polygons);
    for (a, b) in spot.mesh.positions.iter().zip(&reference.positions) {
        assert!((a - b).norm() < 1e-6);
    }
    for (folder, name, counts) in [
        (&formats, "spot.3mf", (2930, 5856)),
        (&dirty, "box.3mf", (8, 12)),
        (&dirty, "pyramids.3mf", (1665, 3276)),
        (&dirty, "malformed_index_oob.3mf", (3, 1)),
    ] {
        let mut document = io::read(&folder.join(name)).unwrap();
        let mesh = &document.mesh;
        assert_eq!(
            (mesh.positions.len(), mesh.polygons.len()),
            counts,
            "{name}"
        );
        let scale = mesh.diagonal();
        for (v, p) in document.mesh.positions.iter_mut().enumerate().skip(1) {
            p.x += 0.01 * scale * (v as f64).sin();
        }
        comes_back(&document);
    }
}

/// Numbers that look random and are always the same.
struct Dice(u64);

impl Dice {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 33) as usize % end.max(1)
    }

    /// Changes a few bytes, or cuts, doubles or drops a piece.
    fn damage(&mut self, bytes: &mut Vec<u8>) {
        let [a, b] = [self.below(bytes.len()), self.below(bytes.len())];
        let piece = a.min(b)..a.max(b).min(a.min(b) + 60);
        match self.below(8) {
            0 => bytes.truncate(a),
            1 => drop(bytes.drain(piece)),
            2 => bytes.extend_from_within(piece),
            3 => {
                let words: [&[u8]; 6] =
                    [b"4294967295", b"<", b"\"", b"-1e999", b"&x;", b"</object>"];
                let word = words[self.below(words.len())].to_vec();
                drop(bytes.splice(a..a, word));
            }
            _ => {
                for _ in 0..1 + self.below(4) {
                    let at = self.below(bytes.len());
                    let bit = 1 << self.below(8);
                    bytes.get_mut(at).into_iter().for_each(|byte| *byte ^= bit);
                }
            }
        }
    }
}

#[test]
fn damaged_files_never_panic() {
    const CASES: usize = 1000;
    let composed = object(7, "name=\"a\" pid=\"4\" pindex=\"0\"")
        + "<basematerials id=\"4\"><base name=\"oak\" displaycolor=\"#ff0000\"/></basematerials>\
           <object id=\"9\"><components><component objectid=\"7\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 5\"/>\
           <component objectid=\"7\" p:path=\"/3D/start.model\"/></components></object>";
    let build =
        "<item objectid=\"9\" transform=\"2 0 0 0 2 0 0 0 2 100 0 0\"/><item objectid=\"7\"/>";
    let text = model(&composed, build);
    let mut dice = Dice(1);
    let mut readable = 0;
    for case in 0..CASES {
        let mut parts = [START.as_bytes().to_vec(), text.as_bytes().to_vec()];
        let inside = case % 2 == 0;
        if inside {
            let part = usize::from(dice.below(8) > 0);
            dice.damage(&mut parts[part]);
        }
        let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, part) in ["_rels/.rels", "3D/start.model"].iter().zip(&parts) {
            writer
                .start_file(*name, SimpleFileOptions::default())
                .unwrap();
            writer.write_all(part).unwrap();
        }
        let mut bytes = writer.finish().unwrap().into_inner();
        if !inside {
            dice.damage(&mut bytes);
        }
        if let Ok(mut document) = io::decode(bytes, Format::ThreeMf) {
            readable += 1;
            for p in &mut document.mesh.positions {
                p.x += dice.below(2) as f64 / 4.0;
            }
            // What could be read can be written.
            let again = read(&written(&document));
            assert_eq!(again.mesh.polygons, document.mesh.polygons);
            for format in Format::ALL {
                let _ = io::losses(&document, format);
            }
        }
    }
    assert!(readable > CASES / 20, "{readable}");
}
