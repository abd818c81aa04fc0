//! Goal: a false check never passes and a true one never fails, on generated identities.
//!
//! True ones are textbook results in other forms; false ones have one mistake. That a mistake makes a difference is
//! decided without the engine: both sides in plain f64 at states that are written down by hand.

use super::rewriting::{Dice, State, expr, mistaken, transformed, value};
use crate::checked;

/// A textbook result.
struct Fact {
    items: &'static str,
    fields: &'static str,
    /// Left side; the right side; when.
    left: &'static str,
    right: &'static str,
    when: &'static str,
    /// Coordinates, and what depends on the rest in the mode: `r = radius`.
    coordinates: &'static str,
    dependent: &'static [(&'static str, &'static str)],
    /// Two expressions that vanish in the mode.
    zeros: &'static [&'static str],
}

const SHELL: &str = "coordinates(r, theta), define(x = r*sin(theta), y = r*cos(theta)),
    kinetic = m/2*(der(x)^2 + der(y)^2), potential = m*g*y, contact(shell: r >= radius)";
const SPHERE: &str = "coordinates(r, theta, phi), define(x = r*sin(theta), y = r*cos(theta)),
    kinetic = m/2*(der(x)^2 + der(y)^2) + 1/5*m*a^2*der(phi)^2, potential = m*g*y,
    contact(shell: r >= radius + a),
    friction(grip on shell: slip = radius*der(theta) - a*(der(phi) - der(theta)), static = mu_s, kinetic = mu_k)";
const WHEEL: &str = "coordinates(x, phi, r, theta), define(px = x + r*sin(theta), py = r*cos(theta)),
    kinetic = wheel/2*der(x)^2 + inertia/2*der(phi)^2 + m/2*(der(px)^2 + der(py)^2), potential = m*g*py,
    constraint(rolling: der(x) == radius*der(phi)), contact(rim: r >= radius),
    friction(grip on rim: slip = radius*(der(theta) - der(phi)), static = mu_s, kinetic = mu_k)";
const PENDULUM: &str = "coordinates(x, y), kinetic = m/2*(der(x)^2 + der(y)^2), potential = m*g*y,
    constraint(rod: x^2 + y^2 == l^2)";
const PENDULUM_ROOT: &str =
    "coordinates(x, y), kinetic = m/2*(der(x)^2 + der(y)^2), potential = m*g*y,
    constraint(rod: sqrt(x^2 + y^2) == l)";
const HOOP: &str = "coordinates(theta),
    define(x = radius*sin(theta)*cos(w*t), y = radius*sin(theta)*sin(w*t), z = -radius*cos(theta)),
    kinetic = m/2*(der(x)^2 + der(y)^2 + der(z)^2), potential = m*g*z";
const DOUBLE: &str = "coordinates(p, q),
    define(x1 = l1*sin(p), y1 = -l1*cos(p), x2 = x1 + l2*sin(q), y2 = y1 - l2*cos(q)),
    kinetic = m1/2*(der(x1)^2 + der(y1)^2) + m2/2*(der(x2)^2 + der(y2)^2), potential = g*(m1*y1 + m2*y2)";
const CART: &str = "coordinates(x, theta), define(px = x + l*sin(theta), py = l*cos(theta)),
    kinetic = cart/2*der(x)^2 + m/2*(der(px)^2 + der(py)^2), potential = m*g*py";
const KEPLER: &str =
    "coordinates(r, phi), kinetic = 1/2*(der(r)^2 + r^2*der(phi)^2), potential = -mu/r";
const KEPLER_XY: &str =
    "coordinates(x, y), kinetic = 1/2*(der(x)^2 + der(y)^2), potential = -mu/sqrt(x^2 + y^2)";
const DRAG: &str = "coordinates(x), kinetic = m/2*der(x)^2, potential = k/2*x^2,
    force(drag: x = -c*exp(b*x)*der(x)^2)";
const BODIES: &str =
    "coordinates(x, y), kinetic = m1/2*der(x)^2 + m2/2*der(y)^2, potential = -m1*g*x - m2*g*y,
    constraint(rope: x + y == l)";

const CLOSED: &[(&str, &str)] = &[("r", "radius"), ("der(r)", "0*r")];
const STUCK: &[(&str, &str)] = &[
    ("r", "radius + a"),
    ("der(r)", "0*r"),
    ("der(phi)", "(radius + a)*der(theta)/a"),
];
const SLIDING: &[(&str, &str)] = &[("r", "radius + a"), ("der(r)", "0*r")];
const CIRCLE: &[(&str, &str)] = &[("l", "sqrt(x^2 + y^2)"), ("der(y)", "-x*der(x)/y")];

#[rustfmt::skip]
const FACTS: &[Fact] = &[
    Fact { items: SHELL, fields: "m g radius", left: "shell", right: "m*g*cos(theta) - m*radius*der(theta)^2",
        when: "closed(shell)", coordinates: "r theta", dependent: CLOSED, zeros: &["r - radius", "der(r)"] },
    Fact { items: SHELL, fields: "m g radius", left: "der(der(theta))", right: "g*sin(theta)/radius",
        when: "closed(shell)", coordinates: "r theta", dependent: CLOSED, zeros: &["r^2 - radius^2", "der(r)"] },
    Fact { items: SHELL, fields: "m g radius", left: "der(der(r))", right: "r*der(theta)^2 - g*cos(theta)",
        when: "open(shell)", coordinates: "r theta", dependent: &[], zeros: &[] },
    Fact { items: SHELL, fields: "m g radius", left: "der(der(theta))", right: "(g*sin(theta) - 2*der(r)*der(theta))/r",
        when: "open(shell)", coordinates: "r theta", dependent: &[], zeros: &[] },
    Fact { items: SPHERE, fields: "m g radius a mu_s mu_k", left: "der(der(theta))", right: "5/7*g*sin(theta)/(radius + a)",
        when: "sticks(grip)", coordinates: "r theta phi", dependent: STUCK,
        zeros: &["r - radius - a", "r*der(theta) - a*der(phi)"] },
    Fact { items: SPHERE, fields: "m g radius a mu_s mu_k", left: "grip", right: "-2/7*m*g*sin(theta)",
        when: "closed(shell) and sticks(grip)", coordinates: "r theta phi", dependent: STUCK,
        zeros: &["r - radius - a", "r*der(theta) - a*der(phi)"] },
    Fact { items: SPHERE, fields: "m g radius a mu_s mu_k", left: "shell",
        right: "m*g*cos(theta) - m*(radius + a)*der(theta)^2",
        when: "closed(shell)", coordinates: "r theta phi", dependent: SLIDING, zeros: &["r - radius - a", "der(r)"] },
    Fact { items: SPHERE, fields: "m g radius a mu_s mu_k", left: "der(der(theta))",
        right: "mu_k*der(theta)^2 + g/(radius + a)*(sin(theta) - mu_k*cos(theta))",
        when: "slips(grip) and slip(grip) >= 0", coordinates: "r theta phi", dependent: SLIDING, zeros: &["der(r)"] },
    Fact { items: SPHERE, fields: "m g radius a mu_s mu_k", left: "der(der(phi))",
        right: "5/2*mu_k*(g*cos(theta) - (radius + a)*der(theta)^2)/a",
        when: "slips(grip) and slip(grip) >= 0", coordinates: "r theta phi", dependent: SLIDING, zeros: &["der(r)"] },
    Fact { items: WHEEL, fields: "wheel inertia m radius g mu_s mu_k", left: "der(der(theta))",
        right: "m*radius*sin(theta)*(g + radius*der(theta)^2)/(wheel*radius^2 + inertia + 2*m*radius^2*(1 + cos(theta)))",
        when: "sticks(grip)", coordinates: "x phi r theta",
        dependent: &[("r", "radius"), ("der(r)", "0*r"), ("der(phi)", "der(theta)"), ("der(x)", "radius*der(theta)")],
        zeros: &["r - radius", "der(theta) - der(phi)", "der(x) - r*der(theta)"] },
    Fact { items: WHEEL, fields: "wheel inertia m radius g mu_s mu_k", left: "der(der(x))", right: "0*r", when: "open(rim)",
        coordinates: "x phi r theta", dependent: &[("der(x)", "radius*der(phi)")], zeros: &["der(x) - radius*der(phi)"] },
    Fact { items: PENDULUM, fields: "m g l", left: "rod", right: "m*(g*y - der(x)^2 - der(y)^2)/(2*l^2)", when: "",
        coordinates: "x y", dependent: CIRCLE, zeros: &["x^2 + y^2 - l^2", "x*der(x) + y*der(y)"] },
    Fact { items: PENDULUM, fields: "m g l", left: "der(der(x))", right: "x*(g*y - der(x)^2 - der(y)^2)/l^2", when: "",
        coordinates: "x y", dependent: CIRCLE, zeros: &["x^2 + y^2 - l^2", "x*der(x) + y*der(y)"] },
    Fact { items: PENDULUM_ROOT, fields: "m g l", left: "rod", right: "m*(g*y - der(x)^2 - der(y)^2)/l", when: "",
        coordinates: "x y", dependent: CIRCLE, zeros: &["sqrt(x^2 + y^2) - l", "x*der(x) + y*der(y)"] },
    Fact { items: HOOP, fields: "m g radius w", left: "der(der(theta))", right: "sin(theta)*(w^2*cos(theta) - g/radius)",
        when: "", coordinates: "theta", dependent: &[], zeros: &[] },
    Fact { items: DOUBLE, fields: "l1 l2 m1 m2 g", left: "der(der(p))",
        right: "(-g*(2*m1 + m2)*sin(p) - m2*g*sin(p - 2*q)
            - 2*sin(p - q)*m2*(der(q)^2*l2 + der(p)^2*l1*cos(p - q)))/(l1*(2*m1 + m2 - m2*cos(2*p - 2*q)))",
        when: "", coordinates: "p q", dependent: &[], zeros: &[] },
    Fact { items: DOUBLE, fields: "l1 l2 m1 m2 g", left: "der(der(q))",
        right: "2*sin(p - q)*(der(p)^2*l1*(m1 + m2) + g*(m1 + m2)*cos(p) + der(q)^2*l2*m2*cos(p - q))
            /(l2*(2*m1 + m2 - m2*cos(2*p - 2*q)))",
        when: "", coordinates: "p q", dependent: &[], zeros: &[] },
    Fact { items: CART, fields: "cart m l g", left: "der(der(theta))",
        right: "((cart + m)*g*sin(theta) - m*l*der(theta)^2*sin(theta)*cos(theta))/(l*(cart + m*sin(theta)^2))",
        when: "", coordinates: "x theta", dependent: &[], zeros: &[] },
    Fact { items: CART, fields: "cart m l g", left: "der(der(x))",
        right: "m*sin(theta)*(l*der(theta)^2 - g*cos(theta))/(cart + m*sin(theta)^2)",
        when: "", coordinates: "x theta", dependent: &[], zeros: &[] },
    Fact { items: KEPLER, fields: "mu", left: "der(der(r))", right: "r*der(phi)^2 - mu/r^2",
        when: "", coordinates: "r phi", dependent: &[], zeros: &[] },
    Fact { items: KEPLER, fields: "mu", left: "der(momentum(phi)^2/r)", right: "-r^2*der(phi)^2*der(r)",
        when: "", coordinates: "r phi", dependent: &[], zeros: &[] },
    Fact { items: KEPLER_XY, fields: "mu", left: "der(der(y)*(x*der(y) - y*der(x)))",
        right: "mu*(der(x)*(x^2 + y^2) - x*(x*der(x) + y*der(y)))/(x^2 + y^2)^(3/2)",
        when: "", coordinates: "x y", dependent: &[], zeros: &[] },
    Fact { items: DRAG, fields: "m k c b", left: "der(der(x))", right: "-k/m*x - c*exp(b*x)*der(x)^2/m",
        when: "", coordinates: "x", dependent: &[], zeros: &[] },
    Fact { items: DRAG, fields: "m k c b", left: "der(energy)", right: "-c*exp(b*x)*der(x)^3",
        when: "", coordinates: "x", dependent: &[], zeros: &[] },
    Fact { items: BODIES, fields: "m1 m2 g l", left: "rope", right: "-2*m1*m2*g/(m1 + m2)",
        when: "", coordinates: "x y", dependent: &[("l", "x + y"), ("der(y)", "-der(x)")],
        zeros: &["x + y - l", "der(x) + der(y)"] },
];

/// Random positive numbers for everything, then what depends on them.
fn state(fact: &Fact, dice: &mut Dice) -> State {
    let mut state = State::new();
    let coordinates = fact.coordinates.split_whitespace();
    let rates = coordinates.clone().map(|name| format!("der({name})"));
    let fields = fact.fields.split_whitespace().chain(coordinates);
    let names = fields.map(str::to_owned).chain(rates);
    for name in names.chain(["t".to_owned()]) {
        state.insert(name, 0.3 + 1.1 * dice.unit());
    }
    for (name, text) in fact.dependent {
        let value = value(&expr(text), &state);
        state.insert((*name).to_owned(), value);
    }
    state
}

/// Largest relative difference at states of the mode.
fn difference(fact: &Fact, a: &str, b: &str, dice: &mut Dice) -> f64 {
    let (a, b) = (expr(a), expr(b));
    let differences = (0..5).map(|_| {
        let state = state(fact, dice);
        let (a, b) = (value(&a, &state), value(&b, &state));
        (a - b).abs() / (1e-3 + a.abs().max(b.abs()))
    });
    differences.fold(0.0, f64::max)
}

#[test]
fn false_checks_fail_and_true_ones_are_proven() {
    let mut dice = Dice::new(2026);
    let (mut true_ones, mut false_ones) = (0, 0);
    for fact in FACTS {
        let other = fact.coordinates.split_whitespace().next().unwrap();
        let when = match fact.when {
            "" => String::new(),
            when => format!(" when {when}"),
        };
        let original = expr(fact.right);
        let (mut checks, mut wrong) = (
            format!("check(given: {} == {original}{when})", fact.left),
            Vec::new(),
        );
        for k in 0..6 {
            let equal = transformed(&original, &mut dice, other, fact.zeros).to_string();
            let gap = difference(fact, &equal, fact.right, &mut dice);
            assert!(gap < 1e-9, "{equal} is not {}: {gap:e}", fact.right);
            checks += &format!(",\ncheck(yes{k}: {} == {equal}{when})", fact.left);
            true_ones += 1;
        }
        while wrong.len() < 6 {
            let equal = transformed(&original, &mut dice, other, fact.zeros);
            let text = mistaken(&equal, &mut dice).to_string();
            let text = expr(&text).to_string();
            // Some mistakes make no difference.
            if difference(fact, &text, fact.right, &mut dice) > 1e-11 {
                let k = wrong.len();
                checks += &format!(",\ncheck(no{k}: {} == {text}{when})", fact.left);
                wrong.push(format!("`{} == {text}` does not hold", fact.left));
                false_ones += 1;
            }
        }
        let fields = fact.fields.split_whitespace().chain(["unused"]);
        let fields: String = fields.map(|f| format!("{f}: f64, ")).collect();
        let text = format!(
            "#[lagrange({}, {checks})] struct S {{ {fields} }}",
            fact.items
        );
        let Err(mistakes) = checked(text.parse().unwrap()) else {
            panic!("all passed:\n{checks}");
        };
        let messages: Vec<&str> = mistakes.iter().map(|one| one.message.as_str()).collect();
        let expected: Vec<&str> = wrong.iter().map(String::as_str).collect();
        let matches = messages.len() == expected.len()
            && messages
                .iter()
                .zip(&expected)
                .all(|(m, e)| m.starts_with(e));
        assert!(
            matches,
            "{checks}\n\nexpected {expected:#?}\nfound {messages:#?}"
        );
        // Without the false ones all are proven, not merely tested.
        let kept: Vec<&str> = checks
            .split(",\n")
            .filter(|c| !c.starts_with("check(no"))
            .collect();
        let text = format!(
            "#[lagrange({}, {})] struct S {{ {fields} }}",
            fact.items,
            kept.join(",\n")
        );
        let verdicts = checked(text.parse().unwrap()).map(|(_, verdicts)| verdicts);
        for verdict in verdicts.unwrap_or_else(|mistakes| panic!("{mistakes}")) {
            let proven = matches!(verdict.outcome, crate::check::Outcome::Proven { .. });
            assert!(proven, "{verdict:?}");
        }
    }
    assert!(true_ones + false_ones >= 300, "{true_ones} + {false_ones}");
}
