// A unit that would need conversion.
#[lagrange(
    coordinates(x: "mm", y: "deg"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:20 E702 `mm` is a multiple of m; numbers are not converted: write `m`, and give the values in it
//~ 3:29 E702 `deg` is a multiple of rad; numbers are not converted: write `rad`, and give the values in it
