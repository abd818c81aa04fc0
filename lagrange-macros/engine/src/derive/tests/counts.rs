//! The derived equations need no more operations than those that one finds in books.

use super::numbers::Derived;
use super::systems::{cart_pole, double_pendulum, mass_on_shell, mass_on_wheel};

/// M and f need no more operations than the equations that one finds in books.
#[test]
fn no_more_operations_than_by_hand() {
    check_operations(
        mass_on_shell().derive(),
        &[
            "m",
            "m*r^2",
            "m*r*v_theta^2 - m*g*cos(theta)",
            "m*r*(g*sin(theta) - 2*v_r*v_theta)",
        ],
    );
    check_operations(
        cart_pole().derive(),
        &[
            "M + m",
            "m*l*cos(theta)",
            "m*l^2",
            "m*l*sin(theta)*v_theta^2",
            "m*g*l*sin(theta)",
        ],
    );
    check_operations(
        double_pendulum().derive(),
        &[
            "(m1 + m2)*l1^2",
            "m2*l1*l2*cos(th1 - th2)",
            "m2*l2^2",
            "-m2*l1*l2*sin(th1 - th2)*v_th2^2 - (m1 + m2)*g*l1*sin(th1)",
            "m2*l1*l2*sin(th1 - th2)*v_th1^2 - m2*g*l2*sin(th2)",
        ],
    );
    check_operations(
        mass_on_wheel().derive(),
        &[
            "wheel + mass",
            "inertia",
            "mass*sin(theta)",
            "mass",
            "mass*r*cos(theta)",
            "mass*r^2",
            "mass*v_theta*(r*v_theta*sin(theta) - 2*v_r*cos(theta))",
            "mass*(r*v_theta^2 - gravity*cos(theta))",
            "mass*r*(gravity*sin(theta) - 2*v_r*v_theta)",
        ],
    );
}

fn check_operations(mut derived: Derived, by_hand: &[&str]) {
    let got = derived.operations();
    let by_hand = derived.operations_of(by_hand);
    assert!(
        got <= by_hand,
        "{got} operations, {by_hand} by hand: {:#?}",
        derived.equations_of_motion()
    );
}
