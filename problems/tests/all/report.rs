//! `lagrange report`: pages are whole, hold the numbers of the run, need no network, and stay small.

use crate::markup::unclosed;
use crate::program::{folder, lagrange, path, refuses, says, text};
use expect_test::expect_file;
use lagrange_problems::catalogue::{self, scenes};
use lagrange_program::report::html::{self, Shown};
use lagrange_program::request::Request;
use lagrange_program::scene::Scene;
use lagrange_program::space::{Solid, Space};
use serde_json::Value;

/// The page of a scene as the program writes it.
fn page(scene: &'static dyn Scene) -> String {
    let request = Request::default();
    let samples = html::intervals(scene.description(), scene.until(), 1);
    paged(scene, &Request { samples, ..request })
}

fn shown(scene: &'static dyn Scene, request: &Request) -> Shown {
    Shown {
        title: scene.name().to_owned(),
        film: scene.film(request).expect("a film"),
        derivation: scene.derivation(),
        failure: None,
    }
}

fn paged(scene: &'static dyn Scene, request: &Request) -> String {
    written(&[shown(scene, request)])
}

fn written(runs: &[Shown]) -> String {
    let mut page = Vec::new();
    html::write(runs, None, None, &mut page).expect("memory");
    String::from_utf8(page).expect("UTF-8")
}

/// The numbers that a page carries.
fn numbers(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"numbers\">").expect("numbers");
    let (text, _) = rest.split_once("</script>").expect("an end");
    serde_json::from_str(text).expect("JSON")
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
        assert!(page.len() < 700_000, "{name}: {} bytes", page.len());
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
        let name = scene.name();
        let rows = scene.description().rows.len();
        if let Some(first) = film.spaces.first() {
            drawn += 1;
            check_spaces(name, rows, first, &film.spaces);
            assert_eq!(film.spaces.len(), film.outcome.samples.len());
            assert!(
                film.drawings.is_empty(),
                "{name} is in a plane and in space"
            );
        }
        let Some(first) = film.drawings.first() else {
            continue;
        };
        drawn += 1;
        for (row, _) in first.arrows.iter().flat_map(|arrow| &arrow.parts) {
            assert!(*row < rows, "{name}: {row} of {rows}");
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

fn check_spaces(name: &str, rows: usize, first: &Space, spaces: &[Space]) {
    for (row, _) in first.arrows.iter().flat_map(|arrow| &arrow.parts) {
        assert!(*row < rows, "{name}: {row} of {rows}");
    }
    for space in spaces {
        assert_eq!(space.arrows.len(), first.arrows.len(), "{name}");
        assert_eq!(space.solids.len(), first.solids.len(), "{name}");
        for (solid, other) in space.solids.iter().zip(&first.solids) {
            assert_eq!(solid.kind(), other.kind(), "{name}");
            assert_eq!(solid.size(), other.size(), "{name}");
            assert_eq!(solid.places().len(), other.places().len(), "{name}");
            let mut numbers = solid
                .places()
                .into_iter()
                .flat_map(|place| [place.x, place.y, place.z]);
            assert!(numbers.all(f64::is_finite), "{name}: {solid:?}");
            assert!(
                solid.turn().is_none_or(|turn| turn.norm().is_finite()),
                "{name}: {solid:?}"
            );
        }
    }
}

/// Bodies that stand or roll on the ground touch it and do not go through it.
#[test]
fn solids_rest_on_the_ground() {
    for name in [
        "table",
        "rattleback",
        "cue-ball",
        "rolling-disk",
        "turning-push",
    ] {
        let request = Request {
            samples: 50,
            ..Request::default()
        };
        let film = catalogue::all()
            .find(name)
            .expect("a scene")
            .film(&request)
            .expect("a film");
        for space in &film.spaces {
            let lowest = |solid: &Solid| {
                let body = solid.places()[0].z - solid.reach().z;
                // The half of an ellipsoid that is there is the lower one.
                matches!(
                    solid,
                    Solid::Box(..)
                        | Solid::Disc(..)
                        | Solid::HalfEllipsoid(..)
                        | Solid::RolledBall(..)
                )
                .then_some(body)
            };
            let low = space
                .solids
                .iter()
                .filter_map(lowest)
                .fold(f64::INFINITY, f64::min);
            // The disk is drawn thicker than it is.
            assert!(low.abs() < 3e-3, "{name}: {low}");
        }
    }
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
    let scene = catalogue::all().find("mass-on-shell").expect("a scene");
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

/// Each mode that the run was in, and no other: its equations, and what ends it in words and as a formula.
#[test]
fn modes_of_the_run_are_written_out() {
    let wheel = catalogue::all().find("mass-on-wheel").expect("a scene");
    let page = page(wheel);
    for part in [
        "<h4>rim closed, grip sticks</h4>\n<p>From 0.000000 s to 2.461759 s.</p>",
        "<h4>rim closed, grip slips forward</h4>",
        "<h4>rim open</h4>",
        "static friction of grip suffices</th>",
        "<th scope=\"row\">friction grip on rim</th>",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("slips backward"));
    for scene in scenes() {
        let request = Request {
            samples: 10,
            ..Request::default()
        };
        let page = paged(scene, &request);
        assert!(
            page.contains("<h3>Equations of motion</h3>"),
            "{}",
            scene.name()
        );
        assert!(!page.contains("not written out"), "{}", scene.name());
    }
}

/// A run without an item has the equations of a declaration without it.
#[test]
fn what_is_left_out_is_not_in_the_equations() {
    let wheel = catalogue::all().find("mass-on-wheel").expect("a scene");
    let without = Request {
        effects: vec![("grip".to_owned(), false)],
        samples: 10,
        ..Request::default()
    };
    let page = paged(wheel, &without);
    let (_, equations) = page.split_once("<h2>Equations</h2>").expect("equations");
    let (equations, _) = equations.split_once("</section>").expect("an end");
    assert!(equations.contains("<h4>rim closed</h4>"));
    assert!(equations.contains("<mi>rim</mi>") && !equations.contains("grip"));
}

/// A page says why a run failed as the terminal does, with the parameter that is the cause.
#[test]
fn a_page_has_the_cause_of_a_failure() {
    let folder = folder("report-failed");
    let [file, page] = ["rod.lagrange", "rod.html"].map(|name| folder.join(name));
    // A rod slides on its tip: Painlevé's paradox, for a friction that is large enough.
    let declared = "parameters(g = 9.81, mu = 0.4), coordinates(x, y, phi),
        define(tip = [x - cos(phi), y - sin(phi)]),
        kinetic = (der(x)^2 + der(y)^2)/2 + der(phi)^2/6, potential = g*y,
        contact(floor: tip[1] >= 0), friction(grip on floor: slip = der(tip[0]), static = mu),
        start(pushed: y = sin(1), phi = 1, der(x) = -1), until = 0.01,";
    std::fs::write(&file, declared).expect("a file");
    let run = [
        "report",
        path(&file),
        "--set",
        "mu=2",
        "--output",
        path(&page),
    ];
    let ended = lagrange(&run);
    let told = text(&ended.stderr);
    let cause = "the cause is `mu` = 2 ";
    assert!(told.contains(cause), "{told}");
    let page = std::fs::read_to_string(&page).expect("the page");
    assert!(page.contains(cause), "{told}");
}

/// What the certificate refuses stands above all else on the page.
#[test]
fn a_page_says_at_its_top_that_a_run_is_not_certified() {
    let page = folder("report-loose").join("crank.html");
    let run = [
        "report",
        "slider-crank",
        "--method",
        "rk4:0.02",
        "--tolerance",
        "1e-6",
    ];
    let ended = lagrange(&[&run[..], &["--output", path(&page)]].concat());
    assert_eq!(ended.status.code(), Some(1));
    let page = std::fs::read_to_string(&page).expect("the page");
    assert!(
        page.contains("<p class=\"failure\">Not certified: "),
        "{page}"
    );
}

/// On one picture scale, with the distance from the first run: 0 while both stick, exact to what a page shows.
#[test]
fn runs_of_a_scene_are_compared() {
    let wheel = catalogue::all().find("mass-on-wheel").expect("a scene");
    let at = |tolerance| Request {
        samples: 200,
        tolerance,
        ..Request::default()
    };
    let page = written(&[shown(wheel, &at(1e-9)), shown(wheel, &at(1e-4))]);
    let runs = numbers(&page)["runs"].clone();
    let height = |run: usize| runs[run]["picture"]["height"].clone();
    assert_eq!(height(0), height(1));
    assert!(runs[0]["phase"][3].get("apart").is_none());
    let apart = runs[1]["phase"][3]["apart"]
        .as_array()
        .expect("differences");
    let largest = apart
        .iter()
        .filter_map(Value::as_f64)
        .fold(0.0, |a: f64, x| a.max(x.abs()));
    assert!((1e-7..1e-2).contains(&largest), "{largest}");
}

#[test]
fn mistakes_are_told() {
    let refused = |change: &str, reason: &str| {
        refuses(&["report", "mass-on-wheel", "--compare", change], 2, reason);
    };
    refused("witout:grip", "did you mean `without:`?");
    refused("without:gripp", "did you mean `grip`?");
    refused(
        "foo",
        "there are without:ITEM, with:ITEM, set:NAME=VALUE, start:NAME=VALUE, from:START, until:T, tolerance:X, method:M",
    );
    refuses(
        &["report", "mass-on-whele"],
        2,
        "did you mean `mass-on-wheel`?",
    );
    refuses(&["report"], 2, "SCENE");
}
