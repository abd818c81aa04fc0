// What presses is named behind `on`.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    constraint(rail: y == 0),
    friction(grip: slip = der(x), normal = rail, static = 0.2),
)]
struct S { mass: f64 }
//~ 6:44 E406 `rail` is a constraint, whose force is not known here; friction names what presses: `friction(… on rail: slip = …, static = …)`
