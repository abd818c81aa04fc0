// f64 in a generic struct.
#[lagrange(coordinates(x), kinetic = mass/2 * der(x)^2)]
struct S<T = f64> { mass: T, gravity: f64 }
//~ 3:39 E103 a parameter cannot have this type; fields are `T` or `[T; N]` with a number N
