//! All that is printed: answers on standard output, the course of the work on standard error.

use std::io::Write;

/// Prints a part of the answer. A reader who has gone away is no reason to fail.
pub fn answer(text: &str) {
    let _ = writeln!(std::io::stdout().lock(), "{text}");
}

/// Prints a line about the course of the work.
pub fn note(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}
