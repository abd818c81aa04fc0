// Exact numbers that overflow where a slip is derived.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    contact(bump: y - 0.12345678901234567 * sin(1.2345678901234567 * x) >= 0),
    friction(grip on bump: slip = der(x) * sqrt(1 + (0.1524157875323883 * cos(1.2345678901234567 * x))^2), static = 1/2),
)]
struct S { mass: f64 }
//~ 5:13 E312 the exact numbers of `bump` outgrow 38 digits; make such numbers parameters
