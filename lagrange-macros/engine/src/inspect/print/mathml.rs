//! Formulas in MathML (Core), which browsers typeset themselves.

use super::notation::{self, Notation};
use crate::inspect::formula::{Formula, Relation, Statement};
use crate::inspect::letter::{Letter, Mark};
use crate::symbolic::Rational;

/// Presentation MathML.
pub struct MathMl;

/// A formula as a `<math>` element in a line of text.
pub fn formula(f: &Formula) -> String {
    format!("<math>{}</math>", notation::formula(&MathMl, f))
}

/// A statement as a `<math>` element in a line of text.
pub fn statement(s: &Statement) -> String {
    format!("<math>{}</math>", notation::statement(&MathMl, s))
}

/// A statement as a `<math>` element of its own.
pub fn display(s: &Statement) -> String {
    format!(
        "<math display=\"block\">{}</math>",
        notation::statement(&MathMl, s)
    )
}

/// Text with everything escaped that means something to XML, in attributes too.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            c => safe.push(c),
        }
    }
    safe
}

const SPACE: &str = "<mspace width=\"0.17em\"/>";

/// A brace as high as its cell: four arcs and two lines. Browsers stretch the letter with a font for mathematics only, and many systems have none.
const BRACE: &str = "padding:0;width:.55em;print-color-adjust:exact;background:\
    radial-gradient(circle at 100% 100%,#0000 .24em,currentColor .25em .3em,#0000 .31em) 100% 0/.3em .3em no-repeat,\
    radial-gradient(circle at 100% 0,#0000 .24em,currentColor .25em .3em,#0000 .31em) 100% 100%/.3em .3em no-repeat,\
    radial-gradient(circle at 0 0,#0000 .24em,currentColor .25em .3em,#0000 .31em) 0 calc(50% - .15em)/.3em .3em no-repeat,\
    radial-gradient(circle at 0 100%,#0000 .24em,currentColor .25em .3em,#0000 .31em) 0 calc(50% + .15em)/.3em .3em no-repeat,\
    linear-gradient(currentColor,currentColor) .25em .3em/.05em calc(50% - .6em) no-repeat,\
    linear-gradient(currentColor,currentColor) .25em calc(100% - .3em)/.05em calc(50% - .6em) no-repeat";

impl Notation for MathMl {
    fn letter(&self, letter: &Letter) -> String {
        let base = format!("<mi>{}</mi>", escaped(&letter.base));
        let dotted = match letter.dots() {
            0 => base,
            // Not as accents: with fonts that have no table of mathematics they touch the letter.
            1 => format!("<mover>{base}<mo>˙</mo></mover>"),
            _ => format!("<mover>{base}<mo>¨</mo></mover>"),
        };
        let subscript = match letter.subscript.as_str() {
            "" => String::new(),
            text if text.bytes().all(|b| b.is_ascii_digit()) => format!("<mn>{text}</mn>"),
            text => format!("<mi>{}</mi>", escaped(text)),
        };
        let raised = match letter.mark {
            Mark::Before => "<mo>−</mo>",
            Mark::After => "<mo>+</mo>",
            _ => "",
        };
        let letter_text = match (subscript.is_empty(), raised.is_empty()) {
            (true, true) => dotted,
            (false, true) => format!("<msub>{dotted}{subscript}</msub>"),
            (true, false) => format!("<msup>{dotted}{raised}</msup>"),
            (false, false) => format!("<msubsup>{dotted}{subscript}{raised}</msubsup>"),
        };
        match letter.mark {
            Mark::Jump => format!("<mrow><mi mathvariant=\"normal\">Δ</mi>{letter_text}</mrow>"),
            _ => letter_text,
        }
    }

    fn number(&self, n: Rational) -> String {
        match n.is_integer() {
            true => format!("<mn>{n}</mn>"),
            false => format!(
                "<mfrac><mn>{}</mn><mn>{}</mn></mfrac>",
                n.numerator(),
                n.denominator()
            ),
        }
    }

    fn decimal(&self, digits: &str) -> String {
        format!("<mn>{digits}</mn>")
    }

    fn sign(&self, minus: bool, leading: bool) -> &'static str {
        match (minus, leading) {
            (true, _) => "<mo>−</mo>",
            (false, true) => "",
            (false, false) => "<mo>+</mo>",
        }
    }

    fn relation(&self, relation: Relation) -> &'static str {
        match relation {
            Relation::Equal => "<mo>=</mo>",
            Relation::AtLeast => "<mo>≥</mo>",
            Relation::AtMost => "<mo>≤</mo>",
            Relation::Above => "<mo>&gt;</mo>",
            Relation::Below => "<mo>&lt;</mo>",
        }
    }

    fn product(&self, factors: &[String]) -> String {
        format!("<mrow>{}</mrow>", factors.join(SPACE))
    }

    fn fraction(&self, above: &str, below: &str) -> String {
        format!("<mfrac><mrow>{above}</mrow><mrow>{below}</mrow></mfrac>")
    }

    fn in_line(&self) -> bool {
        false
    }

    fn power(&self, base: &str, exponent: &str) -> String {
        format!("<msup>{base}<mrow>{exponent}</mrow></msup>")
    }

    fn root(&self, inner: &str) -> String {
        format!("<msqrt>{inner}</msqrt>")
    }

    fn absolute(&self, inner: &str) -> String {
        format!("<mrow><mo>|</mo>{inner}<mo>|</mo></mrow>")
    }

    fn group(&self, inner: &str) -> String {
        format!("<mrow><mo>(</mo>{inner}<mo>)</mo></mrow>")
    }

    fn call(&self, name: &str, exponent: Option<&str>, argument: &str, bare: bool) -> String {
        let name = format!("<mi>{}</mi>", escaped(name));
        let name = match exponent {
            Some(exponent) => self.power(&name, exponent),
            None => name,
        };
        match bare {
            true => format!("<mrow>{name}{SPACE}{argument}</mrow>"),
            false => format!("<mrow>{name}{}</mrow>", self.group(argument)),
        }
    }

    fn rate(&self, inner: &str, order: u8) -> String {
        let (above, below) = match order {
            1 => ("<mi>d</mi>".to_owned(), "<mi>t</mi>".to_owned()),
            _ => (
                "<msup><mi>d</mi><mn>2</mn></msup>".to_owned(),
                "<msup><mi>t</mi><mn>2</mn></msup>".to_owned(),
            ),
        };
        let operator = self.fraction(&above, &format!("<mi>d</mi>{below}"));
        format!("<mrow>{operator}{}</mrow>", self.group(inner))
    }

    fn cases(&self, rows: &[(String, String)], otherwise: &str) -> String {
        let row = |then: &str, when: &str| {
            format!("<mtr><mtd>{then}</mtd><mtd style=\"text-align:left\">{when}</mtd></mtr>")
        };
        // A space at the end of a text is dropped, unless it is one that does not break.
        let rows = rows
            .iter()
            .map(|(condition, then)| row(then, &format!("<mtext>if\u{a0}</mtext>{condition}")));
        let rows: String = rows.collect();
        let last = row(otherwise, "<mtext>else</mtext>");
        // The letter itself is there for who copies it.
        let letter = "<mo stretchy=\"false\" style=\"opacity:0\">{</mo>";
        format!(
            "<mtable><mtr><mtd style=\"{BRACE}\">{letter}</mtd><mtd style=\"padding:0\"><mtable>{rows}{last}</mtable></mtd></mtr></mtable>"
        )
    }

    fn sum_over(&self, index: &str, from: &str, to: &str, body: &str) -> String {
        format!(
            "<mrow><munderover><mo>∑</mo><mrow>{index}<mo>=</mo>{from}</mrow><mrow>{to}</mrow></munderover>{body}</mrow>"
        )
    }

    fn list(&self, elements: &[String]) -> String {
        self.group(&elements.join("<mo>,</mo>"))
    }

    fn element(&self, base: &str, index: &str) -> String {
        format!("<msub>{base}<mrow>{index}</mrow></msub>")
    }

    fn more(&self, count: usize) -> String {
        format!("<mtext>… ({count} more terms)</mtext>")
    }

    fn row(&self, pieces: &[String]) -> String {
        format!("<mrow>{}</mrow>", pieces.concat())
    }
}
