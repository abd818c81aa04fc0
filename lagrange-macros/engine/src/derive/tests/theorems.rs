//! The derivation against exact numeric derivatives of random Lagrangians, and against the energy theorem.

use super::hyperdual::evaluate;
use super::kit::Build;
use super::numbers::{Derived, Point, Random, close};
use super::systems;
use crate::derive::NeedId;
use crate::model::Level;
use crate::symbolic::{ExprId, Symbol};

/// Value and mixed derivative of an expression of the system: ε₁ along `first`, ε₂ along `second`, by name.
fn derivatives(d: &Derived, e: ExprId, point: &Point, first: &Point, second: &Point) -> [f64; 4] {
    let pool = &d.equations.system.pool;
    let at = |s: Symbol| {
        let name = pool.name(s);
        [
            point[name],
            first.get(name).copied().unwrap_or(0.0),
            second.get(name).copied().unwrap_or(0.0),
        ]
    };
    evaluate(pool, e, &at, &|branch| {
        d.evaluate(d.equations.system.branches[branch].guard, point) >= 0.0
    })
    .0
}

fn names(d: &Derived) -> Vec<String> {
    d.equations
        .system
        .coordinates
        .iter()
        .map(|c| c.name.text.clone())
        .collect()
}

/// The direction of motion: q̇ = v, v̇ = a, ṫ = 1.
fn motion(d: &Derived, point: &Point) -> Point {
    let mut direction = Point::from([("t".to_owned(), 1.0)]);
    for name in names(d) {
        direction.insert(format!("v_{name}"), point[&format!("a_{name}")]);
        direction.insert(name.clone(), point[&format!("v_{name}")]);
    }
    direction
}

/// d/dt ∂L/∂v − ∂L/∂q = M v̇ − f for any v̇.
fn check_euler_lagrange(d: &Derived, point: &Point) {
    let system = &d.equations.system;
    let along = motion(d, point);
    let still = Point::new();
    for (i, name) in names(d).iter().enumerate() {
        let (mut want, mut size) = (0.0, 1.0);
        let by_v = Point::from([(format!("v_{name}"), 1.0)]);
        let by_q = Point::from([(name.clone(), 1.0)]);
        for (terms, sign) in [(&system.kinetic, 1.0), (&system.potential, -1.0)] {
            for term in terms {
                let rate = derivatives(d, term.energy, point, &by_v, &along)[3];
                let slope = derivatives(d, term.energy, point, &by_q, &still)[1];
                want += sign * (rate - slope);
                size += rate.abs() + slope.abs();
            }
        }
        let inertial: f64 = names(d)
            .iter()
            .enumerate()
            .map(|(j, other)| d.mass(i, j, point) * point[&format!("a_{other}")])
            .sum();
        let got = inertial - d.forcing(i, point);
        assert!(
            (got - want).abs() <= 1e-11 * size,
            "{name}: got {got}, want {want}"
        );
    }
}

/// The balance that is kept whole is M v̇ − f for any v̇, and its M is M; whether there is one.
fn check_balance(d: &Derived, point: &Point) -> bool {
    let Some(whole) = &d.equations.balance else {
        return false;
    };
    let sum = |terms: &[(NeedId, ExprId)]| -> f64 {
        terms.iter().map(|&(_, e)| d.evaluate(e, point)).sum()
    };
    let names = names(d);
    for (i, terms) in whole.balance.iter().enumerate() {
        let (mut want, mut size) = (-d.forcing(i, point), 1.0 + d.forcing(i, point).abs());
        for (j, other) in names.iter().enumerate() {
            let mass = d.mass(i, j, point);
            let inertial = mass * point[&format!("a_{other}")];
            want += inertial;
            size += inertial.abs();
            let entry = whole.mass.get(&(i.max(j), i.min(j)));
            let got = entry.map_or(0.0, |terms| sum(terms));
            assert!(
                (got - mass).abs() <= 1e-11 * (1.0 + mass.abs()),
                "{got} {mass}"
            );
        }
        let got = sum(terms);
        assert!((got - want).abs() <= 1e-11 * size, "got {got}, want {want}");
    }
    true
}

/// A random expression of the positions, linear or not, never singular for arguments between 0.3 and 1.7.
fn random_position(random: &mut Random, names: &[&str]) -> String {
    let q = names[random.below(names.len())];
    let p = names[random.below(names.len())];
    match random.below(10) {
        0 => format!("sin({q})"),
        1 => format!("cos({q} - {p})"),
        2 => format!("{q}^2*{p}"),
        3 => format!("sqrt(1 + {q}^2)"),
        4 => format!("exp(-{q}*{p})"),
        5 => format!("{q}*cos({p})"),
        6 => format!("tanh({q} + t)"),
        7 => format!("{q}/(2 + {p})"),
        8 => format!("if({q} - {p}*1.1, {q}^2, 2*{p}*{q})"),
        _ => format!("{q}*sin(k*t)"),
    }
}

/// T of two or three points at random functions of the coordinates, V random.
fn random_system(random: &mut Random) -> Build {
    let names = ["a", "b", "c"];
    let mut energy = "1/2*J*(der(a)^2 + der(b)^2 + der(c)^2)".to_owned();
    for _ in 0..2 + random.below(2) {
        let (x, y) = (
            random_position(random, &names),
            random_position(random, &names),
        );
        energy.push_str(&format!(" + m/2*(der({x} + {y})^2 + der({x}*b - {y})^2)"));
    }
    if random.below(2) == 0 {
        energy.push_str(&format!(" + k*der(a)*{}", random_position(random, &names)));
    }
    let potential = format!(
        "k*{} + {}",
        random_position(random, &names),
        random_position(random, &names)
    );
    Build::new("a b c", "m J k")
        .kinetic("", &energy)
        .potential("", &potential)
}

#[test]
fn euler_lagrange_on_random_systems() {
    let mut random = Random::new(20260101);
    let mut whole = 0;
    for _ in 0..20 {
        let d = random_system(&mut random).derive();
        for _ in 0..3 {
            let point = d.point(&mut random);
            check_euler_lagrange(&d, &point);
            whole += usize::from(check_balance(&d, &point));
        }
    }
    assert!(whole > 0);
}

/// Three links of an arm with a spring, a damper and a motor: what is applied is a part of the balance.
#[test]
fn the_balance_of_a_driven_arm() {
    let mut random = Random::new(7);
    let d = Build::new("a b c", "m l k g")
        .define("x", "l*sin(a)")
        .define("y", "-l*cos(a)")
        .define("u", "x + l*sin(a + b)")
        .define("w", "y - l*cos(a + b)")
        .define("z", "u + l*sin(a + b + c)")
        .kinetic(
            "",
            "m/2*(der(x)^2 + der(y)^2) + m/2*(der(u)^2 + der(w)^2) + m/3*der(z)^2",
        )
        .potential("", "m*g*(y + w)")
        .potential("spring", "k/2*b^2")
        .load("motor", "k*sin(t)", &[(1, "k*sin(t)")])
        .dissipation("damper", "k/2*der(c)^2")
        .derive();
    for _ in 0..10 {
        let point = d.point(&mut random);
        assert!(check_balance(&d, &point));
    }
}

/// M depends on the velocities, so only the direct form of f exists.
#[test]
fn euler_lagrange_without_a_quadratic_form() {
    let mut random = Random::new(31);
    let q = ["a", "b", "c"];
    for _ in 0..10 {
        let (x, y) = (
            random_position(&mut random, &q),
            random_position(&mut random, &q),
        );
        let lagrangian =
            format!("(1 + der({x})^2 + der(b + {y})^2)^(3/2) + J*der(c)^2 - exp(der(a))*{x} + {y}");
        let d = Build::new("a b c", "m J k")
            .lagrangian(&lagrangian)
            .derive();
        let point = d.point(&mut random);
        check_euler_lagrange(&d, &point);
    }
}

#[test]
fn euler_lagrange_on_standard_systems() {
    let mut random = Random::new(11);
    for scene in [
        systems::mass_on_shell(),
        systems::rolling_sphere(),
        systems::mass_on_wheel(),
        systems::sphere_in_sphere(),
        systems::double_pendulum(),
        systems::cart_pole(),
        chain(5),
        chain(10),
    ] {
        let d = scene.derive();
        for _ in 0..3 {
            check_euler_lagrange(&d, &d.point(&mut random));
        }
    }
}

/// Nine coordinates, T a sum of squares and products of velocities that are no rates of positions, with weights of all kinds.
fn large_system(random: &mut Random) -> Build {
    let names: Vec<String> = (0..9).map(|i| format!("q{i}")).collect();
    let q: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut energy = "0".to_owned();
    for (i, name) in q.iter().enumerate() {
        energy.push_str(&format!(" + J/2*der({name})^2"));
        let mut speed = format!("{}*der({name})", random_position(random, &q));
        for _ in 0..random.below(4) {
            let other = q[random.below(q.len())];
            speed.push_str(&format!(" - {}*der({other})", random_position(random, &q)));
        }
        let weight = ["m/2", "k*m", "3/2", "m/(k + J)"][i % 4];
        energy.push_str(&format!(" + {weight}*({speed})^2"));
        let (other, factor) = (q[random.below(q.len())], random_position(random, &q));
        energy.push_str(&match i % 3 {
            0 => format!(" + k/9*({speed})*({factor}*der({other}) - der({name}))"),
            1 => format!(" + J/9*({factor})*der({name})*der({other})"),
            _ => format!(" - k*({factor})*der({other})*({speed})/9"),
        });
    }
    Build::new(&q.join(" "), "m J k")
        .kinetic("", &energy)
        .potential("", &random_position(random, &q))
}

#[test]
fn euler_lagrange_on_large_random_systems() {
    let mut random = Random::new(47);
    for _ in 0..8 {
        let d = large_system(&mut random).derive();
        let point = d.point(&mut random);
        check_euler_lagrange(&d, &point);
        let (t, v, h, ..) = d.equations.structure.energy;
        let declared: f64 = d
            .equations
            .system
            .kinetic
            .iter()
            .map(|term| d.evaluate(term.energy, &point))
            .sum();
        close("T", d.value(t, &point), declared);
        close("h", d.value(h, &point), declared + d.value(v, &point));
        for (i, name) in names(&d).iter().enumerate() {
            let p: f64 = names(&d)
                .iter()
                .enumerate()
                .map(|(j, other)| d.mass(i, j, &point) * point[&format!("v_{other}")])
                .sum();
            close(name, d.value(d.equations.structure.momenta.0[i], &point), p);
        }
    }
}

/// An arm in space, each joint about an axis of the link before it, of links with full tensors of inertia: more than can be multiplied out.
fn spatial_arm(n: usize) -> Build {
    let (build, kinetic, potential) = spatial_links(n);
    build.kinetic("", &kinetic).potential("", &potential)
}

/// The definitions of such an arm, and its energies.
fn spatial_links(n: usize) -> (Build, String, String) {
    let list: Vec<String> = (0..n).map(|i| format!("q{i}")).collect();
    let mut build = Build::new(&list.join(" "), "m l g A B C D E F");
    let sum = |terms: [String; 3]| terms.join(" + ");
    let mut axes: [[String; 3]; 3] =
        [0, 1, 2].map(|a| [0, 1, 2].map(|i| format!("{}", u8::from(a == i))));
    let mut place = [0, 1, 2].map(|_| "0".to_owned());
    let mut turn = place.clone();
    let (mut kinetic, mut potential) = ("0".to_owned(), "0".to_owned());
    for (k, q) in list.iter().enumerate() {
        let about = [2, 1, 1, 0][k % 4];
        let (b, c) = ((about + 1) % 3, (about + 2) % 3);
        for i in 0..3 {
            let turned = [
                (about, axes[about][i].clone()),
                (
                    b,
                    format!("cos({q})*{} + sin({q})*{}", axes[b][i], axes[c][i]),
                ),
                (
                    c,
                    format!("cos({q})*{} - sin({q})*{}", axes[c][i], axes[b][i]),
                ),
            ];
            for (a, turned) in turned {
                let name = format!("axis{k}{a}{i}");
                build = build.define(&name, &format!("({turned})"));
                axes[a][i] = name;
            }
            let rate = format!("({} + der({q})*{})", turn[i], axes[about][i]);
            build = build.define(&format!("turn{k}{i}"), &rate);
            turn[i] = format!("turn{k}{i}");
            let next = format!("({} + l*{} + l/3*{})", place[i], axes[2][i], axes[0][i]);
            build = build.define(&format!("place{k}{i}"), &next);
            place[i] = format!("place{k}{i}");
            kinetic.push_str(&format!(" + m/2*der({})^2", place[i]));
        }
        let [x, y, z] = [0, 1, 2].map(|a| {
            let along = [0, 1, 2].map(|i| format!("{}*{}", turn[i], axes[a][i]));
            format!("({})", sum(along))
        });
        kinetic.push_str(&format!(" + A/2*{x}^2 + B/2*{y}^2 + C/2*{z}^2"));
        kinetic.push_str(&format!(" + D*{x}*{y}/9 + E*{x}*{z}/9 + F*{y}*{z}/9"));
        potential.push_str(&format!(" + m*g*{}", place[2]));
    }
    (build, kinetic, potential)
}

#[test]
fn euler_lagrange_on_arms_in_space() {
    let mut random = Random::new(53);
    for joints in [3, 5] {
        let d = spatial_arm(joints).derive();
        let grouped = d
            .equations
            .system
            .pool
            .holds_group(d.equations.system.kinetic[0].energy);
        assert_eq!(grouped, joints > 3, "what is shared is kept whole");
        for _ in 0..5 {
            let point = d.point(&mut random);
            check_euler_lagrange(&d, &point);
        }
    }
}

/// Dampers from the ground to all links: power −2 R, however many terms R has multiplied out.
#[test]
fn dissipations_of_arms_in_space() {
    let mut random = Random::new(59);
    let speeds = (0..15).map(|k| format!("der(place{}{})^2", k / 3, k % 3));
    let speeds: Vec<String> = speeds.collect();
    let rayleigh = format!("m/2*({})", speeds.join(" + "));
    let (links, ..) = spatial_links(5);
    let kinetic = "m/2*(der(q0)^2 + der(q1)^2 + der(q2)^2 + der(q3)^2 + der(q4)^2)";
    let links = links.kinetic("", kinetic).potential("", "m*g*l*q0");
    let d = links.dissipation("dampers", &rayleigh).derive();
    assert!(!d.equations.system.pool.is_full());
    let dampers = &d.equations.structure.dissipations[0];
    for _ in 0..3 {
        let point = d.point(&mut random);
        let (r, power) = (
            d.value(dampers.value, &point),
            d.value(dampers.power, &point),
        );
        assert!(r > 0.0);
        close("power", power, -2.0 * r);
    }
}

/// n-link pendulum with point masses m and links l.
pub fn chain(n: usize) -> Build {
    let list: Vec<String> = (0..n).map(|i| format!("q{i}")).collect();
    let mut build = Build::new(&list.join(" "), "m l g");
    let (mut x, mut y) = ("0".to_owned(), "0".to_owned());
    let (mut kinetic, mut potential) = ("0".to_owned(), "0".to_owned());
    for i in 0..n {
        build = build.define(&format!("x{i}"), &format!("{x} + l*sin(q{i})"));
        build = build.define(&format!("y{i}"), &format!("{y} - l*cos(q{i})"));
        (x, y) = (format!("x{i}"), format!("y{i}"));
        kinetic.push_str(&format!(" + m/2*(der({x})^2 + der({y})^2)"));
        potential.push_str(&format!(" + m*g*{y}"));
    }
    build.kinetic("", &kinetic).potential("", &potential)
}

/// dh/dt = Q·v − ∂L/∂t along the accelerations that M v̇ = f gives.
#[test]
fn energy_theorem() {
    let mut random = Random::new(77);
    for _ in 0..20 {
        let d = random_system(&mut random)
            .load("push", "k*a", &[(0, "k*a*b"), (2, "sin(t)")])
            .dissipation("drag", "J/2*(der(a)^2 + b^2*der(c)^2)")
            .derive();
        let mut point = d.point(&mut random);
        for (name, a) in names(&d).iter().zip(d.accelerations(&[], &point)) {
            point.insert(format!("a_{name}"), a);
        }
        let structure = &d.equations.structure;
        let along = motion(&d, &point);
        let (mut rate, mut size) = (0.0, 1.0);
        for &(_, h) in &d.equations.outputs[structure.energy.2.0].terms {
            let slope = derivatives(&d, h, &point, &along, &Point::new())[1];
            rate += slope;
            size += slope.abs();
        }
        let supplied = [
            structure.forces[0].power,
            structure.dissipations[0].power,
            structure.energy.3,
        ];
        let supplied = supplied.map(|output| d.value(output, &point));
        let want: f64 = supplied.iter().sum();
        size += supplied.iter().map(|s| s.abs()).sum::<f64>();
        assert!(
            (rate - want).abs() <= 1e-10 * size,
            "dh/dt = {rate}, supplied {want}"
        );
    }
}

/// Where T is a quadratic form and nothing depends on time, h = T + V.
#[test]
fn jacobi_integral_is_the_energy() {
    let mut random = Random::new(5);
    for scene in [
        systems::mass_on_wheel(),
        systems::double_pendulum(),
        chain(4),
    ] {
        let d = scene.derive();
        let point = d.point(&mut random);
        let (t, v, h, by_time, _) = d.equations.structure.energy;
        close(
            "h",
            d.value(h, &point),
            d.value(t, &point) + d.value(v, &point),
        );
        assert!(d.equations.outputs[by_time.0].terms.is_empty());
    }
}

/// Momenta are ∂L/∂v.
#[test]
fn momenta_are_slopes_of_the_lagrangian() {
    let mut random = Random::new(9);
    for _ in 0..5 {
        let d = random_system(&mut random).derive();
        let point = d.point(&mut random);
        for (i, name) in names(&d).iter().enumerate() {
            let by_v = Point::from([(format!("v_{name}"), 1.0)]);
            let want: f64 = d
                .equations
                .system
                .kinetic
                .iter()
                .map(|term| derivatives(&d, term.energy, &point, &by_v, &Point::new())[1])
                .sum();
            let got = d.value(d.equations.structure.momenta.0[i], &point);
            assert!(
                (got - want).abs() <= 1e-11 * (1.0 + want.abs()),
                "{name}: {got} {want}"
            );
        }
    }
}

/// Rows: velocity = dg/dt, and d/dt velocity = a v̇ + γ, for random residuals.
#[test]
fn rows_are_time_derivatives() {
    let mut random = Random::new(13);
    let q = ["a", "b", "c"];
    for _ in 0..20 {
        let holonomic = format!(
            "{} - {}",
            random_position(&mut random, &q),
            random_position(&mut random, &q)
        );
        let (u, w) = (
            random_position(&mut random, &q),
            random_position(&mut random, &q),
        );
        let rolling = format!("{u}*der(a) + der({w}) - sin(k*t)*b");
        let d = random_system(&mut random)
            .constraint("h", Level::Position, &holonomic)
            .constraint("n", Level::Velocity, &rolling)
            .derive();
        let point = d.point(&mut random);
        let along = motion(&d, &point);
        let still = Point::new();
        for (index, row) in d.equations.structure.rows.iter().enumerate() {
            let declared = d.equations.system.constraints[index].residual;
            let velocity = d.value(row.velocity, &point);
            let mut rate_of = Vec::new();
            for &(_, e) in &d.equations.outputs[row.velocity.0].terms {
                rate_of.push(derivatives(&d, e, &point, &along, &still)[1]);
            }
            let rate: f64 = rate_of.iter().sum();
            let a = d.jacobian(index, &point);
            let with_a: f64 = names(&d)
                .iter()
                .zip(&a)
                .map(|(name, a)| a * point[&format!("a_{name}")])
                .sum::<f64>()
                + d.value(row.bias, &point);
            assert!(
                (rate - with_a).abs() <= 1e-11 * (1.0 + rate.abs()),
                "acceleration of row {index}"
            );
            let [value, slope, ..] = derivatives(&d, declared, &point, &along, &still);
            let want = if row.position.is_some() { slope } else { value };
            assert!(
                (velocity - want).abs() <= 1e-11 * (1.0 + want.abs()),
                "velocity of row {index}"
            );
        }
    }
}
