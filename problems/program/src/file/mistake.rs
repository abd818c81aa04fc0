//! Mistakes of a file, each with its line and a mark under what is wrong.

use core::fmt;
use lagrange_engine::diagnostics::{Diagnostic, Diagnostics};

/// All mistakes that the first stage with mistakes has found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistakes {
    told: Vec<String>,
    /// How many others there are.
    more: usize,
}

/// So many are told.
const MOST: usize = 20;

/// A longer line is cut around what is wrong.
const WIDEST: usize = 100;

impl Mistakes {
    pub(super) fn new(path: &str, text: &str, found: &Diagnostics) -> Self {
        let told = found.iter().take(MOST).map(|one| told(path, text, one));
        Self {
            told: told.collect(),
            more: found.count().saturating_sub(MOST),
        }
    }
}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told.join("\n"))?;
        match self.more {
            0 => Ok(()),
            more => write!(f, "\n… and {more} more"),
        }
    }
}

impl core::error::Error for Mistakes {}

/// A character as it is shown: none of them commands a terminal.
fn visible(c: char) -> char {
    match c.is_control() && c != '\t' {
        true => char::REPLACEMENT_CHARACTER,
        false => c,
    }
}

/// ```text
/// spring.lagrange:4:13: `stifness` is not known; did you mean `stiffness`? [E201]
///   4 | potential = stifness/2 * x^2,
///     |             ^^^^^^^^
/// ```
fn told(path: &str, text: &str, mistake: &Diagnostic) -> String {
    let (start, end) = (mistake.extent.start.start(), mistake.extent.end.end());
    let hint = match mistake.hint.as_str() {
        "" => String::new(),
        hint => format!("; {hint}"),
    };
    let said: String = format!("{}{hint}", mistake.message)
        .chars()
        .map(visible)
        .collect();
    let (number, column) = (start.line.to_string(), start.column);
    let line: Vec<char> = text
        .lines()
        .nth(start.line - 1)
        .unwrap_or_default()
        .chars()
        .map(visible)
        .collect();
    let last = match end.line == start.line {
        true => end.column,
        false => line.len(),
    };
    let from = match line.len() > WIDEST {
        true => column.saturating_sub(WIDEST / 2),
        false => 0,
    };
    let shown: String = line.iter().skip(from).take(WIDEST).collect();
    let mark = last.saturating_sub(column).clamp(1, WIDEST);
    // A tab before the mark keeps its width.
    let blank = |c: &char| if *c == '\t' { '\t' } else { ' ' };
    let before: String = line.iter().take(column).skip(from).map(blank).collect();
    format!(
        "{path}:{number}:{}: {said} [{}]\n  {number} | {shown}\n  {} | {before}{}",
        column + 1,
        mistake.code,
        " ".repeat(number.len()),
        "^".repeat(mark)
    )
}
