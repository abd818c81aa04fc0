//! Taylor coefficients against known series and identities; duals against differences.

use super::*;

const ORDER: usize = 24;

/// The series of `f(x(τ))`, x given by its coefficients.
fn expand(
    inputs: &[&[f64]],
    f: impl Fn(&mut Recorder<'_, f64>, &[Recorded]) -> Recorded,
) -> Result<Vec<f64>, Operation> {
    let mut recording = Recording::new(100, &[]);
    let slots: Vec<Recorded> = (0..inputs.len())
        .map(|i| Recorded::varying(Slot::new(90 + i)))
        .collect();
    let mut a = recording.record(2);
    a.cut();
    let result = f(&mut a, &slots);
    let program = Program::new(&mut recording, &[result.slot]);
    let (mut first, _) = recording.finish();
    for (slot, input) in slots.iter().zip(inputs) {
        first[slot.slot.index()] = input[0];
    }
    program.evaluate(1, &mut first);
    // The inputs come from outside, as solutions of equations do.
    let mut expansion = Expansion::new(&program, first.len(), &[result], Some(&[]));
    if let Some(operation) = expansion.singular(&first) {
        return Err(operation);
    }
    expansion.begin(&first);
    expansion.run(&program, &mut first, ORDER, &[], |k, now, _, _| {
        for (slot, input) in slots.iter().zip(inputs) {
            now[slot.slot.index()] = input.get(k).copied().unwrap_or(0.0);
        }
    });
    Ok(expansion.series(result, ORDER).to_vec())
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
    same(&expand(&[&tau], |a, x| a.exp(0, x[0])).unwrap(), |k| {
        1.0 / factorial(k)
    });
    let sign = |k: usize| if (k / 2).is_multiple_of(2) { 1.0 } else { -1.0 };
    let odd = |k: usize| if k % 2 == 1 { 1.0 } else { 0.0 };
    same(
        &expand(&[&tau], |a, x| a.sin_cos(0, x[0]).0).unwrap(),
        |k| sign(k) * odd(k) / factorial(k),
    );
    same(
        &expand(&[&tau], |a, x| a.sin_cos(0, x[0]).1).unwrap(),
        |k| sign(k) * odd(k + 1) / factorial(k),
    );
    same(
        &expand(&[&tau], |a, x| a.sinh_cosh(0, x[0]).0).unwrap(),
        |k| odd(k) / factorial(k),
    );
    same(
        &expand(&[&tau], |a, x| a.sinh_cosh(0, x[0]).1).unwrap(),
        |k| odd(k + 1) / factorial(k),
    );
    let alternating = |k: usize| {
        if k == 0 {
            0.0
        } else {
            -(-1_f64).powi(k as i32) / k as f64
        }
    };
    same(
        &expand(&[&from_one], |a, x| a.ln(0, x[0])).unwrap(),
        alternating,
    );
    same(
        &expand(&[&from_one], |a, x| a.sqrt(0, x[0])).unwrap(),
        |k| binomial(0.5, k),
    );
    same(
        &expand(&[&from_one], |a, x| a.powf(0, x[0], -1.7)).unwrap(),
        |k| binomial(-1.7, k),
    );
    same(
        &expand(&[&from_one], |a, x| a.ratio(0, 1.0, x[0])).unwrap(),
        |k| (-1_f64).powi(k as i32),
    );
    same(&expand(&[&tau], |a, x| a.atan(0, x[0])).unwrap(), |k| {
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
    same(&expand(&[&tau], |a, x| a.asin(0, x[0])).unwrap(), asin);
    let half_turn = std::f64::consts::FRAC_PI_2;
    same(&expand(&[&tau], |a, x| a.acos(0, x[0])).unwrap(), |k| {
        if k == 0 { half_turn } else { -asin(k) }
    });
}

#[test]
fn identities_hold_in_every_coefficient() {
    let x = generic(0.4, 3);
    let y = generic(1.3, 8);
    let back_to_x = |f: &dyn Fn(&mut Recorder<'_, f64>, &[Recorded]) -> Recorded| {
        same(&expand(&[&x, &y], f).unwrap(), |k| x[k]);
    };
    back_to_x(&|a, s| {
        let product = a.mul(0, s[0], s[1]);
        a.div(1, product, s[1])
    });
    back_to_x(&|a, s| {
        let root = a.sqrt(0, s[0]);
        a.square(1, root)
    });
    back_to_x(&|a, s| {
        let root = a.powf(0, s[0], 1.0 / 3.0);
        let square = a.square(1, root);
        a.mul(2, square, root)
    });
    back_to_x(&|a, s| {
        let ln = a.ln(0, s[0]);
        a.exp(1, ln)
    });
    back_to_x(&|a, s| {
        let angle = a.asin(0, s[0]);
        a.sin_cos(2, angle).0
    });
    back_to_x(&|a, s| {
        let angle = a.acos(0, s[0]);
        a.sin_cos(2, angle).1
    });
    back_to_x(&|a, s| {
        let angle = a.atan(0, s[0]);
        a.tan(2, angle)
    });
    back_to_x(&|a, s| {
        let tan = a.tan(0, s[0]);
        a.atan(2, tan)
    });
    back_to_x(&|a, s| {
        let (sin, cos) = a.sin_cos(0, s[0]);
        let (up, along) = (a.mul(2, s[1], sin), a.mul(3, s[1], cos));
        a.atan2(4, up, along)
    });
    back_to_x(&|a, s| {
        let (sinh, cosh) = a.sinh_cosh(0, s[0]);
        let tanh = a.tanh(2, s[0]);
        let back = a.mul(4, tanh, cosh);
        let difference = a.sub(5, back, sinh);
        let twice = a.scale(6, 2.0, s[0]);
        let part = a.sub(7, twice, s[0]);
        a.add(8, part, difference)
    });
}

#[test]
fn where_there_is_no_series_a_flag_says_so() {
    let tau = [0.0, 1.0];
    let one = [1.0, 0.5];
    let operation = |x: &[f64], f: &dyn Fn(&mut Recorder<'_, f64>, &[Recorded]) -> Recorded| {
        expand(&[x], f).unwrap_err()
    };
    assert_eq!(
        operation(&tau, &|a, x| a.sqrt(3, x[0])),
        Operation::SquareRoot
    );
    assert_eq!(
        operation(&tau, &|a, x| a.powf(0, x[0], 1.5)),
        Operation::Power
    );
    assert_eq!(operation(&tau, &|a, x| a.ln(0, x[0])), Operation::Logarithm);
    assert_eq!(
        operation(&tau, &|a, x| a.ratio(0, 2.0, x[0])),
        Operation::Division
    );
    assert_eq!(
        operation(&tau, &|a, x| a.div(0, x[0], x[0])),
        Operation::Division
    );
    assert_eq!(
        operation(&tau, &|a, x| a.atan2(0, x[0], x[0])),
        Operation::Angle
    );
    assert_eq!(
        operation(&one, &|a, x| a.asin(0, x[0])),
        Operation::InverseSine
    );
    assert_eq!(
        operation(&one, &|a, x| a.acos(0, x[0])),
        Operation::InverseSine
    );
    // The first one counts.
    let twice = |a: &mut Recorder<'_, f64>, x: &[Recorded]| {
        let root = a.sqrt(0, x[0]);
        a.ln(1, root)
    };
    assert_eq!(operation(&tau, &twice), Operation::SquareRoot);
}

/// Every operation once, smooth at (0.4, 1.3).
fn everything<A: Arithmetic>(a: &mut A, x: A::Node, y: A::Node) -> A::Node {
    let half = A::Scalar::from_f64(0.5);
    let (sin, cos) = a.sin_cos(0, x);
    let (sinh, cosh) = a.sinh_cosh(2, y);
    let parts = [
        a.mul(4, sin, cosh),
        a.div(5, cos, y),
        a.ratio(6, half, y),
        a.sqrt(7, y),
        a.powf(8, y, 2.3),
        a.exp(9, x),
        a.ln(10, y),
        a.tan(11, x),
        a.tanh(13, y),
        a.asin(15, x),
        a.acos(17, x),
        a.atan(19, sinh),
        a.atan2(21, x, y),
        a.square(23, y),
        a.scale(24, half, x),
        a.offset(25, half, y),
        a.constant(26, half),
    ];
    let mut sum = a.neg(27, parts[0]);
    for (i, &part) in parts[1..].iter().enumerate() {
        // Products of what comes before, so that no part can hide.
        let weighted = a.mul(28 + 2 * i, part, parts[i]);
        sum = a.sub(29 + 2 * i, weighted, sum);
    }
    sum
}

#[test]
fn dual_numbers_agree_with_differences() {
    let value = |x: f64, y: f64| everything(&mut Value::new(), x, y);
    let mut a = Derivative::<f64, 2>::new();
    let dual = everything(&mut a, Dual::variable(0.4, 0), Dual::variable(1.3, 1));
    assert_eq!(dual.value, value(0.4, 1.3));
    let h = 1e-4;
    // Central differences of fourth order.
    let slope =
        |f: &dyn Fn(f64) -> f64| (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
    let expected = [
        slope(&|d| value(0.4 + d, 1.3)),
        slope(&|d| value(0.4, 1.3 + d)),
    ];
    for (found, expected) in dual.derivative.into_iter().zip(expected) {
        assert!(
            (found - expected).abs() < 1e-11 * (1.0 + expected.abs()),
            "{found} is not {expected}"
        );
    }
}

#[test]
fn dual_numbers_nest() {
    // f = x³ y: f_xy = 3 x²
    type Inner = Dual<f64, 1>;
    let x = Dual::<Inner, 1>::variable(Dual::constant(0.7), 0);
    let y = Dual::<Inner, 1>::constant(Dual::variable(2.0, 0));
    let f = x.powf(3.0) * y;
    assert!((f.derivative[0].derivative[0] - 3.0 * 0.49).abs() < 1e-14);
}

#[test]
fn a_jet_is_the_value_along_the_curve() {
    let (x, y) = (generic(0.4, 3), generic(1.3, 8));
    let series = expand(&[&x, &y], |a, s| everything(a, s[0], s[1])).expect("smooth");
    let at = |c: &[f64], tau: f64| c.iter().rev().fold(0.0, |sum, c| sum * tau + c);
    for tau in [-0.05, 0.0, 0.03] {
        let direct = everything(&mut Value::new(), at(&x, tau), at(&y, tau));
        let series = at(&series, tau);
        assert!(
            (direct - series).abs() < 1e-13 * (1.0 + direct.abs()),
            "{direct:e} is not {series:e}"
        );
    }
}

#[test]
fn single_precision_runs_the_same_code() {
    let single = everything(&mut Value::new(), 0.4_f32, 1.3_f32);
    let double = everything(&mut Value::new(), 0.4_f64, 1.3_f64);
    assert!((f64::from(single) - double).abs() < 1e-4 * double.abs());
}

/// Of a tape with the numbers a and b, whether others in their place give the tape that recording with them gives, and if so
/// that it does.
#[track_caller]
fn renewable(before: [f64; 2], after: [f64; 2]) -> bool {
    let record = |numbers: [f64; 2]| {
        let mut recording = Recording::new(10, &numbers);
        let mut r = recording.record(3);
        let x = Recorded::varying(Slot::new(2));
        let [a, b] = numbers;
        // b (a x), x² + b, a − x
        let ax = r.scale(0, a, x);
        let product = r.scale(1, b, ax);
        let square = r.square(2, x);
        let sum = r.offset(3, b, square);
        let a = r.constant(4, a);
        let difference = r.sub(5, a, x);
        let results = [product.slot, sum.slot, difference.slot];
        let program = Program::new(&mut recording, &results);
        let (registers, renewal) = recording.finish();
        (program, registers, renewal, results)
    };
    let values = |program: &Program, mut registers: Vec<f64>, results: [Slot; 3]| {
        registers[2] = 0.7;
        program.evaluate(0, &mut registers);
        results.map(|slot| registers[slot.index()])
    };
    let (program, mut registers, mut renewal, results) = record(before);
    let kept = renewal.renew(&after, &mut registers);
    if kept {
        let (new, new_registers, _, new_results) = record(after);
        assert_eq!(format!("{program:?}"), format!("{new:?}"));
        let found = values(&program, registers, results);
        assert_eq!(found, values(&new, new_registers, new_results));
        let [a, b] = after;
        assert!((found[0] - b * (a * 0.7)).abs() < 1e-15 && (found[2] - (a - 0.7)).abs() < 1e-15);
    }
    kept
}

#[test]
fn numbers_are_exchanged_where_the_recording_stays() {
    assert!(renewable([2.0, 3.0], [5.0, 0.3]));
    assert!(renewable([1.0, 3.0], [1.0, 4.0]));
    assert!(renewable([0.0, 3.0], [0.0, 4.0]));
    assert!(renewable([3.0, 3.0], [4.0, 4.0]));
    for special in [0.0, 1.0, -1.0] {
        assert!(!renewable([2.0, 3.0], [special, 3.0]));
        assert!(!renewable([2.0, special], [2.0, 3.0]));
    }
    // Equal numbers are one register.
    assert!(!renewable([2.0, 3.0], [2.0, 2.0]));
    assert!(!renewable([2.0, 2.0], [2.0, 3.0]));
    // As is a product that equals a number.
    assert!(!renewable([2.0, 3.0], [2.0, 0.5]));
    assert!(!renewable([2.0, 0.5], [2.0, 3.0]));
}
