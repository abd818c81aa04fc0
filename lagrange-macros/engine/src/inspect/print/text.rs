//! Formulas as plain text: `m r² θ̈ + m r ẍ cos θ`.

use super::notation::{self, Notation};
use crate::inspect::formula::{Formula, Relation, Statement};
use crate::inspect::letter::{Letter, Mark, lowered, raised};
use crate::symbolic::Rational;

/// Plain text with Unicode letters.
pub struct Text;

/// A formula as text.
pub fn formula(f: &Formula) -> String {
    notation::formula(&Text, f)
}

/// A statement as text.
pub fn statement(s: &Statement) -> String {
    notation::statement(&Text, s)
}

impl Notation for Text {
    fn letter(&self, letter: &Letter) -> String {
        let dots = match letter.dots() {
            _ if !letter.is_single() => "",
            0 => "",
            1 => "\u{307}",
            _ => "\u{308}",
        };
        let subscript = match letter.subscript.as_str() {
            "" => String::new(),
            text if text.chars().filter(|c| c.is_alphabetic()).count() > 1 => format!("_{text}"),
            text => lowered(text).unwrap_or_else(|| format!("_{text}")),
        };
        let mut text = format!("{}{dots}{subscript}", letter.base);
        if !letter.is_single() {
            for _ in 0..letter.dots() {
                text = format!("der({text})");
            }
        }
        match letter.mark {
            Mark::None => text,
            Mark::Before => text + "⁻",
            Mark::After => text + "⁺",
            Mark::Jump => format!("Δ{text}"),
        }
    }

    fn number(&self, n: Rational) -> String {
        let pair = (n.numerator(), n.denominator());
        let known = [
            ((1, 2), "½"),
            ((1, 3), "⅓"),
            ((2, 3), "⅔"),
            ((1, 4), "¼"),
            ((3, 4), "¾"),
            ((1, 5), "⅕"),
            ((2, 5), "⅖"),
            ((3, 5), "⅗"),
            ((4, 5), "⅘"),
            ((1, 6), "⅙"),
            ((1, 8), "⅛"),
        ];
        match known.iter().find(|(number, _)| *number == pair) {
            Some((_, text)) => (*text).to_owned(),
            None if n.is_integer() => n.to_string(),
            None => format!("({n})"),
        }
    }

    fn sign(&self, minus: bool, leading: bool) -> &'static str {
        match (minus, leading) {
            (true, true) => "−",
            (false, true) => "",
            (true, false) => " − ",
            (false, false) => " + ",
        }
    }

    fn relation(&self, relation: Relation) -> &'static str {
        match relation {
            Relation::Equal => " = ",
            Relation::AtLeast => " ≥ ",
            Relation::AtMost => " ≤ ",
            Relation::Above => " > ",
            Relation::Below => " < ",
        }
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join(" ")
    }

    fn fraction(&self, above: &str, below: &str) -> String {
        format!("{above}/{below}")
    }

    fn in_line(&self) -> bool {
        true
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        match raised(exponent) {
            Some(exponent) => format!("{base}{exponent}"),
            None if exponent.chars().count() == 1 => format!("{base}^{exponent}"),
            None => format!("{base}^{}", self.group(exponent)),
        }
    }

    fn root(&self, inner: &str) -> String {
        match inner.chars().count() {
            1 => format!("√{inner}"),
            _ => format!("√({inner})"),
        }
    }

    fn absolute(&self, inner: &str) -> String {
        format!("|{inner}|")
    }

    fn group(&self, inner: &str) -> String {
        // A fraction of numbers comes in parentheses of its own.
        match inner.starts_with('(') && inner.find(')') == Some(inner.len() - 1) {
            true => inner.to_owned(),
            false => format!("({inner})"),
        }
    }

    fn call(&self, name: &str, exponent: Option<&str>, argument: &str, bare: bool) -> String {
        let name = match exponent {
            Some(exponent) => self.power(name, exponent),
            None => name.to_owned(),
        };
        match bare {
            true => format!("{name} {argument}"),
            false => format!("{name}({argument})"),
        }
    }

    fn rate(&self, inner: &str, order: u8) -> String {
        match order {
            1 => format!("d/dt({inner})"),
            _ => format!("d²/dt²({inner})"),
        }
    }

    fn cases(&self, rows: &[(String, String)], otherwise: &str) -> String {
        let row = |(condition, then): &(String, String)| format!("{then} if {condition}, ");
        let rows: String = rows.iter().map(row).collect();
        format!("{{{rows}else {otherwise}}}")
    }

    fn sum_over(&self, index: &str, from: &str, to: &str, body: &str) -> String {
        format!("Σ({index} = {from} … {to}) {body}")
    }

    fn list(&self, elements: &[String]) -> String {
        format!("({})", elements.join(", "))
    }

    fn element(&self, base: &str, index: &str) -> String {
        format!("{base}[{index}]")
    }

    fn more(&self, count: usize) -> String {
        format!("… ({count} more terms)")
    }
}
