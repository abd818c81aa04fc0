// Two scalars.
#[lagrange(coordinates(x), kinetic = mass/2 * der(x)^2)]
struct S<T, U> { mass: T, gravity: U }
//~ 3:13 E102 a second type parameter; the struct is plain (`f64` fields) or has exactly one type parameter: `struct S<T = f64>`
//~ 3:36 E103 a parameter cannot have this type; fields are `T` or `[T; N]` with a number N
