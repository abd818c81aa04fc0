// What several constraints press is not linear in their forces.
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    constraint(wall: y == 0),
    constraint(floor: z == 0),
    friction(rub on (wall, floor): slip = der(x), static = 0.3),
    check(still: der(der(x)) == 0),
)]
struct S { mass: f64 }
//~ 8:18 E805 `rub` may slip here, pressed by several constraints together; no check follows that: say `sticks(rub)` in the condition, and compare numbers of a run in a test
