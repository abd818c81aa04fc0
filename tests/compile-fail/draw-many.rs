// More than can be seen.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    draw(rod[k in 0..100]: list(i in 0..100: (x + i, y + k))),
)]
struct S { mass: f64 }
//~ 5:10 E907 a picture has at most 2000 places; draw fewer elements: nobody sees more
