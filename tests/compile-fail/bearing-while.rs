// What presses together holds at the same times.
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    contact(floor: z >= 0),
    constraint(wall: y == 0),
    constraint(held while floor: der(x) == 0),
    friction(rub on (wall, held): slip = der(x), static = 0.3),
)]
struct S { mass: f64 }
//~ 8:22 E516 these constraints do not hold at the same times; constraints press together if all hold always, or all `while` one contact
