//! The text of an SVG file and its tree, within limits. Nothing outside the file is ever looked at.

use roxmltree::{Document, Node, ParsingOptions};

use crate::error::{Error, Result};

/// Bytes; the largest drawings of maps have some tens of millions.
const LARGEST: usize = 64 << 20;

/// Elements, texts and comments.
const NODES: u32 = 1_000_000;

/// Elements inside each other. Drawing programs stay below 50.
const DEEPEST: usize = 256;

/// Bytes that all uses of the file's own entities may add.
const EXPANDED: usize = 16 << 20;

pub(super) const NAMESPACE: &str = "http://www.w3.org/2000/svg";

const EXPORT: &str = "export the drawing again as plain SVG";

/// The text in the bytes of a file.
///
/// # Errors
/// [`Error::Input`] where it is too large, packed, not UTF-8, or expands its own entities beyond
/// measure.
pub(super) fn text(bytes: Vec<u8>) -> Result<String> {
    if bytes.len() > LARGEST {
        let what = format!("the drawing has {} MiB, more than 64", bytes.len() >> 20);
        return Err(Error::input(what, "simplify it first"));
    }
    if bytes.starts_with(&[0x1f, 0x8b]) {
        let what = "the file is packed (SVGZ)";
        return Err(Error::input(what, "unpack it with gunzip first"));
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        let what = "the text of the file is UTF-16";
        return Err(Error::input(what, "save it as UTF-8"));
    }
    let text = String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        Error::input(
            format!("byte {at} is not UTF-8"),
            "save the drawing as UTF-8",
        )
    })?;
    check_entities(&text)?;
    Ok(text)
}

/// Entities may stand for plain text only (Illustrator names its namespaces so). One that holds
/// others or elements could grow without bound, and could not be edited.
fn check_entities(text: &str) -> Result<()> {
    let mut longest = 0;
    for (start, _) in text.match_indices("<!ENTITY") {
        let declaration = &text[start..];
        let value = declaration.find(['"', '\'']).map_or("", |quote| {
            let rest = &declaration[quote..];
            rest[1..].split(&rest[..1]).next().unwrap_or("")
        });
        if value.contains(['&', '<', '%']) {
            let what = "an entity of its DOCTYPE contains elements or other entities";
            return Err(Error::input(what, EXPORT));
        }
        longest = longest.max(value.len());
    }
    let uses = text.bytes().filter(|&b| b == b'&').count();
    if longest * uses > EXPANDED && longest > 8 {
        let what = format!("{uses} references to entities of up to {longest} bytes");
        return Err(Error::input(what, EXPORT));
    }
    Ok(())
}

/// The tree of a text.
///
/// # Errors
/// [`Error::Input`] where it is no XML, no SVG, or too large or deep.
pub(super) fn tree(text: &str) -> Result<Document<'_>> {
    let options = ParsingOptions {
        allow_dtd: true,
        nodes_limit: NODES,
        ..ParsingOptions::default()
    };
    let tree = Document::parse_with_options(text, options);
    let tree = tree
        .map_err(|e| Error::input(format!("XML: {e}"), "the file is damaged; export it again"))?;
    check_depth(&tree)?;
    let root = tree.root_element();
    if !is_svg(root) || root.tag_name().name() != "svg" {
        let what = format!(
            "the file is XML, but its root is <{}>",
            root.tag_name().name()
        );
        return Err(Error::input(what, "an SVG drawing begins with <svg>"));
    }
    Ok(tree)
}

fn check_depth(tree: &Document<'_>) -> Result<()> {
    let mut depth = vec![0_usize; tree.descendants().count() + 1];
    for node in tree.descendants().filter(Node::is_element) {
        let above = node.parent().map_or(0, |p| depth[p.id().get_usize()]);
        depth[node.id().get_usize()] = above + 1;
        if above >= DEEPEST {
            let at = tree.text_pos_at(node.range().start);
            let what = format!("line {at}: elements are nested more than {DEEPEST} deep");
            return Err(Error::input(what, "ungroup the drawing"));
        }
    }
    Ok(())
}

/// Whether an element belongs to SVG. Hand-written files often name no namespace at all.
pub(super) fn is_svg(node: Node<'_, '_>) -> bool {
    matches!(node.tag_name().namespace(), Some(NAMESPACE) | None)
}

/// How an element is named in messages.
pub(super) fn shown(node: Node<'_, '_>) -> String {
    let line = node.document().text_pos_at(node.range().start).row;
    let name = node.tag_name().name();
    match node.attribute("id") {
        Some(id) => format!("<{name} id={id:?}> in line {line}"),
        None => format!("<{name}> in line {line}"),
    }
}
