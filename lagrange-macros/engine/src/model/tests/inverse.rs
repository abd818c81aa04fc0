//! Conditions on inverse functions hold where the same conditions on their arguments do.

use super::read;
use crate::symbolic::Symbol;

/// Comparisons of x, between −1 and 1, with b and c.
const CONDITIONS: [&str; 19] = [
    "acos(x) >= b",
    "acos(x) <= b",
    "b - 2 * acos(x) * 180 / pi >= 3",
    "asin(x) >= b",
    "2 - asin(x) >= b * c",
    "asin(x)/2 <= 0.3",
    "acos(x) >= 1.1",
    "acos(x) >= -0.5",
    "acos(x) >= 4",
    "sqrt(1 - x) >= b",
    "sqrt(1 - x) <= b",
    "sqrt(2 * c^2 * (1 - x)) >= 0.3",
    "(1 - x)^(3/2) >= b",
    "acos(sqrt((1 + x)/2)) >= b",
    "acos(x) >= b + t/10",
    "acos(x) + x >= b",
    "b * acos(x) >= c",
    "asin(x) / b <= c",
    "b * sqrt(1 - x) >= -c",
];

/// Where an `if` holds as it is declared and as it is decided, for many numbers, some of which no angle has.
#[test]
fn a_condition_says_of_the_argument_what_it_says_of_the_function() {
    for condition in CONDITIONS {
        let system = read(&format!(
            "#[lagrange(coordinates(x), kinetic = der(x)^2/2, force(f: x = if({condition}, 1, 0)))]
            struct Scene {{ b: f64, c: f64 }}"
        ));
        let system = system.expect("a system");
        let [branch] = &system.branches[..] else {
            panic!("{condition}: {} branches", system.branches.len());
        };
        assert_ne!(branch.guard, branch.declared, "{condition}");
        let mut seed = 1_u64;
        let mut next = |low: f64, high: f64| {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..200 {
            let [x, b, c, t] = [(-1.0, 1.0), (-4.0, 5.0), (0.2, 2.0), (0.0, 3.0)]
                .map(|(low, high)| next(low, high));
            let number = |symbol: Symbol| match system.pool.name(symbol) {
                "x" => x,
                "b" => b,
                "c" => c,
                _ => t,
            };
            let pair = [branch.guard, branch.declared];
            let values = system.pool.evaluate(&pair, &number, &|_| true);
            let [guard, declared] = [values[0], values[1]];
            let close = declared.abs() < 1e-9;
            assert!(
                close || (guard >= 0.0) == (declared >= 0.0),
                "{condition} at x = {x}, b = {b}, c = {c}, t = {t}: {guard}, {declared}"
            );
        }
    }
}
