//! A derivation as a part of a LaTeX document; needs amsmath, and pages wide enough for the longest equation.

use super::latex::{self, Latex};
use super::notation::{self, Notation};
use crate::inspect::Derivation;
use crate::inspect::document::{Block, Piece};
use crate::inspect::formula::{Formula, Statement};

/// Right sides with more to read are broken between their terms.
const LONGEST: usize = 24;

/// The whole derivation in LaTeX, to be `\input`.
pub fn paper(derivation: &Derivation) -> String {
    let mut out = String::from("% \\usepackage{amsmath}\n");
    for block in derivation.blocks() {
        match block {
            Block::Heading(depth, title) => {
                let command = ["section", "subsection", "subsubsection"][depth.clamp(1, 3) - 1];
                out.push_str(&format!("\n\\{command}*{{{}}}\n", words(&title)));
            }
            Block::Paragraph(pieces) => out.push_str(&format!("{}\n\n", line(&pieces))),
            Block::Table(rows) => table(&rows, &mut out),
            Block::Equations(equations) => align(&equations, &mut out),
        }
    }
    out
}

fn line(pieces: &[Piece]) -> String {
    pieces
        .iter()
        .map(|piece| match piece {
            Piece::Words(text) => words(text),
            Piece::Formula(f) => format!("${}$", latex::formula(f)),
            Piece::Statement(s) => format!("${}$", latex::statement(s)),
        })
        .collect()
}

/// Words; letters that text fonts lack become mathematics.
fn words(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        let single = c.to_string();
        let greek = crate::inspect::letter::Letter::of(&single, "");
        match (greek.greek_tex(), c) {
            (Some(tex), _) => out.push_str(&format!("${tex}$")),
            (_, '½') => out.push_str("$\\tfrac{1}{2}$"),
            (_, '⅖') => out.push_str("$\\tfrac{2}{5}$"),
            (_, '²') => out.push_str("$^2$"),
            (_, '³') => out.push_str("$^3$"),
            (_, '₁') => out.push_str("$_1$"),
            (_, '₂') => out.push_str("$_2$"),
            (_, '≥') => out.push_str("$\\ge$"),
            (_, '≤') => out.push_str("$\\le$"),
            (_, '→') => out.push_str("$\\to$"),
            (_, '−') => out.push_str("$-$"),
            (_, '…') => out.push_str("\\dots{}"),
            (_, '·') => out.push_str("$\\cdot$"),
            (_, '\u{307}') => out.push_str("\\.{}"),
            (_, 'ₖ') => out.push_str("$_k$"),
            (_, 'ₛ') => out.push_str("$_s$"),
            _ => out.push_str(&latex::escaped(&single)),
        }
    }
    // Code in back quotes.
    let mut code = false;
    out.split('`')
        .map(|part| {
            let text = match code {
                true => format!("\\texttt{{{part}}}"),
                false => part.to_owned(),
            };
            code = !code;
            text
        })
        .collect()
}

fn table(rows: &[Vec<Vec<Piece>>], out: &mut String) {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    out.push_str(&format!(
        "\\par\\noindent\\begin{{tabular}}{{{}}}\n",
        "l".repeat(columns)
    ));
    for row in rows {
        let cells: Vec<String> = row.iter().map(|cell| line(cell)).collect();
        out.push_str(&format!("  {} \\\\\n", cells.join(" & ")));
    }
    out.push_str("\\end{tabular}\n\n");
}

fn align(equations: &[(Vec<Piece>, Statement)], out: &mut String) {
    if equations.is_empty() {
        return;
    }
    out.push_str("\\begin{align*}\n");
    let lines: Vec<String> = equations
        .iter()
        .map(|(label, statement)| {
            let tag = match label.is_empty() {
                true => String::new(),
                false => format!(" \\tag{{{}}}", line(label)),
            };
            format!("  {}{tag}", sides(statement))
        })
        .collect();
    out.push_str(&lines.join(" \\\\\n"));
    out.push_str("\n\\end{align*}\n");
}

fn sides(statement: &Statement) -> String {
    let left = latex::formula(&statement.left);
    let relation = Latex.relation(statement.relation).trim();
    let Formula::Sum(_) = statement.right else {
        return format!("{left} &{relation} {}", latex::formula(&statement.right));
    };
    if statement.right.size() + statement.left.size() <= LONGEST {
        return format!("{left} &{relation} {}", latex::formula(&statement.right));
    }
    let lines = notation::terms(&Latex, &statement.right);
    format!(
        "{left} \\\\ &\\quad {relation} {}",
        lines.join(" \\\\ &\\quad ")
    )
}
