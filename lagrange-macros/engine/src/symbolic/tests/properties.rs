//! On random expressions: values do not change by building, rewriting or printing; derivatives are those of dual
//! numbers.

use super::random::{Random, Step, build, program};
use super::read::Desk;
use crate::symbolic::{ExprId, Function, Symbol};

/// Value, derivative, and size of the largest intermediate result (the scale of rounding errors).
#[derive(Clone, Copy, Debug)]
struct Dual {
    value: f64,
    slope: f64,
}

/// Runs a program in dual numbers: derivative along the direction. None if it leaves the comfortable reals.
fn run(steps: &[Step], at: [f64; 3], along: [f64; 3]) -> Option<Dual> {
    let mut done: Vec<Dual> = Vec::new();
    for &step in steps {
        let chain = |a: usize, value: f64, factor: f64| Dual {
            value,
            slope: factor * done[a].slope,
        };
        let result = match step {
            Step::Leaf(i) => Dual {
                value: at[i],
                slope: along[i],
            },
            Step::Number(n, d) => Dual {
                value: n as f64 / d as f64,
                slope: 0.0,
            },
            Step::Add(a, b) => Dual {
                value: done[a].value + done[b].value,
                slope: done[a].slope + done[b].slope,
            },
            Step::Sub(a, b) => Dual {
                value: done[a].value - done[b].value,
                slope: done[a].slope - done[b].slope,
            },
            Step::Mul(a, b) => {
                let (x, y) = (done[a], done[b]);
                Dual {
                    value: x.value * y.value,
                    slope: x.slope * y.value + x.value * y.slope,
                }
            }
            Step::Div(a, b) => {
                let (x, y) = (done[a], done[b]);
                let slope = (x.slope - x.value / y.value * y.slope) / y.value;
                Dual {
                    value: x.value / y.value,
                    slope,
                }
            }
            Step::Power(a, n, d) => {
                let (x, r) = (done[a].value, n as f64 / d as f64);
                let factor = if n == 0 { 0.0 } else { r * x.powf(r - 1.0) };
                chain(a, x.powf(r), factor)
            }
            Step::General(a, b) => {
                let (x, y) = (done[a], done[b]);
                let value = x.value.powf(y.value);
                if x.value <= 0.0 {
                    return None;
                }
                let slope = value * (y.slope * x.value.ln() + y.value * x.slope / x.value);
                Dual { value, slope }
            }
            Step::Call(f, a) => {
                let x = done[a].value;
                match f {
                    Function::Sin => chain(a, x.sin(), x.cos()),
                    Function::Cos => chain(a, x.cos(), -x.sin()),
                    Function::Tan => chain(a, x.tan(), 1.0 / x.cos().powi(2)),
                    Function::Sinh => chain(a, x.sinh(), x.cosh()),
                    Function::Cosh => chain(a, x.cosh(), x.sinh()),
                    Function::Tanh => chain(a, x.tanh(), 1.0 / x.cosh().powi(2)),
                    Function::Atan => chain(a, x.atan(), 1.0 / (1.0 + x * x)),
                    Function::Exp => chain(a, x.exp(), x.exp()),
                    Function::Ln => chain(a, x.ln(), 1.0 / x),
                    _ => return None,
                }
            }
            Step::Atan2(a, b) => {
                let (y, x) = (done[a], done[b]);
                let square = x.value * x.value + y.value * y.value;
                let slope = (y.slope * x.value - x.slope * y.value) / square;
                Dual {
                    value: y.value.atan2(x.value),
                    slope,
                }
            }
            Step::Select(a, b) => {
                if BRANCHES[a % 2] {
                    done[a]
                } else {
                    done[b]
                }
            }
        };
        // Large or tiny numbers on the way lose digits that other forms keep: no comparison then.
        let comfortable = |x: f64| x == 0.0 || (1e-3..1e3).contains(&x.abs());
        if !comfortable(result.value) || !comfortable(result.slope) {
            return None;
        }
        done.push(result);
    }
    done.last().copied()
}

const BRANCHES: [bool; 2] = [true, false];

fn value(desk: &Desk, e: ExprId, at: [f64; 3]) -> f64 {
    let symbols = |symbol: Symbol| at[symbol.index()];
    desk.pool
        .evaluate(&[e], &symbols, &|branch| BRANCHES[branch])[0]
}

#[track_caller]
fn close(a: f64, b: f64, what: &dyn Fn() -> String) {
    assert!(
        (a - b).abs() <= 1e-7 * (1.0 + a.abs()),
        "{a} and {b}: {}",
        what()
    );
}

/// Gets the expression, a point, value and derivative there, and the direction of the derivative.
type Check<'a> = dyn FnMut(&mut Desk, ExprId, [f64; 3], Dual, [f64; 3]) + 'a;

/// Calls the check with random programs that have comfortable values, and says how many there were.
fn each(seed: u64, rounds: usize, check: &mut Check) -> usize {
    let mut random = Random::new(seed);
    let mut checked = 0;
    for _ in 0..rounds {
        let length = 4 + random.below(14) as usize;
        let steps = program(&mut random, length);
        let mut desk = Desk::default();
        let Some(e) = build(&mut desk, &steps) else {
            continue;
        };
        for _ in 0..3 {
            let mut draw = || [0; 3].map(|_| random.between(0.2, 1.8));
            let (at, along) = (draw(), draw());
            if let Some(dual) = run(&steps, at, along) {
                check(&mut desk, e, at, dual, along);
                checked += 1;
            }
        }
        assert!(desk.pool.outgrown().is_none());
    }
    checked
}

#[test]
fn canonical_building_keeps_the_value() {
    let checked = each(1, 4000, &mut |desk, e, at, dual, _| {
        close(dual.value, value(desk, e, at), &|| desk.pool.print(e));
    });
    assert!(checked > 2000, "{checked}");
}

#[test]
fn derivatives_are_those_of_dual_numbers() {
    let checked = each(2, 4000, &mut |desk, e, at, dual, along| {
        let mut slope = 0.0;
        for (i, symbol) in desk.symbols.clone().into_iter().enumerate() {
            let partial = desk.pool.differentiate(e, symbol);
            slope += along[i] * value(desk, partial, at);
        }
        close(dual.slope, slope, &|| desk.pool.print(e));
        // And along a direction at once.
        let mut direction = Vec::new();
        for (&symbol, &rate) in desk.symbols.clone().iter().zip(&along) {
            let rate =
                crate::symbolic::Rational::new((rate * 1e6).round() as i128, 1_000_000).unwrap();
            direction.push((symbol, desk.pool.number(rate)));
        }
        let total = desk.pool.derivative_along(e, &direction);
        let scale = 1.0 + dual.slope.abs();
        assert!((value(desk, total, at) - dual.slope).abs() < 1e-2 * scale);
    });
    assert!(checked > 2000, "{checked}");
}

#[test]
fn rewriting_keeps_the_value_and_never_costs() {
    let mut cheaper = 0;
    let checked = each(3, 4000, &mut |desk, e, at, dual, _| {
        let expanded = desk.pool.expand(e);
        let simple = desk.pool.simplify(e);
        let factored = desk.pool.factor(expanded);
        for form in [expanded, simple, factored] {
            close(dual.value, value(desk, form, at), &|| {
                format!("{} became {}", desk.pool.print(e), desk.pool.print(form))
            });
        }
        let (before, after) = (desk.pool.operations(&[e]), desk.pool.operations(&[simple]));
        cheaper += usize::from(after < before);
        assert!(
            after <= before,
            "{} became {}",
            desk.pool.print(e),
            desk.pool.print(simple)
        );
    });
    assert!(checked > 2000 && cheaper > 20, "{checked} {cheaper}");
}

#[test]
fn rewriting_is_idempotent_and_repeatable() {
    let mut random = Random::new(4);
    for _ in 0..500 {
        let steps = program(&mut random, 12);
        let mut texts = Vec::new();
        for _ in 0..2 {
            let mut desk = Desk::default();
            let Some(e) = build(&mut desk, &steps) else {
                continue;
            };
            let simple = desk.pool.simplify(e);
            let expanded = desk.pool.expand(e);
            assert_eq!(desk.pool.expand(expanded), expanded);
            texts.push((
                desk.pool.print(simple),
                desk.pool.print(expanded),
                desk.pool.len(),
            ));
        }
        assert!(texts.windows(2).all(|pair| pair[0] == pair[1]));
    }
}

#[test]
fn printing_reads_back_as_the_same_expression() {
    let checked = each(5, 2000, &mut |desk, e, _, _, _| {
        let text = desk.pool.print(e);
        let again = desk.read(&text);
        assert_eq!(again, e, "{text} became {}", desk.pool.print(again));
    });
    assert!(checked > 1000, "{checked}");
}

#[test]
fn substitution_commutes_with_evaluation() {
    let checked = each(6, 2000, &mut |desk, e, at, dual, _| {
        // x → x + y, evaluated where the sum is the old x.
        let [x, y, _] = [0, 1, 2].map(|i| desk.symbols[i]);
        let (a, b) = (desk.pool.leaf(x), desk.pool.leaf(y));
        let sum = desk.pool.add(a, b);
        let shifted = desk.pool.substitute(e, &[(x, sum)]);
        close(
            dual.value,
            value(desk, shifted, [at[0] - at[1], at[1], at[2]]),
            &|| desk.pool.print(e),
        );
    });
    assert!(checked > 1000, "{checked}");
}

/// A random polynomial in sin and cos of x, y, x ± y, as text and as value.
fn trigonometric(random: &mut Random, [x, y, _]: [f64; 3]) -> (String, f64) {
    let angles = [
        ("x", x),
        ("y", y),
        ("x + y", x + y),
        ("x - y", x - y),
        ("x + 1", x + 1.0),
    ];
    let mut text = String::from("0");
    let mut sum = 0.0;
    for _ in 0..2 + random.below(5) {
        let n = random.below(5) as i32 - 2;
        text += &format!(" + ({n})");
        let mut term = f64::from(n);
        for _ in 0..random.below(4) {
            let (name, angle) = angles[random.below(5) as usize];
            let exponent = 1 + random.below(3) as i32;
            let (f, value) = match random.below(2) {
                0 => ("sin", angle.sin()),
                _ => ("cos", angle.cos()),
            };
            text += &format!("*{f}({name})^{exponent}");
            term *= value.powi(exponent);
        }
        sum += term;
    }
    (text, sum)
}

#[test]
fn trigonometric_polynomials_keep_their_value() {
    let mut random = Random::new(7);
    for _ in 0..100 {
        let at = [0; 3].map(|_| random.between(-3.0, 3.0));
        let (a, b) = (
            trigonometric(&mut random, at),
            trigonometric(&mut random, at),
        );
        let c = trigonometric(&mut random, at);
        let (text, exact) = (
            format!("({})*({}) - ({})^2", a.0, b.0, c.0),
            a.1 * b.1 - c.1 * c.1,
        );
        let mut desk = Desk::default();
        desk.symbol("x");
        desk.symbol("y");
        let e = desk.read(&text);
        let expanded = desk.pool.expand(e);
        let split = desk.pool.split_angles(expanded);
        for form in [e, expanded, split, desk.pool.simplify(e)] {
            let found = value(&desk, form, at);
            assert!(
                (found - exact).abs() < 1e-10,
                "{text} became {}: {exact} {found}",
                desk.pool.print(form)
            );
        }
    }
}
