//! A scene file says what a command line says; its mistakes are told at their places.

use lagrange_core::prelude::Impacts;
use lagrange_problems::catalogue;
use lagrange_program::format::RunFormat;
use lagrange_program::request::Request;
use lagrange_program::scene_file::{self, Mistake, Outputs, SceneFile, write};
use std::path::Path;

/// Reads a scene file about a scene of the catalogue.
fn read(text: &str) -> Result<SceneFile, Mistake> {
    scene_file::read(text, Path::new(""), &catalogue::all())
}

const FULL: &str = r#"
scene = "mass-on-wheel"
until = 5
end_after = ["rim lost", "floor"]
max_events = 50
tolerance = 1e-12
method = "dop853"
project = true
impacts = "in_turn"

[parameters]
mu_static = 10
mass = 0.3

[absolute_tolerance]
x = 1e-15

[start]
from = "rest"
theta = 0.1
"der(theta)" = -1

[effects]
grip = false

[outputs]
format = "json"
output = "wheel.json"
plot = "wheel.svg"
ledger = true
samples = 1000
"#;

#[test]
fn a_file_says_what_a_command_line_says() {
    let file = read(FULL).expect("a scene file");
    assert_eq!(file.scene.name(), "mass-on-wheel");
    let pair = |name: &str, value: f64| (name.to_owned(), value);
    let Request {
        parameters,
        from,
        effects,
        start,
        until,
        tolerance,
        absolute,
        method,
        project,
        impacts,
        end_after,
        max_events,
        ledger,
        ..
    } = file.request;
    assert_eq!(parameters, [pair("mass", 0.3), pair("mu_static", 10.0)]);
    assert_eq!(absolute, [pair("x", 1e-15)]);
    assert_eq!(start, [pair("der(theta)", -1.0), pair("theta", 0.1)]);
    assert_eq!(effects, [("grip".to_owned(), false)]);
    assert_eq!(
        (from.as_deref(), until, tolerance),
        (Some("rest"), Some(5.0), 1e-12)
    );
    assert_eq!((method.to_string().as_str(), project), ("dop853", true));
    assert_eq!(impacts, Some(Impacts::InTurn));
    assert_eq!(
        (end_after, max_events, ledger),
        (
            vec!["rim lost".to_owned(), "floor".to_owned()],
            Some(50),
            true
        )
    );
    let outputs = Outputs {
        format: Some(RunFormat::Json),
        output: vec!["wheel.json".into()],
        plot: Some("wheel.svg".into()),
        show: Vec::new(),
        samples: Some(1000),
    };
    assert_eq!(file.outputs, outputs);
}

#[test]
fn what_is_written_is_read_again() {
    let file = read(FULL).expect("a scene file");
    let text =
        write(file.scene, &file.request, &file.outputs, Path::new("")).expect("it can be written");
    let again = read(&text).expect("a scene file");
    assert_eq!(
        format!("{:?}", again.request),
        format!("{:?}", file.request)
    );
    assert_eq!(again.outputs, file.outputs);
}

#[test]
fn mistakes_are_told_at_their_place() {
    let told = |text: &str| match read(text) {
        Ok(_) => panic!("nothing is wrong with\n{text}"),
        Err(mistake) => mistake.to_string(),
    };
    let in_wheel = |text: &str| told(&format!("scene = \"mass-on-wheel\"\n{text}"));
    for (found, expected) in [
        (
            told("scene = \"mass-on-whele\""),
            "1:9: no scene is called `mass-on-whele`; did you mean `mass-on-wheel`?",
        ),
        (
            told("until = 2\n"),
            "1:1: which scene? begin with scene = \"…\"",
        ),
        (told(""), "1:1: which scene?"),
        (
            told("scene = 3"),
            "1:9: a text in quotes is expected here, not a number",
        ),
        (
            in_wheel("[parameters]\nmu_statik = 2"),
            "3:1: no parameter is called `mu_statik`; did you mean `mu_static`?",
        ),
        (
            in_wheel("[parameters]\nmass = \"2\""),
            "3:8: a number, without quotes, is expected here, not a text",
        ),
        (
            in_wheel("[parameters]\nmass = 0x10"),
            "3:8: numbers are written in decimal digits",
        ),
        (
            in_wheel("[parameters]\nmass = inf"),
            "3:8: the value must be finite",
        ),
        (
            in_wheel("[parameters]\nmass = 1e999"),
            "3:8: the value must be finite",
        ),
        (
            in_wheel("[parameters]\nuntil = 2"),
            "3:1: `until` stands above the first [table]",
        ),
        (
            in_wheel("parameters = 2"),
            "2:14: a table is expected here, not a number",
        ),
        (
            in_wheel("tolerance = -1"),
            "2:13: the value must be above 0",
        ),
        (in_wheel("tolerance = 1"), "2:13: a tolerance is between"),
        (
            in_wheel("[absolute_tolerance]\nz = 1e-12"),
            "3:1: no coordinate is called `z`",
        ),
        (
            in_wheel("[absolute_tolerance]\nx = 0"),
            "3:5: the value must be above 0",
        ),
        (
            in_wheel("method = \"tayler\""),
            "2:10: no method is called `tayler`; did you mean `taylor`?",
        ),
        (in_wheel("method = \"rk4\""), "2:10: `rk4` has fixed steps"),
        (
            in_wheel("impacts = \"both\""),
            "2:11: impacts are `together` or `in_turn`",
        ),
        (
            in_wheel("end_after = \"rim lots\""),
            "2:13: no event is called `rim lots`; did you mean `rim lost`?",
        ),
        (
            in_wheel("end_after = [\"rim lost\", \"rmi lost\"]"),
            "2:26: no contact, friction, stop or mark is called `rmi`; did you mean `rim`?",
        ),
        (
            in_wheel("end_after = \"rim lost 0\""),
            "2:13: events are counted from 1: `rim lost 2` is the second, and there is no `rim lost 0`",
        ),
        (
            in_wheel("[start]\nfrom = \"rset\""),
            "3:8: no start is called `rset`; did you mean `rest`?",
        ),
        (
            in_wheel("[start]\nform = \"rest\""),
            "3:1: a named start is given as from",
        ),
        (
            in_wheel("[start]\nthta = 1"),
            "3:1: no coordinate or velocity is called `thta`; did you mean `theta`?",
        ),
        (
            in_wheel("[start]\nder(theta) = 1"),
            "a name with brackets stands in quotes: \"der(theta)\" = …",
        ),
        (
            in_wheel("[effects]\ngripp = false"),
            "3:1: no effect is called `gripp`; did you mean `grip`?",
        ),
        (
            in_wheel("[effects]\ngrip = \"false\""),
            "3:8: true or false, without quotes, is expected here",
        ),
        (
            in_wheel("tolerence = 1e-9"),
            "2:1: no key is called `tolerence`; did you mean `tolerance`?",
        ),
        (
            in_wheel("[outputs]\nformat = \"jsn\""),
            "3:10: no format is called `jsn`; did you mean `json`?",
        ),
        (
            in_wheel("[outputs]\nouput = \"a.csv\""),
            "3:1: no output is called `ouput`; did you mean `output`?",
        ),
        (
            in_wheel("[outputs]\nsamples = 0.5"),
            "3:11: a whole number from 1",
        ),
        (in_wheel("[parameters"), "2:"),
        // Of several, the first in the file.
        (in_wheel("until = -1\n[effects]\ngripp = false"), "2:9: "),
    ] {
        assert!(found.contains(expected), "{found}\nis not\n{expected}");
    }
}

#[test]
fn an_error_is_asked_for_and_kept() {
    let file = read("scene = \"kepler\"\nerror = 1e-7\n").expect("a scene file");
    assert_eq!(file.request.error, Some(1e-7));
    let text = write(file.scene, &file.request, &file.outputs, Path::new("")).expect("TOML");
    assert!(!text.contains("tolerance"), "{text}");
    let again = read(&text).expect("a scene file").request;
    assert_eq!((again.error, again.estimate), (Some(1e-7), false));
    let file = read("scene = \"kepler\"\nestimate = true\n").expect("a scene file");
    assert!(file.request.estimate && file.request.error.is_none());
    let mistakes = read("scene = \"kepler\"\nerror = 1\n")
        .map(drop)
        .expect_err("too large");
    assert!(mistakes.to_string().contains("between 1e-15 and 0.1"));
}

/// What a scene file names lies beside it, wherever the program is started, and what is saved names it so.
#[test]
fn paths_begin_in_the_folder_of_the_file() {
    use crate::program::{folder, lagrange_in, text};
    let root = folder("scene-file-paths");
    let runs = root.join("runs");
    std::fs::create_dir(&runs).expect("a folder");
    std::fs::write(runs.join("own.lagrange"), lagrange_program::file::TEMPLATE).expect("a file");
    let says = "scene = \"own.lagrange\"\nuntil = 0.1\n[outputs]\noutput = \"own.csv\"\nplot = \"own.svg\"\n";
    std::fs::write(runs.join("own.toml"), says).expect("a file");
    let runs_from = |place: &Path, arguments: &[&str]| {
        let output = lagrange_in(place, arguments);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    };
    runs_from(
        &root,
        &["run", "runs/own.toml", "--save", "runs/saved.toml"],
    );
    assert!(runs.join("own.csv").is_file() && runs.join("own.svg").is_file());
    let saved = std::fs::read_to_string(runs.join("saved.toml")).expect("a scene file");
    assert!(
        saved.contains("scene = \"own.lagrange\"") && saved.contains("plot = \"own.svg\""),
        "{saved}"
    );
    runs_from(&runs, &["run", "saved.toml"]);
    std::fs::write(
        root.join("above.lagrange"),
        lagrange_program::file::TEMPLATE,
    )
    .expect("a file");
    runs_from(
        &root,
        &["run", "above.lagrange", "--save", "runs/above.toml"],
    );
    let saved = std::fs::read_to_string(runs.join("above.toml")).expect("a scene file");
    assert!(saved.contains("scene = \"../above.lagrange\""), "{saved}");
    runs_from(&runs, &["run", "above.toml"]);
    let output = "scene = \"own.lagrange\"\n[outputs]\noutput = \"own.xyz\"\n";
    std::fs::write(runs.join("own.toml"), output).expect("a file");
    let said = lagrange_in(&runs, &["run", "own.toml"]);
    let said = text(&said.stderr);
    assert!(
        said.contains("own.toml:3:10") && said.contains("own.xyz says no format"),
        "{said}"
    );
}

/// An array of parameters takes one number for all elements, as a declaration in a file gives it.
#[test]
fn a_number_fills_an_array() {
    use crate::program::{folder, lagrange_in, text};
    let place = folder("array-parameter");
    let declared = "parameters(k[2] = [1, 2]), coordinates(x[2]), kinetic = (der(x[0])^2 + der(x[1])^2)/2,
        potential = k[0]/2 * x[0]^2 + k[1]/2 * x[1]^2, observe(first = k[0], second = k[1]), until = 0.1,";
    std::fs::write(place.join("two.lagrange"), declared).expect("a file");
    std::fs::write(
        place.join("two.toml"),
        "scene = \"two.lagrange\"\n[parameters]\nk = 5\n",
    )
    .expect("a file");
    let parameters = |arguments: &[&str]| {
        let output = lagrange_in(&place, &[arguments, &["--format", "json"]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let told: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        [0, 1].map(|i| told["parameters"][format!("k[{i}]")].as_f64())
    };
    assert_eq!(
        parameters(&["run", "two.lagrange", "--set", "k=5"]),
        [Some(5.0); 2]
    );
    assert_eq!(parameters(&["run", "two.toml"]), [Some(5.0); 2]);
    assert_eq!(
        parameters(&["run", "two.toml", "--set", "k[1]=3"]),
        [Some(5.0), Some(3.0)]
    );
}
