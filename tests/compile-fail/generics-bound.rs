// A bound on the scalar.
#[lagrange(coordinates(x), kinetic = mass/2 * der(x)^2)]
struct S<T: Copy> { mass: T }
//~ 3:13 E102 a bound on the type parameter; the struct is plain (`f64` fields) or has exactly one type parameter: `struct S<T = f64>`
