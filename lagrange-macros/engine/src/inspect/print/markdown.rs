//! A derivation as Markdown, with formulas between dollar signs and the modes as a Mermaid graph: GitHub shows both.

use super::{diagram, latex};
use crate::inspect::Derivation;
use crate::inspect::document::{Block, Piece};

/// The whole derivation as Markdown.
pub fn markdown(derivation: &Derivation) -> String {
    let mut out = String::new();
    for block in derivation.blocks() {
        match block {
            Block::Heading(depth, title) => {
                if !out.is_empty() {
                    out.push('\n');
                }
                let graph = depth == 2 && title.starts_with("Modes");
                out.push_str(&format!("{} {title}\n\n", "#".repeat(depth)));
                if graph {
                    out.push_str(&format!(
                        "```mermaid\n{}```\n",
                        diagram::mermaid(derivation)
                    ));
                }
            }
            Block::Paragraph(pieces) => out.push_str(&format!("{}\n\n", line(&pieces))),
            Block::Table(rows) => table(&rows, &mut out),
            Block::Equations(equations) => {
                for (label, statement) in &equations {
                    let label = match label.is_empty() {
                        true => String::new(),
                        false => format!("{}:\n", line(label)),
                    };
                    let formula = latex::statement(statement);
                    out.push_str(&format!("{label}$${formula}$$\n\n"));
                }
            }
        }
    }
    out
}

fn line(pieces: &[Piece]) -> String {
    pieces
        .iter()
        .map(|piece| match piece {
            Piece::Words(words) => words.replace('_', "\\_").replace('|', "\\|"),
            Piece::Formula(f) => format!("${}$", in_table(&latex::formula(f))),
            Piece::Statement(s) => format!("${}$", in_table(&latex::statement(s))),
        })
        .collect()
}

/// A bar would end a cell.
fn in_table(formula: &str) -> String {
    formula
        .replace("\\left|", "\\left\\vert ")
        .replace("\\right|", "\\right\\vert ")
}

fn table(rows: &[Vec<Vec<Piece>>], out: &mut String) {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let mut rows = rows.to_vec();
    // A table has a header; where there is none, it is empty.
    let titled = rows.first().is_some_and(|row| {
        row.len() > 1
            && row
                .iter()
                .all(|cell| matches!(cell.as_slice(), [Piece::Words(_)]))
            && row.first().is_some_and(|cell| is_title(cell))
    });
    if !titled {
        rows.insert(0, vec![Vec::new(); columns]);
    }
    for (i, row) in rows.iter().enumerate() {
        let cells: Vec<String> = (0..columns)
            .map(|column| row.get(column).map(|cell| line(cell)).unwrap_or_default())
            .collect();
        out.push_str(&format!("| {} |\n", cells.join(" | ")));
        if i == 0 {
            out.push_str(&format!("|{}\n", "---|".repeat(columns)));
        }
    }
    out.push('\n');
}

/// First cell of a header of [`crate::inspect::document`].
fn is_title(cell: &[Piece]) -> bool {
    matches!(cell, [Piece::Words(words)] if ["", "effect", "mode"].contains(&words.as_str()))
}
