//! The floors of ARCHITECTURE.md: a module uses what is below it, never what is above or beside it.
//!
//! Every path into another module of the crate is read from the sources: `crate::...` with its
//! braces, in `use` and anywhere else, and `super::` where it climbs to the crate's root.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// A module of the crate's root and where it stands.
struct Floor {
    module: &'static str,
    /// Everything on a lower floor may be used.
    floor: u32,
    /// Where set, nothing but these: a module, or a path inside one.
    only: Option<&'static [&'static str]>,
}

const fn floor(floor: u32, module: &'static str) -> Floor {
    Floor {
        module,
        floor,
        only: None,
    }
}

/// The house, floor by floor. Tens are the floors of ARCHITECTURE.md, units the order within one.
const HOUSE: &[Floor] = &[
    floor(0, "error"),
    floor(1, "context"),
    floor(1, "geom"),
    floor(2, "raster"),
    floor(10, "shape"),
    Floor {
        module: "drawing",
        floor: 15,
        only: Some(&["error", "context", "geom", "raster", "shape"]),
    },
    floor(20, "sample"),
    floor(20, "transform"),
    Floor {
        module: "deform",
        floor: 20,
        only: Some(&["error", "context", "geom", "shape"]),
    },
    floor(30, "pair"),
    Floor {
        module: "slip",
        floor: 30,
        only: Some(&["geom", "sample", "transform"]),
    },
    floor(40, "cluster"),
    floor(50, "patch"),
    Floor {
        module: "group",
        floor: 52,
        only: Some(&["geom", "transform"]),
    },
    floor(55, "detect"),
    floor(57, "field"),
    floor(60, "optimize"),
    floor(60, "straighten"),
    floor(70, "apply"),
    Floor {
        module: "picture",
        floor: 70,
        only: Some(&[
            "error",
            "context",
            "geom",
            "raster",
            "shape",
            "transform::isometry",
        ]),
    },
    floor(TOP, "params"),
    floor(TOP, "report"),
    floor(TOP, "job"),
];

/// The top floor is one household: its modules may use each other.
const TOP: u32 = 80;

/// A path from one module to an item of the crate, `["transform", "isometry", "Plane"]`.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Arrow {
    line: usize,
    path: Vec<String>,
}

fn find(module: &str) -> Option<&'static Floor> {
    HOUSE.iter().find(|f| f.module == module)
}

/// Why the module `from` must not use `path`, if it must not.
fn objection(from: &str, path: &[String]) -> Option<String> {
    let to = path.first()?.as_str();
    if from == to {
        return None;
    }
    let Some(here) = find(from) else {
        return Some(format!("{from} has no floor in tests/floors.rs"));
    };
    let Some(there) = find(to) else {
        return Some(format!("{to} has no floor in tests/floors.rs"));
    };
    if there.floor > here.floor || (there.floor == here.floor && here.floor < TOP) {
        return Some(format!(
            "{from} (floor {}) must not use {to} (floor {})",
            here.floor, there.floor
        ));
    }
    let allowed = here.only?;
    let full = path.join("::") + "::";
    let fits = |a: &&str| full.starts_with(&format!("{a}::"));
    (!allowed.iter().any(fits)).then(|| format!("{from} may use {} only", allowed.join(", ")))
}

/// The source with comments, strings and character literals blanked, line breaks kept.
fn code_only(source: &str) -> String {
    let mut out = String::with_capacity(source.len());
    let mut rest = source;
    while let Some(first) = rest.chars().next() {
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if first == '"' {
            string_end(rest)
        } else if first == '\'' {
            character_end(rest)
        } else {
            out.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        };
        out.extend(rest[..skipped].chars().filter(|c| *c == '\n'));
        out.push(' ');
        rest = &rest[skipped..];
    }
    out
}

/// Length of the string literal that `text` begins with.
fn string_end(text: &str) -> usize {
    let mut escaped = false;
    for (i, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return i + 1,
            _ => {}
        }
    }
    text.len()
}

/// Length of the character literal that `text` begins with; 1 for the quote of a lifetime.
fn character_end(text: &str) -> usize {
    let mut inner = text[1..].chars();
    match (inner.next(), inner.next()) {
        (Some('\\'), _) => text[3..].find('\'').map_or(1, |end| end + 4),
        (Some(c), Some('\'')) => 2 + c.len_utf8(),
        _ => 1,
    }
}

/// Identifiers, `::` and single signs, each with its line from 1.
fn tokens(source: &str) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut line = 1;
    let mut glue = false;
    let mut colon = false;
    for c in code_only(source).chars() {
        let is_word = c.is_alphanumeric() || c == '_';
        match found.last_mut() {
            Some((_, word)) if is_word && glue => word.push(c),
            Some((_, sign)) if c == ':' && colon && sign == ":" => sign.push(c),
            _ if c.is_whitespace() => {}
            _ => found.push((line, c.to_string())),
        }
        colon = c == ':' && !colon;
        glue = is_word;
        line += usize::from(c == '\n');
    }
    found
}

/// All paths into the crate's root in the source of the module `at` (`["shape", "io"]`).
fn arrows(at: &[String], source: &str) -> Vec<Arrow> {
    let tokens = tokens(source);
    let word = |i: usize| tokens.get(i).map(|t| t.1.as_str());
    let mut found = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        let begins = i == 0 || word(i - 1) != Some("::");
        if begins && word(i) == Some("crate") && word(i + 1) == Some("::") {
            tree(&tokens, i + 2, &[], &mut found);
        } else if begins && word(i) == Some("super") {
            let mut climbed = 0;
            while word(i + 2 * climbed) == Some("super") && word(i + 2 * climbed + 1) == Some("::")
            {
                climbed += 1;
            }
            // Inside `mod tests { }` one climb ends in the file's own module: such paths begin with
            // its own names, not with modules of the root, and are told apart by that.
            let mut climbing = Vec::new();
            if climbed >= at.len() {
                tree(&tokens, i + 2 * climbed, &[], &mut climbing);
            }
            found.extend(climbing.into_iter().filter(|a| find(&a.path[0]).is_some()));
            i += (2 * climbed).saturating_sub(1);
        }
        i += 1;
    }
    found
}

/// Reads the path or the braces of paths at token `i`, below `prefix`; returns the token after it.
fn tree(
    tokens: &[(usize, String)],
    mut i: usize,
    prefix: &[String],
    found: &mut Vec<Arrow>,
) -> usize {
    let mut path = prefix.to_vec();
    let line = tokens.get(i).map_or(0, |t| t.0);
    while let Some((_, token)) = tokens.get(i) {
        match token.as_str() {
            "{" => {
                i += 1;
                while tokens.get(i).is_some_and(|t| t.1 != "}") {
                    let next = tree(tokens, i, &path, found).max(i + 1);
                    i = skip_alias(tokens, next);
                    i += usize::from(tokens.get(i).is_some_and(|t| t.1 == ","));
                }
                return i + 1;
            }
            "*" => {
                i += 1;
                break;
            }
            name if name.starts_with(|c: char| c.is_alphabetic() || c == '_') => {
                path.push(name.to_string());
                i += 1;
                if tokens.get(i).is_none_or(|t| t.1 != "::") {
                    break;
                }
                i += 1;
            }
            _ => break,
        }
    }
    if !path.is_empty() {
        found.push(Arrow { line, path });
    }
    i
}

/// Steps over `as name`.
fn skip_alias(tokens: &[(usize, String)], i: usize) -> usize {
    if tokens.get(i).is_some_and(|t| t.1 == "as") {
        i + 2
    } else {
        i
    }
}

/// Arrows that begin with an item which the root re-exports, led to the module it comes from.
fn resolved(arrow: Arrow, reexports: &[Arrow]) -> Arrow {
    if find(&arrow.path[0]).is_some() {
        return arrow;
    }
    let origin = reexports
        .iter()
        .find(|r| r.path.last() == arrow.path.first());
    Arrow {
        path: origin.map_or(arrow.path, |o| o.path.clone()),
        ..arrow
    }
}

/// `pub use context::{Context, ...}` of the root, as arrows from nowhere.
fn root_reexports(lib: &str) -> Vec<Arrow> {
    let tokens = tokens(lib);
    let mut found = Vec::new();
    for (i, (_, token)) in tokens.iter().enumerate() {
        if token == "use" && tokens.get(i + 1).is_some_and(|t| t.1 != "crate") {
            tree(&tokens, i + 1, &[], &mut found);
        }
    }
    found
}

/// What is wrong with the arrows of one file, a line each.
fn objections(at: &[String], file: &str, source: &str, reexports: &[Arrow]) -> String {
    let mut report = String::new();
    for arrow in arrows(at, source) {
        let arrow = resolved(arrow, reexports);
        if let Some(why) = objection(&at[0], &arrow.path) {
            let path = arrow.path.join("::");
            writeln!(report, "{file}:{}: crate::{path}: {why}", arrow.line).unwrap();
        }
    }
    report
}

fn source_root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// Every source file below `folder`, in order.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut entries: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("the sources")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found
}

/// The module path of a file: `shape/io/ply.rs` and `shape/io/mod.rs` -> shape, io[, ply].
fn module_of(file: &Path) -> Vec<String> {
    let mut path: Vec<String> = file
        .with_extension("")
        .iter()
        .map(|part| part.to_string_lossy().into_owned())
        .collect();
    path.pop_if(|last| last == "mod");
    path
}

#[test]
fn no_arrow_points_upwards() {
    let root = source_root();
    let lib = std::fs::read_to_string(root.join("lib.rs")).unwrap();
    let reexports = root_reexports(&lib);
    let mut report = String::new();
    let mut seen = 0;
    for file in sources(&root) {
        let relative = file.strip_prefix(&root).unwrap();
        if relative == Path::new("lib.rs") {
            continue;
        }
        let source = std::fs::read_to_string(&file).unwrap();
        let at = module_of(relative);
        seen += arrows(&at, &source).len();
        let name = format!("src/{}", relative.display());
        report += &objections(&at, &name, &source, &reexports);
    }
    assert!(report.is_empty(), "\n{report}");
    // A checker that reads nothing would find nothing.
    assert!(seen > 200, "only {seen} arrows read");
}

#[test]
fn every_module_has_a_floor() {
    let root = source_root();
    let lib = std::fs::read_to_string(root.join("lib.rs")).unwrap();
    let words = tokens(&lib);
    let modules: Vec<&str> = words
        .windows(2)
        .filter(|w| w[0].1 == "mod")
        .map(|w| w[1].1.as_str())
        .collect();
    assert!(modules.len() > 10, "{modules:?}");
    for module in modules {
        assert!(find(module).is_some(), "{module} has no floor");
    }
}

fn check(module: &str, source: &str) -> String {
    let reexports = root_reexports("pub use context::{Context, Event};\npub use job::symmetrize;");
    let at: Vec<String> = module.split("::").map(str::to_string).collect();
    objections(&at, "fake.rs", source, &reexports)
}

#[test]
fn upward_and_sideways_arrows_are_named_with_their_line() {
    let report = check(
        "shape",
        "//! Text.\nuse crate::geom::Point;\nuse crate::transform::Isometry;\n",
    );
    assert_eq!(
        report,
        "fake.rs:3: crate::transform::Isometry: shape (floor 10) must not use transform (floor 20)\n"
    );
    assert!(check("sample", "use crate::transform::Plane;").contains("fake.rs:1:"));
    assert!(check("deform", "use crate::pair::Pair;").contains("fake.rs:1:"));
    assert!(check("transform", "fn f() -> crate::patch::Symmetry {}").contains("fake.rs:1:"));
    assert!(check("optimize", "use crate::params::Params;").contains("fake.rs:1:"));
    assert_eq!(check("job", "use crate::report::Report;"), "");
    assert!(check("nowhere", "use crate::geom::Point;").contains("nowhere has no floor"));
}

#[test]
fn braces_aliases_and_climbing_paths_are_read() {
    let nested =
        "use crate::{\n    geom::{Point as P, Vector},\n    optimize::{self, glide::glide},\n};";
    let report = check("cluster", nested);
    assert_eq!(report.lines().count(), 2, "{report}");
    assert!(
        report.starts_with("fake.rs:3: crate::optimize::self"),
        "{report}"
    );
    assert!(report.contains("fake.rs:3: crate::optimize::glide::glide"));
    assert!(check("shape::io", "use super::super::detect::detect;").contains("fake.rs:1:"));
    assert_eq!(check("shape::io", "use super::detect;"), "");
    assert_eq!(check("detect", "mod tests { use super::detect; }"), "");
}

#[test]
fn items_of_the_root_count_as_their_module() {
    assert_eq!(check("deform", "use crate::Context;"), "");
    assert!(check("patch", "use crate::symmetrize;").contains("must not use job"));
}

#[test]
fn narrow_modules_see_their_list_only() {
    assert_eq!(
        check("picture", "use crate::transform::isometry::Plane;"),
        ""
    );
    assert!(check("picture", "use crate::transform::Plane;").contains("may use"));
    assert!(check("picture", "use crate::sample::Samples;").contains("may use"));
    assert_eq!(check("deform", "use crate::shape::Surface;"), "");
}

#[test]
fn comments_strings_and_lifetimes_are_no_arrows() {
    let source = "/// [`crate::job::run`]\n/* crate::job */ const A: &str = \"crate::job\";\n\
                  fn f<'a>(c: char) -> bool { c == '\"' || c == '\\'' }\nuse crate::job::X;";
    let report = check("geom", source);
    assert_eq!(report.lines().count(), 1, "{report}");
    assert!(report.starts_with("fake.rs:4:"), "{report}");
}
