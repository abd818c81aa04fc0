// A constraint presses in one bearing.
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    constraint(wall: y == 0),
    constraint(floor: z == 0),
    friction(rub on (wall, floor): slip = der(x), static = 0.3),
    friction(grip on floor: slip = der(x), static = 0.1),
)]
struct S { mass: f64 }
//~ 8:22 E516 `rub` is pressed by other constraints than this friction; frictions of one bearing name the same constraints; a bearing beside it has constraints of its own, on a body between them
