// More parentheses than anyone needs.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * ((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((((theta)))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))))),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:144 E022 too many parentheses, powers or indices inside each other; name inner parts with `define`
