//! Wrong declarations: what is reported, where, and how often.

use super::{read, with};
use crate::diagnostics::tests::mistakes_are_at;
use crate::model::shouting;

/// (items from line 2 on, mistakes as `line:col code`)
#[test]
fn mistakes_point_at_their_token() {
    let wrong = [
        ("potential = g*thetta", "2:15 E201"),
        ("potential = g*der(x)", "2:15 E401"),
        ("define(v = der(x)), potential = v", "2:33 E401"),
        ("contact(c: der(x) >= 0)", "2:12 E401"),
        ("contact(a: x >= 0)", "2:9 E202"),
        ("contact(sin: x >= 0)", "2:9 E203"),
        ("define(der = x)", "2:8 E203"),
        ("contact(_: x >= 0)", "2:9 E203"),
        ("observe(x, y, x)", "2:15 E510"),
        ("emit = data, emit = loops", "2:14 E510"),
        ("impacts = in_turn, impacts = together", "2:20 E510"),
        ("define(t = x)", "2:8 E203"),
        (
            "define(along = x), potential = a*along + along^2",
            "2:8 E203",
        ),
        ("potential = a*along", "2:15 E203"),
        ("constraint(c: [x, y] == [y, a])", "2:15 E302"),
        ("define(u = sum(a in 0..2: x))", "2:16 E204"),
        ("define(u = w, w = u)", "2:19 E205"),
        ("friction(f on x: slip = der(x), static = a)", "2:15 E206"),
        ("friction(f on c: slip = der(x), static = a)", "2:15 E201"),
        (
            "contact(c[k in 0..2]: q[k] >= 0), friction(f on c: slip = der(x), static = a)",
            "2:49 E206",
        ),
        ("constraint(c while a: der(x) == 0)", "2:20 E206"),
        (
            "contact(c: y >= 0), constraint(d while c: x == 0)",
            "2:34 E505",
        ),
        ("constraint(c: der(x)^2 == a)", "2:15 E504"),
        ("constraint(c: der(x)*der(y) == a)", "2:15 E504"),
        ("constraint(c: a == b)", "2:15 E506"),
        ("contact(c: a >= b)", "2:12 E506"),
        (
            "contact(c: x >= 0), friction(f on c: slip = x, static = a)",
            "2:45 E506",
        ),
        (
            "contact(c: x >= 0), friction(f on c: slip = norm([der(x), der(y)]), static = a)",
            "2:45 E504",
        ),
        ("potential = atan2(x)", "2:13 E301"),
        ("potential = sin(x, y)", "2:13 E301"),
        ("potential = max(x)", "2:13 E301"),
        ("potential = sine(x)", "2:13 E308"),
        ("potential = a(x + y)", "2:13 E308"),
        ("potential = log(x)", "2:13 E308"),
        ("potential = sin", "2:13 E206"),
        ("potential = q", "2:13 E302"),
        ("potential = q + 1", "2:17 E303"),
        ("potential = 1 + q", "2:17 E302"),
        ("potential = norm(x)", "2:18 E303"),
        ("potential = norm(q - [1, 2])", "2:22 E304"),
        ("potential = q*q", "2:15 E313"),
        ("potential = q[3]", "2:15 E305"),
        ("potential = q[x]", "2:15 E306"),
        ("potential = q[1/2]", "2:15 E306"),
        ("potential = x[1]", "2:13 E303"),
        ("potential = x/0", "2:15 E307"),
        ("potential = x/(1 - 1)", "2:15 E307"),
        ("potential = 0^-1", "2:13 E307"),
        ("potential = x.axes", "2:15 E309"),
        ("define(u[k in 3..3] = x)", "2:15 E310"),
        ("define(u[k in 0..1000000000] = x)", "2:15 E311"),
        // Lists in lists multiply: 8⁶ times three elements.
        (
            "define(m0 = list(i in 0..8: list(j in 0..8: q)), m1 = list(i in 0..8: list(j in 0..8: m0)), m2 = list(i in 0..8: list(j in 0..8: m1)))",
            "2:98 E311",
        ),
        ("potential = 10^30*10^30*x", "2:13 E312"),
        // 512^3 is more than exponents go up to: it is said where they first are.
        (
            "define(u = x^512, w = u^512, z = w^512), potential = z",
            "2:23 E312",
        ),
        (
            "define(u = 1/x^1000, w = sqrt(u)), potential = w^1000",
            "2:48 E312",
        ),
        ("contact(c: x >= 0 at (x, 0))", "2:22 E518"),
        ("contact(c: x >= 0 at (0, y))", "2:22 E508"),
        ("contact(c: x >= 0 at (y, 2*y))", "2:22 E508"),
        ("potential = der(der(x))", "2:13 E401"),
        ("kinetic(k: der(der(x)))", "2:12 E402"),
        ("define(w = der(der(x))), kinetic(k: w)", "2:37 E402"),
        ("observe(j = der(der(der(x))))", "2:13 E404"),
        ("contact(c: x >= 0), observe(j = der(c))", "2:33 E404"),
        ("start(s: x = y)", "2:14 E403"),
        ("start(s: x = der(y))", "2:14 E403"),
        ("start(s: x = der(y*t))", "2:14 E403"),
        ("start(s: a = 1)", "2:10 E206"),
        ("start(s: x = 1, x = 2)", "2:17 E510"),
        ("start(s: q[k in 0..4] = 1)", "2:20 E305"),
        ("start(s: q = 1)", "2:14 E303"),
        ("potential = energy", "2:13 E405"),
        ("contact(c: x >= 0), potential = gap(c)", "2:33 E405"),
        ("contact(c: x >= 0), potential = c", "2:33 E406"),
        ("contact(c: x >= 0), dissipation(d: c*a)", "2:36 E506"),
        (
            "constraint(c: x == 0), friction(f on (c, c): slip = der(y), static = 1)",
            "2:42 E510",
        ),
        (
            "constraint(c: x == 0), friction(f on (c, none): slip = der(y), static = 1)",
            "2:42 E201",
        ),
        (
            "constraint(c[k in 0..3]: q[k] == 0), friction(f on (c[0], c[1]): slip = der(y), static = 1), friction(other on (c[2], c[1]): slip = der(y), static = 1)",
            "2:119 E516",
        ),
        (
            "constraint(c[k in 0..3]: q[k] == 0), constraint(d: x == 0), friction(f on (c[0], c[1], c[2], d): slip = der(y), static = 1)",
            "2:76 E301",
        ),
        (
            "contact(c: x >= 0), dissipation(d: c^2*der(x))",
            "2:36 E509",
        ),
        (
            "contact(c: x >= 0), define(p = 2*c), potential = p",
            "2:34 E406",
        ),
        (
            "contact(c: x >= 0), define(p = c^2), force(f: x = p)",
            "2:51 E509",
        ),
        (
            "force(f: x = 1), define(p = 2*f), force(h: x = p)",
            "2:31 E406",
        ),
        ("contact(c: x >= 0), force(f: x = c^2)", "2:34 E509"),
        ("force(f: x = 1), force(h: x = f)", "2:31 E406"),
        ("force(f: (a, b) at (x, y, r))", "2:20 E304"),
        ("force(f: (a, b) at (1, 2))", "2:20 E506"),
        ("force(f: a along x)", "2:18 E506"),
        ("force(f: a = 1)", "2:10 E206"),
        ("dissipation(d: x)", "2:16 E506"),
        ("contact(c: x >= 0), observe(j = closed(c))", "2:33 E407"),
        ("stop(s: closed(x))", "2:16 E206"),
        ("start(s), observe(j = s)", "2:23 E207"),
        ("observe(h = x), potential = h", "2:29 E405"),
        ("kinetic = der(x)^2", "2:1 E511"),
        ("lagrangian = x", "1:47 E503"),
        ("contact(c: x >= 0), kinetic(k: der(x)^4)", "1:47 E507"),
        (
            "attitude(body: z), potential = body.axis[0][1]",
            "2:37 E309",
        ),
        (
            "attitude(body: z), potential = body.body_rate[0]",
            "2:37 E401",
        ),
        ("attitude(body: x)", "2:16 E202"),
        ("attitude(x: z)", "2:10 E202"),
        ("potential(p: theta_dot)", "2:14 E201"),
    ];
    mistakes_are_at(&wrong, |items| with(items).map(|_| ()));
}

/// rustc reads on behind an identifier with an emoji, once it has told it: a constant that it would refuse is another message.
#[test]
fn names_become_constants_that_rust_allows() {
    for (name, constant) in [
        ("muStatic", "MU_STATIC"),
        ("mu_static", "MU_STATIC"),
        ("θ2", "THETA2"),
        ("größe", "GRÖSSE"),
        ("e\u{301}", "E\u{301}"),
        ("a🚀", "AU1F680"),
        ("🚀", "U1F680"),
    ] {
        assert_eq!(shouting(name), constant);
        assert!(syn::parse_str::<syn::Ident>(constant).is_ok(), "{constant}");
    }
}

#[test]
fn hints_say_what_to_do() {
    let found = with("potential = g*thetta").err().unwrap();
    assert_eq!(
        found,
        "2:15 E201 `thetta` is not known; did you mean `theta`?"
    );
    let found = with("potential = theta_dot").err().unwrap();
    assert_eq!(
        found,
        "2:13 E201 `theta_dot` is not known; the velocity of `theta` is written `der(theta)`"
    );
    let found = with("friction(f on x: slip = der(x), static = a), contact(rim: x >= 0)")
        .err()
        .unwrap();
    assert_eq!(
        found,
        "2:15 E206 `x` is a coordinate, not a contact or constraint; known are `rim`"
    );
}

#[test]
fn what_is_meant_is_told() {
    for (items, told) in [
        (
            "observe(p = momentum)",
            "2:13 E206 `momentum` is a function, not a value; write `momentum(…)`",
        ),
        (
            "observe(e = kinetic)",
            "2:13 E201 `kinetic` is not known; `energy` is the whole energy; a part of it is named where it is declared: `define(part = …), kinetic = part`",
        ),
        (
            "start(s: vx = 1)",
            "2:10 E201 `vx` is not known; the velocity of `x` is written `der(x)`",
        ),
        (
            "start(s: xx = 1)",
            "2:10 E201 `xx` is not known; did you mean `x`?",
        ),
        (
            "coordinates(φ), observe(out = phi)",
            "2:31 E201 `phi` is not known; did you mean `φ`?",
        ),
        (
            "observe(speed)",
            "2:9 E201 `speed` is not known; velocities are written `der(…)`",
        ),
        (
            "attitude(body)",
            "2:14 E001 expected `:` and a name for its four coordinates, `body: q`, found the end",
        ),
        (
            "attitude(q)",
            "2:11 E001 expected `:` and a name for its four coordinates, `body: q`, found the end",
        ),
        (
            "contact(c: x >= 0 while t <= 1)",
            "2:19 E024 `while` is not an operator here; it stands behind the name of a constraint, `constraint(name while contact: a == b)`; a contact has a region, `, where c >= d`",
        ),
        (
            "contact(c: x >= 0, restitution = poison(a))",
            "2:34 E308 `poison` is not a function; did you mean `poisson`?",
        ),
        (
            "dissipation(d: x = -a*der(x))",
            "2:18 E024 `=` is not an operator here; what stands here is one value; a force along a coordinate is an item of its own, `force(name: x = …)`",
        ),
        (
            "observe(twice = 2*time)",
            "2:19 E201 `time` is not known; time is written `t`",
        ),
        (
            "constraint(c: x == 0 and theta == 0)",
            "2:22 E024 `and` is not an operator here; a constraint is one equation: write a constraint for each",
        ),
        (
            "contact(c: x >= 0, where theta >= 0, where theta <= 1)",
            "2:38 E017 `where` is given twice; a region is one comparison; for two write `where min(a, b) >= 0`",
        ),
        (
            "coordinates(z[2][3])",
            "2:17 E031 `[…]` stands in the wrong place; coordinates have one index: a name for each row, `x[3], y[3]`, or one for all, `x[6]`",
        ),
    ] {
        assert_eq!(with(items).err().unwrap(), told, "{items}");
    }
    with("define(part = a*x), potential(p: part), force(d: x = -a*der(x)), attitude(body: z), observe(q0 = momentum(x))").unwrap();
}

/// Branches are looked through in whatever order they are declared: those of another friction that contain those of this one, and the choice between the sides of a
/// gap.
#[test]
fn choices_by_velocities_are_seen_through_others() {
    let items = "friction(f: slip = der(y), limit = if(der(x) >= 0, a, 2*a)), \
        friction(h: slip = der(x) - if(t <= 1, a, 2*a), limit = if(der(x) >= if(t <= 1, a, 2*a), a, 2*a))";
    let said = with(items).err().unwrap();
    assert!(said.contains("E519"), "{said}");
    for gap in ["if(der(x) >= 0, y, y + x)", "y + x*sign(der(x))"] {
        let said = with(&format!("contact(c: {gap} >= 0)")).err().unwrap();
        assert!(said.contains("E401"), "{gap}: {said}");
    }
}

/// What holds is as strong one way as the other; a strength may fall with the slip differently in both directions, and be zero at rest.
#[test]
fn a_friction_has_one_strength_at_rest() {
    let friction =
        |strength: &str| with(&format!("friction(f: slip = der(x) - der(y), {strength})")).err();
    for strength in [
        "limit = if(slip >= 0, 0, a)",
        "limit = if(der(x) <= der(y), a, 2*a)",
        "limit = a*(2 + sign(slip))",
        "limit = a*max(0, sign(-slip))",
        "normal = a, static = if(slip <= 0, 0.2, 0.3)",
    ] {
        let said = friction(strength).unwrap_or_default();
        let at = format!("2:{} E519", 40 + strength.rfind(" = ").unwrap());
        assert!(
            said.starts_with(&at) && said.lines().count() == 1,
            "{strength}: {said}"
        );
    }
    for strength in [
        "limit = (2*a, if(slip >= 0, 0, a))",
        "limit = a*slip*sign(slip)",
        "limit = if(slip >= 0, a*exp(-slip), a*exp(3*slip))",
        "limit = if(der(x) >= 0, a, 2*a)",
        "normal = a, static = 0.2 + 0.1*exp(-abs(slip))",
        "normal = a, static = 0.4, kinetic = if(slip >= 0, 0.2, 0.3)",
    ] {
        assert_eq!(friction(strength), None, "{strength}");
    }
}

#[test]
fn an_equation_between_lists_is_told_how_to_be_written() {
    let found = with("constraint(joint: [x, y] == [y, a] + [a, x])")
        .err()
        .unwrap();
    assert_eq!(
        found,
        "2:19 E302 a list of 2 where a single value is expected; write an equation for each element, \
         `joint[k in 0..2]: [x, y][k] == ([y, a] + [a, x])[k]`"
    );
    // What is advised can be read.
    with("constraint(joint[k in 0..2]: [x, y][k] == ([y, a] + [a, x])[k])").unwrap();
}

#[test]
fn one_mistake_is_one_message() {
    let found = with(
        "define(p = undefined_name*x, s = p + 1), potential(one: p), potential(two: s), contact(c: p >= 0),
         friction(f on c: slip = der(p), static = a), observe(c2 = c + gap(c)), stop(end: closed(c)),
         observe(w[k in 0..3] = nowhere[k])",
    )
    .err()
    .unwrap();
    let codes: Vec<&str> = found
        .lines()
        .map(|line| line.split(' ').nth(1).unwrap())
        .collect();
    assert_eq!(codes, ["E201", "E201"], "{found}");
}

#[test]
fn what_every_system_needs() {
    let missing = |items: &str| {
        read(&format!("#[lagrange(\n{items})] struct S {{ a: f64 }}"))
            .err()
            .unwrap()
    };
    assert!(missing("kinetic = a").contains("E501"));
    assert!(missing("coordinates(x)").contains("E502"));
    assert!(missing("coordinates(x), lagrangian = a, lagrangian = a").contains("E510"));
}
