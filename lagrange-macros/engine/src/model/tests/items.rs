//! Contacts at points, forces, attitude, frictions, starts and outputs.

use super::{at_names, close, number, read, with};
use crate::model::{Condition, Level, Normal};
use crate::symbolic::ExprId;

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

/// Axes against the rotation matrix and rates against ȧxis = ω × axis, at a unit quaternion that turns.
#[test]
fn attitude_turns_its_axes() {
    let system = read(
        "#[lagrange(coordinates(x), attitude(body: q),
            kinetic = der(x)^2/2 + sum(k in 0..3: inertia[k]/2 * body.body_rate[k]^2),
            start(spin: x = 1, der(q[1]) = 1), start(turned: q[3] = 1),
            observe(axis = body.axes[0], ay = body.axes[1], az = body.axes[2],
                rx = der(body.axes[0]), ry = der(body.axes[1]), rz = der(body.axes[2]),
                space = body.space_rate, inner = body.body_rate, pull = body))] struct S { inertia: [f64; 3] }",
    )
    .unwrap();
    // Turn by the angle a about n, while a and n change; the derivative is projected onto the sphere.
    let q = [
        0.5f64.cos(),
        0.48 * 0.5f64.sin(),
        0.6 * 0.5f64.sin(),
        0.64 * 0.5f64.sin(),
    ];
    let raw = [0.3, -0.7, 0.2, 1.1];
    let along: f64 = (0..4).map(|k| raw[k] * q[k]).sum();
    let state = |symbol| {
        let name = system.pool.name(symbol);
        let k = name
            .find(|c: char| c.is_ascii_digit())
            .map(|at| usize::from(name.as_bytes()[at] - b'0'));
        match (name.starts_with("q["), name.starts_with("der(q["), k) {
            (true, _, Some(k)) => q[k],
            (_, true, Some(k)) => raw[k] - along * q[k],
            _ => number(name),
        }
    };
    let outputs: Vec<ExprId> = system
        .observes
        .iter()
        .map(|observe| observe.value)
        .collect();
    let value = system.pool.evaluate(&outputs, &state, &|_| true);
    let list = |k: usize| [value[3 * k], value[3 * k + 1], value[3 * k + 2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let (space, inner) = (list(6), list(7));
    // Rodrigues: e₀ turned by 1 rad about n = (0.48, 0.6, 0.64).
    let (n, turn) = ([0.48, 0.6, 0.64], 1f64);
    for (j, expected) in [1.0, 0.0, 0.0].into_iter().enumerate() {
        let swept = cross(n, [1.0, 0.0, 0.0])[j];
        close(
            list(0)[j],
            expected * turn.cos() + swept * turn.sin() + n[j] * n[0] * (1.0 - turn.cos()),
        );
    }
    for (i, &along) in inner.iter().enumerate() {
        for j in 0..3 {
            close(dot(list(i), list(j)), if i == j { 1.0 } else { 0.0 });
            close(list(3 + i)[j], cross(space, list(i))[j]);
        }
        close(along, dot(list(i), space));
    }
    let unit = &system.constraints[0];
    assert_eq!(
        (unit.name.text.as_str(), unit.level),
        ("body", Level::Position)
    );
    close(
        system.pool.evaluate(&[unit.residual], &state, &|_| true)[0],
        0.0,
    );
    assert_eq!(system.coordinates.len(), 5);
    // A start without an orientation stands upright.
    assert_eq!(
        system.starts[0]
            .positions
            .iter()
            .map(|(k, _)| *k)
            .collect::<Vec<_>>(),
        [0, 1]
    );
    assert_eq!(system.starts[1].positions.len(), 1);
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
