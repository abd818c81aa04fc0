//! `lagrange report`: pages are whole, hold the numbers of the run, need no network, and stay small.

mod program;

use expect_test::expect_file;
use lagrange_problems::catalogue::{Scene, scenes};
use lagrange_problems::outcome::forces;
use lagrange_problems::report::html::{self, Shown};
use lagrange_problems::request::Request;
use program::{refuses, says};
use serde_json::Value;

/// The page of a scene as the program writes it.
fn page(scene: &'static dyn Scene) -> String {
    let request = Request::default();
    let samples = html::intervals(scene, &request, 1);
    paged(scene, &Request { samples, ..request })
}

fn shown(scene: &'static dyn Scene, request: &Request) -> Shown {
    Shown {
        title: scene.name().to_owned(),
        film: scene.film(request).expect("a film"),
        derivation: scene.derivation(),
        tolerance: request.tolerance,
        method: request.method,
    }
}

fn paged(scene: &'static dyn Scene, request: &Request) -> String {
    written(&[shown(scene, request)])
}

fn written(runs: &[Shown]) -> String {
    let mut page = Vec::new();
    html::write(runs, None, &mut page).expect("memory");
    String::from_utf8(page).expect("UTF-8")
}

/// The numbers that a page carries.
fn numbers(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"numbers\">").expect("numbers");
    let (text, _) = rest.split_once("</script>").expect("an end");
    serde_json::from_str(text).expect("JSON")
}

/// Names of tags that are opened and not closed in order; what is in scripts and styles is skipped.
fn unclosed(page: &str) -> Vec<&str> {
    let mut open = Vec::new();
    let mut rest = page;
    while let Some((_, tag)) = rest.split_once('<') {
        let (tag, after) = tag.split_once('>').expect("the end of a tag");
        let name = tag.trim_start_matches('/');
        let name = name.split(|c: char| c.is_whitespace()).next().unwrap_or("");
        rest = after;
        if tag.starts_with('!') || tag.ends_with('/') {
            continue;
        }
        if !tag.starts_with('/') {
            open.push(name);
        } else if open.pop() != Some(name) {
            return vec![name];
        }
        if let ("script" | "style", false) = (name, tag.starts_with('/')) {
            let end = after.find("</").expect("an end");
            rest = &after[end..];
        }
    }
    open
}

#[test]
fn every_scene_has_a_page_that_is_whole_and_small() {
    for scene in scenes() {
        let page = page(scene);
        let name = scene.name();
        assert_eq!(unclosed(&page), Vec::<&str>::new(), "{name}");
        assert!(
            !page.contains("http://") && !page.contains("https://"),
            "{name}"
        );
        assert!(!page.contains("{{") && !page.contains("NaN"), "{name}");
        assert!(page.len() < 1_000_000, "{name}: {} bytes", page.len());
        let numbers = numbers(&page);
        let run = &numbers["runs"][0];
        let samples = run["time"].as_array().map_or(0, Vec::len);
        assert!(samples > 100, "{name}: {samples} samples");
        for plot in run["plots"].as_array().expect("plots") {
            let times = plot["time"].as_array().map_or(samples, Vec::len);
            for curve in plot["curves"].as_array().expect("curves") {
                let values = curve["values"].as_array().expect("values");
                assert_eq!(values.len(), times, "{name}: {}", plot["title"]);
            }
        }
    }
}

/// A drawing keeps its shapes, its numbers are finite, and its arrows are those of forces of the scene.
#[test]
fn drawings_are_of_their_scenes() {
    let mut drawn = 0;
    for scene in scenes() {
        let request = Request {
            samples: 100,
            ..Request::default()
        };
        let film = scene.film(&request).expect("a film");
        let Some(first) = film.drawings.first() else {
            continue;
        };
        drawn += 1;
        let name = scene.name();
        let known: Vec<String> = forces(scene.description())
            .into_iter()
            .map(|f| f.name)
            .collect();
        for arrow in &first.arrows {
            assert!(
                known.iter().any(|f| f == arrow.force),
                "{name}: {} in {known:?}",
                arrow.force
            );
        }
        assert_eq!(film.drawings.len(), film.outcome.samples.len());
        for drawing in &film.drawings {
            assert_eq!(drawing.arrows.len(), first.arrows.len(), "{name}");
            assert_eq!(drawing.shapes.len(), first.shapes.len(), "{name}");
            for (shape, other) in drawing.shapes.iter().zip(&first.shapes) {
                assert_eq!(shape.kind(), other.kind(), "{name}");
                assert_eq!(shape.numbers().len(), other.numbers().len(), "{name}");
                assert!(
                    shape.numbers().iter().all(|x| x.is_finite()),
                    "{name}: {shape:?}"
                );
            }
        }
    }
    assert!(drawn == scenes().count(), "only {drawn} scenes are drawn");
}

#[test]
fn a_page_holds_the_numbers_of_the_run() {
    let path = std::env::temp_dir().join(format!("lagrange-report-{}.html", std::process::id()));
    let file = path.to_str().expect("UTF-8");
    says(&[
        "report",
        "mass-on-wheel",
        "mass-on-shell",
        "--without",
        "floor",
        "--until",
        "2.5",
        "--output",
        file,
    ]);
    let page = std::fs::read_to_string(&path).expect("the page");
    std::fs::remove_file(&path).expect("it is ours");
    let numbers = numbers(&page);
    let run = says(&[
        "run",
        "mass-on-wheel",
        "--without",
        "floor",
        "--until",
        "2.5",
        "--format",
        "json",
    ]);
    let run: Value = serde_json::from_str(&run).expect("JSON");
    assert_eq!(numbers["runs"].as_array().map(Vec::len), Some(2));
    let events = numbers["runs"][0]["events"].as_array().expect("events");
    let expected = run["events"].as_array().expect("events");
    assert_eq!(events.len(), expected.len());
    for (event, expected) in events.iter().zip(expected) {
        let (t, exact) = (
            event["time"].as_f64().unwrap(),
            expected["time"].as_f64().unwrap(),
        );
        assert!((t - exact).abs() <= 1e-5 * exact, "{t} is not {exact}");
    }
    assert!(page.contains("<math") && page.contains("Coefficient of static friction."));
}

/// What the player reads, of a short run with few samples.
#[test]
fn the_numbers_of_a_shell() {
    let scene = lagrange_problems::catalogue::find("mass-on-shell").expect("a scene");
    let request = Request {
        samples: 6,
        ..Request::default()
    };
    let numbers = numbers(&paged(scene, &request));
    let mut run = numbers["runs"][0].clone();
    // The energy book is long, and read where it is made.
    run["plots"]
        .as_array_mut()
        .expect("plots")
        .retain(|plot| plot["time"].is_null());
    let text = serde_json::to_string_pretty(&run).expect("JSON") + "\n";
    expect_file!["golden/report-mass-on-shell.json"].assert_eq(&text);
}

#[test]
fn mistakes_are_told() {
    refuses(
        &["report", "mass-on-whele"],
        2,
        "did you mean `mass-on-wheel`?",
    );
    refuses(&["report"], 2, "SCENE");
}
