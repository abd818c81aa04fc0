//! Items of a declaration: dispatch on their keyword, and what several of them share.

mod check;
mod contact;
mod draw;
mod force;
mod output;
mod parameter;
mod quantity;
mod start;

pub(super) use parameter::{Parameters, attributes};

use super::cursor::Cursor;
use super::expression::{index, whole};
use super::leftover::leftover;
use super::words::{FILE_KEYWORDS, KEYWORDS, SINGLE_QUOTES, is_keyword};
use crate::ast::{Attitude, Emit, Head, Impacts, Item, ItemKind, Name, Reference};
use crate::diagnostics::{Code, Diagnostics, Extent, nearest};
use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// What has been read so far.
#[derive(Default)]
pub(super) struct Items {
    pub items: Vec<Item>,
    pub core: Option<TokenStream>,
    /// What only a file has; `None` of a struct.
    pub parameters: Option<Parameters>,
}

/// The items of a part: one, or several where commas are missing.
pub(super) fn items(part: &mut Cursor, read: &mut Items, sink: &mut Diagnostics) {
    loop {
        item(part, read, sink);
        match part.word() {
            None => break,
            Some(word) if is_keyword(&word.text) => {
                sink.report(Code::MissingComma, &word, &[&word.text])
            }
            Some(_) => break,
        }
    }
    let _ = leftover(part, sink);
}

fn item(part: &mut Cursor, read: &mut Items, sink: &mut Diagnostics) -> Option<()> {
    if let Some(hash) = part.take("#") {
        sink.report(Code::Operator, hash, &[&"#", &"a remark begins with `//`"]);
        part.skip_all();
        return None;
    }
    let Some(keyword) = part.name("an item", sink) else {
        part.skip_all();
        return None;
    };
    let word = keyword.text.as_str();
    if let Some(parameters) = &mut read.parameters
        && FILE_KEYWORDS.contains(&word)
    {
        return parameters.read(&keyword, part, sink);
    }
    if !KEYWORDS.contains(&word) {
        let hint = instead(
            word,
            part.operator() == Some("="),
            read.parameters.is_some(),
        );
        sink.report(Code::UnknownItem, &keyword, &[&word, &hint]);
        part.skip_all();
        return None;
    }
    let kind = match (word, part.operator(), part.group(Delimiter::Parenthesis)) {
        ("crate", Some("="), _) => {
            part.next();
            read.core = path(part, sink);
            return None;
        }
        ("impacts", Some("="), _) => {
            part.next();
            ItemKind::Impacts(impacts(part, sink)?)
        }
        ("emit", Some("="), _) => {
            part.next();
            ItemKind::Emit(emit(part, sink)?)
        }
        ("kinetic" | "potential" | "lagrangian", Some("="), _) => {
            part.next();
            let value = super::expression::expression(part, sink).or_else(|| {
                part.skip_all();
                None
            })?;
            quantity::unnamed_energy(word, value)
        }
        ("lagrangian" | "crate" | "impacts" | "emit", ..) => {
            part.expected("`=`", sink);
            part.skip_all();
            return None;
        }
        (_, _, Some(group)) => {
            part.next();
            let inside = part.inside(&group, sink)?;
            let extent = Extent::new(&keyword, group.span_close());
            grouped(&keyword, extent, inside, sink)?
        }
        _ => {
            let what = match word {
                "kinetic" | "potential" => "`=` or `(`".to_owned(),
                _ => format!("`(` and in it {}", example(word)),
            };
            part.expected(&what, sink);
            part.skip_all();
            return None;
        }
    };
    read.items.push(Item {
        keyword: keyword.span(),
        kind,
    });
    Some(())
}

/// What to write where a word begins an item that is none; `equals`: an equals sign follows it.
fn instead(word: &str, equals: bool, in_file: bool) -> String {
    let own: &[&str] = if in_file { &FILE_KEYWORDS } else { &[] };
    let known: Vec<&str> = own.iter().chain(KEYWORDS).copied().collect();
    let others = |words: &[&str]| words.contains(&word);
    match nearest(word, known.iter().copied()) {
        Some(known) => format!("did you mean `{known}`?"),
        None if !in_file && word == "until" => {
            "the time at which a run ends is told to the run: `simulation.run(start, 0.0..10.0)`"
                .to_owned()
        }
        None if !in_file && word == "parameters" => {
            "the fields of the struct are the parameters: `struct Pendulum { mass: f64 }`"
                .to_owned()
        }
        None if equals && in_file => format!(
            "a number that can be set stands in `parameters({word} = …)`, a name for an expression in `define({word} = …)`"
        ),
        None if equals => format!("a name for an expression stands in `define({word} = …)`"),
        None if others(&["spring", "gravity", "weight"]) => {
            format!("it is a potential energy: `potential({word}: …)`")
        }
        None if others(&["damper", "damping", "drag"]) => {
            format!("it is a dissipation: `dissipation({word}: c/2 * der(x)^2)`")
        }
        None if others(&["conserved"]) => {
            "it stands in a check: `check(conserved energy)`".to_owned()
        }
        None => {
            let items: Vec<&str> = known.into_iter().filter(|item| *item != "crate").collect();
            format!("items are {}", items.join(", "))
        }
    }
}

/// What stands in the parentheses of an item.
fn example(keyword: &str) -> &'static str {
    match keyword {
        "coordinates" => "coordinates, as in `coordinates(x, y)`",
        "define" => "definitions, as in `define(px = r*sin(theta))`",
        "kinetic" | "potential" | "dissipation" => "a name and an expression: `name: …`",
        "constraint" => "a name and an equation: `rod: x^2 + y^2 == l^2`",
        "contact" => "a name and a comparison: `floor: y >= 0`",
        "friction" => "a friction: `grip on floor: slip = der(x), static = mu`",
        "force" => "a force: `drive: x = 1`",
        "start" => "a start: `rest: x = 1`",
        "observe" => "an output: `height = y`",
        "stop" | "mark" => "a condition: `ground: y <= 0`",
        "draw" => "a form and where it is: `mass: (x, y)`",
        "check" => "an equation, as in `check(floor == m*g when closed(floor))`",
        _ => "a body and its coordinates: `body: q`",
    }
}

/// An item with parentheses.
fn grouped(
    keyword: &Name,
    extent: Extent,
    inside: Cursor,
    sink: &mut Diagnostics,
) -> Option<ItemKind> {
    let example = example(&keyword.text);
    if inside.is_at_end() {
        sink.report(Code::EmptyPart, extent, &[&example]);
        return None;
    }
    let mut parts = inside.parts(example, sink);
    match keyword.text.as_str() {
        "coordinates" => quantity::coordinates(parts, sink),
        "define" => quantity::define(parts, sink),
        "kinetic" | "potential" | "dissipation" => {
            quantity::named_energy(&keyword.text, parts, sink)
        }
        "constraint" => contact::constraint(parts, sink),
        "contact" => contact::contact(parts, sink),
        "friction" => contact::friction(keyword, parts, sink),
        "force" => force::force(parts, sink),
        "start" => start::start(parts, sink),
        "observe" => output::observe(parts, sink),
        "check" => check::check(parts, sink),
        "draw" => draw::draw(parts, sink),
        "stop" | "mark" => output::watch(&keyword.text, parts, sink),
        _ => attitude(parts.first_mut()?, sink),
    }
}

/// `body: q`
fn attitude(part: &mut Cursor, sink: &mut Diagnostics) -> Option<ItemKind> {
    let body = part.name("the name of a body", sink)?;
    if part.take(":").is_none() {
        // Whoever writes `q` alone has named the coordinates.
        let name = match body.text.as_str() {
            "q" => "body",
            name => name,
        };
        let what = format!("`:` and a name for its four coordinates, `{name}: q`");
        part.expected(&what, sink);
        return None;
    }
    let coordinates = part.name("the name of its coordinates", sink)?;
    leftover(part, sink)?;
    Some(ItemKind::Attitude(Attitude { body, coordinates }))
}

/// `together` or `in_turn`
fn impacts(part: &mut Cursor, sink: &mut Diagnostics) -> Option<Impacts> {
    let words = [
        ("together", Impacts::Together),
        ("in_turn", Impacts::InTurn),
    ];
    one_of(&words, "`together` or `in_turn`", part, sink)
}

/// `unrolled`, `loops` or `data`
fn emit(part: &mut Cursor, sink: &mut Diagnostics) -> Option<Emit> {
    let words = [
        ("unrolled", Emit::Unrolled),
        ("loops", Emit::Loops),
        ("data", Emit::Data),
    ];
    one_of(&words, "`unrolled`, `loops` or `data`", part, sink)
}

/// What one of some words stands for.
fn one_of<T: Copy>(
    words: &[(&str, T)],
    expected: &str,
    part: &mut Cursor,
    sink: &mut Diagnostics,
) -> Option<T> {
    let word = part.word();
    let found = word.and_then(|word| words.iter().find(|(text, _)| *text == word.text));
    let Some((_, meaning)) = found else {
        part.expected(expected, sink);
        part.skip_all();
        return None;
    };
    part.next();
    Some(*meaning)
}

/// The path of `crate = path`.
fn path(part: &mut Cursor, sink: &mut Diagnostics) -> Option<TokenStream> {
    let at = part.here();
    let path = part.rest();
    match syn::parse2::<syn::Path>(path.clone()) {
        Ok(_) => Some(path),
        Err(_) => {
            sink.report(Code::Expected, at, &[&"a path", &format!("`{path}`")]);
            None
        }
    }
}

/// `name` or `name[k in a..b]`
fn head(part: &mut Cursor, what: &str, sink: &mut Diagnostics) -> Option<Head> {
    let name = part.name(what, sink)?;
    let index = match part.take_group(Delimiter::Bracket) {
        None => None,
        Some(group) => {
            let mut inside = part.inside(&group, sink)?;
            let found = index(&mut inside, sink)?;
            leftover(&mut inside, sink)?;
            Some(found)
        }
    };
    Some(Head { name, index })
}

/// `name:` or `name[k in a..b]:`
fn head_and_colon(
    part: &mut Cursor,
    item: &str,
    what: &str,
    sink: &mut Diagnostics,
) -> Option<Head> {
    named(part, item, sink)?;
    let head = head(part, what, sink)?;
    part.require(":", sink)?;
    Some(head)
}

/// Whether the part begins with a name and a colon somewhere after it.
fn named(part: &Cursor, item: &str, sink: &mut Diagnostics) -> Option<()> {
    if part.word().is_none() || part.has_operator(&[":"]) {
        return Some(());
    }
    unnamed(part.here(), item, sink);
    None
}

/// Reports an item that begins with something else than its name.
fn unnamed(at: impl Into<Extent>, item: &str, sink: &mut Diagnostics) {
    let hint = format!("write `{item}(name: …)`");
    sink.report(Code::NoName, at, &[&item, &hint]);
}

/// `name` or `name[e]`
fn reference(part: &mut Cursor, what: &str, sink: &mut Diagnostics) -> Option<Reference> {
    let name = part.name(what, sink)?;
    let element = match part.take_group(Delimiter::Bracket) {
        None => None,
        Some(group) => Some(whole(&mut part.inside(&group, sink)?, sink)?),
    };
    Some(Reference { name, element })
}

/// What the language calls a word, by a table of its words with what others say.
fn meant<'w>(table: &[(&'w str, &[&str])], word: &str) -> Option<&'w str> {
    let mut rows = table.iter();
    let (known, _) = rows.find(|(_, others)| others.contains(&word))?;
    Some(known)
}

/// Letters and words for a part that textbooks call otherwise.
const OTHERWISE: [(&str, &[&str]); 5] = [
    ("static", &["mu", "mu_s", "mu_static", "coefficient"]),
    ("kinetic", &["mu_k", "mu_kinetic", "dynamic"]),
    ("restitution", &["e", "bounce"]),
    ("radius", &["r"]),
    ("angle", &["phi", "theta", "rotation"]),
];

/// `key =`, one of `keys` of the item or field `of`.
pub(super) fn key(
    part: &mut Cursor,
    of: &str,
    keys: &[&str],
    sink: &mut Diagnostics,
) -> Option<Name> {
    let key = part.name("a part `name = …`", sink)?;
    if !keys.contains(&key.text.as_str()) {
        let meant = meant(&OTHERWISE, &key.text).filter(|known| keys.contains(known));
        let hint = match meant.or_else(|| nearest(&key.text, keys.iter().copied())) {
            _ if key.text == "poisson" => "write `restitution = poisson(e)`".to_string(),
            _ if key.text == "at" => {
                "it stands right behind what it belongs to, without a comma: `y >= 0 at (x, y)`"
                    .to_string()
            }
            Some(known) => format!("did you mean `{known}`?"),
            None => format!("its parts are {}", keys.join(", ")),
        };
        sink.report(Code::UnknownPart, &key, &[&key.text, &of, &hint]);
        return None;
    }
    part.require("=", sink)?;
    Some(key)
}

/// A string; `what` is said to be expected where there is none.
pub(super) fn text(part: &mut Cursor, what: &str, sink: &mut Diagnostics) -> Option<String> {
    if let Some(TokenTree::Literal(literal)) = part.peek()
        && let Ok(text) = syn::parse_str::<syn::LitStr>(&literal.to_string())
    {
        part.next();
        return Some(text.value());
    }
    match part.peek() {
        Some(TokenTree::Literal(literal)) if literal.to_string().starts_with('\'') => {
            sink.report(Code::Unreadable, part.here(), &[&SINGLE_QUOTES]);
        }
        _ => part.expected(what, sink),
    }
    None
}

/// Puts a value into its slot; a second one is reported.
fn once<V>(slot: &mut Option<V>, value: V, key: &Name, sink: &mut Diagnostics) {
    if slot.is_some() {
        sink.report(Code::RepeatedPart, key, &[&key.text, &"keep one"]);
    }
    *slot = Some(value);
}

/// Reports parts that an item does not have.
fn no_more(parts: &mut [Cursor], item: &str, hint: &str, sink: &mut Diagnostics) -> Option<()> {
    let Some(extra) = parts.first_mut() else {
        return Some(());
    };
    sink.report(
        Code::UnknownPart,
        extra.here(),
        &[&extra.rest(), &item, &hint],
    );
    None
}
