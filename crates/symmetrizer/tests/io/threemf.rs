//! 3MF: what is read, what is written back as it came, what is refused.

mod damage;
mod writing;

use std::io::{Cursor, Read, Write};

use symmetrizer::geom::Point;
use symmetrizer::shape::Document;
use symmetrizer::shape::document::{Kept, On, Role};
use symmetrizer::shape::io::{self, Format};
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
