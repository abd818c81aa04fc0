//! Powers that begin where a branch does.

use super::kit::Build;

/// Forces of one branch, and which way its guard goes: down where the first side begins later, up where the second does.
const FORCES: [(&str, f64); 19] = [
    ("k*if(r - x, r - x, 0)^(3/2)", -1.0),
    ("k*if(x - r, 0, r - x)^(3/2)", 1.0),
    ("k*if(x - 1/10, 0, 1/10 - x)^(3/2)", 1.0),
    ("k*if(r - x, (r - x)/2, 0)^(3/2)", -1.0),
    ("(k*if(x - r, 0, r - x))^(3/2)", 1.0),
    ("k*(if(r - x, r - x, 0)/r)^(11/10)", -1.0),
    ("if(1 - x/r, k*(r - x)^(3/2), 0)", -1.0),
    ("if(x/r - 1, 0, k*(r - x)^(3/2))", 1.0),
    ("if(r - x, k, 0)*(r - x)^(3/2)", -1.0),
    ("k*((if(x - r, x - r, r - x) + r - x)/2)^(5/2)", 1.0),
    ("if(1/10 - x, k*(1/10 - x)*sqrt(1/10 - x), 0)", -1.0),
    ("if(1/10 - x, k*(1/10 - x)*sqrt(r*(1/10 - x)), 0)", -1.0),
    ("k*sqrt(if(1/10 - x, 1/10 - x, 0)^3)", -1.0),
    ("if(r - x, k*((r - x)*y)^(3/2), 0)", -1.0),
    // What begins elsewhere, or has a series or no slope where it begins, or is on both sides.
    ("if(r - x, k*y^(3/2), 0)", 0.0),
    ("if(r - m, k^(3/2)*x, 0)", 0.0),
    ("if(r - x, k*(r - x)^2, 0)", 0.0),
    ("if(r - x, k*sqrt(r - x), 0)", 0.0),
    ("if(r - x, k*(r - x)^(3/2), k*(x - r)^(3/2))", 0.0),
];

#[test]
fn the_side_with_the_power_begins_a_little_later() {
    for (force, way) in FORCES {
        let mut derived = Build::new("x y", "m k r")
            .kinetic("", "m/2*(der(x)^2 + der(y)^2)")
            .load("f", force, &[(0, "1")])
            .derive();
        let system = &mut derived.equations.system;
        let [branch] = &system.branches[..] else {
            panic!("{force}: {} branches", system.branches.len());
        };
        let later = system.pool.sub(branch.guard, branch.declared);
        let later = system.pool.evaluate(&[later], &|_| f64::NAN, &|_| true)[0];
        assert_eq!(later, way * 1e-12, "{force}");
    }
}
