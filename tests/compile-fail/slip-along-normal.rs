// A slip along the normal of its contact; one along a moving surface beside it is none.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    contact(floor: y - x/2 >= 0),
    contact(lift: y >= sin(t)),
    friction(rub on floor: slip = (der(x) - 2 * der(y)) / -2, static = 0.3),
    friction(drag on lift: slip = (der(x), cos(t) - der(y)), static = 0.3),
    friction(fair on lift: slip = der(y), static = 0.3),
)]
struct S { mass: f64 }
//~ 7:35 E516 this slip is the velocity along the normal of `floor`; a slip is a velocity along the surface
//~ 8:35 E516 this slip is the velocity along the normal of `lift`; a slip is a velocity along the surface
