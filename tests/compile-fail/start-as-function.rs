// A start as textbooks write it.
#[lagrange(
    coordinates(theta),
    kinetic = der(theta)^2 / 2,
    start(released: theta(0) = 2, v(theta) = 1),
    start(hanging, theta = 0),
)]
struct S {}
//~ 5:21 E001 expected a position `theta = …` or a velocity `der(theta) = …`, found `theta(…)`
//~ 5:35 E001 expected a position `theta = …` or a velocity `der(theta) = …`, found `v(…)`
//~ 6:18 E001 expected `:`, found `,`
