// A unit that can be read in two ways.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
)]
struct S { mass: f64, #[lagrange(unit = "J/kg K")] heat: f64, gravity: f64, length: f64 }
//~ 7:41 E703 it is not clear what stands under the stroke; use parentheses: `J/(kg K)`
