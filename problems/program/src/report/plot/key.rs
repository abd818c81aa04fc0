//! The key at the foot: what the numbered tints mean, or the colours of several runs. What is longer than the picture is wide goes on in
//! the next line.

use super::panel::{fitted, sample};
use super::{Area, COLOURS, Drawn, FINE, FOOT, KEY_LINE, LETTER, MARGIN, TINTS, WIDTH, px, words};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// Room before a name: for the tint and the number of a mode, or the colour of a run.
const BEFORE: u32 = 46 * FINE;

/// Names in lines, so many beside each other.
pub(super) struct Key {
    names: Vec<Vec<String>>,
    columns: usize,
    /// Of several runs rather than of the modes of one.
    several: bool,
}

impl Key {
    /// As many columns as the longest name allows.
    pub fn new(names: &[String], several: bool) -> Self {
        let letters = names.iter().map(|name| name.chars().count());
        let width = letters.max().unwrap_or(0) as u32 * LETTER + 50 * FINE;
        let columns = (((WIDTH - 2 * MARGIN) / width) as usize).clamp(1, names.len().max(1));
        let room = (WIDTH - 2 * MARGIN) / columns as u32 - BEFORE;
        Self {
            names: names.iter().map(|name| lines(name, room)).collect(),
            columns,
            several,
        }
    }

    pub fn height(&self) -> u32 {
        let rows = self.names.chunks(self.columns).map(deepest);
        rows.sum::<usize>() as u32 * KEY_LINE + FOOT
    }

    pub fn draw<'a>(&self, area: &Area<'a>) -> Drawn<'a> {
        let style = words(13, &BLACK, HPos::Left, VPos::Center);
        let width = (WIDTH - 2 * MARGIN) as i32 / self.columns as i32;
        let mut y = px(18);
        for (row, names) in self.names.chunks(self.columns).enumerate() {
            for (column, lines) in names.iter().enumerate() {
                let x = MARGIN as i32 + column as i32 * width;
                let index = row * self.columns + column;
                if self.several {
                    sample(area, (x, y), COLOURS[index % COLOURS.len()], 0)?;
                } else {
                    tint(area, (x, y), TINTS[index % TINTS.len()])?;
                    let number = (index + 1).to_string();
                    area.draw(&Text::new(number, (x + px(26), y), style.clone()))?;
                }
                let x = x + BEFORE as i32;
                for (line, text) in lines.iter().enumerate() {
                    let y = y + line as i32 * KEY_LINE as i32;
                    area.draw(&Text::new(text.as_str(), (x, y), style.clone()))?;
                }
            }
            y += (deepest(names) as u32 * KEY_LINE) as i32;
        }
        Ok(())
    }
}

/// Lines of the name that has most.
fn deepest(names: &[Vec<String>]) -> usize {
    names.iter().map(Vec::len).max().unwrap_or(0)
}

/// A text in lines that fit the room, broken between words.
fn lines(text: &str, room: u32) -> Vec<String> {
    let most = (room / LETTER) as usize;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        let word = fitted(word, room);
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

/// The tint of a mode.
fn tint<'a>(area: &Area<'a>, (x, y): (i32, i32), tint: RGBColor) -> Drawn<'a> {
    let corners = [(x, y - px(7)), (x + px(18), y + px(7))];
    area.draw(&Rectangle::new(corners, tint.filled()))?;
    area.draw(&Rectangle::new(corners, BLACK.mix(0.3).stroke_width(FINE)))
}

#[cfg(test)]
mod tests {
    use super::{Key, LETTER, lines};

    #[test]
    fn long_names_go_on_in_the_next_line() {
        let name = "hall and table closed, brake sticks";
        let told = lines(name, 13 * LETTER);
        assert_eq!(told, ["hall and", "table closed,", "brake sticks"]);
        assert_eq!(lines(name, 35 * LETTER), [name]);
        assert_eq!(lines("a of_many_letters", 9 * LETTER), ["a", "of_m…ters"]);
    }

    #[test]
    fn a_key_is_as_high_as_its_lines() {
        let [short, long] = ["open".to_owned(), "open, ".repeat(30)];
        let height = |names: &[&String]| {
            let names: Vec<String> = names.iter().map(|&name| name.clone()).collect();
            Key::new(&names, false).height() - Key::new(&names[..1], false).height()
        };
        assert_eq!(height(&[&short, &short]), 0);
        assert_eq!(height(&[&short, &long]), 2 * super::KEY_LINE);
    }
}
