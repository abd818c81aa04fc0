//! Small declarations → their modes.

use super::{Mode, all, pinned, pins, structures};
use crate::derive::Equations;
use crate::symbolic::{ExprId, Pool, Symbol};

/// Equations of a point in the plane or in space with these items.
fn equations(items: &str) -> Equations {
    let text = format!(
        "#[lagrange(
            coordinates(x, y, z),
            kinetic(point: m/2 * (der(x)^2 + der(y)^2 + der(z)^2)),
            {items}
        )]
        struct Point {{ m: f64, mu: f64, a: f64, b: f64 }}"
    );
    let program = crate::program(text.parse().expect("tokens"));
    program
        .unwrap_or_else(|mistakes| panic!("{mistakes}"))
        .equations
}

const FLOOR: &str = "contact(floor: y >= 0),";
const WALL: &str = "contact(wall: x >= a),";
const RUB: &str = "friction(rub on floor: slip = der(x), static = mu),";
const RUB_IN_SPACE: &str = "friction(rub on floor: slip = (der(x), der(z)), static = mu),";
const BRAKE: &str = "friction(brake: slip = der(z), limit = mu),";
const GUIDE: &str = "constraint(guide while floor: der(z) == 0),";
const SLEEVE: &str = "friction(sleeve on guide: slip = der(x), static = mu),";

#[test]
fn all_modes_of_small_systems() {
    let table: [(&[&str], &[&str]); 7] = [
        (&[], &["smooth"]),
        (&[FLOOR], &["floor open", "floor closed"]),
        (
            &[FLOOR, RUB],
            &[
                "floor open",
                "floor closed, rub sticks",
                "floor closed, rub slips forward",
                "floor closed, rub slips backward",
            ],
        ),
        (
            &[FLOOR, RUB_IN_SPACE],
            &[
                "floor open",
                "floor closed, rub sticks",
                "floor closed, rub slips",
            ],
        ),
        (
            &[BRAKE],
            &[
                "brake sticks",
                "brake slips forward",
                "brake slips backward",
            ],
        ),
        // Friction on a constraint that holds while a contact is closed acts with that contact.
        (
            &[FLOOR, GUIDE, SLEEVE],
            &[
                "floor open",
                "floor closed, sleeve sticks",
                "floor closed, sleeve slips forward",
                "floor closed, sleeve slips backward",
            ],
        ),
        (
            &[FLOOR, WALL, "contact(roof: y <= b),"],
            &[
                "floor open, wall open, roof open",
                "floor closed, wall open, roof open",
                "floor open, wall closed, roof open",
                "floor open, wall open, roof closed",
                "floor closed, wall closed, roof open",
                "floor closed, wall open, roof closed",
                "floor open, wall closed, roof closed",
                "floor closed, wall closed, roof closed",
            ],
        ),
    ];
    for (items, expected) in table {
        let system = equations(&items.concat()).system;
        let modes: Vec<Mode> = all(&system).iter().collect();
        let names: Vec<String> = modes.iter().map(|mode| mode.name(&system)).collect();
        assert_eq!(names, expected);
        assert_eq!(all(&system).count(), expected.len() as u128);
        for (mode, name) in modes.iter().zip(expected) {
            assert_eq!(Mode::named(&system, name).as_ref(), Some(mode));
        }
    }
}

/// Stories and plots say together what items have in common, and which sides of branches hold.
#[test]
fn modes_are_found_by_what_stories_call_them() {
    let items = [
        FLOOR,
        WALL,
        RUB,
        BRAKE,
        "contact(roof: y <= b),",
        "potential = max(x, 0),",
    ];
    let system = equations(&items.concat()).system;
    let found = |name: &str| Mode::named(&system, name).map(|mode| mode.name(&system));
    for (told, name) in [
        (
            "floor and wall closed, roof open, rub and brake stick",
            "floor closed, wall closed, roof open, rub sticks, brake sticks",
        ),
        (
            "all 3 contacts open, brake slips forward",
            "floor open, wall open, roof open, brake slips forward",
        ),
        (
            "all 3 contacts closed, all 2 frictions slip backward, x >= 0",
            "floor closed, wall closed, roof closed, rub slips backward, brake slips backward",
        ),
        (
            "floor, wall and roof open, brake sticks, 3 more conditions",
            "floor open, wall open, roof open, brake sticks",
        ),
    ] {
        assert_eq!(found(told).as_deref(), Some(name), "{told}");
    }
    for wrong in [
        "all 2 contacts open, brake sticks",
        "all 3 contacts open, all 2 frictions stick",
        "floor and wall, brake sticks",
        "2 of 3 contacts open, brake sticks",
    ] {
        assert_eq!(found(wrong), None, "{wrong}");
    }
}

/// The sign of a slip is an argument; a friction that is left out leaves its contact closed without friction. A constraint can be
/// left out where it acts, with no friction on it.
#[test]
fn structures_of_small_systems() {
    let table: [(&[&str], usize, &[&str], bool); 4] = [
        (
            &[FLOOR, GUIDE, SLEEVE],
            16,
            &[
                "floor open",
                "floor closed, sleeve sticks",
                "floor closed, sleeve slips",
                "floor closed",
                "floor closed, without guide",
            ],
            true,
        ),
        (
            &[FLOOR, RUB],
            16,
            &[
                "floor open",
                "floor closed, rub sticks",
                "floor closed, rub slips",
                "floor closed",
            ],
            true,
        ),
        (
            &[FLOOR, RUB_IN_SPACE],
            5,
            &[
                "floor open",
                "floor closed, rub sticks",
                "floor closed, rub slips",
                "floor closed, rub begins to slip",
                "floor closed",
            ],
            true,
        ),
        (
            &[FLOOR, RUB, BRAKE],
            4,
            &[
                "floor open, brake sticks",
                "floor open, brake slips",
                "floor open",
                "floor closed, rub sticks, brake sticks",
            ],
            false,
        ),
    ];
    for (items, most, expected, is_complete) in table {
        let system = equations(&items.concat()).system;
        let (modes, complete) = structures(&system, most);
        let names: Vec<String> = modes.iter().map(|mode| mode.name(&system)).collect();
        assert_eq!(names, expected);
        assert_eq!(complete, is_complete);
    }
}

/// Of 2^200 modes nobody lists more than are asked for.
#[test]
fn many_contacts() {
    let system = equations("contact(stop[k in 0..200]: x >= k * a),").system;
    let (modes, complete) = structures(&system, 202);
    let closed = modes.iter().map(|mode| {
        let contacts = 0..mode.contacts.len();
        contacts.filter(|&i| mode.contacts[i]).collect::<Vec<_>>()
    });
    let closed: Vec<_> = closed.collect();
    assert_eq!(closed[..2], [vec![], vec![0]]);
    assert_eq!(closed[200..], [vec![199], vec![0, 1]]);
    assert!(!complete && all(&system).count() == u128::MAX);
}

#[test]
fn rows_that_act_and_rows_with_a_force() {
    let system = equations(&[FLOOR, WALL, GUIDE, RUB_IN_SPACE, BRAKE].concat()).system;
    // Rows: guide, floor, wall, rub along x and z, brake.
    let table: [(&str, &[usize], &[usize]); 4] = [
        ("brake sticks", &[5], &[5]),
        ("wall closed, brake slips forward", &[2], &[2, 5]),
        (
            "floor closed, rub sticks, brake sticks",
            &[0, 1, 3, 4, 5],
            &[0, 1, 3, 4, 5],
        ),
        (
            "floor closed, rub slips, brake sticks",
            &[0, 1, 5],
            &[0, 1, 3, 4, 5],
        ),
    ];
    for (name, acting, loaded) in table {
        let mode = Mode::named(&system, name).expect(name);
        assert_eq!(mode.acting_rows(&system), acting, "{name}");
        assert_eq!(mode.loaded_rows(&system), loaded, "{name}");
    }
}

/// What is put into the equations of the mode of this name.
fn put_in(equations: &Equations, pool: &mut Pool, name: &str) -> Vec<(Symbol, ExprId)> {
    let mode = Mode::named(&equations.system, name).expect(name);
    let acting = mode.acting_rows(&equations.system);
    let pins = pins(equations, pool, &acting);
    pinned(equations, pool, &pins)
}

#[test]
fn pinned_coordinates() {
    let items = [
        FLOOR,
        WALL,
        "contact(roof: y <= 2 * a + b),",
        "contact(slope: y >= z),",
        "contact(gate: z >= a * t),",
        "contact(scaled: 2 * z >= a),",
        "constraint(held: z == b),",
    ];
    let mut equations = equations(&items.concat());
    let mut pool = std::mem::take(&mut equations.system.pool);
    let mut said = |name: &str| {
        let known = put_in(&equations, &mut pool, name);
        let print = |(symbol, value)| format!("{} = {}", pool.name(symbol), pool.print(value));
        let positions = known.into_iter().step_by(3);
        positions.map(print).collect::<Vec<_>>().join(", ")
    };
    assert_eq!(said(""), "z = b");
    assert_eq!(said("floor closed, wall closed"), "z = b, y = 0, x = a");
    assert_eq!(said("roof closed"), "z = b, y = 2*a + b");
    // The second row that fixes y is a row like others, and so are those of two coordinates, of time, and not of unit slope.
    assert_eq!(said("floor closed, roof closed"), "z = b, y = 0");
    assert_eq!(said("slope closed, gate closed, scaled closed"), "z = b");
}

/// A mode whose place makes something infinite is planned with the place as a number that comes at run time; other places are put in.
#[test]
fn places_at_which_something_is_infinite_are_not_put_in() {
    let ground = "contact(end: x >= 0),";
    let wall = "contact(end: x <= 1),";
    let quarter = "contact(end: x <= pi/2),";
    let half = "contact(end: x <= pi),";
    let given = "contact(end: x >= a),";
    let infinite = [
        (ground, "potential = m * x - mu * ln(x)"),
        (ground, "potential = 1/x"),
        (ground, "potential = x^(-2)"),
        (ground, "potential = x^(-3/2)"),
        (ground, "potential = sqrt(x)"),
        (ground, "potential = x^(1/3)"),
        (ground, "potential = 1/abs(x)"),
        (ground, "potential = 1/max(x, 0)"),
        (ground, "potential = sin(x)/x"),
        (ground, "potential = 1/tan(x)"),
        (ground, "potential = 1/atan(x) + 1/tanh(x)"),
        (ground, "potential = 1/(1 - cosh(x))"),
        (ground, "potential = 1/(exp(x) - 1)"),
        (ground, "potential = exp(1/x)"),
        (ground, "potential = 1/((x + a + b) * m - a * m - b * m)"),
        (ground, "kinetic(more: mu * der(y)^2/x)"),
        (ground, "kinetic(more: mu * der(x)^2/x)"),
        (ground, "force(push: y = ln(x))"),
        (ground, "force(push: y = x * ln(x))"),
        (ground, "force(push: y = der(x)/x)"),
        (ground, "force(push: y = 1/(x^2 + a * x))"),
        (ground, "force(push: y = end/x)"),
        (ground, "dissipation(drag: der(y)^2/x)"),
        (ground, "stop(near: 1/x >= 10)"),
        (ground, "mark(near: der(der(y))/x >= 10)"),
        (
            ground,
            "friction(rub on end: slip = der(y), static = 1/x, kinetic = mu)",
        ),
        (
            ground,
            "friction(rub on end: slip = der(y), static = mu, kinetic = 1/x)",
        ),
        (ground, "friction(brake: slip = der(y), limit = 1/x)"),
        (ground, "contact(other: y >= 0, where 1/x >= 3)"),
        (ground, "constraint(hyperbola: y == 1/x)"),
        ("constraint(end: x == 0),", "potential = 1/x"),
        (quarter, "potential = 1/cos(x)"),
        (half, "potential = 1/sin(x)"),
        (wall, "potential = 1/(1 - x)"),
        (wall, "potential = ln(1 - x)"),
        (wall, "potential = acos(x)"),
        (wall, "potential = asin(x)"),
        (wall, "force(push: x = -der(x)/(1 - x))"),
        (given, "potential = ln(x - a)"),
        (given, "potential = 1/(x^2 - a^2)"),
    ];
    let finite = [
        (ground, "potential = 1/(x + a)"),
        (ground, "potential = abs(x)"),
        (ground, "potential = x^(3/2)"),
        (ground, "potential = cos(x) + tan(x) + atan2(x, 1)"),
        (ground, "force(push: y = sqrt(x) + sign(x))"),
        (ground, "observe(inverse = 1/x)"),
        (wall, "potential = 1/x"),
        (given, "potential = ln(x)"),
    ];
    let put_in = |end: &str, items: &str| {
        let mut equations = equations(&format!("{end}{items},"));
        let mut pool = std::mem::take(&mut equations.system.pool);
        let mut mode = Mode::open(&equations.system);
        mode.contacts
            .iter_mut()
            .take(1)
            .for_each(|closed| *closed = true);
        let acting = mode.acting_rows(&equations.system);
        let pins = pins(&equations, &mut pool, &acting);
        let held: Vec<usize> = pins.iter().map(|pin| pin.coordinate).collect();
        assert_eq!(held, [0], "{end} {items}");
        let known = pinned(&equations, &mut pool, &pins);
        let place = equations.system.coordinates[0].position;
        known.iter().any(|&(symbol, _)| symbol == place)
    };
    for (end, items) in infinite {
        assert!(!put_in(end, items), "{end} {items}");
    }
    for (end, items) in finite {
        assert!(put_in(end, items), "{end} {items}");
    }
}

/// Two places that make something infinite together are both left, and so is a velocity; the others are put in.
#[test]
fn only_what_makes_something_infinite_is_not_put_in() {
    let items = "
        contact(floor: y >= 0), contact(wall: x >= 0), constraint(held: z == b),
        potential = 1/(x + y),
        force(thrust: z = 1/der(y)),";
    let mut equations = equations(items);
    let mut pool = std::mem::take(&mut equations.system.pool);
    let mut said = |name: &str| {
        let known = put_in(&equations, &mut pool, name);
        let names = known.iter().map(|&(symbol, _)| pool.name(symbol));
        let rates = names.filter(|name| !name.starts_with("der(der"));
        rates.collect::<Vec<_>>().join(" ")
    };
    assert_eq!(said(""), "z der(z)");
    assert_eq!(said("floor closed"), "z der(z) y");
    assert_eq!(said("floor closed, wall closed"), "z der(z) der(x)");
}

/// Of one constraint that carries two frictions the sign is chosen once.
#[test]
fn signs_of_normal_forces() {
    let items = "
        constraint(wire: z == b),
        friction(one on wire: slip = der(x), static = mu),
        friction(two on wire: slip = der(y), static = mu),";
    let system = equations(items).system;
    let signed = |name: &str| {
        let mode = Mode::named(&system, name).expect(name);
        mode.with_normal_signs(&system).len()
    };
    assert_eq!(signed("one sticks, two sticks"), 1);
    assert_eq!(signed("one slips forward, two sticks"), 2);
    assert_eq!(signed("one slips forward, two slips backward"), 2);
}
