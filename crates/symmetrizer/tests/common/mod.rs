//! What the test files share.

use std::path::{Path, PathBuf};

/// The file or folder `relative` of the test data: below `SYMMETRIZER_DATA`, or below `shared/data`
/// beside the checkout. `None`, with a loud line, where there is none: the data is not in the
/// repository.
pub fn data(relative: &str) -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let root = std::env::var_os("SYMMETRIZER_DATA").map_or(beside, PathBuf::from);
    let path = root.join(relative);
    if path.exists() {
        return Some(path);
    }
    skip(&path);
    None
}

#[allow(clippy::print_stderr)] // A test that does nothing must not look like one that passed.
fn skip(path: &Path) {
    eprintln!("SKIPPED: no test data at {}", path.display());
}
