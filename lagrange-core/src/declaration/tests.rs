//! Intervals hold every value and rate that the numbers in them have.

use super::series::{Series, function, power};
use super::{Interval, Real};

/// Looks at f and its rate at places of an interval of x, which grows at the rate 1.
#[track_caller]
fn holds(low: f64, high: f64, f: impl Fn(Series) -> Series, enclosed: Series<Interval>) {
    for k in 0..=100 {
        let x = low + (high - low) * f64::from(k) / 100.0;
        let Series(numbers) = f(Series([x, 1.0, 0.0]));
        for (number, range) in numbers.into_iter().zip(enclosed.0) {
            let blur = 1e-12 * (1.0 + number.abs());
            let wide = Interval::new(range.low - blur, range.high + blur);
            assert!(wide.contains(number), "{number} at {x} is not in {range:?}");
        }
    }
}

fn between(low: f64, high: f64) -> Series<Interval> {
    Series([
        Interval::new(low, high),
        Interval::number(1.0),
        Interval::default(),
    ])
}

#[test]
fn functions_stay_within_their_intervals() {
    let spans = [(-0.9, 0.7), (0.1, 0.2), (-0.3, -0.1), (0.0, 0.95)];
    for number in 0..10 {
        for (low, high) in spans {
            let all = between(low, high);
            let (enclosed, _) = all.of(function(number, all.0[0]));
            holds(low, high, |x| x.of(function(number, x.0[0])).0, enclosed);
        }
    }
    // Over several turns, and through the top.
    for (low, high) in [(-7.0, 9.0), (1.0, 2.0), (3.0, 4.0), (-2.0, -1.0)] {
        for number in [0, 1, 9, 6, 7, 8, 5] {
            let all = between(low, high);
            let (enclosed, _) = all.of(function(number, all.0[0]));
            holds(low, high, |x| x.of(function(number, x.0[0])).0, enclosed);
        }
    }
}

#[test]
fn powers_stay_within_their_intervals() {
    for p in [2.0, 3.0, 4.0, 1.0, 0.0] {
        let all = between(-1.5, 0.5);
        holds(
            -1.5,
            0.5,
            |x| x.of(power(x.0[0], p)).0,
            all.of(power(all.0[0], p)).0,
        );
    }
    for p in [-1.0, -2.0, 0.5, 1.5, -0.5] {
        let all = between(0.5, 2.5);
        holds(
            0.5,
            2.5,
            |x| x.of(power(x.0[0], p)).0,
            all.of(power(all.0[0], p)).0,
        );
    }
    let square = between(-1.0, 2.0).0[0].raised(2.0);
    assert_eq!(square, Interval::new(0.0, 4.0));
    assert_eq!(between(-1.0, 2.0).0[0].raised(-1.0), Interval::ANYTHING);
}

#[test]
fn angles_and_products_stay_within_their_intervals() {
    let x = Series::constant(Interval::number(-0.5));
    for (low, high) in [(0.2, 3.0), (-2.0, -0.5), (-1.0, 1.0)] {
        let all = between(low, high);
        holds(
            low,
            high,
            |y| y.atan2(Series::constant(-0.5)).0,
            all.atan2(x).0,
        );
        holds(low, high, |y| y * y * y + y, all * all * all + all);
    }
}
