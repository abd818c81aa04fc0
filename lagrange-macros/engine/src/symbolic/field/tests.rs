//! The fields are fields, roots are roots, and equal expressions have equal values.

use super::{PRIMES, Point, Prime, Trouble};
use crate::symbolic::{ExprId, Function, Pool, Rational};

fn is_prime(n: u64) -> bool {
    let power = |base: u64, exponent: u64| {
        let (mut b, mut e, mut result) = (u128::from(base), exponent, 1_u128);
        while e > 0 {
            if e & 1 == 1 {
                result = result * b % u128::from(n);
            }
            b = b * b % u128::from(n);
            e >>= 1;
        }
        result as u64
    };
    let shift = (n - 1).trailing_zeros();
    // These bases decide for all 64-bit numbers (Sorenson & Webster, Math. Comp. 86, 2017).
    [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37]
        .iter()
        .all(|&base| {
            let mut x = power(base, (n - 1) >> shift);
            if x == 1 || x == n - 1 {
                return true;
            }
            (1..shift).any(|_| {
                x = (u128::from(x) * u128::from(x) % u128::from(n)) as u64;
                x == n - 1
            })
        })
}

#[test]
fn the_primes_are_what_the_roots_need() {
    for field in PRIMES {
        let p = field.modulus();
        assert!(is_prime(p) && is_prime(p / 2), "{p}");
        assert_eq!(p % 4, 3);
        for small in [2, 3, 5, 7, 11, 13, 17, 19, 23] {
            assert!(field.is_square(small), "{small} modulo {p}");
        }
        assert!(!field.is_square(p - 1));
    }
}

fn elements(field: Prime) -> Vec<u64> {
    let mut x = 1_u64;
    let mut all = vec![0, 1, 2, field.modulus() - 1, field.modulus() / 2];
    for _ in 0..200 {
        x = x.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(99);
        all.push(field.element(x));
    }
    all
}

#[test]
fn arithmetic_is_that_of_integers_modulo_p() {
    for field in PRIMES {
        let p = u128::from(field.modulus());
        for pair in elements(field).windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let (x, y) = (u128::from(a), u128::from(b));
            assert_eq!(u128::from(field.add(a, b)), (x + y) % p);
            assert_eq!(u128::from(field.sub(a, b)), (x + p - y) % p);
            assert_eq!(u128::from(field.mul(a, b)), x * y % p);
            if let Some(below) = field.inverse(a) {
                assert_eq!(field.mul(a, below), 1);
            }
        }
    }
}

#[test]
fn roots_of_squares_multiply() {
    for field in PRIMES {
        let squares: Vec<u64> = elements(field)
            .into_iter()
            .filter(|&a| field.is_square(a))
            .collect();
        let power = |a, n, d| field.power(a, Rational::new(n, d).unwrap()).unwrap();
        for pair in squares.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let ab = field.mul(a, b);
            assert_eq!(field.pow(power(a, 1, 2), 2), a);
            assert_eq!(field.pow(power(a, 1, 6), 6), a);
            assert_eq!(field.mul(power(a, 1, 2), power(b, 1, 2)), power(ab, 1, 2));
            assert_eq!(field.mul(power(a, -2, 3), power(a, 5, 3)), a);
        }
    }
}

fn symbols(pool: &mut Pool) -> [ExprId; 3] {
    ["x", "y", "z"].map(|name| {
        let symbol = pool.symbol(name);
        pool.leaf(symbol)
    })
}

/// Values of e at a few points of both fields.
fn values(pool: &mut Pool, e: ExprId) -> Vec<Result<u64, Trouble>> {
    let angles = pool.angles(&[e], &[]);
    let points = (0..8).flat_map(|seed| PRIMES.map(|field| Point::new(field, seed, &angles)));
    points
        .map(|mut point| pool.at_point(&[e], &mut point)[0])
        .collect()
}

#[track_caller]
fn vanishes(pool: &mut Pool, e: ExprId) {
    let values = values(pool, e);
    assert!(values.contains(&Ok(0)), "{}: {values:?}", pool.print(e));
    let defined = values
        .iter()
        .all(|v| matches!(v, Ok(0) | Err(Trouble::NotSquare)));
    assert!(defined, "{}: {values:?}", pool.print(e));
}

#[test]
fn identities_of_functions_need_no_rules() {
    let mut pool = Pool::new();
    let [x, y, z] = symbols(&mut pool);
    let p = &mut pool;
    let half = p.scale(x, Rational::HALF);
    let one = p.integer(1);

    // tan(x/2) (1 + cos x) = sin x
    let tan = p.call(Function::Tan, &[half]);
    let (sin, cos) = (p.call(Function::Sin, &[x]), p.call(Function::Cos, &[x]));
    let above = p.add(one, cos);
    let left = p.mul(tan, above);
    let e = p.sub(left, sin);
    vanishes(p, e);

    // cos((x + y) z) = cos xz cos yz − sin xz sin yz
    let sum = p.add(x, y);
    let [whole, xz, yz] = [sum, x, y].map(|a| p.mul(a, z));
    let [c, cx, cy] = [whole, xz, yz].map(|u| p.call(Function::Cos, &[u]));
    let [sx, sy] = [xz, yz].map(|u| p.call(Function::Sin, &[u]));
    let (cc, ss) = (p.mul(cx, cy), p.mul(sx, sy));
    let e = p.sub(cc, ss);
    let e = p.sub(c, e);
    vanishes(p, e);

    // exp(x + y/2)² exp(−y) = exp(x) (sinh x + cosh x)
    let y_half = p.scale(y, Rational::HALF);
    let up = p.add(x, y_half);
    let minus = p.neg(y);
    let (up, down) = (
        p.call(Function::Exp, &[up]),
        p.call(Function::Exp, &[minus]),
    );
    let left = p.product(&[up, up, down]);
    let (s, c) = (p.call(Function::Sinh, &[x]), p.call(Function::Cosh, &[x]));
    let sum = p.add(s, c);
    let exp = p.call(Function::Exp, &[x]);
    let right = p.mul(exp, sum);
    let e = p.sub(left, right);
    vanishes(p, e);

    // sin(x + π/3) = sin x/2 + √3 cos x/2
    let pi = p.pi();
    let third = p.scale(pi, Rational::new(1, 3).unwrap());
    let moved = p.add(x, third);
    let left = p.call(Function::Sin, &[moved]);
    let three = p.integer(3);
    let root = p.sqrt(three);
    let right = p.mul(root, cos);
    let right = p.add(sin, right);
    let right = p.scale(right, Rational::HALF);
    let e = p.sub(left, right);
    vanishes(p, e);

    // √(x²+y²) √(x²+y²) = x² + y², 1/√u = √u/u
    let (xx, yy) = (p.mul(x, x), p.mul(y, y));
    let square = p.add(xx, yy);
    let expanded = p.expand(square);
    let root = p.sqrt(square);
    let right = p.div(expanded, root).unwrap();
    let e = p.sub(root, right);
    vanishes(p, e);
}

#[test]
fn a_root_of_a_square_has_both_signs() {
    let mut pool = Pool::new();
    let [x, y, _] = symbols(&mut pool);
    let sum = pool.add(x, y);
    let square = pool.mul(sum, sum);
    let square = pool.expand(square);
    let root = pool.sqrt(square);
    let e = pool.sub(root, sum);
    let values = values(&mut pool, e);
    assert!(values.contains(&Ok(0)));
    assert!(values.iter().any(|v| *v != Ok(0)));
}

#[test]
fn what_differs_differs() {
    let mut pool = Pool::new();
    let [x, y, _] = symbols(&mut pool);
    let p = &mut pool;
    // sin(x + y) against sin x cos y + cos x sin y · (1 + 10⁻³⁰)
    let sum = p.add(x, y);
    let left = p.call(Function::Sin, &[sum]);
    let [sx, sy] = [x, y].map(|u| p.call(Function::Sin, &[u]));
    let [cx, cy] = [x, y].map(|u| p.call(Function::Cos, &[u]));
    let (a, b) = (p.mul(sx, cy), p.mul(cx, sy));
    let tiny = Rational::new(10_i128.pow(30) + 1, 10_i128.pow(30)).unwrap();
    let b = p.scale(b, tiny);
    let right = p.add(a, b);
    let e = p.sub(left, right);
    assert!(values(p, e).iter().all(|v| matches!(v, Ok(n) if *n != 0)));
}
