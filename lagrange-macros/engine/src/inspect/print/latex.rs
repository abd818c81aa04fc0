//! Formulas in LaTeX, with the commands of amsmath.

use super::notation::{self, Notation};
use crate::inspect::formula::{Formula, Relation, Statement};
use crate::inspect::letter::{Letter, Mark, from_below};
use crate::symbolic::Rational;

/// LaTeX's mathematics.
pub struct Latex;

/// A formula in LaTeX.
pub fn formula(f: &Formula) -> String {
    notation::formula(&Latex, f)
}

/// A statement in LaTeX.
pub fn statement(s: &Statement) -> String {
    notation::statement(&Latex, s)
}

/// Longer than this, a fraction or a root is written in a line, and so is what stands between parentheses: TeX breaks lines between
/// terms, but inside of none of them.
const LONG: usize = 70;

/// A name in mathematics: letters by their commands, and what has none, `é`, as text.
fn name(text: &str) -> String {
    let character = |c: char| {
        let single = c.to_string();
        match (Letter::of(&single, "").command(), from_below(c)) {
            (Some(tex), _) => format!("{tex} "),
            (None, Some(letter)) => format!("{{}}_{{{letter}}}"),
            (None, None) if c.is_ascii() => escaped(&single),
            (None, None) => format!("\\text{{{c}}}"),
        }
    };
    text.chars()
        .map(character)
        .collect::<String>()
        .trim_end()
        .to_owned()
}

/// Parentheses as high as what stands between them, if no line has to be broken there.
fn parentheses(inner: &str) -> String {
    match inner.len() > LONG {
        true => format!("({inner})"),
        false => format!("\\left({inner}\\right)"),
    }
}

/// Words with everything escaped that means something to LaTeX.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' => safe.push_str("\\textbackslash{}"),
            '{' | '}' | '_' | '&' | '%' | '$' | '#' => {
                safe.push('\\');
                safe.push(c);
            }
            '^' => safe.push_str("\\^{}"),
            '~' => safe.push_str("\\~{}"),
            c => safe.push(c),
        }
    }
    safe
}

impl Notation for Latex {
    fn letter(&self, letter: &Letter) -> String {
        let base = match letter.command() {
            _ if !letter.tex.is_empty() => format!("{{{}}}", letter.tex),
            Some(tex) => tex.to_owned(),
            None if letter.is_single() => name(&letter.base),
            None => format!("\\mathrm{{{}}}", name(&letter.base)),
        };
        let dotted = match letter.dots() {
            0 => base,
            1 => format!("\\dot{{{base}}}"),
            _ => format!("\\ddot{{{base}}}"),
        };
        let letters = letter.subscript.chars().filter(|c| c.is_alphabetic());
        let subscript = match letter.subscript.as_str() {
            "" => String::new(),
            _ if !letter.tex.is_empty() => String::new(),
            text if letters.count() > 1 => format!("_{{\\mathrm{{{}}}}}", name(text)),
            text => format!("_{{{}}}", name(text)),
        };
        let raised = match letter.mark {
            Mark::Before => "^{-}",
            Mark::After => "^{+}",
            _ => "",
        };
        let jump = match letter.mark {
            Mark::Jump => "\\Delta ",
            _ => "",
        };
        format!("{jump}{dotted}{subscript}{raised}")
    }

    fn number(&self, n: Rational) -> String {
        match n.is_integer() {
            true => n.to_string(),
            false => format!("\\tfrac{{{}}}{{{}}}", n.numerator(), n.denominator()),
        }
    }

    fn sign(&self, minus: bool, leading: bool) -> &'static str {
        match (minus, leading) {
            (true, true) => "-",
            (false, true) => "",
            (true, false) => " - ",
            (false, false) => " + ",
        }
    }

    fn relation(&self, relation: Relation) -> &'static str {
        match relation {
            Relation::Equal => " = ",
            Relation::AtLeast => " \\ge ",
            Relation::AtMost => " \\le ",
            Relation::Above => " > ",
            Relation::Below => " < ",
        }
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join(" \\, ")
    }

    fn fraction(&self, above: &str, below: &str) -> String {
        match above.len().max(below.len()) > LONG {
            true => format!("({above}) \\mathbin{{/}} ({below})"),
            false => format!("\\frac{{{above}}}{{{below}}}"),
        }
    }

    fn in_line(&self) -> bool {
        false
    }

    fn stacked(&self, fraction: &str) -> bool {
        fraction.starts_with("\\frac")
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        // A letter that is raised already takes its exponent in braces.
        match base.contains("^{") {
            true => format!("{{{base}}}^{{{exponent}}}"),
            false => format!("{base}^{{{exponent}}}"),
        }
    }

    fn root(&self, inner: &str) -> String {
        match inner.len() > LONG {
            true => format!("({inner})^{{1/2}}"),
            false => format!("\\sqrt{{{inner}}}"),
        }
    }

    fn absolute(&self, inner: &str) -> String {
        format!("\\left|{inner}\\right|")
    }

    fn group(&self, inner: &str) -> String {
        parentheses(inner)
    }

    fn call(&self, name: &str, exponent: Option<&str>, argument: &str, bare: bool) -> String {
        let known = [
            "sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "exp", "ln",
            "max", "min",
        ];
        let name = match known.contains(&name) {
            true => format!("\\{name}"),
            false => format!("\\operatorname{{{}}}", escaped(name)),
        };
        let name = match exponent {
            Some(exponent) => format!("{name}^{{{exponent}}}"),
            None => name,
        };
        match bare {
            true => format!("{name} {argument}"),
            false => format!("{name}{}", parentheses(argument)),
        }
    }

    fn rate(&self, inner: &str, order: u8) -> String {
        match order {
            1 => format!("\\frac{{d}}{{dt}}{}", parentheses(inner)),
            _ => format!("\\frac{{d^2}}{{dt^2}}{}", parentheses(inner)),
        }
    }

    fn cases(&self, rows: &[(String, String)], otherwise: &str) -> String {
        let row = |(condition, then): &(String, String)| {
            format!("{then} & \\text{{if }} {condition} \\\\ ")
        };
        let rows: String = rows.iter().map(row).collect();
        format!("\\begin{{cases}} {rows}{otherwise} & \\text{{else}} \\end{{cases}}")
    }

    fn sum_over(&self, index: &str, from: &str, to: &str, body: &str) -> String {
        format!("\\sum_{{{index}={from}}}^{{{to}}} {body}")
    }

    fn list(&self, elements: &[String]) -> String {
        parentheses(&elements.join(", "))
    }

    fn element(&self, base: &str, index: &str) -> String {
        format!("{base}_{{{index}}}")
    }

    fn more(&self, count: usize) -> String {
        format!("\\cdots \\;\\text{{({count} more terms)}}")
    }
}
