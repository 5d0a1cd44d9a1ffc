//! Errors by cause, and warnings: what went wrong, where, and how to mend it.
//!
//! "No symmetry found" and "energy limit reached" are outcomes of a run, not errors. Bugs panic.

use std::path::PathBuf;

/// The library's result.
pub type Result<T> = std::result::Result<T, Error>;

/// Why a call could not do its work.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The input cannot be used: what is wrong with it, where, and how to mend it.
    #[error("{file}{what}{hint}",
        file = .file.as_ref().map(|f| format!("{}: ", f.display())).unwrap_or_default(),
        hint = .hint.as_ref().map(|h| format!(" ({h})")).unwrap_or_default())]
    Input {
        /// The file, when the shape came from one.
        file: Option<PathBuf>,
        /// What is wrong, with its place (line, byte, vertex or face number).
        what: String,
        /// How to mend it.
        hint: Option<String>,
    },
    /// A parameter lies outside its range or excludes another one.
    #[error("parameter {name}: {what}")]
    Params {
        /// Dotted name, as in `--set`.
        name: String,
        /// What is wrong with the value.
        what: String,
    },
    /// The request is well-formed but this program cannot do it.
    #[error("{0}")]
    Unsupported(String),
    /// A solve failed: singular, or without convergence.
    #[error("numerical failure in {stage}, step {step}: {what}")]
    Numerical {
        /// The stage's name, as in the report.
        stage: &'static str,
        /// Step within the stage, from 0.
        step: usize,
        /// What failed.
        what: String,
    },
    /// Reading or writing failed in the operating system.
    #[error("{path}: {source}", path = .path.display())]
    Io {
        /// The path that could not be read or written.
        path: PathBuf,
        /// The system's own error.
        source: std::io::Error,
    },
    /// The caller asked to stop through [`crate::CancelToken`].
    #[error("cancelled")]
    Cancelled,
}

impl Error {
    /// An [`Error::Input`] with a hint and no file yet; readers add the file with [`Error::in_file`].
    pub fn input(what: impl Into<String>, hint: impl Into<String>) -> Self {
        Self::Input {
            file: None,
            what: what.into(),
            hint: Some(hint.into()),
        }
    }

    /// An [`Error::Params`].
    pub fn params(name: impl Into<String>, what: impl Into<String>) -> Self {
        Self::Params {
            name: name.into(),
            what: what.into(),
        }
    }

    /// An [`Error::Io`] at `path`.
    pub fn io(path: impl Into<PathBuf>, source: std::io::Error) -> Self {
        Self::Io {
            path: path.into(),
            source,
        }
    }

    /// The same error with the file's name, where it is an input or system error without one.
    pub fn in_file(self, path: impl Into<PathBuf>) -> Self {
        match self {
            Self::Input {
                file: None,
                what,
                hint,
            } => Self::Input {
                file: Some(path.into()),
                what,
                hint,
            },
            Self::Io { path: none, source } if none.as_os_str().is_empty() => {
                Self::io(path, source)
            }
            other => other,
        }
    }
}

/// Something the user should know that does not stop the work.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Warning(pub String);
