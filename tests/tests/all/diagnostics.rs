//! Mistakes in declarations: every file of `compile-fail/` is a struct with mistakes, read in process, and ends with what must
//! be said about it, one `//~ line:column code message; hint` for each mistake.
//!
//! `UPDATE_EXPECT=1 cargo test -p lagrange-tests` writes down what is said now, and the page of mistakes in the documentation of
//! `lagrange-macros`.

use lagrange_engine::diagnostics::Diagnostics;
use proc_macro2::{TokenStream, TokenTree};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Marks what is expected.
const MARK: &str = "//~ ";

/// The page of mistakes: (heading, cases).
const PAGE: &[(&str, &[&str])] = &[
    (
        "Notation",
        &[
            "power-stars",
            "missing-operator",
            "function-power",
            "method-call",
            "rust-if",
            "number-suffix",
            "single-equals",
            "comparison-strict",
            "or",
            "missing-comma",
            "no-name",
            "inclusive-range",
        ],
    ),
    (
        "Names and values",
        &[
            "unknown-name",
            "unknown-item",
            "unknown-function",
            "friction-unknown-contact",
            "duplicate-item",
            "handle-clash",
            "index-outside",
            "list-as-potential",
            "list-equation",
            "reserved-name",
            "no-value",
            "generics-lifetime",
        ],
    ),
    (
        "Mechanics",
        &[
            "velocity-in-potential",
            "velocity-in-gap",
            "acceleration-in-force",
            "coordinate-in-start",
            "no-inertia",
            "singular-inertia",
            "constraint-not-linear",
            "while-on-position",
            "friction-slip-position",
            "friction-without-normal",
            "friction-grows",
            "restitution-range",
            "redundant",
            "redundant-sum",
            "contradiction",
            "redundant-while",
        ],
    ),
    (
        "Units",
        &[
            "unit-unknown",
            "unit-multiple",
            "unit-ambiguous",
            "units-added",
            "units-kinetic",
            "units-number",
            "units-der",
            "units-torque",
            "units-gap",
            "units-slip",
            "units-inferred",
        ],
    ),
    (
        "Pictures",
        &[
            "draw-unknown-form",
            "draw-without-radius",
            "draw-plane-and-space",
            "draw-arrow-place",
        ],
    ),
];

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("compile-fail");
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .expect("the folder of cases")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    files
}

fn mistakes(source: &str) -> Diagnostics {
    let tokens: TokenStream = source.parse().expect("tokens");
    match lagrange_engine::program(tokens) {
        Ok(_) => Diagnostics::new(),
        Err(mistakes) => mistakes,
    }
}

#[test]
fn every_mistake_is_told_at_its_token() {
    let mut failures = Vec::new();
    for file in cases() {
        let text = fs::read_to_string(&file).expect("readable");
        let source: String = text
            .lines()
            .filter(|line| !line.starts_with(MARK))
            .map(|line| format!("{line}\n"))
            .collect();
        let said: String = mistakes(&source)
            .iter()
            .map(|mistake| format!("{MARK}{mistake}\n"))
            .collect();
        let name = file.file_stem().expect("a name").to_string_lossy();
        if said.is_empty() {
            failures.push(format!("{name}: accepted"));
        } else if std::env::var_os("UPDATE_EXPECT").is_some() {
            fs::write(&file, source + &said).expect("writable");
        } else if text != source.clone() + &said {
            failures.push(format!("{name}: now says\n{said}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Every position is that of a token of the struct.
#[test]
fn positions_are_those_of_tokens() {
    fn starts(tokens: TokenStream, found: &mut BTreeSet<(usize, usize)>) {
        for token in tokens {
            let at = token.span().start();
            found.insert((at.line, at.column));
            if let TokenTree::Group(group) = token {
                let close = group.span_close().start();
                found.insert((close.line, close.column));
                starts(group.stream(), found);
            }
        }
    }
    for file in cases() {
        let source = fs::read_to_string(&file).expect("readable");
        let mut tokens = BTreeSet::new();
        starts(source.parse().expect("tokens"), &mut tokens);
        for mistake in mistakes(&source).iter() {
            let at = mistake.extent.start.start();
            assert!(
                tokens.contains(&(at.line, at.column)),
                "{}: {mistake}",
                file.display()
            );
        }
    }
}

/// What a mistake expands to is Rust: one `compile_error!` for each, and an implementation that keeps the rest of the
/// program quiet.
#[test]
fn mistakes_expand_to_rust() {
    for file in cases() {
        let source = fs::read_to_string(&file).expect("readable");
        let expected = mistakes(&source).iter().count();
        let expansion = lagrange_engine::expand(source.parse().expect("tokens"));
        let rust = syn::parse2::<syn::File>(expansion)
            .unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let errors = rust
            .items
            .iter()
            .filter(|item| matches!(item, syn::Item::Macro(m) if m.mac.path.segments.last().is_some_and(|s| s.ident == "compile_error")))
            .count();
        assert_eq!(errors, expected, "{}", file.display());
    }
}

/// A declaration with an item of every kind that becomes a constant.
const NAMES: &str = "#[lagrange(
    coordinates(r: \"m\", theta: \"rad\"),
    coordinates(z[3]),
    attitude(body: turned),
    define(x = r * sin(theta), y = r * cos(theta)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + sum(i in 0..3: mass/2 * der(z[i])^2),
    kinetic(spin: mass * radius^2/5 * dot(body.body_rate, body.body_rate)),
    potential(weight: mass * gravity * y),
    constraint(tied[i in 0..2]: z[i] == 2 * z[i + 1]),
    contact(ball: r >= radius, restitution = 0),
    friction(grip on ball: slip = der(theta) * r, static = 0.1),
    force(pull: z[0] = 1),
    dissipation(oil: der(r)^2),
    observe(height = y, x),
    start(nudged: r = radius, theta = 0.1),
    stop(ground: y <= -radius),
    mark(level: y),
)]
struct Ball { mass: f64, gravity: f64, radius: f64 }";

/// The constants of a struct with their types, arrays as those of their elements.
fn handles(source: &str) -> BTreeSet<(String, String)> {
    let expansion = lagrange_engine::expand(source.parse().expect("tokens"));
    let rust = syn::parse2::<syn::File>(expansion).expect("Rust");
    let own = rust.items.iter().filter_map(|item| match item {
        syn::Item::Impl(own) if own.trait_.is_none() => Some(&own.items),
        _ => None,
    });
    let constants = own.flatten().filter_map(|item| {
        let syn::ImplItem::Const(constant) = item else {
            return None;
        };
        let kind = match &constant.ty {
            syn::Type::Array(array) => &*array.elem,
            kind => kind,
        };
        let syn::Type::Path(kind) = kind else {
            return None;
        };
        let kind = kind.path.segments.last()?.ident.to_string();
        kind.ends_with("Id")
            .then(|| (constant.ident.to_string(), kind))
    });
    constants.collect()
}

/// One mistake, in the notation, the names or the units, leaves all constants of the struct, so that their uses are no further errors.
#[test]
fn names_are_known_beside_a_mistake() {
    let declared = handles(NAMES);
    assert_eq!(declared.len(), 17, "{declared:?}");
    for (right, wrong) in [
        ("r >= radius", "r = radius"),
        ("r >= radius", "r > radius"),
        ("y <= -radius", "y == -radius"),
        ("sin(theta)", "sine(theta)"),
        ("gravity * y", "gravty * y"),
        ("der(x)^2", "der(x)**2"),
        ("der(x)^2", "x.der()^2"),
        ("gravity * y),", "gravity * y)"),
        ("contact(ball", "contakt(ball"),
        ("frict", "frik"),
        ("\"rad\"", "\"radian\""),
        ("mass/2 * (", "mass/2 ("),
        ("theta: \"rad\"),", "theta: \"rad\");"),
        ("r: \"m\", theta", "r: \"m\" theta"),
        ("mass: f64", "mass: f32"),
        ("struct Ball {", "struct Ball<'a> {"),
        ("gravity * y", "gravity"),
        ("der(r)^2", "r^2"),
        ("z[0] = 1", "z[0] == 1"),
        ("height = y", "height: y"),
    ] {
        let source = NAMES.replacen(right, wrong, 1);
        assert_ne!(source, NAMES, "{wrong}");
        assert!(mistakes(&source).iter().count() > 0, "{wrong} is accepted");
        let missing: Vec<_> = declared.difference(&handles(&source)).cloned().collect();
        assert!(missing.is_empty(), "{wrong}: {missing:?}");
    }
}

/// The documentation of the macro shows wrong declarations with what is said about them: these cases.
#[test]
fn the_page_of_mistakes_shows_what_is_said() {
    let shown: usize = PAGE.iter().map(|(_, names)| names.len()).sum();
    assert!(shown >= 30, "{shown} cases");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("compile-fail");
    let mut page = String::from(
        "Wrong declarations, and what is said about each. A line below the code begins at the token that is wrong; the\n\
         compiler prints the same as an error there.\n",
    );
    for (heading, names) in PAGE {
        page.push_str(&format!("\n## {heading}\n"));
        for name in *names {
            let text = fs::read_to_string(folder.join(format!("{name}.rs"))).expect("a case");
            page.push_str(&entry(&text));
        }
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../lagrange-macros/src/mistakes.md");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        fs::write(&file, page).expect("writable");
    } else {
        assert_eq!(fs::read_to_string(&file).expect("the page"), page);
    }
}

/// A case with its mistakes below the lines they are in.
fn entry(text: &str) -> String {
    let (said, source): (Vec<&str>, Vec<&str>) =
        text.lines().partition(|line| line.starts_with(MARK));
    let title = source[0].trim_start_matches("// ");
    let mut entry = format!("\n### {}\n\n```text\n", title.trim_end_matches('.'));
    for (number, line) in source.iter().enumerate().skip(1) {
        entry.push_str(&format!("{line}\n"));
        for mistake in &said {
            let (place, rest) = mistake[MARK.len()..].split_once(' ').expect("a place");
            let (at, column) = place.split_once(':').expect("line:column");
            let column: usize = column.parse().expect("a column");
            if at.parse() == Ok(number + 1) {
                let (code, message) = rest.split_once(' ').expect("a code");
                entry.push_str(&format!("{}^ {message} [{code}]\n", " ".repeat(column - 1)));
            }
        }
    }
    entry + "```\n"
}
