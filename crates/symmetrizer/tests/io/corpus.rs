//! The seeds of the fuzz targets and what fuzzing found, through the targets' own check.

use std::path::Path;

use symmetrizer::shape::io::Format;

#[path = "../../../../fuzz/src/check.rs"]
mod check;

#[path = "../../../../fuzz/src/drawing.rs"]
mod drawing;

const TARGETS: [(&str, Format); 7] = [
    ("obj", Format::Obj),
    ("ply", Format::Ply),
    ("off", Format::Off),
    ("stl", Format::Stl),
    ("gltf", Format::Gltf),
    ("threemf", Format::ThreeMf),
    ("xyz", Format::Xyz),
];

#[test]
fn seeds_and_regressions_pass_the_check() {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz");
    let mut checked = [0, 0];
    for (target, format) in TARGETS {
        for (kind, count) in ["seeds", "regressions"].iter().zip(&mut checked) {
            let Ok(files) = std::fs::read_dir(fuzz.join(kind).join(target)) else {
                continue;
            };
            for file in files {
                let path = file.unwrap().path();
                println!("{}", path.display());
                check::check(&std::fs::read(&path).unwrap(), format);
                *count += 1;
            }
        }
    }
    assert!(checked[0] >= 15 && checked[1] >= 1, "{checked:?}");
}

#[test]
fn seeds_are_good_files() {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    for (target, format) in TARGETS.into_iter().filter(|t| t.0 != "threemf") {
        for file in std::fs::read_dir(fuzz.join(target)).unwrap() {
            let bytes = std::fs::read(file.unwrap().path()).unwrap();
            let read = symmetrizer::shape::io::decode(bytes, format);
            assert!(read.is_ok(), "{target}: {read:?}");
        }
    }
}

#[test]
fn drawings_pass_their_check() {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz");
    let mut seeds = 0;
    for kind in ["seeds", "regressions"] {
        let Ok(files) = std::fs::read_dir(fuzz.join(kind).join("drawing")) else {
            continue;
        };
        for file in files {
            let path = file.unwrap().path();
            println!("{}", path.display());
            drawing::check(&std::fs::read(&path).unwrap());
            seeds += u32::from(kind == "seeds");
        }
    }
    assert!(seeds >= 3, "{seeds}");
}
