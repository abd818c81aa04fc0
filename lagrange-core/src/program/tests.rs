//! Values over machine and dual numbers; Taylor coefficients against known series and identities.

use super::instruction::Op;
use super::*;
use crate::arithmetic::{Dual, Scalar};

const ORDER: usize = 24;

/// A program with its numbers, written by hand.
struct Sheet {
    builder: Builder,
    numbers: Vec<(Register, f64)>,
}

macro_rules! operations {
    ($($name:ident($($y:ident)?) $op:ident;)*) => {$(
        fn $name(&mut self, x: Register $(, $y: Register)?) -> Register {
            let _y = Register::ZERO;
            $(let _y = $y;)?
            self.builder.push(Op::$op, x, _y)
        }
    )*};
}

impl Sheet {
    operations! {
        add(y) Add; sub(y) Sub; mul(y) Mul; scale(y) Scale; div(y) Div; neg() Neg; square() Square; sqrt() Sqrt; exp() Exp; ln() Ln;
        sin() SinCos; sinh() SinhCosh; tan() Tan; tanh() Tanh; asin() Asin; acos() Acos; atan() Atan; atan2(x) Atan2;
    }

    fn number(&mut self, value: f64) -> Register {
        let register = self.builder.fresh();
        self.numbers.push((register, value));
        register
    }

    fn scaled(&mut self, c: f64, x: Register) -> Register {
        let c = self.number(c);
        self.scale(c, x)
    }

    fn ratio(&mut self, c: f64, x: Register) -> Register {
        let c = self.number(c);
        self.div(c, x)
    }

    fn powf(&mut self, x: Register, c: f64) -> Register {
        let c = self.number(c);
        self.builder.push(Op::Powf, x, c)
    }

    fn cos(&mut self, x: Register) -> Register {
        self.sin(x).next()
    }

    fn cosh(&mut self, x: Register) -> Register {
        self.sinh(x).next()
    }
}

type Function<'a> = &'a dyn Fn(&mut Sheet, &[Register]) -> Register;

/// The program of a function of so many inputs, its registers with the numbers, and where the inputs and the result are.
fn written<T: Scalar>(count: usize, f: Function) -> (Program, Vec<T>, Vec<Register>, Register) {
    let mut sheet = Sheet {
        builder: Builder::new(1),
        numbers: Vec::new(),
    };
    let inputs: Vec<Register> = (0..count).map(|_| sheet.builder.fresh()).collect();
    let result = f(&mut sheet, &inputs);
    let (program, used) = sheet.builder.finish();
    let mut registers = vec![T::zero(); room(used)];
    for (register, value) in sheet.numbers {
        registers[register.index()] = T::from_f64(value);
    }
    (program, registers, inputs, result)
}

/// f(x)
fn value<T: Scalar>(x: &[T], f: Function) -> T {
    let (program, mut registers, inputs, result) = written::<T>(x.len(), f);
    for (input, &x) in inputs.iter().zip(x) {
        registers[input.index()] = x;
    }
    program.evaluate(0, &mut registers);
    registers[result.index()]
}

/// The series of `f(x(τ))`, x given by its coefficients.
fn expand(x: &[&[f64]], f: Function) -> Result<Vec<f64>, Operation> {
    let (program, mut first, inputs, result) = written::<f64>(x.len(), f);
    for (input, x) in inputs.iter().zip(x) {
        first[input.index()] = x[0];
    }
    program.evaluate(0, &mut first);
    // The inputs come from outside, as solutions of equations do: the whole program runs after them.
    let mut series = Series::new(&program, first.len(), &[result], core::iter::empty(), 0);
    if let Some((operation, _)) = series.singular(&first).next() {
        return Err(operation);
    }
    series.begin(&first);
    series.run(&program, &mut first, ORDER, &[], |k, now, _, _| {
        for (input, x) in inputs.iter().zip(x) {
            now[input.index()] = x.get(k).copied().unwrap_or(0.0);
        }
    });
    Ok(series.series(result, ORDER).to_vec())
}

#[track_caller]
fn same(found: &[f64], expected: impl Fn(usize) -> f64) {
    for (k, &c) in found.iter().enumerate() {
        let e = expected(k);
        assert!(
            (c - e).abs() <= 4e-14 * (1.0 + e.abs()),
            "coefficient {k}: {c:e} is not {e:e}"
        );
    }
}

fn factorial(k: usize) -> f64 {
    (1..=k).map(|j| j as f64).product()
}

/// c (c−1) … (c−k+1) / k!
fn binomial(c: f64, k: usize) -> f64 {
    (0..k).map(|j| (c - j as f64) / (j + 1) as f64).product()
}

/// A series without special structure: xₖ of order one and of both signs, radius about 1.5.
fn generic(start: f64, seed: u32) -> Vec<f64> {
    let step = |k: usize| ((k as f64 + f64::from(seed)) * 1.7).sin() * 0.66_f64.powi(k as i32);
    (0..=ORDER)
        .map(|k| if k == 0 { start } else { step(k) })
        .collect()
}

#[test]
fn elementary_functions_have_their_textbook_series() {
    let tau = [0.0, 1.0];
    let from_one = [1.0, 1.0];
    same(&expand(&[&tau], &|a, x| a.exp(x[0])).unwrap(), |k| {
        1.0 / factorial(k)
    });
    let sign = |k: usize| if (k / 2).is_multiple_of(2) { 1.0 } else { -1.0 };
    let odd = |k: usize| if k % 2 == 1 { 1.0 } else { 0.0 };
    same(&expand(&[&tau], &|a, x| a.sin(x[0])).unwrap(), |k| {
        sign(k) * odd(k) / factorial(k)
    });
    same(&expand(&[&tau], &|a, x| a.cos(x[0])).unwrap(), |k| {
        sign(k) * odd(k + 1) / factorial(k)
    });
    same(&expand(&[&tau], &|a, x| a.sinh(x[0])).unwrap(), |k| {
        odd(k) / factorial(k)
    });
    same(&expand(&[&tau], &|a, x| a.cosh(x[0])).unwrap(), |k| {
        odd(k + 1) / factorial(k)
    });
    let alternating = |k: usize| {
        if k == 0 {
            0.0
        } else {
            -(-1_f64).powi(k as i32) / k as f64
        }
    };
    same(
        &expand(&[&from_one], &|a, x| a.ln(x[0])).unwrap(),
        alternating,
    );
    same(&expand(&[&from_one], &|a, x| a.sqrt(x[0])).unwrap(), |k| {
        binomial(0.5, k)
    });
    same(
        &expand(&[&from_one], &|a, x| a.powf(x[0], -1.7)).unwrap(),
        |k| binomial(-1.7, k),
    );
    same(
        &expand(&[&from_one], &|a, x| a.ratio(1.0, x[0])).unwrap(),
        |k| (-1_f64).powi(k as i32),
    );
    same(&expand(&[&tau], &|a, x| a.atan(x[0])).unwrap(), |k| {
        if k == 0 {
            0.0
        } else {
            sign(k) * odd(k) / k as f64
        }
    });
    let asin = |k: usize| {
        if k % 2 == 1 {
            binomial(-0.5, k / 2).abs() / k as f64
        } else {
            0.0
        }
    };
    same(&expand(&[&tau], &|a, x| a.asin(x[0])).unwrap(), asin);
    let half_turn = std::f64::consts::FRAC_PI_2;
    same(&expand(&[&tau], &|a, x| a.acos(x[0])).unwrap(), |k| {
        if k == 0 { half_turn } else { -asin(k) }
    });
}

#[test]
fn identities_hold_in_every_coefficient() {
    let x = generic(0.4, 3);
    let y = generic(1.3, 8);
    let back_to_x = |f: Function| {
        same(&expand(&[&x, &y], f).unwrap(), |k| x[k]);
    };
    back_to_x(&|a, s| {
        let product = a.mul(s[0], s[1]);
        a.div(product, s[1])
    });
    back_to_x(&|a, s| {
        let root = a.sqrt(s[0]);
        a.square(root)
    });
    back_to_x(&|a, s| {
        let root = a.powf(s[0], 1.0 / 3.0);
        let square = a.square(root);
        a.mul(square, root)
    });
    back_to_x(&|a, s| {
        let ln = a.ln(s[0]);
        a.exp(ln)
    });
    back_to_x(&|a, s| {
        let angle = a.asin(s[0]);
        a.sin(angle)
    });
    back_to_x(&|a, s| {
        let angle = a.acos(s[0]);
        a.cos(angle)
    });
    back_to_x(&|a, s| {
        let angle = a.atan(s[0]);
        a.tan(angle)
    });
    back_to_x(&|a, s| {
        let tan = a.tan(s[0]);
        a.atan(tan)
    });
    back_to_x(&|a, s| {
        let (sin, cos) = (a.sin(s[0]), a.cos(s[0]));
        let (up, along) = (a.mul(s[1], sin), a.mul(s[1], cos));
        a.atan2(up, along)
    });
    back_to_x(&|a, s| {
        let (sinh, cosh) = (a.sinh(s[0]), a.cosh(s[0]));
        let tanh = a.tanh(s[0]);
        let back = a.mul(tanh, cosh);
        let difference = a.sub(back, sinh);
        let twice = a.scaled(2.0, s[0]);
        let part = a.sub(twice, s[0]);
        a.add(part, difference)
    });
}

#[test]
fn where_there_is_no_series_a_flag_says_so() {
    let tau = [0.0, 1.0];
    let one = [1.0, 0.5];
    let operation = |x: &[f64], f: Function| expand(&[x], f).unwrap_err();
    assert_eq!(operation(&tau, &|a, x| a.sqrt(x[0])), Operation::SquareRoot);
    assert_eq!(operation(&tau, &|a, x| a.powf(x[0], 1.5)), Operation::Power);
    assert_eq!(operation(&tau, &|a, x| a.ln(x[0])), Operation::Logarithm);
    assert_eq!(
        operation(&tau, &|a, x| a.ratio(2.0, x[0])),
        Operation::Division
    );
    assert_eq!(
        operation(&tau, &|a, x| a.div(x[0], x[0])),
        Operation::Division
    );
    assert_eq!(
        operation(&tau, &|a, x| a.atan2(x[0], x[0])),
        Operation::Angle
    );
    assert_eq!(
        operation(&one, &|a, x| a.asin(x[0])),
        Operation::InverseSine
    );
    assert_eq!(
        operation(&one, &|a, x| a.acos(x[0])),
        Operation::InverseSine
    );
    // The first one counts.
    let twice = |a: &mut Sheet, x: &[Register]| {
        let root = a.sqrt(x[0]);
        a.ln(root)
    };
    assert_eq!(operation(&tau, &twice), Operation::SquareRoot);
}

/// Every operation once, smooth at (0.4, 1.3).
fn everything(a: &mut Sheet, x: Register, y: Register) -> Register {
    let half = a.number(0.5);
    let (sin, cos) = (a.sin(x), a.cos(x));
    let (sinh, cosh) = (a.sinh(y), a.cosh(y));
    let parts = [
        a.mul(sin, cosh),
        a.div(cos, y),
        a.div(half, y),
        a.sqrt(y),
        a.powf(y, 2.3),
        a.exp(x),
        a.ln(y),
        a.tan(x),
        a.tanh(y),
        a.asin(x),
        a.acos(x),
        a.atan(sinh),
        a.atan2(x, y),
        a.square(y),
        a.scale(half, x),
        a.add(half, y),
        half,
    ];
    let mut sum = a.neg(parts[0]);
    for (i, &part) in parts[1..].iter().enumerate() {
        // Products of what comes before, so that no part can hide.
        let weighted = a.mul(part, parts[i]);
        sum = a.sub(weighted, sum);
    }
    sum
}

#[test]
fn dual_numbers_agree_with_differences() {
    let f: Function = &|a, x| everything(a, x[0], x[1]);
    let value_at = |x: f64, y: f64| value(&[x, y], f);
    let dual = value::<Dual<f64, 2>>(&[Dual::variable(0.4, 0), Dual::variable(1.3, 1)], f);
    assert_eq!(dual.value, value_at(0.4, 1.3));
    let h = 1e-4;
    // Central differences of fourth order.
    let slope =
        |f: &dyn Fn(f64) -> f64| (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
    let expected = [
        slope(&|d| value_at(0.4 + d, 1.3)),
        slope(&|d| value_at(0.4, 1.3 + d)),
    ];
    for (found, expected) in dual.derivative.into_iter().zip(expected) {
        assert!(
            (found - expected).abs() < 1e-11 * (1.0 + expected.abs()),
            "{found} is not {expected}"
        );
    }
}

#[test]
fn a_jet_is_the_value_along_the_curve() {
    let (x, y) = (generic(0.4, 3), generic(1.3, 8));
    let series = expand(&[&x, &y], &|a, s| everything(a, s[0], s[1])).expect("smooth");
    let at = |c: &[f64], tau: f64| c.iter().rev().fold(0.0, |sum, c| sum * tau + c);
    for tau in [-0.05, 0.0, 0.03] {
        let direct = value(&[at(&x, tau), at(&y, tau)], &|a, s| {
            everything(a, s[0], s[1])
        });
        let series = at(&series, tau);
        assert!(
            (direct - series).abs() < 1e-13 * (1.0 + direct.abs()),
            "{direct:e} is not {series:e}"
        );
    }
}

#[test]
fn single_precision_runs_the_same_code() {
    let f: Function = &|a, x| everything(a, x[0], x[1]);
    let (single, double) = (value(&[0.4_f32, 1.3], f), value(&[0.4_f64, 1.3], f));
    assert!((f64::from(single) - double).abs() < 1e-4 * double.abs());
}
