//! Exact numbers.

use super::super::Rational;

fn ratio(n: i128, d: i128) -> Rational {
    Rational::new(n, d).unwrap()
}

#[test]
fn literals_are_exact() {
    for (text, n, d) in [
        ("12", 12, 1),
        ("0.1", 1, 10),
        ("1e-3", 1, 1000),
        ("1_000.5", 2001, 2),
        ("6.674e-11", 3337, 50_000_000_000_000),
        ("2.50E2", 250, 1),
        ("0.000", 0, 1),
        ("1.", 1, 1),
        (
            "100000000000000000000000000000000000000",
            100_000_000_000_000_000_000_000_000_000_000_000_000,
            1,
        ),
        ("1.00000000000000000000000000000000000000000000", 1, 1),
    ] {
        assert_eq!(Rational::parse(text), Some(ratio(n, d)), "{text}");
    }
    for text in [
        "",
        "x",
        "1e",
        "1.2.3",
        "-1",
        "1f64",
        "1e99",
        "1e-99",
        "e5",
        ".5",
        "1e9999999999999999999",
    ] {
        assert_eq!(Rational::parse(text), None, "{text}");
    }
}

#[test]
fn arithmetic_reduces_and_reports_overflow() {
    let (a, b) = (ratio(1, 6), ratio(-3, 10));
    assert_eq!(a.checked_add(b), Some(ratio(-2, 15)));
    assert_eq!(a.checked_sub(b), Some(ratio(7, 15)));
    assert_eq!(a.checked_mul(b), Some(ratio(-1, 20)));
    assert_eq!(a.checked_div(b), Some(ratio(-5, 9)));
    assert_eq!(a.checked_div(Rational::ZERO), None);
    assert_eq!(ratio(-2, 3).pow_int(-3), Some(ratio(-27, 8)));
    assert_eq!(Rational::ZERO.pow_int(0), Some(Rational::ONE));
    assert_eq!(Rational::ZERO.pow_int(-1), None);
    assert_eq!(Rational::MINUS_ONE.pow_int(i64::MIN), Some(Rational::ONE));
    assert_eq!(ratio(-7, 2).floor(), -4);
    let large = ratio(i128::MAX, 1);
    assert_eq!(large.checked_add(Rational::ONE), None);
    assert_eq!(large.checked_mul(large), None);
    assert_eq!(Rational::integer(3).pow_int(100), None);
    assert_eq!(
        ratio(i128::MAX, 3).checked_mul(ratio(3, i128::MAX)),
        Some(Rational::ONE)
    );
    assert_eq!(Rational::new(i128::MIN, -1), None);
    assert_eq!(ratio(i128::MIN, 2).numerator(), i128::MIN / 2);
}

#[test]
fn order_is_numeric() {
    let rising = [
        ratio(-7, 2),
        ratio(-1, 3),
        Rational::ZERO,
        ratio(1, 3),
        Rational::HALF,
        Rational::ONE,
    ];
    assert!(rising.windows(2).all(|pair| pair[0] < pair[1]));
    let m = i128::MAX;
    assert!(ratio(m - 1, m) < Rational::ONE);
    assert!(ratio(m - 2, m - 1) < ratio(m - 1, m));
    assert!(ratio(-(m - 1), m) < ratio(-(m - 2), m - 1));
}

#[test]
fn conversion_rounds_to_nearest() {
    // The standard library's decimal parser rounds correctly; it is the independent reference.
    for text in [
        "0.1",
        "1e-3",
        "6.674e-11",
        "6.02214076e23",
        "1.602176634e-19",
        "9007199254740993",
        "1e-30",
        "3.14159265358979323846264338327950288",
        "123456789012345678901234567890123456789",
        "0.3e-20",
        "9007199254740992.5",
        "9007199254740993.00000001",
        "18014398509481985",
        "2.5e-17",
    ] {
        let exact = Rational::parse(text).unwrap();
        assert_eq!(exact.to_f64(), text.parse::<f64>().unwrap(), "{text}");
        assert_eq!(
            exact.checked_neg().unwrap().to_f64(),
            -text.parse::<f64>().unwrap(),
            "{text}"
        );
    }
    assert_eq!(Rational::ZERO.to_f64(), 0.0);
    assert_eq!(ratio(1, 3).to_f64(), 1.0 / 3.0);
    assert_eq!(ratio(i128::MAX, i128::MAX - 1).to_f64(), 1.0);
}
