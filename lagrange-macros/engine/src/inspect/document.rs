//! A derivation as a sequence of blocks, which the printers of whole documents share.

use super::conserved::JACOBI_INTEGRAL;
use super::formula::{Formula, Statement};
use super::letter::Letter;
use super::{Checked, Derivation, Item, Mode, Part};

/// Headings that printers look for.
pub(super) const ENERGIES: &str = "Energies";
pub(super) const MOTION: &str = "Equations of motion (Euler–Lagrange)";

/// A piece of a line.
#[derive(Clone, Debug)]
pub(super) enum Piece {
    /// Words.
    Words(String),
    /// A formula.
    Formula(Formula),
    /// An equation or inequality.
    Statement(Statement),
}

/// A part of a document.
#[derive(Clone, Debug)]
pub(super) enum Block {
    /// A heading of this depth, 1 or 2.
    Heading(usize, String),
    /// A paragraph.
    Paragraph(Vec<Piece>),
    /// Rows of cells that stand below each other.
    Table(Vec<Vec<Vec<Piece>>>),
    /// Equations below each other, each with a label or none.
    Equations(Vec<(Vec<Piece>, Statement)>),
}

fn words(text: impl Into<String>) -> Piece {
    Piece::Words(text.into())
}

fn letter(letter: &Letter) -> Piece {
    Piece::Formula(Formula::Letter(letter.clone()))
}

impl Derivation {
    /// The document.
    pub(super) fn blocks(&self) -> Vec<Block> {
        let mut blocks = vec![Block::Heading(1, self.name.clone())];
        if !self.summary.is_empty() {
            blocks.push(Block::Paragraph(vec![words(&self.summary)]));
        }
        if self.single_mode {
            for mode in &self.modes {
                mode_blocks(mode, &mut blocks);
            }
            return blocks;
        }
        self.declaration(&mut blocks);
        self.equations(&mut blocks);
        self.all_modes(&mut blocks);
        self.impact_blocks(&mut blocks);
        self.conservation(&mut blocks);
        self.check_blocks(&mut blocks);
        self.cost_blocks(&mut blocks);
        for (title, lines) in [("Hints", &self.hints), ("Notes", &self.notes)] {
            if !lines.is_empty() {
                blocks.push(Block::Heading(2, title.to_owned()));
            }
            for line in lines {
                blocks.push(Block::Paragraph(vec![words(line)]));
            }
        }
        blocks
    }

    fn declaration(&self, blocks: &mut Vec<Block>) {
        blocks.push(Block::Heading(2, "Declared".to_owned()));
        let rows = self.declared.iter().map(|item| {
            vec![
                vec![words(item.keyword)],
                vec![words(&item.name)],
                said(item),
            ]
        });
        blocks.push(Block::Table(rows.collect()));
        let rows: Vec<_> = self
            .symbols
            .iter()
            .map(|meaning| {
                let name = match meaning.unit.as_str() {
                    "" => meaning.name.clone(),
                    unit => format!("{} ({unit})", meaning.name),
                };
                vec![
                    vec![letter(&meaning.letter)],
                    vec![words(name)],
                    vec![words(&meaning.text)],
                ]
            })
            .collect();
        if !rows.is_empty() {
            blocks.push(Block::Heading(2, "Parameters".to_owned()));
            blocks.push(Block::Table(rows));
        }
    }

    fn equations(&self, blocks: &mut Vec<Block>) {
        if !self.bodies.is_empty() {
            blocks.push(Block::Heading(2, "Bodies in space".to_owned()));
        }
        for body in &self.bodies {
            blocks.push(Block::Paragraph(vec![words(&body.text)]));
            let definitions = body.definitions.iter();
            blocks.push(Block::Equations(
                definitions.map(|e| (Vec::new(), e.clone())).collect(),
            ));
        }
        blocks.push(Block::Heading(2, ENERGIES.to_owned()));
        let energies = self.energies();
        blocks.push(Block::Equations(
            energies.map(|e| (Vec::new(), e.clone())).collect(),
        ));
        blocks.push(Block::Heading(2, MOTION.to_owned()));
        let equations = self.motion.iter();
        blocks.push(Block::Equations(
            equations
                .map(|equation| (vec![letter(&equation.label)], equation.statement.clone()))
                .collect(),
        ));
        if self.rows.is_empty() {
            return;
        }
        blocks.push(Block::Heading(
            2,
            "Constraints, contacts and slips".to_owned(),
        ));
        let rows = self.rows.iter().map(|row| {
            vec![
                vec![words(&row.name)],
                within(&row.declared, row.region.as_ref()),
                vec![Piece::Statement(row.acceleration.clone())],
                vec![letter(&row.multiplier)],
                vec![words(&row.when)],
            ]
        });
        let header = ["", "declared", "accelerations", "multiplier", "acts"];
        let header = header.map(|title| vec![words(title)]).to_vec();
        blocks.push(Block::Table([header].into_iter().chain(rows).collect()));
    }

    fn all_modes(&self, blocks: &mut Vec<Block>) {
        if self.mode_count < 2 {
            return;
        }
        let count = match self.mode_count {
            few @ 0..1_000_000 => few.to_string(),
            u128::MAX => "more than 1e38".to_owned(),
            many => format!("about {:.0e}", many as f64),
        };
        blocks.push(Block::Heading(2, format!("Modes ({count})")));
        for mode in &self.modes {
            mode_blocks(mode, blocks);
        }
    }

    fn impact_blocks(&self, blocks: &mut Vec<Block>) {
        if !self.impacts.is_empty() {
            blocks.push(Block::Heading(2, "Impacts".to_owned()));
        }
        for impact in &self.impacts {
            let [gap, rate] = &impact.when;
            let mut pieces = vec![words(format!("{}: when ", impact.contact))];
            pieces.push(Piece::Statement(gap.clone()));
            if let Some(region) = &impact.region {
                pieces.extend([words(", "), Piece::Statement(region.clone())]);
            }
            pieces.extend([words(" and "), Piece::Statement(rate.clone())]);
            blocks.push(Block::Paragraph(pieces));
            let equations = impact.equations.iter();
            blocks.push(Block::Equations(
                equations.map(|e| (Vec::new(), e.clone())).collect(),
            ));
            if !impact.note.is_empty() {
                blocks.push(Block::Paragraph(vec![words(&impact.note)]));
            }
        }
    }

    fn conservation(&self, blocks: &mut Vec<Block>) {
        blocks.push(Block::Heading(2, "Conserved".to_owned()));
        let rows = self.conserved.iter().map(|item| {
            let rate = item.rate.iter().cloned().map(Piece::Statement);
            vec![
                vec![words(&item.name)],
                vec![Piece::Statement(item.quantity.clone())],
                rate.collect(),
                vec![words(&item.when)],
            ]
        });
        blocks.push(Block::Table(rows.collect()));
        let jacobi = self.conserved.iter().any(|c| c.name == JACOBI_INTEGRAL);
        if jacobi {
            blocks.push(Block::Paragraph(vec![words(
                "h is the sum of v ∂L/∂v over all coordinates, less L. It stands for the energy here, where T is not made of squares and \
                 products of velocities alone: something moves as it is told to, as a frame that turns, and its work changes T + V.",
            )]));
        }
    }

    fn check_blocks(&self, blocks: &mut Vec<Block>) {
        if self.checks.is_empty() {
            return;
        }
        blocks.push(Block::Heading(2, "Checks".to_owned()));
        let rows = self
            .checks
            .iter()
            .map(|check| vec![vec![words(title(check))], vec![words(&check.outcome)]]);
        blocks.push(Block::Table(rows.collect()));
    }

    fn cost_blocks(&self, blocks: &mut Vec<Block>) {
        blocks.push(Block::Heading(2, "Operations".to_owned()));
        let header = ["effect", "every formula alone", "shared"];
        let header = header.map(|title| vec![words(title)]).to_vec();
        let rows = self.costs.iter().map(|cost| {
            vec![
                vec![words(&cost.name)],
                vec![words(cost.before.to_string())],
                vec![words(cost.after.to_string())],
            ]
        });
        blocks.push(Block::Table([header].into_iter().chain(rows).collect()));
        let table = |header: &[&str], rows: Vec<Vec<String>>| {
            let header = header.iter().map(|title| title.to_string()).collect();
            let cell = |text: String| vec![words(text)];
            let rows = [header].into_iter().chain(rows);
            Block::Table(
                rows.map(|row| row.into_iter().map(cell).collect())
                    .collect(),
            )
        };
        let interpreted = |mode: &Mode| {
            let work = &mode.work;
            vec![
                mode.name.clone(),
                work.operations.to_string(),
                work.with_guards.to_string(),
            ]
        };
        blocks.push(table(
            &["mode", "equations of motion", "with guards"],
            self.modes.iter().map(interpreted).collect(),
        ));
        let of_functions = |mode: &Mode| {
            let own = mode.work.emitted?;
            let numbers = [
                own.constants,
                own.unknowns,
                own.accelerations,
                own.whole,
                own.convolutions,
            ];
            let numbers = numbers.map(|number| number.to_string());
            Some([mode.name.clone()].into_iter().chain(numbers).collect())
        };
        let rows: Vec<Vec<String>> = self.modes.iter().filter_map(of_functions).collect();
        if rows.is_empty() {
            return;
        }
        blocks.push(Block::Paragraph(vec![words(
            "Of modes that have functions of their own: constants, numbers of parameters alone that are computed once for each \
             choice of them; unknowns of the linear system, which is factorized once a step; operations of the motion at a \
             state, and of all that guards read; sums over earlier coefficients (convolutions) for each new one of the \
             Taylor series.",
        )]));
        blocks.push(table(
            &["mode", "constants", "unknowns", "motion", "all", "sums"],
            rows,
        ));
    }
}

/// A check by its name; what it claims stands among the declared items.
fn title(check: &Checked) -> &str {
    match check.name.as_str() {
        "" => &check.claim,
        name => name,
    }
}

/// What holds, and the region in which it does.
fn within(statement: &Statement, region: Option<&Statement>) -> Vec<Piece> {
    let mut pieces = vec![Piece::Statement(statement.clone())];
    if let Some(region) = region {
        pieces.extend([words(" where "), Piece::Statement(region.clone())]);
    }
    pieces
}

fn mode_blocks(mode: &Mode, blocks: &mut Vec<Block>) {
    blocks.push(Block::Heading(3, mode.name.clone()));
    if !mode.known.is_empty() {
        let mut pieces = vec![words("held: ")];
        for (i, known) in mode.known.iter().enumerate() {
            if i > 0 {
                pieces.push(words(", "));
            }
            pieces.push(Piece::Statement(known.clone()));
        }
        blocks.push(Block::Paragraph(pieces));
    }
    let mut pieces = vec![words("unknown: ")];
    for (i, unknown) in mode.unknowns.iter().enumerate() {
        if i > 0 {
            pieces.push(words(", "));
        }
        pieces.push(letter(unknown));
    }
    blocks.push(Block::Paragraph(pieces));
    let equations = mode.equations.iter();
    blocks.push(Block::Equations(
        equations.map(|e| (Vec::new(), e.clone())).collect(),
    ));
    let solution = mode.solution.as_deref().unwrap_or_default();
    if !solution.is_empty() {
        blocks.push(Block::Paragraph(vec![words("hence")]));
        let solution = solution.iter();
        blocks.push(Block::Equations(
            solution.map(|e| (Vec::new(), e.clone())).collect(),
        ));
    }
    let unsolved = mode.unsolved();
    if !unsolved.is_empty() {
        let mut pieces = vec![words("not in closed form, or too long to be written out: ")];
        for (i, unknown) in unsolved.into_iter().enumerate() {
            if i > 0 {
                pieces.push(words(", "));
            }
            pieces.push(letter(unknown));
        }
        blocks.push(Block::Paragraph(pieces));
    }
    if !mode.guards.is_empty() {
        let rows = mode.guards.iter().map(|guard| {
            vec![
                vec![words("while")],
                within(&guard.statement, guard.region.as_ref()),
                vec![words(format!("else {}", guard.otherwise))],
            ]
        });
        blocks.push(Block::Table(rows.collect()));
    }
}

pub(super) fn said(item: &Item) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (i, part) in item.parts.iter().enumerate() {
        let after_word = i > 0 && matches!(item.parts[i - 1], Part::Word(_));
        let piece = match part {
            Part::Word(word) => words(word),
            Part::Formula(formula) => Piece::Formula(formula.clone()),
            Part::Statement(statement) => Piece::Statement(statement.clone()),
        };
        match (i, part) {
            (0, _) => {}
            (_, Part::Word(word)) if word == ":" => {}
            (_, Part::Word(word)) if word.starts_with("restitution") => pieces.push(words(", ")),
            (_, Part::Word(_)) => pieces.push(words(" ")),
            _ if after_word => pieces.push(words(" ")),
            _ => pieces.push(words(", ")),
        }
        pieces.push(piece);
    }
    pieces
}
