//! A derivation as HTML with MathML: a `<section>` to be put into a page, and the equations for a doc comment.

use super::{mathml, text};
use crate::inspect::document::{self, Block, Piece};
use crate::inspect::formula::Statement;
use crate::inspect::{Derivation, Equation, Item};

/// A doc comment with more than this is not continued.
const MOST_BYTES: usize = 12_000;

/// The whole derivation as a `<section>`; well-formed XML.
pub fn page(derivation: &Derivation) -> String {
    let mut out = String::from("<section>\n");
    for block in derivation.blocks() {
        match block {
            Block::Heading(depth, title) => {
                let depth = depth + 1;
                let title = mathml::escaped(&title);
                out.push_str(&format!("<h{depth}>{title}</h{depth}>\n"));
            }
            Block::Paragraph(pieces) => out.push_str(&format!("<p>{}</p>\n", line(&pieces))),
            Block::Table(rows) => table(&rows, &mut out),
            Block::Equations(equations) => {
                for (label, statement) in &equations {
                    let label = match label.is_empty() {
                        true => String::new(),
                        false => format!("<p>{}:</p>", line(label)),
                    };
                    out.push_str(&format!("{label}{}\n", titled(statement)));
                }
            }
        }
    }
    out.push_str("</section>\n");
    out
}

/// The equations of motion in one line, each with its plain text as title; not all if that is very long.
pub fn equations(derivation: &Derivation) -> String {
    let mut out = String::from("<div class=\"lagrange-equations\">");
    for (i, Equation { statement, .. }) in derivation.motion.iter().enumerate() {
        if out.len() > MOST_BYTES {
            let left = derivation.motion.len() - i;
            out.push_str(&format!("<div>… {left} more like these</div>"));
            break;
        }
        out.push_str(&titled(statement));
    }
    out + "</div>"
}

/// What an item of the declaration says, in a line.
pub fn said(item: &Item) -> String {
    line(&document::said(item))
}

/// A statement with its plain text as title.
pub fn titled(statement: &Statement) -> String {
    let plain = mathml::escaped(&text::statement(statement));
    format!(
        "<div style=\"margin:0.5em 0\" title=\"{plain}\">{}</div>",
        mathml::display(statement)
    )
}

fn line(pieces: &[Piece]) -> String {
    pieces
        .iter()
        .map(|piece| match piece {
            Piece::Words(words) => mathml::escaped(words),
            Piece::Formula(f) => mathml::formula(f),
            Piece::Statement(s) => mathml::statement(s),
        })
        .collect()
}

fn table(rows: &[Vec<Vec<Piece>>], out: &mut String) {
    out.push_str("<table>\n");
    for row in rows {
        let cells: String = row
            .iter()
            .map(|cell| format!("<td>{}</td>", line(cell)))
            .collect();
        out.push_str(&format!("<tr>{cells}</tr>\n"));
    }
    out.push_str("</table>\n");
}
