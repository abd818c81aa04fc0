//! Values of a file are read; its mistakes are shown where they are; hostile files end in an error.

use super::{Refused, TEMPLATE, read, scene, type_name};
use crate::request::Request;
use lagrange_core::prelude::Error;

#[test]
fn names_of_files_become_names_of_types() {
    for (path, name) in [
        ("a/double-pendulum.lagrange", "DoublePendulum"),
        ("3_bodies.lagrange", "System3Bodies"),
        ("self.lagrange", "SystemSelf"),
        // The type parameter and the trait of an exported struct.
        ("t.lagrange", "SystemT"),
        ("default.lagrange", "SystemDefault"),
        ("çé.lagrange", "System"),
    ] {
        assert_eq!(type_name(path), name);
    }
}

#[test]
fn lines_may_end_in_carriage_returns_alone() {
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(file.path(), TEMPLATE.replace('\n', "\r")).expect("text");
    let path = file.path().to_str().expect("a plain path");
    assert_eq!(read(path).expect("text"), TEMPLATE);
}

fn mistakes(text: &str) -> String {
    match scene("spring.lagrange", text) {
        Err(Refused::Mistakes(mistakes)) => mistakes.to_string(),
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("nothing is wrong with\n{text}"),
    }
}

#[test]
fn mistakes_are_marked_where_they_are() {
    let text = "//! A spring.\nparameters(mass: \"kg\" = 1, stiffness: \"N/m\" = 40),\n\
                coordinates(x: \"m\"),\n\tkinetic = mass/2 * der(x)^2,\npotential = stifness/2 * x^2,\n";
    expect_test::expect![[r#"
        spring.lagrange:5:13: `stifness` is not known; did you mean `stiffness`? [E201]
          5 | potential = stifness/2 * x^2,
            |             ^^^^^^^^"#]]
    .assert_eq(&mistakes(text));
    expect_test::expect![[r#"
        spring.lagrange:4:12: a kinetic energy is in J, and this is in kg² m²/s²; a factor in 1/kg is missing [E704]
          4 | 	kinetic = mass^2/2 * der(x)^2,
            | 	          ^^^^^^^^^^^^^^^^^^^"#]]
    .assert_eq(&mistakes(&text.replace("stifness", "stiffness").replace("mass/2", "mass^2/2")));
    // What to do is told as it is done in a file, which has no fields.
    let number = text.replace("stifness/2 * x^2", "mass * 9.81 * x");
    let told = mistakes(&number);
    assert!(
        told.contains(
            r#"`9.81` is a plain number: make it a parameter, `parameters(name: "m/s²" = …)`"#
        ),
        "{told}"
    );
    // A unit behind its value.
    for unit in ["1 \"kg\"", "1 kg"] {
        let told = mistakes(&text.replace("mass: \"kg\" = 1", &format!("mass = {unit}")));
        let right = "a unit stands before the value: `mass: \"kg\" = 1`";
        assert!(told.contains(right), "{told}");
    }
    let told = mistakes(&text.replace("mass: \"kg\" = 1", "mass = 1 m/s^2"));
    assert!(told.contains("`mass: \"m/s^2\" = 1`"), "{told}");
    let told = mistakes(&text.replace("stifness", "k"));
    assert!(
        told.contains("declare it as a parameter, `parameters(name = 1)`, a coordinate"),
        "{told}"
    );
}

#[test]
fn an_attitude_is_no_effect() {
    let text = "attitude(body: q), kinetic = dot(body.body_rate, body.body_rate)/2, start(rest: q[0] = 1), force(twist: 1 along body.space_rate[0])";
    let d = scene("body.lagrange", text)
        .expect("a declaration")
        .description();
    let without = |name: &str| Request {
        effects: vec![(name.to_owned(), false)],
        ..Request::default()
    };
    assert!(without("twist").effects(d).is_ok());
    let told = without("body").effects(d).expect_err("no effect");
    assert_eq!(
        told.to_string(),
        "`body` is an attitude, which cannot be left out: without the unit length of its quaternion it is no orientation"
    );
}

/// What cannot be kept exactly in an expression can be the value of a parameter.
#[test]
fn values_of_parameters_are_doubles() {
    let text = "parameters(planck: \"J s\" = 6.62607015e-34, far[2] = -1e99, masses = [8.74690017413206e-28, 1]), coordinates(x), kinetic = der(x)^2";
    let values = scene("quantum.lagrange", text)
        .expect("a declaration")
        .defaults();
    let masses = [8.746_900_174_132_06e-28, 1.0];
    let before = [6.626_070_15e-34, -1e99, -1e99];
    assert_eq!(values, [&before[..], &masses].concat());
    let told = mistakes(&text.replace("der(x)^2", "1e-40 * der(x)^2"));
    assert!(told.contains("`1e-40` cannot be kept exactly"), "{told}");
    let told = mistakes(&text.replace("1e99", "1e999"));
    assert!(told.contains("`1e999` cannot be kept exactly"), "{told}");
}

#[test]
fn what_only_a_file_has_is_checked() {
    let rest = "coordinates(x), kinetic = der(x)^2";
    for (text, expected) in [
        (
            format!("parameters(a), {rest}"),
            "1:12: `a` has no value; add `= 1` [E018]",
        ),
        (
            format!("parameters(a [m] = 1), {rest}"),
            "1:15: expected a number of elements, as in `[3]`, or a unit, as in `: \"m\"`, found `m` [E001]",
        ),
        (
            format!("parameters(a = b, b = 1), {rest}"),
            "1:16: expected a number, as `3`, `-1/2` or `2*pi` (what follows from other parameters is a `define`), found `b` [E001]",
        ),
        (
            format!("parameters(a = c), {rest}"),
            "1:16: `c` is not known",
        ),
        (
            format!("parameters(a[2] = [1, 2, 3]), {rest}"),
            "1:19: lists of 2 and 3 elements do not fit",
        ),
        (
            format!("parameters(a = sqrt(-1)), {rest}"),
            "1:16: `sqrt(-1)` has no value",
        ),
        (
            format!("parameters(a = 1, a = 2), {rest}"),
            "1:19: `a` is already the name of a parameter",
        ),
        // There is no struct whose fields could be meant.
        (
            format!("{rest}, potential = 1e30 * 1e30 * x"),
            "1:49: the exact numbers of `1000000000000000000000000000000*1000000000000000000000000000000*x` outgrow 38 digits; make such numbers parameters",
        ),
        (
            format!("{rest}, start(a: x = x)"),
            "1:50: a start depends on parameters and t only, and `x` depends on the motion; use parameters",
        ),
        (
            format!("parameters(m = 1), {rest}, potential = self.m * x"),
            "1:68: `self.` is not written so; parameters are written by their name alone",
        ),
        (
            format!("parameters(mass = 1, self = 1), {rest}"),
            "1:22: `self` cannot be the name of a parameter; no field of a struct of Rust can have it",
        ),
        (
            format!("parameters(_ = 1), {rest}"),
            "1:12: `_` cannot be the name of a parameter",
        ),
        (
            format!("parameters(a[9999999] = 1), {rest}"),
            "1:12: 9999999 elements are too many",
        ),
        (
            format!("parametres(a = 1), {rest}"),
            "1:1: `parametres` is not an item; did you mean `parameters`?",
        ),
        (
            format!("{rest}, until = 1, until = 2"),
            "1:48: `until` is given twice",
        ),
        (format!("{rest}, until = x"), "1:45: `x` is not known"),
        (
            format!("parameters(mu: nonnegative = 1), {rest}"),
            "1:16: expected a unit; without one write `mu nonnegative`, found `nonnegative`",
        ),
        (
            format!("# A spring.\n{rest}"),
            "1:1: `#` is not an operator here; a remark begins with `//`",
        ),
        (
            format!("{rest}, start(x = 1)"),
            "1:43: this start has no name; write `start(name: …)`",
        ),
        (
            format!("{rest}, contact(table: x >= 0, where x >= 1 and x <= 2)"),
            "1:73: `and` is not an operator here; a region is one comparison",
        ),
        (
            "//! A spring.\n".to_owned(),
            "1:1: expected items, as `coordinates(x)` and `kinetic = …`, found none",
        ),
        (
            format!("{rest}, until = -5"),
            "1:45: expected a time after the start, which is at 0, as in `until = 5`, found `-5` [E001]",
        ),
        (
            format!("{rest}, until = 10s"),
            "1:45: expected a number of seconds without a unit, as in `until = 10`, found `10s` [E001]",
        ),
        (
            format!("{rest}, until = 10 s"),
            "1:48: expected a number of seconds without a unit, as in `until = 10`, found `s` [E001]",
        ),
        (
            format!("{rest}, until = 10 \"s\""),
            "1:48: expected a number of seconds without a unit, as in `until = 10`, found `\"s\"` [E001]",
        ),
        (
            format!("parameters(m = 1 positive), {rest}"),
            "1:18: `positive` stands in the wrong place; a domain stands before the value: `m positive = 1` [E031]",
        ),
        (
            format!("{rest}, until = \"10 s\""),
            "1:45: expected a number of seconds without a unit, as in `until = 10`, found `\"10 s\"` [E001]",
        ),
        (
            format!("{rest}, until = 0"),
            "1:45: expected a time after the start, which is at 0, as in `until = 5`, found `0` [E001]",
        ),
        (
            format!("{rest}, mass = 2"),
            "1:37: `mass` is not an item; a number that can be set stands in `parameters(mass = …)`, a name for an expression in \
             `define(mass = …)` [E010]",
        ),
        (
            format!("{rest}, damper(x)"),
            "1:37: `damper` is not an item; it is a dissipation: `dissipation(damper: c/2 * der(x)^2)` [E010]",
        ),
        (
            format!("{rest}, draw(circle: (x, 0))"),
            "1:42: `circle` is not the name of a form; did you mean `disc`? [E901]",
        ),
        (
            format!("{rest}, draw(floor: (0, 0) to (1, 0))"),
            "1:49: a list of 2 where a single value is expected; a floor is drawn by its height, `draw(floor: 0)`; from place to \
             place there is `draw(ground: (0, 0) to (l, 0))` [E302]",
        ),
        (
            format!("parameters(m: \"kg\" = 1 l[2]: \"m\" = 0.5), {rest}"),
            "1:24: expected a comma before `l`",
        ),
        (
            format!("parameters(l = 0,5), {rest}"),
            "1:18: expected the name of a parameter (a decimal has a point: `0.5`), found `5`",
        ),
        (
            format!("parameters(l = .5), {rest}"),
            "1:16: `.5` is not a number of the language; write decimal digits",
        ),
        (
            format!("{rest}, potential = math.sin(x)"),
            "1:54: `.sin()` is the notation of programs; functions are written as in mathematics: `sin(x)`",
        ),
        (
            format!("{rest}, potential = sin(30 deg)"),
            "1:56: an operator is missing before `deg`; angles are in radians: 30° is `pi/6`",
        ),
    ] {
        let found = mistakes(&text);
        assert!(
            found.starts_with(&format!("spring.lagrange:{expected}")),
            "{text}\n{found}"
        );
    }
}

#[test]
fn a_mistake_in_the_notation_of_an_item_is_told_once() {
    let found = mistakes("coordinates(x), kinetic = der(x)^2, until: 5");
    assert_eq!(found.matches("[E").count(), 1, "{found}");
}

#[test]
fn what_cannot_be_read_is_named() {
    for (text, expected) in [
        (
            "kinetic = \"a",
            "1:11: what begins here cannot be read; the quotation mark is not closed",
        ),
        // The marks that follow are read in pairs.
        (
            "parameters(\n  a: \"m\" = 1, // \"\n  b: \"m = 2,\n  c: \"m\" = 3,\n)",
            "3:6: what begins here cannot be read; the quotation mark is not closed",
        ),
        (
            "parameters(a: \"m\" = 1, b: \"m = 2, c: \"m\" = 3)",
            "1:27: what begins here cannot be read; the quotation mark is not closed",
        ),
        (
            "parameters(#[lagrange(tex = \"a, b\")] a: \"m\" = 1, b: \"m)",
            "1:53: what begins here cannot be read; the quotation mark is not closed",
        ),
        (
            "coordinates(x: 'kg')",
            "1:16: what begins here cannot be read; `'` is no character of the language; units stand in double quotation marks: `\"kg\"`",
        ),
        (
            "coordinates(x: 'N m', y)",
            "1:20: what begins here cannot be read; `'` is no character of the language; units stand in double quotation marks",
        ),
        (
            "coordinates(x: 'm')",
            "1:16: what begins here cannot be read; `'` is no character of the language; units stand in double quotation marks",
        ),
        (
            "kinetic = x\0",
            "1:12: what begins here cannot be read; `\\0` is no character of the language [E029]\n  1 | kinetic = x\u{fffd}\n",
        ),
        (
            "kinetic = x\u{200b}",
            "1:12: what begins here cannot be read; `\\u{200b}` is no character of the language",
        ),
        (
            "coordinates(x: \"m\u{1b}\"), kinetic = der(x)^2",
            "1:16: `\u{fffd}` has no place in a unit",
        ),
        (
            "kinetic = 2·m·x^2",
            "1:11: what begins here cannot be read; `·` is no character of the language; a product is written `a*b`",
        ),
        (
            "kinetic = \\theta",
            "1:11: what begins here cannot be read; `\\` is no character of the language; a letter is written by its name alone",
        ),
        (
            "kinetic = (1",
            "1:11: what begins here cannot be read; `(` is not closed",
        ),
        (
            "kinetic = 1)",
            "1:12: what begins here cannot be read; no bracket is open that `)` could close",
        ),
        (
            "kinetic = x²",
            "1:12: what begins here cannot be read; `²` is no character of the language; a power is written `x^2`",
        ),
        (
            "kinetic = a×x",
            "1:12: what begins here cannot be read; `×` is no character of the language; a product is written `a*b`",
        ),
        (
            "kinetic = −x",
            "1:11: what begins here cannot be read; `−` is no character of the language; a minus is the sign of the keyboard: `-`",
        ),
        (
            "kinetic = x'",
            "1:12: what begins here cannot be read; `'` is no character of the language; the velocity of `x` is written `der(x)`",
        ),
        (
            "contact(c: x ≥ 0)",
            "1:14: what begins here cannot be read; `≥` is no character of the language; write `>=`",
        ),
        (
            "kinetic = 30°",
            "1:13: what begins here cannot be read; `°` is no character of the language; angles are in radians: 30° is `pi/6`",
        ),
    ] {
        let found = mistakes(text);
        assert!(
            found.starts_with(&format!("spring.lagrange:{expected}")),
            "{text}\n{found}"
        );
    }
}

#[test]
fn names_that_look_like_something_else_are_told_as_that() {
    for (power, expected) in [
        ("k·x", "a product is written `k*x`"),
        ("ẋ", "the velocity of `x` is written `der(x)`"),
        ("xdot", "the velocity of `x` is written `der(x)`"),
        ("v_x", "the velocity of `x` is written `der(x)`"),
    ] {
        let text =
            format!("parameters(k = 1), coordinates(x), kinetic = der(x)^2, force(f: x = {power})");
        let found = mistakes(&text);
        assert!(found.contains(expected), "{power}\n{found}");
    }
}

#[test]
fn values_are_numbers_written_as_expressions() {
    let text = "parameters(a = 2*pi, b[2] = 1/4, c[2] = [1, -2], d = [3, 4], type = sqrt(4)), coordinates(x),\n\
                kinetic = a * b[0] * c[0] * d[1] * type * der(x)^2, until = 3/2";
    let scene = scene("a.lagrange", text).unwrap_or_else(|refused| panic!("{refused}"));
    let tau = 2.0 * std::f64::consts::PI;
    assert_eq!(
        scene.defaults(),
        [tau, 0.25, 0.25, 1.0, -2.0, 3.0, 4.0, 2.0]
    );
    assert_eq!(scene.until(), 1.5);
}

/// Whatever a file says, there is a scene or a mistake.
#[track_caller]
fn survives(text: &str) {
    if let Err(Refused::Bug(reason)) = scene("hostile.lagrange", text) {
        panic!("{reason}\n{text}");
    }
}

#[test]
fn garbage_is_refused() {
    let mut random = fastrand::Rng::with_seed(1);
    let words: Vec<&str> = "parameters coordinates kinetic potential contact friction constraint start stop mark check until define \
        force observe x y der sum if min pi t 0 1 1/2 1e400 1e-9 0..8 ( ) [ ] { } , : = == >= <= + - * / ^ . .. ' \" # ! // \u{e9} \n"
        .split(' ')
        .collect();
    for _ in 0..1000 {
        let count = random.usize(..60);
        let garbage: Vec<&str> = (0..count)
            .map(|_| words[random.usize(..words.len())])
            .collect();
        survives(&garbage.join(" "));
    }
}

#[test]
fn mutations_of_a_good_file_are_read_or_refused() {
    let mut random = fastrand::Rng::with_seed(2);
    let good: Vec<char> = TEMPLATE.chars().collect();
    for _ in 0..300 {
        let mut text = good.clone();
        for _ in 0..1 + random.usize(..4) {
            let (at, from) = (random.usize(..text.len()), random.usize(..text.len()));
            let length = random.usize(..20).min(text.len() - at.max(from));
            match random.usize(..3) {
                0 => drop(text.drain(at..at + length)),
                1 => text[at] = good[random.usize(..good.len())],
                _ => {
                    let copy: Vec<char> = text[from..from + length].to_vec();
                    text.splice(at..at, copy);
                }
            }
        }
        survives(&text.into_iter().collect::<String>());
    }
}

#[test]
fn bombs_do_not_go_off() {
    let with = |value: &str| format!("coordinates(x), kinetic = der(x)^2 + {value}");
    let many = 100_000;
    for bomb in ["(", "[", "sin(", "-", "x^", "x+", "x*", "x.", "2^", "x/"] {
        survives(&with(&(bomb.repeat(many) + "x")));
    }
    for (open, close) in [
        ("(", ")"),
        ("[", "]"),
        ("sin(", ")"),
        ("{", "}"),
        ("max(x, ", ")"),
    ] {
        survives(&with(&(open.repeat(many) + "x" + &close.repeat(many))));
    }
    survives(&with(
        "sum(i in 0..10000: sum(j in 0..10000: sum(k in 0..10000: x^i)))",
    ));
    survives(&with("9^999^999^999"));
    survives(
        "parameters(a[10000] = 1, b[99999999999999999999] = 2), coordinates(q[10000]), kinetic = der(q[0])^2",
    );
    survives(
        "coordinates(q[300]), kinetic = sum(i in 0..300: sum(j in 0..300: cos(q[i]-q[j])*der(q[i])*der(q[j])))",
    );
    let doubled: String = (1..200)
        .map(|k| format!("a{k} = a{}*sin(a{}) + a{},", k - 1, k - 1, k - 1))
        .collect();
    survives(&format!(
        "define(a0 = x, {doubled}), coordinates(x), kinetic = a199*der(x)^2"
    ));
    survives(&" ".repeat(2 << 20));
}

#[test]
fn what_a_parameter_may_be_is_kept_by_the_file_and_the_struct() {
    let text = "parameters(mass: \"kg\" positive = 1, drag nonnegative = 0.5), coordinates(x),
        kinetic = mass/2 * der(x)^2, dissipation(air: drag/2 * der(x)^2), start(moving: der(x) = 1)";
    let declared = scene("falling.lagrange", text).expect("a scene");
    for (name, value) in [("mass", 0.0), ("mass", -1.0), ("drag", -0.5)] {
        let request = Request {
            parameters: vec![(name.to_owned(), value)],
            ..Request::default()
        };
        let outcome = declared.run(&request).expect("a request");
        let error = outcome.failure.expect("outside its domain").to_string();
        assert!(
            error.contains(name) && error.contains("it must be"),
            "{error}"
        );
    }
    assert!(
        declared
            .run(&Request::default())
            .is_ok_and(|run| run.failure.is_none())
    );
    let rust = super::export("falling.lagrange", text)
        .expect("a struct")
        .rust;
    assert!(
        rust.contains("#[lagrange(unit = \"kg\", domain = \"positive\")]"),
        "{rust}"
    );
    assert!(
        rust.contains("#[lagrange(domain = \"nonnegative\")]"),
        "{rust}"
    );
    // A letter that Rust would rather have small is no matter for its user.
    assert!(!rust.contains("non_snake_case"));
    let rust = super::export("falling.lagrange", &text.replace("mass", "M"));
    let rust = rust.expect("a struct").rust;
    assert!(
        rust.contains("Debug)]\n#[allow(non_snake_case)]\n#[lagrange("),
        "{rust}"
    );
    let wrong = scene("falling.lagrange", &text.replace("nonnegative", "small"));
    assert!(
        wrong.is_err_and(|refused| refused.to_string().contains("`positive` or `nonnegative`"))
    );
}

/// A block X on the floor that a wedge's mass x slides on, with names as textbooks have them: in a file no name becomes a constant, and
/// the motion is that of other names. Only the struct that `export` writes has constants.
#[test]
fn names_may_differ_in_case_only() {
    let text = "parameters(M = 2, m = 1, g = 9.81),
coordinates(X, x),
kinetic = M/2 * der(X)^2 + m/2 * ((der(X) + der(x))^2 + der(x)^2),
potential = -m * g * x,
force(F: X = 3),
friction(f: slip = der(X), limit = 1),
start(s: der(x) = 0.1), start(S: der(X) = 0.1),
observe(w = X + x, W = X - x), stop(end: x >= 1),";
    let others = text.replace('X', "block").replace("f:", "floor:");
    let others = others
        .replace("S:", "second:")
        .replace("W =", "difference =");
    let end = |text: &str, start: &str| {
        let system = scene("wedge.lagrange", text).expect("a declaration");
        let request = Request {
            from: Some(start.to_owned()),
            ..Request::default()
        };
        let outcome = system.run(&request).expect("a run");
        assert!(outcome.failure.is_none());
        outcome.samples.last().expect("an end").state.clone()
    };
    let same = |[a, b]: [lagrange_core::prelude::State<f64>; 2]| a.q == b.q && a.v == b.v;
    assert!(same([end(text, "s"), end(&others, "s")]));
    assert!(same([end(text, "S"), end(&others, "second")]));
    let system = scene("wedge.lagrange", text).expect("a declaration");
    let tokens: proc_macro2::TokenStream = system.derivation().declaration.parse().expect("tokens");
    let shown = lagrange_engine::inspect(tokens, None).expect("a derivation");
    let shown = lagrange_engine::inspect::print::plain(&shown);
    assert!(shown.contains("2 m x\u{308} + m X\u{308} = m g"), "{shown}");
    let Err(refused) = super::export("wedge.lagrange", text) else {
        panic!("a struct with two constants X");
    };
    let told = refused.to_string();
    let first = "wedge.lagrange:2:16: `x` and `X` become one constant, `X`";
    assert!(
        told.starts_with(first) && told.contains("`f` and `F`"),
        "{told}"
    );
    assert!(super::export("wedge.lagrange", &others).is_ok());
}

/// A gas whose pressure grows like 1/x³ never lets a piston come to the bottom: x² = 1 + t². Who begins there is told that forces are infinite,
/// and who leaves the gas out comes to rest.
#[test]
fn a_contact_at_a_pole_is_never_reached_or_told() {
    let text = "coordinates(x), kinetic = der(x)^2/2, potential(gas: 1/(2*x^2)), potential(gravity: weight * x),
        parameters(weight nonnegative = 0), contact(bottom: x >= 0),
        start(free: x = 1), start(pressed), until = 3,";
    let piston = scene("piston.lagrange", text).expect("a declaration");
    let run = |request: Request| piston.run(&request).expect("a run");
    let expands = run(Request::default());
    let x = expands.samples.last().expect("an end").state.q[0];
    assert!(
        expands.failure.is_none() && (x - 10.0_f64.sqrt()).abs() < 1e-8,
        "{x}"
    );
    let pressed = Request {
        from: Some("pressed".to_owned()),
        ..Request::default()
    };
    let told = run(pressed.clone()).failure.expect("no forces");
    assert!(matches!(told, Error::NotFinite { .. }), "{told}");
    let empty = run(Request {
        parameters: vec![("weight".to_owned(), 1.0)],
        effects: vec![("gas".to_owned(), false)],
        ..pressed
    });
    let end = empty.samples.last().expect("an end");
    assert!(empty.failure.is_none() && end.state.q == [0.0], "{end:?}");
}

/// A crank of 0.1 m turns a slotted arm whose foot is 0.3 m below: it turns back where the crank is at right angles to it, at
/// cos α = −1/3. There the friction of the ram reverses, constraints have been projected, and the mark is one event all the same.
#[test]
fn a_mark_where_a_friction_reverses_is_one_event() {
    let text = "parameters(crank = 0.1, depth = 0.3, rate = 5), coordinates(alpha, beta, s, x),
        define(pin = [crank * sin(alpha), crank * cos(alpha)], slot = [s * sin(beta), s * cos(beta) - depth]),
        kinetic = der(alpha)^2/4 + der(beta)^2/10 + der(x)^2,
        constraint(pinned[k in 0..2]: pin[k] == slot[k]), constraint(drive: x == tan(beta)/2),
        force(motor: alpha = 1), friction(cutting: slip = der(x), limit = 30),
        start(running: s = crank + depth, der(alpha) = rate, der(beta) = rate * crank/(crank + depth),
            der(x) = rate * crank/(crank + depth)/2),
        mark(turn: der(x)), until = 0.8,";
    let outcome = scene("quick-return.lagrange", text)
        .expect("a declaration")
        .run(&Request::default())
        .expect("a run");
    let told: Vec<&str> = outcome
        .events
        .iter()
        .map(|event| event.kind.word())
        .collect();
    assert_eq!(told, ["mark", "reverses"]);
    let certificate = outcome.certificate.as_ref().expect("a certificate");
    assert!(certificate.holds(), "{certificate}");
    let angle = outcome.events[0].state.q[0];
    assert!((angle.cos() + 1.0 / 3.0).abs() < 1e-8, "{angle}");
}

/// Conditions name the elements that they speak of, and are joined by the word of the language.
#[test]
fn conditions_are_shown_as_they_are_written() {
    let text = "coordinates(q[2]), kinetic = (der(q[0])^2 + der(q[1])^2)/2,
        friction(joint[k in 0..2]: slip = der(q[k]), limit = 1), start(a: q[0] = 1),
        stop(settled: sticks(joint[0]) and sticks(joint[1])),";
    let scene = scene("arm.lagrange", text).expect("a declaration");
    let tokens = scene.derivation().declaration.parse().expect("tokens");
    let derivation = lagrange_engine::inspect(tokens, None).expect("a derivation");
    let shown = lagrange_engine::inspect::print::plain(&derivation);
    assert!(
        shown.contains("joint[0] sticks and joint[1] sticks"),
        "{shown}"
    );
}
