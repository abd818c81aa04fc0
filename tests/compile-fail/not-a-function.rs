// A field is not called.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * mass(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:44 E308 `mass` is not a function; a product is written with `*`: `mass*(…)`; an element `mass[…]`
