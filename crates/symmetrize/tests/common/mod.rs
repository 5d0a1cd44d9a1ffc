//! What the test files share: the command, a folder to work in, data, JSON.
#![allow(dead_code)] // No test file uses all of it.

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// Settings under which the generated creature takes a few seconds and still comes out symmetric.
pub const FAST: [&str; 4] = [
    "--set",
    "sample.count=800",
    "--set",
    "deform.control_faces=1000",
];

/// A folder of its own, in which the command runs.
pub struct Desk(TempDir);

impl Desk {
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder"))
    }

    /// The command in this folder.
    pub fn symmetrize(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_symmetrize"));
        command.current_dir(self.0.path()).args(args);
        command
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.bytes(name)).expect("JSON")
    }

    /// A report without the part that differs from run to run.
    pub fn json_but_run(&self, name: &str) -> Value {
        let mut report = self.json(name);
        report.as_object_mut().unwrap().remove("run").expect("run");
        report
    }

    /// All files, hidden ones too, sorted.
    pub fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let name = |e: std::io::Result<std::fs::DirEntry>| e.unwrap().file_name();
        let mut names: Vec<String> = entries
            .map(|e| name(e).to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// A tetrahedron without any symmetry, as `scalene.off`.
    pub fn scalene(&self) {
        let vertices = "0 0 0\n1 0 0\n0.3 2 0\n0.2 0.5 3.1\n";
        let faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
        self.write("scalene.off", &format!("OFF\n4 4 0\n{vertices}{faces}"));
    }
}

/// The file `relative` of the test data: below `SYMMETRIZER_DATA`, or below `shared/data` beside the
/// checkout. `None`, with a loud line, where there is none: the data is not in the repository.
pub fn data(relative: &str) -> Option<String> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let root = std::env::var_os("SYMMETRIZER_DATA").map_or(beside, PathBuf::from);
    let path = root.join(relative);
    if path.exists() {
        return Some(path.to_str().expect("a plain path").to_owned());
    }
    skip(&path);
    None
}

#[allow(clippy::print_stderr)] // A test that does nothing must not look like one that passed.
fn skip(path: &Path) {
    eprintln!("SKIPPED: no test data at {}", path.display());
}

pub fn stdout(assert: &assert_cmd::assert::Assert) -> String {
    String::from_utf8_lossy(&assert.get_output().stdout).into_owned()
}

pub fn stderr(assert: &assert_cmd::assert::Assert) -> String {
    String::from_utf8_lossy(&assert.get_output().stderr).into_owned()
}

/// Fails unless the command refused with exit code 2 and one line that contains `part`.
#[track_caller]
pub fn refused(mut command: Command, part: &str) {
    let text = stderr(&command.assert().code(2).stdout(""));
    assert!(
        text.starts_with("error: ") && text.contains(part),
        "{text:?} lacks {part:?}"
    );
    assert_eq!(text.lines().count(), 1, "{text:?}");
}

/// Width and height of a PNG file.
pub fn png_size(bytes: &[u8]) -> [u32; 2] {
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    [number(16), number(20)]
}

/// The keys of an object, in its order.
pub fn keys(value: &Value) -> Vec<&str> {
    let object = value.as_object().expect("an object");
    object.keys().map(String::as_str).collect()
}

/// `value` at a path of keys, as a number.
#[track_caller]
pub fn number(value: &Value, pointer: &str) -> f64 {
    let found = value.pointer(pointer).and_then(Value::as_f64);
    found.unwrap_or_else(|| panic!("no number at {pointer}"))
}
