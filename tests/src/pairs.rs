//! Declarations in pairs: with an item and without it. What is left out of the first must cost what the second costs.

use lagrange_core::prelude::*;

/// Something to be done with every pair.
pub trait Visitor {
    /// A declaration with an item, what leaves it out, and the same declaration that never had it.
    fn pair<Whole, Part>(&mut self, pair: &Pair, whole: &Whole, part: &Part)
    where
        Whole: Derived<Scalar = f64> + Starts,
        Part: Derived<Scalar = f64> + Starts;
}

/// What a pair differs in.
#[derive(Clone, Debug)]
pub struct Pair {
    /// `spring (potential)`
    pub name: String,
    /// What leaves the item out of the whole.
    pub without: Effects,
}

/// Declares pairs, in groups with items in common: the numbers, the items of both, then the one item that only the first has.
macro_rules! pairs {
    ($($common:tt { $($whole:ident $part:ident $numbers:tt [$($item:ident),*] $both:tt $only:tt)* })*) => {
        $($(pairs!(@one $whole $part $numbers $common $both $only);)*)*

        /// All pairs.
        pub fn visit(visitor: &mut impl Visitor) {
            $($(
                let mut without = Effects::all();
                let mut names: Vec<String> = Vec::new();
                $(
                    let item = Item::from($whole::$item);
                    names.push(format!("{} ({})", item.name($whole::DESCRIPTION), item.kind()));
                    without = without.without(item);
                )*
                let pair = Pair { name: names.join(", "), without };
                visitor.pair(&pair, &$whole::default(), &$part::default());
            )*)*
        }
    };
    (@one $whole:ident $part:ident { $($field:ident = $value:literal),* } { $($common:tt)* } { $($both:tt)* } { $($only:tt)* }) => {
        /// With the item.
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange($($common)* $($both)* $($only)*)]
        pub struct $whole { $(#[doc = "A number."] pub $field: f64),* }

        impl Default for $whole {
            fn default() -> Self {
                Self { $($field: $value),* }
            }
        }

        /// Without it.
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange($($common)* $($both)*)]
        pub struct $part { $(#[doc = "A number."] pub $field: f64),* }

        impl Default for $part {
            fn default() -> Self {
                Self { $($field: $value),* }
            }
        }
    };
}

pairs! {
    {
        coordinates(x, y, theta),
        define(px = x + length * sin(theta), py = y - length * cos(theta)),
        kinetic(masses: cart/2 * (der(x)^2 + der(y)^2) + bob/2 * (der(px)^2 + der(py)^2)),
        potential(weight: g * (cart * y + bob * py)),
        contact(floor: y >= 0),
        start(held: x = 1/10, theta = 1),
    } {
        CartWithSpring CartWithoutSpring { cart = 1.5, bob = 0.7, length = 0.9, g = 9.81, k = 3.0 } [SPRING] {
            friction(grip on floor: slip = der(x), static = 2/5),
        } {
            potential(spring: k/2 * x^2 * (1 + x^2)),
        }
        CartWithRotor CartWithoutRotor { cart = 1.5, bob = 0.7, length = 0.9, g = 9.81, inertia = 0.3 } [ROTOR] {} {
            kinetic(rotor: inertia/2 * der(theta)^2 * (1 + cos(theta)^2)),
        }
        CartWithMotor CartWithoutMotor { cart = 1.5, bob = 0.7, length = 0.9, g = 9.81, torque = 2.0, rate = 1.3 } [MOTOR] {} {
            force(motor: theta = torque * sin(rate * t)),
        }
        CartInWind CartWithoutWind { cart = 1.5, bob = 0.7, length = 0.9, g = 9.81, strength = 0.8 } [WIND] {} {
            force(wind: (strength * (1 + py^2), 0) at (px, py)),
        }
        CartWithDrag CartWithoutDrag { cart = 1.5, bob = 0.7, length = 0.9, g = 9.81, damping = 0.25 } [DRAG] {} {
            dissipation(drag: damping/2 * (der(px)^2 + der(py)^2)),
        }
        CartWithWall CartWithoutWall { cart = 1.5, bob = 0.7, length = 0.9, g = 9.81 } [WALL] {
            friction(grip on floor: slip = der(x), static = 2/5),
        } {
            contact(wall: x + length * sin(theta) <= 5, restitution = 1/2),
            friction(rub on wall: slip = der(y) + length * sin(theta) * der(theta), static = 3/10),
        }
        CartWithBrake CartWithoutBrake { cart = 1.5, bob = 0.7, length = 0.9, g = 9.81, most = 0.6 } [BRAKE] {} {
            friction(brake: slip = der(theta), limit = most),
        }
        CartWithTrack CartWithoutTrack { cart = 1.5, bob = 0.7, length = 0.9, g = 9.81 } [TRACK] {} {
            constraint(track while floor: der(x) == length * der(theta)),
        }
    }
    {
        coordinates(x, phi, r, theta),
        define(px = x + r * sin(theta), py = r * cos(theta)),
        kinetic = wheel/2 * der(x)^2 + inertia/2 * der(phi)^2 + mass/2 * (der(px)^2 + der(py)^2),
        potential = mass * g * py,
        contact(rim: r >= radius),
        start(rest: r = radius, theta = 1/20),
    } {
        WheelWithGrip WheelWithoutGrip { wheel = 1.0, inertia = 0.125, mass = 0.2, radius = 0.5, g = 9.81 } [GRIP] {
            constraint(rolling: der(x) == radius * der(phi)),
        } {
            friction(grip on rim: slip = radius * (der(theta) - der(phi)), static = 3/5, kinetic = 1/2),
        }
        WheelThatRolls WheelOnIce { wheel = 1.0, inertia = 0.125, mass = 0.2, radius = 0.5, g = 9.81 } [ROLLING] {
            friction(grip on rim: slip = radius * (der(theta) - der(phi)), static = 3/5, kinetic = 1/2),
        } {
            constraint(rolling: der(x) == radius * der(phi)),
        }
    }
    {} {
        BeadsOnRod BeadsApart { m = 0.4, g = 9.81, length = 0.8 } [ROD] {
            coordinates(x, y, u, v),
            kinetic = m/2 * (der(x)^2 + der(y)^2 + der(u)^2 + der(v)^2),
            potential = m * g * (y + v),
            constraint(wire: y == x^2/2),
            friction(sleeve on wire: slip = (der(x) + x * der(y)) / sqrt(1 + x^2), static = 1/5),
            start(held: u = length, x = 0),
        } {
            constraint(rod: (x - u)^2 + (y - v)^2 == length^2),
        }
        PuckOnCloth PuckOnIce { m = 0.2, a = 0.03, g = 9.81, speed = 0.7 } [CLOTH] {
            coordinates(x, y, z, wx, wy),
            kinetic = m/2 * (der(x)^2 + der(y)^2 + der(z)^2) + m * a^2/5 * (der(wx)^2 + der(wy)^2),
            potential = m * g * z,
            contact(table: z >= a),
            start(struck: z = a, der(x) = speed, der(wx) = 9),
        } {
            friction(cloth on table: slip = (der(x) - a * der(wy), der(y) + a * der(wx)), static = 1/5),
        }
        BallThatStops BallThatFalls { m = 0.2, g = 9.81, h = 2.0 } [CAUGHT, PASSES, SPEED] {
            coordinates(x, z),
            kinetic = m/2 * (der(x)^2 + der(z)^2),
            potential = m * g * z,
            contact(floor: z >= 0, restitution = 4/5),
            start(dropped: z = h, der(x) = 1/2),
        } {
            stop(caught: x^2 + z^2 >= 9),
            mark(passes: z <= h/2),
            observe(speed = sqrt(der(x)^2 + der(z)^2)),
        }
    }
}
