//! Declarations drawn at random, as `lagrange export` writes them. `UPDATE_EXPECT=1` writes this file.

#![allow(missing_docs)]

pub mod d18 {
use lagrange_core::prelude::*;

/// Declaration drawn at random.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad", u: "m"),
    define(px = x + length*(dot([ratio, theta], (theta, 2))^2)),
    define(rim = [x + length*cos(theta), y + length*sin(theta)]),
    define(odd[k in 0..2] = weights[k]*length*(2*k + 1)),
    lagrangian = mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2 + mass/2*der(u)^2 - (mass*gravity*y + stiffness/2*(x^2 + y^2)) - stiffness*length^2*(-1e-1),
    constraint(tie: u == length*sin(x/length)),
    contact(floor: y >= 0 at (x, y), where x <= 3*length),
    force(drive: x = push*(cosh(tanh(atan2(second*der(theta), 1 + (t/second)^2))/2)^2)),
    force(twist: theta = push*length*sin(u/length*(x/length*0.25))),
    force(motor: push*sin(list(k1 in 0..3: ratio - second*der(u)/length - k1)[2]) along der(x) + length*sin(acos(tanh(dot([theta, y/length], (y/length, 2)))/2))*der(theta)),
    define(drag = floor*sin(atan2((pi/4)^2, 1 + dot([3/7, x/length], (x/length, 2))^2))/4),
    force(skid: theta = length*drag),
    dissipation(oil: (2 + sin(sum(k5 in 0..3: cos(k5*dot([u/length, x/length], (x/length, 2))))))*damping/2*(der(x)^2 + der(y)^2)),
    start(thrown: x = length*(sign(list(k6 in 0..3: 1.5 - k6)[2])), der(x) = length/second*(pi), theta = ((1 + exp(tanh(t/second)/2)^2)^(1/2)), der(y) = -length/second*(cos(t/second) - tan(tanh(ratio)/2) + cross([(t/second)^2, ratio, 1], [1, t/second, ratio])[1]), y = 2*length),
    start(low: y = length/2, der(theta) = 1/second),
    observe(o0 = push*((pi/4 + second*der(theta))/(1 + if(u/length >= 1/5, second*der(y)/length, u/length)^2))),
    observe(o1 = push*(cos(x/length)*dot([x/length, 1/3], (1/3, 2)))),
    observe(o2 = push*(y/length)),
    observe(o3 = push*(sum(k10 in 0..3: cos(k10*cross([tan(tanh(theta)/2), cos(theta), 1], [1, (1 + (second*der(theta))^2)^(-1/3), cos(theta)])[1])))),
    observe(px, rim, each[k in 0..2] = odd[k]*t/second, height = gap(floor), total = energy),
    observe(up = momentum(y), pressed = floor + mass*der(der(x))),
    mark(passes: theta/3 + -acos(tanh(1.5)/2)*(y/length - pi)),
    mark(reached: push*(sin(theta)) >= push*ratio and open(floor)),
    mark(heavy: floor >= 3*push),
    stop(far: x^2 + y^2 >= 100*length^2),
    stop(fast: second*der(theta) >= 20 + sin((second*der(u)/length)^2 - second*der(theta))),
    draw(mass: (px, y)),
    draw(shell: (0, -length), radius = length),
    draw(spring: (0, 0) to (x, y)),
    impacts = in_turn,
    emit = loops,
)]
pub struct Drawn18<T = f64> {
    #[lagrange(unit = "s", domain = "positive")]
    pub second: T,
    #[lagrange(unit = "m", domain = "positive")]
    pub length: T,
    pub ratio: T,
    #[lagrange(unit = "kg", domain = "positive")]
    pub mass: T,
    #[lagrange(unit = "kg m^2", domain = "positive")]
    pub inertia: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "N/m", domain = "nonnegative")]
    pub stiffness: T,
    #[lagrange(unit = "N s/m", domain = "nonnegative")]
    pub damping: T,
    #[lagrange(unit = "N")]
    pub push: T,
    pub weights: [T; 2],
    pub bounce: T,
}

impl Default for Drawn18 {
    fn default() -> Self {
        Self {
            second: 1.214,
            length: 0.868,
            ratio: 0.482,
            mass: 0.586,
            inertia: 0.248,
            gravity: 9.555,
            stiffness: 0.956,
            damping: 0.347,
            push: 0.708,
            weights: [1.5, 0.5],
            bounce: 0.5,
        }
    }
}
}

pub mod d28 {
use lagrange_core::prelude::*;

/// Declaration drawn at random.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    define(px = x + length*((1 + tanh(t/second)^2)^(1/2))),
    define(rim = [x + length*cos(theta), y + length*sin(theta)]),
    define(odd[k in 0..2] = weights[k]*length*(2*k + 1)),
    kinetic(motion: mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2),
    kinetic(more: (2 + sin(atan2(x/length, 1 + (ln(1 + (3/7)^2) - (y/length + x/length))^2)))*mass/8*der(px)^2),
    potential(rest: mass*gravity*y + stiffness/2*(x^2 + y^2)),
    potential(random: stiffness*length^2*(list(k0 in 0..3: -x/length - k0)[2])),
    contact(floor: y + length/8*sin(cross([ln(1 + sum(k3 in 0..3: cos(k3*2))^2), -(t/second - x/length), 1], [1, dot([0.25, y/length], (y/length, 2))*(theta*(pi/4)), -(t/second - x/length)])[1]) >= length/4*sin(sum(k1 in 0..3: cos(k1*(t/second + 1e-1)))/(1 + sum(k2 in 0..3: cos(k2*cos(t/second)))^2)), restitution = bounce),
    force(drive: x = push*(second*der(theta))),
    force(twist: theta = push*length*sin((-pi/4)/(1 + ((second*der(theta))^2)^2))),
    force(wind: (push*sin((-pi/4)/(1 + ((second*der(theta))^2)^2)), push*sin((y/length + ratio)/(1 + sum(k6 in 0..3: cos(k6*(y/length)))^2))) at rim),
    dissipation(oil: (2 + sin(ln(1 + cross([ratio, x/length, 1], [1, y/length, x/length])[1]^2)))*damping/2*(der(x)^2 + der(y)^2)),
    start(thrown: x = length*((1 + list(k8 in 0..3: ratio - k8)[2]^2)^3), der(x) = length/second*(ratio), theta = (abs(atan(ratio))), der(y) = -length/second*(ratio), y = 2*length),
    start(low: y = length/2, der(theta) = 1/second),
    observe(o0 = push*(3/7)),
    observe(o1 = push*((1 + cosh(tanh(second*der(theta))/2)^2)^(1/2))),
    observe(o2 = push*((t/second)^2 + second*der(ratio))),
    observe(o3 = push*(second*der(theta))),
    observe(px, rim, each[k in 0..2] = odd[k]*t/second, height = gap(floor), total = energy),
    observe(up = momentum(y), pressed = floor + mass*der(der(x))),
    mark(passes: theta/3 + second*der(sign(y/length) + (-3/7))),
    mark(reached: push*((1 + sum(k9 in 0..3: cos(k9*(t/second)))^2)^(-1)) >= push*ratio and open(floor)),
    mark(heavy: floor >= 3*push),
    stop(far: x^2 + y^2 >= 100*length^2),
    stop(fast: second*der(theta) >= 20 + sin((ratio*theta)^2)),
    draw(shell: (0, -length), radius = length),
    draw(bowl: (0, length), radius = 2*length),
    draw(polygon: rim to (x, y) to (0, 0)),
    impacts = in_turn,
)]
pub struct Drawn28<T = f64> {
    #[lagrange(unit = "s", domain = "positive")]
    pub second: T,
    #[lagrange(unit = "m", domain = "positive")]
    pub length: T,
    pub ratio: T,
    #[lagrange(unit = "kg", domain = "positive")]
    pub mass: T,
    #[lagrange(unit = "kg m^2", domain = "positive")]
    pub inertia: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "N/m", domain = "nonnegative")]
    pub stiffness: T,
    #[lagrange(unit = "N s/m", domain = "nonnegative")]
    pub damping: T,
    #[lagrange(unit = "N")]
    pub push: T,
    pub weights: [T; 2],
    pub bounce: T,
}

impl Default for Drawn28 {
    fn default() -> Self {
        Self {
            second: 1.502,
            length: 1.072,
            ratio: -0.587,
            mass: 1.478,
            inertia: 0.533,
            gravity: 3.247,
            stiffness: 1.601,
            damping: 0.252,
            push: 0.358,
            weights: [1.5, 0.5],
            bounce: 0.5,
        }
    }
}
}

pub mod d38 {
use lagrange_core::prelude::*;

/// Declaration drawn at random.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    define(px = x + length*(ratio)),
    define(rim = [x + length*cos(theta), y + length*sin(theta)]),
    define(odd[k in 0..2] = weights[k]*length*(2*k + 1)),
    kinetic(motion: mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2),
    kinetic(more: (2 + sin((1 + theta^2)^-2))*mass/8*der(px)^2),
    potential(rest: mass*gravity*y + stiffness/2*(x^2 + y^2)),
    potential(random: stiffness*length^2*(dot([t/second/(1 + ratio^2), atan(3/7)], (atan(3/7), 2)) + atan(3/7)*(-ratio))),
    contact(floor: y >= length/4*sin(exp(tanh(1.5 - t/second)/2))),
    friction(grip on floor: slip = (der(x), length*der(theta)), static = 0.3 + bounce/10, kinetic = 1/5),
    force(drive: x = push*(list(k1 in 0..3: (1 + (second*der(x)/length)^2)^-2 - k1)[2])),
    force(twist: theta = push*length*sin((1 + (second*der(y)/length - pi/4)^2)^(3/2) + second*der(y)/length)),
    force(motor: push*sin(atan2(1.5, 1 + (second*der(theta))^2)) along der(x) + length*sin(t/second)*der(theta)),
    dissipation(oil: (2 + sin(asin(tanh(atan(ratio) - exp(tanh(y/length)/2))/2)))*damping/2*(der(x)^2 + der(y)^2)),
    start(thrown: x = length*(t/second), der(x) = length/second*(-ratio), theta = (t/second), der(y) = -length/second*(sqrt(1 + dot([ratio, ratio], (ratio, 2))^2)), y = 2*length),
    start(low: y = length/2, der(theta) = 1/second),
    observe(o0 = push*(sinh(tanh(atan(1.5))/2))),
    observe(o1 = push*(dot([second*der(theta), y/length], (y/length, 2)))),
    observe(o2 = push*(sum(k4 in 0..3: cos(k4*(1e-1 + y/length))))),
    observe(o3 = push*(cos(-theta))),
    observe(px, rim, each[k in 0..2] = odd[k]*t/second, height = gap(floor), total = energy),
    observe(up = momentum(y), pressed = floor + mass*der(der(x))),
    mark(passes: theta/3 + -second*der(x)/length),
    mark(reached: push*((3/7)^2) >= push*ratio and open(floor)),
    mark(heavy: floor >= 3*push),
    stop(far: x^2 + y^2 >= 100*length^2),
    stop(fast: second*der(theta) >= 20 + sin(acos(tanh(y/length)/2) - norm([x/length, 1, t/second, 3/7]))),
    draw(floor: -length),
    draw(shell: (0, -length), radius = length),
    draw(rope: (0, 0) to (px, y) to rim),
)]
pub struct Drawn38<T = f64> {
    #[lagrange(unit = "s", domain = "positive")]
    pub second: T,
    #[lagrange(unit = "m", domain = "positive")]
    pub length: T,
    pub ratio: T,
    #[lagrange(unit = "kg", domain = "positive")]
    pub mass: T,
    #[lagrange(unit = "kg m^2", domain = "positive")]
    pub inertia: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "N/m", domain = "nonnegative")]
    pub stiffness: T,
    #[lagrange(unit = "N s/m", domain = "nonnegative")]
    pub damping: T,
    #[lagrange(unit = "N")]
    pub push: T,
    pub weights: [T; 2],
    pub bounce: T,
}

impl Default for Drawn38 {
    fn default() -> Self {
        Self {
            second: 1.701,
            length: 1.373,
            ratio: -0.665,
            mass: 1.396,
            inertia: 0.824,
            gravity: 5.852,
            stiffness: 0.773,
            damping: 0.301,
            push: 0.751,
            weights: [1.5, 0.5],
            bounce: 0.5,
        }
    }
}
}

pub mod d44 {
use lagrange_core::prelude::*;

/// Declaration drawn at random.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    define(px = x + length*((ratio - theta)^2)),
    define(rim = [x + length*cos(theta), y + length*sin(theta)]),
    define(odd[k in 0..2] = weights[k]*length*(2*k + 1)),
    kinetic(motion: mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2),
    kinetic(more: (2 + sin(sqrt(1 + (y/length - dot([ratio, 1e-1], (1e-1, 2)))^2)))*mass/8*der(px)^2),
    potential(rest: mass*gravity*y + stiffness/2*(x^2 + y^2)),
    potential(random: stiffness*length^2*((1 + (-x/length)^2)^(-1/3))),
    contact(floor: y + length/8*sin(list(k1 in 0..3: (1 + (y/length)^2)^(3/2) + tanh(3/7) - k1)[2]) >= length/4*sin(cosh(tanh(t/second)/2)), restitution = poisson(bounce)),
    friction(grip on floor: slip = (der(x), length*der(theta)), static = 0.3 + bounce/10),
    force(drive: x = push*(pi/4*(-ratio))),
    force(motor: push*sin(second*der(y)/length) along der(x) + length*sin(theta)*der(theta)),
    dissipation(oil: (2 + sin(-acos(tanh(ratio)/2)))*damping/2*(der(x)^2 + der(y)^2)),
    start(thrown: x = length*(sqrt(1 + pi^2)), der(x) = length/second*(cross([cross([pi/4, ratio, 1], [1, ratio, ratio])[1], pi/4 + t/second, 1], [1, (t/second)^2, pi/4 + t/second])[1]), theta = ((1 + ratio^2)^(-1/3) + (1 + 1.5^2)^3), der(y) = -length/second*(if(min(pi, ratio) >= 1/5, -t/second, ratio - ratio)), y = 2*length),
    start(low: y = length/2, der(theta) = 1/second),
    observe(o0 = push*((1 + (2 - ratio)^2)^(-1/3))),
    observe(o1 = push*(((1 + (second*der(y)/length*(second*der(y)/length))^2)^(-1/3))^2)),
    observe(o2 = push*((second*der(theta) + theta)/(1 + min(1e-1, x/length)^2))),
    observe(o3 = push*(second*der(y)/length)),
    observe(px, rim, each[k in 0..2] = odd[k]*t/second, height = gap(floor), total = energy),
    observe(up = momentum(y), pressed = floor + mass*der(der(x))),
    mark(passes: theta/3 + (1 + (y/length*(second*der(theta)) - sinh(tanh(t/second)/2))^2)^(-1/3)),
    mark(reached: push*(sum(k5 in 0..3: cos(k5*list(k4 in 0..3: theta - k4)[2]))) >= push*ratio and open(floor)),
    mark(heavy: floor >= 3*push),
    stop(far: x^2 + y^2 >= 100*length^2),
    stop(fast: second*der(theta) >= 20 + sin(cross([second*der(y)/length + ratio, (1 + theta^2)^(1/2), 1], [1, -t/second, (1 + theta^2)^(1/2)])[1])),
    draw(rope: (0, 0) to (px, y) to rim),
    draw(shell: (0, -length), radius = length),
    draw(floor: -length),
    emit = loops,
)]
pub struct Drawn44<T = f64> {
    #[lagrange(unit = "s", domain = "positive")]
    pub second: T,
    #[lagrange(unit = "m", domain = "positive")]
    pub length: T,
    pub ratio: T,
    #[lagrange(unit = "kg", domain = "positive")]
    pub mass: T,
    #[lagrange(unit = "kg m^2", domain = "positive")]
    pub inertia: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "N/m", domain = "nonnegative")]
    pub stiffness: T,
    #[lagrange(unit = "N s/m", domain = "nonnegative")]
    pub damping: T,
    #[lagrange(unit = "N")]
    pub push: T,
    pub weights: [T; 2],
    pub bounce: T,
}

impl Default for Drawn44 {
    fn default() -> Self {
        Self {
            second: 1.893,
            length: 1.913,
            ratio: -0.846,
            mass: 1.41,
            inertia: 0.375,
            gravity: 4.05,
            stiffness: 1.346,
            damping: 0.116,
            push: 0.475,
            weights: [1.5, 0.5],
            bounce: 0.5,
        }
    }
}
}

pub mod d61 {
use lagrange_core::prelude::*;

/// Declaration drawn at random.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta, u),
    define(px = x + length*(pi/4)),
    define(rim = [x + length*cos(theta), y + length*sin(theta)]),
    define(odd[k in 0..2] = weights[k]*length*(2*k + 1)),
    lagrangian = mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2 + mass/2*der(u)^2 - (mass*gravity*y + stiffness/2*(x^2 + y^2)) - stiffness*length^2*(u/length),
    constraint(tie: u == length*sin(t/second)),
    contact(floor: y >= length/4*sin((1 + 1e-1^2)^(1/2) + tanh(1.5)), restitution = bounce, where x <= 3*length),
    friction(grip on floor: slip = der(x), static = 0.3 + bounce/10),
    force(drive: x = push*(cross([second*der(y)/length, 1/3, 1], [1, x/length, 1/3])[1] + asin(tanh(y/length)/2))),
    force(wind: (push*sin(cross([ln(1 + sinh(tanh(x/length)/2)^2), dot([exp(tanh(3/7)/2), (u/length)^2], ((u/length)^2, 2)), 1], [1, norm([3/7, 1, theta, 3/7])/(1 + (second*der(x)/length/(1 + theta^2))^2), dot([exp(tanh(3/7)/2), (u/length)^2], ((u/length)^2, 2))])[1]), push*sin(sin(x/length/(1 + (t/second)^2)))) at rim),
    dissipation(oil: (2 + sin(sinh(tanh((1 + 2^2)^-2)/2) - u/length))*damping/2*(der(x)^2 + der(y)^2)),
    start(thrown: x = length*(sum(k3 in 0..3: cos(k3*ratio))*(t/second)^2), der(x) = length/second*(dot([ratio/(1 + (pi/4)^2), ratio], (ratio, 2))), theta = (atan2(t/second, 1 + (t/second)^2)*(t/second)), der(y) = -length/second*(t/second), y = 2*length),
    start(low: y = length/2, der(theta) = 1/second),
    observe(o0 = push*(second*der(theta))),
    observe(o1 = push*((1 + sqrt(1 + ratio^2)^2)^(tanh(second*der(t/second))/2))),
    observe(o2 = push*(sum(k5 in 0..3: cos(k5*(second*der(x)/length))) - ln(1 + (second*der(u)/length)^2))),
    observe(o3 = push*((1 + theta^2)^(1/2))),
    observe(px, rim, each[k in 0..2] = odd[k]*t/second, height = gap(floor), total = energy),
    observe(up = momentum(y), pressed = floor + mass*der(der(x))),
    observe(creep = slip(grip), held = grip),
    mark(stops: sticks(grip) and closed(floor)),
    mark(goes: slips(grip) and x >= 0),
    mark(passes: theta/3 + (theta - 2)/(1 + (2*(pi/4))^2)),
    mark(reached: push*(asin(tanh(y/length)/2)) >= push*ratio and open(floor)),
    mark(heavy: floor >= 3*push),
    stop(far: x^2 + y^2 >= 100*length^2),
    stop(fast: second*der(theta) >= 20 + sin(pi/4)),
    draw(ground: (0, 0) to (length, 0) to (length, -length)),
    draw(mass: (px, y)),
    draw(polygon: rim to (x, y) to (0, 0)),
    impacts = together,
)]
pub struct Drawn61<T = f64> {
    #[lagrange(domain = "positive")]
    pub second: T,
    #[lagrange(domain = "positive")]
    pub length: T,
    pub ratio: T,
    #[lagrange(domain = "positive")]
    pub mass: T,
    #[lagrange(domain = "positive")]
    pub inertia: T,
    pub gravity: T,
    #[lagrange(domain = "nonnegative")]
    pub stiffness: T,
    #[lagrange(domain = "nonnegative")]
    pub damping: T,
    pub push: T,
    pub weights: [T; 2],
    pub bounce: T,
}

impl Default for Drawn61 {
    fn default() -> Self {
        Self {
            second: 0.822,
            length: 0.84,
            ratio: 0.908,
            mass: 1.823,
            inertia: 0.317,
            gravity: 8.863,
            stiffness: 1.573,
            damping: 0.27,
            push: 0.114,
            weights: [1.5, 0.5],
            bounce: 0.5,
        }
    }
}
}

pub mod d108 {
use lagrange_core::prelude::*;

/// Declaration drawn at random.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    define(px = x + length*(cross([t/second, t/second, 1], [1, theta, t/second])[1]*(t/second))),
    define(rim = [x + length*cos(theta), y + length*sin(theta)]),
    define(odd[k in 0..2] = weights[k]*length*(2*k + 1)),
    kinetic(motion: mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2),
    kinetic(more: (2 + sin(theta*(y/length - y/length)))*mass/8*der(px)^2),
    potential(rest: mass*gravity*y + stiffness/2*(x^2 + y^2)),
    potential(random: stiffness*length^2*(list(k1 in 0..3: ratio - x/length - k1)[2])),
    contact(floor: y >= length/4*sin(1.5*(t/second)), restitution = poisson(bounce), where x <= 3*length),
    force(drive: x = push*(x/length*(second*der(x)/length))),
    force(twist: theta = push*length*sin(x/length)),
    force(wind: (push*sin(x/length), push*sin(list(k2 in 0..3: (y/length)^2 - k2)[2])) at rim),
    force(motor: push*sin(second*der(y/length)) along der(x) + length*sin(cross([theta, ratio, 1], [1, theta, ratio])[1]/(1 + (theta/(1 + (3/7)^2))^2))*der(theta)),
    dissipation(oil: (2 + sin((1 + ratio^2)^(1/2)))*damping/2*(der(x)^2 + der(y)^2)),
    start(thrown: x = length*((pi/4)^2), der(x) = length/second*(cross([t/second, ratio, 1], [1, t/second, ratio])[1] + ratio), theta = ((1 + sum(k5 in 0..3: cos(k5*ratio))^2)^(-1)), der(y) = -length/second*(sqrt(1 + (asin(tanh(t/second)/2)/(1 + (-ratio)^2))^2)), y = 2*length),
    start(low: y = length/2, der(theta) = 1/second),
    observe(o0 = push*(theta)),
    observe(o1 = push*((1 + (3/7)^2)^(-1) - pi/4/(1 + (second*der(x)/length)^2))),
    observe(o2 = push*(0.25)),
    observe(o3 = push*(dot([ln(1 + ((1 + ratio^2)^3)^2), second*der(theta)], (second*der(theta), 2)))),
    observe(px, rim, each[k in 0..2] = odd[k]*t/second, height = gap(floor), total = energy),
    observe(up = momentum(y), pressed = floor + mass*der(der(x))),
    mark(passes: theta/3 + cos(theta/(1 + 1.5^2))),
    mark(reached: push*(ratio) >= push*ratio and open(floor)),
    mark(heavy: floor >= 3*push),
    stop(far: x^2 + y^2 >= 100*length^2),
    stop(fast: second*der(theta) >= 20 + sin(list(k7 in 0..3: (1 + (-second*der(y)/length)^2)^3 - k7)[2])),
    draw(disc: (x, y), radius = length, angle = theta + sin(1/3 + theta)),
    draw(ground: (0, 0) to (length, 0) to (length, -length)),
    draw(pivot[k in 0..2]: (odd[k], 0)),
    check(conserved length*ratio),
)]
pub struct Drawn108<T = f64> {
    #[lagrange(unit = "s", domain = "positive")]
    pub second: T,
    #[lagrange(unit = "m", domain = "positive")]
    pub length: T,
    pub ratio: T,
    #[lagrange(unit = "kg", domain = "positive")]
    pub mass: T,
    #[lagrange(unit = "kg m^2", domain = "positive")]
    pub inertia: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "N/m", domain = "nonnegative")]
    pub stiffness: T,
    #[lagrange(unit = "N s/m", domain = "nonnegative")]
    pub damping: T,
    #[lagrange(unit = "N")]
    pub push: T,
    pub weights: [T; 2],
    pub bounce: T,
}

impl Default for Drawn108 {
    fn default() -> Self {
        Self {
            second: 1.574,
            length: 0.826,
            ratio: 0.238,
            mass: 1.571,
            inertia: 0.667,
            gravity: 3.904,
            stiffness: 1.299,
            damping: 0.476,
            push: 0.517,
            weights: [1.5, 0.5],
            bounce: 0.5,
        }
    }
}
}

pub mod d109 {
use lagrange_core::prelude::*;

/// Declaration drawn at random.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta, u),
    define(px = x + length*(dot([ratio + x/length, tan(tanh(theta)/2)], (tan(tanh(theta)/2), 2)))),
    define(rim = [x + length*cos(theta), y + length*sin(theta)]),
    define(odd[k in 0..2] = weights[k]*length*(2*k + 1)),
    kinetic = mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2 + mass/2*der(u)^2,
    potential = mass*gravity*y + stiffness/2*(x^2 + y^2) + stiffness*length^2*(tanh(list(k1 in 0..3: ratio - k1)[2])),
    constraint(tie: u == length*sin(dot([dot([theta, x/length], (x/length, 2)), ratio/(1 + (pi/4)^2)], (ratio/(1 + (pi/4)^2), 2)))),
    contact(floor: y >= length/4*sin((1 + (ratio - ratio)^2)^(tanh(t/second/(1 + (t/second)^2))/2)), restitution = bounce),
    force(drive: x = push*(dot([second*der(t/second), x/length], (x/length, 2)))),
    dissipation(oil: (2 + sin(sinh(tanh(dot([ratio, ratio], (ratio, 2)))/2)))*damping/2*(der(x)^2 + der(y)^2)),
    start(thrown: x = length*(cross([t/second*ratio, t/second, 1], [1, sum(k9 in 0..3: cos(k9*(t/second))), t/second])[1]), der(x) = length/second*(sum(k10 in 0..3: cos(k10*1.5))), theta = (t/second - t/second), der(y) = -length/second*(if(t/second >= 1/5, -t/second, ratio^2)), y = 2*length),
    start(low: y = length/2, der(theta) = 1/second),
    observe(o0 = push*(sum(k11 in 0..3: cos(k11*(second*der(x/length + ratio)))))),
    observe(o1 = push*(list(k12 in 0..3: second*der(y)/length - k12)[2])),
    observe(o2 = push*(norm([tan(tanh(x/length)/2), 1, list(k13 in 0..3: y/length - k13)[2], 2]))),
    observe(o3 = push*(norm([pi, 1, x/length, second*der(u)/length]))),
    observe(px, rim, each[k in 0..2] = odd[k]*t/second, height = gap(floor), total = energy),
    observe(up = momentum(y), pressed = floor + mass*der(der(x))),
    mark(passes: theta/3 + second*der(u)/length),
    mark(reached: push*(sum(k14 in 0..3: cos(k14*ln(1 + (x/length)^2)))) >= push*ratio and open(floor)),
    mark(heavy: floor >= 3*push),
    stop(far: x^2 + y^2 >= 100*length^2),
    stop(fast: second*der(theta) >= 20 + sin(-(1 + norm([x/length, 1, pi, u/length])^2)^-2)),
    draw(arrow: floor*(0, 1) at (x, y), name = load),
    draw(mass: (px, y)),
    draw(rod: (x, y) to rim),
)]
pub struct Drawn109<T = f64> {
    #[lagrange(domain = "positive")]
    pub second: T,
    #[lagrange(domain = "positive")]
    pub length: T,
    pub ratio: T,
    #[lagrange(domain = "positive")]
    pub mass: T,
    #[lagrange(domain = "positive")]
    pub inertia: T,
    pub gravity: T,
    #[lagrange(domain = "nonnegative")]
    pub stiffness: T,
    #[lagrange(domain = "nonnegative")]
    pub damping: T,
    pub push: T,
    pub weights: [T; 2],
    pub bounce: T,
}

impl Default for Drawn109 {
    fn default() -> Self {
        Self {
            second: 0.614,
            length: 0.862,
            ratio: -0.452,
            mass: 1.674,
            inertia: 0.861,
            gravity: 6.155,
            stiffness: 0.799,
            damping: 0.285,
            push: 0.319,
            weights: [1.5, 0.5],
            bounce: 0.5,
        }
    }
}
}

pub mod d113 {
use lagrange_core::prelude::*;

/// Declaration drawn at random.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta),
    define(px = x + length*(sqrt(1 + (3/7 - t/second)^2))),
    define(rim = [x + length*cos(theta), y + length*sin(theta)]),
    define(odd[k in 0..2] = weights[k]*length*(2*k + 1)),
    lagrangian = mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2 - (mass*gravity*y + stiffness/2*(x^2 + y^2)) - stiffness*length^2*(t/second),
    contact(floor: y + length/8*sin(ratio) >= length/4*sin(acos(tanh(0.25 - t/second)/2)), where x <= 3*length),
    force(drive: x = push*(if(atan(second*der(theta)) >= 1/5, dot([second*der(y)/length, second*der(y)/length], (second*der(y)/length, 2)), x/length)/(1 + (-tanh(second*der(x)/length))^2))),
    force(twist: theta = push*length*sin(tan(tanh(0.25*(x/length))/2))),
    force(wind: (push*sin(tan(tanh(0.25*(x/length))/2)), push*sin((1 + (-ratio)^2)^(tanh(asin(tanh(y/length)/2))/2))) at rim),
    define(drag = floor*sin(-(1 + (pi/4)^2)^(-1/3))/4),
    force(skid: theta = length*drag),
    dissipation(oil: (2 + sin(atan2(0.25 + y/length, 1 + (y/length)^2)/(1 + (pi/(1 + ratio^2)*(t/second))^2)))*damping/2*(der(x)^2 + der(y)^2)),
    start(thrown: x = length*(t/second/(1 + (dot([2, t/second], (t/second, 2))^2)^2)), der(x) = length/second*(acos(tanh(dot([t/second, ratio], (ratio, 2)))/2)), theta = (cos(t/second*(3/7))), der(y) = -length/second*(cross([sinh(tanh(ratio)/2), ratio^2, 1], [1, 1.5 + 2, ratio^2])[1]), y = 2*length),
    start(low: y = length/2, der(theta) = 1/second),
    observe(o0 = push*(x/length - second*der(x)/length*(y/length))),
    observe(o1 = push*(sinh(tanh(second*der(theta)*(t/second))/2))),
    observe(o2 = push*(second*der(theta))),
    observe(o3 = push*(tan(tanh(t/second)/2))),
    observe(px, rim, each[k in 0..2] = odd[k]*t/second, height = gap(floor), total = energy),
    observe(up = momentum(y), pressed = floor + mass*der(der(x))),
    mark(passes: theta/3 + ((-second*der(theta))/(1 + (-second*der(theta))^2))^2),
    mark(reached: push*(ln(1 + sin(2)^2)) >= push*ratio and open(floor)),
    mark(heavy: floor >= 3*push),
    stop(far: x^2 + y^2 >= 100*length^2),
    stop(fast: second*der(theta) >= 20 + sin(cross([(second*der(y)/length)^2, -y/length, 1], [1, second*der(theta), -y/length])[1])),
    draw(path: rim),
    draw(shell: (0, -length), radius = length),
    draw(spring: (0, 0) to (x, y)),
    impacts = in_turn,
)]
pub struct Drawn113<T = f64> {
    #[lagrange(domain = "positive")]
    pub second: T,
    #[lagrange(domain = "positive")]
    pub length: T,
    pub ratio: T,
    #[lagrange(domain = "positive")]
    pub mass: T,
    #[lagrange(domain = "positive")]
    pub inertia: T,
    pub gravity: T,
    #[lagrange(domain = "nonnegative")]
    pub stiffness: T,
    #[lagrange(domain = "nonnegative")]
    pub damping: T,
    pub push: T,
    pub weights: [T; 2],
    pub bounce: T,
}

impl Default for Drawn113 {
    fn default() -> Self {
        Self {
            second: 1.534,
            length: 0.697,
            ratio: 0.767,
            mass: 1.898,
            inertia: 0.639,
            gravity: 3.83,
            stiffness: 1.308,
            damping: 0.3,
            push: 0.405,
            weights: [1.5, 0.5],
            bounce: 0.5,
        }
    }
}
}

/// Calls a function for each system.
macro_rules! each {
    ($check:ident) => {
        $check::<super::written::d18::Drawn18>(18);
        $check::<super::written::d28::Drawn28>(28);
        $check::<super::written::d38::Drawn38>(38);
        $check::<super::written::d44::Drawn44>(44);
        $check::<super::written::d61::Drawn61>(61);
        $check::<super::written::d108::Drawn108>(108);
        $check::<super::written::d109::Drawn109>(109);
        $check::<super::written::d113::Drawn113>(113);
    };
}
pub(crate) use each;
