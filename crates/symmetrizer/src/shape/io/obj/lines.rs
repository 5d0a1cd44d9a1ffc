//! The logical lines of an OBJ file.

use std::borrow::Cow;

/// Logical lines with the number of their first physical line; a backslash at the end of a line
/// continues it.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    next: usize,
}

impl<'a> Lines<'a> {
    pub fn new(text: &'a [u8]) -> Self {
        Self {
            rest: text,
            next: 1,
        }
    }

    fn physical(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let (line, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        let ended = rest.strip_prefix(b"\r\n").or_else(|| rest.get(1..));
        self.rest = ended.unwrap_or(&[]);
        self.next += 1;
        Some(line)
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let number = self.next;
        let mut line = Cow::Borrowed(self.physical()?);
        while line.last() == Some(&b'\\') {
            let joined = line.to_mut();
            joined.pop();
            joined.push(b' ');
            match self.physical() {
                Some(more) => joined.extend_from_slice(more),
                None => break,
            }
        }
        Some((number, line))
    }
}
