//! One file that moves by itself, over and over (SMIL, which browsers play in pages and slides, from `<img>` too).
//!
//! Who prefers reduced motion is shown some instants upon each other instead; so is who prints.

use super::element::{self, Element};
use super::layout::{CURSOR, LETTER, Layout, Place, Seen, letters};
use super::still::{arrows, decimals, marks, reading};
use super::{Clock, Panel};
use crate::report::picture::{self, Form, Stroke, WIDTH, nice};
use lagrange_engine::inspect::print::mathml::escaped;
use std::fmt::Write;

/// Seconds that the last instant stays.
const PAUSE: f64 = 1.0;
/// Instants that a picture without motion has.
const GHOSTS: usize = 6;
/// Readings of the clock, at most.
const READINGS: f64 = 80.0;

const STYLE: &str = ".still { display: none; } .ghost { opacity: .25; }
@media (prefers-reduced-motion: reduce) { .moving { display: none; } .still { display: inline; } }
@media print { .moving { display: none; } .still { display: inline; } }
";

/// The pictures of a clock's instants as one SVG file.
pub fn animated(panels: &[Panel], clock: &Clock) -> String {
    let layout = Layout::new(panels);
    let reel = Reel::new(clock);
    let mut out = layout.open(STYLE);
    for (i, panel) in layout.panels.iter().enumerate() {
        panel.open(&mut out, layout.panels.len() > 1);
        let _ = writeln!(out, "<g clip-path=\"url(#clip{i})\">\n<g class=\"moving\">");
        reel.scene(panel, &mut out);
        out.push_str("</g>\n<g class=\"still\">\n");
        ghosts(panel, &layout, &mut out);
        out.push_str("</g>\n");
        panel.rulers(&mut out);
        out.push_str("</g>\n");
        panel.bar(&layout, &mut out);
        out.push_str("<g class=\"moving\">\n");
        reel.below(panel, &layout, &mut out);
        out.push_str("</g>\n</g>\n");
    }
    out + "</svg>\n"
}

/// Some instants upon each other, the last one in full.
fn ghosts(panel: &Place, layout: &Layout, out: &mut String) {
    out.push_str("<g class=\"ghost\">\n");
    for k in 0..GHOSTS - 1 {
        let part = k as f64 / (GHOSTS - 1) as f64;
        marks(
            panel,
            layout.first + part * (layout.last - layout.first),
            out,
        );
    }
    out.push_str("</g>\n");
    marks(panel, layout.last, out);
    arrows(panel, layout.last, out);
}

/// The instants that are shown, equally long each.
struct Reel {
    instants: Vec<f64>,
    /// Of all, s.
    seconds: f64,
}

impl Reel {
    fn new(clock: &Clock) -> Self {
        let last = clock.instants.last().copied().unwrap_or(0.0);
        let hold = (PAUSE * clock.rate).ceil() as usize;
        let instants: Vec<f64> = clock
            .instants
            .iter()
            .copied()
            .chain(vec![last; hold])
            .collect();
        Self {
            seconds: (instants.len() - 1) as f64 / clock.rate,
            instants,
        }
    }

    fn scene(&self, panel: &Place, out: &mut String) {
        let places = self.instants.iter();
        let places: Vec<picture::Place> = places
            .map(|t| picture::Place::of(*t, &panel.times))
            .collect();
        let height = panel.seen_height();
        if let Some(painter) = &panel.painter {
            painter.grid(out);
            self.solids(&places, |place, out| painter.below(place, out), out);
            for trace in &painter.traces {
                self.trace(trace, out);
            }
            self.solids(&places, |place, out| painter.above(place, out), out);
        }
        for mark in panel.picture.iter().flat_map(|picture| &picture.marks) {
            if let Form::Trace { strokes } = &mark.form {
                self.trace(strokes, out);
                continue;
            }
            let elements = places.iter();
            let elements = elements.map(|place| element::mark(mark, *place, height));
            self.at_times(&elements.collect::<Vec<_>>(), out);
        }
        let arrows: Vec<Vec<Seen>> = places.iter().map(|place| panel.arrows(*place)).collect();
        for i in 0..arrows.first().map_or(0, Vec::len) {
            let dots = arrows.iter().map(|arrows| element::dot(i, &arrows[i]));
            self.at_times(&dots.collect::<Vec<_>>(), out);
            let all = arrows.iter().map(|arrows| element::arrow(i, &arrows[i]));
            let (arrows, names): (Vec<_>, Vec<_>) = all.map(|[arrow, name]| (arrow, name)).unzip();
            self.at_times(&arrows, out);
            self.at_times(&names, out);
        }
    }

    /// An element that is not always there: where it is not it waits, unseen, at the next place that it has, or the last.
    fn at_times(&self, elements: &[Option<Element>], out: &mut String) {
        let seen = self.seen(&elements.iter().map(Option::is_some).collect::<Vec<_>>());
        let mut next = elements.iter().flatten().next_back().cloned();
        let mut placed: Vec<Element> = Vec::new();
        for element in elements.iter().rev() {
            next = element.clone().or(next);
            placed.extend(next.clone());
        }
        placed.reverse();
        self.moving(&placed, &seen, out);
    }

    /// Solids in space: a picture for every instant, as their order from the back to the front changes.
    fn solids(
        &self,
        places: &[picture::Place],
        paint: impl Fn(picture::Place, &mut String),
        out: &mut String,
    ) {
        let mut pictures: Vec<(String, Vec<bool>)> = Vec::new();
        for (k, place) in places.iter().enumerate() {
            let mut picture = String::new();
            paint(*place, &mut picture);
            if pictures.last().is_none_or(|(last, _)| *last != picture) {
                pictures.push((picture, vec![false; places.len()]));
            }
            if let Some((_, seen)) = pictures.last_mut() {
                seen[k] = true;
            }
        }
        for (picture, seen) in pictures {
            let hidden = if seen[0] {
                ""
            } else {
                " visibility=\"hidden\""
            };
            let _ = writeln!(out, "<g{hidden}>{}\n{picture}</g>", self.seen(&seen));
        }
    }

    /// An element with all that it does.
    fn moving(&self, elements: &[Element], inside: &str, out: &mut String) {
        let Some(first) = elements.first() else {
            return;
        };
        let mut inside = inside.to_owned();
        for (k, (name, value)) in first.moving.iter().enumerate() {
            let values: Vec<&str> = elements.iter().map(|e| e.moving[k].1.as_str()).collect();
            if values.iter().any(|other| other != value) {
                inside.push_str(&self.animate(name, &values));
            }
        }
        first.write(&inside, out);
    }

    /// A path that grows: what is new of it at each instant stays from then on.
    fn trace(&self, strokes: &[Stroke], out: &mut String) {
        for (k, pair) in self.instants.windows(2).enumerate() {
            let Some(new) = element::trace(strokes, pair[0], pair[1]) else {
                continue;
            };
            let seen: Vec<bool> = (0..self.instants.len()).map(|i| i > k).collect();
            let _ = write!(out, "<g visibility=\"hidden\">{}", self.seen(&seen));
            new.write("", out);
            out.push_str("</g>\n");
        }
    }

    /// The mark of the present instant, the time, and the mode in words.
    fn below(&self, panel: &Place, layout: &Layout, out: &mut String) {
        let (top, y) = (panel.bar_top() - 4.0, panel.words_at());
        let places = self.instants.iter();
        let places: Vec<String> = places
            .map(|t| format!("{:.1} 0", WIDTH * layout.part(*t)))
            .collect();
        let _ = writeln!(
            out,
            "<path class=\"cursor\" d=\"M0 {top:.1}v{CURSOR}\"><animateTransform attributeName=\"transform\" type=\"translate\" \
             {} values=\"{}\"/></path>",
            self.timing(),
            places.join(";")
        );
        let step = nice(2.5 * (layout.last - layout.first) / READINGS);
        let decimals = decimals(step).saturating_sub(3);
        let readings = self
            .instants
            .iter()
            .map(|t| reading((t / step).floor() * step, decimals));
        self.words(&readings.collect::<Vec<_>>(), 0.0, y, out);
        let modes = self.instants.iter().map(|t| layout.mode(panel, *t));
        self.words(&modes.collect::<Vec<_>>(), 9.0 * LETTER, y, out);
    }

    /// Words that change.
    fn words(&self, said: &[String], x: f64, y: f64, out: &mut String) {
        let mut different: Vec<&String> = Vec::new();
        for words in said {
            if !different.contains(&words) {
                different.push(words);
            }
        }
        for words in different {
            let seen: Vec<bool> = said.iter().map(|other| other == words).collect();
            let _ = writeln!(
                out,
                "<text class=\"words\" x=\"{x:.1}\" y=\"{y:.1}\"{}{}>{}{}</text>",
                letters(words, x),
                if seen[0] {
                    ""
                } else {
                    " visibility=\"hidden\""
                },
                escaped(words),
                self.seen(&seen)
            );
        }
    }

    /// When something is seen.
    fn seen(&self, seen: &[bool]) -> String {
        let mut times = vec!["0".to_owned()];
        let word = |seen: bool| if seen { "visible" } else { "hidden" };
        let mut values = vec![word(seen.first() == Some(&true))];
        for (k, pair) in seen.windows(2).enumerate() {
            if pair[0] != pair[1] {
                times.push(format!("{:.5}", (k + 1) as f64 / (seen.len() - 1) as f64));
                values.push(word(pair[1]));
            }
        }
        if values == ["visible"] {
            return String::new();
        }
        format!(
            "<animate attributeName=\"visibility\" calcMode=\"discrete\" {} keyTimes=\"{}\" values=\"{}\"/>",
            self.timing(),
            times.join(";"),
            values.join(";")
        )
    }

    fn animate(&self, attribute: &str, values: &[&str]) -> String {
        let values = values.join(";");
        format!(
            "<animate attributeName=\"{attribute}\" {} values=\"{values}\"/>",
            self.timing()
        )
    }

    fn timing(&self) -> String {
        format!("dur=\"{:.3}s\" repeatCount=\"indefinite\"", self.seconds)
    }
}
