// Rust's if.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(a = if x >= 0 { x } else { 0 }),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:17 E021 `if` is not written so; write `if(a >= b, x, y)`
