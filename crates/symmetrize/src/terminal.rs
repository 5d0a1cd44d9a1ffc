//! All that the command prints: answers on standard output, errors on standard error.

use std::io::Write;

use symmetrizer::Error;

/// Prints an answer. A reader who has gone away is no reason to fail.
pub fn answer(text: &str) {
    let _ = std::io::stdout().lock().write_all(text.as_bytes());
}

/// Prints a line about the course of the work.
pub fn note(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Prints an error on one line.
pub fn error(error: &Error) {
    let line = error.to_string().replace('\n', " ");
    let _ = writeln!(std::io::stderr().lock(), "error: {line}");
}
