// A force at a point of a plane has two components, in an item and in a picture.
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    force(weight: g at (x, y)),
    draw(arrow: g at (x, y)),
)]
struct S { g: f64 }
//~ 5:19 E303 a single value where a list is expected; a force has as many components as the place where it acts: `(f, 0) at (x, y)`
//~ 6:17 E303 a single value where a list is expected; a force has as many components as the place where it acts: `(f, 0) at (x, y)`
