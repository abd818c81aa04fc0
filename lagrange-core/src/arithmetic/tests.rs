//! Dual numbers of dual numbers.

use super::quad::{Memory, Quad, QuadBody, side_by_side};
use super::*;

#[test]
fn dual_numbers_nest() {
    // f = x³ y: f_xy = 3 x²
    type Inner = Dual<f64, 1>;
    let x = Dual::<Inner, 1>::variable(Dual::constant(0.7), 0);
    let y = Dual::<Inner, 1>::constant(Dual::variable(2.0, 0));
    let f = Scalar::powf(x, 3.0) * y;
    assert!((f.derivative[0].derivative[0] - 3.0 * 0.49).abs() < 1e-14);
}

/// All operations on four numbers.
struct Operations;

impl QuadBody<([f64; 4], [f64; 4])> for Operations {
    type Output = [[f64; 4]; 7];

    #[inline(always)]
    fn run<Q: Quad>(quad: Q, (x, y): ([f64; 4], [f64; 4])) -> Self::Output {
        let (x, y) = (quad.four(x), quad.four(y));
        [
            quad.numbers(quad.product(x, y)),
            quad.numbers(quad.sum(x, y)),
            quad.numbers(quad.magnitudes(x)),
            quad.numbers(quad.first_magnitudes(x, 3)),
            quad.numbers(quad.larger(x, y)),
            quad.numbers(quad.lesser(x, y)),
            [quad.total(x), quad.largest(y), 0.0, 0.0],
        ]
    }
}

#[test]
fn four_numbers_side_by_side_are_what_they_are_in_memory() {
    let numbers = [
        0.0,
        -0.0,
        1.5,
        -2.25,
        1e300,
        -1e-310,
        f64::INFINITY,
        f64::NAN,
    ];
    for k in 0..64 {
        let four = |from: usize| core::array::from_fn(|i| numbers[(from + 3 * i) % 8]);
        let arguments = (four(k % 8), four(k / 8));
        let bits =
            |all: [[f64; 4]; 7]| all.map(|four| four.map(|x: f64| (x.is_nan(), x.to_bits())));
        let [mut here, mut there] = [
            bits(side_by_side::<Operations, _>(arguments)),
            bits(Operations::run(Memory, arguments)),
        ];
        // What is no number has no sign.
        for x in [&mut here, &mut there].into_iter().flatten().flatten() {
            if x.0 {
                x.1 = 0;
            }
        }
        assert_eq!(here, there, "{arguments:?}");
    }
}

#[test]
#[should_panic(expected = "there is no direction 2 among 2")]
fn a_variable_has_a_direction() {
    _ = Dual::<f64, 2>::variable(1.0, 2);
}
