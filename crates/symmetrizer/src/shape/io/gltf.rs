use crate::error::{Error, Result};
use crate::shape::document::Document;
use std::io::Write;
pub(super) fn decode(_: Vec<u8>, _: Option<&std::path::Path>) -> Result<Document> {
    Err(Error::Unsupported("not yet".into()))
}
pub(super) fn encode_text(_: &Document, _: &mut dyn Write) -> Result<()> {
    Err(Error::Unsupported("not yet".into()))
}
pub(super) fn losses(_: &Document) -> Vec<String> {
    Vec::new()
}
pub(super) fn encode_binary(_: &Document, _: &mut dyn Write) -> Result<()> {
    Err(Error::Unsupported("not yet".into()))
}
