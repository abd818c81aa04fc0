//! Films → one HTML page that needs nothing else: pictures that move, plots, tables and equations of one run or several.
//!
//! Tables and equations are written here; what moves is drawn by the script from the numbers that the page carries.

mod curves;
mod data;
mod difference;
mod digits;
mod equations;
mod fine;
mod tables;

use crate::film::Film;
use crate::report::frames::Panel;
use crate::report::picture::palette;
use data::data;
use lagrange_core::prelude::*;
use lagrange_core::system::Description;
use lagrange_engine::inspect::print::mathml::escaped;
use std::io::{self, Write};

/// A run and what the page says about it beside its film.
pub struct Shown {
    /// Title of the run.
    pub title: String,
    /// The film.
    pub film: Film,
    /// What was derived for the scene.
    pub derivation: &'static Derivation,
    /// Why the run failed, if it has.
    pub failure: Option<String>,
}

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("style.css");
const SCRIPTS: [&str; 13] = [
    include_str!("elements.js"),
    include_str!("follow.js"),
    include_str!("picture.js"),
    include_str!("plots.js"),
    include_str!("equations.js"),
    include_str!("vectors.js"),
    include_str!("meshes.js"),
    include_str!("camera.js"),
    include_str!("webgl.js"),
    include_str!("painted.js"),
    include_str!("space.js"),
    include_str!("comparison.js"),
    include_str!("player.js"),
];

impl Shown {
    /// What frames need of it.
    pub fn panel(&self) -> Panel<'_> {
        Panel {
            title: &self.title,
            film: &self.film,
        }
    }
}

/// At how many intervals a page with so many runs shows one of them, which may take so many seconds: thirty a second, as far as its
/// size allows.
pub fn intervals(description: &Description, duration: f64, runs: usize) -> usize {
    const PER_SECOND: f64 = 30.0;
    /// Numbers that a page may carry; each takes about eight bytes.
    const NUMBERS: usize = 70_000;
    /// Numbers for one run, at most.
    const MOST: usize = 50_000;
    let per_sample = 10 + 6 * description.coordinates.len() + 3 * description.rows.len();
    let most = NUMBERS / runs.max(1);
    let most = (most.min(MOST) / per_sample).clamp(150, 3000);
    ((PER_SECOND * duration) as usize).clamp(most.min(900), most)
}

/// Writes the page; it plays at this speed, or at one that suits. `command` is what made it, told at its end.
///
/// # Errors
/// Of `out`.
pub fn write(
    runs: &[Shown],
    speed: Option<f64>,
    command: Option<&str>,
    mut out: impl Write,
) -> io::Result<()> {
    let numbers = data(runs, speed);
    // A script ends at the first `</`, whatever it is in.
    let numbers = serde_json::to_string(&numbers)
        .map_err(io::Error::from)?
        .replace('<', "\\u003c");
    let titles: Vec<&str> = runs.iter().map(|run| run.title.as_str()).collect();
    let sections = runs.iter().enumerate();
    let sections: String = sections.map(|run| section(run, runs.len() > 1)).collect();
    let title = escaped(&titles.join(" · "));
    // Of a single run the name stands over its section.
    let header = match runs.len() {
        1 => String::new(),
        _ => format!("<header>\n<h1>{title}</h1>\n</header>"),
    };
    let command = command.map(|command| {
        format!(
            "<p class=\"command\">Made by <code>{}</code> <button type=\"button\" class=\"copy\" hidden=\"hidden\">Copy</button></p>\n",
            escaped(command)
        )
    });
    let parts = [
        ("title", title),
        ("header", header),
        ("command", command.unwrap_or_default()),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("style", palette::for_pages() + STYLE),
        ("runs", sections),
        ("numbers", numbers),
        ("script", SCRIPTS.concat()),
    ];
    let mut rest = PAGE;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        let part = parts.iter().find(|(part, _)| *part == name);
        out.write_all(before.as_bytes())?;
        out.write_all(part.map_or("", |(_, text)| text).as_bytes())?;
        rest = after;
    }
    out.write_all(rest.as_bytes())
}

/// All about one run; the script finds its places by their class.
fn section((index, run): (usize, &Shown), several: bool) -> String {
    let id = format!("run{index}");
    let title = escaped(&run.title);
    let summary = run.film.outcome.description.documentation.trim();
    let summary = escaped(summary.lines().next().unwrap_or_default().trim());
    let certificate = run.film.outcome.certificate.as_ref();
    let falls_short = certificate.filter(|certificate| !certificate.holds());
    let failed = |told| format!("<strong>The run failed:</strong> {}", escaped(told));
    let failure = (run.failure.as_deref().map(failed))
        .or(falls_short.map(|certificate| escaped(&certificate.to_string())));
    let failure = failure.map(|told| format!("<p class=\"failure\">{told}</p>\n"));
    let failure = failure.unwrap_or_default();
    let level = if several { "h2" } else { "h1" };
    let mut equations = equations::equations(run);
    if !several {
        // One level up, as the name of the run is.
        for level in 3..=5 {
            for tag in ["<h", "</h"] {
                let (from, to) = (format!("{tag}{level}>"), format!("{tag}{}>", level - 1));
                equations = equations.replace(&from, &to);
            }
        }
    }
    let tables = tables::tables(run);
    format!(
        "<section class=\"run\" aria-labelledby=\"{id}\">\n<{level} id=\"{id}\">{title}</{level}>\n<p>{summary}</p>\n{failure}\
         <div class=\"watch\">\n<div class=\"seen\">\n<div class=\"stage\"></div>\n<p class=\"mode\"></p>\n<div class=\"timeline\"></div>\n</div>\n<div class=\"plots\"></div>\n</div>\n\
         {tables}{equations}</section>\n"
    )
}

/// A number with the sign that is as wide as a plus.
fn minus(number: &str) -> String {
    number.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::{Shown, data, tables};
    use crate::file;
    use crate::request::Request;
    use serde_json::Value;

    fn shown(declared: &str) -> Shown {
        let scene = file::scene("shown.lagrange", declared).expect("a declaration");
        let request = Request {
            samples: 30,
            ..Request::default()
        };
        Shown {
            title: "shown".to_owned(),
            film: scene.film(&request).expect("a run"),
            derivation: scene.derivation(),
            failure: None,
        }
    }

    /// y = 5 − 5 t² strikes at 1 s with 10 m/s and leaves with 5 m/s: 75 of 100 J are lost, and the impulse is 2 kg · 15 m/s.
    #[test]
    fn what_an_impact_changes_jumps() {
        let run = shown(
            "parameters(mass: \"kg\" = 2, gravity: \"m/s^2\" = 10), coordinates(y: \"m\"),
             kinetic = mass/2 * der(y)^2, potential = mass * gravity * y,
             contact(floor: y >= 0, restitution = 1/2), start(up: y = 5), until = 1.5,",
        );
        let page = serde_json::to_value(data(std::slice::from_ref(&run), None)).expect("numbers");
        let told = &page["runs"][0];
        let numbers = |value: &Value| -> Vec<f64> {
            let list = value.as_array().expect("a list").iter();
            list.map(|x| x.as_f64().expect("a number")).collect()
        };
        let jump = |times: &[f64]| {
            let at = times.windows(2).position(|pair| pair[0] == pair[1]);
            at.expect("both sides of the impact")
        };
        let times = numbers(&told["time"]);
        let (i, v) = (jump(&times), numbers(&told["phase"][0]["v"]));
        assert_eq!([times[i], v[i], v[i + 1]], [1.0, -10.0, 5.0]);
        let plots = told["plots"].as_array().expect("plots");
        let titles: Vec<&str> = plots.iter().filter_map(|p| p["title"].as_str()).collect();
        assert_eq!(titles, ["Energy", "Work since the start"]);
        let times = numbers(&plots[1]["time"]);
        let (i, work) = (jump(&times), numbers(&plots[1]["curves"][0]["values"]));
        assert_eq!([times[i], work[i], work[i + 1]], [1.0, 0.0, -75.0]);
        let tables = tables::tables(&run);
        assert!(tables.contains("<td>30.000 N s</td>"), "{tables}");
        assert!(!tables.contains("meaning"), "{tables}");
    }

    /// Ten steps of which a ball meets the highest only, which is declared last.
    #[test]
    fn forces_that_act_are_shown_however_many_do_not() {
        let run = shown(
            "coordinates(y), kinetic = der(y)^2/2, potential = 10 * y,
             contact(step[k in 0..10]: y >= k - 9), start(up: y = 1), until = 1,",
        );
        let page = serde_json::to_value(data(std::slice::from_ref(&run), None)).expect("numbers");
        let curves = &page["runs"][0]["plots"][0]["curves"];
        assert_eq!(curves.as_array().map(Vec::len), Some(1), "{curves}");
        assert_eq!(curves[0]["name"], "step[9]");
        let tables = tables::tables(&run);
        let head = |k: usize| tables.contains(&format!("<th scope=\"col\">step[{k}]</th>"));
        assert_eq!([head(0), head(9)], [false, true], "{tables}");
    }

    /// A block that is pulled harder than its friction holds never sticks.
    #[test]
    fn forces_at_the_start_are_those_with_which_the_motion_begins() {
        let run = shown(
            "coordinates(a), kinetic = der(a)^2/2, force(pull: a = 5),
             friction(rub: slip = der(a), limit = 2), start(rest: a = 0), until = 1,",
        );
        let tables = tables::tables(&run);
        assert!(tables.contains("<td>−2.0000</td>"), "{tables}");
        assert!(!tables.contains("−5.0000"), "{tables}");
    }

    /// A train of 30 m/s passes two posts that are 12 m apart, 36 000 km from where it starts.
    #[test]
    fn events_that_follow_each_other_closely_can_be_told_apart() {
        let run = shown(
            "parameters(m = 2), coordinates(x), kinetic = m/2*der(x)^2, mark(first: x - 36000000), mark(second: x - 36000012),
             start(go: der(x) = 30), until = 1200001",
        );
        let tables = tables::tables(&run);
        for cell in [
            ">1200000.000000<",
            ">1200000.400000<",
            "<td>36000000</td>",
            "<td>36000012</td>",
            "<td>900.00</td>",
        ] {
            assert!(tables.contains(cell), "{cell}: {tables}");
        }
    }
}
