//! A derivation as plain text, at most a hundred columns wide where it can be broken.

use super::notation::{Notation, pieces};
use super::text::{self, Text};
use crate::inspect::Derivation;
use crate::inspect::document::{Block, ENERGIES, MOTION, Piece};
use crate::inspect::formula::Statement;

/// A left side up to this stays in one line with what follows.
const SHORT: usize = 8;

/// Columns.
const WIDTH: usize = 100;

/// The whole derivation as text.
pub fn plain(derivation: &Derivation) -> String {
    let mut out = String::new();
    for block in derivation.blocks() {
        match block {
            Block::Heading(1, title) => {
                out.push_str(&title);
                out.push('\n');
            }
            Block::Heading(2, title) => out.push_str(&format!("\n{title}\n")),
            Block::Heading(_, title) => out.push_str(&format!("\n  {title}\n")),
            Block::Paragraph(pieces) => paragraph(&line(&pieces), &mut out),
            Block::Table(rows) => table(&rows, &mut out),
            Block::Equations(equations) => lines(&equations, &mut out),
        }
    }
    out
}

/// Energies and equations of motion alone.
pub fn brief(derivation: &Derivation) -> String {
    let mut out = String::new();
    let mut inside = false;
    for block in derivation.blocks() {
        match block {
            Block::Heading(2, title) => inside = title == ENERGIES || title == MOTION,
            Block::Equations(equations) if inside => lines(&equations, &mut out),
            _ => {}
        }
    }
    out
}

/// Pieces in one line.
pub(super) fn line(pieces: &[Piece]) -> String {
    pieces
        .iter()
        .map(|piece| match piece {
            Piece::Words(words) => words.clone(),
            Piece::Formula(formula) => text::formula(formula),
            Piece::Statement(statement) => text::statement(statement),
        })
        .collect()
}

/// Number of columns: combining dots take none.
pub(super) fn width(text: &str) -> usize {
    text.chars()
        .filter(|c| !('\u{300}'..'\u{370}').contains(c))
        .count()
}

fn paragraph(text: &str, out: &mut String) {
    let mut column = 0;
    for word in text.split(' ') {
        if column > 0 && column + 1 + width(word) > WIDTH {
            out.push('\n');
            column = 0;
        }
        out.push_str(if column == 0 { "  " } else { " " });
        out.push_str(word);
        column += 2 + width(word);
    }
    out.push('\n');
}

fn table(rows: &[Vec<Vec<Piece>>], out: &mut String) {
    let cells: Vec<Vec<String>> = rows
        .iter()
        .map(|row| row.iter().map(|cell| line(cell)).collect())
        .collect();
    let columns = cells.iter().map(Vec::len).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns)
        .map(|column| {
            let of_column = cells.iter().filter_map(|row| row.get(column));
            of_column.map(|cell| width(cell)).max().unwrap_or(0)
        })
        .collect();
    let formulas = rows
        .iter()
        .flatten()
        .flatten()
        .any(|piece| !matches!(piece, Piece::Words(_)));
    let total: usize = widths.iter().map(|wide| wide + 2).sum();
    if let [header, rows @ ..] = rows
        && header.first().is_some_and(|cell| line(cell).is_empty())
        && formulas
        && total > 2 * WIDTH
    {
        return blocks(header, rows, out);
    }
    for row in &cells {
        let mut text = String::new();
        for (cell, &wide) in row.iter().zip(&widths) {
            if wide > 0 {
                text.push_str("  ");
                text.push_str(cell);
                text.push_str(&" ".repeat(wide - width(cell)));
            }
        }
        out.push_str(text.trim_end());
        out.push('\n');
    }
}

/// A table too wide for any screen: each row as a name with its cells below, statements broken.
fn blocks(header: &[Vec<Piece>], rows: &[Vec<Vec<Piece>>], out: &mut String) {
    for row in rows {
        for (i, (cell, title)) in row.iter().zip(header).enumerate() {
            let title = line(title);
            match cell.as_slice() {
                _ if i == 0 => out.push_str(&format!("  {}\n", line(cell))),
                [Piece::Statement(statement)] => {
                    lines(&[(vec![Piece::Words(title)], statement.clone())], out);
                }
                cell => out.push_str(&format!("  {title}    {}\n", line(cell))),
            }
        }
    }
}

fn lines(equations: &[(Vec<Piece>, Statement)], out: &mut String) {
    let labels: Vec<String> = equations.iter().map(|(label, _)| line(label)).collect();
    let widest = labels.iter().map(|label| width(label)).max().unwrap_or(0);
    for (label, (_, statement)) in labels.iter().zip(equations) {
        let mut head = String::from("    ");
        if widest > 0 {
            head = format!("  {label}{}    ", " ".repeat(widest - width(label)));
        }
        let whole = text::statement(statement);
        if width(&head) + width(&whole) <= WIDTH {
            out.push_str(&head);
            out.push_str(&whole);
            out.push('\n');
            continue;
        }
        broken(&head, statement, out);
    }
}

/// A long equation: its right side in a line of its own if it fits there, else broken between terms.
fn broken(head: &str, statement: &Statement, out: &mut String) {
    let indent = " ".repeat(width(head) + 4);
    let relation = Text.relation(statement.relation);
    let mut all = pieces(&Text, &statement.left);
    let mut right = pieces(&Text, &statement.right);
    let whole = format!(
        "{}{}",
        relation.trim_start(),
        text::formula(&statement.right)
    );
    let left = text::formula(&statement.left);
    if width(&indent) + width(&whole) <= WIDTH && width(head) + width(&left) <= WIDTH {
        out.push_str(&format!("{head}{left}\n{indent}{whole}\n"));
        return;
    }
    right[0] = format!("{relation}{}", right[0]);
    if width(&left) <= SHORT {
        right[0] = format!("{left}{}", right[0]);
        all.clear();
    }
    all.append(&mut right);
    let mut current = head.to_owned();
    for (i, piece) in all.iter().enumerate() {
        if i > 0 && width(&current) + width(piece) > WIDTH {
            out.push_str(current.trim_end());
            out.push('\n');
            current = indent.clone();
            current.push_str(piece.trim_start());
        } else {
            current.push_str(piece);
        }
    }
    out.push_str(current.trim_end());
    out.push('\n');
}
