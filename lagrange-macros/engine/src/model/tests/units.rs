//! Units: what is inferred, what is told, and where.

use super::read;

/// A particle in the plane with an angle beside it, all units given but those of `a`, `b` and the list `d`.
fn with(items: &str) -> String {
    format!(
        "#[lagrange(coordinates(x: \"m\", y: \"m\", theta: \"rad\", q[2]: \"m\"),
{items})]
struct S {{
    #[lagrange(unit = \"kg\")] m: f64, #[lagrange(unit = \"m/s^2\")] g: f64, #[lagrange(unit = \"m\")] l: f64,
    #[lagrange(unit = \"kg m^2\")] inertia: f64, #[lagrange(unit = \"N\")] f: f64, a: f64, b: f64, d: [f64; 2],
}}"
    )
}

const KINETIC: &str =
    "kinetic = m/2*(der(x)^2 + der(y)^2 + der(q[0])^2 + der(q[1])^2) + inertia/2*der(theta)^2";

/// What is said about these items (from line 3 on) beside a right kinetic energy.
fn said(items: &str) -> String {
    match read(&with(&format!("{KINETIC},\n{items}"))) {
        Ok(_) => String::new(),
        Err(said) => said,
    }
}

#[track_caller]
fn fine(items: &str) {
    assert_eq!(said(items), "", "{items}");
}

#[test]
fn right_units_are_quiet() {
    fine("potential = m*g*y + a/2*(x - l)^2 - b*cos(theta)");
    fine("potential = m*g*y*(1 + 0.1*sin(theta)), define(z = [x, y])");
    fine("constraint(rod: x^2 + y^2 == l^2), constraint(roll: der(x) == l*der(theta))");
    fine("constraint(rod: sqrt(x^2 + y^2) - l == 0), contact(c: y >= 0, restitution = 1/2)");
    fine(
        "contact(c: y >= l*sin(theta)), friction(s on c: slip = der(x) - l*der(theta), static = 0.3)",
    );
    fine("contact(c: theta >= 0, where y >= l)");
    fine("contact(c: y^2 >= l^2 at y), friction(s on c: slip = der(x), static = a)");
    fine("friction(s: slip = der(x), normal = m*g, static = if(abs(slip) >= a, 0.1, 0.2))");
    fine(
        "contact(c: y >= 0), friction(s on c: slip = (der(x), der(q[0])), static = 0.3, kinetic = if(slip[0] >= a, 0.1, 0.2))",
    );
    fine(
        "force(p: x = f), force(q1: theta = f*l), force(r: (0, -m*g) at (x, y)), force(s: -f along der(x))",
    );
    fine(
        "force(p: x = f*sin(a*t)), force(q1: y = -b*der(y)/a), dissipation(w: b*l^2/a*der(theta)^2)",
    );
    fine(
        "start(one: x = l, der(x) = sqrt(g*l), theta = pi/2, q = [l, -l]), start(two: q[k in 0..2] = (k+1)*l, der(x) = -1/2), stop(far: x >= 10)",
    );
    fine("observe(e = energy, p = momentum(x), v = norm([der(x), der(y)]), h = max(y, l))");
    fine("observe(c = cross([x, y], [der(x), der(y)]), s = if(x >= 0, y, l), e = exp(-x/l))");
    fine("stop(far: x >= 3*l and der(x) <= 0), mark(low: y), mark(z: theta <= -pi)");
    fine("potential = sum(k in 0..2: m*g*q[k] + a/2*q[k]^2), define(r[k in 1..3] = q[k-1]*k)");
    fine(
        "friction(s: slip = der(theta), limit = (f*l, 2*f*l)), friction(u: slip = der(x), normal = m*g, static = a)",
    );
    fine("potential = m*g*l*a^2 + b*l^(1/2), constraint(c: x == l*a)");
}

#[test]
fn wrong_units_are_told_at_the_term() {
    let wrong = [
        (
            "potential = m*g*y + m*l + f*x",
            "3:21 E705 adds kg m to J; a factor in m/s² is missing",
        ),
        (
            "constraint(c: 1 - l*theta == 0)",
            "3:15 E705 adds a plain number to m; a number has no unit: make it a field with `#[lagrange(unit = \"m\")]`",
        ),
        (
            "constraint(c: -1 + l*theta + 2 == y)",
            "3:15 E705 adds a plain number to m; a number has no unit: make it a field with `#[lagrange(unit = \"m\")]`",
        ),
        (
            "kinetic(more: m*(x^2 + der(y)^2))",
            "3:18 E705 adds m² to m²/s²; is a `der(…)` missing?",
        ),
        (
            "define(s = der(y)^2 + 2*x^2), observe(s)",
            "3:23 E705 adds m² to m²/s²; is a `der(…)` missing?",
        ),
        (
            "potential = m*l*(g*y + y)",
            "3:24 E705 adds m to m²/s²; a factor in m/s² is missing",
        ),
        (
            "observe(both = [y, y] + [y^2, y^2])",
            "3:25 E705 adds m² to m; a factor in 1/m is missing",
        ),
        (
            "potential = m*g",
            "3:13 E704 a potential energy is in J, and this is in N; a factor in m is missing",
        ),
        (
            "potential = 9.81*m*y",
            "3:13 E704 a potential energy is in J, and this is in kg m; `9.81` is a plain number: make it a field with `#[lagrange(unit = \"m/s²\")]`",
        ),
        (
            "kinetic(slide: a/2*der(x)^2), potential = 9.81*a*x",
            "3:43 E704 a potential energy is in J, and this is in kg m; `9.81` is a plain number: make it a field with `#[lagrange(unit = \"m/s²\")]`",
        ),
        (
            "potential = m*g*l*cos(x)",
            "3:23 E704 the argument of `cos` is a plain number, and this is in m; a factor in 1/m is missing",
        ),
        (
            "potential = m*g*l*2^y",
            "3:21 E704 an exponent is a plain number, and this is in m; a factor in 1/m is missing",
        ),
        (
            "constraint(c: x^2 + y^2 == l)",
            "3:28 E706 compares m with m²; a factor in m is missing",
        ),
        (
            "constraint(c: x == 1)",
            "3:20 E706 compares a plain number with m; a number has no unit: make it a field with `#[lagrange(unit = \"m\")]`",
        ),
        (
            "constraint(c: der(x) == l*theta)",
            "3:25 E706 compares m with m/s; is a `der(…)` missing?",
        ),
        (
            "contact(c: 1 <= y)",
            "3:12 E706 compares a plain number with m; a number has no unit: make it a field with `#[lagrange(unit = \"m\")]`",
        ),
        (
            "contact(c: theta >= 0), friction(s on c: slip = der(x), static = a)",
            "3:39 E707 the force of `c` is in N m, and what presses is in N",
        ),
        (
            "contact(c: y >= 0), friction(s on c: slip = der(theta), static = a)",
            "3:45 E704 a slip is in m/s, and this is in 1/s; a factor in m is missing",
        ),
        (
            "contact(c: y >= 0), friction(s on c: slip = der(x), static = f)",
            "3:62 E704 a coefficient of friction is a plain number, and this is in N; a factor in s²/(kg m) is missing",
        ),
        ("contact(c: y >= 0, restitution = l)", "3:34 E704 "),
        ("contact(c: y >= 0, where theta >= l)", "3:35 E706 "),
        (
            "force(p: x = f*l)",
            "3:14 E704 a force along `x` is in N, and this is in N m; a factor in 1/m is missing",
        ),
        (
            "force(p: theta = f)",
            "3:18 E704 a force along `theta` is in N m, and this is in N; a factor in m is missing",
        ),
        (
            "force(p: (0, -m) at (x, y))",
            "3:14 E704 a force at this point is in N, and this is in kg; a factor in m/s² is missing",
        ),
        ("force(p: f along l*der(x))", "3:10 E704 "),
        (
            "dissipation(w: m*der(x)^2)",
            "3:16 E704 a dissipation is in W, and this is in J; is a `der(…)` missing?",
        ),
        (
            "contact(c: y >= 0), check(c == m*l when closed(c))",
            "3:32 E706 compares kg m with N; a factor in 1/s² is missing",
        ),
        (
            "start(s: der(x) = l)",
            "3:19 E704 `der(x)` is in m/s, and this is in m; is a `der(…)` missing?",
        ),
        (
            "observe(o = x + theta)",
            "3:17 E705 adds a plain number to m; a factor in m is missing",
        ),
        (
            "observe(o = x + der(x))",
            "3:17 E705 adds m/s to m; is there a `der(…)` too many?",
        ),
        ("define(u = [x, y] + [l, 1])", "3:21 E705 "),
        ("define(u = dot([x, theta], [y, y]))", "3:12 E705 "),
        (
            "observe(o = min(x, der(y)))",
            "3:20 E708 chooses between m and m/s; is there a `der(…)` too many?",
        ),
        (
            "force(p: x = f*min(1, t/1))",
            "3:20 E708 chooses between s and a plain number; a number has no unit: make it a field with `#[lagrange(unit = \"s\")]`",
        ),
        (
            "potential = f*if(x >= l, x, 1)",
            "3:29 E708 chooses between m and a plain number; a number has no unit: make it a field with `#[lagrange(unit = \"m\")]`",
        ),
        ("stop(s: x >= 0 and theta >= l)", "3:29 E706 "),
        (
            "friction(s: slip = der(theta), limit = f)",
            "3:40 E704 the friction force along this slip is in N m, and this is in N; a factor in m is missing",
        ),
        (
            "potential = a*x, force(p: theta = a)",
            "3:35 E704 a force along `theta` is in N m, and this is in N; `a` must be in N elsewhere: give it a unit, or another name here",
        ),
    ];
    for (items, expected) in &wrong {
        let said = said(items);
        assert!(
            said.starts_with(expected) && said.lines().count() == 1,
            "{items}\n  said {said}"
        );
    }
}

#[test]
fn the_term_that_differs_is_told() {
    let said = |items: &str| read(&with(items)).err().unwrap_or_default();
    let two = "kinetic = m/2*(der(x)^2 + y^2) + inertia/2*der(theta) + m/2*der(q[0])^2, potential = a*q[1]^2";
    assert_eq!(
        said(two),
        "2:27 E705 adds m² to m²/s²; is a `der(…)` missing?\n2:34 E705 adds kg m²/s to J; is a `der(…)` missing?"
    );
}

#[test]
fn texts_of_units() {
    let system = read(&with(&format!(
        "{KINETIC}, potential = m*g*y + a/2*x^2 + b/2*theta^2,
        constraint(rod: x^2 + y^2 == l^2), constraint(roll: der(x) == l*der(theta)), constraint(turn: theta == sin(t*l/x*d[0])),
        contact(c: y >= 0), contact(w: theta >= 0), friction(s on c: slip = der(x), static = 1/2),
        force(p: (f, f) at (x, y)), force(r: theta = f*l), dissipation(h: f*der(x)),
        observe(e = energy, u = momentum(theta), v = der(x), c, s, d2 = x*y, k = theta, x)"
    )));
    let system = system.unwrap();
    let parameters: Vec<(&str, &str)> = system
        .parameters
        .iter()
        .map(|parameter| (parameter.name.as_str(), parameter.unit.as_str()))
        .filter(|(name, _)| ["a", "b", "inertia", "d[0]", "d[1]"].contains(name))
        .collect();
    assert_eq!(
        parameters,
        [
            ("inertia", "kg m²"),
            ("a", "kg/s²"),
            ("b", "J"),
            ("d[0]", "1/s"),
            ("d[1]", "1/s")
        ]
    );
    let units = &system.units;
    assert_eq!(units.energy, "J");
    assert_eq!(units.constraints, ["N/m", "N", "N m"]);
    assert_eq!(units.contacts, ["N", "N m"]);
    assert_eq!(units.frictions, ["N"]);
    assert_eq!(units.forces, ["N", "N m"]);
    assert_eq!(units.dissipations, ["W"]);
    assert_eq!(
        units.observes,
        ["J", "kg m²/s", "m/s", "N", "N", "m²", "rad", "m"]
    );
}

#[test]
fn energies_per_mass_are_remarked() {
    let orbit = "#[lagrange(
        coordinates(x: \"m\", y: \"m\"),
        kinetic = (der(x)^2 + der(y)^2)/2,
        potential = -mu/sqrt(x^2 + y^2),
        constraint(line: x == y),
    )]
    struct Orbit { mu: f64 }";
    let system = read(orbit).unwrap();
    assert_eq!(system.parameters[0].unit, "m³/s²");
    assert_eq!(
        (
            system.units.energy.as_str(),
            system.units.constraints[0].as_str()
        ),
        ("m²/s²", "m/s²")
    );
    assert_eq!(system.hints.len(), 1, "{:?}", system.hints);
    // A mass somewhere: then it is a mistake.
    let with_mass = orbit.replace("{ mu", "{ #[lagrange(unit = \"kg\")] m: f64, mu");
    assert!(
        read(&with_mass)
            .err()
            .unwrap()
            .starts_with("3:19 E704 a kinetic energy is in J, and this is in m²/s²")
    );
    // A mistake elsewhere does not make the energies wrong, and is told alone.
    for (from, to, told) in [
        (
            "x == y",
            "x == y + 1",
            "5:35 E705 adds a plain number to m; ",
        ),
        ("der(y)^2", "y^2", "3:31 E705 adds m² to m²/s²; "),
        (
            "x == y)",
            "x == y), start(s: x = mu)",
            "5:48 E704 `x` is in m, and this is in m³/s²; ",
        ),
    ] {
        let said = read(&orbit.replace(from, to)).err().unwrap();
        assert!(
            said.starts_with(told) && said.lines().count() == 1,
            "{said}"
        );
    }
}

#[test]
fn without_units_nothing_is_checked() {
    let angle = "#[lagrange(coordinates(theta: \"rad\"), kinetic = der(theta)^2/2, potential = -cos(theta), observe(theta))] struct S {}";
    let system = read(angle).unwrap();
    assert_eq!(system.coordinates[0].unit, "rad");
    assert!(system.units.energy.is_empty() && system.units.observes.is_empty());
}

#[test]
fn sums_and_differences_of_angles_are_angles() {
    let system = read(
        "#[lagrange(
            coordinates(a: \"rad\", b: \"rad\", x: \"m\"),
            kinetic = inertia/2 * (der(a)^2 + der(b)^2) + mass/2 * der(x)^2,
            observe(twist = a - b - pi/2, turning = der(a) - der(b), swing = der(der(b)), arc = 57.3 * a, wave = sin(a), mixed = a + x/l,
                bearing = atan2(x, l), lead = atan(x/l) - b),
        )]
        struct S { #[lagrange(unit = \"kg m^2\")] inertia: f64, mass: f64, l: f64 }",
    );
    let units = system.unwrap_or_else(|error| panic!("{error}")).units;
    let expected = ["rad", "rad/s", "rad/s²", "", "", "", "rad", "rad"];
    assert_eq!(units.observes, expected);
}

#[test]
fn what_is_no_unit_is_told_at_its_text() {
    let said = |unit: &str| {
        let text =
            format!("#[lagrange(coordinates(x: \"{unit}\"), kinetic = der(x)^2)] struct S {{}}");
        read(&text).err().unwrap_or_default()
    };
    assert_eq!(
        said("mm"),
        "1:27 E702 `mm` is a multiple of m; numbers are not converted: write `m`, and give the values in it"
    );
    assert_eq!(
        said("deg"),
        "1:27 E702 `deg` is a multiple of rad; numbers are not converted: write `rad`, and give the values in it"
    );
    for (unit, coherent) in [
        ("rpm", "rad/s"),
        ("\u{b0}/s", "rad/s"),
        ("rev", "rad"),
        ("mrad", "rad"),
        ("%", "1"),
        ("kHz", "1/s"),
    ] {
        let told = format!("`{unit}` is a multiple of {coherent};");
        assert!(said(unit).contains(&told), "{}", said(unit));
    }
    for (unit, meant) in [
        ("Kg", "did you mean `kg`?"),
        ("Nms", "a product is written with a blank: `N m s`"),
        ("Nmm", "a product is written with a blank: `N mm`"),
        ("kgm^2", "a product is written with a blank: `kg m`"),
    ] {
        assert!(said(unit).contains(meant), "{}", said(unit));
    }
    assert_eq!(said("metre"), "1:27 E701 `metre` is not a unit; write `m`");
    assert_eq!(
        said("J/kg K"),
        "1:27 E703 it is not clear what stands under the stroke; use parentheses: `J/(kg K)`"
    );
}

/// Far more terms and fields than anyone writes, but a generated or hostile file may have them: work grows with their
/// number, not with its square.
#[test]
fn many_terms_and_fields_are_checked_in_proportion() {
    let terms = |n: usize| (1..=n).map(|k| format!("{k}*x")).collect::<Vec<_>>();
    fine(&format!("potential = f*({})", terms(100_000).join(" + ")));
    let one_wrong = format!("{} + m", terms(100_000).join(" + "));
    let said = said(&format!("potential = f*({one_wrong})"));
    assert!(said.contains("kg"), "{said}");

    let fields: Vec<String> = (0..20_000).map(|k| format!("a{k}")).collect();
    let declared: Vec<String> = fields.iter().map(|a| format!("{a}: f64")).collect();
    let forces: Vec<String> = fields.iter().map(|a| format!("{a}*x")).collect();
    let text = format!(
        "#[lagrange(coordinates(x: \"m\"), kinetic = m/2*der(x)^2, potential = {})]
         struct S {{ #[lagrange(unit = \"kg\")] m: f64, {} }}",
        forces.join(" + "),
        declared.join(", "),
    );
    let system = read(&text).expect("units that follow");
    assert!(system.parameters[1..].iter().all(|a| a.unit == "N"));
}
