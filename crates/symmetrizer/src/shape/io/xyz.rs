use crate::error::{Error, Result};
use crate::shape::document::Document;
use std::io::Write;
pub(super) fn decode(_: &[u8]) -> Result<Document> {
    Err(Error::Unsupported("not yet".into()))
}
pub(super) fn encode(_: &Document, _: &mut dyn Write) -> Result<()> {
    Err(Error::Unsupported("not yet".into()))
}
pub(super) fn losses(_: &Document) -> Vec<String> {
    Vec::new()
}
