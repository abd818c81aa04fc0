// A lifetime.
#[lagrange(coordinates(x), kinetic = der(x)^2)]
struct S<'a> { mass: &'a f64 }
//~ 3:10 E102 a lifetime parameter; the struct is plain (`f64` fields) or has exactly one type parameter: `struct S<T = f64>`
//~ 3:22 E103 a parameter cannot have this type; fields are `f64` or `[f64; N]` with a number N; for other numbers give the struct a parameter, `struct S<T = f64>`, and fields that are `T`
