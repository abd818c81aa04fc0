// A field that is not a number.
#[lagrange(coordinates(x), kinetic = mass/2 * der(x)^2)]
struct S { mass: f64, name: String }
//~ 3:29 E103 a parameter cannot have this type; fields are `f64` or `[f64; N]` with a number N; for other numbers give the struct a parameter, `struct S<T = f64>`, and fields that are `T`
