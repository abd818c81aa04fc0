//! Where the panels stand, and what in them does not move.

use super::{Panel, span};
use crate::film::Film;
use crate::report::one_mode;
use crate::report::picture::palette::{self, colour};
use crate::report::picture::{self, Painter, Picture, WIDTH, label, pictures, stages};
use crate::report::words::Names;
use lagrange_engine::inspect::print::mathml::escaped;
use std::fmt::Write;

/// Between panels, and around them.
const GAP: f64 = 24.0;
/// Size of letters.
pub(super) const LETTER: f64 = 24.0;
/// Height of the bar of modes.
const BAR: f64 = 16.0;

/// The light and the shade on a ball.
const ROUND: &str = "<radialGradient id=\"round\" cx=\".36\" cy=\".3\" r=\".75\"><stop offset=\"0\" stop-color=\"#fff\" \
     stop-opacity=\".45\"/><stop offset=\".4\" stop-color=\"#fff\" stop-opacity=\"0\"/><stop offset=\"1\" \
     stop-opacity=\".45\"/></radialGradient>\n";

/// Units from left to right of so many panels.
pub fn width(panels: usize) -> f64 {
    GAP + panels as f64 * (WIDTH + GAP)
}

/// Everything that does not depend on the instant.
pub(super) struct Layout<'a> {
    pub panels: Vec<Place<'a>>,
    width: f64,
    height: f64,
    pub first: f64,
    pub last: f64,
}

/// A panel and where it stands.
pub(super) struct Place<'a> {
    title: &'a str,
    pub film: &'a Film,
    /// What its modes are called.
    names: Names,
    pub picture: Option<Picture>,
    /// Of a scene in space, in place of a picture.
    pub painter: Option<Painter>,
    pub x: f64,
    pub y: f64,
    /// Of its picture.
    pub height: f64,
    /// Times of the samples, s.
    pub times: Vec<f64>,
}

/// A force as it is seen.
pub(super) struct Seen {
    pub name: String,
    /// From where to where it points: x, y, x, y.
    pub ends: [f64; 4],
    /// In space, where it acts: a dot shows it, since arrows end in front of or behind what they push.
    pub acts: Option<[f64; 2]>,
    /// Where its name stands, if it is long enough for one that covers no other.
    pub label: Option<[f64; 2]>,
}

impl<'a> Layout<'a> {
    pub fn new(panels: &[Panel<'a>]) -> Self {
        let films: Vec<&Film> = panels.iter().map(|panel| panel.film).collect();
        let pictures = pictures(&films);
        let stages = stages(&films).into_iter();
        let painters: Vec<Option<Painter>> = stages.map(|stage| stage.map(Painter::new)).collect();
        let heights = pictures.iter().flatten().map(|picture| picture.height);
        let seen = painters.iter().flatten().map(|painter| painter.view.height);
        let height = heights.chain(seen).fold(0.0, f64::max);
        let top = if panels.len() > 1 {
            GAP + 1.5 * LETTER
        } else {
            GAP
        };
        let (first, last) = span(films.iter().copied());
        type Pair = (Option<Picture>, Option<Painter>);
        let place = |(i, (panel, (picture, painter))): (usize, (&Panel<'a>, Pair))| Place {
            title: panel.title,
            film: panel.film,
            names: Names::of(&panel.film.outcome, films.iter().map(|film| &film.outcome)),
            picture,
            painter,
            x: GAP + i as f64 * (WIDTH + GAP),
            y: top,
            height,
            times: panel.film.outcome.samples.iter().map(|s| s.time).collect(),
        };
        Self {
            panels: panels
                .iter()
                .zip(pictures.into_iter().zip(painters))
                .enumerate()
                .map(place)
                .collect(),
            width: width(panels.len()),
            height: top + height + GAP + BAR + 2.0 * LETTER,
            first,
            last,
        }
    }

    /// The file up to what moves; `style` is added to the look of pictures.
    pub fn open(&self, style: &str) -> String {
        let titles: Vec<&str> = self.panels.iter().map(|panel| panel.title).collect();
        let (width, height, title) = (self.width, self.height, escaped(&titles.join(", ")));
        let look = palette::for_pictures();
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-size=\"{LETTER}\" role=\"img\" aria-label=\"{title}\">\n<title>{title}</title>\n<style>\n\
             svg:root {{ max-width: 100%; max-height: 100%; }}\n{look}{style}</style>\n\
             <rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n"
        );
        if self.panels.iter().any(|panel| panel.painter.is_some()) {
            out.push_str(ROUND);
        }
        for (i, panel) in self.panels.iter().enumerate() {
            let _ = writeln!(
                out,
                "<clipPath id=\"clip{i}\"><rect width=\"{WIDTH}\" height=\"{}\"/></clipPath>",
                panel.height
            );
        }
        out
    }

    /// Part of the bar up to a time, from 0 to 1.
    pub fn part(&self, time: f64) -> f64 {
        let long = self.last - self.first;
        match long > 0.0 {
            true => ((time - self.first) / long).clamp(0.0, 1.0),
            false => 0.0,
        }
    }

    /// The mode of a panel at a time, in words.
    pub fn mode(&self, panel: &Place, time: f64) -> String {
        let outcome = &panel.film.outcome;
        let mut latest_first = outcome.phases.iter().rev();
        let phase = latest_first.find(|phase| phase.from <= time);
        let phase = phase.or(outcome.phases.first());
        let over = outcome.last().is_some_and(|end| time > end.time);
        let one = one_mode(outcome.description);
        match phase {
            Some(_) if one => String::new(),
            Some(phase) if over => format!("{} (ended)", panel.names.brief(&phase.mode)),
            Some(phase) => panel.names.brief(&phase.mode),
            None => String::new(),
        }
    }

    /// Number of a mode among those of all panels.
    fn number(&self, words: &str) -> usize {
        let mut seen: Vec<String> = Vec::new();
        for panel in &self.panels {
            for phase in &panel.film.outcome.phases {
                let other = panel.names.brief(&phase.mode);
                if other == words {
                    return seen.iter().position(|s| *s == other).unwrap_or(seen.len());
                }
                if !seen.contains(&other) {
                    seen.push(other);
                }
            }
        }
        seen.len()
    }
}

/// Words that would leave the picture on the right have smaller letters: an attribute, empty for all others.
pub(super) fn letters(words: &str, x: f64) -> String {
    let (long, room) = (0.6 * LETTER * words.chars().count() as f64, WIDTH - x);
    match long <= room {
        true => String::new(),
        false => format!(" font-size=\"{:.1}\"", LETTER * room / long),
    }
}

impl Place<'_> {
    /// Opens the group of the panel, with its title.
    pub fn open(&self, out: &mut String, titled: bool) {
        let _ = writeln!(out, "<g transform=\"translate({} {})\">", self.x, self.y);
        if titled {
            let title = escaped(self.title);
            let _ = writeln!(
                out,
                "<text class=\"words\" y=\"{}\">{title}</text>",
                -0.5 * LETTER
            );
        }
        if self.picture.is_none() && self.painter.is_none() {
            let y = 0.5 * self.height;
            let _ = writeln!(
                out,
                "<text class=\"words\" x=\"500\" y=\"{y}\" text-anchor=\"middle\">no picture: draw(…) in the declaration says what is \
                 shown</text>"
            );
        }
    }

    /// Height of what is seen, which may be less than that of its panel.
    pub fn seen_height(&self) -> f64 {
        let picture = self.picture.as_ref().map(|picture| picture.height);
        let painter = self.painter.as_ref().map(|painter| painter.view.height);
        picture.or(painter).unwrap_or(self.height)
    }

    /// The forces at a place among the samples.
    pub fn arrows(&self, place: picture::Place) -> Vec<Seen> {
        let height = self.seen_height();
        let mut taken: Vec<[f64; 3]> = Vec::new();
        let seen = |(name, impulse, ends): (String, bool, [f64; 4])| {
            let characters = name.chars().count();
            let half = 0.3 * LETTER * characters as f64;
            let [x1, y1, x2, y2] = ends;
            // Beyond the end where it does not act.
            let away = if impulse { [x2, y2, x1, y1] } else { ends };
            let label = label(away, characters, LETTER, height).filter(|[x, y]| {
                let apart =
                    |[u, v, wide]: &[f64; 3]| (x - u).abs() > half + wide || (y - v).abs() > LETTER;
                taken.iter().all(apart)
            });
            taken.extend(label.map(|[x, y]| [x, y, half]));
            let acts = self.painter.as_ref().map(|_| match impulse {
                true => [x2, y2],
                false => [x1, y1],
            });
            Seen {
                name,
                ends,
                acts,
                label,
            }
        };
        if let Some(painter) = &self.painter {
            return painter.arrows(place).into_iter().map(seen).collect();
        }
        let arrows = self.picture.iter().flat_map(|picture| &picture.arrows);
        let ends = |arrow: &picture::Arrow| {
            let [x, y, dx, dy] = arrow.numbers.each_ref().map(|column| column.at(place));
            (arrow.name.clone(), arrow.impulse, [x, y, x + dx, y + dy])
        };
        arrows.map(ends).map(seen).collect()
    }

    /// What lengths of the picture mean.
    pub fn rulers(&self, out: &mut String) {
        if let Some(painter) = &self.painter {
            let (y, ruler) = (self.height - 16.0, painter.ruler());
            let _ = writeln!(
                out,
                "<text class=\"words\" x=\"16\" y=\"{y:.1}\">{ruler}</text>"
            );
        }
        let Some(picture) = &self.picture else { return };
        let y = picture.height - 16.0;
        let mut x = 16.0;
        for (i, ruler) in picture.rulers.iter().enumerate() {
            let end = x + ruler.length;
            let path = match i {
                0 => format!(
                    "M{x:.1} {:.1}v12M{x:.1} {y:.1}H{end:.1}M{end:.1} {:.1}v12",
                    y - 6.0,
                    y - 6.0
                ),
                _ => format!("M{x:.1} {y:.1}H{end:.1}m-14 -7l14 7l-14 7"),
            };
            let _ = writeln!(
                out,
                "<path class=\"ruler\" d=\"{path}\"/><text class=\"words\" x=\"{x:.1}\" y=\"{:.1}\">{}</text>",
                y - 14.0,
                ruler.text
            );
            x = end.max(x + 0.6 * LETTER * ruler.text.len() as f64) + 2.0 * LETTER;
        }
    }

    /// The bar of modes.
    pub fn bar(&self, layout: &Layout, out: &mut String) {
        let outcome = &self.film.outcome;
        for phase in &outcome.phases {
            let words = self.names.brief(&phase.mode);
            let [from, to] = [phase.from, phase.to].map(|t| WIDTH * layout.part(t));
            let _ = writeln!(
                out,
                "<rect x=\"{from:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{BAR}\" fill=\"{}\"><title>{}</title></rect>",
                self.bar_top(),
                (to - from).max(0.5),
                colour(layout.number(&words)),
                escaped(&words)
            );
        }
    }

    /// Top of the bar.
    pub fn bar_top(&self) -> f64 {
        self.height + 0.5 * GAP
    }

    /// Below the bar: y of what is said there.
    pub fn words_at(&self) -> f64 {
        self.bar_top() + BAR + 1.2 * LETTER
    }
}

/// Height of the mark of the present instant.
pub(super) const CURSOR: f64 = BAR + 8.0;

#[cfg(test)]
mod tests {
    use super::{LETTER, WIDTH, letters};

    #[test]
    fn long_words_stay_in_the_picture() {
        assert_eq!(letters("rim closed, grip slips forward", 9.0 * LETTER), "");
        let words = "wheel[0] closed, ".repeat(8);
        let attribute = letters(&words, 200.0);
        let size: f64 = attribute
            .trim_matches(|c: char| !c.is_ascii_digit())
            .parse()
            .expect("a number");
        let end = 200.0 + 0.6 * size * words.len() as f64;
        assert!((0.98 * WIDTH..1.01 * WIDTH).contains(&end), "{end}");
    }
}
