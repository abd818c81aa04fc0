//! Systems of textbooks.

use super::kit::Build;
use crate::model::{Level, Normal};

/// Point mass in the plane, θ from the vertical.
pub fn mass_on_shell() -> Build {
    Build::new("r theta", "m g R")
        .define("px", "r*sin(theta)")
        .define("py", "r*cos(theta)")
        .kinetic("", "m/2*(der(px)^2 + der(py)^2)")
        .potential("", "m*g*py")
        .contact("shell", "r - R")
}

pub fn rolling_sphere() -> Build {
    Build::new("r theta phi", "m g R a")
        .define("px", "r*sin(theta)")
        .define("py", "r*cos(theta)")
        .kinetic(
            "",
            "m/2*(der(px)^2 + der(py)^2) + 1/2*(2/5*m*a^2)*der(phi)^2",
        )
        .potential("", "m*g*py")
        .contact("shell", "r - (R + a)")
        .friction(
            "grip",
            Normal::Contact(0),
            &["a*(der(phi) - der(theta)) - R*der(theta)"],
            "1",
        )
}

pub fn mass_on_wheel() -> Build {
    Build::new("x phi r theta", "wheel inertia mass radius gravity mu")
        .define("px", "x + r*sin(theta)")
        .define("py", "r*cos(theta)")
        .kinetic(
            "",
            "wheel/2*der(x)^2 + inertia/2*der(phi)^2 + mass/2*(der(px)^2 + der(py)^2)",
        )
        .potential("", "mass*gravity*py")
        .constraint("rolling", Level::Velocity, "der(x) - radius*der(phi)")
        .contact("rim", "r - radius")
        .friction(
            "grip",
            Normal::Contact(0),
            &["radius*(der(theta) - der(phi))"],
            "mu",
        )
}

pub fn sphere_in_sphere() -> Build {
    Build::new("r theta phi", "m g R a")
        .define("px", "r*sin(theta)")
        .define("py", "-r*cos(theta)")
        .kinetic(
            "",
            "m/2*(der(px)^2 + der(py)^2) + 1/2*(2/5*m*a^2)*der(phi)^2",
        )
        .potential("", "m*g*py")
        .contact("shell", "R - a - r")
        .friction(
            "grip",
            Normal::Contact(0),
            &["R*der(theta) - a*(der(phi) + der(theta))"],
            "1",
        )
}

pub fn double_pendulum() -> Build {
    Build::new("th1 th2", "m1 m2 l1 l2 g")
        .define("x1", "l1*sin(th1)")
        .define("y1", "-l1*cos(th1)")
        .define("x2", "x1 + l2*sin(th2)")
        .define("y2", "y1 - l2*cos(th2)")
        .kinetic(
            "",
            "m1/2*(der(x1)^2 + der(y1)^2) + m2/2*(der(x2)^2 + der(y2)^2)",
        )
        .potential("", "m1*g*y1 + m2*g*y2")
}

pub fn cart_pole() -> Build {
    Build::new("x theta", "M m l g")
        .define("px", "x + l*sin(theta)")
        .define("py", "l*cos(theta)")
        .kinetic("", "M/2*der(x)^2 + m/2*(der(px)^2 + der(py)^2)")
        .potential("", "m*g*py")
}
