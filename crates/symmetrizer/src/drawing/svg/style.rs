//! What of an element's style decides about its shape: whether it is filled, stroked, seen, by which
//! rule, and where its transform and clip path are.

use roxmltree::{Document, Node};
use simplecss::{AttributeOperator, DeclarationTokenizer, PseudoClass, StyleSheet};

use super::source::is_svg;
use crate::drawing::region::Rule;
use crate::error::{Error, Result};

/// How many pairs of a rule and a drawn element are looked at.
const LOOKS: usize = 50_000_000;

const NAMES: [&str; 13] = [
    "clip-path",
    "clip-rule",
    "display",
    "fill",
    "fill-opacity",
    "fill-rule",
    "mask",
    "opacity",
    "stroke",
    "stroke-opacity",
    "stroke-width",
    "transform",
    "visibility",
];

/// The style sheets of a document.
pub(super) struct Sheets<'a> {
    sheet: StyleSheet<'a>,
    looks: usize,
}

/// The properties that an element itself sets, without what it inherits.
pub(super) struct Own<'a>([Option<&'a str>; NAMES.len()]);

impl<'a> Sheets<'a> {
    /// The sheets inside a document.
    pub fn new(tree: &'a Document<'_>) -> Self {
        let mut sheet = StyleSheet::new();
        let styles =
            |n: &Node<'_, '_>| n.is_element() && is_svg(*n) && n.tag_name().name() == "style";
        for node in tree.descendants().filter(styles) {
            sheet.parse_more(node.text().unwrap_or(""));
        }
        Self { sheet, looks: 0 }
    }

    /// The properties of an element: attributes, above them rules, above them its `style`.
    ///
    /// # Errors
    /// [`Error::Input`] where there are so many rules and elements that matching takes too long.
    pub fn of(&mut self, node: Node<'a, '_>) -> Result<Own<'a>> {
        self.looks += self.sheet.rules.len();
        if self.looks > LOOKS {
            let what = format!(
                "{} style rules for too many elements",
                self.sheet.rules.len()
            );
            let hint = "export the drawing with presentation attributes";
            return Err(Error::input(what, hint));
        }
        let mut own = Own([None; NAMES.len()]);
        for attribute in node.attributes().filter(|a| a.namespace().is_none()) {
            own.set(attribute.name(), attribute.value());
        }
        let rules = self.sheet.rules.iter();
        for rule in rules.filter(|r| r.selector.matches(&Element(node))) {
            let declarations = rule.declarations.iter();
            declarations.for_each(|d| own.set(d.name, d.value));
        }
        let style = node.attribute("style").unwrap_or("");
        DeclarationTokenizer::from(style).for_each(|d| own.set(d.name, d.value));
        Ok(own)
    }
}

impl<'a> Own<'a> {
    fn set(&mut self, name: &str, value: &'a str) {
        if let Some(i) = NAMES.iter().position(|n| *n == name) {
            self.0[i] = Some(value.trim());
        }
    }

    /// The value of a property, unless it is inherited.
    pub fn get(&self, name: &str) -> Option<&'a str> {
        let i = NAMES.iter().position(|n| *n == name)?;
        self.0[i].filter(|v| *v != "inherit")
    }

    /// The id in the `url(#id)` of a property.
    pub fn link(&self, name: &str) -> Option<&'a str> {
        self.get(name).and_then(link)
    }
}

/// The id in `url(#id)`.
pub(super) fn link(value: &str) -> Option<&str> {
    let inside = value.trim().strip_prefix("url(")?.split(')').next()?;
    inside.trim().trim_matches(['"', '\'']).strip_prefix('#')
}

/// What children inherit.
#[derive(Clone, Copy)]
pub(super) struct Style<'a> {
    pub fill: &'a str,
    pub stroke: &'a str,
    fill_shows: bool,
    stroke_shows: bool,
    visible: bool,
    /// No ancestor is switched off or fully transparent.
    drawn: bool,
    pub fill_rule: Rule,
    pub clip_rule: Rule,
}

impl<'a> Style<'a> {
    /// What holds where nothing is said.
    pub fn initial() -> Self {
        Self {
            fill: "black",
            stroke: "none",
            fill_shows: true,
            stroke_shows: true,
            visible: true,
            drawn: true,
            fill_rule: Rule::NonZero,
            clip_rule: Rule::NonZero,
        }
    }

    /// The style of an element with these properties inside one of this style.
    pub fn with(mut self, own: &Own<'a>) -> Self {
        let rule = |name, inherited| match own.get(name) {
            Some("evenodd") => Rule::EvenOdd,
            Some(_) => Rule::NonZero,
            None => inherited,
        };
        let shows = |name, inherited| own.get(name).map_or(inherited, |v| !is_zero(v));
        self.fill_rule = rule("fill-rule", self.fill_rule);
        self.clip_rule = rule("clip-rule", self.clip_rule);
        self.fill = own.get("fill").unwrap_or(self.fill);
        self.stroke = own.get("stroke").unwrap_or(self.stroke);
        self.fill_shows = shows("fill-opacity", self.fill_shows);
        self.stroke_shows = shows("stroke-opacity", self.stroke_shows);
        if let Some(value) = own.get("visibility") {
            self.visible = value == "visible";
        }
        self.drawn &= own.get("display") != Some("none") && shows("opacity", true);
        self
    }

    pub fn is_filled(&self) -> bool {
        self.drawn && self.visible && self.fill_shows && paints(self.fill)
    }

    pub fn is_stroked(&self) -> bool {
        self.drawn && self.visible && self.stroke_shows && paints(self.stroke)
    }
}

fn paints(value: &str) -> bool {
    !matches!(value, "none" | "transparent")
}

fn is_zero(value: &str) -> bool {
    value.trim_end_matches('%').trim().parse() == Ok(0.0)
}

/// How the style library sees an element.
struct Element<'a, 'input>(Node<'a, 'input>);

impl simplecss::Element for Element<'_, '_> {
    fn parent_element(&self) -> Option<Self> {
        self.0.parent_element().map(Self)
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.0.prev_sibling_element().map(Self)
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.0.tag_name().name() == name
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        let value = self.0.attribute(name);
        value.is_some_and(|v| operator.matches(v))
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        matches!(class, PseudoClass::FirstChild) && self.prev_sibling_element().is_none()
    }
}
