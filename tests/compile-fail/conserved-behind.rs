// The word `conserved` stands before the quantity.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = mass * gravity * x,
    check(energy conserved),
)]
struct S { mass: f64, gravity: f64 }
//~ 6:18 E031 `conserved` stands in the wrong place; the word stands before the quantity: `conserved energy`
