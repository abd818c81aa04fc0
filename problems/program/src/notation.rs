//! How names and units of a declaration are written for people.

use lagrange_core::system::Coordinate;

/// How the velocity of a coordinate is written, `der(theta)`.
pub fn velocity_name(coordinate: &str) -> String {
    format!("der({coordinate})")
}

/// The unit of a velocity: `m/s`, `rad/s`; empty for a coordinate without a unit.
pub(crate) fn rate_unit(unit: &str) -> String {
    match unit {
        "" => String::new(),
        unit if unit.contains(['/', ' ']) => format!("({unit})/s"),
        unit => format!("{unit}/s"),
    }
}

/// Whether a coordinate is an angle, so that people read it in degrees: its unit is declared as `rad`, or its
/// name is that of a Greek letter customary for angles (`theta`, `phi2`, `psi_left`, `alpha[3]`).
pub fn is_angle(coordinate: &Coordinate) -> bool {
    const LETTERS: [&str; 7] = ["theta", "phi", "psi", "alpha", "beta", "gamma", "chi"];
    if !coordinate.unit.is_empty() {
        return coordinate.unit == "rad";
    }
    let stem = coordinate
        .name
        .split(|c: char| !c.is_ascii_alphabetic())
        .next()
        .unwrap_or_default();
    LETTERS.contains(&stem)
}

/// Greek letters for the names of Greek letters; other names as they are.
pub(crate) fn symbol(name: &str) -> String {
    const GREEK: [(&str, &str); 7] = [
        ("theta", "θ"),
        ("phi", "φ"),
        ("psi", "ψ"),
        ("alpha", "α"),
        ("beta", "β"),
        ("gamma", "γ"),
        ("chi", "χ"),
    ];
    let split = name
        .find(|c: char| !c.is_ascii_alphabetic())
        .unwrap_or(name.len());
    let (stem, rest) = name.split_at(split);
    match GREEK.iter().find(|(word, _)| *word == stem) {
        Some((_, letter)) => format!("{letter}{rest}"),
        None => name.to_owned(),
    }
}

/// Of a force's impulse, `N s`.
pub(crate) fn impulse_unit(force: &str) -> String {
    match force {
        "" => String::new(),
        unit if unit.contains('/') => format!("({unit}) s"),
        unit => format!("{unit} s"),
    }
}
