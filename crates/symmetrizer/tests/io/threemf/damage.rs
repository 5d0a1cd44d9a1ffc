//! Damaged and hostile packages.

use std::io::{Cursor, Write};

use symmetrizer::shape::io::{self, Format};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::*;

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
