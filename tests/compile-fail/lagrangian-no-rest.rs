// A Lagrangian that is infinite at rest cannot be split there into its energies.
#[lagrange(
    coordinates(r, s),
    lagrangian = der(r)^2 / (r^2 * der(s)^2),
)]
struct S {}
//~ 4:18 E517 this Lagrangian has no value where nothing moves; its value at rest says what is potential energy: declare `kinetic = …` and `potential = …` in its place
