// More coordinates than a matrix should have rows.
#[lagrange(
    coordinates(x[3000], y[1001]),
    kinetic = sum(k in 0..3000: der(x[k])^2) + sum(k in 0..1001: der(y[k])^2),
)]
struct S {}
//~ 3:26 E608 4001 coordinates, constraints, contacts and frictions are too many; a declaration may have 4000 together: matrices have a row for each
