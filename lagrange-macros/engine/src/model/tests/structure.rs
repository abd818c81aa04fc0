//! What constraints say together: mistakes and remarks.

use super::read;

/// A particle in space and an angle.
fn with(items: &str) -> String {
    format!(
        "#[lagrange(coordinates(x, y, z, theta),
{items})]
struct S {{ m: f64, g: f64, l: f64, a: f64 }}"
    )
}

const KINETIC: &str = "kinetic = m/2*(der(x)^2 + der(y)^2 + der(z)^2 + l^2*der(theta)^2), potential = m*g*(z + l*cos(theta))";

fn said(items: &str) -> String {
    match read(&with(&format!("{KINETIC},\n{items}"))) {
        Ok(_) => String::new(),
        Err(said) => said,
    }
}

fn remarks(items: &str) -> Vec<String> {
    let system = read(&with(&format!("{KINETIC},\n{items}"))).unwrap();
    system.hints.into_iter().map(|hint| hint.text).collect()
}

#[test]
fn a_dissipation_that_only_gives_energy_is_told() {
    for (items, given) in [
        ("dissipation(d: -m/2*(der(x)^2 + der(y)^2))", true),
        ("dissipation(d: -m*abs(der(x))^3)", true),
        ("dissipation(d: -m/2*norm([der(x), der(y)]))", true),
        ("dissipation(d: m/2*der(x)^2)", false),
        ("dissipation(d: m*abs(der(x))^3)", false),
        // A belt drags, and what swings by itself takes energy where it swings far.
        ("dissipation(d: m/2*(der(x) - a)^2)", false),
        ("dissipation(d: m/2*(x^2 - 1)*der(x)^2)", false),
        ("dissipation(d: m*x*der(x)^2)", false),
    ] {
        let told = remarks(items);
        let gives = told.iter().any(|text| text.starts_with("`d` gives energy"));
        assert_eq!(gives, given, "{items}: {told:?}");
    }
}

#[test]
fn dependent_constraints_are_told() {
    let wrong = [
        (
            "constraint(b: x == l), constraint(c: x == l)",
            "3:35 E603 `c` says nothing that `b` does not say already",
        ),
        (
            "constraint(b: x == l), constraint(c: 2*x == 2*l)",
            "3:35 E603 `c` says",
        ),
        (
            "constraint(b: x == 1), constraint(c: x == 2)",
            "3:35 E604 `c` cannot hold together with `b`",
        ),
        (
            "constraint(b: x == l), constraint(c: x^2 == l^2)",
            "3:35 E603 `c` says",
        ),
        (
            "constraint(b: x^2 + y^2 == l^2), constraint(c: sqrt(x^2 + y^2) == l)",
            "3:45 E603 `c` says",
        ),
        (
            "constraint(b: x == y), constraint(c: y == z), constraint(d: x == z)",
            "3:58 E603 `d` says nothing that `b`, `c` does not",
        ),
        (
            "constraint(b: x == y), constraint(c: y == z), constraint(d: x == z + 1)",
            "3:58 E604 `d` cannot hold together with `b`, `c`",
        ),
        (
            "constraint(b: der(x) == 0), constraint(c: der(x) == 1)",
            "3:40 E604 `c`",
        ),
        (
            "constraint(b: der(x) == a*der(theta)), constraint(c: x == a*theta)",
            "3:51 E603 `c`",
        ),
        (
            "constraint(b: x == 3), constraint(c: der(x) == sin(t))",
            "3:35 E604 `c`",
        ),
        (
            "constraint(b[k in 0..2]: x == l)",
            "3:12 E603 `b[1]` says nothing that `b[0]`",
        ),
        (
            "contact(f: z >= 0), constraint(c while f: der(z) == 0)",
            "3:32 E603 `c` says nothing that `f`",
        ),
        ("constraint(c: sin(x)^2 + cos(x)^2 == 1)", "3:15 E506 "),
    ];
    for (items, expected) in wrong {
        let said = said(items);
        assert!(
            said.starts_with(expected) && said.lines().count() == 1,
            "{items}\n  said {said}"
        );
    }
}

#[test]
fn parameters_may_decide() {
    for items in [
        "constraint(b: x == l), constraint(c: 2*x == 2*a)",
        "constraint(b: der(x) == 0), constraint(c: der(x) == a)",
    ] {
        let remarks = remarks(items);
        let expected = "`c` holds together with `b` only for some values";
        assert!(
            remarks.iter().any(|text| text.starts_with(expected)),
            "{items}: {remarks:?}"
        );
    }
}

#[test]
fn constraints_that_meet_are_fine() {
    let fine = [
        // Three cranks of a parallelogram: dependent on the constraints only.
        "constraint(crank[k in 0..3]: (x + (k-1)*a*(cos(theta) - 1))^2 + (y + (k-1)*a*sin(theta))^2 == l^2)",
        "constraint(b: x^2 + y^2 == l^2), constraint(c: x == l*cos(theta)), constraint(d: y == l*sin(theta))",
        "constraint(b: x == l*sin(t)), constraint(c: y == l*cos(t))",
        "contact(f: z >= 0), constraint(c while f: der(x) == a*der(theta))",
        "contact(f: z >= 0), constraint(b: z == x), constraint(c while f: der(x) == a*der(theta))",
        "constraint(c: if(x >= l, y, z) == 0), constraint(d: if(x >= l, y, -z) == 0)",
        "constraint(b: asin(10 + x) == 0), constraint(c: asin(10 + x) == 0)",
    ];
    for items in fine {
        assert_eq!(said(items), "", "{items}");
    }
}

#[test]
fn integrable_velocity_constraints_are_remarked() {
    let one = |items: &str| {
        let remarks = remarks(items);
        assert_eq!(remarks.len(), 1, "{items}: {remarks:?}");
        remarks[0].clone()
    };
    let found = one("constraint(roll: der(x) == l*der(theta))");
    assert!(
        found.contains("`roll`") && found.contains("`x == l*theta`, but for a constant"),
        "{found}"
    );
    assert!(one("constraint(c: der(x*y) - a*der(z) == 0)").contains("`x*y - a*z == 0`"));
    assert!(one("constraint(c: x*der(y) + y*der(x) == 0)").contains("on positions if you can"));
    assert!(one("constraint(c: x*der(y) == y*der(x))").contains("on positions if you can"));
    // dx = z dy alone is not integrable (contact form), nor is a skate.
    assert!(remarks("constraint(c: der(x) == z*der(y))").is_empty());
    assert!(remarks("constraint(c: der(x)*sin(theta) == der(y)*cos(theta))").is_empty());
    // dx = z dy with dz = 0 leaves planes: integrable together.
    let two = remarks("constraint(c: der(x) == z*der(y)), constraint(d: z*der(z) == 0)");
    assert!(two.iter().any(|text| text.contains("`d`")), "{two:?}");
    let two = remarks(
        "constraint(c: der(x) == z*der(y)), constraint(d: der(z) == (x - y*z)*der(y) + 0*x)",
    );
    assert!(two.is_empty() || two[0].contains("together"), "{two:?}");
    // A rolling disk in the plane of its rim: two rows, not integrable.
    let skate = "constraint(a1: der(x) == l*cos(theta)*der(z)), constraint(a2: der(y) == l*sin(theta)*der(z))";
    assert!(remarks(skate).is_empty(), "{:?}", remarks(skate));
}

#[test]
fn gaps_that_are_never_negative_are_remarked() {
    let remarks = |gap: &str| {
        let text = format!(
            "#[lagrange(coordinates(a, b, x, y), kinetic = m/2*(der(a)^2 + der(b)^2 + der(x)^2 + der(y)^2), contact(hit: {gap}))]
             struct S {{ m: f64, r: f64 }}"
        );
        read(&text).unwrap().hints.len()
    };
    for gap in [
        "sqrt((b - a)^2) >= 0",
        "(b - a)^2 >= 0",
        "norm((x, y) - (a, b)) >= 0",
        "(x - a)^2 + 2*sqrt(y) + 1 >= 0",
    ] {
        assert_eq!(remarks(gap), 1, "{gap}");
    }
    for gap in [
        "b >= a",
        "abs(b - a) >= 0",
        "norm((x, y)) >= r",
        "r >= norm((x, y))",
        "sqrt(x^2 + y^2) >= 1",
        "x * y^2 >= 0",
        "(b - a)^3 >= 0",
    ] {
        assert_eq!(remarks(gap), 0, "{gap}");
    }
}

#[test]
fn coordinates_put_in_too_early_are_remarked() {
    let early = "#[lagrange(coordinates(r, theta),
        kinetic = m/2*radius^2*der(theta)^2, potential = m*g*radius*cos(theta), constraint(shell: r == radius))]
        struct S { m: f64, g: f64, radius: f64 }";
    let system = read(early).unwrap();
    assert_eq!(system.hints.len(), 1, "{:?}", system.hints);
    assert!(
        system.hints[0]
            .text
            .starts_with("`r` occurs in `shell` but in no energy")
    );
    let right = early.replace("radius^2*der(theta)^2", "(der(r)^2 + r^2*der(theta)^2)");
    assert!(read(&right).unwrap().hints.is_empty());
}
