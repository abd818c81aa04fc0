use super::{Outputs, read, write};
use crate::report::Format;
use crate::request::Request;
use lagrange_core::prelude::Impacts;

const FULL: &str = r#"
scene = "mass-on-wheel"
until = 5
tolerance = 1e-12
method = "dop853"
project = true
impacts = "in_turn"

[parameters]
mu_static = 10
mass = 0.3

[start]
from = "rest"
theta = 0.1
"der(theta)" = -1

[effects]
grip = false

[outputs]
format = "json"
plot = "wheel.svg"
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
        method,
        project,
        impacts,
        ..
    } = file.request;
    assert_eq!(parameters, [pair("mass", 0.3), pair("mu_static", 10.0)]);
    assert_eq!(start, [pair("der(theta)", -1.0), pair("theta", 0.1)]);
    assert_eq!(effects, [("grip".to_owned(), false)]);
    assert_eq!(
        (from.as_deref(), until, tolerance),
        (Some("rest"), Some(5.0), 1e-12)
    );
    assert_eq!((method.to_string().as_str(), project), ("dop853", true));
    assert_eq!(impacts, Some(Impacts::InTurn));
    let outputs = Outputs {
        format: Some(Format::Json),
        output: None,
        plot: Some("wheel.svg".into()),
    };
    assert_eq!(file.outputs, outputs);
}

#[test]
fn what_is_written_is_read_again() {
    let file = read(FULL).expect("a scene file");
    let text = write(file.scene, &file.request, &file.outputs).expect("it can be written");
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
        (told("until = 2\n"), "missing field `scene`"),
        (
            in_wheel("[parameters]\nmu_statik = 2"),
            "3:1: no parameter is called `mu_statik`; did you mean `mu_static`?",
        ),
        (in_wheel("[parameters]\nmass = \"2\""), "3:8: "),
        (
            in_wheel("[parameters]\nmass = inf"),
            "3:8: the value must be finite",
        ),
        (
            in_wheel("tolerance = -1"),
            "2:13: the value must be above 0",
        ),
        (in_wheel("method = \"tayler\""), "2:10: "),
        (
            in_wheel("[start]\nfrom = \"rset\""),
            "3:8: no start is called `rset`; did you mean `rest`?",
        ),
        (
            in_wheel("[start]\nthta = 1"),
            "3:1: no coordinate or velocity is called `thta`; did you mean `theta`?",
        ),
        (
            in_wheel("[effects]\ngripp = false"),
            "3:1: no effect is called `gripp`; did you mean `grip`?",
        ),
        (in_wheel("[effects]\ngrip = \"no\""), "3:8: "),
        (
            in_wheel("tolerence = 1e-9"),
            "2:1: unknown field `tolerence`",
        ),
        (in_wheel("[outputs]\nformat = \"jsn\""), "3:10: "),
        (in_wheel("[parameters"), "2:"),
    ] {
        assert!(found.contains(expected), "{found}\nis not\n{expected}");
    }
}
