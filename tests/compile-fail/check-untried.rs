// Three legs in a row: the floor may carry the bench on any two of them.
#[lagrange(
    coordinates(z, a),
    kinetic = mass/2 * der(z)^2 + inertia/2 * der(a)^2,
    potential = mass * gravity * z,
    contact(leg[k in 0..3]: z + (k - 1)*half*sin(a) >= 0),
    check(leg[0] == mass*gravity/4 when closed(leg)),
)]
struct S { mass: f64, inertia: f64, gravity: f64, half: f64 }
//~ 7:11 E806 `leg[0] == mass*gravity/4` is not proven, and could be tried at no state; the mode does not determine `leg[0]`; say more of the state in the condition, or compare numbers of a run in a test
