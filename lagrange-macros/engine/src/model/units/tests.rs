//! Texts of units, and what is wrong with them.

use super::dimension::Dimension;
use super::grammar::unit;
use super::refusal::Refusal;

#[test]
fn ways_of_writing_one_unit() {
    let energy = [
        "J",
        "N m",
        "N.m",
        "N*m",
        "N\u{b7}m",
        "kg m^2/s^2",
        "kg m\u{b2} s\u{207b}\u{b2}",
        "kg*m^2*s^-2",
        "kg (m/s)^2",
        "W s",
        "kN mm",
        "V A s",
        " J ",
        "kg^(1/2) kg^(1/2) m^2/s/s",
        "1 J",
        "C V",
        "Pa m^3",
        "MPa cm^3",
    ];
    for text in energy {
        let read = unit(text).unwrap_or_else(|refusal| panic!("{text}: {refusal:?}"));
        assert_eq!(read.dimension, Dimension::ENERGY, "{text}");
    }
    for text in ["1", "rad", "sr", "m/m", "N s^2/(kg m)"] {
        assert!(
            unit(text).is_ok_and(|read| read.dimension.is_one()),
            "{text}"
        );
    }
    // The derived units of the SI (BIPM 2019, table 4), each by what the brochure says that it is.
    for (named, by_base_units) in [
        ("Hz", "1/s"),
        ("Pa", "N/m^2"),
        ("W", "J/s"),
        ("C", "A s"),
        ("V", "W/A"),
        ("F", "C/V"),
        ("ohm", "V/A"),
        ("S", "A/V"),
        ("Wb", "V s"),
        ("T", "Wb/m^2"),
        ("H", "Wb/A"),
        ("lm", "cd sr"),
        ("lx", "lm/m^2"),
        ("Bq", "1/s"),
        ("Gy", "J/kg"),
        ("Sv", "J/kg"),
        ("kat", "mol/s"),
    ] {
        let of = |text| unit(text).expect("a unit").dimension;
        assert_eq!(of(named), of(by_base_units), "{named}");
    }
    assert_eq!(unit("kg m^2/s^2").unwrap().text, "kg m\u{b2}/s\u{b2}");
    assert_eq!(unit("N.m").unwrap().text, "N m");
    assert_eq!(unit("1").unwrap().text, "");
}

#[test]
fn texts_of_dimensions_read_back() {
    let texts = [
        "J",
        "N",
        "m/s",
        "kg m/s",
        "1/s",
        "kg/s\u{b2}",
        "m^(1/2)",
        "1/(K m)",
        "\u{3a9}",
        "kg m\u{b2}",
    ];
    for text in texts {
        let dimension = unit(text).unwrap().dimension;
        assert_eq!(
            unit(&dimension.text()).unwrap().dimension,
            dimension,
            "{text}"
        );
    }
    for (text, force) in [
        ("J", "N m"),
        ("kg/s^2", "N/m"),
        ("N", "N"),
        ("kg m/s", "kg m/s"),
        ("J m", "N m\u{b2}"),
    ] {
        assert_eq!(unit(text).unwrap().dimension.as_force(), force);
    }
}

/// What is no unit is cut into units as long as that is quick.
#[test]
fn long_words_are_refused_at_once() {
    let hint = |text: &str| match unit(text) {
        Err(Refusal::Unknown(_, hint)) => hint,
        other => panic!("{text}: {other:?}"),
    };
    assert!(hint("Nms").ends_with("`N m s`"), "{}", hint("Nms"));
    for text in ["dimensionless", &"ms".repeat(500), &"k".repeat(100_000)] {
        assert!(hint(text).starts_with("units are those of the SI"));
    }
}

#[test]
fn multiples_are_told_with_their_coherent_unit() {
    let multiples = [
        ("mm", "m"),
        ("g", "kg"),
        ("t", "kg"),
        ("deg", "rad"),
        ("min", "s"),
        ("km/h", "m/s"),
        ("kN", "N"),
        ("rpm", "rad/s"),
        ("mrad", "rad"),
    ];
    for (text, coherent) in multiples {
        assert_eq!(
            unit(text),
            Err(Refusal::Multiple(coherent.to_string())),
            "{text}"
        );
    }
}

#[test]
fn what_is_no_unit_is_told() {
    let hint = |text: &str| match unit(text) {
        Err(Refusal::Unknown(_, hint) | Refusal::Form(_, hint)) => hint,
        other => panic!("{text}: {other:?}"),
    };
    assert_eq!(hint("Nm"), "a product is written with a blank: `N m`");
    assert_eq!(hint("meter"), "write `m`");
    assert_eq!(hint("KG"), "did you mean `kg`?");
    assert_eq!(
        hint("furlong"),
        "units are those of the SI: `kg m^2/s^2`, `N m`, `rad`"
    );
    assert_eq!(hint("J/kg K"), "use parentheses: `J/(kg K)`");
    assert_eq!(hint("m2"), "write `m^2`, or `m\u{b2}`");
    assert!(hint("9.81 m/s^2").starts_with("numbers are not converted"));
    for text in [
        "",
        "m^",
        "m/",
        "m^1/2",
        "(m",
        "m)",
        "m + s",
        "m^(1/0)",
        "m^0.5",
        "m^99999999999999999999",
        "\u{1F600}",
        "m^9223372036854775807 m^9223372036854775807 m^9223372036854775807",
    ] {
        assert!(unit(text).is_err() || text.starts_with("m^9"), "{text}");
    }
}
