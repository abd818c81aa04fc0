//! Long hanging chains: one declaration, three lengths.

use lagrange_macros::Lagrangian;

/// A chain of so many links.
macro_rules! chain {
    ($(#[$summary:meta])* $name:ident of $n:literal) => {
        $(#[$summary])*
        ///
        /// The coordinates are the angles of the links from the downward vertical, counter-clockwise. It hangs from a
        /// fixed point and starts at rest as an arc: each link is turned against the one above.
        ///
        /// What to expect: energy is conserved. The lower end cracks like a whip: the steps become small for a moment.
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange(
            coordinates(theta[$n]),
            define(
                x[k in 0..$n] = sum(i in 0..k+1: length * sin(theta[i])),
                y[k in 0..$n] = sum(i in 0..k+1: -length * cos(theta[i])),
            ),
            kinetic   = sum(k in 0..$n: mass/2 * (der(x[k])^2 + der(y[k])^2)),
            potential = sum(k in 0..$n: mass * gravity * y[k]),
            start(arc: theta[k in 0..$n] = start_angle + turn * k),
            start(hanging: theta[k in 0..$n] = 0),
            observe(tip_x = x[$n - 1], tip_y = y[$n - 1]),
            draw(path: (x[$n - 1], y[$n - 1])),
            draw(rod: (0, 0) to list(k in 0..$n: (x[k], y[k]))),
            draw(pivot: (0, 0)),
            draw(mass[k in 0..$n]: (x[k], y[k])),
        )]
        pub struct $name<T = f64> {
            /// Mass at the end of each link, kg.
            pub mass: T,
            /// Length of each link, m.
            pub length: T,
            /// Gravitational acceleration, m/s².
            pub gravity: T,
            /// Angle of the first link at the start, rad from the downward vertical.
            pub start_angle: T,
            /// By how much each link is turned against the one above at the start, rad.
            pub turn: T,
        }

        impl Default for $name {
            /// 2 m and 2 kg in all.
            fn default() -> Self {
                Self {
                    mass: 2.0 / f64::from($n),
                    length: 2.0 / f64::from($n),
                    gravity: 9.81,
                    start_angle: 1.0,
                    turn: 1.0 / f64::from($n),
                }
            }
        }
    };
}

chain! {
    /// A chain of ten links swings in a plane: point masses at the ends of massless rods.
    Chain10 of 10
}
chain! {
    /// A chain of twenty links swings in a plane: point masses at the ends of massless rods.
    Chain20 of 20
}
chain! {
    /// A chain of fifty links swings in a plane: point masses at the ends of massless rods.
    Chain50 of 50
}
