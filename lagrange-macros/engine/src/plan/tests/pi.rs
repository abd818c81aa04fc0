//! Multiples of π are coefficients like any number, in every kind of item, with either sign, with units and without.

use super::{Dice, Machine, Selection, compare};
use std::collections::BTreeMap;

/// A pendulum with one more item; S stands for the multiple of π.
const SIGNS: [&str; 8] = [
    "pi",
    "-pi",
    "pi/2",
    "-pi/2",
    "-3*pi/4",
    "-1e-3*pi",
    "-pi^2",
    "-sqrt(pi)",
];

/// One item of each kind; S is a plain number.
const ITEMS: [&str; 19] = [
    "start(s: theta = S)",
    "start(s: theta = S*lean, der(theta) = -S*rate)",
    "start(s: theta = lean + S, der(theta) = S*rate/lean)",
    "stop(f: theta >= S)",
    "stop(f: rod*theta <= S*rod*lean)",
    "mark(m: theta - S)",
    "potential(more: mass*gravity*rod*sin(theta + S/3))",
    "potential(more: stiffness*(theta - S)^2)",
    "kinetic(more: 2*mass*rod^2*(S*der(theta))^2)",
    "force(drag: theta = S*viscosity*der(theta))",
    "force(push: theta = if(theta >= S, S*stiffness, stiffness*theta))",
    "dissipation(rub: S^2*viscosity*der(theta)^2)",
    "constraint(turn: phi == S*theta)",
    "constraint(turn: der(phi) == S*rate - der(theta))",
    "contact(wall: rod*theta >= S*rod*lean, restitution = (S/100)^2)",
    "contact(wall: theta >= S, where phi <= -S)",
    "friction(seal: slip = rod*der(theta) - S*rod*rate, limit = S^2*stiffness/rod)",
    "observe(arc = S*rod, turned = theta/S, speed = -S*rod*der(theta))",
    "define(bent = S*lean), potential(more: stiffness*bent*cos(phi - S*lean))",
];

fn declaration(item: &str, units: bool) -> String {
    let unit = |unit: &str| match units {
        true => format!("#[lagrange(unit = \"{unit}\")]"),
        false => String::new(),
    };
    let coordinates = match units {
        true => "theta: \"rad\", phi: \"rad\"",
        false => "theta, phi",
    };
    let fields: String = [
        ("mass", "kg"),
        ("rod", "m"),
        ("gravity", "m/s^2"),
        ("stiffness", "N m"),
        ("viscosity", "N m s"),
        ("rate", "rad/s"),
        ("lean", "rad"),
    ]
    .map(|(field, of)| format!("{} {field}: f64,", unit(of)))
    .concat();
    format!(
        "#[lagrange(
            coordinates({coordinates}),
            kinetic(motion: mass/2*rod^2*(der(theta)^2 + der(phi)^2)),
            potential(weight: -mass*gravity*rod*cos(theta)),
            {item},
        )]
        struct Pendulum {{ {fields} }}"
    )
}

#[test]
fn multiples_of_pi_keep_their_values_in_every_item() {
    let mut dice = Dice::new(1);
    for item in ITEMS {
        for sign in SIGNS {
            for units in [false, true] {
                let text = declaration(&item.replace('S', &format!("({sign})")), units);
                check(&text, &mut dice);
            }
        }
    }
}

fn check(text: &str, dice: &mut Dice) {
    let tokens: proc_macro2::TokenStream = text.parse().expect("tokens");
    let program = crate::program(tokens.clone()).unwrap_or_else(|m| panic!("{text}\n{m}"));
    let system = &program.equations.system;
    let values: BTreeMap<_, _> = super::inputs(system, crate::derive::Stage::Report)
        .into_iter()
        .chain(system.parameters.iter().map(|p| p.symbol))
        .map(|symbol| (symbol, dice.number()))
        .collect();
    let needs = vec![!0; program.equations.needs.len().div_ceil(64)];
    for branches in [[0], [!0]] {
        let held = Selection {
            needs: &needs,
            branches: &branches,
        };
        assert!(compare(&program, &values, held) > 0, "{text}");
    }
    let parameters: Vec<f64> = system
        .parameters
        .iter()
        .map(|p| values[&p.symbol])
        .collect();
    let machine = Machine::new(&program, &parameters);
    for (index, start) in system.starts.iter().enumerate() {
        let (q, v) = machine.start(index, 0.0);
        for (found, given) in [(q, &start.positions), (v, &start.velocities)] {
            for (i, e) in given {
                let e = system
                    .pool
                    .evaluate(&[*e], &|symbol| values[&symbol], &|_| true)[0];
                let error = (found[*i] - e).abs();
                assert!(error <= 1e-14 * e.abs(), "{text}: {} not {e}", found[*i]);
            }
        }
    }
    let expansion = crate::expand(tokens).to_string();
    assert!(!expansion.contains("compile_error"), "{text}");
}
