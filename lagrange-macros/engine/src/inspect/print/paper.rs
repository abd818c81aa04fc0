//! A derivation as a part of a LaTeX document; needs amsmath.
//!
//! Equations are formulas in paragraphs, because TeX breaks those at relations and signs where a line ends, and displayed ones
//! never.

use super::latex;
use crate::inspect::Derivation;
use crate::inspect::document::{Block, Piece};
use crate::inspect::formula::Statement;
use crate::inspect::letter::{Letter, from_below};

/// Letters that a row of a table has room for.
const WIDEST: usize = 70;
/// Letters that stand for the space between two columns.
const BETWEEN: usize = 3;
/// A table with more rows is written as several, as each stays on one page.
const LONGEST: usize = 30;

/// The whole derivation in LaTeX, to be `\input`.
pub fn paper(derivation: &Derivation) -> String {
    let mut out = String::from(
        "% \\usepackage{amsmath}\n\\begingroup\\raggedright\\parindent=0pt \\relpenalty=0 \\binoppenalty=100\n",
    );
    for block in derivation.blocks() {
        match block {
            Block::Heading(depth, title) => {
                let command = ["section", "subsection", "subsubsection"][depth.clamp(1, 3) - 1];
                out.push_str(&format!("\n\\{command}*{{{}}}\n", words(&title)));
            }
            Block::Paragraph(pieces) => out.push_str(&format!("{}\n\n", line(&pieces))),
            Block::Table(rows) => table(&rows, &mut out),
            Block::Equations(list) => equations(&list, &mut out),
        }
    }
    out + "\\par\\endgroup\n"
}

fn line(pieces: &[Piece]) -> String {
    pieces
        .iter()
        .map(|piece| match piece {
            Piece::Words(text) => words(text),
            Piece::Formula(f) => format!("${}$", breakable(&latex::formula(f))),
            Piece::Statement(s) => format!("${}$", breakable(&latex::statement(s))),
        })
        .collect()
}

/// Words; letters that text fonts lack become mathematics.
fn words(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        let single = c.to_string();
        let letter = Letter::of(&single, "");
        match (letter.command(), c) {
            (Some(tex), _) => out.push_str(&format!("${tex}$")),
            // The power of a unit.
            (_, '^') => {
                let mut power = String::new();
                while let Some(digit) = rest.next_if(|c| c.is_ascii_digit() || *c == '-') {
                    power.push(digit);
                }
                out.push_str(&format!("$^{{{power}}}$"));
            }
            (_, '½') => out.push_str("$\\tfrac{1}{2}$"),
            (_, '⅖') => out.push_str("$\\tfrac{2}{5}$"),
            (_, '²') => out.push_str("$^2$"),
            (_, '³') => out.push_str("$^3$"),
            (_, '₀'..='₉') => out.push_str(&format!("$_{}$", c as u32 - '₀' as u32)),
            (_, '∂') => out.push_str("$\\partial$"),
            (_, '√') => out.push_str("$\\surd$"),
            (_, '≥') => out.push_str("$\\ge$"),
            (_, '≤') => out.push_str("$\\le$"),
            (_, '→') => out.push_str("$\\to$"),
            (_, '−') => out.push_str("$-$"),
            (_, '…') => out.push_str("\\dots{}"),
            (_, '·') => out.push_str("$\\cdot$"),
            (_, '\u{307}') => out.push_str("\\.{}"),
            _ => match from_below(c) {
                Some(letter) => out.push_str(&format!("$_{letter}$")),
                None => out.push_str(&latex::escaped(&single)),
            },
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

/// A formula whose lists may end a line after each comma. (Browsers that show TeX do not know the command.)
fn breakable(formula: &str) -> String {
    let broken = formula.replace(", ", ", \\penalty0 ");
    // Thin spaces end in a comma, too.
    broken.replace("\\, \\penalty0 ", "\\, ")
}

fn table(rows: &[Vec<Vec<Piece>>], out: &mut String) {
    let letters = |piece: &Piece| match piece {
        Piece::Words(text) => text.chars().count(),
        _ => WIDEST,
    };
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells
            .map(|cell| cell.iter().map(letters).sum())
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let between = BETWEEN * columns.saturating_sub(1);
    let wide = between + widths.iter().sum::<usize>() > WIDEST;
    if wide && widths[1..].iter().sum::<usize>() > WIDEST / 2 || widths.first() == Some(&WIDEST) {
        return paragraphs(rows, out);
    }
    // What the other columns leave to the first one.
    let others: usize = between + widths.iter().skip(1).sum::<usize>();
    let left = WIDEST.saturating_sub(others) as f64 / WIDEST as f64;
    for part in rows.chunks(LONGEST) {
        out.push_str(&format!(
            "\\par\\noindent\\begin{{tabular}}{{@{{}}{}@{{}}}}\n",
            "l".repeat(columns)
        ));
        for row in part {
            let mut cells: Vec<String> = row.iter().map(|cell| line(cell)).collect();
            if wide && let Some(first) = cells.first_mut() {
                *first = format!(
                    "\\parbox[t]{{{left:.2}\\linewidth}}{{\\raggedright\\hangindent=1em {first}\\strut}}"
                );
            }
            out.push_str(&format!("  {} \\\\\n", cells.join(" & ")));
        }
        out.push_str("\\end{tabular}\n\n");
    }
}

/// A paragraph for each row; if the first row has no name of its own, its cells say what the others' are.
fn paragraphs(rows: &[Vec<Vec<Piece>>], out: &mut String) {
    let header = rows
        .first()
        .filter(|row| row.first().is_some_and(|cell| line(cell).is_empty()));
    for row in &rows[usize::from(header.is_some())..] {
        let cell = |(i, cell): (usize, &Vec<Piece>)| {
            let title = header.and_then(|row| row.get(i)).map(|title| line(title));
            match title.filter(|title| !title.is_empty()) {
                Some(title) => format!("{title} {}", line(cell)),
                None => line(cell),
            }
        };
        let cells = row.iter().enumerate().map(cell);
        let cells: Vec<String> = cells.filter(|text| !text.is_empty()).collect();
        paragraph(&cells.join("\\quad\n  "), out);
    }
    out.push('\n');
}

/// A paragraph whose first line stands out.
fn paragraph(text: &str, out: &mut String) {
    out.push_str(&format!("\\par\\hangindent=2em {text}\n"));
}

fn equations(equations: &[(Vec<Piece>, Statement)], out: &mut String) {
    for (label, statement) in equations {
        let said = format!(
            "$\\displaystyle {}$",
            breakable(&latex::statement(statement))
        );
        match label.is_empty() {
            true => paragraph(&said, out),
            false => paragraph(&format!("{said}\\quad({})", line(label)), out),
        }
    }
    out.push('\n');
}
