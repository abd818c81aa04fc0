//! Declarations in, systems or mistakes out.

use super::{Condition, Level, Normal, System};
use crate::diagnostics::Diagnostics;
use crate::symbolic::ExprId;

mod bare;
mod inverse;
mod items;
mod mistakes;
mod structure;
mod units;

pub(crate) use bare::{bare, item};

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
        .map(|branch| branch.then.clone())
        .collect();
    assert_eq!(
        guards,
        ["x - y >= 0", "x <= y", "a >= 0"],
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

/// Elements of one declaration are told apart by what stands in the place of the index.
#[test]
fn branches_of_elements_have_their_own_names() {
    let system = with(
        "define(squeeze[k in 0..2] = q[k + 1] - k*a), define(wear = sum(k in 0..2: max(-squeeze[k], 0))),
         force(push: x = if(wear >= sum(i in 0..2: abs(q[i])), 1, 2)), force(rub[k in -1..1]: sign(q[k + 1] + k) along der(y))",
    )
    .unwrap();
    let mut sides: Vec<&str> = (system.branches.iter())
        .flat_map(|branch| [branch.then.as_str(), branch.otherwise.as_str()])
        .collect();
    sides.sort();
    assert_eq!(
        sides,
        [
            "-squeeze[0] < 0",
            "-squeeze[0] >= 0",
            "-squeeze[1] < 0",
            "-squeeze[1] >= 0",
            "q[0] - 1 < 0",
            "q[0] - 1 >= 0",
            "q[0] < 0",
            "q[0] >= 0",
            "q[1] < 0",
            "q[1] >= 0",
            "wear < sum(i in 0..2: abs(q[i]))",
            "wear >= sum(i in 0..2: abs(q[i]))",
        ]
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
         contact(floor: y >= 0), constraint(pure while floor: der(x) == 0), constraint(d: der(p) == 0), define(p = theta)",
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

/// Squares that cancel leave a linear constraint, though its form is of second degree.
#[test]
fn linear_is_meant_not_written() {
    let system = with("constraint(c: (der(x) + y)^2 - der(x)^2 == a)").unwrap();
    assert_eq!(system.constraints[0].level, Level::Velocity);
    let cancelling = "contact(c: x >= 0), kinetic(k: (der(x) + 1)^3 - der(x)^3)";
    assert!(with(cancelling).is_ok());
}
