//! The folder of real models, which is not in the repository.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use symmetrizer::{Error, Result};

/// The folder named by `SYMMETRIZER_DATA`, or `shared/data` beside the checkout.
///
/// # Errors
/// [`Error::Input`] where it is not there.
pub fn root() -> Result<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let root = std::env::var_os("SYMMETRIZER_DATA").map_or(beside, PathBuf::from);
    if root.is_dir() {
        return Ok(root);
    }
    let what = format!("no test data at {}", root.display());
    Err(Error::input(what, "set SYMMETRIZER_DATA to its folder"))
}

/// The text of a file.
///
/// # Errors
/// [`Error::Io`].
pub fn text(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).map_err(|e| Error::io(path, e))
}

/// What a JSON file holds.
///
/// # Errors
/// [`Error::Io`]; [`Error::Input`] for a file that holds something else.
pub fn json<T: DeserializeOwned>(path: &Path) -> Result<T> {
    serde_json::from_str(&text(path)?).map_err(|e| damaged(path, &e.to_string()))
}

/// An error about a file of the test data.
pub fn damaged(path: &Path, what: &str) -> Error {
    Error::input(what, "the test data is damaged").in_file(path)
}
