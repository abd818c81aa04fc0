// There are three ways to write equations.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    emit = rust,
)]
struct S { mass: f64 }
//~ 5:12 E001 expected `unrolled`, `loops` or `data`, found `rust`
