//! "Simplifies to" tables, operation counts, linear coefficients, and what an expression contains.

use super::read::Desk;
use crate::symbolic::{Function, Rational, Symbol};

#[test]
fn simplifies_to() {
    let mut desk = Desk::default();
    for symbol in ["m", "l", "g", "x", "y", "v", "w"] {
        desk.symbol(symbol);
    }
    for (text, printed) in [
        ("m*(l*cos(x)*v)^2/2 + m*(l*sin(x)*v)^2/2", "1/2*m*l^2*v^2"),
        (
            "(v + l*cos(x)*w)^2 + (l*sin(x)*w)^2 - v^2 - l^2*w^2",
            "2*l*v*w*cos(x)",
        ),
        ("m*x + m*y", "m*(x + y)"),
        ("(x + y)^2 - x^2 - y^2", "2*x*y"),
        ("(x + y)*(x - y) + y^2", "x^2"),
        ("m*g*x + m*l*x + m*v", "m*(v + x*(l + g))"),
        ("x^3 + x^2", "x^2*(x + 1)"),
        ("x/l + y/l", "(x + y)/l"),
        ("(x + y)*m + (x + y)*g", "(x + y)*(m + g)"),
        ("sin(x)*cos(y)^2 + sin(x)*sin(y)^2", "sin(x)"),
        ("sqrt((l*sin(x))^2 + (l*cos(x))^2)", "sqrt(l^2)"),
        (
            "(x - l*sin(y))^2 + (v - l*cos(y))^2",
            "(x - l*sin(y))^2 + (v - l*cos(y))^2",
        ),
        // Multiplied out it would be one operation less, and lose its digits where both differences vanish.
        ("sqrt((x - 1)^2 + y^2)", "sqrt(y^2 + (x - 1)^2)"),
        ("m/((x - 1)^2 + y^2 + 1/8)", "m/((y^2 + (x - 1)^2 + 1/8))"),
        ("(x - 1)^2 + 2*x + y^2", "x^2 + y^2 + 1"),
        ("cos(x)*cos(y) + sin(x)*sin(y)", "cos(x - y)"),
        ("cos(x)*cos(y) - sin(x)*sin(y)", "cos(x + y)"),
        ("m*sin(x)*cos(y) + m*cos(x)*sin(y)", "m*sin(x + y)"),
        ("m*sin(x)*cos(y)*v - m*v*cos(x)*sin(y)", "m*v*sin(x - y)"),
        ("m*sin(y)*cos(x) - m*cos(y)*sin(x) + g", "g - m*sin(x - y)"),
        ("cos(x - y) - cos(x)*cos(y) - sin(x)*sin(y)", "0"),
        ("sin(x + y)^2 + (cos(x)*cos(y) - sin(x)*sin(y))^2", "1"),
        ("sin(x)*sin(x + y) + cos(x)*cos(x + y)", "cos(y)"),
        (
            "sin(x + y)*sin(x + y + w) + cos(x + y)*cos(x + y + w)",
            "cos(w)",
        ),
        (
            "(l*v*cos(x) + g*w*cos(y))^2 + (l*v*sin(x) + g*w*sin(y))^2",
            "g^2*w^2 + l*v*(l*v + 2*g*w*cos(x - y))",
        ),
        ("x", "x"),
    ] {
        let e = desk.read(text);
        let simple = desk.pool.simplify(e);
        assert_eq!(desk.pool.print(simple), printed, "{text}");
        assert_eq!(desk.pool.simplify(simple), simple, "{text}");
        let at = |symbol: Symbol| 0.3 + (1.7 * symbol.index() as f64).sin().abs();
        let values = desk.pool.evaluate(&[e, simple], &at, &|_| true);
        assert!((values[0] - values[1]).abs() < 1e-13, "{text}: {values:?}");
    }
}

#[test]
fn expands_to() {
    let mut desk = Desk::default();
    for (text, printed) in [
        ("(x + y)^2", "x^2 + y^2 + 2*x*y"),
        ("(x + y)*(x - y)", "x^2 - y^2"),
        ("(x + 1)^3", "x^3 + 3*x^2 + 3*x + 1"),
        (
            "sin(2*(x + y))*(x + 1)",
            "sin(2*x + 2*y)*x + sin(2*x + 2*y)",
        ),
        ("(sin(x) + cos(x))^2", "1 + 2*sin(x)*cos(x)"),
        ("z*(x + y)/(x - y)", "x*z/(x - y) + y*z/(x - y)"),
    ] {
        let e = desk.read(text);
        let (expanded, expected) = (desk.pool.expand(e), desk.read(printed));
        assert_eq!(
            expanded,
            expected,
            "{text} became {}",
            desk.pool.print(expanded)
        );
    }
}

#[test]
fn large_powers_stay_within_the_budget() {
    let mut desk = Desk::default();
    let e = desk.read("(a + b + c + d + e + f)^30*(x + y)^1000");
    assert_eq!(desk.pool.expand(e), e);
    assert_eq!(desk.pool.simplify(e), e);
}

#[test]
fn deep_expressions_stay_within_the_budget() {
    let mut desk = Desk::default();
    let (x, one) = (desk.read("x"), desk.read("1"));
    let symbol = desk.symbol("x");
    let (mut horner, mut nested) = (one, x);
    for _ in 0..200 {
        let product = desk.pool.mul(x, horner);
        horner = desk.pool.add(one, product);
        let sine = desk.pool.call(Function::Sin, &[nested]);
        nested = desk.pool.add(x, sine);
    }
    for e in [horner, nested] {
        let slope = desk.pool.differentiate(e, symbol);
        let simple = desk.pool.simplify(slope);
        assert!(desk.pool.operations(&[simple]) <= desk.pool.operations(&[slope]));
    }
    assert!(desk.pool.len() < 200_000, "{}", desk.pool.len());
}

#[test]
fn operations_count_the_graph() {
    let mut desk = Desk::default();
    for (text, count) in [
        ("x", 0),
        ("2", 0),
        ("-x", 0),
        ("x - y", 1),
        ("2*x", 1),
        ("x + y + 1", 2),
        ("2*x + 2*y", 2),
        ("x^2", 1),
        ("x^4", 2),
        ("x^5", 3),
        ("x/y", 1),
        ("x/(y*z)", 2),
        ("1/x", 1),
        ("sqrt(x)", 1),
        ("sin(x)", 1),
        ("sin(x) + cos(x)", 2),
        ("sin(x)*cos(x)*sin(y)", 4),
        ("x^2*y + x^2*z", 4),
        ("pi*sqrt(2)*3", 0),
    ] {
        let e = desk.read(text);
        assert_eq!(desk.pool.operations(&[e]), count, "{text}");
    }
    let pair = [desk.read("sin(x)"), desk.read("cos(x)")];
    assert_eq!(desk.pool.operations(&pair), 1);
}

#[test]
fn fixed_symbols_cost_nothing() {
    let mut desk = Desk::default();
    let fixed = ["m", "n", "l", "g"].map(|name| desk.symbol(name));
    let before = desk.read("x*m + x*n");
    assert!(desk.pool.varies(before));
    desk.pool.fix(&fixed);
    for (text, count) in [
        ("m*l^2 + sin(g)", 0),
        ("m*l*x", 1),
        ("m*l*x*y", 2),
        ("m*x + m*y", 2),
        ("m*x + l*x", 1),
        ("m*x + l*y + m*l", 4),
        ("m*x^2 + n*x^2 + y", 3),
        ("sin(m*x) + cos(m*x)", 3),
        ("x/m", 1),
        ("m/x", 2),
        ("select(0, m, n)", 1),
    ] {
        let e = desk.read(text);
        assert_eq!(desk.pool.operations(&[e]), count, "{text}");
        assert_eq!(desk.pool.varies(e), count > 0, "{text}");
    }
    for (text, printed) in [
        ("(m + n)*(x + y) - n*x - n*y", "m*(x + y)"),
        ("m*x*y + n*x*y + x*l", "x*(l + y*(m + n))"),
        ("m*l^2 + n*l^2", "l^2*(m + n)"),
        // Nothing that runs gets cheaper, but what is done once does.
        ("sin(x)*(m*l + m*g)", "m*(l + g)*sin(x)"),
    ] {
        let e = desk.read(text);
        let (simple, expected) = (desk.pool.simplify(e), desk.read(printed));
        assert_eq!(
            simple,
            expected,
            "{text} became {}",
            desk.pool.print(simple)
        );
    }
}

#[test]
fn affine_expressions_give_their_coefficients() {
    let mut desk = Desk::default();
    let symbols = [desk.symbol("v"), desk.symbol("w")];
    for (text, coefficients) in [
        ("r*(v - w)", Some(["r", "-r", "0"])),
        ("v*cos(x) + 3", Some(["cos(x)", "0", "3"])),
        ("(v + w)^2 - v^2 - w^2 - 2*v*w + v", Some(["1", "0", "0"])),
        ("(v^2 + v*x)/v", Some(["1", "0", "x"])),
        ("x", Some(["0", "0", "x"])),
        ("v*w", None),
        ("v^2", None),
        ("sin(v)", None),
        ("v/w", None),
    ] {
        let e = desk.read(text);
        let found = desk.pool.coefficients_linear(e, &symbols);
        let expected = coefficients.map(|texts| {
            let [a, b, rest] = texts.map(|text| desk.read(text));
            (vec![a, b], rest)
        });
        assert_eq!(found, expected, "{text}");
    }
}

#[test]
fn contents_are_listed() {
    let mut desk = Desk::default();
    let (x, y, z) = (desk.symbol("x"), desk.symbol("y"), desk.symbol("z"));
    let e = desk.read("select(4, x, sin(z)) + select(1, x, z)");
    assert_eq!(desk.pool.symbols(e), [x, z]);
    assert_eq!(desk.pool.branches(e), [1, 4]);
    assert!(desk.pool.depends_on(e, z) && !desk.pool.depends_on(e, y));
    // Symbols 63 apart share a bit of the quick test.
    let distant: Vec<_> = (0..63).map(|i| desk.symbol(&format!("s{i}"))).collect();
    assert!(!desk.pool.depends_on(e, distant[60]));
    let d = desk.pool.differentiate(e, distant[60]);
    assert!(desk.pool.is_zero(d));
    let reachable = desk.pool.iter_reachable(&[e]);
    assert!(reachable.windows(2).all(|pair| pair[0] < pair[1]));
    assert_eq!(reachable.last(), Some(&e));
    // x, z, sin(z), two selections, their sum.
    assert_eq!(reachable.len(), 6);
}

#[test]
fn total_time_derivative_follows_the_chain_rule() {
    let mut desk = Desk::default();
    let (x, v) = (desk.symbol("x"), desk.symbol("v"));
    let direction = [
        (x, desk.read("v")),
        (v, desk.read("a")),
        (desk.symbol("t"), desk.read("1")),
    ];
    let e = desk.read("m*v*cos(x) + t*x");
    let total = desk.pool.derivative_along(e, &direction);
    let expected = desk.read("m*a*cos(x) - m*v^2*sin(x) + x + t*v");
    assert_eq!(total, expected);
}

#[test]
fn zeros_are_those_of() {
    let mut desk = Desk::default();
    for (text, zeros, signs) in [
        ("(x - y)^3", "x - y", "x - y"),
        ("(x - y)^2", "x - y", "(x - y)^2"),
        (
            "-2*(x - y)^2*z^3/w^2",
            "-2*(x - y)*z/w^2",
            "-2*(x - y)^2*z/w^2",
        ),
        ("x^(3/2)", "x^(3/2)", "x^(3/2)"),
        ("x^2 - y^2", "x^2 - y^2", "x^2 - y^2"),
        ("sin(x)^5", "sin(x)", "sin(x)"),
    ] {
        let e = desk.read(text);
        for (signed, expected) in [(false, zeros), (true, signs)] {
            let simple = desk.pool.with_simple_zeros(e, signed);
            assert_eq!(simple, desk.read(expected), "{text}, {signed}");
        }
    }
}

/// Powers of what is chosen between x and zero are choices of powers, however they are written, and have the same values.
#[test]
fn what_is_chosen_is_raised_where_it_is() {
    let mut desk = Desk::default();
    let ([x, zero, k], power) = (
        ["x - 1/10", "0", "k"].map(|text| desk.read(text)),
        Rational::new(3, 2).expect("a power"),
    );
    let pool = &mut desk.pool;
    let chosen = pool.select(0, x, zero);
    let scaled = pool.mul(k, chosen);
    let quotient = pool.div(chosen, k).expect("a quotient");
    let cube = pool.raise(chosen, Rational::integer(3));
    let [cubed, rooted] = [cube, scaled].map(|e| pool.sqrt(e));
    let other = pool.select(1, zero, k);
    let both = pool.mul(other, chosen);
    let unlike = pool.select(0, x, k);
    let unlike = pool.raise(unlike, power);
    let mut powers = [chosen, scaled, quotient, both]
        .map(|e| pool.raise(e, power))
        .to_vec();
    powers.extend([cubed, pool.mul(rooted, chosen)]);
    for e in powers {
        let e = pool.mul(e, k);
        let raised = pool.raise_sides(&[e])[0];
        for part in pool.iter_reachable(&[raised]) {
            let begun = pool.begun(part);
            assert!(begun.iter().all(|&base| pool.branches(base).is_empty()));
        }
        for side in [0, 1, 2, 3] {
            let on = |branch: usize| side >> branch & 1 == 1;
            let values = pool.evaluate(&[e, raised], &|_| 0.7, &on);
            assert!((values[0] - values[1]).abs() < 1e-14, "{values:?}");
        }
    }
    assert_eq!(pool.raise_sides(&[unlike]), [unlike]);
}
