//! Declarations in, systems or mistakes out.

use super::{Condition, Level, Normal, System};
use crate::diagnostics::Diagnostics;
use crate::symbolic::ExprId;

/// DESIGN's example.
pub(crate) const MASS_ON_WHEEL: &str = r#"
/// A small mass carried up and thrown off by the rim of a rolling wheel.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, phi, r: "m", theta),
    define(
        px = x + r * sin(theta),
        py = r * cos(theta),
    ),
    kinetic   = wheel/2 * der(x)^2 + inertia/2 * der(phi)^2 + mass/2 * (der(px)^2 + der(py)^2),
    potential = mass * gravity * py,
    constraint(rolling: der(x) == radius * der(phi)),
    contact(rim: r >= radius, restitution = 0),
    friction(grip on rim: slip = radius * (der(theta) - der(phi)), static = mu_static, kinetic = mu_kinetic),
    start(rest: r = radius, theta = 1/20),
    observe(height = py),
    stop(floor: py <= -radius and open(rim)),
)]
pub struct MassOnWheel<T = f64> {
    /// Mass of the wheel, kg.
    #[lagrange(unit = "kg", tex = "M")]
    pub wheel: T,
    pub inertia: T,
    pub mass: T,
    pub gravity: T,
    pub radius: T,
    pub mu_static: T,
    pub mu_kinetic: T,
}
"#;

fn read(text: &str) -> Result<System, String> {
    let mut sink = Diagnostics::new();
    let declaration = crate::parse::declaration(text.parse().unwrap(), &mut sink);
    let system = declaration.and_then(|declaration| super::system(&declaration, &mut sink));
    match system {
        Some(system) => {
            assert!(sink.is_empty(), "{sink}");
            Ok(system)
        }
        None => {
            assert!(!sink.is_empty(), "no system and no mistake: {text}");
            Err(sink.to_string().trim_end().to_string())
        }
    }
}

/// Value of an expression at a state that depends on the symbols' names only.
fn at_names(system: &System, e: ExprId) -> f64 {
    system
        .pool
        .evaluate(&[e], &|symbol| number(system.pool.name(symbol)), &|_| true)[0]
}

/// A number in (0.5, 1.5) for every name.
fn number(name: &str) -> f64 {
    let sum = name.bytes().fold(7u64, |sum, byte| {
        sum.wrapping_mul(31).wrapping_add(u64::from(byte))
    });
    0.5 + (sum % 1009) as f64 / 1009.0
}

#[track_caller]
fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-14 * (1.0 + b.abs()), "{a} and {b}");
}

#[test]
fn mass_on_wheel_is_what_a_hand_writes() {
    let system = read(MASS_ON_WHEEL).unwrap();
    let n = |name: &str| number(name);
    let (x, r, theta) = (n("x"), n("r"), n("theta"));
    let (vx, vphi, vr, vtheta) = (n("der(x)"), n("der(phi)"), n("der(r)"), n("der(theta)"));
    let _ = x;
    // Velocity of the mass by hand.
    let vpx = vx + vr * theta.sin() + r * theta.cos() * vtheta;
    let vpy = vr * theta.cos() - r * theta.sin() * vtheta;
    let kinetic = n("wheel") / 2.0 * vx.powi(2)
        + n("inertia") / 2.0 * vphi.powi(2)
        + n("mass") / 2.0 * (vpx.powi(2) + vpy.powi(2));
    close(at_names(&system, system.kinetic[0].energy), kinetic);
    close(
        at_names(&system, system.potential[0].energy),
        n("mass") * n("gravity") * r * theta.cos(),
    );
    assert_eq!(system.coordinates.len(), 4);
    assert_eq!(system.coordinates[2].unit, "m");
    assert_eq!(system.parameters.len(), 7);
    let rolling = &system.constraints[0];
    assert_eq!(rolling.level, Level::Velocity);
    close(at_names(&system, rolling.residual), vx - n("radius") * vphi);
    close(at_names(&system, system.contacts[0].gap), r - n("radius"));
    let grip = &system.frictions[0];
    assert!(matches!(grip.normal, Normal::Contact(0)));
    close(
        at_names(&system, grip.slip[0].0),
        n("radius") * (vtheta - vphi),
    );
    assert_eq!(system.starts[0].positions.len(), 2);
    assert_eq!(system.observes[0].name.text, "height");
    assert_eq!(system.stops[0].conditions, [Condition::Open(0)]);
    close(
        at_names(&system, system.stops[0].terms[0]),
        -n("radius") - r * theta.cos(),
    );
    assert_eq!(system.core.to_string(), ":: lagrange_core");
}

/// A chain of n links with point masses, in ten lines.
#[test]
fn chain_is_its_closed_form() {
    const N: usize = 5;
    let system = read(&format!(
        "#[lagrange(
            coordinates(theta[{N}]),
            define(
                px[k in 0..{N}] = sum(i in 0..k+1: length[i]*sin(theta[i])),
                py[k in 0..{N}] = -sum(i in 0..k+1: length[i]*cos(theta[i])),
            ),
            kinetic = sum(k in 0..{N}: mass[k]/2 * (der(px[k])^2 + der(py[k])^2)),
            potential = gravity * sum(k in 0..{N}: mass[k] * py[k]),
        )] struct Chain {{ mass: [f64; {N}], length: [f64; {N}], gravity: f64 }}"
    ))
    .unwrap();
    let of = |name: &str, k: usize| number(&format!("{name}[{k}]"));
    let rate = |k: usize| number(&format!("der(theta[{k}])"));
    let (mut kinetic, mut potential) = (0.0, 0.0);
    for k in 0..N {
        // |Σ lᵢ eᵢ ωᵢ|² = Σᵢⱼ lᵢ lⱼ ωᵢ ωⱼ cos(θᵢ − θⱼ)
        for i in 0..=k {
            potential -= of("mass", k) * number("gravity") * of("length", i) * of("theta", i).cos();
            for j in 0..=k {
                let angle = (of("theta", i) - of("theta", j)).cos();
                kinetic += of("mass", k) / 2.0
                    * of("length", i)
                    * of("length", j)
                    * rate(i)
                    * rate(j)
                    * angle;
            }
        }
    }
    close(at_names(&system, system.kinetic[0].energy), kinetic);
    close(at_names(&system, system.potential[0].energy), potential);
    assert_eq!(system.coordinates[3].name.text, "theta[3]");
    assert_eq!(system.coordinates[3].name.element, Some((3, N)));
    assert_eq!(system.parameters[2].name, "mass[2]");
}

/// `coordinates(x, y, r, theta)` and fields `a b g l` with these items.
fn with(items: &str) -> Result<System, String> {
    read(&format!(
        "#[lagrange(coordinates(x, y, r, theta, q[3]), kinetic = der(x)^2 + der(y)^2 + der(r)^2 + der(theta)^2,\n{items})] struct S {{ a: f64, b: f64, g: f64, l: [f64; 3] }}"
    ))
}

/// Value of `observe(e = …)` beside other items.
#[track_caller]
fn observed(expression: &str, items: &str) -> f64 {
    let system = with(&format!("observe(e = {expression}), {items}")).unwrap();
    at_names(&system, system.observes[0].value)
}

#[test]
fn derivatives_are_total() {
    let (x, y, t) = (number("x"), number("y"), number("t"));
    let (vx, vy) = (number("der(x)"), number("der(y)"));
    let (ax, ay) = (number("der(der(x))"), number("der(der(y))"));
    close(
        observed("der(x*y + t^2*x)", ""),
        vx * y + x * vy + 2.0 * t * x + t * t * vx,
    );
    close(
        observed("der(der(x*y))", ""),
        ax * y + 2.0 * vx * vy + x * ay,
    );
    close(observed("der(p)", "define(p = x^2)"), 2.0 * x * vx);
    close(
        observed("der(v)", "define(v = der(x*y))"),
        ax * y + 2.0 * vx * vy + x * ay,
    );
    close(observed("der(a)", ""), 0.0);
}

#[test]
fn lists_work_by_component() {
    let (x, y, r, a) = (number("x"), number("y"), number("r"), number("a"));
    close(
        observed("dot(p, [1, 2])", "define(p = [x, y] - a*[1, r]/2)"),
        x - a / 2.0 + 2.0 * (y - a * r / 2.0),
    );
    close(observed("norm([x, y])", ""), x.hypot(y));
    close(observed("cross([x, y, r], [1, 2, 3])[1]", ""), r - 3.0 * x);
    close(observed("cross([x, y], [1, 2])", ""), 2.0 * x - y);
    close(observed("der([x, y])[1]", ""), number("der(y)"));
    close(
        observed("sum(i in 0..3: l[i]*q[i])", ""),
        (0..3)
            .map(|i| number(&format!("l[{i}]")) * number(&format!("q[{i}]")))
            .sum(),
    );
    close(observed("sum(i in 0..2: [q[i], 1])[1]", ""), 2.0);
    close(observed("sum(i in 2..2: x)", ""), 0.0);
    close(
        observed("sum(i in 0..3: if(i >= 1, q[i-1], x))", ""),
        x + number("q[0]") + number("q[1]"),
    );
    close(
        observed("sum(i in 0..2: sum(j in i..2: x^i*y^j))", ""),
        1.0 + y + x * y,
    );
    close(observed("m[2]", "define(m[k in 2..4] = k*x)"), 2.0 * x);
}

#[test]
fn piecewise_functions_become_branches() {
    let system = with(
        "observe(e = abs(x - y) + max(x, y) + min(x, y) + sign(a) + if(x >= y, 1, 2) + abs(-3))",
    )
    .unwrap();
    let guards: Vec<String> = system
        .branches
        .iter()
        .map(|branch| branch.text.clone())
        .collect();
    assert_eq!(
        guards,
        ["abs(x - y)", "min(x, y)", "sign(a)"],
        "equal guards share a branch"
    );
    let (x, y) = (2.0, 5.0);
    let value = |then: &dyn Fn(usize) -> bool| {
        let symbols = |symbol| match system.pool.name(symbol) {
            "x" => x,
            "y" => y,
            _ => -1.0,
        };
        system
            .pool
            .evaluate(&[system.observes[0].value], &symbols, then)[0]
    };
    // x < y: branch 0 (x − y ≥ 0) is off, branch 1 (y − x ≥ 0) on, a < 0.
    close(
        value(&|branch| branch == 1),
        3.0 + 5.0 + 2.0 - 1.0 + 2.0 + 3.0,
    );
}

#[test]
fn lagrangian_is_split_at_rest() {
    let system = read(
        "#[lagrange(coordinates(x, y), lagrangian = m/2*(der(x)^2 + der(y)^2) + b*(x*der(y) - y*der(x)) - m*g*y,
            observe(e = energy, p = momentum(x)))] struct S { m: f64, b: f64, g: f64 }",
    )
    .unwrap();
    assert!(system.from_lagrangian);
    let n = number;
    let quadratic = n("m") / 2.0 * (n("der(x)").powi(2) + n("der(y)").powi(2));
    let linear = n("b") * (n("x") * n("der(y)") - n("y") * n("der(x)"));
    close(
        at_names(&system, system.kinetic[0].energy),
        quadratic + linear,
    );
    close(
        at_names(&system, system.potential[0].energy),
        n("m") * n("g") * n("y"),
    );
    close(
        at_names(&system, system.observes[0].value),
        quadratic + n("m") * n("g") * n("y"),
    );
    close(
        at_names(&system, system.observes[1].value),
        n("m") * n("der(x)") - n("b") * n("y"),
    );
}

#[test]
fn constraints_find_their_level() {
    let system = with(
        "constraint(rod: x^2 + y^2 == t^2), constraint(roll: der(x*y) == a*der(theta)),
         contact(floor: y >= 0), constraint(pure while floor: der(x) == 0), constraint(d: der(p) == 0), define(p = x)",
    )
    .unwrap();
    let levels: Vec<Level> = system
        .constraints
        .iter()
        .map(|constraint| constraint.level)
        .collect();
    assert_eq!(
        levels,
        [
            Level::Position,
            Level::Velocity,
            Level::Velocity,
            Level::Velocity
        ]
    );
    assert_eq!(system.constraints[2].while_contact, Some(0));
}

#[test]
fn point_of_a_contact_gives_the_normal() {
    // The gap in halves of a metre: N = λ/2 · … by hand |∂gap/∂p| = 1/2.
    let factor = |items: &str| {
        let system = with(items).unwrap();
        at_names(&system, system.contacts[0].normal_factor.unwrap())
    };
    close(factor("contact(c: y/2 >= 0 at (x, y))"), 0.5);
    close(
        factor("contact(c: r*cos(theta) >= 0 at (r*sin(theta), r*cos(theta)))"),
        1.0,
    );
    close(
        factor("contact(c: r^2 >= 1 at (r*sin(theta), r*cos(theta)))"),
        2.0 * number("r"),
    );
    close(
        factor("contact(c: x + y + r >= 0 at (x, y, r))"),
        3f64.sqrt(),
    );
    close(factor("contact(c: 3*x >= 0 at x)"), 3.0);
    // The carrier moves along: the point has to be relative to it.
    let moving = "contact(c: r >= a at (x + r*sin(theta), r*cos(theta)))";
    assert!(with(moving).err().unwrap().contains("E508"));
    close(
        factor("contact(c: r >= a at (r*sin(theta), r*cos(theta)))"),
        1.0,
    );
}

#[test]
fn forces_act_by_virtual_work() {
    let system = with(
        "contact(c[k in 0..2]: q[k] >= 0), constraint(rod: x^2 + y^2 == 1), define(px = r*sin(theta), py = r*cos(theta)),
         force(push: (a, b*x) at (px, py)), force(turn: theta = a*der(r)), force(drag[k in 0..3]: -a along der(q[k])),
         force(brake: a*c[1] + rod along a*der(theta) - der(x)),
         observe(f = push, d = drag[2], h = c[0] + rod, s = gap(c[1]))",
    )
    .unwrap();
    let n = number;
    let push = &system.forces[0];
    let (fx, fy) = (n("a"), n("b") * n("x"));
    close(at_names(&system, push.value), fx.hypot(fy));
    assert_eq!(
        push.generalized.iter().map(|(j, _)| *j).collect::<Vec<_>>(),
        [2, 3]
    );
    close(
        at_names(&system, push.generalized[0].1),
        fx * n("theta").sin() + fy * n("theta").cos(),
    );
    close(
        at_names(&system, push.generalized[1].1),
        n("r") * (fx * n("theta").cos() - fy * n("theta").sin()),
    );
    assert_eq!(system.forces.len(), 6);
    assert_eq!(system.forces[3].name.text, "drag[1]");
    assert_eq!(system.forces[3].generalized[0].0, 5);
    let brake = &system.forces[5];
    let f = n("a") * n("c[1]") + n("rod");
    close(at_names(&system, brake.generalized[0].1), -f);
    close(at_names(&system, brake.generalized[1].1), n("a") * f);
    close(at_names(&system, system.observes[0].value), n("push"));
    close(at_names(&system, system.observes[1].value), n("drag[2]"));
    close(
        at_names(&system, system.observes[2].value),
        n("c[0]") + n("rod"),
    );
    close(at_names(&system, system.observes[3].value), n("q[1]"));
}

#[test]
fn frictions_and_starts_and_outputs() {
    let system = with(
        "contact(c[k in 1..3]: q[k] >= 0 at (q[k], x)), constraint(rod: x^2 + y^2 == 1),
         friction(f[k in 1..3] on c[k]: slip = der(x), static = a), friction(s on rod: slip = (der(x), der(y)), static = a, kinetic = b),
         friction(n: slip = der(x), normal = a*x^2, static = 1), friction(m: slip = der(x), limit = (2*a, a)),
         start(up: x = a, der(x) = -2, q[k in 0..2] = k*a, q[2] = 7), start(rest), start(all: q = [1, 2, 3]),
         observe(e = s[1], q, i[k in 0..2] = k*x), stop(low: y <= a and slips(s) and closed(c[2])), mark(top: der(y))",
    )
    .unwrap();
    assert_eq!(system.frictions.len(), 5);
    assert!(matches!(system.frictions[1].normal, Normal::Contact(1)));
    assert_eq!(system.frictions[1].name.text, "f[2]");
    assert!(matches!(system.frictions[2].normal, Normal::Constraint(0)));
    assert_eq!(system.frictions[2].slip.len(), 2);
    assert!(matches!(system.frictions[3].normal, Normal::Given(_)));
    close(
        at_names(&system, system.frictions[4].static_coefficient),
        2.0 * number("a"),
    );
    let start = &system.starts[0];
    assert_eq!(
        start.positions.iter().map(|(j, _)| *j).collect::<Vec<_>>(),
        [0, 4, 5, 6]
    );
    close(at_names(&system, start.positions[2].1), number("a"));
    assert_eq!(start.velocities.len(), 1);
    assert_eq!(system.starts[2].positions.len(), 3);
    let names: Vec<&str> = system
        .observes
        .iter()
        .map(|observe| observe.name.text.as_str())
        .collect();
    assert_eq!(names, ["e", "q[0]", "q[1]", "q[2]", "i[0]", "i[1]"]);
    assert_eq!(
        system.stops[0].conditions,
        [Condition::Slips(2), Condition::Closed(1)]
    );
    assert!(system.marks[0].zeros);
}

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
        ("define(t = x)", "2:8 E203"),
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
        ("potential = 10^30*10^30*x", "2:1 E312"),
        ("potential = der(der(x))", "2:13 E401"),
        ("kinetic(k: der(der(x)))", "2:12 E402"),
        ("define(w = der(der(x))), kinetic(k: w)", "2:37 E402"),
        ("observe(j = der(der(der(x))))", "2:13 E404"),
        ("contact(c: x >= 0), observe(j = der(c))", "2:33 E404"),
        ("start(s: x = y)", "2:14 E403"),
        ("start(s: x = der(y))", "2:14 E403"),
        ("start(s: a = 1)", "2:10 E206"),
        ("start(s: x = 1, x = 2)", "2:17 E510"),
        ("start(s: q[k in 0..4] = 1)", "2:20 E305"),
        ("start(s: q = 1)", "2:14 E303"),
        ("potential = energy", "2:13 E405"),
        ("contact(c: x >= 0), potential = gap(c)", "2:33 E405"),
        ("contact(c: x >= 0), potential = c", "2:33 E406"),
        ("contact(c: x >= 0), dissipation(d: c*der(x))", "2:36 E406"),
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
        ("kinetic = x", "2:1 E511"),
        ("lagrangian = x", "1:47 E503"),
        ("contact(c: x >= 0), kinetic(k: der(x)^4)", "1:47 E507"),
        ("attitude(body: z)", "2:1 E019"),
        ("potential(p: theta_dot)", "2:14 E201"),
    ];
    let mut failures = String::new();
    for (items, expected) in wrong {
        let found = match with(items) {
            Ok(_) => "nothing wrong".to_string(),
            Err(found) => found,
        };
        let places: Vec<String> = found
            .lines()
            .map(|line| line.split(' ').take(2).collect::<Vec<_>>().join(" "))
            .collect();
        if places != [expected] {
            failures += &format!("{items}\n  expected {expected}\n  found {found}\n");
        }
    }
    assert!(failures.is_empty(), "{failures}");
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
        "2:15 E206 `x` is a coordinate, not a contact or constraint; there is `rim`"
    );
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
