// What only files have: a struct has fields, and a run its times.
#[lagrange(
    parameters(mass = 1),
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    until = 10,
)]
struct S {}
//~ 3:5 E010 `parameters` is not an item; the fields of the struct are the parameters: `struct Pendulum { mass: f64 }`
//~ 6:5 E010 `until` is not an item; the time at which a run ends is told to the run: `simulation.run(start, 0.0..10.0)`
