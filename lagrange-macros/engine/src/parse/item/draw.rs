//! `draw(disc: (x, y), radius = r, angle = phi)`

use super::super::cursor::Cursor;
use super::super::expression::{expression, whole};
use super::super::leftover::leftover;
use super::{head_and_colon, key, meant, no_more};
use crate::ast::{Detail, Draw, Form, ItemKind};
use crate::diagnostics::{Code, Diagnostics, nearest};

/// Words for a form that nobody has to know is called otherwise.
const OTHERWISE: [(&str, &[&str]); 9] = [
    ("disc", &["circle", "wheel", "disk", "roller", "pulley"]),
    ("sphere", &["ball"]),
    ("mass", &["point", "dot", "bob", "particle"]),
    ("rod", &["line", "bar", "beam", "link", "stick"]),
    ("rope", &["string", "cable", "chain"]),
    ("box", &["block", "rectangle", "square", "cuboid"]),
    ("pivot", &["hinge", "joint", "pin"]),
    ("path", &["trace", "trail", "curve"]),
    ("arrow", &["vector", "force"]),
];

/// `form: p to q at r, detail = …`
pub(super) fn draw(mut parts: Vec<Cursor>, sink: &mut Diagnostics) -> Option<ItemKind> {
    let (first, others) = parts.split_first_mut()?;
    let head = head_and_colon(first, "draw", "a form, as in `mass: (x, y)`", sink)?;
    let word = head.name;
    let Some(&(text, form)) = Form::ALL.iter().find(|(text, _)| *text == word.text) else {
        let words = Form::ALL.iter().map(|(text, _)| *text);
        let meant = meant(&OTHERWISE, &word.text).or_else(|| nearest(&word.text, words.clone()));
        let hint = match meant {
            Some(known) => format!("did you mean `{known}`?"),
            None => format!("forms are {}", words.collect::<Vec<_>>().join(", ")),
        };
        sink.report(Code::UnknownForm, &word, &[&word.text, &hint]);
        return None;
    };
    let mut places = vec![expression(first, sink)?];
    while first.take_word("to").is_some() {
        places.push(expression(first, sink)?);
    }
    let mut at = None;
    if form == Form::Arrow && first.take_word("at").is_some() {
        at = Some(expression(first, sink)?);
    }
    leftover(first, sink)?;
    let told = form.details();
    let mut keys: Vec<&str> = told.iter().map(|detail| detail.word()).collect();
    if form == Form::Arrow {
        keys.push("name");
    }
    if keys.is_empty() {
        no_more(others, text, "it has places only, joined by `to`", sink)?;
    }
    let (mut name, mut details): (_, Vec<(Detail, _, _)>) = (None, Vec::new());
    for part in others {
        let key = key(part, text, &keys, sink)?;
        if key.text == "name" {
            super::once(&mut name, part.name("a name", sink)?, &key, sink);
            leftover(part, sink)?;
            continue;
        }
        let detail = Detail::ALL.iter().find(|(word, _)| *word == key.text)?.1;
        if details.iter().any(|(known, ..)| *known == detail) {
            sink.report(Code::RepeatedPart, &key, &[&key.text, &"keep one"]);
        }
        details.push((detail, key, whole(part, sink)?));
    }
    Some(ItemKind::Draw(Box::new(Draw {
        word,
        form,
        index: head.index,
        places,
        at,
        name,
        details,
    })))
}
