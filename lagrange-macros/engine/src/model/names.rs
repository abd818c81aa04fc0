//! The one namespace of fields, coordinates, definitions and items.

use super::elaboration::Elaboration;
use super::meaning::{Entry, Kind, Meaning};
use crate::ast::{Name, Reference};
use crate::diagnostics::{Code, nearest};
use crate::parse::FUNCTIONS;
use unicode_ident::is_xid_continue;

/// Words with a meaning of their own in expressions, beside the functions.
const RESERVED: &[&str] = &[
    "t",
    "pi",
    "sum",
    "list",
    "if",
    "gap",
    "slip",
    "momentum",
    "energy",
    "closed",
    "open",
    "sticks",
    "slips",
    "poisson",
    "when",
    "conserved",
    "at",
    "along",
    "on",
    "where",
    "while",
    "and",
    "in",
];

impl Elaboration<'_> {
    /// Enters a name; a reserved word or second use of a name is reported. Where the word is then used as a name, nothing more is said.
    pub fn enter(&mut self, name: &Name, kind: Kind, meaning: Meaning) -> Option<()> {
        let text = name.text.as_str();
        if is_reserved(text) {
            self.sink.report(Code::ReservedName, name, &[&text]);
            let meaning = Meaning::Poisoned;
            self.names.insert(text.to_string(), Entry { kind, meaning });
            return None;
        }
        if let Some(first) = self.names.get(text) {
            self.sink
                .report(Code::DuplicateName, name, &[&text, &first.kind.text()]);
            return None;
        }
        self.names.insert(text.to_string(), Entry { kind, meaning });
        Some(())
    }

    /// What a name has come to mean.
    pub fn settle(&mut self, name: &str, meaning: Meaning) {
        if let Some(entry) = self.names.get_mut(name) {
            entry.meaning = meaning;
        }
    }

    /// Reports a name that nothing has, with the nearest one that exists.
    pub fn unknown(&mut self, name: &Name) {
        let text = name.text.as_str();
        // All names are looked through for it: not where nobody will read it.
        let hint = match self.sink.is_full() {
            true => String::new(),
            false => self.suggestion(text),
        };
        self.sink.report(Code::UnknownName, name, &[&text, &hint]);
    }

    /// Reports a name that should be that of an item of one of these kinds.
    pub fn unknown_of(&mut self, name: &Name, kinds: &[Kind]) {
        let text = name.text.as_str();
        let of_kind = self
            .names
            .iter()
            .filter(|(_, entry)| kinds.contains(&entry.kind));
        let near = match self.sink.is_full() {
            true => None,
            false => meant(text, of_kind.map(|(known, _)| known.as_str())),
        };
        // `vx` is near to `x`, and means something else.
        let velocity = match kinds.contains(&Kind::Coordinate) {
            true => self.velocity(text),
            false => None,
        };
        let meant = near.map(|known| format!("did you mean `{known}`?"));
        let hint = velocity.or(meant).unwrap_or_else(|| self.known(kinds));
        self.sink.report(Code::UnknownName, name, &[&text, &hint]);
    }

    /// What is said of a name that looks like the velocity of a coordinate.
    fn velocity(&self, text: &str) -> Option<String> {
        let dotted = DOTTED.iter().find(|(letter, _)| *letter == text);
        let bases = [
            text.strip_suffix("_dot"),
            text.strip_suffix("dot"),
            text.strip_prefix('d'),
            text.strip_prefix("v_"),
            text.strip_prefix('v'),
            text.strip_suffix('\u{307}'),
            dotted.map(|(_, base)| *base),
        ];
        let coordinates = || {
            let names = self.names.iter();
            let coordinates = names.filter(|(_, entry)| entry.kind == Kind::Coordinate);
            coordinates.map(|(name, _)| name.as_str())
        };
        let base = match (text, coordinates().count()) {
            ("v" | "velocity" | "speed", 1) => coordinates().next()?,
            ("v" | "velocity" | "speed", _) => {
                return Some("velocities are written `der(…)`".to_owned());
            }
            _ => bases
                .into_iter()
                .flatten()
                .find(|base| coordinates().any(|name| name == *base))?,
        };
        Some(format!("the velocity of `{base}` is written `der({base})`"))
    }

    fn suggestion(&self, text: &str) -> String {
        if text == "e" {
            return "powers of Euler's number are written `exp(…)`".to_string();
        }
        if text == "time" {
            return "time is written `t`".to_string();
        }
        let mut letters = text.chars();
        if let (Some(letter), None) = (letters.next(), letters.next())
            && let Some(word) = spelt(letter)
        {
            return format!("write `{word}`");
        }
        if let Some(velocity) = self.velocity(text) {
            return velocity;
        }
        if ["kinetic", "potential", "lagrangian"].contains(&text) {
            return format!(
                "`energy` is the whole energy; a part of it is named where it is declared: `define(part = …), {text} = part`"
            );
        }
        if text.contains('·') {
            return format!("a product is written `{}`", text.replace('·', "*"));
        }
        let indices = self.indices.iter().map(|(name, _)| name.as_str());
        let names = self
            .names
            .keys()
            .map(String::as_str)
            .chain(indices)
            .chain(["pi", "energy"]);
        match meant(text, names) {
            Some(known) => format!("did you mean `{known}`?"),
            None => self.home.unknown().to_owned(),
        }
    }

    /// The element of an item of one of these kinds that a reference names.
    pub fn item(&mut self, reference: &Reference, kinds: &[Kind]) -> Option<(Kind, usize)> {
        let name = &reference.name;
        let Some(entry) = self.names.get(&name.text) else {
            self.unknown_of(name, kinds);
            return None;
        };
        let kind = entry.kind;
        let wanted: Vec<&str> = kinds.iter().map(|kind| kind.text()).collect();
        let wanted = wanted.join(" or ");
        let (elements, lower) = match &entry.meaning {
            Meaning::Poisoned => return None,
            Meaning::Item { elements, lower } if kinds.contains(&kind) => {
                (elements.clone(), *lower)
            }
            _ => {
                let hint = self.known(kinds);
                self.sink.report(
                    Code::WrongKind,
                    name,
                    &[&name.text, &kind.text(), &wanted, &hint],
                );
                return None;
            }
        };
        let Some(element) = &reference.element else {
            return match (lower, elements.as_slice()) {
                (None, [only]) => Some((kind, *only)),
                _ => {
                    let (list, hint) = (
                        format!("list of {}", elements.len()),
                        format!("write `{}[k]`", name.text),
                    );
                    self.sink
                        .report(Code::WrongKind, name, &[&name.text, &list, &wanted, &hint]);
                    None
                }
            };
        };
        let Some(lower) = lower else {
            let hint = format!("write `{}` alone", name.text);
            self.sink.report(
                Code::WrongKind,
                name,
                &[&name.text, &kind.text(), &"list", &hint],
            );
            return None;
        };
        let index = self.position(element, lower, elements.len())?;
        Some((kind, elements[index]))
    }

    /// Names of these kinds, for a hint.
    fn known(&self, kinds: &[Kind]) -> String {
        let known: Vec<String> = self
            .names
            .iter()
            .filter(|(_, entry)| kinds.contains(&entry.kind))
            .map(|(name, _)| format!("`{name}`"))
            .collect();
        if known.is_empty() {
            format!("declare a {}", kinds[0].text())
        } else {
            format!("known are {}", known.join(", "))
        }
    }
}

/// A name without `r#`.
pub(super) fn plain(ident: &proc_macro2::Ident) -> String {
    Name::new(ident).text
}

/// Letters with a dot above, as keyboards and files compose them.
const DOTTED: [(&str, &str); 12] = [
    ("ẋ", "x"),
    ("ẏ", "y"),
    ("ż", "z"),
    ("ṙ", "r"),
    ("ṡ", "s"),
    ("ṗ", "p"),
    ("ẇ", "w"),
    ("ȧ", "a"),
    ("ḃ", "b"),
    ("ċ", "c"),
    ("ḋ", "d"),
    ("ḣ", "h"),
];

/// The name of a Greek letter, whether small or capital.
fn spelt(letter: char) -> Option<&'static str> {
    /// Names from α to ω, ς between ρ and σ among them.
    const NAMES: [&str; 25] = [
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa",
        "lambda", "mu", "nu", "xi", "omicron", "pi", "rho", "sigma", "sigma", "tau", "upsilon",
        "phi", "chi", "psi", "omega",
    ];
    match letter {
        'ϑ' => Some("theta"),
        'ϕ' => Some("phi"),
        _ => {
            let small = letter.to_lowercase().next()?;
            let place = (small as usize).checked_sub('α' as usize)?;
            NAMES.get(place).copied()
        }
    }
}

/// The name of which this is the Greek letter in words, `phi` of `φ`, or else the nearest one.
fn meant<'a>(text: &str, names: impl Iterator<Item = &'a str> + Clone) -> Option<&'a str> {
    let in_words = |name: &str| -> String {
        let letters = name.chars();
        let words = letters.map(|letter| spelt(letter).map_or(letter.to_string(), str::to_owned));
        words.collect()
    };
    let mut same = names.clone().filter(|name| in_words(name) == text);
    same.next().or_else(|| nearest(text, names))
}

/// A name as that of a constant: `muStatic` and `mu_static` are both `MU_STATIC`. Greek letters are spelt, `THETA`: Rust warns of
/// names that look alike, and Θ looks like θ.
pub(crate) fn shouting(name: &str) -> String {
    let mut constant = String::with_capacity(name.len() + 4);
    let mut lower = false;
    for letter in name.chars() {
        if lower && letter.is_uppercase() {
            constant.push('_');
        }
        lower = letter.is_lowercase() || letter.is_numeric();
        match spelt(letter) {
            Some(name) => constant.push_str(&name.to_uppercase()),
            None if is_xid_continue(letter) => constant.extend(letter.to_uppercase()),
            // rustc goes on behind a name with an emoji, and has told it.
            None => constant.push_str(&format!("U{:X}", u32::from(letter))),
        }
    }
    constant
}

/// Whether a word is that of a function, be it of values or of an item.
pub(super) fn is_function(word: &str) -> bool {
    FUNCTIONS.contains(&word) || ["gap", "slip", "momentum"].contains(&word)
}

/// Whether a word cannot be a name. Nothing is called `_` in Rust.
pub(super) fn is_reserved(word: &str) -> bool {
    word == "_" || RESERVED.contains(&word) || FUNCTIONS.contains(&word)
}
