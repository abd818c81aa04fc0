// Items have names.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(y >= 0),
    constraint(x == y),
    force(x = 1),
    dissipation(der(x)^2),
    start(x = 1),
    observe(x + y),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:13 E025 this contact has no name; write `contact(name: …)`
//~ 7:16 E025 this constraint has no name; write `constraint(name: …)`
//~ 8:11 E025 this force has no name; write `force(name: …)`
//~ 9:17 E025 this dissipation has no name; write `dissipation(name: …)`
//~ 10:11 E025 this start has no name; write `start(name: …)`
//~ 11:13 E025 this output has no name; write `observe(name = …)`
